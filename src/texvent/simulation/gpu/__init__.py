"""Pixel models as Triton kernels, on batches of clips that stay on the GPU."""

from __future__ import annotations

from typing import Any

from texvent._require import require

__all__ = ["ClipEvents", "GpuSimulator"]


def __getattr__(name: str) -> Any:
    """Load a public name on first use: it brings Triton along.

    Raises:
        MissingDependencyError: Triton is not installed.
    """
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    require("triton", extra="gpu")
    from texvent.simulation.gpu.engine import ClipEvents, GpuSimulator

    public = {"ClipEvents": ClipEvents, "GpuSimulator": GpuSimulator}
    return public[name]
