"""One adapter over every diffusers text-to-video pipeline (Eq. 3): prompt → video on disk.

    generator = GENERATORS.load("wan-1.3b")(config, seed=0, size=None)
    video = generator.generate("a red car drives left")

The pipeline is loaded only if the video was not made before. Frames go from the model's decoder
into a lossless 16-bit file, a few at a time where the decoder allows it, and are read from there.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any, ClassVar

from texvent._require import require
from texvent._version import __version__
from texvent.errors import ConfigError, InputError
from texvent.generate.diffusers_models.latents import Latents
from texvent.generate.diffusers_models.model_run import ModelRun
from texvent.generate.diffusers_models.pipeline_call import (
    check_options,
    check_reference,
    read_image,
)
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.adapters import (
    Adapter,
    digest_adapter,
    files_of,
    find_local,
)
from texvent.generate.video_models.download import find_downloaded
from texvent.generate.video_models.known_models import VideoModel
from texvent.generate.video_models.loading import quiet_libraries
from texvent.generate.video_models.weight_files import CONFIG, check_part, fingerprint
from texvent.generate.videos.reference_video import check_reference_file, warn_of_rate
from texvent.generate.videos.retries import generate_checked
from texvent.generate.videos.stored_video import StoredVideo
from texvent.generate.videos.video_cache import VideoCache, content_key
from texvent.networks.weight_files import describe_file
from texvent.options.values import plain
from texvent.runtime.progress import NoProgress, Progress
from texvent.video import PixelArray

EXTRA = "generate"
PIXEL_OPTIONS = (
    *("frames", "width", "height", "steps", "guidance"),
    *("negative_prompt", "dtype", "quantize"),
)
"""Options that decide the pixels, beside model, prompt, seed and files."""
PIXEL_FACTS = ("call", "sigmas", "scheduler")
"""What of a model's row decides the pixels too."""
NETWORK_OPTIONS = ("decoder", "motion_adapter")
"""Options that name a network."""


class DiffusersGenerator:
    """A learned text-to-video model, run through diffusers.

    Args:
        config: options; None values are the pipeline's own defaults, no `lora` the row's. A model
            that follows a video keeps the row's beside others.
        model: where the weights are, and what they were made for.
        seed: seed of the first noise.
    """

    config_type: ClassVar[type] = DiffusersConfig
    default_interpolate: ClassVar[str] = "flow"
    default_sensor: ClassVar[str | None] = None

    def __init__(self, config: DiffusersConfig, *, model: VideoModel, seed: int = 0) -> None:
        own = model.lora if model.needs_reference or not config.lora else ()
        self.config = dataclasses.replace(config, lora=(*own, *config.lora))
        self.model = model
        self.seed = seed
        self._run: ModelRun | None = None

    def generate(self, prompt: str, *, progress: Progress | None = None) -> StoredVideo:
        """The video for `prompt`, made now unless it was made before.

        Args:
            prompt: what to show.
            progress: receives the licence before a download, and every denoising step; an exception
                from it, like Ctrl-C, stops the run and leaves nothing behind.

        Raises:
            InputError: the prompt is empty or blocked, or the model is not on this machine and
                cannot be fetched.
            ConfigError: the pipeline does not take an option, or its frame rate is not known.
            FileFormatError: a file of the model is damaged.
            MissingDependencyError: a package is not installed.
        """
        self._check(prompt)
        if self.config.reference_video is not None:
            warn_of_rate(self.config.reference_video, self.fps)
        return generate_checked(
            functools.partial(self._find_or_make, prompt),
            self.config,
            prompt=prompt,
            seed=self.seed,
            progress=progress,
        )

    def generate_latents(self, prompt: str, *, progress: Progress | None = None) -> Latents:
        """What the model denoises for `prompt`, with the scale and shift of its decoder.

        Raises:
            InputError: the model's decoder is not known, or the model has a guardrail that must
                see finished frames; and what `generate` raises.
        """
        self._check(prompt)
        return self._loaded(progress or NoProgress()).latents(prompt, self.seed)

    def decode(self, latents: Latents) -> Iterator[PixelArray]:
        """Frames of latents, [H, W, 3] float32 in 0..1, a few at a time in memory."""
        return self._loaded(NoProgress()).decode(latents)

    def plan(self, prompt: str) -> str | None:
        """What making the video would take, or None if it was made before. Touches no network.

        Raises:
            TexventError: as `generate`, for what shows before the model's networks are loaded.
        """
        self._check(prompt)
        key = content_key(self._pixel_facts(prompt, self.seed))
        if VideoCache(is_kept=self.config.reuse_video).find(key, self.fps) is not None:
            return None
        config, folder = self.config, self.model.folder or find_downloaded(self.model)
        if folder is None or None in map(find_local, config.adapters):
            self._check_before_loading()
        else:  # all files are here: what does not fit them is refused too
            self._loaded(NoProgress())
        here = f"its files are in {folder}" if folder is not None else "it has to be fetched first"
        wishes = {"frames": config.frames, "steps": config.steps}
        amounts = ", ".join(f"{value} {name}" for name, value in wishes.items() if value)
        return (
            f"the video is not made yet: {self.model.name} would make it"
            f"{f' ({amounts})' if amounts else ''}; {here}; licence: {self.model.licence_and_terms}"
        )

    @property
    def fps(self) -> Fraction:
        """Frame rate that the model is given or was made for.

        Raises:
            ConfigError: neither the option nor the model's row says it.
        """
        rate = self.config.fps or self.model.fps
        if rate is None:
            raise ConfigError(
                f"the frame rate of {self.model.name} is not known, and it is nowhere in the "
                "weights; say it, for example fps=16"
            )
        return Fraction(rate)

    def _check(self, prompt: str) -> None:
        if not prompt.strip():
            raise InputError("the prompt is empty; describe a scene, such as 'a car drives left'")
        if self.config.image is not None:
            read_image(self.config.image)
        elif self.model.needs_image:
            raise InputError(f"{self.model.name} starts from an image; give image=PATH")
        if self.model.pipeline is not None:
            check_reference(self.model.pipeline, self.config)
        if self.config.reference_video is not None:
            check_reference_file(self.config.reference_video, self.config.frames or 1)
        self._check_networks()
        for adapter in self.config.adapters:
            find_local(adapter)
        self.fps  # noqa: B018  (an unknown rate is refused before anything is loaded)

    def _check_networks(self) -> None:
        """Refuse the folders of networks that are missing, damaged or of no use to the model."""
        for option in NETWORK_OPTIONS:
            folder = getattr(self.config, option)
            if folder is None:
                continue
            if not (folder / CONFIG).is_file():
                raise InputError(f"there is no {option} in {folder} (no {CONFIG})")
            check_part(folder)

    def _check_before_loading(self) -> None:
        """Refuse what shows without the model's files, which may have to be fetched first."""
        model, config = self.model, self.config
        if config.lora:
            require("peft", extra=EXTRA)
        name = None if config.motion_adapter is not None else model.pipeline
        if config.image is not None:
            name = model.image_pipeline or name
        if name is None:
            return
        with quiet_libraries():
            pipeline_class = getattr(require("diffusers", extra=EXTRA), name, None)
        if pipeline_class is not None:  # else the installed one is too old, which loading says
            check_options(pipeline_class, config)

    def _loaded(self, progress: Progress) -> ModelRun:
        if self._run is None:
            self._check_before_loading()
            self._run = ModelRun(self.model, self.config, fps=self.fps, progress=progress)
        self._run.progress = progress
        return self._run

    def _find_or_make(self, prompt: str, seed: int, progress: Progress) -> StoredVideo:
        cache = VideoCache(is_kept=self.config.reuse_video)
        key = content_key(self._pixel_facts(prompt, seed))
        found = cache.find(key, self.fps)
        if found is not None:
            progress.announce(f"this video was generated before: {found.path}")
            return found.with_metadata(**self._request_facts())
        run = self._loaded(progress)
        frames = run.frames(prompt, seed)
        facts = {
            "generator": self.model.name,
            "version": __version__,
            "prompt": prompt,
            "seed": seed,
            **self._request_facts(),
            **run.provenance(),
        }
        video = cache.store(key, frames, self.fps, facts)
        asked = self.config.frames
        if asked not in (None, video.frame_count):
            progress.announce(
                f"the model made {video.frame_count} frames, not {asked}: it can make certain "
                "numbers only"
            )
        return video

    def _pixel_facts(self, prompt: str, seed: int) -> dict[str, Any]:
        """Everything that decides the frames."""
        model, config = self.model, self.config
        facts: dict[str, Any] = {name: getattr(config, name) for name in PIXEL_OPTIONS}
        facts |= {name: value for name in PIXEL_FACTS if (value := getattr(model, name))}
        if not model.ignores_fps:
            facts["fps"] = self.fps
        for name in (*NETWORK_OPTIONS, "image", "reference_video"):
            if getattr(config, name) is not None:
                facts[name] = _digest(getattr(config, name))
        if config.lora:
            facts["lora"] = [
                [_adapter_content(one), one.weight, one.noise_or_name] for one in config.adapters
            ]
        if model.folder is None:
            facts["source"] = model.source
        else:
            facts["folder"] = fingerprint(model.folder) if model.folder.is_dir() else ""
        return {**facts, "prompt": prompt, "seed": seed}

    def _request_facts(self) -> dict[str, Any]:
        """Options and files of this run; a video found again may have been made with others."""
        files = self._files()
        return {"options": plain(self.config), **({"files": files} if files else {})}

    def _files(self) -> list[dict[str, str]]:
        """The single files that decide the frames, by path and sha256; `replay` compares them."""
        config = self.config
        paths = [config.image, config.reference_video]
        for path in map(find_local, config.adapters):
            paths += [] if path is None else files_of(path)
        return [
            {"file": str(path.absolute()), "sha256": _digest(path)}
            for path in paths
            if path is not None and path.is_file()
        ]


def _digest(path: Path) -> str:
    """Of a file, sha256; of a folder with a network, see `fingerprint`."""
    return describe_file(path)["sha256"] if path.is_file() else fingerprint(path)


def _adapter_content(adapter: Adapter) -> str:
    """Digest of its files, or its name on the hub: looking for a video fetches nothing."""
    path = find_local(adapter)
    return adapter.source if path is None else digest_adapter(path)
