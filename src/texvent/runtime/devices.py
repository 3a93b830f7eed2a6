"""GPUs that torch finds, and arrays on them. torch is loaded only where there is a driver."""

from __future__ import annotations

import contextlib
import ctypes
import functools
import importlib.util
import re
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import ConfigError, InputError

EXTRA = "gpu"
AUTO, CPU = "auto", "cpu"
Device: TypeAlias = Any
"""torch.device."""
Tensor: TypeAlias = Any
"""torch.Tensor."""
_DRIVER = "nvcuda.dll" if sys.platform == "win32" else "libcuda.so.1"
_VERSION = Path("/proc/driver/nvidia/version")


def find_gpu(wish: str) -> Device | None:
    """The GPU of the option `device`; None for "cpu", and for "auto" where there is none.

    Raises:
        ConfigError: "cuda" or a numbered GPU is wanted, and torch finds none.
        MissingDependencyError: one is wanted, and torch is not installed.
    """
    if wish == CPU:
        return None
    if wish == AUTO:
        return _any_gpu()
    torch = require("torch", extra=EXTRA)
    if not torch.cuda.is_available():
        raise ConfigError(
            f"device is {wish!r}, and torch {torch.__version__} finds no GPU here; use device='cpu'"
        )
    device, count = torch.device(wish), torch.cuda.device_count()
    if device.index is not None and device.index >= count:
        names = "cuda:0" if count == 1 else f"cuda:0 to cuda:{count - 1}"
        raise ConfigError(f"device is {wish!r}; torch finds {names} here")
    return device if device.index is not None else _current(torch)


@functools.cache
def _any_gpu() -> Device | None:
    try:
        ctypes.CDLL(_DRIVER)
    except OSError:
        return None
    if any(importlib.util.find_spec(name) is None for name in ("torch", "triton")):
        return None
    torch = require("torch", extra=EXTRA)
    return _current(torch) if torch.cuda.is_available() else None


def _current(torch: Any) -> Device:
    return torch.device("cuda", torch.cuda.current_device())


def describe_device(device: Device) -> dict[str, str]:
    """Name of a device, and the versions that it was used with."""
    torch, triton = require("torch", extra=EXTRA), require("triton", extra=EXTRA)
    facts = {"device": str(device), "torch": torch.__version__, "triton": triton.__version__}
    if device.type == "cuda":
        facts["name"] = torch.cuda.get_device_name(device)
        with contextlib.suppress(OSError):
            found = re.search(r"\d+\.\d+(\.\d+)?", _VERSION.read_text(encoding="ascii"))
            facts |= {"driver": found[0]} if found else {}
    return facts


@contextlib.contextmanager
def explain_device_memory(device: Device, size: object) -> Iterator[None]:
    """Turn torch's failure of memory on a device into one line.

    Raises:
        InputError: it says how much frames of this size asked for, and how much there is.
    """
    try:
        yield
    except RuntimeError as error:
        if "memory" not in str(error):
            raise
        wanted = re.search(r"Tried to allocate ([\d.]+ \w+)", str(error))
        more = f" {wanted[1]} more were wanted;" if wanted else ""
        has = f" it has {total_bytes(device) / 1e9:.3g} GB;" if device.type == "cuda" else ""
        raise InputError(
            f"frames of {size} do not fit into the memory of {device}:{more}{has} choose a smaller "
            "`sensor`, or device='cpu'"
        ) from error


def total_bytes(device: Device) -> int:
    """Memory of a GPU, bytes."""
    return int(require("torch", extra=EXTRA).cuda.get_device_properties(device).total_memory)


def to_device(array: NDArray[Any], device: Device) -> Tensor:
    """A copy of an array; the host does not wait for it."""
    torch = require("torch", extra=EXTRA)
    array = np.ascontiguousarray(array)
    if not array.flags.writeable:  # which torch warns of
        array = array.copy()
    tensor = torch.from_numpy(array)
    if device.type == "cuda":
        return tensor.pin_memory().to(device, non_blocking=True)
    return tensor.clone()
