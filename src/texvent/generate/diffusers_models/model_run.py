"""A model that is loaded and answers prompts: files, placement, guardrail, embeddings, frames."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from fractions import Fraction
from importlib import metadata
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.errors import InputError
from texvent.generate.diffusers_models.adapter_loading import check_adapters, describe_few_steps
from texvent.generate.diffusers_models.decoder_input import (
    SINGLE_DECODE_PIPELINES,
    capture_decoder_input,
)
from texvent.generate.diffusers_models.device_placement import Placement, place
from texvent.generate.diffusers_models.guardrail import (
    PART,
    check_prompt,
    guardrail_version,
    needs_guardrail,
)
from texvent.generate.diffusers_models.latents import (
    Latents,
    decode_frames,
    read_latents,
    stream_frames,
)
from texvent.generate.diffusers_models.pipeline_call import (
    call_pipeline,
    check_options,
    default_guidance,
)
from texvent.generate.diffusers_models.pipeline_loading import (
    MOTION_PIPELINE,
    LoadRequest,
    Pipeline,
    find_kept,
    find_pipeline_class,
    load_pipeline,
    resolve_device,
)
from texvent.generate.diffusers_models.prompt_embeddings import (
    EMBEDDING_PIPELINES,
    embed_prompt,
    find_embeddings,
)
from texvent.generate.diffusers_models.streamed_decoding import can_stream
from texvent.generate.video_config import DiffusersConfig
from texvent.generate.video_models.adapters import AdapterFile, find_adapter
from texvent.generate.video_models.download import ModelFiles, find_files
from texvent.generate.video_models.known_models import VideoModel
from texvent.generate.video_models.weight_files import fingerprint, read_pipeline_index
from texvent.generate.videos.video_cache import content_key
from texvent.runtime.progress import Progress
from texvent.transfer import Transfer
from texvent.video import PixelArray

EXTRA = "generate"
LINEAR_PIPELINES = ("LTX2HDRPipeline",)
"""Their frames are linear light, 1 is white and more is brighter: diffusers undoes LogC3 itself."""
PACKAGES = ("diffusers", "transformers", "torch")
"""What decides the pixels beside the weights; their versions go into the metadata."""


class ModelRun:
    """One model with its options.

    Args:
        model: where the weights are.
        config: options.
        fps: frame rate, for models that take it as an input.
        progress: receives downloads and denoising steps.

    Raises:
        InputError, FileFormatError, MissingDependencyError: see `download.find_files`.
    """

    def __init__(
        self, model: VideoModel, config: DiffusersConfig, *, fps: Fraction, progress: Progress
    ) -> None:
        self._model = model
        self._config = config
        self._fps = fps
        self.progress = progress
        """Receives loading and denoising; may be replaced between prompts."""
        self._files: ModelFiles = find_files(model, progress.announce)
        self._index = read_pipeline_index(self._files.folder)
        self._pipe: Pipeline | None = None
        self._adapters: tuple[AdapterFile, ...] = ()
        self._adapters = self._find_adapters()

    @property
    def has_guardrail(self) -> bool:
        """True for models that must not run without their guardrail."""
        return needs_guardrail(self._index)

    def frames(self, prompt: str, seed: int) -> Iterator[PixelArray]:
        """Frames [H, W, 3] float32 in 0..1; those of `LINEAR_PIPELINES` go on above 1.

        Denoised before this returns, decoded step by step where the decoder can be.
        """
        pipe, arguments = self._prepare(prompt)
        # The guardrail looks at decoded frames, inside the pipeline: it must decode them itself.
        is_streamed = self._class_name in SINGLE_DECODE_PIPELINES and can_stream(pipe.vae)
        if not is_streamed or self.has_guardrail:
            return iter(self._call(pipe, arguments, seed, "np"))
        with capture_decoder_input(pipe) as taken:
            self._call(pipe, arguments, seed, "np")
        return stream_frames(pipe, *taken[0])

    def latents(self, prompt: str, seed: int) -> Latents:
        """What the model denoises.

        Raises:
            InputError: the model has a guardrail, or its decoder is not known.
        """
        if self.has_guardrail:
            raise InputError(
                f"{self._model.name} gives no latents: its guardrail must see the frames"
            )
        pipe, arguments = self._prepare(prompt)
        return self._latents(pipe, arguments, seed)

    def decode(self, latents: Latents) -> Iterator[PixelArray]:
        """Frames of latents of this model, [H, W, 3] float32 in 0..1."""
        if self._pipe is None:
            self._pipe = self._load(has_text_encoder=False)
        return decode_frames(self._pipe, latents)

    def provenance(self) -> dict[str, Any]:
        """What made the frames, beside prompt, seed and options."""
        facts: dict[str, Any] = {
            "source": self._model.source,
            "commit": self._files.commit,
            "pipeline": self._class_name,
            "dtype": self._placement.dtype,
            "quantize": self._placement.quantize,
            "lora": [one.facts for one in self._adapters] or None,
            "licence": self._model.licence_and_terms,
            **{name: metadata.version(name) for name in PACKAGES},
        }
        if self.has_guardrail:
            facts["guardrail"] = guardrail_version()
        if self._class_name in LINEAR_PIPELINES:
            facts["transfer"] = Transfer.LINEAR.value
        return {name: value for name, value in facts.items() if value is not None}

    def _find_adapters(self) -> tuple[AdapterFile, ...]:
        """The files of `--lora`, refused if the pipeline cannot take them; fetched if need be."""
        adapters = self._config.adapters
        if not adapters:
            return ()
        pipeline_class = find_pipeline_class(self._request(has_text_encoder=True))
        check_adapters(adapters, pipeline_class, self._index)
        hint = describe_few_steps(adapters, pipeline_class, self._config)
        if hint is not None:
            self.progress.announce(hint)
        return tuple(find_adapter(one, self.progress.announce) for one in adapters)

    @property
    def _class_name(self) -> str:
        if self._config.image is not None and self._model.image_pipeline is not None:
            return self._model.image_pipeline
        if self._motion_adapter is not None:
            return MOTION_PIPELINE
        return self._model.pipeline or str(self._index["_class_name"])

    @property
    def _motion_adapter(self) -> Path | None:
        return self._config.motion_adapter or self._files.motion_adapter

    @functools.cached_property
    def _placement(self) -> Placement:
        device, free = resolve_device(self._config.generator_device)
        return place(self._model, self._config, device, free)

    @functools.cached_property
    def _content(self) -> str:
        folders = (self._files.folder, self._config.decoder, self._motion_adapter)
        return " ".join(fingerprint(folder) for folder in folders if folder is not None)

    def _request(self, *, has_text_encoder: bool) -> LoadRequest:
        return LoadRequest(
            folder=self._files.folder,
            content=self._content,
            class_name=self._class_name,
            placement=self._placement,
            decoder=self._config.decoder,
            decoder_in_float32=self._model.needs_float32_vae,
            motion_adapter=self._motion_adapter,
            adapters=self._adapters,
            scheduler=tuple(self._model.scheduler.items()),
            has_text_encoder=has_text_encoder,
        )

    def _load(self, *, has_text_encoder: bool) -> Pipeline:
        request = self._request(has_text_encoder=has_text_encoder)
        return load_pipeline(request, self.progress.announce)

    def _prepare(self, prompt: str) -> tuple[Pipeline, dict[str, Any]]:
        """The pipeline, and the prompt as it wants it: text, or embeddings."""
        takes_embeddings = self._class_name in EMBEDDING_PIPELINES and not self.has_guardrail
        key = self._embedding_key(prompt) if self._config.reuse_video else None
        known = find_embeddings(key) if takes_embeddings and key is not None else None
        if self._pipe is None:
            request = self._request(has_text_encoder=known is None)
            if find_kept(request) is None:
                # Before minutes of loading.
                check_options(find_pipeline_class(request), self._config)
                self.progress.announce(
                    f"loading {self._model.source} ({self._describe_placement()})"
                )
            self._pipe = load_pipeline(request, self.progress.announce)
        pipe = self._pipe
        if self.has_guardrail:
            check_prompt(getattr(pipe, PART, None), prompt)
        if known is not None:
            return pipe, {name: tensor.to(pipe._execution_device) for name, tensor in known.items()}
        if not takes_embeddings:
            return pipe, {"prompt": prompt}
        if getattr(pipe, "text_encoder", None) is None:
            # Loaded for a prompt whose embeddings were known; this one needs the encoder. Nothing
            # may hold the old one while the new one is loaded.
            self._pipe = pipe = None
            pipe = self._pipe = self._load(has_text_encoder=True)
        guidance = default_guidance(pipe, self._config)
        return pipe, embed_prompt(
            pipe, prompt, self._config.negative_prompt, key=key, guidance=guidance
        )

    def _embedding_key(self, prompt: str) -> str:
        return content_key(
            {
                "content": self._content,
                "prompt": prompt,
                "negative": self._config.negative_prompt,
                "guidance": self._config.guidance,
                "dtype": self._placement.dtype,
            }
        )

    def _describe_placement(self) -> str:
        placement = self._placement
        facts = [placement.device, placement.dtype]
        facts += [] if placement.quantize == "none" else [f"weights in {placement.quantize}"]
        facts += [] if placement.offload == "none" else [f"offload {placement.offload}"]
        return ", ".join(facts)

    def _latents(self, pipe: Pipeline, arguments: dict[str, Any], seed: int) -> Latents:
        output = self._call(pipe, arguments, seed, "latent")
        return read_latents(pipe, output, self._config.frames, self._fps)

    def _call(self, pipe: Pipeline, arguments: dict[str, Any], seed: int, kind: str) -> Any:
        """Frames or latents."""
        return call_pipeline(
            pipe,
            arguments,
            self._config,
            model=self._model,
            fps=self._fps,
            generator=_noise(seed),
            output_type=kind,
            progress=self.progress,
        )[0]


def _noise(seed: int) -> Any:
    """A source of noise that gives the same on every device."""
    return require("torch", extra=EXTRA).Generator("cpu").manual_seed(seed)
