"""Options of V2CE."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.config import check_range
from texvent.simulate.v2ce.ldati import Rounding
from texvent.simulate.v2ce.network import Device


@dataclass(frozen=True, kw_only=True)
class V2ceConfig:
    """Options of V2CE; the defaults are those of its program.

    Raises:
        ConfigError: an option is out of range.
    """

    weights: Path | None = None
    """File with the network's weights, v2ce_3d.pt; it is never downloaded."""
    device: Device = "auto"
    """Where the network runs: cpu, cuda (an NVIDIA GPU), or auto for a GPU if there is one."""
    sequence_length: int = 16
    """Frame pairs that the network sees at once; it was trained on 16."""
    rounding: Rounding = "published"
    """What becomes of parts of an event: published rounds each pixel's number up or down by where
    the part is; stochastic rounds it by chance, right on average."""
    bidirectional: bool = False
    """Infer times from both ends of the interval instead of from its start."""

    def __post_init__(self) -> None:
        check_range("sequence_length", self.sequence_length, 1, 1024)
