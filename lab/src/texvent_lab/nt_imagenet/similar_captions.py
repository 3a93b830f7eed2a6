"""Captions that say nearly the same, by a sentence model that the user has (such as MiniLM)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.extending import require
from texvent.generate.diffusers_models.pipeline_loading import resolve_device
from texvent.generate.video_models.loading import loading
from texvent.generate.video_models.model_files import find_saved_model

EXTRA = "generate"
EXAMPLE = "sentence-transformers/all-MiniLM-L6-v2"
LEAST_COSINE = 0.95
BATCH = 64


def find_similar(
    captions: Mapping[str, str], model: str, *, device: str = "auto"
) -> list[tuple[str, str, float]]:
    """Pairs of captions whose vectors have a cosine of at least 0.95: id, id, cosine.

    Args:
        captions: id → caption.
        model: folder of a sentence model saved by transformers, or `hub:org/name`; a caption's
            vector is the mean of the last layer over its tokens.
        device: "auto", or a torch device.

    Raises:
        InputError: there is no such model.
        FileFormatError: it cannot be loaded.
        MissingDependencyError: torch or transformers is not installed.
    """
    return similar_pairs(list(captions), embed_sentences(list(captions.values()), model, device))


def similar_pairs(ids: Sequence[str], vectors: NDArray[np.float32]) -> list[tuple[str, str, float]]:
    """Pairs of vectors of unit length with a cosine of at least 0.95, the most similar first."""
    pairs = []
    for first, vector in enumerate(vectors):
        cosines = vectors[first + 1 :] @ vector
        for place in np.flatnonzero(cosines >= LEAST_COSINE):
            pairs.append((ids[first], ids[first + 1 + int(place)], float(cosines[place])))
    return sorted(pairs, key=lambda pair: -pair[2])


def embed_sentences(texts: Sequence[str], model: str, device: str) -> NDArray[np.float32]:
    """Vectors of unit length, [n, d]; errors as `find_similar`."""
    torch, transformers = require("torch", extra=EXTRA), require("transformers", extra=EXTRA)
    place, _ = resolve_device(device, "device")
    folder = find_saved_model(model, "sentence model", example=EXAMPLE)
    with loading(folder, "a sentence model"):
        tokenizer = transformers.AutoTokenizer.from_pretrained(str(folder), local_files_only=True)
        network = transformers.AutoModel.from_pretrained(
            str(folder), local_files_only=True, use_safetensors=True
        )
    network = network.eval().to(place)
    longest = int(network.config.max_position_embeddings)
    parts = []
    with torch.inference_mode():
        for first in range(0, len(texts), BATCH):
            words = tokenizer(
                list(texts[first : first + BATCH]),
                padding=True,
                truncation=True,
                max_length=longest,
                return_tensors="pt",
            ).to(place)
            mask = words["attention_mask"].unsqueeze(-1).float()
            total = (network(**words).last_hidden_state.float() * mask).sum(1)
            parts.append(torch.nn.functional.normalize(total, dim=-1).cpu().numpy())
    return np.concatenate(parts)
