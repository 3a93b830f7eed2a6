"""Frames of a clip again: from the stored videos, else made or read as for its samples."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

from texvent.dataset.generation.make_shard import StoredVideos
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.sample import prepare_clip
from texvent.dataset.specification.clips import clip_settings
from texvent.pipeline import fit_to_sensor
from texvent.video import FrameStream


@contextmanager
def clip_frames(recipe: Recipe, folder: Path, shard: Shard, key: str) -> Iterator[FrameStream]:
    """Frames of a clip at the size of its events.

    Args:
        recipe: of the data set.
        folder: of the data set.
        shard: that its sample is in.
        key: of the clip.

    Raises:
        TexventError: the video cannot be read or made.
    """
    clip = next(one for one in recipe.clips_of(shard) if one.key == key)
    settings = clip_settings(
        recipe.specification,
        recipe.variants[shard.variant],
        clip,
        recipe.command,
        is_stored=recipe.stores_videos,
    )
    if not recipe.stores_videos:
        yield prepare_clip(recipe, clip, settings).video
        return
    with tempfile.TemporaryDirectory() as scratch:
        stored = StoredVideos(folder, replace(shard, variant=VIDEOS), Path(scratch))
        yield fit_to_sensor(stored.open(clip), settings)
