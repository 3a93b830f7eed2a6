"""Simulated samples for training: prompt or video → events → arrays, made from their numbers."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, partial
from pathlib import Path
from typing import Any, ClassVar, Literal, TypeAlias, cast, get_args

import numpy as np

from texvent.api.functions import Source
from texvent.config import check_range
from texvent.dataset.sample_table import Arrays, SampleTable, Targets, Window, stack_windows
from texvent.dataset.specification.entries import entries_of
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.frames import Frame, FrameStream, RenderableStream
from texvent.pipeline import Simulation
from texvent.run.prepare import open_subject, prepare_prompt, prepare_source
from texvent.sensor import SensorSize
from texvent.settings.resolution import Settings, resolve
from texvent.simulation.random.draws import frame_key
from texvent.truth.boxes import box_records, detection_target
from texvent.truth.class_ids import class_ids_of

Target: TypeAlias = Literal["frame", "flow", "depth", "instance", "boxes"]


@dataclass(frozen=True, eq=False)
class SlicedClip:
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


def record_clip(simulation: Simulation, slice_us: int | None) -> SlicedClip:
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
    return SlicedClip(simulation.video, EventStream.concat(packets), frames, start_us)


def _drawn(frame: Frame) -> Frame:
    """The frame, drawn: an undrawn intermediate frame keeps its source frames alive."""
    frame.pixels  # noqa: B018
    return frame


def target_of(clip: SlicedClip, target: Target, window: Window) -> Any:
    """Ground truth of a window; `SimulatedSamples` describes each target.

    Raises:
        ConfigError: the video does not know it.
    """
    start, stop = window
    if target == "frame":
        video = clip.video
        frame = video.at(stop) if isinstance(video, RenderableStream) else clip.frames.get(stop)
        if frame is None:
            raise ConfigError(NO_FRAME)
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
    if target == "boxes":
        ids = class_ids_of(box.class_name for box in truth.boxes)
        class_ids = [ids[box.class_name] for box in truth.boxes]
        return detection_target(box_records(stop, truth.boxes, class_ids))
    return np.asarray(truth.depth if target == "depth" else truth.instance)


MAX_SEED = 2**63 - 1
NO_FRAME = (
    "target 'frame' of slices of events needs a source that is rendered at any instant, such as "
    "prompts with the generator 'procedural'; give slice_us"
)


@dataclass(frozen=True, kw_only=True, eq=False)
class SimulatedSamples(SampleTable):
    """A table of samples without end, none of which is stored.

    Sample i shows source i modulo the number of sources, simulated with a seed that depends on
    `seed` and i alone. So any order, any split over processes and any machine gives the same
    samples, and every pass over the sources gives new ones. `make` gives too:

    * `source`: index of the prompt or video.
    * `frame`: luma at the end of the slice, [H, W] float32, 0..255. A video that cannot be
      rendered at that instant gives its last frame until then, interpolated ones included.
    * `flow`: displacement (x, y) in pixels over the slice of what each pixel shows at its start,
      [2, H, W] float32; NaN where it ends behind the camera.
    * `depth`: metres at the end of the slice, [H, W] float32; inf for the sky.
    * `instance`: id of the object seen at the end of the slice, [H, W] int32.
    * `boxes`: at the end of the slice, as `texvent.truth.boxes.detection_target` gives them, a
      tuple over slices; labels are the class ids of nouns.

    With slices, targets have a first axis for them.

    Raises:
        ConfigError: no sources or two kinds of them; an unknown representation, option or target.

    Example:
        >>> from texvent.dataset import SimulatedSamples
        >>> samples = SimulatedSamples(
        ...     prompts=["a red ball flies left"],
        ...     slice_us=50_000,
        ...     simulation={"sensor": "32x24", "duration": 0.125},
        ... )
        >>> samples.make(0)["representation"].shape  # time, bins, rows, columns
        (2, 5, 24, 32)
    """

    prompts: Sequence[str] = ()
    """Prompts; see `texvent.generate`."""
    videos: Sequence[Source] = ()
    """Videos instead of prompts; see `texvent.simulate`. A folder of videos stands for these, and
    for those of the folders in it."""
    representation: str | None = "voxel-e2vid"
    simulation: Mapping[str, Any] = field(default_factory=dict)
    """Options of `texvent.generate` or `texvent.simulate`, such as `{"sensor": "davis240c",
    "duration": 1.0, "randomize": "stoffregen"}`."""
    seed: int = 0
    """Seed of the seeds, 0..2⁶³−1."""

    known_targets: ClassVar[tuple[str, ...]] = get_args(Target)

    def __post_init__(self) -> None:
        for name, sources in (("prompts", self.prompts), ("videos", self.videos)):
            if not isinstance(sources, list | tuple):
                raise ConfigError(
                    f"{name} is one {type(sources).__name__}; give a list, even of one source"
                )
        if bool(self.prompts) == bool(self.videos):
            raise ConfigError("give either prompts or videos, and at least one")
        check_range("seed", self.seed, 0, MAX_SEED)
        if "seed" in self.simulation:
            raise ConfigError("every sample has a seed of its own; give seed beside simulation")
        super().__post_init__()
        if self.videos and self.slice_events is not None and "frame" in self.targets:
            raise ConfigError(NO_FRAME)

    @property
    def count(self) -> int:
        """Number of prompts or videos."""
        return len(self.prompts or self._videos)

    @cached_property
    def _videos(self) -> Sequence[Source]:
        return [video for one in self.videos for video in self._videos_of(one)]

    def _videos_of(self, source: Source) -> Sequence[Source]:
        if not (isinstance(source, str | Path) and Path(source).is_dir()):
            return [source]
        try:
            entries = [*entries_of(str(source), of_stills="camera" in self.simulation)]
        except InputError:  # a folder of another kind, which its reader knows or refuses
            return [source]
        return [entry.video for entry in entries if entry.video is not None]

    def seed_of(self, number: int) -> int:
        """Seed of the simulation of sample `number`."""
        return int(frame_key(self.seed, number)) >> 1

    def _checked(self, number: int) -> int:
        if number < 0:
            raise InputError(f"sample number is {number}; it must be 0 or more")
        return number

    def _sizes(self) -> Iterable[SensorSize]:
        size = self._resolve(0).size
        return () if size is None else (size,)

    def _clip(self, number: int) -> tuple[EventStream, Sequence[Window], Targets]:
        clip = record_clip(self._simulation(number), self.slice_us)
        return clip.events, clip.windows, partial(self._targets, clip)

    def _targets(self, clip: SlicedClip, windows: Sequence[Window] | None) -> Arrays:
        parts = [
            {name: target_of(clip, cast(Target, name), window) for name in self.targets}
            for window in windows or clip.windows
        ]
        return parts[0] if windows is None else stack_windows(parts)

    def _facts(self, number: int) -> Arrays:
        return {"source": number % self.count}

    def _resolve(self, number: int) -> Settings:
        options = {**self.simulation, "seed": self.seed_of(number)}
        return resolve("generate" if self.prompts else "simulate", options)

    def _simulation(self, number: int) -> Simulation:
        settings, source = self._resolve(number), number % self.count
        if self.prompts:
            assets = getattr(settings.source, "assets", None)
            return prepare_prompt(open_subject(self.prompts[source], assets), settings)
        return prepare_source(self._videos[source], settings)
