"""Files that several layouts share: events, frames, poses, the IMU, calibrations."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.frames import Frame
from texvent.options.values import plain
from texvent.pipeline import Simulation
from texvent.run.files import OnStep, RunFiles, write_run
from texvent.runtime.progress import Progress
from texvent.truth.layout import parse_parts
from texvent.truth.poses import POSE_HEADER, pose_row, quaternion
from texvent_scenes.rig.description import Rig, RigCamera
from texvent_scenes.rig.imu import ImuSamples
from texvent_scenes.rig.kalibr import camchain, camera_entries, imu_yaml
from texvent_scenes.rig.recording import Recording
from texvent_scenes.rig.shutter import ExposedFrame

CALIBRATION, IMU_NOISE, FACTS = "calib.yaml", "imu.yaml", "rig.json"
IMU_TOPIC = "/imu0"


@dataclass
class Tally:
    """Counts of written events and frames."""

    events: dict[str, int] = field(default_factory=dict)
    """Camera → events."""
    frames: dict[str, int] = field(default_factory=dict)
    """Camera → frames."""


def image_topic(camera: RigCamera) -> str:
    """Topic of a camera's frames, as Kalibr names it."""
    return f"/{camera.name}/image_raw"


def intrinsic_values(camera: RigCamera) -> tuple[str, list[float], list[float]]:
    """Distortion model, coefficients and fx, fy, cx, cy as calibration files have them."""
    entry = camera_entries(Rig((camera,)), {}, has_imu=False)["cam0"]
    return entry["distortion_model"], entry["distortion_coeffs"], entry["intrinsics"]


def counter(simulation: Simulation, camera: RigCamera, tally: Tally, progress: Progress) -> OnStep:
    """A function that counts every dense frame of a camera and the packet that ends at it."""
    tally.events[camera.name] = done = 0

    def count(frame: Frame, packet: EventStream) -> None:
        nonlocal done
        done += frame.is_source
        tally.events[camera.name] += len(packet)
        progress.advance(f"events of {camera.name}", done, simulation.video.frame_count)

    return count


def write_events(
    recording: Recording,
    camera: RigCamera,
    path: Path,
    *,
    format: str | None,
    tally: Tally,
    progress: Progress,
) -> None:
    """Simulate a camera into an event file with provenance; truth goes into `truth` beside it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    simulation = recording.simulation(camera, progress)
    files = RunFiles(path, format=format, truth=parse_parts(recording.config.truth))
    write_run(
        simulation,
        files,
        metadata={**simulation.provenance, "rig": recording.facts(camera)},
        on_step=counter(simulation, camera, tally, progress),
    )
    if files.truth_folder is not None:
        files.truth_folder.rename(path.parent / "truth")


def counted_frames(
    recording: Recording, camera: RigCamera, tally: Tally, progress: Progress
) -> Iterator[ExposedFrame]:
    """The frames of a camera, counted."""
    tally.frames[camera.name] = 0
    for frame in recording.frames(camera, progress):
        yield frame
        tally.frames[camera.name] += 1


def write_calibration(recording: Recording, folder: Path) -> None:
    """`calib.yaml` of the cameras, `imu.yaml` of the IMU, as Kalibr writes and reads them."""
    topics = {camera.name: image_topic(camera) for camera in recording.rig.cameras}
    rate = recording.config.imu
    text = camchain(recording.rig, topics, has_imu=rate is not None)
    (folder / CALIBRATION).write_text(text, encoding="utf-8")
    if rate is not None:
        text = imu_yaml(recording.noise, rate, IMU_TOPIC)
        (folder / IMU_NOISE).write_text(text, encoding="utf-8")


def write_facts(recording: Recording, folder: Path, tally: Tally) -> None:
    """`rig.json`: what made the recording, and which files belong to it."""
    files = sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
    first = recording.rig.cameras[0]
    facts = {
        **recording.provenance(),
        "rig": recording.facts(),
        "pixel_seeds": {one.name: recording.seed_of(one.name) for one in recording.rig.cameras},
        "events": tally.events,
        "frames": tally.frames,
        "clock": "all times count from the first frame of the simulation, t = 0",
        "axes": f"world: x right, y away, z up; cameras: x right, y down, z forward; the IMU's "
        f"place is T_cam_imu of {first.name} in calib.yaml (identity without one)",
        "files": [*files, FACTS],
    }
    (folder / FACTS).write_text(json.dumps(plain(facts), indent=1) + "\n", encoding="utf-8")


def write_tum(path: Path, t_us: NDArray[np.int64], poses: tuple[Any, Any]) -> None:
    """Poses to the world as rows `timestamp tx ty tz qx qy qz qw`, s and m (TUM's format)."""
    with path.open("w", encoding="utf-8") as file:
        file.write(POSE_HEADER)
        for time, place, turn in zip(t_us, *poses, strict=True):
            file.write(pose_row(int(time), place, turn))


def quaternions(rotations: NDArray[Any]) -> NDArray[Any]:
    """[n, 4] unit quaternions x y z w of rotations [n, 3, 3]."""
    return np.array([quaternion(one) for one in rotations]).reshape(-1, 4)


def write_euroc_imu(path: Path, imu: ImuSamples) -> None:
    """The IMU as rows `timestamp [ns], angular velocity, specific force` (EuRoC's data.csv)."""
    axes = [f"{kind}_RS_S_{axis} [{unit}]" for kind, unit in (("w", "rad s^-1"), ("a", "m s^-2"))
            for axis in "xyz"]  # fmt: skip
    with path.open("w", encoding="utf-8") as file:
        file.write("#timestamp [ns]," + ",".join(axes) + "\n")
        for time, rate, force in zip(imu.t_us, imu.rate, imu.acceleration, strict=True):
            values = ",".join(f"{one:.9g}" for one in (*rate, *force))
            file.write(f"{int(time) * 1000},{values}\n")
