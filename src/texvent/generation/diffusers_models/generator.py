"""One adapter over every diffusers text-to-video pipeline (Eq. 3): prompt → video.

    generator = GENERATORS.load("wan-1.3b")(config, seed=0, size=None)
    video = generator.generate("a red car drives left")

The pipeline is loaded only if the video was not made before. Its frames stay where it made them,
rounded to 16 bits; a lossless file for later runs is written beside.
"""

from __future__ import annotations

import functools
from fractions import Fraction
from importlib import metadata
from pathlib import Path
from typing import Any, ClassVar

from texvent._require import find_missing, install_command, require
from texvent._version import __version__
from texvent.errors import ConfigError, InputError, shown
from texvent.generation.diffusers_models.guardrail import (
    PART,
    check_prompt,
    guardrail_version,
    needs_guardrail,
)
from texvent.generation.diffusers_models.modular import MODULAR, find_class
from texvent.generation.diffusers_models.pipeline_call import (
    call_pipeline,
    check_options,
    read_image,
)
from texvent.generation.diffusers_models.pipeline_loading import (
    GB,
    LoadRequest,
    find_pipeline_class,
    load_pipeline,
    place,
    resolve_device,
)
from texvent.generation.video_models.config import DiffusersConfig, VideoModel
from texvent.generation.video_models.controls import check_class, find_control_part
from texvent.generation.video_models.download_sizes import with_sizes
from texvent.generation.video_models.known_models import check_control, check_shape
from texvent.generation.video_models.lora import check_loras, find_row_loras, parse_lora
from texvent.generation.video_models.model_files import (
    check_weight_files,
    elsewhere_parts,
    find_downloaded,
    find_files,
    fingerprint,
    read_pipeline_index,
)
from texvent.generation.video_models.upscalers import check_upscalers, find_upscalers
from texvent.generation.videos.retries import generate_checked
from texvent.generation.videos.stored_video import FinishedVideo, MadeVideo
from texvent.generation.videos.video_cache import VideoCache, content_key
from texvent.networks import describe_file
from texvent.options.values import plain
from texvent.runtime.devices import Tensor
from texvent.runtime.progress import NoProgress, Progress
from texvent.sensor import SensorSize

EXTRA = "generate"
NEEDED = ("diffusers", "huggingface_hub", "torch")
"""Packages without which neither files nor a GPU can be looked for."""
PIXEL_OPTIONS = ("frames", "width", "height", "steps", "guidance", "negative_prompt")
"""Options that decide the pixels, beside model, prompt, seed and files."""
OF_COST = ("frames", "width", "height", "steps")
"""Options that decide the time, which a row knows for its own values."""
PIXEL_FACTS = ("call", "sigmas", "scheduler", "loras", "upscalers")
"""Fields of a model's row that decide the pixels too."""
PACKAGES = ("diffusers", "transformers", "torch")
"""Packages that decide the pixels beside the weights; their versions go into the metadata."""


class DiffusersGenerator:
    """A learned text-to-video model, run through diffusers.

    Args:
        config: options; None values are the pipeline's own defaults.
        model: origin of the weights, and defaults.
        seed: seed of the first noise.
    """

    config_type: ClassVar[type] = DiffusersConfig
    default_interpolate: ClassVar[str] = "flow"
    default_sensor: ClassVar[str | None] = None

    def __init__(self, config: DiffusersConfig, *, model: VideoModel, seed: int = 0) -> None:
        self.config = config
        self.model = model
        self.seed = seed
        self._loras = tuple(map(parse_lora, config.lora))
        self._request: LoadRequest | None = None
        self._has_guardrail = False
        self._origin: dict[str, Any] = {}

    def generate(self, prompt: str, *, progress: Progress | None = None) -> FinishedVideo:
        """The video for `prompt`, made now unless it was made before.

        Args:
            prompt: content of the video.
            progress: receives the licence before a download, and denoising steps; an exception
                from it, like Ctrl-C, stops the run and leaves nothing behind.

        Raises:
            InputError: the prompt is empty or blocked, or the model is not on this machine and
                cannot be fetched.
            ConfigError: the pipeline does not take an option, or its frame rate is not known.
            FileFormatError: a file of the model is damaged.
            MissingDependencyError: a package is not installed.
        """
        self._check(prompt)
        return generate_checked(
            functools.partial(self._find_or_make, prompt),
            self.config,
            seed=self.seed,
            progress=progress,
            find_fault=self._find_fault,
        )

    def plan(self, prompt: str) -> str | None:
        """Cost of making the video, or None if it was made before. No weights are fetched.

        Without the packages that make it, the cost that its row states.

        Raises:
            TexventError: as `generate`, for faults that show before the networks are loaded.
        """
        self._check(prompt)
        key = content_key(self._pixel_facts(prompt, self.seed))
        if VideoCache(is_kept=self.config.reuse_video).find(key, self.fps) is not None:
            return None
        missing, row, found = find_missing(NEEDED), self.model, ""
        if missing is None:
            here, row = self._look_for_files()
            device, free = resolve_device()
            seen = "no GPU" if free is None else f"{device} with {free / GB:.0f} GB free"
            found = f", torch finds {seen}"
        else:
            if row.folder is not None:
                check_weight_files(row.folder, elsewhere_parts(row))
            if (known := MODULAR.get(row.pipeline or "")) is not None:
                check_options(known, self.config)
            install = install_command(f"texvent[{EXTRA}]")
            here = f"files, their sizes and a GPU are not known without {missing} ({install})"
        config, cost = self.config, row.cost
        if row.minutes and any(getattr(config, one) != getattr(row, one) for one in OF_COST):
            cost += f" (for {row.frames} frames of {row.width}x{row.height}, {row.steps} steps)"
        wanted = {"frames": config.frames, "steps": config.steps}
        amounts = ", ".join(f"{value} {name}" for name, value in wanted.items() if value)
        return (
            f"the video is not made yet: {row.name} would make it"
            f"{f' ({amounts})' if amounts else ''}; {here}; licence: {row.licence_and_terms}"
            f"; {row.memory}{found}; {cost}"
        )

    def _look_for_files(self) -> tuple[str, VideoModel]:
        """Place of the model's files for messages, and its row with the sizes of missing ones."""
        folder = self.model.folder or find_downloaded(self.model)
        if folder is not None and None in (find_row_loras(self.model), find_upscalers(self.model)):
            folder = None
        if folder is None:
            self._check_before_loading()
            return "it has to be fetched first", with_sizes(self.model, self.config.control)
        self._prepare(NoProgress())  # refuses options that do not fit the files, too
        return f"its files are in {folder}", self.model

    @property
    def fps(self) -> Fraction:
        """Frame rate that the model is given or was made for.

        Raises:
            ConfigError: neither the option nor the model's row states it, or no folder is there.
        """
        rate, folder = self.config.fps or self.model.fps, self.model.folder
        if rate is None and folder is not None and not folder.is_dir():
            raise ConfigError(f"generator {shown(self.model.name)} is no folder; check its path")
        if rate is None:
            raise ConfigError(
                f"the frame rate of {self.model.name} is not known, and it is nowhere in the "
                "weights; say it, for example fps=16"
            )
        return Fraction(rate)

    def _check(self, prompt: str) -> None:
        if not prompt.strip():
            raise InputError("the prompt is empty; describe a scene, such as 'a car drives left'")
        self._check_model()

    def _check_model(self) -> None:
        """Refuse options that the model does not take, and files that are not here."""
        check_control(self.model, self.config)
        check_shape(self.model, self.config)
        if self.config.image is not None:
            read_image(self.config.image)
        elif self.model.needs_image:
            raise InputError(f"{self.model.name} starts from an image; give image=PATH")
        for lora in self._loras:
            if not lora.file.is_file():
                raise InputError(f"there is no LoRA {lora.file}; check its path")
        if self.model.folder is not None:
            find_row_loras(self.model)
            find_upscalers(self.model)
        self.fps  # noqa: B018  (an unknown rate is refused before anything is loaded)

    def _check_before_loading(self) -> None:
        """Refuse faults that show without the model's files, which may have to be fetched first."""
        model, config = self.model, self.config
        if config.lora or model.loras:
            require("peft", extra=EXTRA)
        name = model.pipeline
        if config.image is not None:
            name = model.image_pipeline or name
        if name is None:
            return
        pipeline_class = find_class(name)
        if pipeline_class is not None:  # else the installed one is too old, which loading says
            check_options(pipeline_class, config)

    def _prepare(self, progress: Progress) -> LoadRequest:
        """Find the model's files and check that the options fit them; no network is loaded."""
        if self._request is not None:
            return self._request
        self._check_before_loading()
        model, config = self.model, self.config
        files = find_files(model, progress.announce)
        loras = (*(find_row_loras(model, progress.announce) or ()), *self._loras)
        check_class(model, files.folder)
        upscalers = find_upscalers(model, progress.announce) or ()
        check_upscalers(upscalers, files.folder)
        parts = find_control_part(model, config, files.folder, progress.announce) + upscalers
        device, free = resolve_device()
        request = LoadRequest(
            folder=files.folder,
            content=" ".join(
                [
                    fingerprint(files.folder),
                    *(_sha256(one) if one.is_file() else fingerprint(one) for _, one in parts),
                    *(_sha256(one.file) for one in loras),
                ]
            ),
            class_name=(model.image_pipeline if config.image else None) or model.pipeline,
            placement=place(model, config, device, free),
            decoder_in_float32=model.needs_float32_vae,
            loras=loras,
            scheduler=tuple(
                (name, tuple(value) if isinstance(value, list) else value)
                for name, value in model.scheduler.items()
            ),
            parts=parts,
        )
        pipeline_class = find_pipeline_class(request)
        check_loras(loras, pipeline_class, files.folder)
        check_options(pipeline_class, config)
        facts = {
            "source": model.source,
            "commit": files.commit,
            **{f"{name}_commit": part.name for name, part in parts if part.is_dir()},
            **{f"{name}_sha256": _sha256(part) for name, part in upscalers},
            "lora_sha256": [_sha256(one.file) for one in loras[: len(model.loras)]] or None,
            "pipeline": pipeline_class.__name__,
            "dtype": request.placement.dtype,
            "licence": model.licence_and_terms,
            **{name: metadata.version(name) for name in PACKAGES},
        }
        self._has_guardrail = needs_guardrail(read_pipeline_index(files.folder))
        if self._has_guardrail:
            facts["guardrail"] = guardrail_version()
        self._origin = {name: fact for name, fact in facts.items() if fact is not None}
        self._request = request
        return request

    def _find_fault(self, video: FinishedVideo) -> str | None:
        """Fault of a video beside those of the checks."""

    def _levels(self, prompt: str, seed: int, progress: Progress) -> Tensor:
        """Frames as `call_pipeline` returns them."""
        return self._call(prompt, seed, progress)

    def _call(self, prompt: str, seed: int, progress: Progress, control: Any = None) -> Tensor:
        pipeline = load_pipeline(self._prepare(progress), progress.announce)
        if self._has_guardrail:
            check_prompt(getattr(pipeline, PART, None), prompt)
        return call_pipeline(
            pipeline,
            prompt,
            self.config,
            model=self.model,
            fps=self.fps,
            # Of the CPU: the same noise on every device.
            generator=require("torch", extra=EXTRA).Generator("cpu").manual_seed(seed),
            progress=progress,
            control=control,
        )

    def _find_or_make(self, prompt: str, seed: int, progress: Progress) -> FinishedVideo:
        cache = VideoCache(is_kept=self.config.reuse_video)
        key = content_key(self._pixel_facts(prompt, seed))
        found = cache.find(key, self.fps)
        if found is not None:
            progress.announce(f"this video was generated before: {found.path}")
            return found.with_metadata(**self._request_facts())
        levels = self._levels(prompt, seed, progress)
        facts = {
            "generator": self.model.name,
            "version": __version__,
            "prompt": prompt,
            "seed": seed,
            **self._request_facts(),
            **self._origin,
        }
        count, height, width, _ = levels.shape
        video = MadeVideo(self.fps, SensorSize(width, height), count, facts, levels=levels)
        cache.store_beside(key, video.pixels, self.fps, facts)
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
        if config.image is not None:
            facts["image"] = _sha256(config.image)
        if self._loras:
            facts["lora"] = [[_sha256(one.file), one.weight] for one in self._loras]
        if model.folder is None:
            facts["source"] = model.source
        else:
            facts["folder"] = fingerprint(model.folder) if model.folder.is_dir() else ""
        return {**facts, "prompt": prompt, "seed": seed}

    def _request_facts(self) -> dict[str, Any]:
        """Options and files of this run; a video found again may have been made with others."""
        paths = [self.config.image, *(one.file for one in self._loras)]
        files = [
            {"file": str(path.absolute()), "sha256": _sha256(path)}
            for path in paths
            if path is not None
        ]
        return {"options": plain(self.config), **({"files": files} if files else {})}


def _sha256(path: Path) -> str:
    return describe_file(path)["sha256"]
