"""Options of the paper's tables."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

from texvent.config import check_range
from texvent.data.pull import find_pulled
from texvent.errors import ConfigError
from texvent_lab.bench.paper.published_tables import TABLES
from texvent_lab.bench.real.recording import (
    WITH_FRAMES,
    FrameRecording,
    locate_source,
    open_recording,
)
from texvent_lab.registries import RECONSTRUCTORS

BASELINE = "Texvent"
ABLATIONS = (4, 5)
"""Tables of configs/paper."""


@dataclass(frozen=True, kw_only=True)
class PaperConfig:
    """Table and inputs.

    Raises:
        ConfigError: an unknown table or network, jobs below 1, or nothing to run.
    """

    main_options: ClassVar[tuple[str, ...]] = (
        "table", "scenes", "recordings", "configs", "weights", "match_rate", "out", "overwrite",
        "quiet",
    )  # fmt: skip

    table: int | None = None
    """Table of the paper: 1, 2, 4, 5, 7, 8 or 9; default: the ablations of both 4 and 5."""
    scenes: str | None = None
    """Tables 4 and 5: names of scenes of bench fidelity, separated by commas; default: its own."""
    oracle: bool = True
    """Tables 4 and 5: run on scenes with true events; --no-oracle leaves recordings alone."""
    recordings: str | None = None
    """Names of pulled data sets, or paths of recordings, separated by commas; default: slider_depth
    and davis346 where they are pulled, for tables 4 and 5 none."""
    match_rate: bool = True
    """Fit each contrast threshold to the number of true events. With --no-match-rate every row
    keeps its own, as in the paper: then the number of events decides."""
    configs: Path = Path("configs/paper")
    """Tables 4 and 5: folder with one TOML file per row."""
    baseline: str = BASELINE
    """Tables 4 and 5: row that the others are compared with, pair by pair."""
    weights: Path | None = None
    """Tables 1, 7, 8: published weights of the network; table 9: those of the classifier."""
    network: str | None = None
    """Tables 1, 7, 8: network that reconstructs images; default: e2vid as in the
    paper, for table 8 pie-net in place of its ET-Net."""
    rvt_weights: Path | None = None
    """Table 2: RVT's published weights, for EQS; or weights.pt of train detection, for eqs (own
    RVT)."""
    folder: Path | None = None
    """Table 9: folder with a sub-folder per column (original, texvent ...), each with a sub-folder
    of event files per class."""
    jobs: int = 2
    """Processes for simulating on recordings and scenes."""

    def __post_init__(self) -> None:
        if self.table is not None and self.table not in TABLES:
            raise ConfigError(
                f"table is {self.table}; the tables are {', '.join(map(str, TABLES))}"
            )
        if self.network is not None:
            RECONSTRUCTORS.load(self.network)
        check_range("jobs", self.jobs, 1)
        if not self.oracle and not self.recordings and self.table in (None, *ABLATIONS):
            raise ConfigError("--no-oracle leaves nothing to run; name --recordings")

    @property
    def named_recordings(self) -> tuple[str, ...]:
        """Those of the option."""
        return tuple(self.recordings.split(",")) if self.recordings else ()

    @property
    def sources(self) -> tuple[str, ...]:
        """Recordings to use; none if nothing is named and nothing pulled."""
        pulled = tuple(name for name in WITH_FRAMES if find_pulled(name) is not None)
        return self.named_recordings or pulled

    def whole_recordings(self) -> list[FrameRecording]:
        """The recordings, to be read through."""
        return [open_recording(locate_source(source)[0]) for source in self.sources]
