"""Does a video show what the prompt says? A score from a CLIP model that the user has.

CLIP maps images and sentences to vectors; their cosine is higher where they belong together. For
OpenAI's ViT-B/32 a fitting pair is typically near 0.3, an unrelated one near 0.15. The score is the
mean over frames, as in the CLIPScore of video generation papers (without its factor 2.5).
"""

from __future__ import annotations

import functools
from pathlib import Path

import numpy as np

from texvent.generate.videos.clip_model import ClipModel
from texvent.generate.videos.stored_video import StoredVideo

FRAMES = 8
"""Frames looked at, spread over the clip."""


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
    model = _load_clip(folder)
    chosen = set(np.linspace(0, video.frame_count - 1, FRAMES).round().astype(int).tolist())
    frames = (frame.pixels for index, frame in enumerate(video) if index in chosen)
    return float((model.embed_images(frames) @ model.embed_texts([prompt]).T).mean())


_load_clip = functools.lru_cache(maxsize=1)(ClipModel)
