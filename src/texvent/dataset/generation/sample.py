"""One sample: a video simulated, filtered, and put into the columns of its files."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.specification.specification import Filters
from texvent.errors import TexventError
from texvent.events import EventStream
from texvent.pipeline import Simulation
from texvent.represent.event_frame import count_events
from texvent.video_check.measurer import VideoMeasurer
from texvent.video_check.report import judge_measures

COLUMNS = ("x", "y", "t", "p")
PREVIEW_US, PREVIEW_WIDTH = 50_000, 256


class FilteredError(TexventError):
    """A sample that the filters leave out."""


@dataclass(frozen=True)
class MadeEvents:
    """The events of a sample, and what is known of its video."""

    events: EventStream
    start_us: int
    """Time of the first frame, µs."""
    duration_us: int
    """From the first frame to the last, µs."""


def simulate_sample(simulation: Simulation, filters: Filters) -> MadeEvents:
    """Run a simulation and apply the filters.

    Raises:
        FilteredError: too few or too many events, or the video looks failed.
        TexventError: the video cannot be read or made.
    """
    measurer = VideoMeasurer() if filters.failed_videos else None
    packets, count, times = [], 0, []
    for frame, packet in simulation.steps():
        packets.append(packet)
        count += len(packet)
        times.append(frame.t_us)
        if filters.max_events is not None and count > filters.max_events:
            raise FilteredError(f"more than {filters.max_events:,} events")
        if measurer is not None and frame.is_source:
            measurer.add(frame)
    if count < filters.min_events:
        raise FilteredError(f"{count:,} events, fewer than {filters.min_events:,}")
    if measurer is not None:
        report = judge_measures(measurer.measures())
        if not report.is_fine:
            raise FilteredError(f"the video looks failed: {report.summary}")
    events = EventStream.concat(packets) if packets else EventStream.empty(simulation.video.size)
    start = times[0] if times else 0
    return MadeEvents(events, start, times[-1] - start if times else 0)


def event_columns(events: EventStream) -> dict[str, NDArray[Any]]:
    """x, y: uint16; t: µs, uint32, int64 where it does not fit; p: uint8, 1 is ON."""
    fits = len(events) == 0 or (events.t[0] >= 0 and int(events.t[-1]) < 2**32)
    columns = {
        "x": events.x.astype(np.uint16),
        "y": events.y.astype(np.uint16),
        "t": events.t.astype(np.uint32 if fits else np.int64),
        "p": events.p.astype(np.uint8),
    }
    if events.label is not None:
        columns["label"] = events.label.astype(np.uint8)
    return columns


def sample_members(
    made: MadeEvents, facts: Mapping[str, Any], *, class_number: int | None, preview: bool
) -> dict[str, bytes]:
    """The files of a sample: extension → content.

    Args:
        made: its events.
        facts: all that is known of it, for its `.json`; `prompt` becomes the `.txt`.
        class_number: of its label, or None.
        preview: whether there is an image.
    """
    members = {f"{name}.npy": npy_bytes(one) for name, one in event_columns(made.events).items()}
    members["json"] = json.dumps(facts, sort_keys=True, ensure_ascii=False).encode()
    members["txt"] = (facts.get("prompt") or "").encode()
    if class_number is not None:
        members["cls"] = str(class_number).encode()
    if preview:
        members["png"] = preview_png(made.events)
    return members


def npy_bytes(array: NDArray[Any]) -> bytes:
    """An array as a .npy file."""
    file = io.BytesIO()
    np.save(file, array, allow_pickle=False)
    return file.getvalue()


def preview_png(events: EventStream) -> bytes:
    """The events of the liveliest 50 ms as an image, small."""
    from texvent.view.drawing.canvas import png_bytes, shrink  # brings OpenCV
    from texvent.view.drawing.event_image import draw_events
    from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette

    start = 0
    if len(events):
        bins = np.bincount((events.t - events.t[0]) // PREVIEW_US)
        start = int(events.t[0]) + int(bins.argmax()) * PREVIEW_US
    counts = count_events(events.cut(start, start + PREVIEW_US))
    return png_bytes(shrink(draw_events(counts, get_palette(DEFAULT_PALETTE)), PREVIEW_WIDTH))
