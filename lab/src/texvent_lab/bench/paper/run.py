"""Runs of the paper's tables and of folders of config files."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from texvent.data.pull import find_pulled
from texvent.errors import InputError, MissingDependencyError
from texvent.metrics.latent_similarity import load_eqs
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.published_tables import OurFigures, join_figures
from texvent_lab.bench.paper.tables import (
    accuracy_figures,
    eqs_figures,
    event_frame_figures,
    image_figures,
    noise_figures,
    time_figures,
)
from texvent_lab.bench.real.recording import (
    WITH_FRAMES,
    FrameRecording,
    RealScene,
    locate_source,
    open_recording,
    open_scene,
)
from texvent_lab.reconstruct.reconstructor import Reconstructor, load_reconstructor
from texvent_lab.registries import RECONSTRUCTORS

NETWORKS = {1: "e2vid", 7: "e2vid", 8: "et-net"}
"""Table → the network that the paper reconstructs with."""


@dataclass(frozen=True, kw_only=True)
class PaperInputs:
    """What the user has.

    Raises:
        ConfigError: an unknown network.
    """

    recordings: tuple[str, ...] = ()
    """Names of pulled data sets, or paths of recordings; none: those data sets with frames that
    are pulled."""
    is_rate_matched: bool = True
    """Fit each δ to the recorded number of events; else presets keep theirs, as in the paper."""
    weights: Path | None = None
    """Of the network of tables 1, 7 and 8, or of the classifier of table 9."""
    network: str | None = None
    """Name of the network; None: the paper's."""
    rvt_weights: Path | None = None
    folder: Path | None = None
    """Table 9: a sub-folder per column, each with a sub-folder of event files per class."""
    classes: Path | None = None
    """Table 9: names of the classes in the classifier's order."""
    jobs: int = 1
    """Processes for event frames and EQS."""

    def __post_init__(self) -> None:
        if self.network is not None:
            RECONSTRUCTORS.load(self.network)

    @property
    def sources(self) -> tuple[str, ...]:
        """Recordings to use; none if nothing is named and nothing pulled."""
        pulled = tuple(name for name in WITH_FRAMES if find_pulled(name) is not None)
        return self.recordings or pulled

    def scenes(self) -> list[RealScene]:
        """Parts of the recordings, in memory."""
        return [open_scene(source) for source in self.sources]

    def whole_recordings(self) -> list[FrameRecording]:
        """The recordings, to be read through."""
        return [open_recording(locate_source(source)[0]) for source in self.sources]

    def reconstructor(self, table: int) -> Reconstructor:
        """The network of a table.

        Raises:
            ConfigError: it does not exist.
            InputError: its weights are missing; the message says where they come from.
            FileFormatError: the weights are damaged or of another network.
            MissingDependencyError: torch is not installed.
        """
        return load_reconstructor(self.network or NETWORKS[table], self.weights)


def measure_table(number: int, inputs: PaperInputs, progress: Progress) -> OurFigures:
    """Our figures of one table, and what is missing for the rest.

    Args:
        number: 1, 2, 7, 8 or 9; `paper_ablations` has 4 and 5.
        inputs: what there is.
        progress: told of every step.

    Raises:
        InputError, FileFormatError: an input that was named is missing or damaged.
    """
    if number == 9:
        return _measure_accuracy(inputs, progress)
    if number != 2 and not inputs.sources:
        return OurFigures(
            needs=["anything; texvent data pull slider_depth, or --recordings with a recording"]
        )
    if number == 2:
        return _measure_eqs_and_time(inputs, progress)
    network, missing = _find_network(number, inputs)
    found = []
    if number == 1:
        for need in missing.needs:  # said before what takes minutes
            progress(f"not measured: {need}")
        found.append(
            event_frame_figures(
                inputs.scenes(),
                is_rate_matched=inputs.is_rate_matched,
                jobs=inputs.jobs,
                progress=progress,
            )
        )
    if network is not None:
        found.append(_measure_images(number, inputs, network, progress))
    return join_figures([*found, missing])


def _find_network(number: int, inputs: PaperInputs) -> tuple[Reconstructor | None, OurFigures]:
    """The network of a table, or None and what is missing."""
    try:
        return inputs.reconstructor(number), OurFigures()
    except (InputError, MissingDependencyError) as error:
        if inputs.weights is not None:
            raise
        return None, OurFigures(needs=[f"images; {error}"])


def _measure_images(
    number: int, inputs: PaperInputs, network: Reconstructor, progress: Progress
) -> OurFigures:
    if number == 7:
        return noise_figures(inputs.whole_recordings(), network, progress=progress)
    return image_figures(
        inputs.whole_recordings(),
        network,
        prefix="images: " if number == 1 else "",
        is_rate_matched=inputs.is_rate_matched,
        progress=progress,
    )


def _measure_eqs_and_time(inputs: PaperInputs, progress: Progress) -> OurFigures:
    eqs = None if inputs.rvt_weights is None else load_eqs(inputs.rvt_weights)
    found = [time_figures(progress)]
    if eqs is None or not inputs.sources:
        needs = [
            "EQS; --rvt-weights FILE (docs/metrics.md says where it comes from) and a "
            "recording, such as texvent data pull slider_depth"
        ]
        found.append(OurFigures(needs=needs))
    else:
        found.append(
            eqs_figures(
                inputs.scenes(),
                eqs,
                is_rate_matched=inputs.is_rate_matched,
                jobs=inputs.jobs,
                progress=progress,
            )
        )
    return join_figures(found)


def _measure_accuracy(inputs: PaperInputs, progress: Progress) -> OurFigures:
    if inputs.folder is None or inputs.weights is None:
        return OurFigures(
            needs=[
                "anything; --folder DIR with recorded and simulated streams per class, and "
                "--weights FILE of N-ImageNet's classifier (texvent bench classify says where it "
                "comes from)"
            ]
        )
    return accuracy_figures(
        inputs.folder, inputs.weights, classes=inputs.classes, progress=progress
    )
