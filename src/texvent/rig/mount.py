"""The scene as one camera of a rig sees it, and the rig's body along the scene's camera path."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError
from texvent.rig.description import Float64Array, RigCamera
from texvent.scenes.lens import Lens
from texvent.scenes.scene import Camera, Environment, Primitives, Scene


@dataclass(frozen=True, eq=False)
class MountedScene:
    """A scene seen by one camera of a rig, whose first camera follows the scene's camera path."""

    scene: Scene
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

    def camera(self, time_s: float) -> Camera:
        """This camera at that instant."""
        first = self.scene.camera(time_s)
        turn, shift = self.mount.from_first[:3, :3], self.mount.from_first[:3, 3]
        place = first.position - first.rotation.T @ (turn.T @ shift)
        lens = self.mount.lens
        focal = first.focal if lens is None else lens.fx / self.mount.size.width
        return Camera(np.asarray(place), np.asarray(turn @ first.rotation), focal, lens)


def path_lens(scene: Scene, camera: RigCamera, duration_s: float) -> Lens:
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
    scene: Scene, first_from_imu: Float64Array, t_s: NDArray[Any]
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
