"""Ways that are said in few words: "left, then right", "and back", "towards each other"."""

import pytest

from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.language.phrases.ways import plain_ways
from texvent.scenes.language.words.tokens import tokenize_prompt


def motions_of(prompt: str, index: int = 0) -> list[tuple[str, str | None]]:
    found = parse_prompt(prompt).objects[index]
    assert found.motion is not None
    return [(one.kind, one.direction) for one in (found.motion, *found.then)]


@pytest.mark.parametrize(
    ("prompt", "said"),
    [
        ("a bar moves up, then down", "a bar moves up , then moves down"),
        ("a bar moves right and then goes back", "a bar moves right and then goes left"),
        ("a man walks back", "a man walks back"),
        ("a bus drives past from the left", "a bus drives across from the left"),
        ("a bus drives past a tree", "a bus drives past a tree"),
        ("two buses approach each other", "two buses move in opposite directions"),
        ("two lines cross", "two lines move in opposite directions"),
        ("a man crosses", "a man crosses"),
        ("a boy runs along a beach after a kite", "a boy runs along a beach chasing a kite"),
        ("a boy runs along a beach after the storm", "a boy runs along a beach after the storm"),
    ],
)
def test_a_way_is_said_in_full(prompt: str, said: str) -> None:
    assert " ".join(one.text for one in plain_ways(tokenize_prompt(prompt))) == said


@pytest.mark.parametrize(
    ("prompt", "motions"),
    [
        ("a square moves right, then left", [("slide", "right"), ("slide", "left")]),
        ("a drone flies left, stops and flies back",
         [("fly", "left"), ("stand", None), ("fly", "right")]),
        ("a helicopter hovers, then shoots off to the left",
         [("hover", None), ("fly", "left")]),
        ("a bus slows and comes to a standstill", [("drive", None), ("stand", None)]),
        ("a dog runs past", [("run", "across")]),
        ("two cars drive towards each other", [("drive", "right")]),
    ],
)  # fmt: skip
def test_a_motion_goes_the_way_that_is_meant(
    prompt: str, motions: list[tuple[str, str | None]]
) -> None:
    assert motions_of(prompt) == motions
    assert parse_prompt(prompt).not_understood == ()


def test_what_turns_slows_down_where_it_is() -> None:
    wheel = parse_prompt("a wheel spins and slows down").objects[0]
    fan = parse_prompt("a fan slows down").objects[0]
    assert wheel.motion is not None
    assert fan.motion is not None
    assert (wheel.motion.kind, wheel.motion.end_pace, wheel.then) == ("spin", 0.2, ())
    assert (fan.motion.kind, fan.motion.end_pace, fan.then) == ("work", 0.2, ())


@pytest.mark.parametrize(
    "prompt", ["a drone moves up and down at 3 Hz", "a checkerboard shakes at 3 Hz"]
)
def test_what_goes_and_returns_does_so_at_the_rate_that_is_stated(prompt: str) -> None:
    found = parse_prompt(prompt).objects[0]
    assert found.motion is not None
    assert found.motion.rate_hz == 3.0


@pytest.mark.parametrize(
    ("prompt", "way"),
    [
        ("parcels move from right to left on a conveyor belt", "left"),
        ("a conveyor belt carrying crates from left to right", "right"),
        ("a fast conveyor belt with boxes", None),
        ("bottles move to the left along a conveyor belt", "left"),
    ],
)
def test_a_belt_runs_where_it_stands(prompt: str, way: str | None) -> None:
    (belt,) = (one for one in parse_prompt(prompt).objects if one.noun == "conveyor belt")
    assert belt.motion is not None
    assert (belt.motion.kind, belt.motion.direction) == ("work", way)


def test_a_screen_flickers_as_part_of_its_device() -> None:
    assert parse_prompt("the laptop screen flickers").objects[0].blink_hz is not None


def test_patterns_of_several_lines_are_one() -> None:
    assert [one.count for one in parse_prompt("growing concentric circles").objects] == [1]
