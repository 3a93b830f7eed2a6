"""Paths of pieces: continuous, of the stated speed, and what sequences of motions come to."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.scenes.description import ObjectMotion
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.staging.trajectories.phases import build_path, schedule
from texvent.scenes.staging.trajectories.steered_path import Lagging, Piece, SteeredPath

KINDS = ("drive", "walk", "run", "fly", "turn", "reverse", "spin", "rise", "sink",
         "jump", "bounce", "fall", "topple", "stand", "sit", "sway", "hover")  # fmt: skip
DIRECTIONS = (None, "left", "right", "towards", "away", "backward", "around", "circle", "up")
motions = st.builds(
    ObjectMotion,
    st.sampled_from(KINDS),
    st.sampled_from(DIRECTIONS),
    st.sampled_from([0.5, 1.0, 2.0]),
    end_pace=st.sampled_from([None, None, 0.0, 2.0]),
)


def path_of(
    *sequence: ObjectMotion, noun: str = "car", speed: float = 4.0, duration_s: float = 4.0
) -> SteeredPath:
    model = NOUNS[noun].build(colour=None, scale=1.0, seed=0)
    return build_path(sequence, NOUNS[noun], model, yaw=0.0, usual_m_s=speed, duration_s=duration_s)


def test_stated_times_are_kept():
    sequence = [ObjectMotion("walk"), ObjectMotion("jump", start_s=2.0), ObjectMotion("sit")]
    starts = [phase.start_s for phase in schedule(sequence, 6.0)]
    assert starts == [0.0, 2.0, 4.0]
    waiting = schedule([ObjectMotion("walk", start_s=1.5)], 2.0)
    assert [(p.motion.kind, p.start_s) for p in waiting] == [("stand", 0.0), ("walk", 1.5)]


@given(
    st.lists(motions, min_size=1, max_size=4),
    st.sampled_from(["car", "man", "helicopter", "dog", "fish", "table"]),
    st.floats(0.0, 4.0),
    st.floats(0.5, 4.0),
)
def test_sequences_are_continuous(sequence, noun, time_s, duration_s):
    path = path_of(*sequence, noun=noun, duration_s=duration_s)
    assert path.duration_s == pytest.approx(duration_s)
    edges = np.cumsum([piece.duration_s for piece in path.pieces])
    for instant in (time_s, *(edges - 5e-4)):
        before, after = path.at(float(instant)), path.at(float(instant) + 1e-3)
        assert np.abs(np.subtract(after.position, before.position)).max() < 0.05
        assert abs(after.yaw - before.yaw) < 0.2
        assert abs(after.speed_m_s - before.speed_m_s) < 1.0


@pytest.mark.parametrize(("direction", "sign"), [("left", 1.0), ("right", -1.0)])
def test_a_car_turns_a_quarter_circle_and_drives_on(direction, sign):
    path = path_of(ObjectMotion("turn", direction))
    turned = path.at(4.0).yaw - path.at(0.0).yaw
    assert turned == pytest.approx(sign * 0.5 * math.pi)
    assert path.at(4.0).distance_m > 10.0
    assert path.at(4.0).speed_m_s == path.at(0.0).speed_m_s


@given(st.floats(0.5, 20.0))
def test_stated_speeds_are_exact(speed):
    path = path_of(
        ObjectMotion("drive", speed_m_s=speed), ObjectMotion("turn", "left", speed_m_s=speed)
    )
    for time_s in (0.3, 1.0, 3.0):
        assert path.at(time_s).speed_m_s == pytest.approx(speed, rel=1e-12)


def test_accelerating_and_braking_end_at_the_end_pace():
    faster = path_of(ObjectMotion("drive", end_pace=2.0))
    assert (faster.at(0.0).speed_m_s, faster.at(4.0).speed_m_s) == (4.0, 8.0)
    braking = path_of(ObjectMotion("drive", end_pace=0.0))
    assert braking.at(4.0).speed_m_s == 0.0


@pytest.mark.parametrize(("noun", "rises"), [("balloon", 1.0), ("balloon", -1.0), ("boat", -1.0)])
def test_what_rises_or_sinks_goes_straight_up_or_down(noun, rises):
    path = path_of(ObjectMotion("rise" if rises > 0.0 else "sink"), noun=noun, speed=1.0)
    first, last = path.at(0.0).position, path.at(4.0).position
    assert first[:2] == pytest.approx(last[:2])
    assert rises * (last[2] - first[2]) > 0.3


def test_an_airplane_takes_off_along_a_runway_and_lands_on_it():
    off = path_of(ObjectMotion("rise"), noun="airplane", speed=20.0)
    assert off.at(1.0).position[2] == 0.0
    assert off.at(4.0).position[2] > 5.0
    assert off.at(4.0).pitch < -0.1
    down = path_of(ObjectMotion("sink"), noun="airplane", speed=20.0)
    assert down.at(0.0).position[2] > 3.0
    assert down.at(4.0).position[2] == pytest.approx(0.0, abs=0.1)


pieces = st.builds(
    Piece,
    st.floats(0.2, 2.0),
    st.floats(-4.0, 9.0),
    st.floats(-3.0, 3.0),
    st.floats(-1.0, 1.0),
    st.floats(0.05, 1.0),
    hop_m=st.sampled_from([0.0, 0.0, 0.3]),
    is_dropped=st.booleans(),
    pitch_rad=st.sampled_from([0.0, 0.0, 1.5]),
)
paths = st.builds(
    SteeredPath,
    st.just((1.0, 2.0, 0.5)),
    st.floats(-3.0, 3.0),
    st.lists(pieces, min_size=1, max_size=4).map(tuple),
    st.floats(-3.0, 9.0),
    lean=st.sampled_from([0.0, 1.0]),
)


@given(paths, st.floats(-0.5, 9.0))
def test_position_heading_and_speed_are_continuous(path, time_s):
    instants = [time_s, *(knot.time_s - 5e-4 for knot in path._knots)]
    for instant in instants:
        before, after = path.at(instant), path.at(instant + 1e-3)
        assert np.abs(np.subtract(after.position, before.position)).max() < 0.03
        assert abs(after.yaw - before.yaw) < 0.01
        assert abs(after.roll - before.roll) < 0.25
        assert abs(after.speed_m_s - before.speed_m_s) < 0.5
        assert abs(after.distance_m - before.distance_m) < 0.02


@given(paths, st.floats(0.0, 5.0))
def test_the_velocity_is_the_speed_along_the_heading(path, time_s):
    before, middle, after = (path.at(time_s + step) for step in (-1e-5, 0.0, 1e-5))
    velocity = np.subtract(after.position, before.position)[:2] / 2e-5
    signed = (after.distance_m - before.distance_m) / 2e-5
    heading = np.array([math.cos(middle.yaw), math.sin(middle.yaw)])
    np.testing.assert_allclose(velocity, signed * heading, atol=2e-3)
    assert abs(signed) == pytest.approx(middle.speed_m_s, abs=1e-2)


def test_a_follower_stays_the_gap_behind_on_the_same_line():
    path = SteeredPath(
        (0.0, 0.0, 0.0), 0.0, (Piece(1.0, 5.0), Piece(1.0, 5.0, 1.6), Piece(1.0, 0.0)), 5.0
    )
    follower = Lagging(path, 3.0)
    for time_s in (0.1, 1.2, 2.9):
        way = path.distance_at(time_s) - follower.at(time_s).distance_m
        assert way == pytest.approx(3.0)
    earlier = min(
        np.hypot(*np.subtract(path.at(float(t)).position, follower.at(1.9).position)[:2])
        for t in np.linspace(0.0, 1.9, 4000)
    )
    assert earlier < 3e-3
