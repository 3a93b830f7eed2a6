"""One sample: a clip simulated, filtered, and stored as the members of a shard."""

from __future__ import annotations

import io
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.clips import NumberedClip, with_seed
from texvent.dataset.specification.items import Item
from texvent.dataset.specification.specification import Filters, Specification
from texvent.events import SIGNAL, EventStream
from texvent.frames import Frame
from texvent.generation.kept_frames import KeepingStream, KeptFrames
from texvent.ground_truth import Box
from texvent.pipeline import Simulation, select_events, text_to_video
from texvent.represent.event_frame import count_events
from texvent.run.prepare import prepare_source, prepare_video
from texvent.sensor import as_size
from texvent.settings.resolution import Settings
from texvent.truth.boxes import SIZE_CLASSES, detection_target, size_classes
from texvent.truth.clip import ClipTruth
from texvent.video_check.checks import VideoReport
from texvent.video_check.measurements import VideoMeasurer

if TYPE_CHECKING:
    from texvent.truth.recorder import TruthRecorder
    from texvent.truth.sinks import SampleSink


def prepare_clip(
    recipe: Recipe, clip: NumberedClip, settings: Settings, frames: KeptFrames | None = None
) -> Simulation:
    """A clip made ready; its video has the clip's seed, its simulation that of the settings.

    Args:
        recipe: of the data set.
        clip: which.
        settings: of the variant.
        frames: what other simulations of the clip have rendered; None: it is not kept.

    Raises:
        TexventError: the video cannot be read or made.
    """
    prompt = clip.item.prompt
    if recipe.items.are_videos:
        return prepare_source(clip.item.video, settings, prompt=prompt, video_seed=clip.seed)
    video = text_to_video(clip.item.subject, with_seed(settings, clip.seed))
    if isinstance(video, KeepingStream) and frames is not None:
        video = video.keeping(frames)
    return prepare_video(video, settings, prompt=prompt)


def record_truth(
    specification: Specification, item: Item, simulation: Simulation
) -> TruthRecorder[SampleSink]:
    """Recorder of the truth that a specification asks for, of the frames of a clip or its labels.

    Raises:
        TexventError: the labels cannot be read, or the video does not know its truth.
    """
    from texvent.truth.labels import read_labels  # brings OpenCV
    from texvent.truth.recorder import TruthRecorder  # brings the ray caster
    from texvent.truth.sinks import SampleSink

    video, place, labelled = simulation.video, None, set[str]()
    if item.boxes is not None:
        capture: Any = simulation.settings.source
        size = as_size(video.metadata.get("size_before_fit", video.size))
        rate_hz = None if item.box_rate is None else Fraction(item.box_rate)
        labels, is_whole = read_labels(Path(item.boxes), size), capture.stop is None
        labelled = {labels.names[one] for one in np.unique(labels.boxes["class_id"]).tolist()}
        place = partial(labels.place, fit=capture.fit, rate_hz=rate_hz, is_whole=is_whole)
    truth, classes = specification.truth, specification.class_of
    return TruthRecorder(SampleSink(video, truth, classes, place_labels=place, labelled=labelled))


COLUMNS = ("x", "y", "t", "p")
PREVIEW_US, PREVIEW_WIDTH = 50_000, 256


@dataclass(frozen=True)
class SimulatedClip:
    """The events of a sample, and what is known of its video."""

    events: EventStream
    start_us: int
    """Time of the first frame, µs."""
    duration_us: int
    """From the first frame to the last, µs."""
    signal_events: int
    """Events that the video fired, without noise; all where a simulator labels none."""
    left_out: str | None = None
    """Reason why the filters leave it out; None: it is kept."""


class SampleRun:
    """A simulation whose events become a sample; one with too many is stopped there."""

    def __init__(
        self,
        simulation: Simulation,
        filters: Filters,
        on_frame: Callable[[Frame], None] | None = None,
    ) -> None:
        """A run, not started.

        Args:
            simulation: the run.
            filters: which samples to leave out.
            on_frame: called with every dense frame.
        """
        run = self._run = simulation.settings.run
        told_apart = replace(run, keep_events="all", label_noise=True)
        self.simulation = replace(simulation, settings=replace(simulation.settings, run=told_apart))
        self._filters, self._on_frame = filters, on_frame
        self._measurer = VideoMeasurer() if filters.failed_videos else None
        self._packets: list[EventStream] = []
        self._count = self._signal = 0
        self._times: list[int] = []
        self._left_out: str | None = None

    def take(self, frame: Frame, packet: EventStream) -> bool:
        """Take the next step of `simulation`; False: no more is wanted."""
        filters = self._filters
        self._packets.append(select_events(packet, self._run))
        self._count += len(self._packets[-1])
        self._signal += _count_signal(packet)
        self._times.append(frame.t_us)
        if filters.max_events is not None and self._count > filters.max_events:
            self._left_out = f"more than {filters.max_events:,} events"
            return False
        if self._on_frame is not None:
            self._on_frame(frame)
        if self._measurer is not None and frame.is_source:
            self._measurer.add(frame)
        return True

    def finish(self) -> SimulatedClip:
        """The sample, after all steps that were wanted."""
        left_out = (
            self._left_out
            or _too_weak(self._signal, self._filters)
            or _looks_failed(self._measurer)
        )
        size, times = self.simulation.video.size, self._times
        events = EventStream.concat(self._packets) if self._packets else EventStream.empty(size)
        start = times[0] if times else 0
        length = times[-1] - start if times else 0
        return SimulatedClip(events, start, length, self._signal, left_out)


def simulate_sample(run: SampleRun) -> SimulatedClip:
    """The sample of a run.

    Raises:
        TexventError: the video cannot be read or made.
    """
    for step in run.simulation.steps():
        if not run.take(*step):
            break
    return run.finish()


def _count_signal(packet: EventStream) -> int:
    return len(packet) if packet.label is None else int(np.sum(packet.label == SIGNAL))


def _too_weak(signal: int, filters: Filters) -> str | None:
    is_weak = signal < filters.min_events
    return f"fewer than {filters.min_events:,} signal events" if is_weak else None


def _looks_failed(measurer: VideoMeasurer | None) -> str | None:
    if measurer is None:
        return None
    report = VideoReport(measurer.measurements())
    return None if report.is_fine else f"the video looks failed: {report.summary}"


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
    clip: SimulatedClip,
    facts: Mapping[str, Any],
    *,
    class_number: int | None,
    preview: bool,
    truth: Mapping[str, bytes] = MappingProxyType({}),
) -> dict[str, bytes]:
    """The files of a sample: extension → content.

    Args:
        clip: its events.
        facts: all that is known of it, for its `.json`; `prompt` becomes the `.txt`.
        class_number: of its label, or None.
        preview: whether there is an image.
        truth: files of the truth of the clip, whose facts are among `facts`.
    """
    members = {f"{name}.npy": npy_bytes(one) for name, one in event_columns(clip.events).items()}
    members["json"] = json.dumps(facts, sort_keys=True, ensure_ascii=False).encode()
    members["txt"] = (facts.get("prompt") or "").encode()
    if class_number is not None:
        members["cls"] = str(class_number).encode()
    if preview:
        known = ClipTruth({**members, **truth}.__getitem__, "the clip")
        members["png"] = preview_png(clip.events, known)
    return {**members, **truth}


def count_boxes(truth: ClipTruth) -> dict[str, Any]:
    """Facts of a sample's boxes for its record; none where boxes are not stored."""
    if "boxes" not in truth.parts:
        return {}
    boxes, sizes = truth.boxes, size_classes(truth.boxes)
    counts = {}
    for one in np.unique(boxes["class_id"]).tolist():
        own = sizes[boxes["class_id"] == one]
        counts[truth.classes[one]] = np.bincount(own, minlength=len(SIZE_CLASSES)).tolist()
    return {"boxes": counts, "tracks": len(set(boxes["track_id"].tolist()) - {0})}


def npy_bytes(array: NDArray[Any]) -> bytes:
    """An array as a .npy file."""
    file = io.BytesIO()
    np.save(file, array, allow_pickle=False)
    return file.getvalue()


def preview_png(events: EventStream, truth: ClipTruth) -> bytes:
    """The events of the liveliest 50 ms as an image, small, under the boxes nearest to its end."""
    from texvent.view.drawing.canvas import enlarge, png_bytes, shrink  # brings OpenCV
    from texvent.view.drawing.event_image import draw_events
    from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette
    from texvent.view.drawing.panels import Annotations

    start = 0
    if len(events):
        # No array of all bins: a clip may pause for days.
        bins, sizes = np.unique((events.t - events.t[0]) // PREVIEW_US, return_counts=True)
        start = int(events.t[0]) + int(bins[sizes.argmax()]) * PREVIEW_US
    counts = count_events(events.cut(start, start + PREVIEW_US))
    image = draw_events(counts, get_palette(DEFAULT_PALETTE))
    if "boxes" in truth.parts:
        factor = max(1, PREVIEW_WIDTH // events.size.width)
        image = enlarge(image, factor, how="blocks")
        Annotations(_boxes_near(truth, start + PREVIEW_US)).draw(image, factor)
    return png_bytes(shrink(image, PREVIEW_WIDTH))


def _boxes_near(truth: ClipTruth, t_us: int) -> tuple[Box, ...]:
    """Boxes at the time nearest to an instant, µs, of those at which they are known."""
    times = truth.box_times_us
    near = truth.boxes[truth.boxes["t"] == times[np.abs(times - t_us).argmin()]]
    target = detection_target(near)
    corners = np.rint(target["boxes"]).astype(int).tolist()
    return tuple(
        Box(0, truth.classes[label], x0, y0, x1, y1, visibility=1.0)
        for label, (x0, y0, x1, y1) in zip(target["labels"].tolist(), corners, strict=True)
    )
