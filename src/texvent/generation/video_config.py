"""Options of generators that make a whole video at once, with a learned model."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import ClassVar, Literal

from texvent.config import FPS_RANGE, check_range
from texvent.generation.video_models.lora import parse_lora


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
    offload: Literal["auto", "none", "model", "sequential"] = "auto"
    """Parts that wait in the computer's memory: none, whole parts that are not in use, or every
    layer (slow, fits small GPUs); auto: by the GPU's free memory."""

    repeated: ClassVar[tuple[str, ...]] = ("lora",)

    def __post_init__(self) -> None:
        super().__post_init__()
        for text in self.lora:
            parse_lora(text)
        for name, low in (("frames", 2), ("width", 8), ("height", 8), ("steps", 1)):
            check_range(name, getattr(self, name), low, 65_535)
        check_range("guidance", self.guidance, 0.0, 1000.0)
