"""Learned models that make a whole video at once: what is known of one, and its options."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from pathlib import Path
from typing import Any, ClassVar, Literal

from texvent.config import FPS_RANGE, IdleOptions, check_range
from texvent.generation.video_models.controls import PIPELINES, ControlPipeline
from texvent.generation.video_models.lora import parse_lora
from texvent.generation.video_models.model_files import NOT_READ

LEAST_FPS = 24
"""Frame rate from which a model is recommended for events."""


@dataclass(frozen=True, kw_only=True)
class GeneratedVideoConfig:
    """Options that all learned generators share: frame rate, stored videos, failure filter."""

    fps: Fraction | None = None
    """Frame rate the model was made for, as 24, 29.97 or 30000/1001. Models that take it as an
    input are given it; for the others it only says how fast their frames play."""
    fit: Literal["cover", "contain", "stretch"] = "cover"
    """Fit of frames to the sensor's size: cut the excess, add black bars, or distort."""
    reuse_video: bool = True
    """Keep generated videos in the cache folder and use one again when prompt, model, seed and
    generation options are the same, so that trying simulator options costs no generation."""
    on_failure: Literal["ignore", "warn", "reject", "retry"] = "warn"
    """Response to a video that is frozen, flickering, cut, dark, saturated or noise: none, a
    warning, refusal, or generation with up to three other seeds."""

    def __post_init__(self) -> None:
        check_range("fps", self.fps, *FPS_RANGE)


@dataclass(frozen=True, kw_only=True)
class DiffusersConfig(GeneratedVideoConfig):
    """Options of a diffusers text-to-video pipeline; `none` is the pipeline's own default."""

    frames: int | None = None
    """Frames to generate. Models change it silently to a number they can make (4k+1 or 8k+1);
    the number made is used and reported."""
    width: int | None = None
    """Width to generate, pixels."""
    height: int | None = None
    """Height to generate, pixels."""
    steps: int | None = None
    """Denoising steps."""
    guidance: float | None = None
    """Classifier-free guidance scale: how closely the prompt is followed."""
    negative_prompt: str | None = None
    """Content to avoid."""
    image: Path | None = None
    """Image to start from, where the model can."""
    lora: tuple[str, ...] = ()
    """LoRA that diffusers loads: a .safetensors file, with :WEIGHT if it is not 1; may be
    repeated."""
    control: Literal["depth", "edges", "ids", "flow"] | None = None
    """Part of the scene that the video follows, for models that follow one: depth, edges, ids of
    objects, or motion. The prompt, or a scene file, is staged by the embedded generator."""
    look: str | None = None
    """Words about the look, such as "a rainy street in Osaka", added to the scene's sentence."""
    scene_seed: int | None = None
    """Seed of the scene that the video follows, so that several looks share one; none: that of the
    video."""
    assets: Path | None = None
    """Folder of models (GLB, OBJ, PLY) for the scene that the video follows; see docs/assets.md."""
    least_agreement: float | None = None
    """Least share of the scene's edges and motion that the video must show (0: chance, 1: all);
    one that shows less failed, see on_failure."""
    offload: Literal["auto", "none", "model", "sequential"] = "auto"
    """Parts that wait in the computer's memory: none, whole parts that are not in use, or every
    layer (slow, fits small GPUs); auto: by the GPU's free memory."""

    repeated: ClassVar[tuple[str, ...]] = ("lora",)
    idle_with: ClassVar[IdleOptions] = {"least_agreement": ("on_failure", ("ignore",))}

    def __post_init__(self) -> None:
        super().__post_init__()
        for text in self.lora:
            parse_lora(text)
        for name, low in (("frames", 2), ("width", 8), ("height", 8), ("steps", 1)):
            check_range(name, getattr(self, name), low, 65_535)
        check_range("guidance", self.guidance, 0.0, 1000.0)
        check_range("scene_seed", self.scene_seed, 0, 2**63 - 1)
        check_range("least_agreement", self.least_agreement, 0.0, 1.0)


@dataclass(frozen=True, kw_only=True)
class VideoModel:
    """One learned model; None: the pipeline's own default."""

    name: str
    """Name that `--generator` takes."""
    repo: str = ""
    """Repository on the model hub, `org/name`; empty for a local folder."""
    folder: Path | None = None
    """Local folder with the model, instead of the repository."""
    revision: str | None = None
    """Branch, tag or commit; None: the default branch."""
    pipeline: str | None = None
    """diffusers class; None: the one that `model_index.json` names."""
    image_pipeline: str | None = None
    """diffusers class that starts from an image with the same weights."""
    needs_image: bool = False
    """Whether an image is required."""
    fps: Fraction | None = None
    """Frame rate the model was trained for; the weights do not state it."""
    frames: int | None = None
    width: int | None = None
    height: int | None = None
    steps: int | None = None
    guidance: float | None = None
    negative_prompt: str | None = None
    """Content to avoid, by the publisher's own program; the pipeline's default is none."""
    differs: str = ""
    """Why frames, size, steps or guidance are not the call defaults of the pipeline."""
    call: Mapping[str, Any] = field(default_factory=dict, hash=False)
    """Further arguments of the pipeline's call."""
    sigmas: tuple[float, ...] = ()
    """Noise levels that a few-step model was distilled for, first to last; used with as many
    steps."""
    scheduler: Mapping[str, Any] = field(default_factory=dict, hash=False)
    """Settings of the noise schedule that the publisher asks for."""
    licence: str = NOT_READ
    """Licence of the weights, by its SPDX name where it has one."""
    licence_source: str = ""
    """Publisher's repository or page and file where the licence was read; empty: not read."""
    licence_terms: str = ""
    """Obligations beyond keeping notices, in a few words."""
    gpu_gb: float | None = None
    """GPU memory with every part on the device, GB, as makers or users report it."""
    offload_gb: float | None = None
    """GPU memory with parts moved to the device when used, GB."""
    download_gb: float | None = None
    """Size of its files, GB, where its publisher states it."""
    minutes: Mapping[str, float] = field(default_factory=dict, hash=False)
    """GPU → minutes for the row's frames, size and steps, where its publisher states them."""
    cost_source: str = ""
    """Publisher's file in which minutes and size of the files were read."""
    dtype: str = "bfloat16"
    """Number format on a GPU."""
    needs_float32_vae: bool = False
    """Whether the decoder should stay in float32 (Wan's page asks for it)."""
    ignores_fps: bool = False
    """Whether the rate is known not to change the frames."""
    unused: tuple[str, ...] = ()
    """Parts of its repository that are not needed for a video from text or an image."""
    frame_range: tuple[int, int] | None = None
    """Fewest and most frames that it makes; None: not known."""
    multiple: int | None = None
    """Width and height are multiples of it; None: not known."""
    longest: int | None = None
    """Most frames over which it follows a scene; None: no limit is known."""
    control_revision: str = ""
    """Branch with the network of a control, `{}` for its name; empty: it is among the parts."""
    control_lora: str = ""
    """Repository of the LoRA that follows a scene."""
    loras: tuple[str, ...] = ()
    """Files of the LoRA that makes few steps enough, `organisation/name/path` on the model hub: for
    the network, and for the second one of models that have two."""
    lora_gb: float | None = None
    """Size of these files, GB, as listings of them state it."""
    upscalers: tuple[str, ...] = ()
    """Files of the networks that double its latents, named likewise: in space, and in time."""
    frame_step: int | None = None
    """Frames are multiples of it and one more; None: not known."""
    of_paper: bool = False
    """Whether the paper uses it."""

    @property
    def is_low_fps(self) -> bool:
        """Whether the rate is below `LEAST_FPS`."""
        return self.fps is not None and self.fps < LEAST_FPS

    @property
    def steering(self) -> ControlPipeline | None:
        """Control by which its videos follow a scene; None: they follow none."""
        return PIPELINES.get(self.pipeline or "")

    @property
    def licence_and_terms(self) -> str:
        """Licence with its terms, for messages and metadata."""
        return f"{self.licence}; {self.licence_terms}" if self.licence_terms else self.licence

    @property
    def memory(self) -> str:
        """GPU memory that it needs, for messages."""
        parts = [f"{self.gpu_gb:g} GB"] if self.gpu_gb else []
        parts += [f"{self.offload_gb:g} GB with --offload model"] if self.offload_gb else []
        return f"GPU memory {', '.join(parts) or 'not known'}"

    @property
    def cost(self) -> str:
        """Download and time that it needs, for messages."""
        size = "not known" if self.download_gb is None else f"{self.download_gb:g} GB"
        told = ", ".join(f"{value:g} min on {card}" for card, value in self.minutes.items())
        if self.loras:
            lora = "not known" if self.lora_gb is None else f"{self.lora_gb:g} GB"
            size += f", and of its LoRA {lora} ({', '.join(self.loras)})"
        if self.upscalers:
            size += f" with its upscalers ({', '.join(self.upscalers)})"
        return f"download {size}, time {f'about {told}' if told else 'not known'}"

    @property
    def source(self) -> str:
        """Origin of the weights, for messages and metadata."""
        if self.folder is not None:
            return str(self.folder)
        return f"{self.repo}@{self.revision}" if self.revision else self.repo
