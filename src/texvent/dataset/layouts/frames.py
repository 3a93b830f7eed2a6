"""Frames of a sample, read or made again and written as a folder of images; the layout timelens.

TimeLens reads frames, and the events between each two:

    SPLIT/KEY/images/000000.png    frames
    SPLIT/KEY/images/timestamp.txt one time per frame, µs
    SPLIT/KEY/events/000001.npz    events between frame 0 and frame 1: x, y, t (µs), p (0 or 1)

Source: S. Tulyakov et al., "TimeLens: event-based video frame interpolation", CVPR 2021, and its
code: `python -m timelens.run_timelens checkpoint.bin KEY/events KEY/images OUT 0 7`.
"""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.generation.make_sample import prepare_clip
from texvent.dataset.generation.recipe import VIDEOS, Recipe, Shard
from texvent.dataset.generation.shard_files import SampleRecord
from texvent.dataset.generation.shard_samples import StoredVideos
from texvent.dataset.layouts.layout import Layout, LayoutSample
from texvent.dataset.stored.folder import StoredShard
from texvent.dataset.stored.sample_files import SampleFiles
from texvent.errors import FileFormatError, InputError
from texvent.frames import FrameStream
from texvent.io.atomic import atomic_folder
from texvent.pipeline import fit_to_sensor
from texvent.settings.provenance import is_replaced


def _write(sample: LayoutSample, path: Path) -> bool:
    if sample.read_frames is None:
        raise InputError(f"sample {sample.key} has no frames")
    events = sample.read_events()
    with atomic_folder(path, overwrite=False, is_own=lambda _: False) as part:
        with sample.read_frames() as frames:
            times = write_frames(frames, part / "images")
        np.savetxt(part / "images" / "timestamp.txt", times, fmt="%d")
        (part / "events").mkdir()
        for index, (start, stop) in enumerate(pairwise(times), start=1):
            between = events.cut(int(start), int(stop))
            columns = {name: getattr(between, name) for name in "xytp"}
            np.savez_compressed(part / "events" / f"{index:06d}.npz", **columns)
    return True


TIMELENS = Layout(
    place="{split}/{key}",
    write=_write,
    lost="captions",
    takes_frames=True,
    has_frames=True,
)


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
def clip_frames(recipe: Recipe, stored: StoredShard, sample: SampleRecord) -> Iterator[FrameStream]:
    """Frames of a clip at the size of its events.

    Args:
        recipe: of the data set.
        stored: shard that its sample is in.
        sample: that shows the clip.

    Raises:
        InputError: its video, or a file that its scene shows, is not the one of its events.
        TexventError: the video cannot be read or made.
    """
    record = stored.record
    shard = Shard(record.variant, record.split, int(record.name.rpartition("-")[2]))
    clip = next((one for one in recipe.clips_of(shard) if one.key == sample.clip), None)
    if clip is None:
        raise FileFormatError(f"sample {sample.key} shows a clip that is not of {shard.path}")
    name = clip.item.video
    if name is not None and is_replaced(name, record.inputs.get(name, {"seen": ""})):
        raise InputError(f"{name} is not the video that the events of {sample.key} are of")
    settings = recipe.settings[shard.variant].of(clip)
    if not recipe.stores_videos:
        video = prepare_clip(recipe, clip, settings).video
        if name is None:
            _check_files(video, stored.files(sample))
        yield video
        return
    with tempfile.TemporaryDirectory() as scratch:
        folder = stored.path.parent.parent
        videos = StoredVideos(folder, replace(shard, variant=VIDEOS), Path(scratch))
        yield fit_to_sensor(videos.open(clip), settings)


def _check_files(video: FrameStream, files: SampleFiles) -> None:
    """Refuse a scene that shows other files than it did; the data set may come from others.

    Raises:
        InputError: see above.
    """
    source = files.facts().get("source")
    listed = source.get("files") if isinstance(source, dict) else None
    if video.metadata.get("files", []) != (listed or []):
        raise InputError(f"the files that the scene of {files.key} shows are not as they were")
