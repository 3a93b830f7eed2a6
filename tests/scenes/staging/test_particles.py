"""Effects: functions of time with a constant number of shapes."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE, stage, thing

from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.render import render
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.scene import Effect, SceneObject
from texvent_scenes.staging.compose import ComposedScene
from texvent_scenes.staging.particles.emitter import GENERATIONS, TINY_M, Emitter, flight


def staged(*effects, seed=0):
    return stage.__wrapped__(
        SceneObject("box"), effects=effects, place="plain", seed=seed, duration_s=1.0
    )


def small(scene: ComposedScene, time_s: float) -> Float64Array:
    """[n, 3, 4] maps of all small shapes."""
    return np.concatenate([one.at(time_s).to_world for one in scene.particles.effects])


CASES = [(kind, source) for kind in EFFECTS for source in ("box", None)]


@pytest.mark.parametrize(("kind", "source"), CASES)
def test_every_effect_is_a_function_of_time_with_as_many_shapes_at_every_instant(kind, source):
    scene, again = (staged(Effect(kind, source)) for _ in range(2))
    other = staged(Effect(kind, source), seed=1)
    count = len(small(scene, 0.0))
    media = len(scene.environment(0.0).media)
    assert count or media
    for time_s in (0.137, 0.4, 5.3):
        maps, cloud = small(scene, time_s), scene.environment(time_s).media
        assert (len(maps), len(cloud)) == (count, media)
        assert np.isfinite(maps).all()
        assert all(np.isfinite(cloud[name]).all() for name in cloud.dtype.names)
        assert (cloud["optical_depth"] >= 0.0).all()
        np.testing.assert_array_equal(maps, small(again, time_s))
        np.testing.assert_array_equal(cloud, again.environment(time_s).media)
    assert not np.array_equal(maps, small(other, 5.3)) or not np.array_equal(
        cloud, other.environment(5.3).media
    )


@pytest.mark.parametrize(("kind", "source"), CASES)
def test_what_is_seen_of_an_effect_moves_without_jumps(kind, source):
    """In 0.1 ms, nothing moves by more than a hundredth of the scene; births are tiny."""
    scene = staged(Effect(kind, source))
    reach = scene.camera_path.framing.distance_m
    for time_s in np.linspace(0.2, 0.55, 15):
        first, second = small(scene, time_s), small(scene, time_s + 1e-4)
        way = np.linalg.norm(second[:, :, 3] - first[:, :, 3], axis=1)
        size = np.minimum(
            np.linalg.norm(first[:, :, :3], axis=(1, 2)),
            np.linalg.norm(second[:, :, :3], axis=(1, 2)),
        )
        above = np.minimum(first[:, 2, 3] + size, second[:, 2, 3] + size) > 0.0
        seen = (size > 0.004 * reach) & above
        assert way[seen].max(initial=0.0) < 0.01 * reach
        clouds = [scene.environment(t).media for t in (time_s, time_s + 1e-4)]
        places, depths = ([one[name] for one in clouds] for name in ("to_world", "optical_depth"))
        drift = np.linalg.norm((places[1] - places[0])[:, :, 3], axis=1)
        thick = np.minimum(*depths)
        assert drift[thick > 0.02].max(initial=0.0) < 0.01 * reach
        assert np.abs(depths[1] - depths[0]).max(initial=0.0) < 0.05


def test_no_chip_is_seen_right_before_the_camera():
    scene = stage(effects=(Effect("leaves"),), place="plain")
    nearest_m, sizes = 0.3 * scene.camera_path.framing.distance_m, []
    for time_s in np.linspace(0.0, 5.0, 21):
        maps, camera = small(scene, float(time_s)), scene.camera(float(time_s)).position
        is_near = np.linalg.norm(maps[:, :, 3] - camera, axis=1) < nearest_m
        sizes += list(np.linalg.norm(maps[is_near, :, :3], axis=(1, 2)))
    assert len(sizes) > 0
    assert max(sizes) <= 2.0 * TINY_M


def test_ground_truth_belongs_to_the_surface_behind_the_smoke():
    bare, smoky = staged(), staged(Effect("smoke"))
    smoky = ComposedScene(**{**vars(bare), "particles": smoky.particles})
    first, second = (ground_truth(scene, 0.2, 0.25, SIZE) for scene in (bare, smoky))
    np.testing.assert_array_equal(first.depth, second.depth)
    np.testing.assert_array_equal(first.instance, second.instance)
    assert np.abs(render(bare, 0.2, SIZE) - render(smoky, 0.2, SIZE)).max() > 2.0


@pytest.mark.parametrize("drag_s", [0.3, 2.0, np.inf])
def test_flight_solves_its_equation_of_motion(drag_s):
    velocity = np.array([[3.0, -1.0, 5.0]])
    pull = np.array([0.4, 0.0, -9.81])
    place, speed, steps = np.zeros(3), velocity[0].copy(), 20_000
    for _ in range(steps):
        middle = speed + 0.5 * (0.9 / steps) * (pull - speed / drag_s)
        place += 0.9 / steps * middle
        speed += 0.9 / steps * (pull - middle / drag_s)
    age = np.array([0.9])
    way, later = flight(age, velocity, drag_s, pull)
    np.testing.assert_allclose(way[0], place, atol=1e-4)
    np.testing.assert_allclose(later[0], speed, atol=1e-4)


def look_of(emitter, time_s):
    return np.concatenate([one["to_world"] if one.dtype.names else one for one in
                           (emitter.at(time_s).to_world, emitter.media(time_s))])  # fmt: skip


@for_every(EFFECTS)
def test_particles_that_begin_later_or_go_slower_are_the_same_by_their_own_clock(kind):
    for one, start_s in itertools.product(
        staged(Effect(kind, "box")).particles.effects, (0.3, 2.7)
    ):
        first, late, slow = (
            Emitter.of(replace(one.style, curl=0.0), one.source, one.setting,
                       np.random.default_rng(2), start_s=start, pace=pace)
            for start, pace in ((0.0, 1.0), (start_s, 1.0), (start_s, 0.4))
        )  # fmt: skip
        for after_s in (0.05, 0.2, 0.5):
            shown = (look_of(late, start_s + 0.4 * after_s), look_of(slow, start_s + after_s))
            np.testing.assert_allclose(*shown, atol=1e-9)
            ages = (each.lives.at(at + after_s)[0] for each, at in ((first, 0.0), (late, start_s)))
            assert not one.style.at_once or next(ages) == pytest.approx(next(ages))


@pytest.mark.parametrize("kind", EFFECTS)
def test_a_chip_that_lies_still_turns_no_more_and_is_another_one_in_its_next_life(kind):
    for emitter in staged(Effect(kind, "box")).particles.effects:
        first, later = (emitter.at(at).to_world for at in (0.9, 0.93))
        lies = np.abs(later - first)[:, :, 3].max(axis=1, initial=0.0) < 1e-9
        axes = [one[lies, :, :3] / np.linalg.norm(one[lies, :, :3], axis=1)[:, None]
                for one in (first, later)]  # fmt: skip
        np.testing.assert_allclose(*axes, atol=1e-6)
        lives = [emitter.lives.at(0.1 + n * emitter.lives.life_s) for n in range(GENERATIONS + 1)]
        drawn = np.array([draws[:, :3] for _, draws in lives])
        np.testing.assert_allclose(drawn[-1], drawn[0])
        assert (np.ptp(drawn[:-1], axis=0) > 0.3).all()
        assert all((np.diff(drawn[:-1], axis=0) != 0.0).ravel())


@pytest.mark.parametrize("pace", [0.5, 0.2])
def test_pieces_fly_at_the_pace_of_what_breaks(pace):
    slow, usual = (stage(thing("vase", ("break", None, one)), place="plain") for one in (pace, 1.0))
    for after_s in (0.05, 0.2, 0.5):
        found, expected = (
            [one.at(scene.actors[0].breaks_s + after).to_world for one in scene.particles.effects]
            for scene, after in ((slow, after_s), (usual, pace * after_s))
        )
        np.testing.assert_allclose(np.concatenate(found), np.concatenate(expected), atol=1e-9)


@pytest.mark.parametrize("noun", ["vase", "mug", "plate", "bottle", "glass", "cup", "window"])
def test_pieces_have_the_colours_of_all_that_is_no_detail(noun):
    scene = stage(thing(noun, ("break", None, 1.0)), place="plain")
    (broken,) = scene.actors
    parts = broken.model.parts(broken.pose(broken.breaks_s))
    bulks = [np.prod(np.linalg.svd(one.to_body[:, :3])[1]) for one in parts]
    bulky = {one.colour for one, bulk in zip(parts, bulks, strict=True) if bulk > 0.02 * max(bulks)}
    for pieces in scene.particles.effects:
        assert {tuple(one) for one in pieces.colours.tolist()} == bulky


def is_seen(emitter, time_s):
    clouds, pieces = emitter.media(time_s)["optical_depth"], emitter.at(time_s).to_world[:, :, :3]
    return bool(clouds.any() or np.abs(pieces).max(initial=0.0) > 20.0 * TINY_M)


@pytest.mark.parametrize("kind", EFFECTS)
def test_nothing_of_an_effect_is_there_before_it_begins(kind):
    for emitter in staged(Effect(kind, "box")).particles.effects:
        later = replace(emitter, start_s=0.4)
        assert not any(is_seen(later, time_s) for time_s in (0.0, 0.2, 0.39))
        assert any(is_seen(later, time_s) for time_s in (0.45, 0.7, 1.2))
