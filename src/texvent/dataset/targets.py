"""A simulated clip cut into windows, and what is true in each besides the events."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.pipeline import Simulation
from texvent.video import Frame, FrameStream, RenderableStream

Target: TypeAlias = Literal["frame", "flow", "depth", "instance"]
Window: TypeAlias = tuple[int, int]
"""Start (included) and end (excluded), µs."""


@dataclass(frozen=True, eq=False)
class Clip:
    """A simulation that has run, cut into windows of equal length."""

    video: FrameStream
    events: EventStream
    frames: Mapping[int, Frame]
    """End of each window, µs → the last dense frame until then."""
    start_us: int
    """Start of the first window, µs: the time of the first frame."""

    @property
    def windows(self) -> tuple[Window, ...]:
        """All windows in time order."""
        ends = tuple(self.frames)
        return tuple(zip((self.start_us, *ends), ends, strict=False))


def record_clip(simulation: Simulation, slice_us: int | None) -> Clip:
    """Run a simulation and cut it into whole windows.

    Args:
        simulation: the run.
        slice_us: length of a window, µs; None: one window over the whole clip.

    Raises:
        InputError: the clip is shorter than one window, or a frame cannot be read.
    """
    packets: list[EventStream] = []
    frames: dict[int, Frame] = {}
    start_us = last_us = end_us = 0
    latest: Frame | None = None
    for frame, packet in simulation.steps():
        packets.append(packet)
        if latest is None:
            start_us = frame.t_us
            end_us = start_us + (slice_us or 0)
        # A frame at the very end of a window still belongs to it.
        while slice_us and latest is not None and frame.t_us > end_us:
            frames[end_us] = _drawn(latest)
            end_us += slice_us
        latest, last_us = frame, frame.t_us
    if latest is not None and start_us < last_us >= end_us:
        frames[end_us if slice_us else last_us] = _drawn(latest)
    if not frames:
        raise InputError(
            f"the clip lasts {last_us - start_us} µs, less than one slice of {slice_us or 1} µs; "
            "make it longer, or slice_us shorter"
        )
    return Clip(simulation.video, EventStream.concat(packets), frames, start_us)


def _drawn(frame: Frame) -> Frame:
    """The frame, drawn: an undrawn intermediate frame keeps its source frames alive."""
    frame.pixels  # noqa: B018
    return frame


def target_of(clip: Clip, target: Target, window: Window) -> NDArray[Any]:
    """What is true in a window; `SimulatedSamples.make` describes each target.

    Raises:
        ConfigError: the video does not know it.
    """
    start, stop = window
    if target == "frame":
        video = clip.video
        frame = video.at(stop) if isinstance(video, RenderableStream) else clip.frames[stop]
        return frame.luma.astype(np.float32)
    describe = getattr(clip.video, "ground_truth", None)
    if describe is None:
        raise ConfigError(
            f"target {target!r} needs a source that knows its scene, such as prompts with the "
            "generator 'procedural'; recorded and learned video has frames alone"
        )
    truth = describe(start if target == "flow" else stop, stop)
    if target == "flow":
        return np.moveaxis(truth.flow, -1, 0)
    return np.asarray(truth.depth if target == "depth" else truth.instance)
