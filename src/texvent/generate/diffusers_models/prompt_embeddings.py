"""Prompt embeddings, kept on disk: a repeated prompt needs no text encoder.

The text encoder of a video model is often its largest part (T5-XXL: 11 GB). With the embeddings
at hand it is not even loaded.
"""

from __future__ import annotations

import inspect
from pathlib import Path
from typing import Any

from texvent._require import require
from texvent.generate.videos.video_cache import made_folder
from texvent.io.atomic import atomic_file

EXTRA = "generate"
EMBEDDING_PIPELINES = ("WanPipeline", "CogVideoXPipeline")
"""Pipelines whose `encode_prompt` gives two tensors that their call takes; tried in the tests.
None with a guardrail, which must see the prompt itself."""
NAMES = ("prompt_embeds", "negative_prompt_embeds")


def find_embeddings(key: str) -> dict[str, Any] | None:
    """Stored embeddings as call arguments, or None."""
    path = _path(key)
    if not path.is_file():
        return None
    load_file = require("safetensors.torch", extra=EXTRA).load_file
    error_type = require("safetensors", extra=EXTRA).SafetensorError
    try:
        tensors: dict[str, Any] = load_file(str(path))
    except (OSError, error_type):
        return None
    return tensors


def embed_prompt(
    pipe: Any, prompt: str, negative_prompt: str | None, *, key: str | None, guidance: float
) -> dict[str, Any]:
    """Encode a prompt as the pipeline's own call would, and store the result.

    Args:
        pipe: one of `EMBEDDING_PIPELINES`, with its text encoder.
        prompt: what to show.
        negative_prompt: what not to show.
        key: where to store it, or None not to.
        guidance: scale of classifier-free guidance; without it (≤ 1) there is no negative part.

    Returns:
        Call arguments: `NAMES` → tensor.
    """
    torch = require("torch", extra=EXTRA)
    # encode_prompt has another default for the length than the call has.
    length = inspect.signature(pipe.__call__).parameters["max_sequence_length"].default
    with torch.no_grad():
        encoded = pipe.encode_prompt(
            prompt=prompt,
            negative_prompt=negative_prompt,
            do_classifier_free_guidance=guidance > 1.0,
            max_sequence_length=length,
            device=pipe._execution_device,
        )
    tensors = {
        name: tensor for name, tensor in zip(NAMES, encoded, strict=True) if tensor is not None
    }
    if key is not None:
        save_file = require("safetensors.torch", extra=EXTRA).save_file
        with atomic_file(_path(key), overwrite=True) as part:
            save_file({name: one.contiguous().cpu() for name, one in tensors.items()}, str(part))
    return tensors


def _path(key: str) -> Path:
    return made_folder("prompts") / f"{key}.safetensors"
