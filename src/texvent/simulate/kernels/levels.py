"""What a kernel gets and gives when it looks for pixels that are outside their trigger levels."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias, cast

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.kernels.select import AUTO, load_kernel_when_ready

Luma: TypeAlias = NDArray[Any]
"""[n] 0..255 scale, uint8 or float32."""

Logs: TypeAlias = tuple[NDArray[np.float64], NDArray[np.float64]]
Curve: TypeAlias = tuple[float, float]

MARGIN = 1e-6
"""By how much levels are narrowed, relative and in levels of 0..255: ten float32 roundings."""

FindOutside: TypeAlias = Callable[[Luma, Luma, Luma], NDArray[np.int64]]
"""`find_outside(luma, low, high)`, see `levels_reference.find_outside`."""


def load_find_outside(dtype: np.dtype[Any], backend: str = AUTO) -> FindOutside:
    """The function of a backend; "auto" is NumPy until the compiled one is ready.

    Raises:
        ConfigError: no backend has that name.
        MissingDependencyError: what the backend needs is not installed.
    """
    return cast(
        "FindOutside", load_kernel_when_ready("levels", "find_outside", backend, dtype.name)
    )


Narrow: TypeAlias = Callable[[NDArray[np.int64], Logs, Curve, Luma, Luma], None]
"""`narrow(pixel, (low, high), (scale, offset), low, high)`, see `levels_reference.narrow`."""


def load_narrow(dtype: np.dtype[Any], backend: str = AUTO) -> Narrow:
    """As `load_find_outside`."""
    return cast("Narrow", load_kernel_when_ready("levels", "narrow", backend, dtype.name))
