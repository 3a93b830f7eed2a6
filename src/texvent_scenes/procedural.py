"""The embedded generator: prompt → description → scene → frames, at any instant.

Nothing here is learned. The words of the prompt choose and place articulated models made of
simple shapes, and a ray caster draws them; in return every frame is exact at its own instant and
comes with exact ground truth.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property, partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, cast

import numpy as np
from numpy.typing import NDArray

from texvent._version import __version__
from texvent.config import FPS_RANGE, check_range
from texvent.errors import ConfigError, InputError, warn
from texvent.frames import (
    MICROSECONDS,
    Frame,
    MotionVectors,
    NotebookFrames,
    describe_stream,
    frame_time_us,
)
from texvent.generation.subjects import Subject, describe_subject
from texvent.options.values import plain
from texvent.prompt_report import REPORT_KEY
from texvent.runtime.work.worker_threads import prefetch
from texvent.sensor import SENSORS, SensorSize
from texvent.transfer import Transfer, encode_srgb, linear_levels
from texvent_scenes.description import report_of
from texvent_scenes.scene_input import list_nouns, nouns_of, understand
from texvent_scenes.spec.data import naming_file

if TYPE_CHECKING:
    from texvent.camera import PosedCamera
    from texvent.generation.kept_frames import KeptFrames
    from texvent.ground_truth import GroundTruth
    from texvent.prompt_report import PromptReport
    from texvent.runtime.progress import Progress
    from texvent_scenes.models.protocol import Noun
    from texvent_scenes.raycast.incremental import IncrementalRenderer, RenderedFrame
    from texvent_scenes.raycast.optics import Optics
    from texvent_scenes.rendered_scene import RenderedScene
    from texvent_scenes.staging.compose import ComposedScene

DEFAULT_SIZE = SENSORS["davis346"].size
"""Image size when none is given."""
IMAGES_AHEAD = 8
"""Images between two frames that are drawn while those of the frames before are simulated."""


@dataclass(frozen=True, kw_only=True)
class ProceduralConfig:
    """Options of the embedded generator."""

    fps: Fraction = Fraction(24)
    """Frame rate of the video, as 24, 29.97 or 30000/1001. In between, every part of the image is
    rendered as often as it changes: the rate decides little."""
    duration: float = 2.0
    """Length of the video, in seconds, cut to whole frame intervals: 0.4 s at 24 fps are nine of
    them, 0.375 s."""
    samples: int = 2
    """Fineness of edges: rays per pixel side that look for them; 1 = fast draft, 2 = smooth
    enough for events."""
    shadows: bool = True
    """Whether the sun and the moon cast shadows."""
    point_spread: float = 0.5
    """Standard deviation of the lens' image of a point, in pixels; 0 = a perfect lens."""
    vignetting: bool = True
    """Whether the lens passes less light off its axis: cos⁴ of the angle to it."""
    assets: Path | None = None
    """Folder of models (GLB, OBJ, PLY), which prompts call by their file names; they take the place
    of embedded ones of the same name. See docs/assets.md."""
    hdr: bool = False
    """Render linear light, with lamps, fire and sun as bright as they are; without it frames are
    gamma-coded, and highlights are compressed below white."""
    strict: bool = False
    """Refuse a prompt with a word that is not understood or shown as something else, or with an
    object that is never in view; without it a warning names them."""

    def __post_init__(self) -> None:
        check_range("duration", self.duration, 1e-6, 86_400.0)
        check_range("samples", self.samples, 1, 8)
        check_range("point_spread", self.point_spread, 0.0, 10.0)
        check_range("fps", self.fps, *FPS_RANGE)
        if self.intervals < 1:
            raise ConfigError(
                f"duration is {self.duration:g} s, shorter than one frame interval at "
                f"{float(self.fps):g} fps; it must be at least {float(1 / self.fps):g} s"
            )

    @property
    def intervals(self) -> int:
        """Frame intervals in the duration; there is one frame more."""
        return math.floor(Fraction(str(self.duration)) * self.fps)


@dataclass(frozen=True, eq=False, repr=False)
class SceneFrame(Frame):
    """A frame of a scene."""

    made_of: RenderedFrame | None = None


@dataclass(frozen=True, eq=False, repr=False)
class ProceduralVideo(NotebookFrames):
    """A rendered scene: a stream of frames that can also be rendered at any instant."""

    scene: RenderedScene
    """The scene that is rendered."""
    size: SensorSize
    """Width and height of every frame, pixels."""
    config: ProceduralConfig = field(default_factory=ProceduralConfig)
    """Options of the generator."""
    metadata: Mapping[str, Any] = field(default_factory=dict)
    """Result of the generator for the prompt (JSON-serialisable)."""
    flicker_hz: float | None = None
    """Highest frequency at which any light goes up and down, Hz, or None where all is steady."""
    has_motion: bool = False
    """Whether frames carry exact motion vectors and depth."""
    transfer: Transfer = Transfer.GAMMA
    """Whether frames are gamma-coded or linear."""
    kept: KeptFrames | None = None
    """Store of what was rendered, for several simulations; None: nothing is kept."""

    def __repr__(self) -> str:
        return describe_stream(self)

    @property
    def fps(self) -> Fraction:
        """Frame rate, frames per second."""
        return self.config.fps

    @property
    def frame_count(self) -> int:
        """Number of frames: events cover the time from the first to the last."""
        return self.config.intervals + 1

    @property
    def is_live(self) -> bool:
        """False: the frames can be rendered again."""
        return False

    def __iter__(self) -> Iterator[Frame]:
        """Frames in time order, each rendered on demand."""
        return self.from_frame(0)

    def from_frame(self, first: int) -> Iterator[Frame]:
        """The frames from number `first` on; those before it are not rendered."""
        renderer = self._make_renderer()
        for index in range(first, self.frame_count):
            t_us = frame_time_us(index, self.fps)
            made = self._render(renderer, t_us)
            motion = self._motion(index) if self.has_motion else None
            yield SceneFrame(made.pixels, t_us, motion=motion, transfer=self.transfer, made_of=made)

    def at(self, t_us: int) -> Frame:
        """The frame at `t_us`, [H, W, 3] float32 RGB on the 0..255 scale, `is_source` False."""
        pixels = self._render(self._renderer, t_us).pixels
        return Frame(pixels, t_us, is_source=False, transfer=self.transfer)

    def _render(self, renderer: IncrementalRenderer, t_us: int) -> RenderedFrame:
        make = partial(renderer.render, t_us / MICROSECONDS)
        return cast("RenderedFrame", self._once("frame", t_us, make=make, bytes_per_pixel=48))

    def ground_truth(self, t0_us: int, t1_us: int) -> GroundTruth:
        """Depth, ids and boxes at `t0_us`, and optical flow from there to `t1_us`."""
        # Imported here: the kernels load Numba, which reading options and help must not do.
        from texvent_scenes.raycast.ground_truth import ground_truth

        times = t0_us / MICROSECONDS, t1_us / MICROSECONDS
        make = partial(ground_truth, self.scene, *times, self.size)
        return cast("GroundTruth", self._once("truth", t0_us, t1_us, make=make))

    def instances_at(
        self, t_us: int, points: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
        """Depth in metres and instance id, [k], at the image points [k, 2] (x, y), pixels."""
        from texvent_scenes.raycast.ground_truth import visible_instances

        return visible_instances(self.scene, t_us / MICROSECONDS, self.size, points)

    def camera_at(self, t_us: int) -> PosedCamera:
        """The camera at `t_us`."""
        return self.scene.camera(t_us / MICROSECONDS)

    @property
    def class_names(self) -> Mapping[int, str]:
        """Instance id → noun, such as {1: "car"}."""
        return self.scene.class_names

    @property
    def object_ids(self) -> Mapping[int, str]:
        """Instance id → id of the object in the scene, such as {1: "taxi"}."""
        ids: Mapping[int, str] = getattr(self.scene, "object_ids", {})
        return ids

    def with_motion(self) -> ProceduralVideo:
        """The same video, whose frames carry exact motion vectors and depth."""
        return replace(self, has_motion=True)

    def keeping(self, kept: KeptFrames) -> ProceduralVideo:
        """The same video; what is kept of it is not rendered again."""
        return replace(self, kept=kept)

    def _once(self, *key: Any, make: Callable[[], Any], bytes_per_pixel: int = 24) -> Any:
        if self.kept is None:
            return make()
        key = (*key, self.size, self.transfer)
        return self.kept.once(key, make, bytes_per_pixel * self.size.width * self.size.height)

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames of luma at times between two frames, each part drawn as often as it changes."""
        images = prefetch(self._draw_between(first, second, times_us), depth=IMAGES_AHEAD)
        frames = (
            Frame(image, t_us, is_source=False, transfer=self.transfer)
            for image, t_us in zip(images, times_us, strict=True)
        )
        if self.kept is None:
            return frames
        key = "between", first.t_us, *times_us, second.t_us
        make = partial(tuple, frames)
        return iter(self._once(*key, make=make, bytes_per_pixel=4 * len(times_us)))

    def _draw_between(
        self, first: Frame, second: Frame, times_us: Sequence[int]
    ) -> Iterator[NDArray[np.float32]]:
        from texvent_scenes.raycast.incremental import DrawnInstant, block_speeds

        start, stop = first.motion or MotionVectors(), second.motion or MotionVectors()
        speeds = block_speeds(self.size, start.forward, stop.backward)
        times = [t_us / MICROSECONDS for t_us in (first.t_us, *times_us, second.t_us)]
        ends = []
        for number, frame in ((0, first), (len(times) - 1, second)):
            made = getattr(frame, "made_of", None) or self._render(self._renderer, frame.t_us)
            ends.append(DrawnInstant(number, frame.float_luma, made.light, made.codes))
        return self._renderer.render_between(ends[0], ends[1], speeds, times)

    def _motion(self, index: int) -> MotionVectors:
        """Motion from a frame to its neighbours."""
        from texvent_scenes.raycast.ground_truth import frame_motion

        before, now, after = (
            frame_time_us(index + step, self.fps) / MICROSECONDS for step in (-1, 0, 1)
        )
        last = self.frame_count - 1
        neighbours = before if index else None, after if index < last else None
        make = partial(frame_motion, self.scene, now, *neighbours, self.size)
        return cast(MotionVectors, self._once("motion", index, make=make))

    @cached_property
    def _renderer(self) -> IncrementalRenderer:
        """Renderer of single instants and of those between frames."""
        return self._make_renderer()

    def _make_renderer(self) -> IncrementalRenderer:
        from texvent_scenes.raycast.incremental import IncrementalRenderer

        return IncrementalRenderer(
            self.scene, self.size, samples=self.config.samples, shadows=self.config.shadows,
            code=self._code, optics=self.optics, beat_s=1.0 / (self.flicker_hz or 1e-9),
        )  # fmt: skip

    @property
    def optics(self) -> Optics:
        """The lens of the camera."""
        from texvent_scenes.raycast.optics import Optics

        return Optics(self.config.point_spread, self.config.vignetting)

    def gamma_coded(self) -> ProceduralVideo:
        """The same scene in gamma-coded frames, which go above white where it has highlights."""
        facts = {name: one for name, one in self.metadata.items() if name != "transfer"}
        return replace(self, transfer=Transfer.GAMMA, metadata=facts)

    @property
    def _code(self) -> Callable[[NDArray[Any]], NDArray[np.float32]]:
        """Light (1 is white) → levels of a frame."""
        return linear_levels if self.transfer is Transfer.LINEAR else encode_srgb


class ProceduralGenerator:
    """Prompts become scenes built from simple shapes. No weights, no downloads."""

    config_type: ClassVar[type] = ProceduralConfig
    default_interpolate: ClassVar[str] = "motion"
    has_ground_truth: ClassVar[bool] = True
    takes_scenes: ClassVar[bool] = True

    def __init__(
        self, config: ProceduralConfig, *, seed: int = 0, size: SensorSize | None = None
    ) -> None:
        self.config = config
        self.seed = seed
        self.size = size if size is not None else DEFAULT_SIZE

    def generate(self, prompt: Subject, *, progress: Progress | None = None) -> ProceduralVideo:
        """The video for `prompt`.

        Args:
            prompt: English sentences, such as "a red car drives left past two trees at dusk"; or
                a scene.
            progress: unused: frames are rendered on demand.

        Returns:
            A stream of float RGB frames. Its metadata hold the report of the prompt's words, a
            `texvent.prompt_report.PromptReport` as JSON, under "prompt_report"; and a scene that
            was given, as plain values, under "scene".

        Raises:
            InputError: the prompt is empty, nothing in it is understood, or `strict` refuses it.
            ConfigError: a field of the scene is wrong, or a word of it is not shown.

        Warns:
            TexventWarning: some of its words are not shown as they say, or objects out of view.
        """
        del progress
        with naming_file(prompt):
            scene, report, files = self._stage(prompt)
        for fault in report.warnings("prompt words " if isinstance(prompt, str) else "scene: "):
            warn(fault)
        metadata = {
            "generator": "procedural",
            "version": __version__,
            **describe_subject(prompt),
            "seed": self.seed,
            "options": plain(self.config),
            REPORT_KEY: report.to_json(),
        }
        if files:
            metadata["files"] = files
        transfer = Transfer.LINEAR if self.config.hdr else Transfer.GAMMA
        if self.config.hdr:
            metadata["transfer"] = transfer.value
        return ProceduralVideo(
            scene,
            self.size,
            self.config,
            metadata,
            flicker_hz=scene.flicker_hz,
            transfer=transfer,
        )

    def report(self, prompt: Subject, *, is_staged: bool = True) -> PromptReport:
        """Report of a prompt, as its output would store it.

        Args:
            prompt: as `generate` takes it.
            is_staged: whether the scene is built, which takes 0.1 s, so that objects that are
                never in view are found too; False: the sentence is only read.

        Raises:
            InputError: as `generate`.
        """
        with naming_file(prompt):
            if is_staged:
                return self._stage(prompt)[1]
            return self._accepted(report_of(understand(prompt, nouns_of(prompt, self._nouns))))

    def _stage(self, prompt: Subject) -> tuple[ComposedScene, PromptReport, list[dict[str, str]]]:
        # Imported here: all models are only needed to make a scene.
        from texvent_scenes.staged_prompt import stage

        named = nouns_of(prompt, self._nouns)
        description = understand(prompt, named)
        said = self._accepted(report_of(description))  # before the scene is built
        scene, report, files = stage(
            description, said, named, seed=self.seed, size=self.size,
            duration_s=self.config.duration,
        )  # fmt: skip
        scene = replace(scene, has_highlights=self.config.hdr)
        return scene, self._accepted(report), files

    @cached_property
    def _nouns(self) -> Mapping[str, Noun]:
        """Nouns that prompts can name."""
        return list_nouns(self.config.assets)

    def _accepted(self, report: PromptReport) -> PromptReport:
        """The report, unless `strict` refuses the prompt."""
        refusal = report.refusal() if self.config.strict else None
        if refusal is not None:
            raise InputError(refusal)
        return report
