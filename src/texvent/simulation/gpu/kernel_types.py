"""Arguments of the GPU kernels: tensors by name, in groups.

A group is one argument of a kernel. Tensors are on one device; an item that a model does not need
is None, and the kernel is then compiled without it. S is the number of segments, the intervals of
all clips, one clip after the other: clip · T + interval.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

Tensor: TypeAlias = Any
"""torch.Tensor; inside a kernel a Triton pointer."""


class FrameLayout(NamedTuple):
    """The frames of one call: T intervals per clip, each ending at a frame of `pixels`."""

    pixels: Tensor
    """[B, T, area] intensity, uint8 or float32; only the last axis must be contiguous."""
    previous: Tensor
    """[B, area] the frame before the first of them, same type."""
    clip_stride: int
    """Pixels from one clip to the next."""
    frame_stride: int
    """Pixels from one frame to the next."""
    intervals: int
    """T."""
    area: int
    """Pixels of a frame."""
    width: int
    """Pixels of a row."""


class Intervals(NamedTuple):
    """Every interval, as the host prepares it; all [S] int64."""

    start_us: Tensor
    """Time of the frame before."""
    duration_us: Tensor
    """Time until the next frame, at least 1."""
    key: Tensor
    """The bits of `draws.frame_key`."""
    share: Tensor
    """The bits of the share by which references move to the frame before, float64: 0 keeps them, 1
    replaces them."""
    origin_us: Tensor
    """Added to a time it gives the time on an axis that puts the clips one after the other."""
    table: Tensor
    """Row of the Poisson tables for the noise of the interval."""


class NoiseRules(NamedTuple):
    """Eq. 6 as numbers."""

    numbers: Tensor
    """[2] float64."""
    cumulative: Tensor
    """[tables, length] float64: P(events of a block ≤ k), filled up with 2."""
    length: int
    """Entries of a table."""


class PassCounts(NamedTuple):
    """Counts of the first pass over the frames, which the second one reads."""

    events: Tensor
    """[S, blocks] int32, first pass: events of a block in an interval. Second pass: int64, where
    the block's events begin among all records."""
    fired: Tensor
    """[S, area / 4 rounded up] uint8, or None: a bit per pixel that fired, lowest bit first."""
    bad: Tensor
    """[1] int32: intensities that are refused; None in the second pass."""


class Records(NamedTuple):
    """Signal events before they have a time; those of a segment follow each other; [n] each."""

    pixel: Tensor
    """Flat index y · W + x, int32."""
    order: Tensor
    """Number of the event among its pixel's in this interval: 1, 2, ...; int32; None where a pixel
    has one at most."""
    reference: Tensor
    """Reference of the pixel: an intensity, in the frames' type, or a brightness, float64."""


PIXELS_PER_MARK = 4
"""Pixels in a byte of `PassCounts.fired`: those of one thread, so that none waits for another."""
ON_FRACTION, DARK_BELOW = range(2)
"""Places in `NoiseRules.numbers`."""


class Call(NamedTuple):
    """One call of the engine, as every kernel sees it."""

    frames: FrameLayout
    intervals: Intervals
    align: int
    """Largest power of two, up to 16, that divides the distance of any two frames, pixels."""

    @property
    def clips(self) -> int:
        """B."""
        return len(self.frames.previous)

    @property
    def segments(self) -> int:
        """S."""
        return len(self.intervals.start_us)
