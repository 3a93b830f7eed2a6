"""Stereo: pairs of events, matched by row and time alone, triangulate to the true depth."""

from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path

import cv2
import numpy as np
import pytest
from tests.scenes.hand_scenes import HandScene, MovingShape, day, still

from texvent._registry import SIMULATORS
from texvent.camera import PosedCamera, project
from texvent.errors import ConfigError
from texvent.lens import Lens
from texvent.runtime.progress import NO_PROGRESS
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent_scenes.procedural import ProceduralConfig, ProceduralVideo
from texvent_scenes.rendered_scene import Ground, Shape
from texvent_scenes.rig.config import RigConfig
from texvent_scenes.rig.description import ImuNoise, Rig, RigCamera
from texvent_scenes.rig.layouts.dsec import rectified_points, rectify, write_disparity
from texvent_scenes.rig.recording import Recording

SIZE = SensorSize(128, 76)
LEVEL = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
BASELINE = 0.2
SPEED_M_S = 4.0
DEPTHS = (2.0, 3.0, 5.0, 8.0)
"""Of four plates, one below the other, so that a row knows one depth."""
PLAIN = Lens(120.0, 120.0, 64.0, 38.0)
LEFT = Lens(112.0, 113.0, 62.5, 39.0, "radtan", (-0.2, 0.04, 1e-3, -5e-4))
RIGHT = Lens(100.0, 101.0, 65.0, 37.0, "equidistant", (0.01, -0.004, 0.0, 0.0))


def turned_in(degrees: float) -> np.ndarray:
    """First camera → one 0.2 m to its right that is turned to the left and rolled a little."""
    yaw, roll = np.radians(-degrees), np.radians(1.0)
    about_y = np.array([[np.cos(yaw), 0, np.sin(yaw)], [0, 1, 0], [-np.sin(yaw), 0, np.cos(yaw)]])
    about_z = np.array(
        [[np.cos(roll), -np.sin(roll), 0], [np.sin(roll), np.cos(roll), 0], [0, 0, 1]]
    )
    in_first = np.eye(4)
    in_first[:3, :3], in_first[:3, 3] = about_y @ about_z, (BASELINE, 0.004, -0.003)
    return np.linalg.inv(in_first)


PARALLEL = np.linalg.inv(np.block([[np.eye(3), np.array([[BASELINE], [0], [0]])], [0, 0, 0, 1.0]]))
RIGS = {
    "parallel": Rig((RigCamera("cam0", SIZE, PLAIN), RigCamera("cam1", SIZE, PLAIN, PARALLEL))),
    "lenses": Rig((RigCamera("cam0", SIZE, LEFT), RigCamera("cam1", SIZE, RIGHT, turned_in(4.0)))),
}


def plates() -> HandScene:
    """Four dark plates at their depths before an even sky, a camera sliding to the right."""
    grey, black = np.full(3, 0.4, dtype=np.float32), np.zeros(3, dtype=np.float32)
    sky = replace(day(Ground.NONE), sky_top=grey, sky_horizon=grey, ambient=black, sun_colour=black)
    shapes = []
    for number, depth in enumerate(DEPTHS):
        height = (1.5 - number) * 0.15 * depth
        shapes.append(
            MovingShape(
                Shape.BOX, (0.15 * depth, 1e-3, 0.05 * depth), still(0.0, depth, height),
                colour=(0.1, 0.1, 0.1), emission=1.0,
            )
        )  # fmt: skip

    def camera_at(time: float) -> PosedCamera:
        return PosedCamera(np.array([SPEED_M_S * (time - 0.05), 0.0, 0.0]), LEVEL, 1.0)

    return HandScene(tuple(shapes), camera_at, sky)


def record(rig: Rig) -> Recording:
    config = ProceduralConfig(fps=Fraction(100), duration=0.1, point_spread=0.0)
    video = ProceduralVideo(plates(), SIZE, config, {"generator": "procedural"})
    settings = resolve("generate", {"noise": "none", "sensor": "128x76"})
    return Recording(
        prompt="plates",
        settings=settings,
        config=RigConfig(),
        rig=rig,
        noise=ImuNoise(),
        video=video,
    )


@dataclass(frozen=True)
class Placed:
    """Events with their rectified places, in time order."""

    x: np.ndarray
    y: np.ndarray
    t: np.ndarray
    p: np.ndarray


def rectified_events(recording: Recording, number: int) -> Placed:
    camera = recording.rig.cameras[number]
    events = recording.simulation(camera, NO_PROGRESS).packets.collect()
    pair = rectify(*recording.rig.cameras)
    place = rectified_points(pair, number, camera)[events.y, events.x]
    return Placed(place[:, 0], place[:, 1], events.t, events.p)


def match(left: Placed, right: Placed, within_us: int) -> np.ndarray:
    """[k, 2] pairs: for each left event the right one of its row and polarity nearest in time."""
    pairs = []
    for index in range(len(left.t)):
        low = np.searchsorted(right.t, left.t[index] - within_us)
        high = np.searchsorted(right.t, left.t[index] + within_us)
        near = np.arange(low, high)
        fits = (np.abs(right.y[near] - left.y[index]) < 0.75) & (right.p[near] == left.p[index])
        if fits.any():
            chosen = near[fits]
            pairs.append((index, chosen[np.argmin(np.abs(right.t[chosen] - left.t[index]))]))
    return np.array(pairs)


@pytest.mark.long
@pytest.mark.parametrize("name", list(RIGS))
def test_triangulated_event_pairs_agree_with_depth_within_a_pixel(name: str) -> None:
    recording = record(RIGS[name])
    pair = rectify(*recording.rig.cameras)
    left, right = (rectified_events(recording, number) for number in (0, 1))
    pairs = match(left, right, within_us=9000)
    assert len(pairs) > 200
    disparity = left.x[pairs[:, 0]] - right.x[pairs[:, 1]]
    row = left.y[pairs[:, 0]]
    factor = pair.lens.fx * pair.baseline_m
    # Two events are half a pixel each from the edge they saw; rectified, pixels differ in size.
    steps = [
        np.diff(rectified_points(pair, number, camera)[..., 0], axis=1).max()
        for number, camera in enumerate(recording.rig.cameras)
    ]
    pixel, seen = float(np.mean(steps)), 0
    for number, depth in enumerate(DEPTHS):
        # The middle of each plate's rows; the one below begins 0.05 · focal length further.
        middle = pair.lens.cy - (1.5 - number) * 0.15 * pair.lens.fy
        own = np.abs(row - middle) < 0.035 * pair.lens.fy
        error = disparity[own] - factor / depth
        apart_s = np.abs(np.diff(np.stack([left.t[pairs[own, 0]], right.t[pairs[own, 1]]]), axis=0))
        moved = pair.lens.fx * SPEED_M_S / depth * apart_s[0] * 1e-6
        assert own.sum() > 20
        assert np.mean(np.abs(error) <= 1.0) > 0.95
        assert np.mean(np.abs(error) <= pixel + moved) > 0.995
        assert abs(error.mean()) < 0.25
        seen += int(own.sum())
    assert seen > 0.6 * len(pairs)


def test_rectified_points_of_a_world_point_lie_in_one_row_at_its_disparity() -> None:
    rig = RIGS["lenses"]
    pair = rectify(*rig.cameras)
    recording = record(rig)
    point = np.array([0.2, 4.0, 0.3])
    places = []
    for number, camera in enumerate(rig.cameras):
        mounted = recording.scene_of(camera).camera(0.05)
        raw = project(mounted, SIZE, point)[:2]
        grid = rectified_points(pair, number, camera)
        low = np.floor(raw - 0.5).astype(int)
        share = raw - 0.5 - low
        corners = grid[low[1] : low[1] + 2, low[0] : low[0] + 2]
        top, bottom = (corners[k, 0] * (1 - share[0]) + corners[k, 1] * share[0] for k in (0, 1))
        places.append(top * (1 - share[1]) + bottom * share[1])
    (x0, y0), (x1, y1) = places
    assert y0 == pytest.approx(y1, abs=0.01)
    turn = pair.turns[0] @ recording.scene_of(rig.cameras[0]).camera(0.05).rotation
    depth = float((turn @ point)[2])
    assert x0 - x1 == pytest.approx(pair.lens.fx * pair.baseline_m / depth, abs=0.02)


def test_disparity_images_hold_the_true_depth(tmp_path: Path) -> None:
    """In 1/256 px; the plates move out of the middle, so the first image shows them shifted."""
    recording = record(RIGS["parallel"])
    pair = rectify(*recording.rig.cameras)
    write_disparity(recording, pair, tmp_path)
    assert (tmp_path / "timestamps.txt").read_text() == "0\n100000\n"
    image = cv2.imread(str(tmp_path / "event" / "000000.png"), cv2.IMREAD_UNCHANGED)
    for number, depth in enumerate(DEPTHS):
        row = round(38.0 - (1.5 - number) * 0.15 * 120.0)
        column = round(64.0 + 120.0 * 0.05 * SPEED_M_S / depth)
        assert image[row, column] / 256.0 == pytest.approx(120.0 * BASELINE / depth, abs=0.01)
    assert image[0, 0] == 0


def test_a_pair_with_the_second_camera_on_the_left_is_refused() -> None:
    first, second = RIGS["parallel"].cameras
    with pytest.raises(ConfigError, match="cam0 must stand to the right of cam1"):
        rectify(second, first)


def test_each_camera_has_the_constants_of_its_sensor_and_the_options_given() -> None:
    davis, plain = "davis240c", RigCamera("cam1", SIZE, PLAIN, PARALLEL)
    rig = Rig((RigCamera("cam0", SIZE, PLAIN, sensor=davis), plain))
    options = {"simulator": "physical", "sensor": "davis346", "hot_pixel_fraction": 0.125}
    options["sensor_seed"] = 7
    recording = replace(record(rig), settings=resolve("generate", options))
    first, second = (
        recording.simulation(camera, NO_PROGRESS).settings for camera in recording.rig.cameras
    )
    assert (first.run.preset, second.run.preset) == ("davis240c", "davis346")
    assert (first.run.sensor, second.run.sensor) == ("davis240c", "128x76")
    assert first.simulate.hot_pixel_fraction == second.simulate.hot_pixel_fraction == 0.125
    presets = SIMULATORS.load("physical").presets
    own = first.simulate.sensor_seed
    expected = replace(presets["davis240c"], hot_pixel_fraction=0.125, sensor_seed=own)
    assert first.simulate == expected
    assert len({own, second.simulate.sensor_seed, 7}) == 3
