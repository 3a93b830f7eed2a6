"""Devices of the GPU backend, and the launch of its kernels: sizes of programs, grids, tables."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

from texvent._require import require
from texvent.errors import ConfigError
from texvent.runtime.devices import EXTRA as EXTRA
from texvent.runtime.devices import to_device as to_device
from texvent.simulation.gpu.kernel_types import Call, Records, Tensor

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
        f"the frames are on {device.type!r}, they must be on a GPU; to try the kernels slowly on a "
        "CPU, set TRITON_INTERPRET=1 before Python starts"
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


_MOST_ALIGNED = 16


class LaunchSize(NamedTuple):
    """Size of the programs of a kernel that scans pixels."""

    block: int
    """Pixels of a program, at least 8."""
    warps: int
    """Threads of a program, in groups of 32."""
    registers: int | None = None
    """Most registers of a thread; None: as the compiler likes."""


LEVELS_LAUNCH = LaunchSize(128, 1)
"""Launch of Texvent's scan by trigger levels. One warp: nothing waits at a barrier, and a quiet one
has little to do."""
BRIGHTNESS_LAUNCH = LaunchSize(512, 4)
"""Launch of Texvent's scan by brightness."""
RAMP_LAUNCH = LaunchSize(512, 4)
"""Launch of ESIM's scan."""
CIRCUIT_LAUNCH = LaunchSize(32, 1, registers=168)
"""Launch of the `physical` model's scan. A thread per pixel: those that may fire hold up few. Left
alone, the compiler takes 128 registers and spills others."""
RECORD_BLOCK = 512
"""Records that a program takes at a time to give them times or order them."""


def choose_launch_size(compiled: LaunchSize) -> LaunchSize:
    """The size that is best on a GPU, or one for few programs in the interpreter's loop."""
    return LaunchSize(256, 1) if is_interpreted() else compiled


def pixel_grid(call: Call, block: int) -> tuple[int, int]:
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


def make_records(count: int, reference: Tensor, *, has_order: bool) -> Records:
    """Room for `count` events.

    Args:
        count: n.
        reference: a tensor of the type that their references have, and on their device.
        has_order: whether a pixel may have several events in an interval.
    """
    torch = require("torch", extra=EXTRA)
    pixel = torch.empty(count, dtype=torch.int32, device=reference.device)
    order = torch.empty_like(pixel) if has_order else None
    return Records(pixel, order, torch.empty(count, dtype=reference.dtype, device=pixel.device))
