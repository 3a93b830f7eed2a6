"""What a kernel of the `physical` model gets and gives: all pixel circuits over one interval.

Pixels are numbered y · W + x, every array is flat, and times are µs. A pixel keeps the change of
its photoreceptor's output since it was last reset; an event, of whatever cause, sets it to zero.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.firings import Firings
from texvent.simulate.kernels.select import AUTO, load_kernel

Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]


class Drive(NamedTuple):
    """Brightness between two frames, a straight line, and how photoreceptors follow it.

    Over a time h the lag of a first-order low-pass with corner ω behind a line that rises by ΔL
    becomes `lag · e^(−a) + ΔL · (1 − e^(−a)) / a` with a = ωh: `decay` and `gain`. The corner
    changes with intensity, and the output is curved, so a pixel that may fire goes through the
    interval in `pieces`: brightness is a straight line, so α + I grows by one factor per piece.
    """

    rise: Float64Array
    """[n] change of brightness ln(α + I) over the interval."""
    pieces: Int64Array
    """[n] number of equal pieces, at least 1."""
    glow: Float64Array
    """[n] α + I in the middle of the first piece, linear levels."""
    growth: Float64Array
    """[n] factor on it from one piece to the next."""
    decay: Float64Array
    """[n] of the whole interval."""
    gain: Float64Array
    """[n] of the whole interval."""
    corner_per_level: float
    """ω per linear level, 1/µs; 0 stands for an unlimited bandwidth."""
    corner_level: float
    """What to add to α + I to have the levels that ω is proportional to."""


class Pixels(NamedTuple):
    """What differs from pixel to pixel and never changes."""

    threshold_on: Float64Array
    """[n] log units, above 0."""
    threshold_off: Float64Array
    """[n] log units, above 0."""
    leak: Float64Array
    """[n] log units per µs by which the change grows on its own."""


class PixelState(NamedTuple):
    """What a pixel remembers; a kernel changes it in place."""

    lag: Float64Array
    """[n] brightness minus photoreceptor output, log units."""
    change: Float64Array
    """[n] photoreceptor output minus its value at the last reset, leak included, log units."""
    leaked: Float64Array
    """[n] the part of the change that leakage made, log units."""
    release_us: Int64Array
    """[n] when the pixel leaves reset after its last event, µs."""

    def copied(self) -> PixelState:
        """A state of its own, equal to this one."""
        return PixelState(
            self.lag.copy(), self.change.copy(), self.leaked.copy(), self.release_us.copy()
        )

    def take(self, other: PixelState) -> None:
        """Become equal to another state, in place."""
        for mine, theirs in zip(self, other, strict=True):
            mine[:] = theirs


class Arrivals(NamedTuple):
    """Noise of one interval, by pixel and then by time."""

    pixel: Int64Array
    """[m] flat index."""
    t: Int64Array
    """[m] µs, in the interval."""
    p: NDArray[np.uint8]
    """[m] 1 = ON, 0 = OFF."""


class ResetRules(NamedTuple):
    """What an event does to its pixel besides setting the change to zero."""

    refractory_us: int
    """How long the pixel is held in reset, so that what happens meanwhile is lost; 0 is none."""
    by_noise: bool
    """Whether noise resets its pixel too, or leaves it as it is."""


AdvancePixels: TypeAlias = Callable[
    [Drive, Pixels, PixelState, Arrivals, ResetRules, tuple[int, int]], Firings
]
"""`advance_pixels(drive, pixels, state, noise, rules, (start_us, stop_us))`, see
`circuit_reference.advance_pixels`."""


def load_advance_pixels(backend: str = AUTO) -> AdvancePixels:
    """The function of a backend. All return equal bits.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("AdvancePixels", load_kernel("circuit", "advance_pixels", backend))


def bounds_of_change(
    drive: Drive, pixels: Pixels, state: PixelState, duration_us: int
) -> tuple[Float64Array, Float64Array]:
    """Lowest and highest change that each pixel can reach in an interval without an event.

    A first-order low-pass never leaves the range of its present output and its input, so a pixel
    whose bounds lie between its thresholds cannot fire.

    Args:
        drive: brightness over the interval.
        pixels: leak rates.
        state: at the start of the interval.
        duration_us: its length, µs.

    Returns:
        Two arrays [n], log units.
    """
    end = state.lag + drive.rise
    low = state.change + np.minimum(np.minimum(state.lag, end), 0.0)
    high = state.change + np.maximum(np.maximum(state.lag, end), 0.0)
    return low, high + pixels.leak * duration_us


def advance_quietly(
    drive: Drive, pixels: Pixels, state: PixelState, duration_us: int
) -> PixelState:
    """State at the end of an interval of pixels that do not fire in it, in closed form."""
    lag = drive.decay * state.lag + drive.gain * drive.rise
    leak = pixels.leak * duration_us
    change = state.change + (drive.rise - (lag - state.lag)) + leak
    return PixelState(lag, change, state.leaked + leak, state.release_us)
