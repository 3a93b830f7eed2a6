"""A preposition is staged and checked, or reported: it never disappears."""

from __future__ import annotations

import pytest
from tests.generate.seen_words.test_words import report_of


def listed(prompt: str) -> tuple[str, ...]:
    report = report_of(prompt)
    return (*report.not_shown, *report.not_understood)


@pytest.mark.parametrize(
    ("prompt", "phrase"),
    [
        ("a wind turbine rotates behind a hill", "behind"),
        ("a dog runs around a lake", "around"),
        ("a truck with two flags", "truck with the flags"),
        ("a cat jumps from a chair", "from the chair"),
        ("a car turns left while a cyclist waits behind it", "behind the car"),
    ],
)
def test_what_a_preposition_says_is_reported_where_it_is_not_seen(prompt: str, phrase: str) -> None:
    assert phrase in listed(prompt)


@pytest.mark.parametrize(
    "prompt",
    [
        "a drone takes off from a table",
        "a man stands at a window",
        "a curtain at a window",
        "a tree behind a house",
        "a satellite with solar panels",
        "a cow stands beside a road",
    ],
)
def test_what_is_seen_is_not_reported(prompt: str) -> None:
    assert listed(prompt) == ()


def test_what_is_seen_from_a_bridge_is_seen_from_above_and_without_it() -> None:
    report = report_of("highway traffic from an overpass")
    assert not any("bridge" in line for line in report.scene)
    assert any("high view" in line for line in report.scene)
    assert [one.shown for one in report.substituted] == ["where the camera stands"]


@pytest.mark.parametrize(
    "prompt",
    ["people walk, fixed camera from an upstairs window", "steady shot from a window, people walk"],
)
def test_the_window_that_the_camera_looks_out_of_is_not_in_the_picture(prompt: str) -> None:
    report = report_of(prompt)
    assert not any("window" in line for line in report.scene)
    assert "place: grass" in report.scene


def test_what_lifts_off_from_a_table_is_on_it_first() -> None:
    assert "1 drone, rises, on 1 table" in report_of("a drone takes off from a table").scene
