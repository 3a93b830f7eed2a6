"""What a kernel of the `physical` model gets and gives: all pixel circuits over one interval.

Pixels are numbered y · W + x, every array is flat, and times are µs. A pixel keeps the output of
its photoreceptor and what it was when the pixel was last reset; an event, of whatever cause, resets
it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.elementary import exponential, natural_log
from texvent.simulate.backend.select import AUTO, load_kernel_when_ready
from texvent.simulate.packets.sorting import SortedEvents
from texvent.simulate.packets.unsorted_events import UnsortedEvents

Float64Array: TypeAlias = NDArray[np.float64]
Float32Array: TypeAlias = NDArray[np.float32]
Int64Array: TypeAlias = NDArray[np.int64]
Luma: TypeAlias = NDArray[Any]
"""[n] 0..255 scale, uint8 or float32."""

WHITE = 255.0
DARK_OFFSET = 20.0
"""Intensity, linear levels, that stands for what flows in the dark; v2e's value."""
ALMOST_BLACK = 1e-25
"""Added to the luma before the logarithm that makes it linear; any other luma swallows it."""
BLOCK = 256
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class Optics(NamedTuple):
    """How luma becomes brightness and bandwidth."""

    gamma: float
    """Exponent that makes the luma linear; 1 if it is already."""
    balance: float
    """α, linear levels, above 0."""
    corner_per_level: float
    """Corner frequency ω of a photoreceptor per linear level, 1/µs; 0 is unlimited."""


class Light(NamedTuple):
    """What every pixel sees over an interval; brightness is a straight line in time."""

    before: Luma
    """[n] luma at the start; a kernel turns it into that at the end."""
    now: Luma
    """[n] luma at the end, of the same type."""
    optics: Optics
    table: tuple[Float64Array, Float64Array] | None
    """For 8-bit luma `light_of` of all 256 levels, so that kernels need no logarithm."""
    shape: tuple[int, int]
    """(height, width) of the sensor."""


class Pixels(NamedTuple):
    """What differs from pixel to pixel and never changes."""

    threshold_on: Float32Array
    """[n] log units, above 0."""
    threshold_off: Float32Array
    """[n] log units, above 0."""
    leak: Float32Array
    """[n] log units per µs by which the change grows on its own, at least 0."""


class PixelState(NamedTuple):
    """What a pixel remembers; a kernel changes it in place.

    The change that fires a pixel is `output − level + leak · (t − since)`.
    """

    output: Float64Array
    """[n] output of the photoreceptor, which follows the brightness, log units."""
    level: Float64Array
    """[n] that output when the pixel was last reset; NaN while the pixel is held in reset."""
    since_us: Int64Array
    """[n] when the pixel was last reset, or will be released if it is held, µs."""
    calm_until_us: Int64Array
    """[blocks] time up to which no pixel of a block fires if its light stays as it is; a note of
    the fast kernel for itself."""


class NoiseEvents(NamedTuple):
    """Noise of one interval, by pixel and then by time."""

    pixel: Int64Array
    """[m] flat index."""
    t: Int64Array
    """[m] µs, in the interval."""
    p: NDArray[np.uint8]
    """[m] 1 = ON, 0 = OFF."""


class ResetRules(NamedTuple):
    """What an event does to its pixel besides resetting it."""

    refractory_us: int
    """How long the pixel is held in reset, so that what happens meanwhile is lost; 0 is none."""
    by_noise: bool
    """Whether noise resets its pixel too, or leaves it as it is."""


AdvancePixels: TypeAlias = Callable[
    [Light, Pixels, PixelState, NoiseEvents, ResetRules, tuple[int, int]],
    UnsortedEvents | SortedEvents,
]
"""`advance_pixels(light, pixels, state, noise, rules, (start_us, stop_us))`, see
`circuit_reference.advance_pixels`."""


def load_advance_pixels(dtype: np.dtype[Any], backend: str = AUTO) -> AdvancePixels:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    function = load_kernel_when_ready(__name__, "advance_pixels", backend, dtype.name)
    return cast("AdvancePixels", function)


def light_of(luma: Float64Array, optics: Optics) -> tuple[Float64Array, Float64Array]:
    """Brightness and corner frequency of the photoreceptor.

    Args:
        luma: 0..255 scale, any shape.
        optics: the constants.

    Returns:
        `L = ln(α + I)`, log units, and `ω = corner_per_level · (I + 20)`, 1/µs, with the linear
        intensity `I = 255 · (luma / 255)^gamma`.
    """
    intensity = linearize(luma, optics.gamma)
    return (
        natural_log(optics.balance + intensity),
        optics.corner_per_level * (intensity + DARK_OFFSET),
    )


def linearize(luma: Float64Array, gamma: float) -> Float64Array:
    """Linear intensity of gamma-coded luma.

    Args:
        luma: 0..255 scale, any shape.
        gamma: exponent; 1 leaves the luma as it is.

    Returns:
        `255 · (luma / 255)^gamma`.

    Example:
        >>> linearize(np.array([0.0, 128.0, 255.0]), 2.2).round(2).tolist()
        [0.0, 55.98, 255.0]
    """
    if gamma == 1.0:
        return luma
    exponent = gamma * natural_log((luma + ALMOST_BLACK) / WHITE)
    return np.asarray(WHITE * exponential(exponent))


def new_state(output: Float64Array, level: Float64Array, first_us: int) -> PixelState:
    """The state of pixels that were all reset, or might have been, at the first frame.

    Args:
        output: of the photoreceptors, [n], log units.
        level: at the last reset, [n], log units.
        first_us: time of the frame, µs.
    """
    blocks = -(-output.size // BLOCK)
    since = np.full(output.size, first_us, np.int64)
    return PixelState(output, level, since, np.full(blocks, first_us, np.int64))
