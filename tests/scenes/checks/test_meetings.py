"""Bodies that stated numbers lead through each other are told, with their names and the time."""

import itertools
import re

from tests.scenes.every_row import for_every

from texvent.sensor import SensorSize
from texvent_scenes.description import report_of
from texvent_scenes.scene_input import describe_scene, list_nouns
from texvent_scenes.spec.scene import Motion, Place, Scene, SceneObject
from texvent_scenes.staged_prompt import stage

MOVERS = [("car", "drive", 8.0), ("man", "walk", 1.5), ("dog", "run", 3.0),
          ("mobile robot", "drive", 1.0), ("bus", "drive", 6.0), ("drone", "fly", 2.0)]  # fmt: skip
STILL = ["tree", "wall", "crate", "street lamp", "table", "person"]
WAYS = {"right": (1.0, 0.0), "left": (-1.0, 0.0), "away": (0.0, 1.0), "towards": (0.0, -1.0)}
MET_S = 1.2


def tell(*objects):
    nouns = list_nouns()
    scene = Scene(objects=objects, place=Place("plain", is_empty=True))
    description = describe_scene(scene, nouns)
    size = SensorSize(64, 48)
    _, report, _ = stage(
        description, report_of(description), nouns, seed=0, size=size, duration_s=2.0
    )
    return [one for one in report.not_shown if "one goes through the other" in one]


def mover(noun, kind, speed, way, name, late_m=0.0):
    """A body that is at (0, 0) at `MET_S`, or so much later on its way."""
    along = -speed * MET_S - late_m
    place = tuple(along * one for one in WAYS[way])
    height = {"height_m": 0.3} if noun == "drone" else {}
    motion = Motion(kind, way, speed_m_s=speed)
    return SceneObject(noun, id=name, motions=(motion,), position_m=place, **height)


def time_of(line):
    return float(re.search(r"at ([\d.]+) s$", line)[1])


PAIRS = [pair for pair in itertools.combinations(MOVERS, 2) if "drone" not in (pair[0][0])]


@for_every(itertools.product(PAIRS, (("right", "away"), ("right", "left"), ("towards", "left"))))
def test_movers_that_meet_are_told_with_the_time_and_others_are_not(row):
    (first, second), ways = row
    lines = tell(mover(*first, ways[0], "one"), mover(*second, ways[1], "other"))
    assert len(lines) == 1
    assert lines[0].startswith(f"the {first[0]} and the {second[0]} apart: ")
    slowest = min(first[2], second[2])
    assert MET_S - 6.0 / slowest < time_of(lines[0]) <= MET_S + 0.1
    if ways != ("right", "left"):
        late = mover(*second, ways[1], "other", late_m=14.0)
        assert not tell(mover(*first, ways[0], "one"), late)


@for_every(itertools.product(MOVERS[:5], STILL, ("right", "away")))
def test_what_goes_through_a_thing_is_told(row):
    (noun, kind, speed), thing, way = row
    still = SceneObject(thing, motions=(Motion("stand"),), position_m=(0.0, 0.0), size=1.2)
    lines = tell(mover(noun, kind, speed, way, "one"), still)
    assert all(time_of(line) <= MET_S + 0.5 for line in lines)
    assert lines or thing in ("tree", "table", "street lamp")  # under the crown, or the top
    aside = SceneObject(thing, motions=(Motion("stand"),), position_m=(20.0, 20.0))
    assert not tell(mover(noun, kind, speed, way, "one"), aside)


def test_ids_tell_several_of_one_noun_apart():
    two = [mover("car", "drive", 8.0, way, name) for way, name in (("right", "a"), ("away", "b"))]
    (line,) = tell(*two)
    assert line.startswith('the car "a" and the car "b" apart: ')
