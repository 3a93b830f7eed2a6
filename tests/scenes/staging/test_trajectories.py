"""Trajectories: continuous, physical, pure functions of time."""

from __future__ import annotations

import math

import numpy as np
import pytest

from texvent.scenes.staging.trajectories.action_trajectories import (
    GRAVITY_M_S2,
    Arc,
    Flight,
    Oscillating,
    Spin,
    Swing,
    Wave,
    bounce_height,
    hover,
)
from texvent.scenes.staging.trajectories.trajectory import (
    BodyState,
    Circle,
    Riding,
    Rolling,
    Shuttle,
    Stationary,
    Straight,
    Trajectory,
)

STRAIGHT = Straight((1.0, 2.0, 0.0), math.pi, 4.0, 1.0)
TRAJECTORIES: dict[str, Trajectory] = {
    "rest": Stationary((1.0, 2.0, 0.0)),
    "straight": STRAIGHT,
    "weaving": Oscillating(
        Straight((0.0, 0.0, 2.0), 0.3, 1.0, 1.0, climb=0.4), (Wave("yaw", 0.1, 0.7, 0.3),)
    ),
    "rolling": Rolling(Straight((0.0, 0.0, 0.0), 0.0, 2.0, 1.0), 0.25, 0.25),
    "shuttle": Shuttle((0.0, 0.0, 0.0), 0.5, 1.5, 2.0),
    "circle": Circle((0.0, 0.0, 1.0), 2.0, -1.5, 0.4, lean_rad=0.3),
    "spin": Spin((0.0, 0.0, 0.0), 3.0),
    "axle": Spin((0.0, 0.0, 0.0), 3.0, axis="pitch", pivot_m=0.5),
    "bounce": Flight(BodyState((0.0, 0.0, 1.5)), (0.5, 0.0, 0.0)),
    "throw": Flight(BodyState((0.0, 0.0, 1.0), pivot_m=0.2), (2.0, 1.0, 4.0), 0.0, 0.6, 0.3, 3.0),
    "swing": Swing((0.0, 0.0, 1.0), 1.2, 0.5),
    "hover": hover(Stationary((0.0, 0.0, 2.0)), 0.2, 0.4),
    "sway": Oscillating(Stationary((0.0, 0.0, 0.0)), (Wave("roll", 0.2, 0.5),)),
    "riding": Riding(STRAIGHT, (0.0, 0.0, 1.0)),
}
TIMES = np.linspace(0.0, 6.0, 1201)


@pytest.mark.parametrize("name", TRAJECTORIES)
def test_a_body_never_jumps(name):
    maps = np.array([TRAJECTORIES[name].at(float(t)).to_world() for t in TIMES])
    step = float(TIMES[1] - TIMES[0])
    assert np.abs(np.diff(maps, axis=0)).max() / step < 14.0


@pytest.mark.parametrize("name", TRAJECTORIES)
def test_distance_never_falls_and_matches_the_path_on_the_ground(name):
    states = [TRAJECTORIES[name].at(float(t)) for t in TIMES]
    distance = np.array([state.distance_m for state in states])
    assert np.all(np.diff(distance) >= -1e-12)
    if name in ("straight", "rolling", "shuttle", "circle", "bounce", "throw"):
        ground = np.array([state.position[:2] for state in states])
        path = np.hypot(*np.diff(ground, axis=0).T).sum()
        assert distance[-1] - distance[0] == pytest.approx(path, rel=1e-3)


def test_a_rolling_ball_does_not_slide():
    """The point that touches the ground stands still: v = ω r."""
    ball = TRAJECTORIES["rolling"]
    before, after = ball.at(1.0).to_world(), ball.at(1.0 + 1e-6).to_world()
    lowest = np.linalg.inv(before[:, :3]) @ (
        np.array([ball.at(1.0).position[0], 0.0, 0.0]) - before[:, 3]
    )
    touched = after[:, :3] @ lowest + after[:, 3]
    np.testing.assert_allclose(touched, before[:, :3] @ lowest + before[:, 3], atol=1e-9)


def test_a_bouncing_ball_falls_freely_and_keeps_its_restitution():
    landing = math.sqrt(2.0 * 1.25 / GRAVITY_M_S2)

    def height(rounds: float) -> float:
        return bounce_height(1.25, 0.0, 0.8, landing * rounds)

    assert height(0.5) == pytest.approx(1.25 * 0.75)
    assert height(1.0) == pytest.approx(0.0, abs=1e-12)
    assert height(1.8) == pytest.approx(0.64 * 1.25)
    assert height(1.0 + 1.6 + 0.64) == pytest.approx(0.64**2 * 1.25)
    assert height(200.0) == 0.0


def test_an_arc_goes_from_one_state_to_the_other_under_gravity():
    start = BodyState((0.0, 0.0, 1.0), 0.2, pivot_m=0.1)
    end = BodyState((2.0, -1.0, 1.5), 1.0, 0.3, pivot_m=0.1)
    arc = Arc(start, end, 0.4, 1.2, 1.0)
    for state, time_s in ((start, 0.4), (end, 1.2)):
        np.testing.assert_allclose(arc.at(time_s).to_world(), state.to_world(), atol=1e-12)
    heights = [arc.at(time_s).position[2] for time_s in (0.5, 0.6, 0.7)]
    assert np.diff(heights, 2) == pytest.approx(-GRAVITY_M_S2 * 0.01)


def test_a_pendulum_has_the_period_of_its_length():
    swing = Swing((0.0, 0.0, 1.0), 1.5, 0.3)
    period = 2.0 * math.pi * math.sqrt(1.5 / GRAVITY_M_S2)
    assert swing.at(0.0).pitch == pytest.approx(0.3)
    assert swing.at(0.5 * period).pitch == pytest.approx(-0.3)
    top = np.array([0.0, 0.0, 1.5, 1.0])
    np.testing.assert_allclose(swing.at(0.7).to_world() @ top, [0.0, 0.0, 2.5], atol=1e-12)
