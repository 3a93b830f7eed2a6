"""The photoreceptors of v2e from one frame to the next: input, state and kernel by backend."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import Kernel
from texvent.simulate.random.mismatch import PixelMismatch

Float64Array: TypeAlias = NDArray[np.float64]

SETTLED = 2.0**-40
"""A lag of brightness below this, log units, counts as none, so that a static pixel settles."""
BLOCK = 256
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class LowPassInput(NamedTuple):
    """The frames at both ends of the interval, and the constants of the low-pass."""

    before: NDArray[Any]
    """[n] luma at the start, 0..255 scale, uint8 or float32; a kernel overwrites it with `now`."""
    now: NDArray[Any]
    """[n] luma at the end, of the same type."""
    table: Float64Array | None
    """[2, 256] for uint8: brightness of every level, and its (I + 20) / 275; else None."""
    linear_below: float
    """Intensity up to which brightness is linear."""
    angle: float
    """2π · bandwidth at white · length of the interval; infinite for an unlimited bandwidth."""
    elapsed_us: tuple[float, float]
    """Time from the first frame to the start and to the end of the interval, µs."""


class V2ePixelState(NamedTuple):
    """What changes in a pixel.

    The change that fires it is brightness + noise − reference + leak · time since the first frame.
    """

    brightness: Float64Array
    """[n] after the low-pass, log units; a kernel moves it to the end of the interval."""
    reference: Float64Array
    """[n] brightness at the last event, less what had leaked until then, log units."""
    noise: tuple[Float64Array, Float64Array]
    """[n] noise of the photoreceptor at the start and at the end, log units; [0] without."""
    quiescent_until_us: Float64Array
    """[blocks] time after the first frame, µs, up to which no pixel of a block fires if its luma
    does not change; only the fast kernel reads it."""

    def end_quiescence(self, pixel: NDArray[np.int64]) -> None:
        """Have kernels look at some pixels again, whose references have moved."""
        self.quiescent_until_us[pixel // BLOCK] = -np.inf


class CrossingPixels(NamedTuple):
    """The pixels that have reached a threshold at the end."""

    pixel: NDArray[np.int64]
    """[m] flat index, ascending."""
    start: Float64Array
    """[m] change against the reference at the start, log units."""
    stop: Float64Array
    """[m] change at the end."""


ApplyLowPass: TypeAlias = Callable[[LowPassInput, PixelMismatch, V2ePixelState], CrossingPixels]
"""`apply_low_pass(light, mismatch, state)`, see `reference.apply_low_pass`."""
APPLY_LOW_PASS = Kernel[ApplyLowPass](__name__, "apply_low_pass")


def new_state(brightness: Float64Array, *, has_noise: bool) -> V2ePixelState:
    """The state of pixels whose reference is the brightness of the first frame.

    Args:
        brightness: [n] log units.
        has_noise: whether the photoreceptors make noise.
    """
    noise = np.zeros(brightness.size if has_noise else 0)
    blocks = -(-brightness.size // BLOCK)
    return V2ePixelState(
        brightness, brightness.copy(), (noise, noise.copy()), np.full(blocks, -np.inf)
    )
