"""Paths of pieces: continuous, of the stated speed, and where the geometry says."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.scenes.staging.trajectories.steered_path import (
    Lagging,
    Piece,
    SteeredPath,
)

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
def test_position_heading_and_speed_are_continuous(path: SteeredPath, time_s: float) -> None:
    instants = [time_s, *(knot.time_s - 5e-4 for knot in path._knots)]
    for instant in instants:
        before, after = path.at(instant), path.at(instant + 1e-3)
        assert np.abs(np.subtract(after.position, before.position)).max() < 0.03
        assert abs(after.yaw - before.yaw) < 0.01
        assert abs(after.roll - before.roll) < 0.25
        assert abs(after.speed_m_s - before.speed_m_s) < 0.5
        assert abs(after.distance_m - before.distance_m) < 0.02


@given(paths, st.floats(0.0, 5.0))
def test_the_velocity_is_the_speed_along_the_heading(path: SteeredPath, time_s: float) -> None:
    before, middle, after = (path.at(time_s + step) for step in (-1e-5, 0.0, 1e-5))
    velocity = np.subtract(after.position, before.position)[:2] / 2e-5
    signed = (after.distance_m - before.distance_m) / 2e-5
    heading = np.array([math.cos(middle.yaw), math.sin(middle.yaw)])
    np.testing.assert_allclose(velocity, signed * heading, atol=2e-3)
    assert abs(signed) == pytest.approx(middle.speed_m_s, abs=1e-2)


def test_the_quadrature_agrees_with_many_small_steps() -> None:
    path = SteeredPath((0.0, 0.0, 0.0), 0.3, (Piece(3.0, 8.0, 4.0, ramp_s=3.0),), 1.0)
    times = np.linspace(0.0, 3.0, 20001)
    states = [path.at(float(t)) for t in times[::100]]
    u = times / 3.0
    speed = 1.0 + 7.0 * u * u * (3.0 - 2.0 * u)
    heading = 0.3 + 4.0 * 3.0 * (u**3 - 0.5 * u**4)
    x = np.concatenate([[0.0], np.cumsum(0.5 * np.diff(times) * (
        (speed * np.cos(heading))[1:] + (speed * np.cos(heading))[:-1]))])  # fmt: skip
    np.testing.assert_allclose([s.position[0] for s in states], x[::100], atol=1e-6)


def test_a_follower_stays_the_gap_behind_on_the_same_line() -> None:
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


def test_a_hop_rises_to_its_height_and_says_when_it_is_there() -> None:
    path = SteeredPath((0.0, 0.0, 0.0), 0.0, (Piece(0.8, hop_m=0.4, activity="jump"),))
    states = [path.at(float(time_s)) for time_s in np.linspace(0.0, 0.8, 801)]
    highest = max(states, key=lambda one: one.position[2])
    assert highest.position[2] == pytest.approx(0.4, rel=1e-3)
    assert highest.act_s == pytest.approx(0.0, abs=1e-3)
    assert min(one.position[2] for one in states) == 0.0
