"""A stated camera pose is where all moves begin, straight down too; the report tells both ends."""

import itertools
import math
import re

import numpy as np
import pytest
from tests.scenes.every_row import for_every
from tests.scenes.staged import stage, thing

from texvent_scenes.spec.scene import Camera, CameraMove
from texvent_scenes.staging.idle_fields import DIRECTIONS_OF_MOVES

POSES = {
    "level": ((1.7, -6.0, 1.3), (1.7, 30.0, 1.3)), "aslant": ((-3.0, -4.0, 2.0), (0.5, 0.0, 0.4)),
    "down": ((0.5, 0.2, 6.0), (0.5, 0.2, 0.0)), "nearly down": ((0.0, -0.1, 8.0), (0.0, 0.0, 0.0)),
    "up": ((0.0, 0.0, 0.5), (0.0, 0.0, 9.0)),
}  # fmt: skip
TIMES = [{}, {"start_s": 0.0}, {"start_s": 0.5}, {"duration_s": 1.0},
         {"start_s": 0.3, "duration_s": 0.9}, {"phase": 1}]  # fmt: skip
RATES = {"dolly": "speed_m_s", "truck": "speed_m_s", "pedestal": "speed_m_s"}
MOVES = [(kind, way) for kind, ways in DIRECTIONS_OF_MOVES.items() if kind != "travel"
         for way in ways]  # fmt: skip


def film(pose, *moves):
    position, goal = POSES[pose]
    shot = Camera(moves, position_m=position, look_at_m=goal, field_of_view_deg=60.0)
    return stage(thing("mug"), camera=shot)


@for_every(itertools.product(POSES, MOVES, TIMES, (None, 0.4)))
def test_every_move_begins_at_the_stated_pose(row):
    pose, (kind, direction), times, rate = row
    stated = {RATES.get(kind, "rate_deg_s"): rate} if rate and kind != "handheld" else {}
    scene = film(pose, CameraMove(kind, direction, **times, **stated))
    camera, last = scene.camera(0.0), scene.camera(2.0)
    position, goal = POSES[pose]
    np.testing.assert_allclose(camera.position, position, atol=1e-9)
    way = np.subtract(goal, position)
    np.testing.assert_allclose(camera.rotation[2], way / np.linalg.norm(way), atol=1e-9)
    assert math.degrees(2.0 * math.atan(0.5 / camera.focal)) == pytest.approx(60.0)
    np.testing.assert_allclose(camera.rotation @ camera.rotation.T, np.eye(3), atol=1e-9)
    assert camera.rotation[0][2] == pytest.approx(0.0, abs=1e-9)  # the horizon is level
    moved = np.linalg.norm(np.array(last.position) - position)
    if kind in RATES and rate:
        begin_s = times.get("start_s", times.get("phase", 0) * 1.0)
        span_s = times.get("duration_s", 2.0 - begin_s)
        assert moved == pytest.approx(rate * span_s, abs=1e-6)
    (note,) = scene.camera_path.notes
    x, y, z = position
    assert note.startswith(f"the camera begins at ({x:g}, {y:g}, {z:g}) m, heading ")


@for_every(itertools.product(("down", "up"), ("pan", "tilt", "orbit", "roll"), (20.0, 60.0)))
def test_a_camera_that_looks_straight_down_or_up_turns_as_others_do(row):
    pose, kind, rate = row
    way = {"tilt": "up" if pose == "down" else "down"}.get(kind, "left")
    scene = film(pose, CameraMove(kind, way, rate_deg_s=rate))
    first, last = scene.camera(0.0), scene.camera(1.0)
    np.testing.assert_allclose(first.rotation[0], (1.0, 0.0, 0.0), atol=1e-9)
    axis = 0 if kind != "tilt" else 2
    turn = math.degrees(math.acos(min(first.rotation[axis] @ last.rotation[axis], 1.0)))
    assert turn == pytest.approx(rate, abs=1e-6)
    if kind != "tilt":
        np.testing.assert_allclose(last.rotation[2], first.rotation[2], atol=1e-9)


@for_every(itertools.product(POSES, ("left", "right"), (0.0, 25.0), (0.0, 40.0)))
def test_the_stated_heading_is_where_the_camera_looks_however_it_rolls(row):
    pose, way, roll_deg_s, pan_deg_s = row
    moves = [CameraMove("pan", way, rate_deg_s=pan_deg_s)] * (pan_deg_s > 0.0)
    moves += [CameraMove("roll", way, rate_deg_s=roll_deg_s)] * (roll_deg_s > 0.0)
    scene = film(pose, *moves or [CameraMove("dolly", "in", speed_m_s=0.1)])
    x, y, z = scene.camera(2.0).rotation[2]
    said = re.findall(r"heading ([\d.]+) degrees", scene.camera_path.notes[0])
    if abs(z) < 0.99:
        turn = float(said[-1]) - math.degrees(math.atan2(y, x))
        assert abs((turn + 180.0) % 360.0 - 180.0) < 0.06


def test_a_dolly_from_a_stated_pose_goes_on_past_the_point_that_it_looks_at():
    scene = film("aslant", CameraMove("dolly", "in", speed_m_s=8.0, start_s=0.5))
    first, last = scene.camera(0.0), scene.camera(2.0)
    np.testing.assert_allclose(last.position - first.position, 12.0 * first.rotation[2], atol=1e-9)
    np.testing.assert_allclose(last.rotation, first.rotation, atol=1e-9)
