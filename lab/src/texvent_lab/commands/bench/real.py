"""`texvent bench real`: simulators against the events that a real sensor recorded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import ClassVar

from texvent.cli.notices import write_out
from texvent.cli.options import parse_configs
from texvent.config import check_range
from texvent.data.catalogue import DATA_SETS
from texvent.view.video_writer import write_clips
from texvent_lab.bench.fidelity.entries import ConfigEntry, Entry, choose_entries
from texvent_lab.bench.fidelity.event_files import FileEntry, named_folders
from texvent_lab.bench.fidelity.table import BASELINE, check_baseline, fidelity_tables
from texvent_lab.bench.real.recording import (
    LINEAR_GAMMA,
    RecordingPart,
    open_scene,
    used_frames,
)
from texvent_lab.bench.real.run import INTERPOLATIONS, real_entries, run_real
from texvent_lab.bench.reconstruction.run import (
    ReconstructionPlan,
    ReconstructionScorer,
    run_reconstruction,
)
from texvent_lab.bench.reconstruction.table import reconstruction_document, reconstruction_tables
from texvent_lab.commands.bench.bench import ResultOptions
from texvent_lab.frame_recordings import (
    WITH_FRAMES,
    FrameRecording,
    locate_source,
    open_recording,
    recording_name,
)
from texvent_lab.reconstruct.image_measures import load_measures
from texvent_lab.reconstruct.reconstructor import find_network, load_reconstructor

DESCRIPTION = """\
Simulators get the frames that a sensor recorded, and are scored by the events it recorded; with
--network, by the images that a network makes of either, beside the frames.

A source is a pulled data set (slider_depth, davis346), a folder of the Event-Camera Dataset, an
EVREAL folder with images, a DSEC sequence, or an AEDAT4 file with frames. docs/real-data.md
explains the tables."""


@dataclass(frozen=True, kw_only=True)
class RealOptions:
    """Recordings and simulators."""

    input_texts: ClassVar[tuple[str, ...]] = ("sources",)
    outputs: ClassVar[tuple[str, ...]] = ("write_frames",)
    positional: ClassVar[tuple[str, ...]] = ("sources",)
    main_options: ClassVar[tuple[str, ...]] = (
        "start", "seconds", "simulators", "interpolations", "config", "baseline", "network", "out",
        "overwrite",
    )  # fmt: skip

    sources: tuple[str, ...] = WITH_FRAMES
    """Names of pulled data sets, or paths of recordings."""
    start: float = 0.0
    """Skip this much of each recording, in seconds."""
    seconds: float = 4.0
    """Longest part that is used, in seconds: δ is fitted on its first half, its second scored."""
    offset_us: int | None = None
    """Added to the times of the frames, µs; default: what the catalogue knows of a data set, 0
    for others. `texvent calibrate` finds it; half of the exposure where stamps are its start."""
    frames_gamma: float | None = None
    """Exponent that makes the frames linear; default: 1 (DAVIS), for DSEC 2.2."""
    simulators: str | None = None
    """Names of simulators, separated by commas, a preset after a colon (physical:davis346);
    default: all that are registered, texvent:paper, and sensor presets of physical."""
    interpolations: str | None = None
    """Names of interpolators, separated by commas; default: none,blend,flow."""
    config: Path | None = None
    """Sensor file that texvent calibrate wrote, or any config file: one more row, its threshold
    left as it is."""
    baseline: str = BASELINE
    """Row that the others are compared with, pair by pair."""
    network: str | None = None
    """Score images: pie-net, or firenet, firenet+, e2vid, e2vid+ with their weights. Default rows:
    flow. The first 10 images do not count."""
    weights: Path | None = None
    """File with the network's weights; pie-net's package has its own."""
    match_rate: bool = False
    """With network: fit each contrast threshold to the number of recorded events."""
    events: tuple[str, ...] = ()
    """NAME=FOLDER of one more row, of another program: an event file per recording, named as it and
    on the clock of its frames; or a sub-folder of such files per contrast threshold (0.15, 0.2), of
    which the one is scored that fits the number of recorded events."""
    write_frames: Path | None = None
    """Write the frames of each recording into a folder here, for other programs, and end."""
    jobs: int = 2
    """Processes to use; with network, one."""

    def __post_init__(self) -> None:
        check_range("start", self.start, 0.0)
        check_range("seconds", self.seconds, 0.5)
        check_range("frames_gamma", self.frames_gamma, 0.1, 10.0)
        check_range("jobs", self.jobs, 1, 256)


def run(arguments: Sequence[str]) -> None:
    """Run the command."""
    options, output = parse_configs(
        arguments,
        {"options": RealOptions(), "output": ResultOptions()},
        prog="texvent bench real",
        description=DESCRIPTION,
    )
    output.check()
    part = RecordingPart(options.start, options.seconds, options.offset_us, options.frames_gamma)
    if options.write_frames is not None:
        _write_frames(options.sources, options.write_frames, part, output)
        return
    entries = _choose_entries(options)
    if options.network is not None:
        _score_images(options, options.network, entries, output)
        return
    check_baseline(options.baseline, [entry.name for entry in entries])
    scenes = [open_scene(source, part) for source in options.sources]
    report = run_real(scenes, entries, jobs=options.jobs, progress=output.progress)
    output.write(report.document)
    write_out(fidelity_tables(report, baseline=options.baseline))


def _score_images(
    options: RealOptions, network: str, entries: Sequence[Entry], output: ResultOptions
) -> None:
    plan = ReconstructionPlan(
        entries=entries,
        start_s=options.start,
        seconds=options.seconds,
        is_rate_matched=options.match_rate,
        frames_gamma=options.frames_gamma or LINEAR_GAMMA,
    )
    reconstructor = load_reconstructor(find_network(network).name, options.weights)
    recordings = [_open_whole(source) for source in options.sources]
    scorer = ReconstructionScorer(reconstructor=reconstructor, measures=load_measures(), plan=plan)
    report = run_reconstruction(recordings, scorer, progress=output.progress)
    output.write(lambda: reconstruction_document(report))
    write_out(reconstruction_tables(report))


def _write_frames(
    sources: Sequence[str], folder: Path, part: RecordingPart, output: ResultOptions
) -> None:
    """Write the used frames of each recording, on their own clock, and say what to do with them."""
    recordings = ((one, open_recording(locate_source(one)[0])) for one in sources)
    used = ((recording_name(source), used_frames(one, part)) for source, one in recordings)
    write_clips(used, folder, overwrite=output.overwrite)
    write_out(
        f"frames of {', '.join(map(recording_name, sources))} in {folder}, their times in "
        f"timestamps.txt\nnext: simulate each on that clock into {recording_name(sources[0])}.h5 "
        "and so on, then texvent bench real --events NAME=FOLDER\n"
    )


def _open_whole(source: str) -> FrameRecording:
    recording = open_recording(locate_source(source)[0])
    return replace(recording, name=source) if source in DATA_SETS else recording


def _choose_entries(options: RealOptions) -> list[Entry]:
    entries: list[Entry] = real_entries()
    if options.network is not None:
        entries = [entry for entry in entries if entry.interpolate == "flow"]
    if options.simulators or options.interpolations:
        usual = ",".join(INTERPOLATIONS) if options.network is None else "flow"
        names = options.interpolations or usual
        entries = choose_entries(options.simulators, names)
    if options.config is not None:
        entries.append(ConfigEntry.read(options.config))
    recordings = [recording_name(source) for source in options.sources]
    entries += [FileEntry.find(*row, recordings) for row in named_folders(options.events).items()]
    return entries
