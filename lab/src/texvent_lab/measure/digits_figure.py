"""What networks of `texvent bench digits` see: digits as recorded and as simulated.

    python -m texvent_lab.measure.digits_figure RESULT --mnist DIR --nmnist DIR -o digits-events.png

RESULT is the JSON file of `texvent bench digits`; thresholds are those that it fitted to the pairs.
Each row is a pair of a recording of N-MNIST and the digit that it shows: the events of the first
movement, and how recent each pixel's last event is at the end.
"""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from texvent.capture.camera_path.saccades import DURATION_US
from texvent.events import EventStream
from texvent.io.atomic import atomic_file, check_output
from texvent.represent.event_frame import count_events
from texvent.represent.named import represent_window
from texvent.run.prepare import prepare_video
from texvent.view.drawing.canvas import Image, blank, draw_text, enlarge, png_bytes, text_width
from texvent.view.drawing.event_image import draw_events, draw_fading
from texvent.view.drawing.palettes import get_palette
from texvent_lab.bench.digits.arms import Way, find_arm
from texvent_lab.bench.digits.data.idx import read_mnist
from texvent_lab.bench.digits.data.inputs import REPRESENTATIONS, WINDOW_US
from texvent_lab.bench.digits.data.recordings import FIRST_TEST, read_recordings
from texvent_lab.bench.digits.data.sheet import Digits, DigitSheet
from texvent_lab.bench.digits.report.results import DigitsReport, read_report
from texvent_lab.bench.document import read_document

PAIRS = (1, 2, 5)
"""Numbers of MNIST's test images."""
ARMS: Mapping[str, Way] = {
    "physical": "exact",
    "texvent accurate": "exact",
    "texvent paper": "exact",
    "esim": "exact",
    "v2e noisy": "exact",
    "frame difference": "frames",
}
MOVEMENTS = 3
SCALE, GAP, TEXT_PX = 4, 10, 8
PALETTE = get_palette("paper")


def main() -> None:
    """Write the figure."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("result", type=Path)
    parser.add_argument("--mnist", type=Path, required=True)
    parser.add_argument("--nmnist", type=Path, required=True)
    parser.add_argument("-o", "--out", type=Path, required=True)
    parser.add_argument("--overwrite", action="store_true")
    options = parser.parse_args()
    check_output(options.out, overwrite=options.overwrite)
    report = read_report(read_document(options.result))
    image = draw_figure(report, options.mnist, options.nmnist)
    with atomic_file(options.out, overwrite=options.overwrite) as part:
        part.write_bytes(png_bytes(image, level=9))


def draw_figure(report: DigitsReport, mnist: Path, nmnist: Path) -> Image:
    """A row per digit and kind of image, a column per source of events."""
    images = read_mnist(mnist).images[np.array(PAIRS) - 1]
    sheet = DigitSheet(Digits.as_measured(images))
    recorded = read_recordings(nmnist, [FIRST_TEST + number for number in PAIRS])
    columns = {"recorded": sheet.lay_out([one.events for one in recorded])}
    for name, way in ARMS.items():
        thresholds = (
            one.threshold
            for one in report.scores
            if (one.arm, one.way, one.choice) == (name, way, "matched")
        )
        settings = find_arm(name).settings(way, threshold=next(thresholds, None))
        settings = dataclasses.replace(settings, run=dataclasses.replace(settings.run, seed=1))
        columns[name] = prepare_video(sheet, settings).packets.collect()
    parts = [_column(sheet, name, events) for name, events in columns.items()]
    return np.ascontiguousarray(np.concatenate(parts, axis=1))


def _column(sheet: DigitSheet, name: str, events: EventStream) -> Image:
    surface = represent_window(
        "time-surface", events, WINDOW_US, **REPRESENTATIONS["surface"].options
    )
    first = events.between(0, DURATION_US // MOVEMENTS)
    images = [
        sheet.cut(np.moveaxis(one, -1, 0))
        for one in (
            draw_events(count_events(first), PALETTE),
            draw_fading(np.asarray(surface), PALETTE),
        )
    ]
    tiles = [
        enlarge(np.ascontiguousarray(np.moveaxis(kind[number], 0, -1)), SCALE, how="blocks")
        for number in range(len(PAIRS))
        for kind in images
    ]
    height, width = tiles[0].shape[:2]
    column = blank(width + GAP, 2 * TEXT_PX + len(tiles) * (height + GAP), PALETTE.background)
    left = max(0, (width - text_width(name, TEXT_PX)) // 2)
    draw_text(column, name, left, TEXT_PX + 2, height=TEXT_PX, colour=PALETTE.ink)
    for number, tile in enumerate(tiles):
        top = 2 * TEXT_PX + number * (height + GAP)
        column[top : top + height, :width] = tile
    return column


if __name__ == "__main__":
    main()
