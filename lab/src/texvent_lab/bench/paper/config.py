"""Options of the paper's tables."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from texvent.config import check_range
from texvent.data.pull import find_pulled
from texvent.errors import ConfigError
from texvent.sensor import as_size
from texvent_lab.bench.fidelity.event_files import named_folders
from texvent_lab.bench.paper.published_tables import FIGURES, TABLES
from texvent_lab.frame_recordings import (
    WITH_FRAMES,
    FrameRecording,
    locate_source,
    open_recording,
    recording_name,
)
from texvent_lab.reconstruct.reconstructor import find_network
from texvent_lab.registries import RECONSTRUCTORS

BASELINE = "Texvent"
ABLATIONS = (4, 5)
"""Tables of configs/paper."""
CONFIGS = Path(__file__).with_name("configs")
"""A link to configs/paper, whose files are in the wheel of the laboratory."""
CLASSIFIED = 9
"""Table of N-ImageNet's classifier."""
FROM_FILES = (1, 2, 8, 9)
"""Tables whose columns other programs may fill."""


@dataclass(frozen=True, kw_only=True)
class PaperConfig:
    """Table and inputs.

    Raises:
        ConfigError: an unknown table or network, jobs below 1, or nothing to run.
    """

    main_options: ClassVar[tuple[str, ...]] = (
        "table", "figure", "all", "scenes", "recordings", "configs", "weights", "match_rate", "out",
        "overwrite", "quiet",
    )  # fmt: skip

    table: int | None = None
    """Table of the paper, 1 to 9; default: the ablations of both 4 and 5."""
    figure: int | None = None
    """Figure of the paper instead of a table: 5, 6, 7 or 12, of one recording; -o is its PNG."""
    all: bool = False
    """Every table with what is here; weights are those in the weights folder, --weights is the
    classifier of Table 9. texvent bench page makes a page of -o."""
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
    configs: Path | None = None
    """Tables 4 and 5: folder with one TOML file per row; default: the paper's rows, which are
    configs/paper of the repository."""
    rife: bool = True
    """Interpolate Texvent's rows by RIFE at every instant, as in the paper. --no-rife takes optical
    flow, and minutes in place of hours on a processor."""
    baseline: str = BASELINE
    """Tables 4 and 5: row that the others are compared with, pair by pair."""
    weights: Path | None = None
    """Tables 1, 7, 8: published weights of the network; table 9: those of the classifier."""
    network: str | None = None
    """Tables 1, 7, 8: network that reconstructs images; default: e2vid as in the paper where its
    weights are, else pie-net, which is also in place of table 8's ET-Net."""
    rvt_weights: Path | None = None
    """Table 2: RVT's published weights, for EQS; or weights.pt of train detection, for eqs (own
    RVT)."""
    folder: Path | None = None
    """Table 9: folder with a sub-folder per column (original, texvent ...), each with a sub-folder
    of event files per class. Table 6: the same with train and test, and one per simulator."""
    specification: Path | None = None
    """Table 3: data set specification of the simulated clips."""
    epochs: int = 30
    """Tables 3 and 6: passes over the training streams."""
    image_size: str = "224x224"
    """Table 6: size that coordinates are scaled to."""
    work: Path | None = None
    """Tables 3 and 6: folder that keeps the trainings, so that a run that was stopped goes on."""
    events: tuple[str, ...] = ()
    """Tables 1, 2, 8, 9: NAME=FOLDER of a column that another program filled: an event file per
    recording, named as it and on the clock of its frames; for table 9 a sub-folder per class."""
    slomo_weights: Path | None = None
    """Table 4: SuperSloMo.ckpt, for E8; default: that in the weights folder. Without one, E8 takes
    optical flow."""
    jobs: int = 2
    """Processes for simulating on recordings and scenes."""

    def __post_init__(self) -> None:
        if self.table is not None and self.table not in TABLES:
            raise ConfigError(
                f"table is {self.table}; the tables are {', '.join(map(str, TABLES))} (texvent "
                "nt-imagenet prints the rows of Table 10)"
            )
        if self.figure is not None:
            self._check_figure()
        elif self.network is not None:
            find_network(self.network)
        check_range("jobs", self.jobs, 1)
        check_range("epochs", self.epochs, 1, 1_000_000)
        as_size(self.image_size)
        if self.all and (self.table, self.figure, self.network) != (None, None, None):
            raise ConfigError("all takes every table; leave out table, figure and network")
        if self.events and not (self.all or self.figure or self.table in FROM_FILES):
            tables = ", ".join(map(str, FROM_FILES))
            raise ConfigError(f"events fills columns of tables {tables}; name one with --table")
        named_folders(self.events, TABLES[self.table or 1].columns)
        if not self.oracle and not self.recordings and self.table in (None, *ABLATIONS):
            raise ConfigError("--no-oracle leaves nothing to run; name --recordings")

    def _check_figure(self) -> None:
        if self.figure not in FIGURES:
            known = ", ".join(map(str, FIGURES))
            raise ConfigError(f"figure is {self.figure}; the figures are {known}")
        if self.table is not None:
            raise ConfigError("table and figure are given; give one of them")
        if self.network is not None:
            RECONSTRUCTORS.load(self.network)
        if len(self.named_recordings) > 1:
            raise ConfigError(f"recordings is {self.recordings}; a figure shows one recording")

    def of_table(self, number: int) -> PaperConfig:
        """The same for one of all tables."""
        return replace(
            self,
            all=False,
            table=number,
            events=self.events if number in FROM_FILES and number != CLASSIFIED else (),
            weights=self.weights if number == CLASSIFIED else None,
            folder=self.folder if number == CLASSIFIED else None,
        )

    @property
    def event_folders(self) -> Mapping[str, Path]:
        """Column → folder of its events; a name that the table has not is a column of its own.

        Raises:
            ConfigError: a text is not NAME=FOLDER, there is no such folder, or a column is named
                twice.
        """
        return named_folders(self.events, TABLES[self.table or 1].columns)

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
        return [
            replace(open_recording(locate_source(source)[0]), name=recording_name(source))
            for source in self.sources
        ]
