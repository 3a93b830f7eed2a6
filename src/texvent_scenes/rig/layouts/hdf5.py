"""Layout hdf5: one HDF5 file of events per camera, frames as PNG, text for the rest.

cam0/events.h5          events, universal HDF5 (texvent.load)
cam0/frames/000000.png  frames; cam0/frames.csv their times, µs
cam1/...
imu.csv                 the IMU as in EuRoC's data.csv, ns
poses.txt               true poses of the IMU (without one: of the first camera), TUM, s
calib.yaml, imu.yaml    Kalibr's
rig.json                what made it
"""

from __future__ import annotations

from pathlib import Path

from texvent.runtime.progress import Progress
from texvent_scenes.rig.description import RigCamera
from texvent_scenes.rig.layouts.parts import (
    Tally,
    counted_frames,
    write_calibration,
    write_euroc_imu,
    write_events,
    write_tum,
)
from texvent_scenes.rig.recording import Recording

FRAME_COLUMNS = "file,t_us,first_row_start_us,row_us,exposure_us"


def check(recording: Recording) -> None:
    """Nothing to refuse."""


def write(recording: Recording, folder: Path, tally: Tally, progress: Progress) -> None:
    """Everything but `rig.json`."""
    for camera in recording.rig.cameras:
        path = folder / camera.name / "events.h5"
        write_events(recording, camera, path, format=None, tally=tally, progress=progress)
        if recording.config.frames is not None:
            _write_frames(recording, camera, path.parent, tally, progress)
    if recording.imu is not None:
        write_euroc_imu(folder / "imu.csv", recording.imu)
    write_tum(folder / "poses.txt", recording.pose_times, recording.poses())
    write_calibration(recording, folder)


def _write_frames(
    recording: Recording, camera: RigCamera, folder: Path, tally: Tally, progress: Progress
) -> None:
    from texvent.view.drawing.canvas import png_bytes  # brings OpenCV

    (folder / "frames").mkdir()
    lines = [FRAME_COLUMNS]
    for number, frame in enumerate(counted_frames(recording, camera, tally, progress)):
        name = f"frames/{number:06d}.png"
        (folder / name).write_bytes(png_bytes(frame.pixels))
        lines.append(
            f"{name},{frame.t_us},{frame.first_row_s * 1e6:.3f},{frame.row_s * 1e6:.6f},"
            f"{frame.exposure_s * 1e6:.3f}"
        )
    (folder / "frames.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
