"""Lines on the ground fit what stands there; halls, even grounds and flakes look their part."""

import itertools
import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.scenes.every_row import for_every
from tests.scenes.staged import DURATION_S, SIZE, thing

from texvent_scenes.checks.views.surfaces import _MATERIALS
from texvent_scenes.defaults import complete
from texvent_scenes.description import SceneDescription, to_description
from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.models.materials import MATERIALS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.raycast.render import render
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.spec.scene import Camera, Effect, Light, Motion, Place, Scene
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene, compose_scene

TIMES_S = np.linspace(0.0, DURATION_S, 9)
VEHICLES = ("car", "van", "bus", "truck", "motorcycle", "taxi")
LOTS = [name for name, one in PLACES.items() if any(s.noun == "parking lines" for s in one.scenery)]


def compose(*objects, place, camera=None, light=None, seed=0) -> ComposedScene:
    scene = Scene(objects=objects, camera=camera or Camera(), light=light or Light(), place=place)
    said = complete(to_description(scene), NOUNS)
    return compose_scene(said, seed=seed, size=SIZE, duration_s=DURATION_S)


def rectangles(scene: ComposedScene, noun: str) -> list[np.ndarray]:
    """[4, 2] corners of each line of a noun of the scenery."""
    unit = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    found = []
    for item in scene.scenery:
        if item.rule.noun != noun:
            continue
        placed = item.place()
        for part in placed.parts:
            points = unit @ part.to_body[:, :3].T + part.to_body[:, 3]
            found.append((points @ placed.to_world[:, :3].T + placed.to_world[:, 3])[:, :2])
    return found


def meet(one: np.ndarray, other: np.ndarray) -> bool:
    """Whether two convex polygons, [n, 2], overlap: no side of either parts them."""
    for polygon in (one, other):
        edges = np.roll(polygon, -1, axis=0) - polygon
        for x, y in edges:
            normal = np.array([-y, x])
            a, b = one @ normal, other @ normal
            if a.max() <= b.min() or b.max() <= a.min():
                return False
    return True


def foot(one: Actor, time_s: float) -> np.ndarray:
    """[4, 2] corners of the ground on which a body stands."""
    state, body = one.track.at(time_s), one.model
    half = 0.5 * np.array([body.length, body.width]) - 0.03
    corners = np.array([[1, 1], [1, -1], [-1, -1], [-1, 1]]) * half
    c, s = math.cos(state.yaw), math.sin(state.yaw)
    return corners @ [[c, s], [-s, c]] + one.middle(time_s)[:2]


@given(
    noun=st.sampled_from(VEHICLES), heading=st.integers(0, 359),
    x=st.floats(-30.0, 30.0), y=st.floats(-30.0, 30.0),
    way=st.sampled_from((None, "forward", "backward")),
)  # fmt: skip
def test_a_vehicle_that_stands_or_leaves_touches_no_line_of_its_bay(noun, heading, x, y, way):
    moves = (Motion("stand"),)
    moves += () if way is None else (Motion("drive", way, speed_m_s=3.0, start_s=0.5),)
    said = replace(thing(noun), motions=moves, position_m=(x, y), heading_deg=float(heading))
    scene = compose(said, place=Place("parking lot"))
    lines = rectangles(scene, "parking lines")
    assert lines
    for time_s in TIMES_S:
        assert not any(meet(foot(scene.actors[0], time_s), line) for line in lines)


@given(
    first=st.sampled_from(VEHICLES), second=st.sampled_from(VEHICLES),
    gap=st.floats(0.5, 9.0), along=st.floats(-8.0, 8.0), turn=st.sampled_from((0, 180, 90, 30)),
)  # fmt: skip
@example("van", "motorcycle", 1.0, 3.03125, 90)
def test_where_no_row_of_bays_fits_all_vehicles_a_line_says_so(first, second, gap, along, turn):
    aside = gap + 0.5 * sum(
        NOUNS[one].build(colour=None, scale=1.0, seed=0).width for one in (first, second)
    )
    objects = (
        replace(thing(first, ("stand",)), position_m=(0.0, 0.0), heading_deg=90.0),
        replace(thing(second, ("stand",)), position_m=(aside, along), heading_deg=90.0 + turn),
    )
    scene = compose(*objects, place=Place("parking lot"))
    lines = rectangles(scene, "parking lines")
    is_met = any(meet(foot(one, 0.0), line) for one in scene.actors for line in lines)
    assert not is_met or any("across the lines" in one for one in scene.notes)


@for_every([(lot, seed) for lot in LOTS for seed in range(4)])
def test_parked_cars_of_a_place_stand_in_its_bays(row):
    lot, seed = row
    scene = compose(thing("man", ("walk", "left")), place=Place(lot), seed=seed)
    lines = rectangles(scene, "parking lines")
    for item in (one for one in scene.scenery if one.rule.where == "bays"):
        low, high = bounds(item.place().parts)
        half = 0.5 * (np.asarray(high) - np.asarray(low))[:2] - 0.05
        c, s = math.cos(item.yaw), math.sin(item.yaw)
        corners = np.array([[1, 1], [1, -1], [-1, -1], [-1, 1]]) * half @ [[c, s], [-s, c]]
        assert not any(meet(corners + item.position, line) for line in lines)


@given(y=st.floats(6.0, 30.0), turn=st.integers(0, 359), aside=st.floats(6.0, 12.0))
def test_every_train_is_on_rails(y, turn, aside):
    angle = math.radians(turn)
    places = [(0.0, y), (-aside * math.sin(angle), y + aside * math.cos(angle))]
    trains = [
        replace(thing("train", ("drive",)), position_m=one, heading_deg=float(turn))
        for one in places
    ]
    scene = compose(*trains, place=Place("railway"))
    tracks = [one for one in scene.scenery if one.rule.noun == "railway track"]
    for one in scene.actors:
        x, y, _ = one.middle(0.0)
        gaps = [abs((x - t.position[0]) * math.sin(t.yaw) - (y - t.position[1]) * math.cos(t.yaw))
                for t in tracks]  # fmt: skip
        assert min(gaps) < 0.35


@given(y=st.floats(-5.0, 5.0), heading=st.sampled_from((0, 90, 180)))
def test_a_runner_has_a_lane(y, heading):
    said = replace(thing("runner"), motions=(Motion("run", speed_m_s=4.0),), position_m=(y, y),
                   heading_deg=float(heading))  # fmt: skip
    scene = compose(said, place=Place("running track"))
    lines = [one for one in rectangles(scene, "running lanes") if np.ptp(one, axis=0).min() < 1.0]
    spot = scene.actors[0].middle(0.0)[:2]
    square = spot + 0.35 * np.array([[1, 1], [1, -1], [-1, -1], [-1, 1]])
    assert lines
    assert not any(meet(square, line) for line in lines)


@given(
    x=st.floats(-20.0, 20.0), y=st.floats(-20.0, 20.0), heading=st.integers(0, 359),
    row=st.sampled_from([("goal", "stadium", "pitch lines"),
                         ("basketball hoop", "basketball court", "basketball court lines")]),
)  # fmt: skip
def test_a_goal_stands_on_the_line_behind_which_a_ball_is_in(x, y, heading, row):
    noun, place, marks = row
    goal = replace(thing(noun, ("stand",)), position_m=(x, y), heading_deg=float(heading))
    scene = compose(goal, place=Place(place))
    (lines,) = (one for one in scene.scenery if one.rule.noun == marks)
    spot = scene.actors[0].middle(0.0)[:2]
    ends = [line.mean(axis=0) for line in rectangles(scene, marks)]
    assert min(float(np.hypot(*(one - spot))) for one in ends) < 0.05
    towards = np.array(lines.position) - spot
    assert towards @ [math.cos(math.radians(heading)), math.sin(math.radians(heading))] > 0.0


@pytest.mark.parametrize("colour", [None, "white", "red"])
@pytest.mark.parametrize("light", [None, "overcast", "dusk"])
def test_the_plain_ground_is_even(colour, light):
    camera = Camera(position_m=(0.0, -3.0, 1.5), look_at_m=(0.0, 0.0, 0.0))
    ball = replace(thing("ball", ("stand",)), position_m=(0.0, 40.0))
    scene = compose(ball, place=Place("plain", colour=colour), camera=camera, light=Light(light))
    picture = render(scene, 0.0, SIZE, samples=1, shadows=False)[SIZE.height // 2 :]
    level = np.log(np.asarray(picture, dtype=np.float64).max(axis=-1) + 1.0)
    grain = level[1:-1, 1:-1] - 0.25 * (
        level[2:, 1:-1] + level[:-2, 1:-1] + level[1:-1, 2:] + level[1:-1, :-2]
    )
    assert np.percentile(np.abs(grain), 99.0) < 0.03
    assert np.ptp(np.percentile(level, [5.0, 95.0])) < 0.35


@for_every(
    [
        kind
        for kind, one in EFFECTS.items()
        if any(math.isfinite(e.widest_rad) for e in one.emitters)
    ]
)
def test_flakes_that_stand_for_smaller_ones_are_small_before_the_lens(kind):
    said = (
        Place("grass", weather=kind, is_empty=True)
        if kind == "snow"
        else Place("grass", is_empty=True)
    )
    effects = () if kind == "snow" else (kind,)
    description = SceneDescription(effects=tuple(map(Effect, effects)), place=said)
    scene = compose_scene(description, seed=1, size=SIZE, duration_s=DURATION_S)
    (emitter,) = scene.particles.effects
    for time_s in TIMES_S:
        shapes = emitter.at(time_s)
        half = np.linalg.norm(shapes.to_world[:, :, :3], axis=1).max(axis=1)
        away = np.linalg.norm(shapes.to_world[:, :, 3] - scene.camera(time_s).position, axis=1)
        assert (half <= emitter.style.widest_rad * away + 1e-4).all()
        assert np.allclose(shapes.emission, emitter.style.emission[0])


HALLS = [name for name, one in PLACES.items() if one.hall_m]


@for_every(HALLS)
def test_a_hall_is_high_and_large_whatever_is_in_it(name):
    scene = compose(thing("cat", ("walk", "left")), place=Place(name))
    seen = scene.environment(0.0)
    assert seen.ground is Ground.FLOOR
    assert seen.is_hall
    assert seen.room_half_size >= PLACES[name].hall_m
    assert seen.ceiling_m >= 4.0


KIN = {"marble": "stone", "brass": "metal", "striped": "stripes", "checkered": "checks"}
"""Material → name of its texture, where that is another."""


def test_a_texture_that_captions_name_is_of_that_material():
    for name, one in MATERIALS.items():
        if one.texture in _MATERIALS:
            assert one.texture.name.lower() == KIN.get(name, name)
    for noun, material in itertools.product(("box", "open box"), ("cloth", "leather")):
        parts = NOUNS[noun].build(colour=(0.1, 0.1, 0.5), scale=1.0, seed=0).parts
        drawn = {one.texture.name.lower() for one in parts(Pose(0.0, 0.0, 0.0, "stand"))}
        assert material not in drawn
