"""Adapter over the pipelines that follow a control video: scene → control → video of the scene.

The embedded generator stages the scene at the model's size, rate and length. The video that comes
out has the scene's motion and truth.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from texvent._registry import DEFAULT_GENERATOR, GENERATORS
from texvent._require import find_missing
from texvent.errors import InputError
from texvent.frames import FrameStream, Video
from texvent.generation.control_video import Pixels, draw_control, times_of
from texvent.generation.diffusers_models.generator import NEEDED, DiffusersGenerator
from texvent.generation.steered_video import SteeredVideo
from texvent.generation.subjects import Subject, describe_subject, prompt_of
from texvent.prompt_report import REPORT_KEY, PromptReport
from texvent.runtime.progress import NoProgress, Progress
from texvent.sensor import SensorSize

if TYPE_CHECKING:
    from texvent.generation.videos.stored_video import FinishedVideo
    from texvent.runtime.devices import Tensor

AGREEMENT = "control_agreement"
"""Agreement with the scene, among the facts of a video."""


@dataclass(frozen=True, eq=False)
class _Steering:
    """A scene that a video is to follow."""

    subject: Subject
    scene: Any
    control: Pixels


class SteeredGenerator(DiffusersGenerator):
    """A learned model whose videos follow a scene, by a control video of it."""

    default_interpolate: ClassVar[str] = "motion"

    _steering: _Steering
    """Set by the first call; later ones of the same subject find it."""

    def generate(self, prompt: Subject, *, progress: Progress | None = None) -> SteeredVideo:
        """The video of a scene, or of the one that a sentence describes; see the base class.

        Raises:
            ConfigError: the model does not take the control, the length or the size; or as the
                embedded generator.
        """
        self._check_here()
        text = self._steer(prompt, progress or NoProgress())
        return self.attach(super().generate(text, progress=progress), prompt)

    def plan(self, prompt: Subject) -> str | None:
        """As the base class; the scene is rendered, for what was made before is found by it."""
        if find_missing(NEEDED) is None:
            self._check_here()
        return super().plan(self._steer(prompt, NoProgress()))

    def _check_here(self) -> None:
        """Refuse what shows without the network, before the scene is rendered."""
        self._check_model()
        self._check_before_loading()
        if self.model.folder is not None:
            self._prepare(NoProgress())

    def draw(self, prompt: Subject) -> Video:
        """The control video of a subject, for people; nothing is loaded."""
        self._steer(prompt, NoProgress())
        scene = self._steering.scene
        return Video(self._steering.control, times_of(scene), scene.fps, scene.metadata)

    def attach(self, video: FrameStream, prompt: Subject) -> SteeredVideo:
        """A video that this generator made of a subject, with its scene.

        Raises:
            InputError: it has another number of frames than the scene.
        """
        scene = self._steering.scene if self._has(prompt) else self._stage(prompt)
        if video.frame_count != scene.frame_count or video.size != scene.size:
            raise InputError(
                f"{self.model.name} made {video.frame_count} frames of {video.size} of a scene of "
                f"{scene.frame_count} frames of {scene.size}; give `frames`, `width` and `height` "
                "that it makes"
            )
        shape = scene.fps, video.size, scene.frame_count
        return SteeredVideo(*shape, video.metadata, video=video, scene=scene)

    def report(self, prompt: Subject, *, is_staged: bool = True) -> PromptReport:
        """Report of the prompt's words in the scene, as its output would store it."""
        report: PromptReport = self._embedded().report(prompt, is_staged=is_staged)
        return report

    def _steer(self, prompt: Subject, progress: Progress) -> str:
        """Render the control video of a subject; the text for the model."""
        self._check_model()
        text = self._text(prompt)
        if not self._has(prompt):
            scene = self._stage(prompt)
            progress.announce(f"rendering the control video ({self.config.control}) of the scene")
            control = draw_control(scene, str(self.config.control))
            self._steering = _Steering(prompt, scene, control)
        return text

    def _has(self, prompt: Subject) -> bool:
        return "_steering" in vars(self) and self._steering.subject is prompt

    def _text(self, prompt: Subject) -> str:
        """The scene's sentence, and words about the look."""
        said = (prompt_of(prompt) or "").strip()
        text = ", ".join(filter(None, (said.rstrip(" ."), (self.config.look or "").strip())))
        if not text:
            raise InputError(
                "the scene has no sentence; give look='...', or a `prompt` in the scene file"
            )
        return text

    def _stage(self, prompt: Subject) -> Any:
        return self._embedded().generate(prompt)

    def _embedded(self) -> Any:
        """The embedded generator at the model's size, rate and length."""
        config, fps = self.config, self.fps
        kind: Any = GENERATORS.load(DEFAULT_GENERATOR)
        frames, size = config.frames or 0, SensorSize(config.width or 0, config.height or 0)
        # Half a frame more, so that rounding takes none away.
        duration = float((frames - 0.5) / fps)
        own = kind.config_type(fps=fps, duration=duration, assets=config.assets)
        seed = self.seed if config.scene_seed is None else config.scene_seed
        return kind(own, seed=seed, size=size)

    def _find_fault(self, video: FinishedVideo) -> str | None:
        """The base class's, or too little agreement with the scene."""
        least, found = self.config.least_agreement, video.metadata[AGREEMENT]
        low = [] if least is None else [one for one in found.items() if one[1] < least]
        return (
            "; ".join(f"{name} agree by {share:g}, below {least:g}" for name, share in low) or None
        )

    def _find_or_make(self, prompt: str, seed: int, progress: Progress) -> FinishedVideo:
        from texvent.video_check.control_agreement import measure_agreement  # brings OpenCV

        video = super()._find_or_make(prompt, seed, progress)
        self.attach(video, self._steering.subject)  # refuses frames that are not the scene's
        found = measure_agreement(video, self._steering.scene)
        said = ", ".join(f"{name} {share:.0%}" for name, share in found.items())
        progress.announce(
            f"the video follows the scene: {said or 'nothing to compare'} (0: chance)"
        )
        return video.with_metadata(**{AGREEMENT: found})

    def _levels(self, prompt: str, seed: int, progress: Progress) -> Tensor:
        return self._call(prompt, seed, progress, control=self._steering.control)

    def _pixel_facts(self, prompt: str, seed: int) -> dict[str, Any]:
        control = np.ascontiguousarray(self._steering.control)
        digest = hashlib.sha256(control.data).hexdigest()
        return {**super()._pixel_facts(prompt, seed), "control": digest}

    def _request_facts(self) -> dict[str, Any]:
        """The base class's, and the scene."""
        known = self._steering
        facts = {**super()._request_facts(), **describe_subject(known.subject)}
        scene = known.scene.metadata
        facts |= {name: scene[name] for name in (REPORT_KEY,) if name in scene}
        files = [*facts.get("files", ()), *scene.get("files", ())]
        return {**facts, "text": self._text(known.subject), **({"files": files} if files else {})}
