"""How the files of each kind of network are read, checked and stored."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent.interpolate.rife.weights import read_rife_weights, write_rife_weights
from texvent.metrics.lpips.weights import read_lpips_weights, write_lpips_weights
from texvent.weights.catalogue import NetworkKind


@dataclass(frozen=True)
class NetworkFiles:
    """One kind of network's way to read files."""

    needs: tuple[str, ...]
    """Modules that reading and writing need."""
    extra: str | None
    """The texvent extra that brings them."""
    read: Callable[[Path], Any]
    """File → checked weights, which say their `layout.name`."""
    write: Callable[[Any, Path], None]
    """Weights, path: store them as texvent keeps them."""


NETWORKS: Mapping[NetworkKind, NetworkFiles] = {
    "rife": NetworkFiles(
        ("torch", "safetensors.torch"), "rife", read_rife_weights, write_rife_weights
    ),
    "lpips": NetworkFiles((), None, read_lpips_weights, write_lpips_weights),
}
"""Kind → how to read it."""
