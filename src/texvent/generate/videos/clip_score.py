"""Does a video show what the prompt says? A score from a CLIP model that the user has.

CLIP maps images and sentences to vectors; their cosine is higher where they belong together. For
OpenAI's ViT-B/32 a fitting pair is typically near 0.3, an unrelated one near 0.15. The score is the
mean over frames, as in the CLIPScore of video generation papers (without its factor 2.5).
"""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

import numpy as np

from texvent._require import require
from texvent.errors import InputError
from texvent.generate.video_models.loading import loading
from texvent.generate.videos.stored_video import StoredVideo
from texvent.video import PixelArray

EXTRA = "generate"
FRAMES = 8
"""Frames looked at, spread over the clip."""
MEAN = (0.48145466, 0.4578275, 0.40821073)
STD = (0.26862954, 0.26130258, 0.27577711)
"""Of CLIP's training images, RGB in 0..1 (Radford 2021)."""


def measure_clip_score(video: StoredVideo, prompt: str, folder: Path) -> float:
    """Mean cosine between the prompt and frames of a video, -1..1.

    Args:
        video: the video.
        prompt: what it should show; CLIP reads the first 77 tokens of it.
        folder: a CLIP model saved by transformers.

    Raises:
        InputError: there is no such model.
        FileFormatError: it cannot be loaded as one.
        MissingDependencyError: torch or transformers is not installed.
    """
    torch = require("torch", extra=EXTRA)
    model, tokenizer = _load_clip(folder)
    chosen = set(np.linspace(0, video.frame_count - 1, FRAMES).round().astype(int).tolist())
    size = int(model.config.vision_config.image_size)
    images = [_prepare(frame.pixels, size) for index, frame in enumerate(video) if index in chosen]
    limit = int(model.config.text_config.max_position_embeddings)
    words = tokenizer([prompt], truncation=True, max_length=limit, return_tensors="pt")
    with torch.no_grad():
        outputs = model(
            input_ids=words["input_ids"],
            attention_mask=words["attention_mask"],
            pixel_values=torch.cat(images),
        )
    # Both are of unit length already.
    return float((outputs.image_embeds @ outputs.text_embeds.T).mean())


def check_clip_folder(folder: Path) -> None:
    """Refuse a folder that holds no saved model, without loading anything.

    Raises:
        InputError: it has no `config.json`.
    """
    if not (folder / "config.json").is_file():
        raise InputError(
            f"there is no CLIP model in {folder} (no config.json); give the folder of one saved by "
            "transformers, such as openai/clip-vit-base-patch32 fetched with: hf download"
        )


@functools.lru_cache(maxsize=1)
def _load_clip(folder: Path) -> tuple[Any, Any]:
    check_clip_folder(folder)
    transformers = require("transformers", extra=EXTRA)
    with loading(folder, "a CLIP model"):
        model = transformers.CLIPModel.from_pretrained(
            str(folder), local_files_only=True, use_safetensors=True
        )
        tokenizer = transformers.AutoTokenizer.from_pretrained(str(folder), local_files_only=True)
    return model.eval(), tokenizer


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
