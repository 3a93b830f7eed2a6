"""Lamps: light, beams, shadows and glow."""

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.raycast.intersect_reference import hit_shape_reference

from texvent.sensor import SensorSize
from texvent_scenes.raycast.lamps.gleam import lamp_gleam
from texvent_scenes.raycast.lamps.light import (
    FINE,
    LONGITUDES,
    MOST_SHADOW_LAMPS,
    find_cells,
    lamp_light,
    lamps_reach,
    order_lamps,
)
from texvent_scenes.raycast.render import render_light, world_at
from texvent_scenes.rendered_scene import Environment, Ground, Shape

from ..hand_scenes import HandScene, MovingShape, day, lamp_row, look_at, still

SMALL = SensorSize(96, 72)


def dark(*lamps: np.ndarray, ground: Ground = Ground.PLAIN) -> Environment:
    black = np.zeros(3, dtype=np.float32)
    return replace(
        day(ground), sky_top=black, sky_horizon=black, sun_colour=black, ambient=black,
        lamps=np.concatenate(lamps) if lamps else day().lamps,
    )  # fmt: skip


def scene_of(environment: Environment, *shapes: MovingShape) -> HandScene:
    return HandScene(shapes, environment_base=environment)


@pytest.mark.parametrize("height", [0.5, 1.0, 3.0])
def test_light_falls_with_the_square_of_the_distance(height):
    world = world_at(scene_of(dark(lamp_row((0, 0, height), radius=0.2, reach=1e6))), 0.0, SMALL)
    light = lamp_light(world.instant[0], (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0)
    np.testing.assert_allclose(light, 2.0 / (height**2 + 0.2**2), rtol=1e-6)
    aside = lamp_light(world.instant[0], (height, 0.0, 0.0), (0.0, 0.0, 1.0), 0)
    np.testing.assert_allclose(aside, 2.0 / np.sqrt(2.0) / (2.0 * height**2 + 0.04), rtol=1e-6)


def test_a_beam_has_a_soft_edge_and_nothing_outside():
    beam = lamp_row((0, 0, 2), beam=(0, 0, -1), cosines=(np.cos(0.2), np.cos(0.4)), reach=1e6)
    world = world_at(scene_of(dark(beam)), 0.0, SMALL)
    angles = np.linspace(0.0, 0.6, 61)
    light = [lamp_light(world.instant[0], (2 * np.tan(a), 0, 0), (0, 0, 1), 0)[0] for a in angles]
    assert light[0] == pytest.approx(0.5, rel=1e-3)
    assert all(np.diff(light) <= 0.0)
    assert light[19] > 0.4
    assert light[41] == 0.0
    assert np.abs(np.diff(light)).max() < 0.06


def test_shadows_are_those_of_all_shapes_tested_one_by_one():
    rng = np.random.default_rng(3)
    shapes = tuple(
        MovingShape(
            Shape(k % 4),
            tuple(rng.uniform(0.1, 0.8, 3)) if k % 3 else (0.08, 0.08, 1.5),
            still(*rng.uniform(-4.0, 4.0, 2), rng.uniform(2.0, 3.0)),
        )
        for k in range(40)
    )
    places = np.array([(0.3, 0.2, 5.5), (-6.0, 2.0, 2.0), (3.0, -3.0, 0.4)])  # outside of all
    lamps = [lamp_row(tuple(place), casts=True) for place in places]
    scene = scene_of(dark(*lamps), *shapes)
    world = world_at(scene, 0.0, SMALL)
    kinds, inverses = scene.primitives(0.0).shape, world.shapes["inverse"]
    wrong = blocked = 0
    for point in np.append(rng.uniform(-5.0, 5.0, (150, 2)), np.zeros((150, 1)), axis=1):
        seen, _ = lamps_reach(world.instant[0], tuple(point), (0.0, 0.0, 1.0), 0b111, True)
        depths = np.min(
            [
                hit_shape_reference(
                    Shape(kind),
                    np.tile(inverse[:, :3] @ point + inverse[:, 3], (3, 1)),
                    (places - point) @ inverse[:, :3].T,
                )
                for kind, inverse in zip(kinds, inverses, strict=True)
            ],
            axis=0,
        )
        blocked += int((depths < 1.0).sum())
        wrong += sum((depths < 1.0) == [bool(seen >> number & 1) for number in range(3)])
    assert blocked > 60
    assert wrong <= 2  # a ray that grazes a shape


def test_a_box_covers_as_many_cells_wherever_around_the_lamp_it_is():
    rng = np.random.default_rng(8)
    axes, middles = rng.normal(0.0, 0.3, (200, 3, 3)), rng.normal(0.0, 3.0, (200, 3, 1))
    boxes = np.concatenate([axes, middles], axis=2)
    turn = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    cells = np.empty((2, 200, 4), np.int64)
    near = [find_cells(one, found) for one, found in zip((boxes, turn @ boxes), cells, strict=True)]
    assert near[0] == pytest.approx(near[1])
    assert (cells[0, :, 2:] == cells[1, :, 2:]).all()
    sides = cells[:, :, 1] - cells[:, :, 0]
    assert (sides[0] == sides[1]).all()
    columns = FINE * LONGITUDES
    further = (cells[1] - cells[0])[sides[0] < columns - 1, 0]
    assert (further % columns == columns // 4).all()


def test_no_more_lamps_cast_shadows_than_there_are_bits():
    lamps = np.concatenate([lamp_row((k, 0.0, 1.0), casts=k % 2 == 1) for k in range(12)])
    rows, count = order_lamps(lamps, shadows=True)
    assert count == MOST_SHADOW_LAMPS
    assert len(rows) == 12
    assert (rows["casts"][:count] > 0.0).all()
    assert order_lamps(lamps, shadows=False)[1] == 0


SKY = 0.1


def glow_energy(place: tuple[float, float, float], intensity: float, radius: float) -> float:
    """Light of a lamp before a grey sky, summed over the image, before it fills up to white."""
    lamp = lamp_row(place, (intensity,) * 3, radius=radius, glows=True)
    grey = np.full(3, SKY, dtype=np.float32)
    sky = replace(dark(lamp, ground=Ground.NONE), sky_top=grey, sky_horizon=grey)
    camera = look_at((0.0, -2.0, 1.0), (0.0, 0.0, 1.0))
    image = render_light(replace(scene_of(sky), camera_at=lambda time: camera), 0.0, SMALL)
    return float(-np.log((1.0 - image[..., 0]) / (1.0 - np.float64(grey[0]))).sum())


@pytest.mark.parametrize("x", [0.0, 0.003, 0.01, 0.017])
@pytest.mark.parametrize("radius", [0.0001, 0.002, 0.02])
def test_the_light_of_a_lamp_in_the_image_does_not_depend_on_its_size_and_place(x, radius):
    expected = np.pi * 1e-4 * (96.0 / 2.0) ** 2
    assert glow_energy((x, 0.0, 1.0), 1e-4, radius) == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("x", [0.0, 0.4, -0.9])
@pytest.mark.parametrize("fog_m", [2.0, 0.5])
def test_fog_takes_from_a_glow_what_it_takes_along_the_way(x, fog_m):
    lamp = lamp_row((x, 0.0, 1.0), (1e-3,) * 3, glows=True)
    camera, light = look_at((0.0, -2.0, 1.0), (0.0, 0.0, 1.0)), []
    for distance_m in (np.inf, fog_m):
        scene = scene_of(replace(dark(lamp, ground=Ground.NONE), fog_distance=distance_m))
        glows = world_at(replace(scene, camera_at=lambda time: camera), 0.0, SMALL).glows
        light.append(float(glows["core_light"].sum()))
    assert light[1] / light[0] == pytest.approx(np.exp(-np.hypot(2.0, x) / fog_m))


def test_what_stands_before_a_lamp_hides_its_glow_bit_by_bit():
    lamp = lamp_row((0.0, 0.0, 1.0), (1e-3,) * 3, radius=0.05, glows=True)

    def energy(edge: float) -> float:
        wall = MovingShape(Shape.BOX, (1.0, 0.05, 1.0), still(edge - 1.0, -1.0, 1.0))
        glows = world_at(scene_of(dark(lamp, ground=Ground.NONE), wall), 0.0, SMALL).glows
        return float(glows["core_light"].sum())

    shown = np.array([energy(edge) for edge in np.linspace(-0.1, 0.1, 9)])
    assert shown[0] > 0.0
    assert shown[-1] == 0.0
    assert 0.3 * shown[0] < shown[4] < 0.7 * shown[0]
    assert (np.diff(shown) <= 1e-9).all()


def gleam_reference(lamp, point, view, normal, film):
    """One lamp on a microfacet film: D by Trowbridge and Reitz, G by Schlick, F by Schlick."""
    base, rough, pixel = film
    towards = lamp["place"] - point
    distance = np.linalg.norm(towards)
    to_lamp, to_eye = towards / distance, -view
    half = (to_lamp + to_eye) / np.linalg.norm(to_lamp + to_eye)
    alpha = rough + pixel + 0.5 * lamp["radius"] / distance
    slopes = alpha**2 / (np.pi * ((normal @ half) ** 2 * (alpha**2 - 1.0) + 1.0) ** 2)
    cosines = np.array([normal @ to_lamp, normal @ to_eye])
    seen = cosines / (cosines * (1.0 - alpha / 2) + alpha / 2)
    mirrored = base + (1.0 - base) * (1.0 - half @ to_eye) ** 5
    brdf = slopes * np.prod(seen) * mirrored / (4.0 * np.prod(cosines))
    fall = (1.0 - (distance / lamp["reach"]) ** 2) ** 2 / (distance**2 + lamp["radius"] ** 2)
    return np.pi * brdf * fall * (normal @ to_lamp) * lamp["light"]


def test_the_gleam_is_the_sum_over_the_lamps_that_the_point_sees():
    rng = np.random.default_rng(4)
    for casts in (0, 1, 3):
        lamps = [lamp_row(tuple(rng.uniform((-4, -4, 1), (4, 4, 5))), tuple(rng.uniform(1, 3, 3)),
                          reach=30.0, radius=0.1, casts=n < casts) for n in range(4)]  # fmt: skip
        instant = world_at(scene_of(dark(*lamps)), 0.0, SMALL).instant[0]
        ordered, count = order_lamps(np.concatenate(lamps), shadows=True)
        assert count == casts
        for lit in range(0, 2 << casts):
            point = rng.uniform((-2, -2, 0), (2, 2, 0))
            view = rng.uniform((-1, 1, -1), (1, 2, -0.2))
            view /= np.linalg.norm(view)
            normal, film = np.array([0.0, 0.0, 1.0]), (0.02, rng.uniform(0.05, 0.4), 0.01)
            seen = [n >= casts or bool(lit >> (n + 1) & 1) for n in range(4)]
            expected = sum(
                gleam_reference(one, point, view, normal, film)
                for one, is_seen in zip(ordered, seen, strict=True)
                if is_seen
            )
            found = lamp_gleam(instant, tuple(point), tuple(view), tuple(normal), film, lit)
            np.testing.assert_allclose(found, expected + np.zeros(3), rtol=1e-5)
