"""Frames of a sample: read or made again, and written as a folder of images."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.generation.make_shard import StoredVideos
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.sample import prepare_clip
from texvent.dataset.specification.clips import clip_settings
from texvent.pipeline import fit_to_sensor
from texvent.video import FrameStream


def write_frames(frames: FrameStream, folder: Path) -> NDArray[np.int64]:
    """Write 000000.png and so on, 8-bit RGB, into a new folder.

    Returns:
        Their times, µs.
    """
    from texvent.view.drawing.canvas import png_bytes  # brings OpenCV
    from texvent.view.drawing.event_image import frame_image

    folder.mkdir(parents=True)
    times = []
    for index, frame in enumerate(frames):
        (folder / f"{index:06d}.png").write_bytes(png_bytes(frame_image(frame)))
        times.append(frame.t_us)
    return np.array(times, np.int64)


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
