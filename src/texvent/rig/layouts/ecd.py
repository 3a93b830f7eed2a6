"""Layout ecd: a folder per camera in the text files of the Event Camera Dataset.

    cam0/events.txt         t x y p               cam0/calib.txt   fx fy cx cy k1 k2 p1 p2 k3
    cam0/images.txt         t file                cam0/images/frame_00000000.png (grey)
    cam0/imu.txt            t ax ay az gx gy gz   m/s², rad/s
    cam0/groundtruth.txt    t px py pz qx qy qz qw, of the camera
    calib.yaml, imu.yaml, rig.json

Times are seconds. Every camera's folder has the rig's only IMU.

Source: Mueggler et al., The Event-Camera Dataset and Simulator, IJRR 2017.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np

from texvent.brightness import luma_bt601
from texvent.errors import ConfigError
from texvent.rig.description import RigCamera
from texvent.rig.layouts.parts import (
    Tally,
    counted_frames,
    intrinsic_values,
    quaternions,
    write_calibration,
    write_events,
)
from texvent.rig.recording import Recording
from texvent.runtime.progress import Progress
from texvent.truth.poses import seconds_text


def check(recording: Recording) -> None:
    """Refuse lenses that calib.txt cannot hold.

    Raises:
        ConfigError: a lens is equidistant.
    """
    for camera in recording.rig.cameras:
        if camera.lens is not None and camera.lens.distortion == "equidistant":
            raise ConfigError(
                f"{camera.name} has an equidistant lens, and ecd's calib.txt knows radtan only; "
                "choose layout hdf5, dsec, rosbag1 or mcap"
            )


def write(recording: Recording, folder: Path, tally: Tally, progress: Progress) -> None:
    """Everything but `rig.json`."""
    for camera in recording.rig.cameras:
        own = folder / camera.name
        path = own / "events.txt"
        write_events(recording, camera, path, format="ecd", tally=tally, progress=progress)
        if recording.config.frames is not None:
            _write_images(recording, camera, own, tally, progress)
        _write_calibration(camera, own)
        _write_poses(recording, camera, own)
        _write_imu(recording, folder, own)
    write_calibration(recording, folder)


def _write_images(
    recording: Recording, camera: RigCamera, folder: Path, tally: Tally, progress: Progress
) -> None:
    from texvent.view.drawing.canvas import png_bytes  # brings OpenCV

    (folder / "images").mkdir()
    lines = []
    for number, frame in enumerate(counted_frames(recording, camera, tally, progress)):
        name = f"images/frame_{number:08d}.png"
        grey = np.asarray(np.round(luma_bt601(frame.pixels)), dtype=np.uint8)
        (folder / name).write_bytes(png_bytes(grey))
        lines.append(f"{seconds_text(frame.t_us)} {name}\n")
    (folder / "images.txt").write_text("".join(lines), encoding="utf-8")


def _write_calibration(camera: RigCamera, folder: Path) -> None:
    _, coefficients, intrinsics = intrinsic_values(camera)
    text = " ".join(f"{value:.9g}" for value in (*intrinsics, *coefficients, 0.0))
    (folder / "calib.txt").write_text(f"{text}\n", encoding="utf-8")


def _write_poses(recording: Recording, camera: RigCamera, folder: Path) -> None:
    place, turn = recording.poses(camera)
    rows = np.concatenate([place, quaternions(turn)], axis=1)
    with (folder / "groundtruth.txt").open("w", encoding="utf-8") as file:
        for time, row in zip(recording.pose_times, rows, strict=True):
            file.write(f"{seconds_text(int(time))} {' '.join(f'{one:.9f}' for one in row)}\n")


def _write_imu(recording: Recording, folder: Path, own: Path) -> None:
    imu = recording.imu
    if imu is None:
        return
    written = folder / recording.rig.cameras[0].name / "imu.txt"
    if written.exists():
        shutil.copy(written, own / "imu.txt")
        return
    with written.open("w", encoding="utf-8") as file:
        for time, force, rate in zip(imu.t_us, imu.acceleration, imu.rate, strict=True):
            values = " ".join(f"{one:.9g}" for one in (*force, *rate))
            file.write(f"{seconds_text(int(time))} {values}\n")
