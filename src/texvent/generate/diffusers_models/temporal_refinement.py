"""Two or four times the frames from the model itself: LTX-2.5's rounds of temporal refinement.

A round doubles the frames of the latents with a network, the temporal upsampler, and denoises them
again between keyframes that the first pass made. The rate doubles too; the duration stays.

Source: LTX2DFRPipeline and LTX2DFRTemporalRefinePipeline of diffusers.
"""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError, InputError
from texvent.generate.diffusers_models.call_adjustments import adjusted
from texvent.generate.diffusers_models.device_placement import Placement
from texvent.generate.diffusers_models.pipeline_call import run_pipeline
from texvent.generate.diffusers_models.pipeline_loading import Pipeline, place_pipeline
from texvent.generate.video_models.loading import loading
from texvent.generate.video_models.weight_files import CONFIG, read_json
from texvent.runtime.progress import Progress

EXTRA = "generate"
REFINED_PIPELINE = "LTX2DFRPipeline"
"""The pipeline whose first pass gives what the rounds take: latents, keyframes and sound."""
UPSAMPLER = "LTX2LatentUpsamplerModel"
ETA = 0.5
"""Fraction of new noise in a step of a round, as diffusers documents it."""


def refined_count(frames: int, factor: int) -> int:
    """Frames after refinement: new ones lie between the old, none behind the last.

    Example:
        >>> refined_count(121, 2), refined_count(121, 4)
        (241, 481)
    """
    return factor * (frames - 1) + 1


def check_refinable(pipeline: str) -> None:
    """Refuse a pipeline that the rounds cannot follow.

    Args:
        pipeline: its diffusers class.

    Raises:
        ConfigError: see above.
    """
    if pipeline != REFINED_PIPELINE:
        raise ConfigError(
            f"refine is set, but {pipeline} cannot refine its frames in time; only "
            f"{REFINED_PIPELINE} can: --generator ltx2.5-dfr"
        )


def check_upsampler(folder: Path) -> None:
    """Refuse the folder of a network that is no temporal upsampler; only its config is read.

    Raises:
        InputError: see above.
        FileFormatError: the config is damaged.
    """
    config = read_json(folder / CONFIG)
    name = config.get("_class_name")
    if name != UPSAMPLER:
        raise InputError(f"{folder} holds the class {name}; a temporal upsampler is {UPSAMPLER}")
    if config.get("spatial_upsample", True) or not config.get("temporal_upsample", False):
        raise InputError(
            f"{folder} holds an upsampler that enlarges frames; refine needs one that adds frames "
            "(temporal_upsample true, spatial_upsample false in its config)"
        )


def load_refiner(pipe: Pipeline, folder: Path, placement: Placement) -> Pipeline:
    """The pipeline of the rounds, with the parts of a loaded `REFINED_PIPELINE`.

    Args:
        pipe: gives the parts.
        folder: the temporal upsampler, see `check_upsampler`.
        placement: where `pipe` is.

    Raises:
        FileFormatError: a weight file does not fit the upsampler.
        InputError: the upsampler is for latents of another model.
    """
    torch, diffusers = require("torch", extra=EXTRA), require("diffusers", extra=EXTRA)
    upsamplers = require("diffusers.pipelines.ltx2", extra=EXTRA)
    with loading(folder, "a temporal upsampler"):
        upsampler = getattr(upsamplers, UPSAMPLER).from_pretrained(
            str(folder),
            dtype=getattr(torch, placement.dtype),
            local_files_only=True,
            use_safetensors=True,
        )
    own, needed = upsampler.config.in_channels, pipe.vae.config.latent_channels
    if own != needed:
        raise InputError(
            f"{folder} is for latents of {own} channels, those of the model have {needed}; take "
            "the upsampler that was published with the model"
        )
    refining = diffusers.LTX2DFRTemporalRefinePipeline
    shared = set(inspect.signature(refining).parameters) & set(pipe.components) - {"scheduler"}
    refiner = refining(
        **{name: getattr(pipe, name) for name in shared},
        scheduler=diffusers.LTXEulerAncestralRFScheduler(eta=ETA),
        temporal_latent_upsampler=upsampler.eval(),
    )
    place_pipeline(refiner, placement)
    return refiner


@dataclass(frozen=True)
class _RoundProgress:
    """Names the steps of a round after it."""

    progress: Progress
    name: str

    def announce(self, line: str) -> None:
        self.progress.announce(line)

    def advance(self, stage: str, done: int, total: int | None) -> None:
        del stage
        self.progress.advance(self.name, done, total)


def refine(
    refiner: Pipeline,
    first_pass: tuple[Any, ...],
    prompt: Mapping[str, Any],
    *,
    factor: int,
    frames: int | None,
    fps: Fraction,
    generator: Any,
    progress: Progress,
) -> Any:
    """Run one round (factor 2) or two (4), and decode what the last one made.

    Args:
        refiner: see `load_refiner`.
        first_pass: what `REFINED_PIPELINE` gives without decoding: latents [1, C, T, h, w], sound,
            latents of the keyframes [1, C, K, h, w] and their frame numbers.
        prompt: as it was given to the first pass.
        factor: 2 or 4.
        frames: asked of the first pass, which pads them to whole segments; None keeps all.
        fps: of the first pass.
        generator: source of noise, left where the first pass left it.
        progress: receives every denoising step.

    Returns:
        Frames [F, H, W, 3] float32 in 0..1, F as `refined_count` says.

    Raises:
        ConfigError: the pipeline refuses the options.
        TexventError: the GPU's memory is too small.
    """
    latents, sound, keyframes, positions = first_pass
    padded = (latents.shape[2] - 1) * refiner.vae_temporal_compression_ratio + 1
    asked = frames or padded
    size = refiner.vae_spatial_compression_ratio
    common = {
        **prompt,
        "height": latents.shape[3] * size,
        "width": latents.shape[4] * size,
        "audio_latents": sound,
        "source_seconds": float(padded / fps),
        "condition_num_frames": asked,
        "generator": generator,
    }
    rounds = factor.bit_length() - 1
    for index in range(1, rounds + 1):
        arguments = {
            **common,
            "latents": latents,
            "keyframes_latents": keyframes,
            "keyframe_positions": positions,
            "num_frames": refined_count(padded, 2 ** (index - 1)),
            "frame_rate": float(fps * 2 ** (index - 1)),
            "round_index": index,
            "output_type": "np" if index == rounds else "latent",
        }
        shown = _RoundProgress(progress, f"refine, round {index} of {rounds}")
        with adjusted(refiner, {}, shown, guidance=None, sigmas=None, generator=None):
            latents, _, keyframes, positions = run_pipeline(refiner, arguments)
    return latents[0][: refined_count(asked, factor)]
