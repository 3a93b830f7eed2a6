"""A run in memory whose ground truth is written to a folder."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.pipeline import Simulation
from texvent.runtime.progress import Progress
from texvent.runtime.work.worker_threads import BackgroundWriter
from texvent.truth.layout import ALL, PARTS, check_truth_folder, parse_parts

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
