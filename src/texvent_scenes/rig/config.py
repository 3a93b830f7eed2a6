"""Options of `texvent rig`: cameras, frames, IMU, layout."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import ClassVar, Literal

from texvent.config import FPS_RANGE, IdleOptions, check_range
from texvent.errors import ConfigError, shown
from texvent.truth.layout import parse_parts

MOST_BASELINE_M = 100.0
IMU_RATE_HZ = (1.0, 1000.0)

Layout = Literal["hdf5", "dsec", "rosbag1", "mcap"]


@dataclass(frozen=True, kw_only=True)
class RigConfig:
    """The cameras, their frames, and the IMU."""

    idle_with: ClassVar[IdleOptions] = {
        "readout": ("shutter", ("global",)),
        "imu_noise": ("imu", (None,)),
    }

    rig: Path | None = None
    """YAML or TOML file of cameras as Kalibr's camchain.yaml has them: resolution, intrinsics,
    distortion, places (docs/rigs.md). Without it, and without --stereo: one camera."""
    stereo: float | None = None
    """Two like cameras, the second this far to the right of the first, m."""
    frames: Fraction | None = None
    """Frames per second beside the events; without it there are none."""
    exposure: float = 0.0
    """Exposure time of each frame, or of each of its rows, s; moving objects are blurred."""
    shutter: Literal["global", "rolling"] = "global"
    """Global: all rows are exposed at once; rolling: one after the other, from the top."""
    readout: float = 0.01
    """Rolling shutter: from the first row to the last, in seconds (not measured on any sensor)."""
    imu: float | None = None
    """Samples per second of an IMU, at most 1000; without it there is none."""
    imu_noise: str = "adis16448"
    """Noise of the IMU: adis16448 (EuRoC's), none, or a file as Kalibr's imu.yaml. What a rig file
    states under imu0 comes before the default."""
    layout: Layout = "hdf5"
    """Layout of the folder: hdf5 (a file per camera), dsec, rosbag1 or mcap."""
    truth: str = ""
    """Layout hdf5: ground truth of each camera, in cam0/truth/: flow, depth, ids, boxes,
    poses, events, with commas between, or all (docs/truth.md)."""

    def __post_init__(self) -> None:
        if parse_parts(self.truth) and self.layout != "hdf5":
            raise ConfigError(
                f"truth is written beside layout hdf5, not {self.layout}; leave one of them out"
            )
        check_range("stereo", self.stereo, 1e-4, MOST_BASELINE_M)
        check_range("frames", self.frames, *FPS_RANGE)
        check_range("exposure", self.exposure, 0.0, 1.0)
        check_range("readout", self.readout, 0.0, 1.0)
        check_range("imu", self.imu, *IMU_RATE_HZ)
        if self.rig is not None and self.stereo is not None:
            raise ConfigError("rig and stereo both say where the cameras are; give one of them")
        if self.frames is None and (self.exposure > 0.0 or self.shutter != "global"):
            raise ConfigError("exposure and shutter are those of frames; say how many: frames = 30")
        times = {"exposure": self.exposure}
        if self.shutter == "rolling":
            times["readout"] = self.readout
        for name, value in times.items():
            if self.frames is not None and value > 1 / self.frames:
                raise ConfigError(
                    f"{name} is {value:g} s, longer than the {float(1 / self.frames):.4g} s from "
                    f"frame to frame at {float(self.frames):g} per second"
                )


def check_generator(name: str | None) -> None:
    """Refuse generators whose videos are seen from one place only.

    Raises:
        ConfigError: it is not the embedded one.
    """
    if name != "procedural":
        raise ConfigError(
            "a rig needs a scene that can be seen from several places; generator "
            f"{shown(name)} makes videos, so use the embedded one (procedural)"
        )
