"""Events, video and rate as a recording for the rerun viewer. The file that knows rerun."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.atomic import atomic_file
from texvent.video import MICROSECONDS, FrameStream
from texvent.view.drawing.caption import title_of
from texvent.view.drawing.event_image import frame_image
from texvent.view.drawing.palettes import Palette, get_palette
from texvent.view.page.sample import UniformSample
from texvent.view.render_config import RenderConfig
from texvent.view.windows.cut import cut_streams, time_range

TIMELINE = "time"
WINDOWS = 400
"""Where the window is not given, a recording is cut into about this many."""
SHORTEST_WINDOW_US = 1_000


def write_rrd(
    packets: EventPackets,
    path: Path,
    config: RenderConfig,
    *,
    frames: FrameStream | None = None,
    overwrite: bool = False,
) -> None:
    """Write a .rrd file that `rerun` opens.

    On the timeline "time" (a duration, ns in the file): `plane/events`, the events of each window
    as coloured points over `plane/video`, the frames; and `rate/on`, `rate/off`, events per
    second. Without time: `cloud`, a fair sample in x, y and time (1 s is as long as the sensor is
    wide), and `run`, the facts.

    Args:
        packets: the recording; read twice.
        path: .rrd file.
        config: palette, window and points.
        frames: the video.
        overwrite: whether an existing file may be replaced.

    Raises:
        InputError: there is no event to show.
        MissingDependencyError: rerun-sdk, the extra "rerun", is not installed.
        OutputError: the file exists already or cannot be written.
    """
    rerun = require("rerun", extra="rerun")
    extent = time_range(packets)
    if extent is None:
        raise InputError("the recording, or the part asked for, holds no events to show")
    window_us = config.window_us or max(SHORTEST_WINDOW_US, (extent[1] - extent[0]) // WINDOWS)
    palette = get_palette(config.palette)
    with atomic_file(path, overwrite=overwrite) as part:
        recording: Any = rerun.RecordingStream("texvent", recording_id=path.stem)
        recording.save(part)
        log = _Log(rerun, recording, palette)
        log.facts(packets)
        for frame in frames or ():
            if frame.t_us >= extent[1]:
                break
            log.frame(frame_image(frame), frame.t_us)
        sample = UniformSample(packets.size, limit=config.points)
        windows = cut_streams(packets, packets.size, Fraction(window_us), window_us)
        for start_us, events in windows:
            sample.append(events)
            log.window(events, start_us, window_us)
        log.cloud(sample.events(), extent[0])
        recording.flush()
        recording.disconnect()


class _Log:
    """Writes into one rerun recording."""

    def __init__(self, rerun: Any, recording: Any, palette: Palette) -> None:
        self._rerun, self._recording = rerun, recording
        self._colours = np.array([palette.off, palette.on], dtype=np.uint8)
        for name, colour in (("on", palette.on), ("off", palette.off)):
            line = rerun.SeriesLines(colors=[colour], names=[f"{name.upper()} events per second"])
            recording.log(f"rate/{name}", line, static=True)

    def facts(self, packets: EventPackets) -> None:
        text = f"{title_of(packets.metadata) or 'events'}\n\nsensor {packets.size}"
        self._recording.log("run", self._rerun.TextDocument(text), static=True)

    def frame(self, image: Any, t_us: int) -> None:
        self._at(t_us)
        self._recording.log("plane/video", self._rerun.Image(image).compress(jpeg_quality=85))

    def window(self, events: EventStream, start_us: int, window_us: int) -> None:
        self._at(start_us)
        places = np.stack([events.x, events.y], axis=1).astype(np.float32) + np.float32(0.5)
        points = self._rerun.Points2D(places, colors=self._colours[events.p], radii=0.5)
        self._recording.log("plane/events", points)
        on_events = int(events.p.sum())
        for name, count in (("on", on_events), ("off", len(events) - on_events)):
            rate = count * MICROSECONDS / window_us
            self._recording.log(f"rate/{name}", self._rerun.Scalars(rate))

    def cloud(self, events: EventStream, start_us: int) -> None:
        depth = (events.t - start_us) * (events.size.width / MICROSECONDS)
        places = np.stack([events.x, events.y, depth], axis=1).astype(np.float32)
        points = self._rerun.Points3D(places, colors=self._colours[events.p])
        self._recording.log("cloud", points, static=True)

    def _at(self, t_us: int) -> None:
        duration = np.timedelta64(t_us, "us")
        self._recording.set_time(TIMELINE, duration=duration)
