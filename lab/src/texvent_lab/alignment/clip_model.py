"""CLIP models that the user has: vectors of images and sentences, and their agreement.

CLIP maps images and sentences to vectors of unit length; their cosine is higher where they belong
together. For OpenAI's ViT-B/32 a fitting pair is typically near 0.3, an unrelated one near 0.15.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import FileFormatError
from texvent.extending import require
from texvent.frames import PixelArray
from texvent.generation.diffusers_models.pipeline_loading import resolve_device
from texvent.generation.video_models.model_files import EXTRA, loading
from texvent_lab.networks.saved_models import find_model

EXAMPLE = "openai/clip-vit-base-patch32"
MEAN = (0.48145466, 0.4578275, 0.40821073)
STD = (0.26862954, 0.26130258, 0.27577711)
"""Standard deviation of CLIP's training images, RGB in 0..1 (Radford 2021)."""
BATCH = 32

Vectors = NDArray[np.float32]
"""[n, d], each of unit length."""


class ClipModel:
    """A model that maps images and sentences to vectors, whose cosine is higher where they fit.

    Args:
        model: folder of a CLIP model saved by transformers, or `hub:org/name`.
        device: "auto", or a torch device.

    Raises:
        InputError: there is no such model.
        FileFormatError: it cannot be loaded as one.
        ConfigError: torch cannot use the device here.
        MissingDependencyError: torch or transformers is not installed.
    """

    def __init__(self, model: str | Path, *, device: str = "cpu") -> None:
        self._device, _ = resolve_device(device, "device")
        folder = find_model(model, "CLIP model", EXAMPLE)
        transformers = require("transformers", extra=EXTRA)
        with loading(folder, "a CLIP model"):
            loaded = transformers.CLIPModel.from_pretrained(
                str(folder), local_files_only=True, use_safetensors=True
            )
            self._tokenizer = transformers.AutoTokenizer.from_pretrained(
                str(folder), local_files_only=True
            )
        self._model = loaded.eval().to(self._device)
        self._side = int(loaded.config.vision_config.image_size)
        self.most_tokens = int(loaded.config.text_config.max_position_embeddings)
        """Tokens of a sentence that the model reads; the rest is cut off."""

    def embed_images(self, images: Iterable[PixelArray]) -> Vectors:
        """Vectors of images, each [H, W, 3] uint8 or uint16."""
        prepared = [_prepare(pixels, self._side) for pixels in images]
        return self._embed(prepared, self._vectors_of_images)

    def embed_texts(self, texts: Sequence[str]) -> Vectors:
        """Vectors of sentences, of which the first `most_tokens` tokens count."""
        return self._embed(list(texts), self._vectors_of_texts)

    def count_tokens(self, text: str) -> int:
        """Tokens of a sentence, those that the model adds included."""
        return len(self._tokenizer(text, verbose=False)["input_ids"])

    def _vectors_of_images(self, images: list[Any]) -> Any:
        torch = require("torch", extra=EXTRA)
        pixels = torch.cat(images).to(self._device)
        seen = self._model.vision_model(pixel_values=pixels).pooler_output
        return self._model.visual_projection(seen)

    def _vectors_of_texts(self, texts: list[str]) -> Any:
        words = self._tokenizer(
            texts, truncation=True, max_length=self.most_tokens, padding=True, return_tensors="pt"
        ).to(self._device)
        read = self._model.text_model(
            input_ids=words["input_ids"], attention_mask=words["attention_mask"]
        ).pooler_output
        return self._model.text_projection(read)

    def _embed(self, items: list[Any], embed: Any) -> Vectors:
        torch = require("torch", extra=EXTRA)
        parts = []
        with torch.inference_mode():
            for first in range(0, len(items), BATCH):
                vectors = embed(items[first : first + BATCH])
                vectors = vectors / vectors.norm(dim=-1, keepdim=True)
                parts.append(vectors.float().cpu().numpy())
        found = np.concatenate(parts)
        if not np.isfinite(found).all():
            raise FileFormatError("the CLIP model gives NaN or infinity; its weights are damaged")
        return np.asarray(found, np.float32)


def _prepare(pixels: PixelArray, size: int) -> Any:
    """A frame as CLIP sees it: short side to `size`, centre cut, normalised; [1, 3, size, size]."""
    torch = require("torch", extra=EXTRA)
    functional = require("torch.nn.functional", extra=EXTRA)
    levels = pixels.astype(np.float32) / float(np.iinfo(pixels.dtype).max)
    image = torch.from_numpy(np.ascontiguousarray(levels.transpose(2, 0, 1)))[None]
    height, width = image.shape[2:]
    scale = size / min(height, width)
    shape = (max(size, round(height * scale)), max(size, round(width * scale)))
    resized = functional.interpolate(image, shape, mode="bicubic", antialias=True).clamp(0, 1)
    top, left = (shape[0] - size) // 2, (shape[1] - size) // 2
    centre = resized[:, :, top : top + size, left : left + size]
    mean, std = (torch.tensor(values).view(1, 3, 1, 1) for values in (MEAN, STD))
    return (centre - mean) / std
