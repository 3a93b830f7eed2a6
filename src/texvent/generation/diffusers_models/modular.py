"""Models that diffusers has in several pieces, with the call of its other pipelines."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import Any

from texvent._require import require
from texvent.errors import ConfigError
from texvent.generation.diffusers_models.temporal import LTX2DFRTemporalRefinePipeline

EXTRA = "generate"
WORKFLOW = "t2va"
"""MiniMax-H3 from text alone: what else its repository holds is neither fetched nor loaded."""


class TextTokens:
    """Kinds of tokens of a prompt without pictures, in place of a processor of pictures."""

    def create_mm_token_type_ids(self, rows: Sequence[Sequence[int]]) -> list[list[int]]:
        """Zero, the kind of text, for every token."""
        return [[0] * len(row) for row in rows]


class MiniMaxH3ModularPipeline:
    """MiniMax-H3 by the argument names of other pipelines; its sound is left out."""

    parts = (
        "text_encoder", "tokenizer", "vae", "audio_vae", "transformer", "scheduler",
        "audio_scheduler",
    )  # fmt: skip
    """Folders that text alone needs."""

    def __init__(self, pipe: Any, manager: Any) -> None:
        self._pipe = pipe
        self._manager = manager

    @classmethod
    def from_pretrained(
        cls, folder: str, *, dtype: Any, local_files_only: bool, use_safetensors: bool
    ) -> MiniMaxH3ModularPipeline:
        """Load the parts from a folder in the published layout.

        Raises:
            ValueError: a part cannot be loaded.
        """
        del use_safetensors  # pickles are refused before
        diffusers = require("diffusers", extra=EXTRA)
        manager = diffusers.ComponentsManager()
        pipe = diffusers.ModularPipeline.from_pretrained(
            folder, workflow=WORKFLOW, components_manager=manager, local_files_only=local_files_only
        )
        # One by one: load_components warns of a part that it cannot load, and goes on.
        for name in cls.parts:
            one = dtype.get(name, dtype["default"]) if isinstance(dtype, Mapping) else dtype
            spec = pipe.get_component_spec(name)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", FutureWarning)  # torch's of weight_norm
                part = spec.load(dtype=one, local_files_only=local_files_only)
            pipe.update_components(**{name: part})
        pipe.processor = TextTokens()
        return cls(pipe, manager)

    @classmethod
    def download(cls, repo: str, *, revision: str | None, use_safetensors: bool) -> str:
        """Fetch what text alone needs; the folder."""
        del use_safetensors
        hub = require("huggingface_hub", extra=EXTRA)
        wanted = [
            "model_index.json",
            "modular_model_index.json",
            *(f"{one}/*" for one in cls.parts),
        ]
        return str(hub.snapshot_download(repo, revision=revision, allow_patterns=wanted))

    @property
    def components(self) -> dict[str, Any]:
        """Name → part."""
        return {name: getattr(self._pipe, name) for name in self.parts}

    @property
    def scheduler(self) -> Any:
        """Noise schedule of the frames; that of the sound stays."""
        return self._pipe.scheduler

    @scheduler.setter
    def scheduler(self, other: Any) -> None:
        self._pipe.update_components(scheduler=other)

    def __call__(
        self,
        prompt: str,
        num_frames: int = 124,
        width: int = 1344,
        height: int = 768,
        num_inference_steps: int = 50,
        *,
        generator: Any = None,
        output_type: str = "pt",
        return_dict: bool = False,
    ) -> tuple[Any]:
        """The video, [1, F, 3, H, W]; see the pipelines of diffusers."""
        del return_dict
        made = self._pipe(
            prompt=prompt,
            num_frames=num_frames,
            width=width,
            height=height,
            num_inference_steps=num_inference_steps,
            generator=generator,
            output_type=output_type,
            output="videos",
        )
        return (made,)

    @staticmethod
    def lora_state_dict(source: Any, **options: Any) -> Any:
        """Tensors of a LoRA by the names of diffusers."""
        kind = require("diffusers", extra=EXTRA).MiniMaxH3ModularPipeline
        return kind.lora_state_dict(source, **options)

    def load_lora_weights(self, source: Any, **options: Any) -> None:
        """Load a LoRA; see the pipelines of diffusers."""
        self._pipe.load_lora_weights(source, **options)

    def set_adapters(self, names: list[str], weights: list[float]) -> None:
        """Weigh the LoRA that are loaded."""
        self._pipe.set_adapters(names, weights)

    def to(self, device: str) -> None:
        """Bring all parts to a device."""
        self._pipe.to(device)

    def enable_model_cpu_offload(self, device: str) -> None:
        """Bring parts to a device when they are used."""
        self._manager.enable_auto_cpu_offload(device=device)

    def enable_sequential_cpu_offload(self, device: str) -> None:
        """Refused: there is no such way."""
        raise ConfigError(
            f"offload is sequential on {device}, and MiniMax-H3 takes none or model; give "
            "--offload model on a larger GPU, or a folder of weights in 8 or 4 bits"
        )

    def maybe_free_model_hooks(self) -> None:
        """Nothing: parts go when others come."""

    def set_progress_bar_config(self, **options: Any) -> None:
        """Options of the progress bar."""
        self._pipe.set_progress_bar_config(**options)


MODULAR: Mapping[str, Any] = {
    "MiniMaxH3ModularPipeline": MiniMaxH3ModularPipeline,
    "LTX2DFRTemporalRefinePipeline": LTX2DFRTemporalRefinePipeline,
}
"""Class that an index or a row names → the one here that runs it."""


def find_class(name: str) -> Any:
    """The class that runs a pipeline; None: the installed diffusers lacks it."""
    found = getattr(require("diffusers", extra=EXTRA), name, None)
    return MODULAR.get(name, found) if found is not None else None
