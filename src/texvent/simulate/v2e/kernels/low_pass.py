"""What a kernel gets and gives when v2e's pixels follow the light from one frame to the next."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO, load_kernel_when_ready

Float64Array: TypeAlias = NDArray[np.float64]
Float32Array: TypeAlias = NDArray[np.float32]

DARK_OFFSET, WHITE_LEVEL = 20.0, 275.0
"""Bandwidth and shot noise depend on (I + 20) / 275, which is never 0."""


SETTLED = 2.0**-40
"""A lag of brightness below this, log units, is none, so that a pixel at rest is at rest."""
BLOCK = 256
"""Pixels that a fast kernel looks at together, and skips together if nothing happens to them."""


class Light(NamedTuple):
    """The frames at both ends of the interval."""

    before: NDArray[Any]
    """[n] luma at the start, 0..255 scale, uint8 or float32; a kernel turns it into that at the
    end."""
    luma: NDArray[Any]
    """[n] luma at the end, of the same type."""
    table: Float64Array | None
    """[2, 256] for uint8: brightness of every level, and its (I + 20) / 275; else None."""
    linear_below: float
    """Intensity up to which brightness is linear."""
    angle: float
    """2π · bandwidth at white · length of the interval; infinite for an unlimited bandwidth."""


class Pixels(NamedTuple):
    """What differs from pixel to pixel and never changes."""

    threshold_on: Float32Array
    """[n] log units, above 0."""
    threshold_off: Float32Array
    """[n] log units, above 0."""
    leak: Float32Array | None
    """[n] log units per µs by which references sink; None without leak."""


class PixelState(NamedTuple):
    """What the change of a pixel is made of."""

    brightness: Float64Array
    """[n] behind the low-pass; a kernel moves it to the end of the interval."""
    reference: Float64Array
    """[n] the level of the last event, as it was at the first frame, before it leaked."""
    voltage: tuple[Float64Array, Float64Array] | None
    """[n] noise of the photoreceptor at the start and at the end; None without."""
    calm_until_us: Float64Array
    """[blocks] time after the first frame, µs, up to which no pixel of a block reaches a threshold
    if its light stays as it is; a note of the fast kernel for itself."""

    def disturb(self, pixel: NDArray[np.int64]) -> None:
        """Have kernels look at some pixels again, whose references have moved."""
        self.calm_until_us[pixel // BLOCK] = -np.inf


class Restless(NamedTuple):
    """The pixels that have reached a threshold at the end."""

    pixel: NDArray[np.int64]
    """[m] flat index, ascending."""
    start: Float64Array
    """[m] change against the reference at the start, log units."""
    stop: Float64Array
    """[m] change at the end."""


FollowLight: TypeAlias = Callable[[Light, Pixels, PixelState, tuple[float, float]], Restless]
"""`follow_light(light, pixels, state, (start, stop))`, see `follow_reference.follow_light`."""


def load_follow_light(dtype: np.dtype[Any], backend: str = AUTO) -> FollowLight:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast(
        "FollowLight", load_kernel_when_ready(__name__, "follow_light", backend, dtype.name)
    )


def new_state(
    brightness: Float64Array, voltage: tuple[Float64Array, Float64Array] | None
) -> PixelState:
    """The state of pixels that have memorised what they see.

    Args:
        brightness: [n] log units.
        voltage: see `PixelState`.
    """
    blocks = -(-brightness.size // BLOCK)
    return PixelState(brightness, brightness.copy(), voltage, np.full(blocks, -np.inf))
