"""Rig: cameras with lenses and mounts, and an IMU.

Frames of reference are right-handed. A camera's x points right, its y down, its z along the optical
axis. The IMU's axes are those of the first camera unless the rig says otherwise. A [4, 4] map
`a_from_b` turns coordinates in b into coordinates in a, metres.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.lens import Lens
from texvent.sensor import SensorSize

Float64Array = NDArray[np.float64]


def no_motion() -> Float64Array:
    """The [4, 4] map that changes nothing."""
    return np.eye(4)


@dataclass(frozen=True, eq=False)
class RigCamera:
    """One camera of a rig."""

    name: str
    """Such as cam0; names its files and topics, and with the run's seed its pixels' seed."""
    size: SensorSize
    """Pixels."""
    lens: Lens | None
    """Intrinsics and distortion; None: the pinhole that the scene's own camera is."""
    from_first: Float64Array = field(default_factory=no_motion)
    """[4, 4] coordinates in the first camera → coordinates in this one."""
    sensor: str | None = None
    """Name of its sensor, whose measured constants its pixels have where the simulator knows them;
    None: they are as the run's."""


@dataclass(frozen=True)
class ImuNoise:
    """Densities of an IMU's noise, as in Kalibr's imu.yaml."""

    accelerometer_noise_density: float = 0.0
    """White noise, m/s²/√Hz."""
    accelerometer_random_walk: float = 0.0
    """Random walk of the bias, m/s³/√Hz."""
    gyroscope_noise_density: float = 0.0
    """White noise, rad/s/√Hz."""
    gyroscope_random_walk: float = 0.0
    """Random walk of the bias, rad/s²/√Hz."""


NOISE_NAMES = (
    "accelerometer_noise_density",
    "accelerometer_random_walk",
    "gyroscope_noise_density",
    "gyroscope_random_walk",
)
"""Fields of `ImuNoise`, by which Kalibr knows them too."""
IMU_NOISES: dict[str, ImuNoise] = {
    "adis16448": ImuNoise(2.0e-3, 3.0e-3, 1.6968e-4, 1.9393e-5),
    "none": ImuNoise(),
}
"""Noise by name. adis16448: the IMU of EuRoC, as its sensor.yaml states it (Burri et al., IJRR
2016); users of that data often take them for any IMU of its class."""


@dataclass(frozen=True, eq=False)
class Rig:
    """Cameras on one rigid body, with one clock."""

    cameras: tuple[RigCamera, ...]
    """At least one; the first follows the scene's camera path."""
    first_from_imu: Float64Array = field(default_factory=no_motion)
    """[4, 4] coordinates in the IMU → coordinates in the first camera."""
