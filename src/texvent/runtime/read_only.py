"""Arrays that cannot be written, so that Numba compiles a kernel for one kind of array only."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray


def read_only(array: NDArray[Any]) -> NDArray[Any]:
    """A C-contiguous view (or copy) of an array that cannot be written."""
    view = np.ascontiguousarray(array).view()
    view.flags.writeable = False
    return view
