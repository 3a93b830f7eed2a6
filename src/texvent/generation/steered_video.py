"""Videos that follow a scene: frames of a model, with the motion and the truth of the scene."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import KW_ONLY, dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from texvent.frames import Frame, FrameStream, MotionVectors, frame_time_us
from texvent.generation.videos.stored_video import FinishedVideo

if TYPE_CHECKING:
    from texvent.camera import PosedCamera
    from texvent.ground_truth import GroundTruth


@dataclass(frozen=True, eq=False, repr=False)
class SteeredVideo(FinishedVideo):
    """A finished video of a scene: every frame carries the scene's motion to its neighbours.

    Its truth is the scene's. What is between two frames is not rendered, but moved along the
    motion: the scene looks otherwise.
    """

    _: KW_ONLY
    video: FrameStream
    """The model's frames, at the times and of the size of the scene's."""
    scene: Any
    """The rendered scene."""

    @property
    def plain(self) -> FrameStream:
        """The model's frames alone, where the motion is not needed."""
        return self.video

    def __iter__(self) -> Iterator[Frame]:
        """The frames with their motion."""
        for index, frame in enumerate(self.video):
            yield replace(frame, motion=self._motion(index))

    def _motion(self, index: int) -> MotionVectors:
        """Motion of a frame to its neighbours, and its depth."""
        before_us, t_us, after_us = (
            frame_time_us(index + step, self.scene.fps) for step in (-1, 0, 1)
        )
        is_last = index == self.frame_count - 1
        after = self.ground_truth(t_us, t_us if is_last else after_us)
        back = self.ground_truth(t_us, before_us).flow if index else None
        forward = None if is_last else after.flow
        return MotionVectors(forward, back, after.depth, after.instance)

    def ground_truth(self, t0_us: int, t1_us: int) -> GroundTruth:
        """Ground truth of the scene at `t0_us`, and the motion from there to `t1_us`."""
        truth: GroundTruth = self.scene.ground_truth(t0_us, t1_us)
        return truth

    def instances_at(
        self, t_us: int, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Depth in metres and instance id, [k], at the image points [k, 2] (x, y), pixels."""
        depth, instance = self.scene.instances_at(t_us, points)
        return depth, instance

    def camera_at(self, t_us: int) -> PosedCamera:
        """The camera at `t_us`."""
        camera: PosedCamera = self.scene.camera_at(t_us)
        return camera

    @property
    def class_names(self) -> Mapping[int, str]:
        """Instance id → noun."""
        names: Mapping[int, str] = self.scene.class_names
        return names

    @property
    def object_ids(self) -> Mapping[int, str]:
        """Instance id → id of the object in the scene."""
        ids: Mapping[int, str] = getattr(self.scene, "object_ids", {})
        return ids
