"""Which network reconstructs, and where it runs."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

Device: TypeAlias = Literal["auto", "cpu", "cuda"]


@dataclass(frozen=True, kw_only=True)
class ReconstructConfig:
    """Which network turns events into images."""

    network: str = "e2vid"
    """Network: e2vid, e2vid+, firenet, firenet+, hypere2vid or et-net."""
    weights: Path | None = None
    """File with its published weights, which texvent neither carries nor downloads; default: its
    place in the weights folder."""
    device: Device = "auto"
    """Where it runs: cpu, cuda (an NVIDIA GPU), or auto for a GPU if there is one."""
