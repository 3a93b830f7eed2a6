"""The GPU backend: pixel models as Triton kernels, on batches of clips that stay on the device."""

from __future__ import annotations

from typing import Any

from texvent._registry import load_object
from texvent._require import require

_HOMES = {
    "EventBatch": "texvent.simulate.gpu.batch:EventBatch",
    "GpuPairs": "texvent.simulate.gpu.frame_pairs:GpuPairs",
    "GpuSimulator": "texvent.simulate.gpu.engine:GpuSimulator",
}

__all__ = ["EventBatch", "GpuPairs", "GpuSimulator"]


def __getattr__(name: str) -> Any:
    """Load a public name on first use: it brings Triton along.

    Raises:
        MissingDependencyError: Triton is not installed.
    """
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    require("triton", extra="gpu")
    return load_object(_HOMES[name])
