"""What a Texvent kernel keeps per pixel, which pixels it looks at closely, and how it draws noise.

The definition of the model is float64 NumPy on whole frames (`texvent.simulate.texvent.reference`).
A fast backend must return the same events, bit for bit, without a logarithm per pixel. It can,
because an event needs three things only, and each is told here once for all backends.

**State.** One array per pixel, `reference`: the intensity R that the pixel compares with, in the
type of the frames (uint8, uint16 or float32 luma; once frames of two types have come, float32,
which holds all three exactly). That is the whole state, because Eq. 5's cached reference is always
the intensity of an earlier frame: where a pixel fires, R becomes the frame's intensity there; where
the cache forgets (`local` after a source frame, `none` after every frame), R becomes the frame.
Only `reset="step"` and the residual decay move references between intensities. They keep two arrays
instead: `level`, the reference brightness itself, float64, exact; and `reference`, float32, the
balanced intensity exp(level), for the scan alone, rounded any way, within a relative 10⁻⁷.

**Trigger levels.** With brightness L = ln(α + I) an event is

    |L(I) − L(R)| ≥ δ   ⇔   α + I ≥ (α + R)·e^δ   or   α + I ≤ (α + R)·e^−δ ,

so a scan needs two multiplications and two comparisons per pixel, in float32. The levels are moved
towards R by the margin of `crossing.trigger_levels`: a pixel outside them *may* fire (a candidate),
a pixel inside cannot. A candidate fires if and only if `L(I) − L(R)`, both in float64 as
`brightness.balanced_log` computes them, differs from 0 by δ or more. For 8-bit frames a look-up
table of 256 logarithms does that, for 16-bit ones one of 65,536; float frames take NumPy's
logarithm of the candidates. For 8-bit frames there is an even cheaper scan, on bytes: no pixel
fires whose intensity differs from R by less than the smallest difference of any two levels that
fires.

**Noise.** Eq. 6 is a Poisson process of `mean` = λ1·λ2 events per pixel. The frame is cut into runs
of `NOISE_BLOCK` pixels in row-major order. Block b draws how many events its pixels would have if
all were noisy, and for each a place and a time, both uniform; then the mask of Eq. 6 is applied
where they fell. A Poisson number per block with uniform places is the same distribution as a
Poisson number per pixel, and costs time only where noise is. All draws are hashes
(`draws.draw_words`) of the frame's key, with y, x = b div 2¹⁶, b mod 2¹⁶:

    u  = uniform(NOISE_COUNT.draw())        count: Poisson quantile of u, mean · NOISE_BLOCK
    wₖ = word(NOISE_PLACE.draw(k))          k = 0..count−1; its top 12 bits: pixel in the block;
                                            its other 52 · 2⁻⁵²: time, fraction of the interval
    vₖ = uniform(NOISE_POLARITY.draw(k))    ON where vₖ < on_fraction

Places beyond the last pixel of the frame are dropped. Blocks know nothing of each other, so bands,
threads, chunks and GPUs draw the same noise.

**Order.** Events of a packet are ordered by (t, y, x, p, label).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel

Float64Array: TypeAlias = NDArray[np.float64]
Intensity: TypeAlias = NDArray[Any]
"""[n] flat: uint8 or float32 luma on the 0..255 scale, or uint16 on the 0..65535 scale."""

NOISE_BLOCK = 4096
"""Pixels per noise block; also what a scan works on at a time."""
NOISE_PLACE_SHIFT = 52
"""By how many bits a place word is shifted to give the pixel in its block."""
SCAN_FLOOR = 1e-37
"""Added to `trigger_levels.MARGIN`, for intensities so small that float32 has no relative
precision."""


class ScanLevels(NamedTuple):
    """How a scan finds candidates: `I ≥ R·up + up_offset` or `I ≤ R·down + down_offset`, float32.

    The trigger levels of above, `(α + R)·e^±δ − α`, moved towards each other by the margin.
    """

    up: np.float32
    up_offset: np.float32
    down: np.float32
    down_offset: np.float32
    least: np.uint8
    """Smallest difference of two uint8 intensities that may fire."""


class FireRule(NamedTuple):
    """What firing is, and what it does to a reference (Eq. 5)."""

    threshold: float
    """δ, log units."""
    balance: float
    """α, 0..255 scale."""
    multi_event: bool
    """Whether a pixel fires floor(Δ / δ) times."""
    is_step: bool
    """Whether an event moves the level by δ; else to the frame's brightness."""
    is_renewed: bool
    """Whether the cache forgets all references after this frame: the frame becomes them."""
    has_line: bool
    """Whether the times of events need to know where brightness came from."""


class Fired(NamedTuple):
    """The pixels that fired in one sub-interval, in row-major order: of a sensor, or of a band."""

    pixel: NDArray[np.int64]
    """[n] flat index y · W + x, ascending."""
    change: Float64Array
    """[n] brightness minus reference brightness, log units."""
    start: Float64Array
    """[n] brightness at the start of the sub-interval; [0] unless `FireRule.has_line`."""
    stop: Float64Array
    """[n] brightness at its end; [0] likewise."""
    reference: Float64Array
    """[n] reference brightness; [0] likewise."""

    def first(self, number: int) -> Fired:
        """Views of the first so many rows."""
        rows, lines = slice(number), slice(number if self.start.size else None)
        pixel, change, start, stop, reference = self
        return Fired(pixel[rows], change[rows], start[lines], stop[lines], reference[lines])


def join_fired(bands: Sequence[Fired]) -> Fired:
    """The pixels that fired in bands that follow each other."""
    return Fired(
        np.concatenate([band.pixel for band in bands]),
        np.concatenate([band.change for band in bands]),
        np.concatenate([band.start for band in bands]),
        np.concatenate([band.stop for band in bands]),
        np.concatenate([band.reference for band in bands]),
    )


@dataclass(eq=False)
class Memory:
    """What a sensor's pixels remember between frames; flat arrays, changed by the kernels."""

    reference: Intensity
    """[n] intensity that each pixel compares with, of the frames' type; beside `level` float32,
    exp(level)."""
    renewed: Intensity
    """[n] where a kernel writes the next references if all are renewed; else not looked at."""
    previous: Intensity
    """[n] intensity of the frame before, or [0] where times do not depend on it."""
    level: Float64Array
    """[n] reference brightness, or [0] where `reference` says it all."""
    table: Float64Array
    """Brightness of every intensity that an integer type has, or [0] for float32."""
    work: Any = None
    """Room that a backend keeps for its results; overwritten by each frame."""

    def __getstate__(self) -> dict[str, Any]:
        """What a copy takes along: not the room for results."""
        return vars(self) | {"work": None}


FindFired: TypeAlias = Callable[[Intensity, Memory, ScanLevels, FireRule], "Fired | None"]
"""`find_fired(frame, memory, levels, rule)`, see `texvent_numpy.find_fired`."""
FIND_FIRED = Kernel[FindFired](__name__, "find_fired")
