"""Whether the GPU backend can run here, and how its kernels are launched."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError

EXTRA = "gpu"
LAUNCH = {"enable_fp_fusion": False}
"""Options of every launch. A fused multiply-add rounds once where the CPU rounds twice, and an
event at the threshold would show it."""


def check_device(device: Any) -> None:
    """Refuse a device that the kernels cannot run on.

    Args:
        device: torch.device of the frames.

    Raises:
        ConfigError: it is no GPU, and Triton's interpreter is off.
        MissingDependencyError: torch or Triton is not installed.
    """
    if device.type == "cuda" or is_interpreted():
        return
    raise ConfigError(
        f"backend gpu needs frames on a GPU; these are on {device.type!r}. Use backend cpu, or, to "
        "try the GPU kernels slowly on a CPU, set TRITON_INTERPRET=1 before Python starts"
    )


def default_device() -> str:
    """Device for frames from the host: the GPU, or the CPU under the interpreter.

    Raises:
        ConfigError: torch finds no GPU, and Triton's interpreter is off.
        MissingDependencyError: torch or Triton is not installed.
    """
    can_interpret = is_interpreted()
    torch = require("torch", extra=EXTRA)
    if torch.cuda.is_available():
        return "cuda"
    if can_interpret:
        return "cpu"
    raise ConfigError(
        "backend gpu needs a GPU, and torch finds none here; use backend cpu, or, to try the GPU "
        "kernels slowly on a CPU, set TRITON_INTERPRET=1 before Python starts"
    )


def is_interpreted() -> bool:
    """Whether Triton runs kernels in its interpreter, on the CPU.

    Raises:
        MissingDependencyError: Triton is not installed.
    """
    return bool(require("triton", extra=EXTRA).knobs.runtime.interpret)


@contextmanager
def on_device(device: Any) -> Iterator[None]:
    """Launch kernels on this device."""
    if device.type != "cuda":
        yield
        return
    with require("torch", extra=EXTRA).cuda.device(device):
        yield
