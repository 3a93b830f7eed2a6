"""`texvent bench reconstruction`: simulators scored by the images made from their events."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import ClassVar

from texvent.cli.event_files.event_file_options import parse_time_range
from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.errors import ConfigError
from texvent_lab.bench.fidelity.entries import choose_entries
from texvent_lab.bench.real.recording import FrameRecording, locate_source, open_recording
from texvent_lab.bench.reconstruction.run import (
    ReconstructionPlan,
    ReconstructionScorer,
    run_reconstruction,
)
from texvent_lab.bench.reconstruction.table import reconstruction_document, reconstruction_tables
from texvent_lab.commands.bench.bench import ResultOptions
from texvent_lab.reconstruct.image_measures import load_measures
from texvent_lab.reconstruct.reconstructor import ReconstructConfig, load_reconstructor

DESCRIPTION = """\
A network makes an image at every frame of a recording, once from the recorded events and once from
those that each simulator makes of the frames. All are compared with the frames themselves.

A recording is a pulled data set (slider_depth, davis346), a folder of the Event-Camera Dataset, an
EVREAL folder with images, an AEDAT4 file with frames, or an event file with --frames. The
network's weights must be yours: docs/reconstruction.md says where they come from."""


@dataclass(frozen=True, kw_only=True)
class ReconstructionOptions:
    """Recordings and simulators."""

    input_texts: ClassVar[tuple[str, ...]] = ("recordings", "frames")
    positional: ClassVar[tuple[str, ...]] = ("recordings",)
    main_options: ClassVar[tuple[str, ...]] = (
        "network", "weights", "simulators", "interpolations", "match_rate", "time", "out",
        "overwrite",
    )  # fmt: skip

    recordings: tuple[str, ...] = ("slider_depth",)
    """Names of pulled data sets, or paths of recordings."""
    frames: str | None = None
    """Frames of a recording that is an event file alone: a video or image folder on its clock."""
    simulators: str | None = None
    """Names of simulators, separated by commas, a preset after a colon (physical:davis346);
    default: texvent, physical, esim, v2e."""
    interpolations: str | None = None
    """Names of interpolators, separated by commas; default: flow, for texvent also blend."""
    match_rate: bool = False
    """Fit each contrast threshold to the number of recorded events, instead of keeping it."""
    frames_gamma: float = 1.0
    """Exponent that makes the frames linear: 1 for those of a DAVIS, 2.2 for ordinary video."""
    time: str | None = None
    """Score START,STOP alone, in seconds of the recording's clock. Without it: the part that EVREAL
    scores, where it names the recording, else all."""
    skip_frames: int | None = None
    """Do not score this many images at the start, and score all others; default: 10, but 0 where
    a part is named."""
    seed: int = 0
    """Of the simulators."""

    def plan(self) -> ReconstructionPlan:
        """The plan of these options.

        Raises:
            ConfigError: a value is out of range, or something named does not exist.
        """
        plan = ReconstructionPlan(
            span_us=None if self.time is None else parse_time_range(self.time),
            skip=self.skip_frames,
            is_rate_matched=self.match_rate,
            frames_gamma=self.frames_gamma,
            seed=self.seed,
        )
        if self.simulators is None and self.interpolations is None:
            return plan
        simulators = self.simulators or "texvent,physical,esim,v2e"
        return replace(plan, entries=choose_entries(simulators, self.interpolations or "flow"))

    def open_recordings(self) -> list[FrameRecording]:
        """The recordings.

        Raises:
            ConfigError: frames are given for several recordings.
            InputError: a recording is not there, or holds no frames.
        """
        if self.frames is not None and len(self.recordings) != 1:
            raise ConfigError(
                f"frames belong to one recording; {len(self.recordings)} are given: run them one "
                "by one"
            )
        return [
            open_recording(locate_source(source)[0], frames=self.frames)
            for source in self.recordings
        ]


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, network, output = parse_configs(
        arguments,
        {
            "input": ReconstructionOptions(),
            "network": ReconstructConfig(),
            "output": ResultOptions(),
        },
        prog="texvent bench reconstruction",
        description=DESCRIPTION,
    )
    output.check()
    plan = options.plan()
    reconstructor = load_reconstructor(network.network, network.weights, device=network.device)
    recordings = options.open_recordings()
    scorer = ReconstructionScorer(reconstructor=reconstructor, measures=load_measures(), plan=plan)
    report = run_reconstruction(recordings, scorer, progress=output.progress)
    output.write(lambda: reconstruction_document(report))
    write_out(reconstruction_tables(report))
