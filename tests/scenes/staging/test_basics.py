"""Short prompts of event vision: where their bodies are over time."""

import math
from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.staged import SIZE, middle, place, stage, thing

from texvent.camera import project
from texvent_scenes.colours import rgb_of
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.raycast.ground_truth import ground_truth
from texvent_scenes.raycast.render import render_light
from texvent_scenes.rendered_scene import Texture
from texvent_scenes.scene_input import understand
from texvent_scenes.spec.scene import Place, Relation, Scene, SceneObject


def act(kind, target, *others, **fields):
    return stage(
        *others, thing(target, **fields), relations=((kind, 0, 1), ("towards", 0, 2))
    ).actors


@pytest.mark.parametrize(("noun", "target"), [("cat", "fence"), ("dog", "table"), ("boy", "box")])
def test_what_jumps_onto_something_leaps_from_the_ground_and_ends_on_it(noun, target):
    noun = {"boy": "child"}.get(noun, noun)
    one, other = stage(
        thing(noun, ("jump",), ("stand",)), thing(target), relations=(("on", 0, 1),)
    ).actors
    feet = [one.track.at(time_s).position[2] for time_s in np.linspace(0.0, 2.0, 401)]
    top = feet[-1]
    assert feet[0] == pytest.approx(0.0, abs=1e-6)
    assert 0.2 < top <= other.model.height + 0.05
    assert max(feet) > top + 0.1
    flown = np.flatnonzero(np.diff(feet) != 0.0)
    rises = np.diff(feet, 2)[flown[1] : flown[-1] - 1] / 0.005**2
    assert np.median(rises) == pytest.approx(-9.81, rel=0.01)  # free flight
    away = middle(one, 2.0) - middle(other, 2.0)
    assert np.abs(away[:2]).max() <= 0.5 * max(other.model.length, other.model.width)


@pytest.mark.parametrize("kind", ["kick", "throw"])
@pytest.mark.parametrize("wall", ["wall", "striped wall", "house"])
@pytest.mark.parametrize("stated", [{}, {"position_m": (5.0, 6.0)}])
def test_what_is_sent_against_a_wall_comes_back_from_its_face(kind, wall, stated):
    child = thing("child", **({"position_m": (0.0, 0.0)} if stated else {}))
    who, ball, wall = act(kind, wall, child, thing("ball"), **stated)
    way = np.array([math.cos(ball.track.yaw), math.sin(ball.track.yaw)])
    places = np.array([ball.track.at(t).position[:2] for t in np.linspace(0.0, 2.0, 801)]) @ way
    far = int(np.argmax(places))
    assert 0 < far < 800
    assert places[-1] < places[far] - 0.5
    face = float(min(wall.corners(0.0)[:, :2] @ way))
    assert places[far] + 0.5 * ball.model.length == pytest.approx(face, abs=0.3)
    assert float(who.middle(0.0)[:2] @ way) < face
    aside = (wall.corners(0.0)[:, :2] - ball.track.start[:2]) @ [-way[1], way[0]]
    assert aside.min() < 0.0 < aside.max()  # it meets it


@pytest.mark.parametrize("heading", [0.0, 180.0, 200.0])
def test_a_wall_keeps_the_heading_that_is_said(heading):
    *_, wall = act("kick", "wall", thing("child"), thing("ball"), heading_deg=heading)
    turn = math.degrees(wall.track.at(0.0).yaw) - heading
    assert (turn + 180.0) % 360.0 == pytest.approx(180.0, abs=1e-6)


def test_what_is_held_all_along_does_not_come_back():
    scene = stage(thing("man"), thing("ball"), thing("wall"),
                  relations=(("kick", 0, 1), ("hold", 0, 1), ("towards", 0, 2)))  # fmt: skip
    assert all(np.isfinite(one.corners(1.9)).all() for one in scene.actors)


def complete_of(*objects, place):
    return complete(to_description(Scene("x", objects=objects, place=Place(place))), NOUNS)


@pytest.mark.parametrize(
    ("noun", "support"), [("mug", "table"), ("laptop", "desk"), ("pot", "oven")]
)
def test_small_things_stand_on_their_usual_support(noun, support):
    with_support = complete_of(SceneObject(noun), SceneObject(support), place="indoor")
    assert [(one.kind, one.subject, one.targets) for one in with_support.relations] == [
        ("on", 0, (1,))
    ]
    held = SceneObject(noun, relations=(Relation("under", (support,)),))
    assert len(complete_of(held, SceneObject(support), place="indoor").relations) == 1
    alone = understand(f"a {noun}", NOUNS)
    assert f"nothing carries the {noun}: it stands on the floor" in alone.notes


@pytest.mark.parametrize(
    ("noun", "count", "support"),
    [("candle", 3, "cake"), ("cube", 3, "rug"), ("bottle", 9, "stool")],
)
def test_several_things_fit_on_what_they_are_put_on(noun, count, support):
    scene = stage(thing(noun, count=count), thing(support), relations=(("on", 0, 1),))
    *own, other = scene.actors
    low, high = other.corners(0.0).min(axis=0)[:2], other.corners(0.0).max(axis=0)[:2]
    for one in own:
        assert (one.corners(0.0).min(axis=0)[:2] > low - 0.25 * one.size_m).all()
        assert (one.corners(0.0).max(axis=0)[:2] < high + 0.25 * one.size_m).all()
    assert any(f"the {noun} is drawn at" in note for note in scene.notes)


@pytest.mark.parametrize(
    ("noun", "support"),
    [("cup", "table"), ("book", "chair"), ("cat", "box"), ("ball", "bench"), ("bird", "fence")],
)
@pytest.mark.parametrize(("count", "several"), [(2, 2), (4, 2), (5, 2), (3, 3), (7, 3)])
def test_several_things_bear_as_many_each(noun, support, count, several):
    put, on = thing(noun, count=count), thing(support, count=several)
    scene = stage(put, on, relations=(("on", 0, 1),))
    own, others = scene.actors[:count], scene.actors[count : count + several]
    middles = [other.corners(0.0)[:, :2].mean(axis=0) for other in others]
    nearest = [
        int(np.argmin([np.linalg.norm(one.middle(0.0)[:2] - each) for each in middles]))
        for one in own
    ]
    borne = np.bincount(nearest, minlength=several)
    assert np.ptp(borne) <= 1
    assert all(one.lowest_m(0.0) > 0.1 for one in own)
    places = np.array([one.middle(0.0) for one in own])
    assert len(np.unique(places.round(3), axis=0)) == count


@pytest.mark.parametrize(("noun", "motion"), [("ball", "roll"), ("car", "drive"), ("box", "slide")])
def test_what_goes_down_a_ramp_gains_the_speed_of_its_height(noun, motion):
    one, _ = stage(thing(noun, (motion,)), thing("ramp"), relations=(("on", 0, 1),)).actors
    heights = [one.track.at(time_s).position[2] for time_s in np.linspace(0.0, 2.0, 201)]
    assert heights[0] == pytest.approx(0.55)
    assert heights[-1] == pytest.approx(0.0, abs=1e-6)
    share = 5.0 / 7.0 if motion == "roll" else 1.0
    fastest = max(one.track.at(time_s).speed_m_s for time_s in np.linspace(0.0, 2.0, 201))
    assert fastest == pytest.approx(math.sqrt(2.0 * 9.81 * share * 0.55), rel=0.02)


@pytest.mark.parametrize("material", [None, "metal"])
@pytest.mark.parametrize(("noun", "count"), [("marble", 1), ("marble", 5), ("ball", 1)])
def test_a_slope_fits_what_rolls_down_on_it_side_by_side_and_is_seen_whole(noun, count, material):
    goers = replace(thing(noun, ("roll",)), count=count)
    scene = stage(goers, replace(thing("ramp"), material=material), relations=(("on", 0, 1),))
    *rolling, ramp = scene.actors
    assert ramp.model.length <= 50.0 * rolling[0].size_m
    low, high = (ramp.corners(0.0).min(axis=0), ramp.corners(0.0).max(axis=0))
    for one in rolling:
        lowest = one.corners(0.1)[:, 2].min()
        assert low[1] < one.middle(0.1)[1] < high[1]
        assert abs(lowest - high[2]) < 0.7 * one.size_m  # at its top, on it
    x, y, depth = project(scene.camera(0.1), SIZE, ramp.corners(0.1)).T
    assert ((x > 0) & (x < SIZE.width) & (y > 0) & (y < SIZE.height) & (depth > 0)).all()


@pytest.mark.parametrize(("way", "sign"), [("towards", 1.0), ("away", -1.0)])
@pytest.mark.parametrize("noun", ["checkerboard", "circle grid", "april tag"])
def test_a_board_tilts_its_top_to_the_side_that_is_said(noun, way, sign):
    scene = stage(thing(noun, ("tilt", way)), thing("wall"), relations=(("front", 0, 1),))
    one = scene.actors[0]
    camera = scene.camera(0.0)
    top = np.array([0.0, 0.0, one.model.height, 1.0])
    depths = [float(camera.rotation[2] @ (one.track.at(time_s).to_world() @ top - camera.position))
              for time_s in (0.0, 1.0, 2.0)]  # fmt: skip
    assert sign * (depths[0] - depths[1]) > 0.05 * one.model.height
    assert sign * (depths[1] - depths[2]) > 0.0


@pytest.mark.parametrize("noun", ["girl", "man", "child"])
def test_who_is_on_a_swing_goes_with_its_seat(noun):
    one, swing = stage(thing(noun, ("sit",)), thing("swing", ("work",)),
                       relations=(("on", 0, 1),)).actors  # fmt: skip
    gaps = []
    for time_s in np.linspace(0.0, 2.0, 9):
        seat = swing.track.at(time_s).to_world() @ np.append(
            swing.own_parts(swing.pose(time_s))[-1].to_body[:, 3], 1.0
        )
        gaps.append(np.linalg.norm(one.track.at(time_s).to_world()[:, 3] - seat))
    ways = [one.track.at(time_s).position[0] for time_s in np.linspace(0.0, 2.0, 9)]
    assert np.ptp(gaps) < 1e-6
    assert np.ptp(ways) > 0.3


@pytest.mark.parametrize(
    ("noun", "target"),
    [("man", "fence"), ("horse", "bench"), ("dog", "box"), ("skateboarder", "box")],
)
def test_what_jumps_over_something_clears_it_and_lands_behind_it(noun, target):
    one, other = stage(thing(noun, ("jump",)), thing(target), relations=(("above", 0, 1),)).actors
    over = 0
    for time_s in np.linspace(0.0, 2.0, 41):
        apart = np.abs(one.track.at(time_s).position[:2] - other.middle(time_s)[:2])
        is_above = (apart < 0.25 * other.model.length + 0.05).all()
        over += is_above
        assert not is_above or one.track.at(time_s).position[2] > 0.9 * other.model.height
    assert over
    before, after = (middle(one, time_s)[1] for time_s in (0.0, 2.0))
    assert before < other.middle(0.0)[1] < after
    assert one.track.at(2.0).position[2] == pytest.approx(one.track.at(0.0).position[2], abs=1e-6)


@pytest.mark.parametrize(
    "noun", sorted(nouns_with("faces the camera") | nouns_with("flat pattern"))
)
def test_a_board_without_a_heading_faces_the_camera(noun):
    (body,) = place(thing(noun))
    front = body.track.at(0.0).to_world()[:, 0]
    np.testing.assert_allclose(front / np.linalg.norm(front), [0.0, -1.0, 0.0], atol=1e-9)
    turned = place(thing(noun, heading_deg=20.0))[0].track.at(0.0).to_world()[:, 0]
    assert noun in nouns_with("flat pattern") or turned[0] > 0.9


class Even:
    """A scene whose first body has one colour and no texture."""

    def __init__(self, scene, colour):
        self._scene, self._colour = scene, colour

    def __getattr__(self, name):
        return getattr(self._scene, name)

    def primitives(self, time_s):
        shapes = self._scene.primitives(time_s)
        own = shapes.instance == 1
        return replace(
            shapes,
            texture=np.where(own, Texture.PLAIN, shapes.texture),
            colour=np.where(own[:, None], np.float32(self._colour), shapes.colour),
        )


@pytest.mark.parametrize("colour", ["white", "orange", "blue", "#404040"])
@pytest.mark.parametrize("noun", ["ball", "sphere", "cube", "cylinder", "cone"])
def test_a_stated_colour_is_that_of_most_of_a_body(noun, colour):
    """Its own pixels are as light as those of a body of that colour without a pattern."""
    scene = stage(thing(noun, colour=colour), place="plain")
    own = ground_truth(scene, 0.0, 0.01, SIZE).instance == 1
    light, even = (render_light(one, 0.0, SIZE)[own].mean(axis=1)
                   for one in (scene, Even(scene, rgb_of(colour))))  # fmt: skip
    assert np.mean(np.abs(light / even - 1.0) < 0.25) > 0.75
