"""Brightness changes between latents, and the events that they give."""

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
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulate.packets import FrameInterval, make_packet
from texvent.simulate.random.draws import frame_key
from texvent.simulate.v2ce.ldati import sample_events
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


Float64Array = NDArray[np.float64]


def sample_packets(
    change: BrightnessChange, *, contrast_threshold: float = 0.2, seed: int = 0
) -> Iterator[EventStream]:
    """Events of each interval.

    Args:
        change: what the pixels see.
        contrast_threshold: δ, log units.
        seed: of the random draws, 0..2⁶³−1.

    Yields:
        Packets in time order, a packet per latent frame after the first.

    Raises:
        ConfigError: the threshold or the seed is out of range.
    """
    check_range("contrast_threshold", contrast_threshold, 0.01, 10.0)
    check_range("seed", seed, 0, 2**63 - 1)
    bounds_us = change.edges_us[:: change.voxels.shape[1]].tolist()
    distance = np.zeros(change.voxels.shape[2:])
    for number, voxels in enumerate(change.voxels):
        start_us, stop_us = bounds_us[number : number + 2]
        interval = FrameInterval(start_us, stop_us, frame_key(seed, stop_us))
        grid, distance = node_grid(voxels, distance, contrast_threshold)
        yield make_packet(sample_events(grid, interval), interval, change.size)


def node_grid(
    voxels: NDArray[np.float32], distance: Float64Array, contrast_threshold: float
) -> tuple[Float64Array, Float64Array]:
    """The grid that LDATI takes, from the changes of one interval.

    Args:
        voxels: changes, [B, H, W], log units.
        distance: from the brightness at each pixel's last event, [H, W], within ± δ.
        contrast_threshold: δ, log units.

    Returns:
        Events per node, ON first, then OFF, [2, B + 1, H, W], and the distance at the end.
    """
    grid = np.zeros((2, len(voxels) + 1, *voxels.shape[1:]))
    # In units of δ: n events move the reference by n.
    distance = distance / contrast_threshold
    for node, change in enumerate(voxels / np.float64(contrast_threshold)):
        counts = np.trunc(distance + change)
        n, along = np.abs(counts), distance * np.sign(change)
        with np.errstate(divide="ignore", invalid="ignore"):
            late = np.where(n > 0, (n * (n + 1) / 2 - n * along) / np.abs(change), 0.0)
        for polarity, fired in enumerate((counts > 0, counts < 0)):
            grid[polarity, node] += np.where(fired, n - late, 0.0)
            grid[polarity, node + 1] += np.where(fired, late, 0.0)
        distance = distance + change - counts
    return grid, distance * contrast_threshold
