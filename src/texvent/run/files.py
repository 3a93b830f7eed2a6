"""Files of a run, written while it runs: events, preview video, image, page, ground truth."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.io.block_writer import BlockWriter
from texvent.io.files import open_writer
from texvent.pairs.frame_pair import OnSceneChange
from texvent.pipeline import Simulation
from texvent.runtime.progress import Progress
from texvent.runtime.work.interrupts import StopRequest, stop_on_interrupt
from texvent.runtime.work.worker_threads import BackgroundWriter
from texvent.truth.layout import ALL, PARTS, check_truth_folder, parse_parts, truth_folder
from texvent.view.drawing.palettes import DEFAULT_PALETTE

if TYPE_CHECKING:
    from texvent.truth.recorder import TruthRecorder
    from texvent.truth.sinks import FolderSink


@dataclass(frozen=True)
class TruthFolder:
    """Truth that a run writes, and its folder.

    Example:
        >>> from texvent import TruthFolder
        >>> TruthFolder("car.truth", "flow,boxes").names
        ('flow', 'boxes')
    """

    path: str | Path
    """The folder."""
    parts: str | Iterable[str] = ALL
    """flow, flow-back, depth, ids, boxes, poses, events, with commas between, or
    "all"."""
    overwrite: bool = False
    """Whether a folder of truth may be replaced."""

    @property
    def names(self) -> tuple[str, ...]:
        """The parts by name.

        Raises:
            ConfigError: an unknown part, or none.
        """
        names = parse_parts(self.parts)
        if not names:
            raise ConfigError(f"no part of truth is named; give some of {', '.join(PARTS)}, or all")
        return names

    def check(self) -> None:
        """Refuse what cannot be written, before any work.

        Raises:
            ConfigError: an unknown part, or none.
            OutputError: the folder exists already, or cannot be made.
        """
        self.names  # noqa: B018
        check_truth_folder(Path(self.path), overwrite=self.overwrite)

    def recorder(
        self,
        run: Simulation,
        on_events: Callable[[EventStream], None],
        metadata: Mapping[str, Any] | None = None,
    ) -> TruthRecorder[FolderSink]:
        """Recorder of the truth of a run, to be opened by `with`.

        Args:
            run: the run.
            on_events: as `TruthRecorder` takes it.
            metadata: stored with the truth; default: the provenance of the run.
        """
        # Imported here: they bring the ray caster and OpenCV.
        from texvent.truth.recorder import TruthRecorder
        from texvent.truth.sinks import FolderSink

        facts = metadata or run.provenance
        sink = FolderSink(
            self.path, run.video, self.names, metadata=facts, overwrite=self.overwrite
        )
        return TruthRecorder(sink, on_events=on_events)


def run_with_truth(run: Simulation, folder: TruthFolder, progress: Progress) -> EventStream:
    """The events of a run, in memory; its truth is written meanwhile.

    Where the ids of events are among the truth, the events have them too.

    Args:
        run: the run.
        folder: which truth, and where.
        progress: receives each source frame.

    Raises:
        ConfigError, InputError: the video does not know its truth.
        OutputError: the folder cannot be written.

    Warns:
        TexventWarning: there is no signal, or hardly any.
    """
    packets = [EventStream.empty(run.video.size)]
    has_ids, done = "events" in folder.names, 0
    with ExitStack() as stack:
        writer = stack.enter_context(folder.recorder(run, packets.append))
        background = stack.enter_context(BackgroundWriter(writer))
        for frame, packet in replace(run, warns=True).steps():
            background.append(frame, packet)
            if not has_ids:
                packets.append(packet)
            done += frame.is_source
            progress.advance("simulate", done, run.video.frame_count)
    return EventStream.concat(packets).with_metadata(run.provenance)


PREVIEW_SUFFIX = ".events"
"""Stands before the extension of previews, so that none takes the name of a source video."""

OnStep = Callable[[Frame, EventStream], None]


@dataclass(frozen=True)
class RunFiles:
    """Files that a run writes."""

    events: Path
    """Event file; previews are named after it."""
    format: str | None = None
    """Its format; None where its extension decides."""
    previews: tuple[str, ...] = ()
    """Kinds of preview, as file extensions without the dot."""
    palette: str = DEFAULT_PALETTE
    """Colours of the previews."""
    overwrite: bool = False
    """Whether existing files may be replaced."""
    truth: tuple[str, ...] = ()
    """Parts of ground truth to write; see `texvent.truth.layout`."""
    keep_partial: bool = False
    """Whether a run that is stopped, or whose input ends in damage, keeps what it has made."""

    @property
    def preview_stem(self) -> Path:
        """Previews without their extension: `clip.events` for `clip.h5`."""
        name = self.events.with_suffix("").name.removesuffix(PREVIEW_SUFFIX)
        return self.events.with_name(f"{name}{PREVIEW_SUFFIX}")

    @property
    def truth_folder(self) -> Path | None:
        """Folder of ground truth, such as `clip.truth` for `clip.h5`; None where none is wanted."""
        return truth_folder(self.events) if self.truth else None

    @property
    def outputs(self) -> tuple[Path, ...]:
        """All files and folders."""
        return self.paths if self.truth_folder is None else (*self.paths, self.truth_folder)

    @property
    def paths(self) -> tuple[Path, ...]:
        """All files but the truth."""
        stem = self.preview_stem
        previews = (stem.with_name(f"{stem.name}.{kind}") for kind in self.previews)
        return (self.events, *previews)


@dataclass(frozen=True)
class EarlyStop:
    """Why a run ended before its video, though its files are complete."""

    t_us: int
    """Time of the last frame, µs."""
    signal: int | None = None
    """Signal that stopped the run, if any."""
    error: InputError | None = None
    """Input error that stopped the run, if any."""

    @property
    def facts(self) -> Mapping[str, Any]:
        """Facts that the files store of it."""
        reason = str(self.error) if self.signal is None else signal.Signals(self.signal).name
        return {"complete": False, "stopped_us": self.t_us, "stopped_by": reason}


def write_run(
    simulation: Simulation,
    files: RunFiles,
    *,
    metadata: Mapping[str, Any] | None = None,
    on_step: OnStep,
    on_scene_change: OnSceneChange | None = None,
) -> EarlyStop | None:
    """Run a simulation into its files; none appears under its name before all are complete.

    Everything is opened, and so checked, before any work; a thread of its own writes each output.

    Args:
        simulation: the run.
        files: what is written.
        metadata: stored with the events; default: the provenance of the run.
        on_step: given every dense frame and its packet; an exception from it ends the run.
        on_scene_change: called at every cut and flash.

    Returns:
        Why the run ended early, where partial results are kept; else None.

    Raises:
        OutputError: a file exists already, or cannot be written.
        InputError: the frames cannot be used.

    Warns:
        TexventWarning: there is no signal, or hardly any.
    """
    facts = metadata or simulation.provenance
    at_first = dict(simulation.video.metadata)
    with ExitStack() as outputs:
        # The exit stack closes in reverse: the event file is safe on disk before the previews end.
        preview = _open_previews(outputs, simulation, files, facts)
        sinks: list[OnStep] = []
        if preview is not None:
            sinks.append(outputs.enter_context(BackgroundWriter(preview)).append)
        writer = outputs.enter_context(_open_events(simulation, files, facts))
        append = outputs.enter_context(BackgroundWriter(writer)).append

        def append_labelled(packet: EventStream) -> None:
            # A file without a place for the ids of objects has them in the folder of truth.
            append(packet if writer.keeps_labels else packet.with_ids(None, None))

        # The truth ends before the event file does, for it may give it its events.
        truth = None
        if files.truth_folder is not None:
            folder = TruthFolder(files.truth_folder, files.truth, files.overwrite)
            truth = outputs.enter_context(folder.recorder(simulation, append_labelled, facts))
            sinks.append(outputs.enter_context(BackgroundWriter(truth)).append)
        if "events" not in files.truth:
            sinks.append(lambda frame, packet: append(packet))
        stop = outputs.enter_context(stop_on_interrupt()) if files.keep_partial else StopRequest()
        steps = replace(simulation, warns=True).steps(on_scene_change)
        early = _run_steps(steps, [*sinks, on_step], stop, files.keep_partial)
        added = {**_found_late(simulation, at_first, facts), **(early.facts if early else {})}
        for output in (writer, preview, truth) if added else ():
            if output is not None:
                output.add_metadata(added)
    return early


def _found_late(
    simulation: Simulation, at_first: Mapping[str, Any], facts: Mapping[str, Any]
) -> dict[str, Any]:
    """Facts of the source with those that only reading it tells, such as the frames dropped."""
    found = simulation.video.metadata
    late = {name: one for name, one in found.items() if at_first.get(name) != one}
    return {"source": {**facts.get("source", {}), **late}} if late else {}


def _run_steps(
    steps: Iterator[tuple[Frame, EventStream]],
    sinks: Sequence[OnStep],
    stop: StopRequest,
    keep_partial: bool,
) -> EarlyStop | None:
    """Give every step to all sinks, until the end or a reason to stop."""
    t_us: int | None = None
    try:
        for frame, packet in steps:
            for sink in sinks:
                sink(frame, packet)
            t_us = frame.t_us
            if stop.number is not None:
                return EarlyStop(t_us, signal=stop.number)
    except InputError as error:
        if not keep_partial or t_us is None:
            raise
        return EarlyStop(t_us, error=error)
    return None


def _open_events(simulation: Simulation, files: RunFiles, facts: Mapping[str, Any]) -> BlockWriter:
    """A writer of the events; a format that the name does not tell is stored."""
    return open_writer(
        files.events,
        size=simulation.video.size,
        metadata=facts if files.format is None else {**facts, "format": files.format},
        format=files.format,
        overwrite=files.overwrite,
    )


def _open_previews(
    outputs: ExitStack, simulation: Simulation, files: RunFiles, facts: Mapping[str, Any]
) -> Any:
    """The previews, open; None where none is wanted."""
    if not files.previews:
        return None
    # Imported here: it brings PyAV and OpenCV, which help and the event file do not need.
    from texvent.view.preview import Preview

    preview = Preview(
        files.preview_stem,
        size=simulation.video.size,
        fps=simulation.video.fps,
        kinds=files.previews,
        palette=files.palette,
        overwrite=files.overwrite,
        metadata=facts,
    )
    return outputs.enter_context(preview)
