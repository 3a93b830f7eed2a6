"""How brightness changes between the latent frames of a video. Experimental.

A video autoencoder keeps one latent frame for r frames: latent frame 0 is frame 0, latent frame k
is frames (k − 1)·r + 1 .. k·r. Interval k − 1 lasts from frame (k − 1)·r to frame k·r and is cut
into B bins of equal length. The voxel of a bin is the signed change of brightness over it,

    c[k, b, y, x] = L(t[k, b + 1], y, x) − L(t[k, b], y, x),    L = ln(α + I)

in log units: ∂L/∂t times the length of the bin. I is luma on the 0..255 scale. A bin is as wide and
as high as a pixel of the decoded video, not of the latents.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.config import check_range
from texvent.errors import InputError
from texvent.sensor import SensorSize
from texvent.video import Frame, FrameStream, RenderableStream, frame_time_us

BALANCE = 30.0
"""α of the paper, on the 0..255 scale."""
WHITE = 255.0


@dataclass(frozen=True, eq=False)
class BrightnessChange:
    """Changes of brightness over a clip, and when they happen.

    Raises:
        InputError: the voxels have another shape.
    """

    voxels: NDArray[np.float32]
    """[K, B, H, W], log units: intervals, bins, rows, columns."""
    fps: Fraction
    """Rate of the frames."""
    frames_per_latent: int
    """r: frames of an interval."""
    balance: float = BALANCE
    """α."""

    def __post_init__(self) -> None:
        if self.voxels.ndim != 4 or 0 in self.voxels.shape:
            raise InputError(
                "changes must be [intervals, bins, H, W], each 1 or more; got shape "
                f"{list(self.voxels.shape)}"
            )

    @property
    def size(self) -> SensorSize:
        """Width and height, pixels."""
        return SensorSize(self.voxels.shape[3], self.voxels.shape[2])

    @property
    def edges_us(self) -> NDArray[np.int64]:
        """Bounds of all bins, µs, [K · B + 1]; the first frame is at 0."""
        intervals, bins = self.voxels.shape[:2]
        rate = self.fps * bins / self.frames_per_latent
        return np.array([frame_time_us(edge, rate) for edge in range(intervals * bins + 1)])

    def frames(self) -> Iterator[Frame]:
        """Grey frames that change as the voxels say, one per bound of a bin.

        Any pixel model takes them. All pixels begin white: changes do not tell the brightness. A
        pixel that falls below black stays black.

        Yields:
            Frames in time order, [H, W] float32, 0 and up; lighter than white is above 255.
        """
        intervals, bins, *shape = self.voxels.shape
        brightness = np.full(shape, np.log(self.balance + WHITE))
        steps = self.voxels.reshape(intervals * bins, *shape)
        for edge, t_us in enumerate(self.edges_us.tolist()):
            if edge:
                brightness += steps[edge - 1]
            luma = np.maximum(np.exp(brightness) - self.balance, 0).astype(np.float32)
            yield Frame(luma, t_us, is_source=True)


def measure_change(
    video: FrameStream, bins: int, *, frames_per_latent: int, balance: float = BALANCE
) -> BrightnessChange:
    """The true changes of a video that can be rendered at any instant.

    Frames after the last whole interval are left out.

    Args:
        video: such as the embedded generator makes.
        bins: B.
        frames_per_latent: r.
        balance: α.

    Raises:
        InputError: the video cannot be rendered between its frames, or is shorter than an interval.
    """
    check_range("bins", bins, 1, 1024)
    if not isinstance(video, RenderableStream) or video.fps is None or not video.frame_count:
        raise InputError(
            "brightness between frames is only known of scenes of the embedded generator; give "
            "prompts for it"
        )
    intervals = (video.frame_count - 1) // frames_per_latent
    if not intervals:
        raise InputError(
            f"the video has {video.frame_count} frames; a latent frame needs "
            f"{frames_per_latent + 1} or more"
        )
    rate = video.fps * bins / frames_per_latent
    before: NDArray[Any] | None = None
    steps = []
    for edge in range(intervals * bins + 1):
        after = balanced_log(video.at(frame_time_us(edge, rate)).luma, balance)
        if before is not None:
            steps.append((after - before).astype(np.float32))
        before = after
    voxels = np.stack(steps).reshape(intervals, bins, *steps[0].shape)
    return BrightnessChange(voxels, video.fps, frames_per_latent, balance)
