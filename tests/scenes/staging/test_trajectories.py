"""Trajectories: continuous, physical, pure functions of time."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.scenes.staging.trajectories.action_trajectories import (
    GRAVITY_M_S2,
    Bounce,
    Climb,
    Hop,
    Hover,
    Spin,
    Sway,
    Swing,
)
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Circle,
    FigureEight,
    Riding,
    Rolling,
    Shuttle,
    Stationary,
    Straight,
    Trajectory,
    rotation,
)

STRAIGHT = Straight((1.0, 2.0, 0.0), math.pi, 4.0, 1.0)
TRAJECTORIES: dict[str, Trajectory] = {
    "rest": Stationary((1.0, 2.0, 0.0)),
    "straight": STRAIGHT,
    "weaving": Straight((0.0, 0.0, 2.0), 0.3, 1.0, 1.0, climb=0.4, bob_m=0.1, weave_rad=0.1),
    "rolling": Rolling(Straight((0.0, 0.0, 0.0), 0.0, 2.0, 1.0), 0.25, 0.25),
    "shuttle": Shuttle((0.0, 0.0, 0.0), 0.5, 1.5, 2.0),
    "circle": Circle((0.0, 0.0, 1.0), 2.0, -1.5, 0.4, lean_rad=0.3),
    "eight": FigureEight((0.0, 0.0, 1.0), 2.0, 0.4, 1.2, 0.3, lean_rad=0.3),
    "spin": Spin((0.0, 0.0, 0.0), 3.0),
    "bounce": Bounce((0.0, 0.0, 1.5), along_m_s=0.5),
    "throw": Bounce((0.0, 0.0, 1.0), 0.0, 4.0, 2.0, restitution=0.6, tumble_rad_s=3.0),
    "climb": Climb((0.0, 0.0, 0.0), 0.5, 0.0, 2.0),
    "sink": Climb((0.0, 0.0, 1.0), -1.0, 0.5, lowest_m=0.0),
    "swing": Swing((0.0, 0.0, 1.0), 1.2, 0.5),
    "jump": Hop((0.0, 0.0, 0.0), 0.4, hop_m=0.8, mid_s=1.0),
    "dance": Hop((0.0, 0.0, 0.0), 0.1, sway_rad=0.5, phase_s=0.3),
    "hover": Hover((0.0, 0.0, 2.0), 0.2),
    "sway": Sway((0.0, 0.0, 0.0), 0.2, 0.5),
    "riding": Riding(STRAIGHT, (0.0, 0.0, 1.0)),
}
TIMES = np.linspace(0.0, 6.0, 1201)


@pytest.mark.parametrize("name", TRAJECTORIES)
def test_a_body_never_jumps(name: str) -> None:
    maps = np.array([TRAJECTORIES[name].at(float(t)).to_world() for t in TIMES])
    step = float(TIMES[1] - TIMES[0])
    assert np.abs(np.diff(maps, axis=0)).max() / step < 14.0


@pytest.mark.parametrize("name", TRAJECTORIES)
def test_distance_never_falls_and_matches_the_path_on_the_ground(name: str) -> None:
    states = [TRAJECTORIES[name].at(float(t)) for t in TIMES]
    distance = np.array([state.distance_m for state in states])
    assert np.all(np.diff(distance) >= -1e-12)
    if name in ("straight", "rolling", "shuttle", "circle", "bounce", "jump"):
        ground = np.array([state.position[:2] for state in states])
        path = np.hypot(*np.diff(ground, axis=0).T).sum()
        assert distance[-1] - distance[0] == pytest.approx(path, rel=1e-3)


@pytest.mark.parametrize("name", TRAJECTORIES)
def test_body_maps_are_rotations(name: str) -> None:
    turn = TRAJECTORIES[name].at(1.234).to_world()[:, :3]
    np.testing.assert_allclose(turn @ turn.T, np.eye(3), atol=1e-12)
    assert np.linalg.det(turn) == pytest.approx(1.0)


@given(*[st.floats(-7.0, 7.0)] * 3)
def test_rotation_puts_the_nose_where_yaw_and_pitch_say(
    yaw: float, pitch: float, roll: float
) -> None:
    nose = rotation(yaw, pitch, roll) @ [1.0, 0.0, 0.0]
    expected = [math.cos(yaw) * math.cos(pitch), math.sin(yaw) * math.cos(pitch), -math.sin(pitch)]
    np.testing.assert_allclose(nose, expected, atol=1e-12)


def test_straight_motion_is_at_home_at_mid_clip() -> None:
    assert STRAIGHT.at(1.0).position == pytest.approx((1.0, 2.0, 0.0))
    assert STRAIGHT.at(0.0).position == pytest.approx((5.0, 2.0, 0.0))


def test_a_rolling_ball_does_not_slide() -> None:
    """The point that touches the ground stands still: v = ω r."""
    ball = TRAJECTORIES["rolling"]
    before, after = ball.at(1.0).to_world(), ball.at(1.0 + 1e-6).to_world()
    lowest = np.linalg.inv(before[:, :3]) @ (
        np.array([ball.at(1.0).position[0], 0.0, 0.0]) - before[:, 3]
    )
    touched = after[:, :3] @ lowest + after[:, 3]
    np.testing.assert_allclose(touched, before[:, :3] @ lowest + before[:, 3], atol=1e-9)


def test_a_bouncing_ball_falls_freely_and_keeps_its_restitution() -> None:
    ball = Bounce((0.0, 0.0, 1.25), restitution=0.8)
    landing = math.sqrt(2.0 * 1.25 / GRAVITY_M_S2)
    assert ball.height_m(0.5 * landing) == pytest.approx(1.25 * 0.75)
    assert ball.height_m(landing) == pytest.approx(0.0, abs=1e-12)
    peak = ball.height_m(landing * (1.0 + 0.8))
    assert peak == pytest.approx(0.64 * 1.25)
    second = landing * (1.0 + 1.6 + 0.64)
    assert ball.height_m(second) == pytest.approx(0.64**2 * 1.25)
    assert ball.height_m(100.0) == 0.0


@given(st.floats(0.05, 3.0), st.floats(0.1, 0.95), st.floats(0.0, 20.0))
def test_a_bouncing_ball_is_never_below_the_ground_or_above_its_start(
    height: float, restitution: float, time_s: float
) -> None:
    assert 0.0 <= Bounce((0.0, 0.0, height), restitution=restitution).height_m(time_s) <= height


def test_a_pendulum_has_the_period_of_its_length() -> None:
    swing = Swing((0.0, 0.0, 1.0), 1.5, 0.3)
    period = 2.0 * math.pi * math.sqrt(1.5 / GRAVITY_M_S2)
    assert swing.at(0.0).pitch == pytest.approx(0.3)
    assert swing.at(0.5 * period).pitch == pytest.approx(-0.3)
    top = np.array([0.0, 0.0, 1.5, 1.0])
    np.testing.assert_allclose(swing.at(0.7).to_world() @ top, [0.0, 0.0, 2.5], atol=1e-12)


def test_a_circling_body_faces_along_its_path() -> None:
    circle = Circle((0.0, 0.0, 0.0), 2.0, -1.5)
    step = np.subtract(circle.at(0.3 + 1e-6).position, circle.at(0.3).position)
    nose = rotation(circle.at(0.3).yaw, 0.0, 0.0) @ [1.0, 0.0, 0.0]
    np.testing.assert_allclose(step / np.linalg.norm(step), nose, atol=1e-5)


def test_an_eight_closes_crosses_its_middle_and_is_faced_along() -> None:
    eight = FigureEight((1.0, 2.0, 3.0), 2.0, 0.4, 1.2)
    round_s = 2.0 * math.pi / 1.2
    for time_s in (0.0, 0.5 * round_s, round_s):
        assert eight.at(time_s).position == pytest.approx((1.0, 2.0, 3.0))
    end = eight.at(0.25 * round_s).position
    assert end == pytest.approx((1.0 + 2.0 * math.cos(0.4), 2.0 + 2.0 * math.sin(0.4), 3.0))
    times = np.linspace(0.0, round_s, 4001)
    places = np.array([eight.at(float(t)).position for t in times])
    way = float(np.linalg.norm(np.diff(places, axis=0), axis=1).sum())
    assert eight.at(round_s).distance_m == pytest.approx(way, rel=1e-3)
    for time_s in (0.3, 1.7, 4.0):
        state = eight.at(time_s)
        step = np.subtract(eight.at(time_s + 1e-5).position, state.position)
        assert math.atan2(step[1], step[0]) == pytest.approx(
            math.remainder(state.yaw, 2.0 * math.pi), abs=1e-3
        )


def test_a_jump_reaches_its_height_and_lands() -> None:
    heights = [Hop((0.0, 0.0, 0.0), 0.4).at(float(t)).position[2] for t in TIMES]
    assert max(heights) == pytest.approx(0.4, rel=1e-3)
    assert min(heights) == 0.0


def test_a_rider_keeps_its_seat() -> None:
    horse = Circle((0.0, 0.0, 0.0), 3.0, 1.0)
    rider = Riding(horse, (0.2, 0.0, 1.0))
    for time in (0.0, 0.7, 1.9):
        seat = horse.at(time).to_world() @ [0.2, 0.0, 1.0, 1.0]
        np.testing.assert_allclose(rider.at(time).position, seat)


def test_states_turn_about_their_pivot() -> None:
    for yaw, pitch, roll in itertools.product((0.0, 1.0), (0.0, 2.0), (0.0, -1.0)):
        state = BodyState((1.0, 2.0, 3.0), yaw, pitch, roll, pivot_m=0.5)
        np.testing.assert_allclose(state.to_world() @ [0.0, 0.0, 0.5, 1.0], [1.0, 2.0, 3.5])
