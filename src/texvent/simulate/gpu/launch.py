"""How many programs a kernel starts, and how tables reach the device."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.simulate.gpu.device import EXTRA
from texvent.simulate.gpu.kernel_types import Call, Records, Tensor

_MOST_ALIGNED = 16


def walk_grid(call: Call, block: int) -> tuple[int, int]:
    """One program per block of pixels and clip."""
    return math.ceil(call.frames.area / block), call.clips


def segment_grid(call: Call, records: int, block: int) -> tuple[int, int]:
    """Programs for the records of every segment: enough for the average one.

    The number of records of a segment is known on the device only; a program of a fuller segment
    takes several blocks.
    """
    return call.segments, max(1, math.ceil(records / (call.segments * block)))


def alignment(*strides: int) -> int:
    """Largest power of two, up to 16, that divides all of them.

    Example:
        >>> alignment(1280 * 720), alignment(346 * 260), alignment(35)
        (16, 8, 1)
    """
    return math.gcd(_MOST_ALIGNED, *strides)


def make_records(count: int, reference: Tensor) -> Records:
    """Room for `count` events whose references are of the type, and on the device, of another."""
    torch = require("torch", extra=EXTRA)
    dtypes = torch.int32, torch.int32, reference.dtype
    return Records(*(torch.empty(count, dtype=one, device=reference.device) for one in dtypes))


def to_device(array: NDArray[Any], device: Any) -> Tensor:
    """A copy of a small array; the host does not wait for it."""
    torch = require("torch", extra=EXTRA)
    tensor = torch.from_numpy(np.ascontiguousarray(array))
    if device.type == "cuda":
        return tensor.pin_memory().to(device, non_blocking=True)
    return tensor.clone()
