"""The files of a run, written while it runs: events, preview video, image and page."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from texvent.events import EventStream
from texvent.io.files import open_writer
from texvent.pairs.frame_pair import OnSceneChange
from texvent.pipeline import Simulation
from texvent.runtime.background_writer import BackgroundWriter
from texvent.video import Frame
from texvent.view.drawing.palettes import DEFAULT_PALETTE


def write_run(
    simulation: Simulation,
    path: Path,
    *,
    previews: tuple[str, ...] = (),
    palette: str = DEFAULT_PALETTE,
    overwrite: bool = False,
    metadata: Mapping[str, Any] | None = None,
    on_step: Callable[[Frame, EventStream], None],
    on_scene_change: OnSceneChange | None = None,
) -> None:
    """Run a simulation into its files; none appears under its name before all are complete.

    Everything is opened, and so checked, before any work. Each output is written by a thread of
    its own, while the next frames are simulated.

    Args:
        simulation: the run.
        path: event file; previews are named after it.
        previews: kinds of preview, as file extensions without the dot.
        palette: colours of the previews.
        overwrite: whether existing files may be replaced.
        metadata: stored with the events; default: the provenance of the run.
        on_step: given every dense frame and its packet; an exception from it ends the run.
        on_scene_change: called at every cut and flash.

    Raises:
        OutputError: a file exists already, or cannot be written.
        InputError: the frames cannot be used.
    """
    size, facts = simulation.video.size, metadata or simulation.provenance
    with ExitStack() as outputs:
        # The exit stack closes in reverse: the event file is safe on disk before the previews end.
        shown: BackgroundWriter | None = None
        if previews:
            # Imported here: it brings PyAV and OpenCV, which help and the event file do not need.
            from texvent.view.preview import Preview

            preview = Preview(
                path.with_suffix(""),
                size=size,
                fps=simulation.video.fps,
                kinds=previews,
                palette=palette,
                overwrite=overwrite,
                metadata=facts,
            )
            shown = outputs.enter_context(BackgroundWriter(outputs.enter_context(preview)))
        writer = open_writer(path, size=size, metadata=facts, overwrite=overwrite)
        events = outputs.enter_context(BackgroundWriter(outputs.enter_context(writer)))
        for frame, packet in simulation.steps(on_scene_change):
            if shown is not None:
                shown.append(frame, packet)
            events.append(packet)
            on_step(frame, packet)
