"""LTX-2.5 with twice the frames per second: its publisher's stages by one call.

Half size with keyframes, doubled in space, refined; doubled in time, refined piece by piece between
keyframes (github.com/Lightricks/LTX-2: ltx_pipelines/dfr_pipeline.py, one temporal round, without
the detailing LoRA, which is optional there). diffusers has every stage, and leaves the order to its
caller. Its own decoder of convolutions makes the frames, not the publisher's larger one.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from texvent._require import require

EXTRA = "generate"
OnStep: TypeAlias = Callable[[Any, int, Any, dict[str, Any]], dict[str, Any]]
LEFT_OUT = ("processor", "prompt_enhancer", "duration_head")
"""Parts that rewrite the prompt or choose the length."""


class LTX2DFRTemporalRefinePipeline:
    """LTX-2.5's stages, with the argument names of other pipelines; its sound is left out."""

    parts = (
        "text_encoder", "tokenizer", "connectors", "transformer", "vae", "audio_vae", "vocoder",
        "scheduler",
    )  # fmt: skip
    """Folders of the repository that are needed."""

    def __init__(self, first: Any, spatial: Any, refine: Any) -> None:
        self._first = first
        self._spatial = spatial
        self._refine = refine
        self.num_timesteps = 0
        """Denoising steps of all stages."""

    @classmethod
    def from_pretrained(
        cls,
        folder: str,
        *,
        latent_upsampler: Any,
        temporal_latent_upsampler: Any,
        **options: Any,
    ) -> LTX2DFRTemporalRefinePipeline:
        """Load the parts from a folder in the published layout; the upscalers are loaded before."""
        diffusers = require("diffusers", extra=EXTRA)
        utils = require("diffusers.pipelines.ltx2.utils", extra=EXTRA)
        first = diffusers.LTX2DFRPipeline.from_pretrained(
            folder, **dict.fromkeys(LEFT_OUT), **options
        )
        shared = {name: getattr(first, name) for name in cls.parts}
        shared["scheduler"] = diffusers.LTXEulerAncestralRFScheduler(
            eta=utils.TEMPORAL_ANCESTRAL_ETA
        )
        refine = diffusers.LTX2DFRTemporalRefinePipeline(
            **shared, temporal_latent_upsampler=temporal_latent_upsampler
        )
        spatial = diffusers.LTX2LatentUpsamplePipeline(
            vae=first.vae, latent_upsampler=latent_upsampler
        )
        return cls(first, spatial, refine)

    @classmethod
    def download(cls, repo: str, *, revision: str | None, use_safetensors: bool) -> str:
        """Fetch what is needed; the folder."""
        del use_safetensors
        hub = require("huggingface_hub", extra=EXTRA)
        wanted = ["model_index.json", *(f"{one}/*" for one in cls.parts)]
        return str(hub.snapshot_download(repo, revision=revision, allow_patterns=wanted))

    @property
    def components(self) -> dict[str, Any]:
        """Name → part."""
        return {**self._refine.components, "latent_upsampler": self._spatial.latent_upsampler}

    @property
    def vae(self) -> Any:
        """The decoder."""
        return self._first.vae

    def __call__(  # noqa: PLR0913  (names of the pipelines of diffusers)
        self,
        prompt: str,
        num_frames: int = 241,
        width: int = 1536,
        height: int = 1024,
        frame_rate: float = 48.0,
        *,
        image: Any = None,
        generator: Any = None,
        output_type: str = "pt",
        return_dict: bool = False,
        callback_on_step_end: OnStep | None = None,
    ) -> tuple[Any]:
        """The video, [1, F, 3, H, W], of `num_frames` at `frame_rate`; see diffusers' pipelines."""
        del return_dict
        with require("torch", extra=EXTRA).no_grad():
            words, mask = self._first.encode_prompt(prompt, device=self._first._execution_device)
            shared = {
                "prompt_embeds": words,
                "prompt_attention_mask": mask,
                "conditions": _at_the_start(image),
                "frame_rate": frame_rate / 2,
                "generator": generator,
                "output_type": "latent",
            }
            frames = (num_frames - 1) // 2 + 1
            latents = self._latents(shared, frames, width, height, callback_on_step_end)
            vae, ratio = self.vae, self._first.vae_temporal_compression_ratio
            kept = _utils().trim_canvas(latents, num_frames, ratio).to(vae.dtype)
            time = kept.new_zeros(1) if vae.config.timestep_conditioning else None
            made = vae.decode(kept, time, return_dict=False)[0]
            video = self._first.video_processor.postprocess_video(made, output_type=output_type)
        return (video,)

    def _latents(
        self, shared: dict[str, Any], frames: int, width: int, height: int, on_step: OnStep | None
    ) -> Any:
        """Latents of twice the frames, by arguments that all stages share."""
        utils, first = _utils(), self._first
        layout = require("diffusers.pipelines.ltx2.dfr_layout", extra=EXTRA)
        canvas, _, seams = layout.resolve_canvas(frames, first.vae_temporal_compression_ratio)
        stages = (utils.DISTILLED_SIGMA_VALUES, utils.STAGE_2_DISTILLED_SIGMA_VALUES)
        before = [0, len(stages[0]), len(stages[0]) + len(stages[1])]
        pieces = min(2, len(seams))
        self.num_timesteps = before[2] + pieces * len(utils.TEMPORAL_ROUND_DISTILLED_SIGMA_VALUES)
        half = {"width": width // 2, "height": height // 2}
        small = first(
            **shared, **half, num_frames=frames, sigmas=stages[0], **self._steps(before[0], on_step)
        )
        large = first(
            **shared,
            width=width,
            height=height,
            num_frames=frames,
            sigmas=stages[1],
            latents=self._double(small.frames, half),
            keyframes_latents=self._double(small.keyframes, half),
            keyframe_positions=small.keyframe_positions,
            audio_latents=small.audio,
            **self._steps(before[1], on_step),
        )
        return self._refine(
            **shared,
            width=width,
            height=height,
            num_frames=canvas,
            condition_num_frames=frames,
            latents=large.frames,
            keyframes_latents=large.keyframes,
            keyframe_positions=large.keyframe_positions,
            audio_latents=small.audio,
            **self._steps(before[2], on_step),
        ).frames

    def _double(self, latents: Any, size: dict[str, int]) -> Any:
        """Latents of twice the width and height."""
        return self._spatial(latents=latents, **size, output_type="latent", return_dict=False)[0]

    def _steps(self, before: int, on_step: OnStep | None) -> dict[str, Any]:
        """The callback of a stage, which counts on from the stages before."""
        if on_step is None:
            return {}

        def report(pipe: Any, step: int, time: Any, tensors: dict[str, Any]) -> dict[str, Any]:
            del pipe
            return on_step(self, before + step, time, tensors)

        return {"callback_on_step_end": report}

    @staticmethod
    def lora_state_dict(source: Any, **options: Any) -> Any:
        """Tensors of a LoRA by the names of diffusers."""
        kind = require("diffusers", extra=EXTRA).LTX2DFRPipeline
        return kind.lora_state_dict(source, **options)

    def load_lora_weights(self, source: Any, **options: Any) -> None:
        """Load a LoRA; see the pipelines of diffusers."""
        self._first.load_lora_weights(source, **options)

    def set_adapters(self, names: list[str], weights: list[float]) -> None:
        """Weigh the LoRA that are loaded."""
        self._first.set_adapters(names, weights)

    def to(self, device: str) -> None:
        """Bring all parts to a device."""
        self._refine.to(device)
        self._spatial.latent_upsampler.to(device)

    def enable_model_cpu_offload(self, device: str) -> None:
        """Bring parts to a device when they are used; the small upscaler in space stays there."""
        self._refine.enable_model_cpu_offload(device=device)
        self._spatial.latent_upsampler.to(device)

    def enable_sequential_cpu_offload(self, device: str) -> None:
        """Bring layers to a device when they are used; the small upscaler in space stays there."""
        self._refine.enable_sequential_cpu_offload(device=device)
        self._spatial.latent_upsampler.to(device)

    def maybe_free_model_hooks(self) -> None:
        """Send parts back that were brought to a device."""
        self._refine.maybe_free_model_hooks()

    def set_progress_bar_config(self, **options: Any) -> None:
        """Options of the progress bar."""
        for one in (self._first, self._spatial, self._refine):
            one.set_progress_bar_config(**options)


def _at_the_start(image: Any) -> list[Any] | None:
    """An image as the first frame."""
    if image is None:
        return None
    module = require("diffusers.pipelines.ltx2", extra=EXTRA)
    return [module.LTX2VideoCondition(frames=image, index=0)]


def _utils() -> Any:
    return require("diffusers.pipelines.ltx2.utils", extra=EXTRA)
