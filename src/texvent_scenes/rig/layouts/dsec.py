"""Layout dsec: a stereo pair as a sequence of DSEC.

    events/left/events.h5, rectify_map.h5                raw events, and where they are rectified
    images/left/rectified/000000.png                     frames, rectified
    images/left/exposure_timestamps.txt, images/timestamps.txt    µs
    disparity/event/000000.png, disparity/timestamps.txt          true, ×256, 16 bits, every 100 ms
    calibration/cam_to_cam.yaml
    ... and right; imu.csv, poses.txt, calib.yaml, imu.yaml, rig.json, which DSEC does not have

DSEC has four cameras: event cameras 0 and 3, frame cameras 1 and 2. Here a frame camera is the
event camera beside it, so T_10 and T_32 are identities. Disparity is that of the scene, seen in
the rectified left event camera; 0 is unknown (sky, or less than half a step of 1/256 px).

Rectification gives two virtual pinholes in which matching points are in one row.

Sources: Fusiello, Trucco and Verri, A compact algorithm for rectification of stereo pairs, 2000;
Gehrig et al., DSEC: A Stereo Event Camera Dataset for Driving Scenarios, RA-L 2021, and its
description of files.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from texvent.errors import ConfigError
from texvent.frames import MICROSECONDS
from texvent.lens import HALF_PIXEL, Lens, distort, normalised
from texvent.runtime.progress import Progress
from texvent.sensor import SensorSize
from texvent.truth.sinks import write_png
from texvent_scenes.rig.description import Float64Array, RigCamera
from texvent_scenes.rig.layouts.parts import (
    Tally,
    counted_frames,
    intrinsic_values,
    write_calibration,
    write_euroc_imu,
    write_events,
    write_tum,
)
from texvent_scenes.rig.recording import Recording


@dataclass(frozen=True, eq=False)
class Rectified:
    """The pair of pinholes; both have `lens` and the first's size."""

    lens: Lens
    size: SensorSize
    turns: tuple[Float64Array, Float64Array]
    """[3, 3] each: coordinates in a camera → in its rectified one."""
    baseline_m: float


def rectify(first: RigCamera, second: RigCamera) -> Rectified:
    """The rectified pair of two cameras, whose lenses are known.

    Raises:
        ConfigError: they stand at one place, or one before the other.
    """
    to_first = np.linalg.inv(second.from_first @ np.linalg.inv(first.from_first))
    baseline = to_first[:3, 3]
    length = float(np.linalg.norm(baseline))
    if length < 1e-6 or baseline[0] < 0.5 * length:
        raise ConfigError(
            f"{second.name} must stand to the right of {first.name}; it is at "
            f"({', '.join(f'{one:.3g}' for one in baseline)}) m"
        )
    across = baseline / length
    forward = np.array([0.0, 0.0, 1.0]) + to_first[:3, 2]
    down = np.cross(forward, across)
    down /= np.linalg.norm(down)
    turn = np.stack([across, down, np.cross(across, down)])
    turns = (turn, np.asarray(turn @ to_first[:3, :3]))
    middle = []
    for camera, own in zip((first, second), turns, strict=True):
        centre = np.array([0.5 * camera.size.width, 0.5 * camera.size.height])
        seen = own @ np.append(normalised(_lens(camera), centre), 1.0)
        middle.append(seen[:2] / seen[2])
    focal = 0.25 * sum(_lens(one).fx + _lens(one).fy for one in (first, second))
    x, y = (float(one) for one in np.mean(middle, axis=0))
    size = first.size
    lens = Lens(focal, focal, 0.5 * size.width - focal * x, 0.5 * size.height - focal * y)
    return Rectified(lens, size, turns, length)


def rectified_points(pair: Rectified, number: int, camera: RigCamera) -> Float64Array:
    """[H, W, 2] where each pixel's middle of a raw image lies in the rectified one, our pixels."""
    rows, columns = np.indices(camera.size.shape) + 0.5
    plane = normalised(_lens(camera), np.stack([columns, rows], axis=-1))
    seen = np.concatenate([plane, np.ones((*plane.shape[:2], 1))], axis=-1) @ pair.turns[number].T
    lens = pair.lens
    return np.asarray(seen[..., :2] / seen[..., 2:] * lens.fx + [lens.cx, lens.cy])


def raw_points(pair: Rectified, number: int, camera: RigCamera) -> Float64Array:
    """[H, W, 2] where each pixel's middle of a rectified image lies in the raw one; may be NaN."""
    rows, columns = np.indices(pair.size.shape) + 0.5
    plane = (np.stack([columns, rows], axis=-1) - [pair.lens.cx, pair.lens.cy]) / pair.lens.fx
    seen = np.concatenate([plane, np.ones((*plane.shape[:2], 1))], axis=-1) @ pair.turns[number]
    lens = _lens(camera)
    placed = distort(lens, seen[..., :2] / seen[..., 2:])
    return np.asarray(placed * [lens.fx, lens.fy] + [lens.cx, lens.cy])


def rectified_camera(pair: Rectified, number: int, camera: RigCamera) -> RigCamera:
    """The virtual pinhole, as a camera of the rig."""
    turn = np.eye(4)
    turn[:3, :3] = pair.turns[number]
    return RigCamera(f"{camera.name}_rect", pair.size, pair.lens, turn @ camera.from_first)


def _lens(camera: RigCamera) -> Lens:
    if camera.lens is None:
        raise ConfigError(f"{camera.name} has no lens; the rig is not resolved")
    return camera.lens


SIDES = ("left", "right")
DISPARITY_EVERY_US = 100_000
DISPARITY_SCALE = 256.0
EXPOSURE_HEADER = "# exposure_start_timestamp_us, exposure_end_timestamp_us\n"


def check(recording: Recording) -> None:
    """Refuse rigs that are no stereo pair.

    Raises:
        ConfigError: there are not two cameras of one size, the second right of the first.
    """
    cameras = recording.rig.cameras
    if len(cameras) != 2 or cameras[0].size != cameras[1].size:
        sizes = ", ".join(str(camera.size) for camera in cameras)
        raise ConfigError(
            f"layout dsec is for two cameras of one size; this rig has {sizes}; give --stereo "
            "0.12, or choose layout hdf5"
        )
    rectify(*cameras)


def write(recording: Recording, folder: Path, tally: Tally, progress: Progress) -> None:
    """Everything but `rig.json`."""
    first, second = recording.rig.cameras
    pair = rectify(first, second)
    for number, (side, camera) in enumerate(zip(SIDES, (first, second), strict=True)):
        place = folder / "events" / side
        path = place / "events.h5"
        write_events(recording, camera, path, format="dsec", tally=tally, progress=progress)
        points = rectified_points(pair, number, camera) - HALF_PIXEL
        _write_map(place / "rectify_map.h5", points)
        if recording.config.frames is not None:
            images = folder / "images" / side
            _write_images(recording, (pair, number), images, tally, progress)
    write_disparity(recording, pair, folder / "disparity")
    calibration = folder / "calibration"
    calibration.mkdir()
    text = yaml.safe_dump(_cam_to_cam(first, second, pair), default_flow_style=None, width=120)
    (calibration / "cam_to_cam.yaml").write_text(text, encoding="utf-8")
    if recording.imu is not None:
        write_euroc_imu(folder / "imu.csv", recording.imu)
    write_tum(folder / "poses.txt", recording.pose_times, recording.poses())
    write_calibration(recording, folder)


def _write_map(path: Path, points: Float64Array) -> None:
    import h5py

    with h5py.File(path, "w") as file:
        file.create_dataset("rectify_map", data=points.astype(np.float32), compression="gzip")


def _write_images(
    recording: Recording,
    of: tuple[Rectified, int],
    folder: Path,
    tally: Tally,
    progress: Progress,
) -> None:
    """The rectified frames of one camera."""
    import cv2

    from texvent.view.drawing.canvas import png_bytes

    pair, number = of
    camera = recording.rig.cameras[number]
    (folder / "rectified").mkdir(parents=True)
    place = np.nan_to_num(raw_points(pair, number, camera) - HALF_PIXEL, nan=-1e4)
    columns, rows = place[..., 0].astype(np.float32), place[..., 1].astype(np.float32)
    exposures, times = [EXPOSURE_HEADER], []
    for index, frame in enumerate(counted_frames(recording, camera, tally, progress)):
        image = cv2.remap(frame.pixels, columns, rows, interpolation=cv2.INTER_LINEAR)
        (folder / "rectified" / f"{index:06d}.png").write_bytes(png_bytes(np.asarray(image)))
        first_us, last_us = frame.first_row_s * MICROSECONDS, frame.end_s * MICROSECONDS
        exposures.append(f"{round(first_us)}, {round(last_us)}\n")
        times.append(f"{frame.t_us}\n")
    (folder / "exposure_timestamps.txt").write_text("".join(exposures), encoding="utf-8")
    (folder.parent / "timestamps.txt").write_text("".join(times), encoding="utf-8")


def write_disparity(recording: Recording, pair: Rectified, folder: Path) -> None:
    """Disparity from the scene's depth in the rectified left camera."""
    from texvent_scenes.raycast.ground_truth import ground_truth

    scene = recording.scene_of(rectified_camera(pair, 0, recording.rig.cameras[0]))
    (folder / "event").mkdir(parents=True)
    times = range(0, recording.stop_us + 1, DISPARITY_EVERY_US)
    for number, t_us in enumerate(times):
        time_s = t_us / MICROSECONDS
        depth = ground_truth(scene, time_s, time_s, pair.size).depth.astype(np.float64)
        disparity = pair.lens.fx * pair.baseline_m / depth
        levels = np.clip(np.round(disparity * DISPARITY_SCALE), 0, 65_535).astype(np.uint16)
        write_png(folder / "event" / f"{number:06d}.png", levels)
    text = "".join(f"{t_us}\n" for t_us in times)
    (folder / "timestamps.txt").write_text(text, encoding="utf-8")


def _cam_to_cam(first: RigCamera, second: RigCamera, pair: Rectified) -> dict[str, Any]:
    """DSEC's cam_to_cam.yaml."""
    cameras, turns = (first, first, second, second), (0, 0, 1, 1)
    pinhole = list(pair.lens.intrinsics)
    intrinsics: dict[str, Any] = {}
    for number, camera in enumerate(cameras):
        model, coefficients, matrix = intrinsic_values(camera)
        intrinsics[f"cam{number}"] = {
            "camera_matrix": matrix,
            "camera_model": "pinhole",
            "distortion_coeffs": coefficients,
            "distortion_model": model,
            "resolution": list(camera.size),
        }
        intrinsics[f"camRect{number}"] = {
            "camera_matrix": pinhole,
            "camera_model": "pinhole",
            "resolution": list(pair.size),
        }
    to_right = second.from_first @ np.linalg.inv(first.from_first)
    extrinsics = {f"R_rect{number}": pair.turns[turn].tolist() for number, turn in enumerate(turns)}
    extrinsics |= {"T_10": _rows(np.eye(4)), "T_21": _rows(to_right), "T_32": _rows(np.eye(4))}
    to_depth = np.array(
        [
            [1.0, 0.0, 0.0, -pinhole[2]],
            [0.0, 1.0, 0.0, -pinhole[3]],
            [0.0, 0.0, 0.0, pinhole[0]],
            [0.0, 0.0, 1.0 / pair.baseline_m, 0.0],
        ]
    )
    return {
        "disparity_to_depth": {"cams_03": _rows(to_depth), "cams_12": _rows(to_depth)},
        "extrinsics": extrinsics,
        "intrinsics": intrinsics,
    }


def _rows(matrix: NDArray[Any]) -> list[list[float]]:
    return [[float(one) for one in row] for row in matrix]
