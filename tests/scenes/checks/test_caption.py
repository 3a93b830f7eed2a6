"""Captions: lines on a clip that are measured beside what its scene states."""

import itertools
import re

import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import SIZE

from texvent_scenes.checks.caption import caption
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.in_view import find_unseen
from texvent_scenes.defaults import complete
from texvent_scenes.description import to_description
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.places import PLACES
from texvent_scenes.spec.data import scene_from_data
from texvent_scenes.staging.compose import compose_scene

CLIP_S = 2.0


def lines(*objects, **scene):
    """Caption of a scene of plain values: the line of its place, those of its objects, the last."""
    said = scene_from_data({"place": {"name": "grass", "is_empty": True}, "objects": [*objects]}
                           | scene)  # fmt: skip
    description = complete(to_description(said), NOUNS)
    staged = compose_scene(description, seed=0, size=SIZE, duration_s=CLIP_S)
    seen = find_unseen(staged, description, SIZE, CLIP_S)
    place, *bodies, camera = caption(StagedClip(staged, description, SIZE, CLIP_S), seen.views)
    return place, bodies, camera


def first(line):
    """A line without its share of the picture."""
    return re.sub(r"; [\d.]+% of the picture.*", "", line)


@pytest.mark.parametrize("colour", ["red", "yellow", "green", "blue", "white", "black", "orange"])
@pytest.mark.parametrize("noun", ["cube", "ball", "car", "mug"])
def test_a_stated_colour_is_the_first_that_is_told(noun, colour):
    _, (line,), _ = lines({"noun": noun, "colour": colour, "motions": [{"kind": "stand"}]})
    assert re.match(rf"{noun} \({colour}\b", line), line


@pytest.mark.parametrize("count", [1, 2, 5])
def test_copies_in_view_are_counted(count):
    _, (line,), _ = lines({"noun": "child", "count": count, "motions": [{"kind": "wave"}]})
    assert line.startswith(f"{count} children" if count > 1 else "child "), line
    assert "acts: wave" in line


@pytest.mark.parametrize(("direction", "words"), [
    ("left", "to the left"), ("right", "to the right"), ("towards", "towards the camera"),
    ("away", "away from the camera"),
])  # fmt: skip
@pytest.mark.parametrize("noun", ["car", "man", "drone"])
def test_a_way_is_told_with_its_length_side_and_speed(noun, direction, words):
    kind = {"car": "drive", "man": "walk", "drone": "fly"}[noun]
    motion = {"kind": kind, "direction": direction, "speed_m_s": 1.5}
    _, (line,), _ = lines({"noun": noun, "motions": [motion]})
    length = float(re.search(rf"([\d.]+) m {words}", line)[1])
    assert 2.5 <= length <= 3.0, line
    assert "at 1.5 m/s" in line


def test_each_leg_of_a_way_is_told():
    legs = [{"kind": "rise"}, {"kind": "fly", "direction": "left", "speed_m_s": 2, "start_s": 0.5}]
    _, (line,), _ = lines({"noun": "drone", "height_m": 1.0, "motions": legs})
    assert re.search(r"goes [\d.]+ m to the left and [\d.]+ m up", line), line


@pytest.mark.parametrize(
    ("heading_deg", "side"), [(0.0, "side"), (90.0, "behind"), (-90.0, "front"), (180.0, "side")]
)
@pytest.mark.parametrize("noun", ["man", "dog", "car"])
def test_the_side_that_is_seen_follows_from_the_heading(noun, heading_deg, side):
    camera = {"position_m": [0.0, -9.0, 1.2], "look_at_m": [0.0, 0.0, 0.8]}
    body = {"noun": noun, "position_m": [0.0, 0.0], "heading_deg": heading_deg,
            "motions": [{"kind": "stand"}]}  # fmt: skip
    _, (line,), _ = lines(body, camera=camera)
    assert re.search(rf"seen from( the)? {side}", line), line


@pytest.mark.parametrize("bearer", ["table", "box", "bench"])
def test_what_bears_a_body_is_told(bearer):
    cup = {"noun": "mug", "relations": [{"kind": "on", "to": [bearer]}],
           "motions": [{"kind": "stand"}]}  # fmt: skip
    _, (line, other), _ = lines(cup, {"noun": bearer, "motions": [{"kind": "stand"}]})
    assert f"; on the {bearer}" in line
    assert "; on the ground" in other


HELD = ("knife", "cup", "umbrella", "paper plane", "rope", "book", "sword", "balloon", "flag")
HAD = [
    *itertools.product(("man", "hand", "robot arm"), HELD, ("hold",)),
    *itertools.product(("robot arm",), ("cup", "box", "bottle"), ("lift",)),
    *itertools.product(("man", "child"), ("hat", "backpack", "scarf", "helmet"), ("wear",)),
]


@for_every(HAD)
def test_what_is_held_or_worn_is_told_so_and_not_in_the_air(row):
    who, thing, kind = row
    holder = {"noun": who, "relations": [{"kind": kind, "to": [thing]}]}
    _, (own, line), _ = lines(holder, {"noun": thing})
    assert f"; {'worn' if kind == 'wear' else 'held'} by the {who}" in line
    assert "in the air" not in line
    assert f"on the {thing}" not in own


@for_every(itertools.product(("ball", "crate", "vase"), (0.5, 1.6)))
def test_what_hangs_on_a_thread_until_it_falls_is_told_so(row):
    noun, start_s = row
    _, (line,), _ = lines({"noun": noun, "height_m": 2.0,
                           "motions": [{"kind": "fall", "start_s": start_s}]})  # fmt: skip
    assert ("hangs on a thread" in line) is (start_s > 0.5 * CLIP_S)


def test_heights_and_grounds_are_told():
    ball = {"noun": "ball", "position_m": [0.0, 0.0], "height_m": 1.2,
            "motions": [{"kind": "hover"}]}  # fmt: skip
    _, (line,), _ = lines(ball)
    assert "m above the ground" in line
    room = {"name": "kitchen", "is_empty": True}
    _, (line,), _ = lines({"noun": "dog", "motions": [{"kind": "sit"}]}, place=room)
    assert "on the floor" in line
    lamp = {"noun": "ceiling lamp", "motions": [{"kind": "stand"}]}
    _, (line,), _ = lines(lamp, place=room)
    assert "under the ceiling" in line
    _, (line,), _ = lines({"noun": "boat", "motions": [{"kind": "float"}]}, place={"name": "sea"})
    assert re.search("(on|in) the water", line)


@pytest.mark.parametrize(("move", "words"), [
    ({"kind": "truck", "direction": "right", "speed_m_s": 0.5}, "goes 1 m right"),
    ({"kind": "truck", "direction": "left", "speed_m_s": 0.5}, "goes 1 m left"),
    ({"kind": "pedestal", "direction": "up", "speed_m_s": 0.4}, "goes 0.8 m up"),
    ({"kind": "dolly", "direction": "in", "speed_m_s": 0.6}, "goes 1.2 m forward"),
    ({"kind": "pan", "direction": "left", "rate_deg_s": 10.0}, "turns 20° left"),
    ({"kind": "pan", "direction": "right", "rate_deg_s": 10.0}, "turns 20° right"),
    ({"kind": "tilt", "direction": "up", "rate_deg_s": 6.0}, "turns 12° up"),
    ({"kind": "zoom", "direction": "out", "rate_deg_s": 10.0}, "zooms out 1.5 times"),
    ({"kind": "zoom", "direction": "in", "rate_deg_s": 10.0}, "zooms in 1.8 times"),
    ({"kind": "roll", "direction": "clockwise", "rate_deg_s": 10.0}, "rolls by 20°"),
    ({"kind": "static"}, "stays"),
])  # fmt: skip
def test_ways_and_turns_of_the_camera_are_told_as_stated(move, words):
    camera = {"position_m": [0.0, -8.0, 1.5], "look_at_m": [0.0, 0.0, 1.5], "moves": [move]}
    body = {"noun": "man", "position_m": [0.0, 0.0], "motions": [{"kind": "stand"}]}
    *_, line = lines(body, camera=camera)
    assert line == f"camera: 1.5 m above the ground, looks level, {words}"


def test_what_is_hidden_or_gone_is_told():
    wall = {"noun": "car", "id": "near", "position_m": [0.0, -3.0], "heading_deg": 0.0,
            "motions": [{"kind": "stand"}]}  # fmt: skip
    man = {"noun": "man", "position_m": [0.0, 0.0], "motions": [{"kind": "stand"}]}
    camera = {"position_m": [0.0, -12.0, 1.2], "look_at_m": [0.0, 0.0, 1.0]}
    _, (_, line), _ = lines(wall, man, camera=camera)
    hidden = int(re.search(r"(\d+)% of it hidden", line)[1])
    assert 60 <= hidden < 100
    _, (line, _), _ = lines(man | {"position_m": [0.0, -30.0]}, wall, camera=camera)
    assert line == "man: never in view"


@pytest.mark.parametrize(("view", "has_sky"), [("top", False), ("low", True)])
def test_the_sky_is_told_where_it_is_in_view(view, has_sky):
    place, _, _ = lines({"noun": "man", "motions": [{"kind": "stand"}]}, camera={"view": view})
    assert bool(re.search(r", sky in \d+% of the picture", place)) is has_sky, place
    assert (", no sky in view" in place) is not has_sky


@pytest.mark.parametrize("name", sorted(PLACES))
def test_every_place_is_named_with_its_light(name):
    line, _, camera = lines(place={"name": name}, light={"kind": "night"})
    assert re.match(f"({'|'.join((name, *PLACES[name].names))}) at night", line), line
    assert camera.startswith("camera: ")


@pytest.mark.parametrize("noun", ["hummingbird", "drone", "balloon", "bee"])
@pytest.mark.parametrize("kind", ["hover", "sway", "shake", "bounce"])
def test_small_motions_have_a_line_whichever_way_they_go(noun, kind):
    _, (line,), _ = lines({"noun": noun, "motions": [{"kind": kind}]}, camera={"framing": "close"})
    assert re.search(r"(goes .*\d m.* at |stays|turns by|tilts .*by 16°)", line), line


@pytest.mark.parametrize("act", ["turn red", "turn green", "turn amber"])
@pytest.mark.parametrize("timed", [{}, {"start_s": 0.5}])
def test_a_light_that_changes_once_has_no_rate(act, timed):
    _, (line,), _ = lines({"noun": "traffic light", "motions": [{"kind": act, **timed}]})
    assert "acts: " in line
    assert "Hz" not in line, line


@pytest.mark.parametrize(
    ("motion", "words"),
    [({"kind": "sway", "rate_hz": 2.0}, "tilts to and fro by 16"),
     ({"kind": "topple"}, "tilts by 90"),
     ({"kind": "tilt", "rate_hz": 1.5}, "tilts to and fro by 46")],
)  # fmt: skip
@pytest.mark.parametrize("noun", ["checkerboard", "box", "tree", "bottle", "sign"])
def test_what_leans_on_the_spot_goes_no_way(noun, motion, words):
    _, (line,), _ = lines({"noun": noun, "motions": [motion]})
    rate = float((re.search(r" at ([\d.]+) Hz", line) or [0, "0"])[1])
    assert re.search(rf"\b{words}\b", line), line
    assert "goes" not in line
    assert rate == pytest.approx(motion.get("rate_hz", 0.0), rel=0.1)
