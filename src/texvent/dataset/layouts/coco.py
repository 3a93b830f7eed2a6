"""Layout coco: images of events at labelled instants, with their boxes as COCO JSON.

    SPLIT/KEY/000000.png      events of the 50 ms before an instant
    SPLIT/annotations.json    images, annotations and categories of the split

Instants less than 50 ms after the first frame are left out. An image may have no box. Categories
are numbered from 1, images and annotations too; a box has `track_id`, an image `t_us`.

Source: the COCO object detection format.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import ExitStack
from itertools import count
from pathlib import Path

import numpy as np

from texvent.dataset.layouts.layout import USUAL_SPLITS, Layout, LayoutSample
from texvent.io.atomic import atomic_file, atomic_folder
from texvent.represent.event_frame import count_events
from texvent.runtime.files.file_names import inside
from texvent.truth.boxes import CocoFile, open_coco

WINDOW_US = 50_000
FIRST_CLASS = 1


def _write(sample: LayoutSample, path: Path) -> bool:
    from texvent.view.drawing.canvas import png_bytes  # brings OpenCV
    from texvent.view.drawing.event_image import draw_events
    from texvent.view.drawing.palettes import DEFAULT_PALETTE, get_palette

    events, palette = sample.read_events(), get_palette(DEFAULT_PALETTE)
    with atomic_folder(path, overwrite=False, is_own=lambda _: False) as part:
        for name, t_us in _images(sample):
            counts = count_events(events.cut(t_us - WINDOW_US, t_us))
            (part / name).write_bytes(png_bytes(draw_events(counts, palette)))
    return True


def _images(sample: LayoutSample) -> Iterator[tuple[str, int]]:
    """Name and instant of each image, µs."""
    instants = sample.instants_us[sample.instants_us >= sample.start_us + WINDOW_US]
    return ((f"{index:06d}.png", t_us) for index, t_us in enumerate(instants.tolist()))


def _write_annotations(
    folder: Path, samples: Iterable[LayoutSample], classes: tuple[str, ...]
) -> None:
    names = dict(enumerate(classes, start=FIRST_CLASS))
    numbers = count(1)
    with ExitStack() as stack:
        files: dict[str, CocoFile] = {}
        for sample in samples:
            if sample.split not in files:
                path = inside(folder, f"{sample.split}/annotations.json")
                part = stack.enter_context(atomic_file(path, overwrite=True))
                context = open_coco(part, classes=names, info={})
                files[sample.split] = stack.enter_context(context)
            for name, t_us in _images(sample):
                place = f"{sample.key}/{name}"
                files[sample.split].add_image(next(numbers), place, sample.size, t_us)
                for box in sample.boxes[sample.boxes["t"] == t_us]:
                    _add_box(files[sample.split], box)


def _add_box(file: CocoFile, box: np.void) -> None:
    left, top, width, height = (float(box[name]) for name in "xywh")
    file.add_box(
        int(box["class_id"]) + FIRST_CLASS,
        (left, top, width, height),
        width * height,
        track_id=int(box["track_id"]),
    )


COCO = Layout(
    place="{split}/{key}",
    write=_write,
    finish=_write_annotations,
    splits=USUAL_SPLITS,
    lost="captions, events (only images of them)",
    has_boxes=True,
    first_class=FIRST_CLASS,
)
