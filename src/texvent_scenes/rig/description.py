"""Rig: cameras with lenses and mounts, an IMU, and the scene as they see it.

Frames of reference are right-handed. A camera's x points right, its y down, its z along the optical
axis. The IMU's axes are those of the first camera unless the rig says otherwise. A [4, 4] map
`a_from_b` turns coordinates in b into coordinates in a, metres.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.camera import PosedCamera
from texvent.errors import ConfigError
from texvent.lens import Lens
from texvent.options.values import option_names
from texvent.sensor import SensorSize
from texvent_scenes.rendered_scene import Environment, Primitives, RenderedScene

Float64Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RigCamera:
    """One camera of a rig."""

    name: str
    """Such as cam0; names its files and topics, and with the run's seed its pixels' seed."""
    size: SensorSize
    """Pixels."""
    lens: Lens | None
    """Intrinsics and distortion; None: the pinhole that the scene's own camera is."""
    from_first: Float64Array = field(default_factory=lambda: np.eye(4))
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


NOISE_NAMES = option_names(ImuNoise)
"""Kalibr knows the densities by the same names."""
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
    first_from_imu: Float64Array = field(default_factory=lambda: np.eye(4))
    """[4, 4] coordinates in the IMU → coordinates in the first camera."""


@dataclass(frozen=True, eq=False)
class MountedScene:
    """A scene seen by one camera of a rig, whose first camera follows the scene's camera path."""

    scene: RenderedScene
    mount: RigCamera

    def primitives(self, time_s: float) -> Primitives:
        """All shapes at that instant."""
        return self.scene.primitives(time_s)

    def environment(self, time_s: float) -> Environment:
        """Surroundings and light at that instant."""
        return self.scene.environment(time_s)

    @property
    def class_names(self) -> dict[int, str]:
        """Instance id → noun."""
        return self.scene.class_names

    @property
    def object_ids(self) -> Mapping[int, str]:
        """Instance id → id of the object in the scene."""
        ids: Mapping[int, str] = getattr(self.scene, "object_ids", {})
        return ids

    def camera(self, time_s: float) -> PosedCamera:
        """This camera at that instant."""
        first = self.scene.camera(time_s)
        turn, shift = self.mount.from_first[:3, :3], self.mount.from_first[:3, 3]
        place = first.position - first.rotation.T @ (turn.T @ shift)
        lens = self.mount.lens
        focal = first.focal if lens is None else lens.fx / self.mount.size.width
        return PosedCamera(np.asarray(place), np.asarray(turn @ first.rotation), focal, lens)


def path_lens(scene: RenderedScene, camera: RigCamera, duration_s: float) -> Lens:
    """The lens of a camera, or what the scene's own camera is where the rig states none.

    Raises:
        ConfigError: the scene's camera zooms: no calibration holds for the whole recording.
    """
    focal = [scene.camera(share * duration_s).focal for share in (0.0, 0.31, 0.5, 0.77, 1.0)]
    if max(focal) - min(focal) > 1e-9 * max(focal):
        raise ConfigError(
            "the camera zooms, but a calibrated camera has one focal length; ask for 'dolly in' "
            "instead of 'zoom in', or leave the zoom out of the prompt"
        )
    if camera.lens is not None:
        return camera.lens
    pixels = focal[0] * camera.size.width
    return Lens(pixels, pixels, 0.5 * camera.size.width, 0.5 * camera.size.height)


def body_poses(
    scene: RenderedScene, first_from_imu: Float64Array, t_s: NDArray[Any]
) -> tuple[Float64Array, Float64Array]:
    """Poses of a body along the scene's camera path.

    Args:
        scene: the scene.
        first_from_imu: [4, 4] coordinates in the IMU → coordinates in the first camera.
        t_s: [n] instants, s.

    Returns:
        ([n, 3] position in the world, m, [n, 3, 3] rotation from the IMU to the world).
    """
    cameras = [scene.camera(float(time)) for time in t_s]
    to_world = np.array([camera.rotation.T for camera in cameras]).reshape(-1, 3, 3)
    places = np.array([camera.position for camera in cameras]).reshape(-1, 3)
    turn, shift = first_from_imu[:3, :3], first_from_imu[:3, 3]
    return places + to_world @ shift, np.asarray(to_world @ turn)
