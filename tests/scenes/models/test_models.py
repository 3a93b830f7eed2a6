"""Every noun's model: honest size, steady parts, wheels and feet that do not slip."""

import itertools
import math
import operator
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from tests.scenes.every_row import for_every

from texvent.sensor import SensorSize
from texvent_scenes.colours import COLOURS, SHADES, SURFACES, find_colour
from texvent_scenes.models.nouns import AFLOAT, FAMILIES, NOUNS
from texvent_scenes.models.protocol import Model, ModelPart, Noun, Pose
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator
from texvent_scenes.rendered_scene import Shape
from texvent_scenes.spec.scene import Motion, Place, Scene, SceneObject

from ..golden.rows import usual_model

ALL = list(NOUNS.values())
POSES = [
    Pose(time_s, distance_m, speed, activity)
    for time_s, distance_m, speed, activity in (
        (0.0, 0.0, 0.0, "stand"), (0.31, 0.17, 1.3, "move"), (1.77, 3.9, 2.0, "move"),
        (2.9, 11.3, 4.0, "run"), (0.5, 1.0, 0.0, "sit"), (6.2, 40.1, 1.0, "move"))
]  # fmt: skip


MOUNDS = {"dune mound"}
"""Scenery whose lower half is in the ground."""
HUNG = {*nouns_with("hangs from a ceiling"), "wall shelf"}
"""What hangs from above or on a wall."""
LINES = {
    *("runway markings", "basketball court lines", "pitch lines"),
    *("tennis court lines", "parking lines"),
}
"""White paint on the ground."""
PIECES = LINES | {
    *("crosswalk", "firework", "expanding ring", "saturn"),
    *("ski", "boot", "shoe", "violin", "drum kit", "toy train"),
    *("campfire", "vegetables", "candy", "leaf pile", "seaweed", "grass tuft"),
}
"""What consists of several pieces: lines, light, rings; pairs and sets; piles and stems."""
TOUCHING = 0.03
"""Greatest gap between parts of a body, as a share of its size."""
INSECTS = {"bee", "housefly", "dragonfly", "butterfly"}
HOPPERS = {"frog"}
"""What leaves the ground at each stride."""


VIOLET = (0.31, 0.02, 0.47)


@cache
def violet_model(noun: Noun) -> Model:
    return noun.build(colour=VIOLET, scale=0.3, seed=7)


for_every_noun = for_every(ALL)


@cache
def unit_points(shape: Shape) -> np.ndarray:
    """Points all over a unit shape: [n, 3]."""
    u = np.linspace(0.0, 2.0 * math.pi, 24, endpoint=False)
    if shape is Shape.BOX:
        return np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    if shape is Shape.ELLIPSOID:
        v = np.linspace(0.0, math.pi, 13)
        return np.array([[math.sin(b) * math.cos(a), math.sin(b) * math.sin(a), math.cos(b)]
                         for a in u for b in v])  # fmt: skip
    ends = (-1.0, 1.0) if shape is Shape.CYLINDER else (-1.0,)
    return np.array([[math.cos(a), math.sin(a), z] for a in u for z in ends] + [[0, 0, 1.0]])


def surface_points(part: ModelPart) -> np.ndarray:
    """Points all over a part, in body coordinates: [n, 3]."""
    return unit_points(part.shape) @ part.to_body[:, :3].T + part.to_body[:, 3]


def all_points(model: Model, *poses: Pose) -> np.ndarray:
    """Points all over it at some poses; a part that is the same at all of them counts once."""
    parts = {id(part): part for pose in poses for part in model.parts(pose)}
    return np.concatenate([surface_points(part) for part in parts.values()])


def test_every_word_means_one_noun_and_is_lower_case():
    owner: dict[str, str] = {}
    for key, noun in NOUNS.items():
        assert key == noun.name
        for word in {noun.name, *noun.synonyms, *noun.plurals}:
            assert word == word.lower().strip()
            assert owner.setdefault(word, noun.name) == noun.name, word


@pytest.mark.long
@for_every_noun
def test_parts_keep_their_number_order_and_handedness(noun):
    for model, poses in ((usual_model(noun), POSES), (violet_model(noun), POSES[::3])):
        posed = [model.parts(pose) for pose in poses]
        shapes = [[part.shape for part in parts] for parts in posed]
        assert all(row == shapes[0] for row in shapes)
        assert 1 <= len(shapes[0]) <= 60
        parts = [part for each in posed for part in each]
        maps = np.array([part.to_body for part in parts])
        assert maps.shape == (len(parts), 3, 4)
        assert np.isfinite(maps).all()
        # Not mirrored and not flattened to nothing.
        volume = np.linalg.norm(maps[:, :, :3], axis=1).prod(axis=1)
        assert (np.linalg.det(maps[:, :, :3]) > 1e-3 * volume).all()
        assert (volume > 0.0).all()
        paints = np.array([(*part.colour, *part.second_colour) for part in parts])
        assert 0.0 <= paints.min() <= paints.max() <= 1.0
        assert min(part.emission for part in parts) >= 0.0


@for_every_noun
def test_size_holds_all_parts_and_is_not_loose(noun):
    model = usual_model(noun)
    points = all_points(model, *(pose for pose in POSES if pose.activity != "sit"))
    reach = np.abs(points).max(axis=0)
    size = np.array([model.length, model.width, model.height])
    assert (reach[:2] <= 0.55 * size[:2]).all()
    assert (reach[:2] >= 0.30 * size[:2]).all()
    if noun.habitat in ("ground", "fixed") or noun.name in AFLOAT:
        assert 0.85 * model.height <= points[:, 2].max() <= 1.1 * model.height
    else:
        assert 0.30 * model.height <= reach[2] <= 0.55 * model.height


def nearest_points(part: ModelPart, points: np.ndarray) -> np.ndarray:
    """Points of a part near others, [n, 3]: those nearest where it is a ball or a cube."""
    turn, middle = part.to_body[:, :3], part.to_body[:, 3]
    unit = (points - middle) @ np.linalg.inv(turn).T
    radius = np.linalg.norm(unit[:, :2], axis=1, keepdims=True)
    flat = np.clip(unit, -1.0, 1.0)
    if part.shape is Shape.ELLIPSOID:
        flat = unit / np.maximum(np.linalg.norm(unit, axis=1, keepdims=True), 1.0)
    elif part.shape is not Shape.BOX:
        ends = 0.5 * (1.0 - flat[:, 2:]) if part.shape is Shape.CONE else 1.0
        flat[:, :2] = unit[:, :2] * np.minimum(1.0, ends / np.maximum(radius, 1e-12))
    return flat @ turn.T + middle


def are_near(one: ModelPart, other: ModelPart, gap: float) -> bool:
    """Whether two parts are no further apart: from points of each, then to and fro."""
    for step, (first, second) in itertools.product((5, 1), ((one, other), (other, one))):
        middle, edge = first.to_body[:, 3], surface_points(first)[::step]
        points = np.concatenate([[middle], edge, 0.5 * (middle + edge)])
        across = np.linalg.norm(nearest_points(second, points) - points, axis=1)
        least, point = across.min(), points[[across.argmin()]]
        for _ in range(8 if least > gap else 0):
            end = nearest_points(second, point)
            least = min(least, np.linalg.norm(point - end))
            point = nearest_points(first, end)
        if least <= gap:
            return True
    return False


def list_loose(parts: Sequence[ModelPart], gap: float) -> list[int]:
    """Numbers of the parts that a way over gaps of this size does not lead to, from the first."""
    points = [surface_points(part) for part in parts]
    low, high = (np.array([end(one, axis=0) for one in points]) for end in (np.min, np.max))
    apart = np.maximum(low[:, None] - high, low - high[:, None]).max(axis=2)
    left, reached = {*range(1, len(parts))}, [0]
    while reached and left:
        own = reached.pop()
        near = [n for n in left if apart[own, n] <= gap and are_near(parts[own], parts[n], gap)]
        left -= {*near}
        reached += near
    return sorted(left)


@for_every_noun
def test_the_parts_of_a_body_touch_each_other(noun):
    model = usual_model(noun)
    gap = TOUCHING * max(model.length, model.width, model.height)
    done: list[Sequence[ModelPart]] = []
    for pose in POSES if noun.name not in PIECES else ():
        parts = model.parts(pose)
        if not any(all(map(operator.is_, parts, other)) for other in done):
            assert not list_loose(parts, gap), pose
            done.append(parts)


@for_every_noun
def test_things_on_the_ground_stand_on_it(noun):
    if noun.habitat not in ("ground", "fixed") or noun.name in MOUNDS | HUNG:
        return
    model = usual_model(noun)
    for pose in POSES:
        lowest = all_points(model, pose)[:, 2].min()
        assert lowest >= -0.05 * max(1.0, model.height / 10.0), pose
        if pose.activity in ("stand", "move") and noun.name not in HOPPERS:
            slack = 0.02 if pose.activity == "stand" else 0.06
            assert lowest <= 0.02 + slack * model.height, pose


@pytest.mark.long
@for_every_noun
def test_a_millisecond_moves_nothing_far(noun):
    model = usual_model(noun)
    speed = max(noun.speed_m_s, 1.0)
    extent = max(model.length, model.width, model.height)
    # Rotors turn up to 12 times a second, limbs swing at a few times the body's speed; wings of
    # insects beat up to 60 times.
    rate = 45.0 if noun.name in INSECTS else 13.0
    bound = 1e-3 * (8.0 * speed + 2.0 * math.pi * rate * 0.5 * extent)
    for activity in ("move", "run", "stand"):
        for step in range(6):
            time_s = 0.574 * step
            before = model.parts(Pose(time_s, speed * time_s, speed, activity))
            time_s += 1e-3
            after = model.parts(Pose(time_s, speed * time_s, speed, activity))
            changed = [(a, b) for a, b in zip(before, after, strict=True) if a is not b]
            if not changed:
                continue
            change = np.array([b.to_body - a.to_body for a, b in changed])
            assert np.abs(change).max() <= bound
            fade = [
                [*np.subtract(b.colour, a.colour), (b.emission - a.emission) / 3.0]
                for a, b in changed
                if (a.colour, a.emission) != (b.colour, b.emission)
            ]
            assert np.abs(fade).max(initial=0.0) <= 0.1


@for_every_noun
def test_a_colour_word_shows(noun):
    if noun.name in LINES:
        return
    painted = violet_model(noun).parts(Pose(0.3, 0.4, 1.0))
    hue = np.array(VIOLET) / np.linalg.norm(VIOLET)
    likeness = [float(np.dot(p.colour, hue) / max(np.linalg.norm(p.colour), 1e-9)) for p in painted]
    assert max(likeness) > 0.97


@for_every(FAMILIES["birds"])
def test_a_colour_that_is_said_of_a_bird_is_that_of_most_of_it(noun):
    painted = violet_model(noun).parts(Pose(0.3, 0.0, 0.0, "stand"))
    hue = np.array(VIOLET) / np.linalg.norm(VIOLET)
    sides = np.array([np.linalg.norm(one.to_body[:, :3], axis=1) for one in painted])
    areas = np.sum(sides * np.roll(sides, 1, axis=1), axis=1)
    is_so = [float(np.dot(p.colour, hue) / max(np.linalg.norm(p.colour), 1e-9)) > 0.97
             for p in painted]  # fmt: skip
    assert areas[is_so].sum() > 0.55 * areas.sum()


@pytest.mark.parametrize("shade", SHADES)
def test_a_shade_of_a_colour_is_on_its_way_to_white_or_black(shade):
    """Of each channel as much is left, or as much white mixed in."""
    for name, base in COLOURS.items():
        found, colour = np.array(find_colour(f"{shade} {name}", SURFACES)), np.array(base)
        assert (found < colour).all() == (shade in ("dark", "deep"))
        if shade in ("light", "pale"):
            np.testing.assert_allclose(np.ptp((1.0 - found) / (1.0 - colour)), 0.0, atol=1e-9)
        else:
            shares = (found / colour)[found < 1.0]
            np.testing.assert_allclose(shares, shares[:1].repeat(len(shares)), rtol=1e-9)


@pytest.mark.parametrize("name", ["ball", "football", "sphere", "wheel", "car", "truck", "bicycle"])
def test_rolling_nouns_turn_by_distance_over_radius(name):
    for scale in (1.0, 2.5):
        model = NOUNS[name].build(colour=None, scale=scale, seed=0)
        step = 1e-3
        first = model.parts(Pose(0.0, 0.0, 1.0))
        second = model.parts(Pose(0.0, step, 1.0))
        rates = []
        for a, b in zip(first, second, strict=True):
            turn = (b.to_body[:, :3] - a.to_body[:, :3]) / step
            rate = turn @ np.linalg.inv(a.to_body[:, :3])
            if abs(rate[0, 2]) > 1e-6 and np.allclose(a.to_body[:, 3], b.to_body[:, 3], atol=1e-12):
                # Spin about +y by 1 / radius; these parts' centres are at the wheel's height.
                rates.append(rate[0, 2] * a.to_body[2, 3])
        assert rates
        np.testing.assert_allclose(rates, 1.0, rtol=1e-4)


TWO_COLOURED = ("beach ball", "football")
"""Half of a beach ball is white, a third of a football black."""
ROUND = [name for name, noun in NOUNS.items() if noun.motion == "roll" and "ball" in name]
BALLS = [one for one in (*ROUND, "sphere", "marble", "balloon") if one not in TWO_COLOURED]
CHANNELS = {"red": 0, "green": 1, "blue": 2}


@for_every(itertools.product(BALLS, CHANNELS))
def test_four_fifths_of_the_pixels_of_a_coloured_ball_are_of_its_colour(row):
    noun, colour = row
    ball = SceneObject(noun, colour=colour, position_m=(0, 0), motions=(Motion("stand"),))
    config = ProceduralConfig(duration=0.2, samples=1)
    generator = ProceduralGenerator(config, size=SensorSize(96, 72))
    video = generator.generate(Scene(objects=(ball,), place=Place("plain")))
    own = video.at(0).pixels[video.ground_truth(0, 1000).instance == 1]
    others = np.delete(own, CHANNELS[colour], axis=1).max(axis=1)
    assert np.mean(own[:, CHANNELS[colour]] > 1.02 * others) > 0.8
