"""GPUs that torch finds, and arrays on them. torch is loaded only where there is a driver."""

from __future__ import annotations

import contextlib
import ctypes
import functools
import importlib.util
import os
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import (
    ConfigError,
    InputError,
    MissingDependencyError,
    one_line,
    shown,
    warn,
)

AUTO, CPU = "auto", "cpu"
_NAME = re.compile("auto|cpu|cuda(:(0|[1-9][0-9]?))?")


def check_device_name(value: Any, option: str = "device") -> str:
    """The name of a device.

    Args:
        value: a name, or a torch.device.
        option: of what, for the message.

    Raises:
        ConfigError: it is none.
    """
    if _NAME.fullmatch(str(value)):
        return str(value)
    raise ConfigError(
        f"{option} is {shown(value)}; it must be auto, cpu, cuda or a numbered GPU such as cuda:1"
    )


EXTRA = "gpu"
VARIABLE = "TEXVENT_DEVICE"
LEAST_CAPABILITY = 7, 0
"""Compute capability of the oldest GPUs that Triton compiles for."""
Device: TypeAlias = Any
"""torch.device."""
Tensor: TypeAlias = Any
"""torch.Tensor."""
_DRIVER = "nvcuda.dll" if sys.platform == "win32" else "libcuda.so.1"
_VERSION = Path("/proc/driver/nvidia/version")


def find_gpu(wish: str) -> Device | None:
    """The GPU of the option `device`; None for "cpu", and for "auto" where there is none.

    $TEXVENT_DEVICE is what "auto" stands for, if it is set.

    Raises:
        ConfigError: "cuda" or a numbered GPU is wanted, and torch finds none.
        MissingDependencyError: one is wanted, and torch is not installed.
    """
    if wish == AUTO:
        wish = check_device_name(os.environ.get(VARIABLE) or AUTO, f"${VARIABLE}")
    if wish == CPU:
        return None
    if wish == AUTO:
        return _any_gpu()
    torch = require("torch", extra=EXTRA)
    if not torch.cuda.is_available():
        raise ConfigError(f"device is {wish!r}, and {say_no_gpu(torch)}; use device='cpu'")
    device, count = torch.device(wish), torch.cuda.device_count()
    if device.index is not None and device.index >= count:
        names = "cuda:0" if count == 1 else f"cuda:0 to cuda:{count - 1}"
        raise ConfigError(f"device is {wish!r}; torch finds {names} here")
    if _is_old(torch, device):
        raise ConfigError(f"device is {wish!r}, a GPU too old for Triton; use device='cpu'")
    return device if device.index is not None else _current(torch)


def say_no_gpu(torch: Any) -> str:
    """Say why this torch has no GPU: it was built for CPUs alone, or finds none."""
    if not (torch.version.cuda or torch.version.hip):
        return f"torch {torch.__version__} is built for CPUs alone; install a build for CUDA"
    return f"torch {torch.__version__} finds no GPU here"


def _is_old(torch: Any, device: Device | None = None) -> bool:
    return bool(torch.cuda.get_device_capability(device) < LEAST_CAPABILITY)


@functools.cache
def _any_gpu() -> Device | None:
    try:
        ctypes.CDLL(_DRIVER)
    except OSError:
        return None
    if any(importlib.util.find_spec(name) is None for name in ("torch", "triton")):
        return None
    try:
        torch = require("torch", extra=EXTRA)
        if not torch.cuda.is_available():
            return None
        return None if _is_old(torch) else _current(torch)
    except (MissingDependencyError, OSError, RuntimeError) as error:
        # torch is damaged, or another process fills the GPU or has it alone.
        warn(f"the GPU is not used: {one_line(error)}")
        return None


@functools.cache
def triton_fault() -> str | None:
    """Why Triton cannot launch kernels on the GPUs here, such as a missing C compiler.

    Raises:
        MissingDependencyError: Triton is not installed.
    """
    triton = require("triton", extra=EXTRA)
    try:
        triton.runtime.driver.active  # noqa: B018  (compiles, once per machine)
    except (OSError, RuntimeError, subprocess.SubprocessError) as error:
        return f"Triton cannot launch kernels ({one_line(error)})"
    return None


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
def explain_device_memory(
    device: Device,
    size: object,
    *,
    subject: str = "frames of",
    advice: str = "choose a smaller `sensor`",
) -> Iterator[None]:
    """Turn a failure of memory on a device into one line.

    Args:
        device: torch.device.
        size: of the frames, or all that does not fit.
        subject: stands before it.
        advice: to do about it; on a GPU, device='cpu' is added.

    Raises:
        InputError: it says how much was asked for, and how much there is.
    """
    try:
        yield
    except (RuntimeError, MemoryError) as error:
        # Others name memory too: "an illegal memory access". NumPy's is the host's.
        is_other = isinstance(error, MemoryError) and device.type != "cpu"
        if is_other or not re.search(
            "out of memory|allocate memory|Unable to allocate", str(error)
        ):
            raise
        wanted = re.search(r"(?:[Tt]ried|Unable) to allocate ([\d.]+ \w+)", str(error))
        facts = [f"{wanted[1]} more were wanted"] if wanted else []
        if device.type == "cuda":
            facts.append(f"it has {total_bytes(device) / 1e9:.3g} GB, of which others may use some")
            advice += ", or device='cpu'"
        raise InputError(
            f"{subject} {size} do not fit into the memory of {device}: "
            + "; ".join([*facts, advice])
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
