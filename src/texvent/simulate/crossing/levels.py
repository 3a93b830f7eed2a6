"""What a kernel gets and gives when it looks for pixels that are outside their trigger levels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.backend.select import AUTO, load_kernel_when_ready

Float64Array: TypeAlias = NDArray[np.float64]
Luma: TypeAlias = NDArray[Any]
"""[n] 0..255 scale, uint8 or float32."""

_BYTE = np.dtype(np.uint8).str
MARGIN = 1e-6
"""By how much levels are narrowed, relative and in levels of 0..255: ten float32 roundings."""
SLACK = 1e-9
"""Log units by which a brightness must be out of reach, for what is rounded."""


class Outside(NamedTuple):
    """Pixels that may fire; arrays that the next call may overwrite."""

    pixel: NDArray[np.int64]
    """[m] flat index, ascending."""
    before: Luma
    """[m] luma in the frame before."""
    now: Luma
    """[m] luma in this frame."""


class Curve(NamedTuple):
    """How brightness and intensity belong together."""

    scale: float
    """A pixel of brightness v has the intensity `scale · e^v + offset`."""
    offset: float
    darkest: float = -np.inf
    """No intensity is as dark as a brightness below this, log units."""


class Thresholds(NamedTuple):
    """By how much a pixel's brightness must change to fire, log units."""

    on: Float64Array
    """[n], or [1] where all pixels have the same."""
    off: Float64Array
    """[n] or [1]."""


FindOutside: TypeAlias = Callable[[Luma, Luma, Luma, Luma], Outside]
"""`find_outside(luma, seen, low, high)`, see `levels_reference.find_outside`."""


def load_find_outside(dtype: np.dtype[Any], backend: str = AUTO) -> FindOutside:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast("FindOutside", load_kernel_when_ready(__name__, "find_outside", backend, dtype.str))


Narrow: TypeAlias = Callable[[NDArray[np.int64], Float64Array, Thresholds, Curve, Luma, Luma], None]
"""`narrow(pixel, reference, thresholds, curve, low, high)`, see `levels_reference.narrow`."""


def load_narrow(dtype: np.dtype[Any], backend: str = AUTO) -> Narrow:
    """As `load_find_outside`."""
    return cast("Narrow", load_kernel_when_ready(__name__, "narrow", backend, dtype.str))


LookUp: TypeAlias = Callable[[NDArray[Any], NDArray[np.uint8]], NDArray[Any]]
"""`look_up(table, luma)`, see `levels_reference.look_up`."""


def load_look_up(backend: str = AUTO) -> LookUp:
    """As `load_find_outside`."""
    return cast("LookUp", load_kernel_when_ready(__name__, "look_up", backend, _BYTE))
