"""Event images of the truth and of every simulator: one scene, the same 10 ms."""

from __future__ import annotations

import numpy as np

from texvent.events import EventStream
from texvent.represent.event_frame import event_frame
from texvent.video import MICROSECONDS
from texvent.view.drawing.canvas import Image, blank, draw_text, enlarge, png_bytes, tile
from texvent.view.drawing.event_image import count_ceiling, draw_events
from texvent.view.drawing.palettes import get_palette
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.fidelity.results import FidelityReport
from texvent_lab.bench.oracle.camera import camera_level
from texvent_lab.bench.oracle.pixel import FLOOR_SEED, REFERENCE_SEED, TARGETS
from texvent_lab.bench.oracle.recording import oracle_scene, record

START_US, STOP_US = 250_000, 260_000
"""The 10 ms that are shown."""
ENLARGE = 3
COLUMNS = 4
TEXT_PX, MARGIN_PX = 10, 6
PAPER = (236, 238, 242)


def event_image_grid(report: FidelityReport, scene: str) -> bytes:
    """A PNG file: a video frame, the truth, a second recording, and each entry at its fitted δ.

    Args:
        report: a run that scored the scene.
        scene: which scene to show, on the first scoring seed, with the best entry first.
    """
    seed = report.score_seeds[0]
    shown = oracle_scene(scene, seed)
    target = next(one.target for one in report.references if one.scene == scene)
    model = TARGETS[target]
    streams = record(
        shown, {"truth": (model, REFERENCE_SEED), "second recording": (model, FLOOR_SEED)}
    )
    for score in report.ranked(scene, target):
        if score.track == "recorded":
            continue
        title = f"{score.entry}  {score.summary('stpp').mean:.2f}"
        streams[title] = Entry.parse(score.entry).simulate(shown, seed, score.threshold)
    level = camera_level(shown(START_US / MICROSECONDS))
    grey = np.repeat(np.rint(level).astype(np.uint8)[..., None], 3, axis=2)
    ceiling = count_ceiling(event_frame(_cut(streams["truth"]), "count"))
    panels = [_panel("scene", grey)]
    for title, events in streams.items():
        counts = event_frame(_cut(events), "count")
        panels.append(_panel(title, draw_events(counts, get_palette("paper"), ceiling=ceiling)))
    return png_bytes(tile(panels, COLUMNS, PAPER), level=9)


def _cut(events: EventStream) -> EventStream:
    return events.cut(START_US, STOP_US)


def _panel(title: str, image: Image) -> Image:
    large = enlarge(image, ENLARGE, how="blocks")
    height, width = large.shape[:2]
    panel = blank(width + 2 * MARGIN_PX, height + TEXT_PX + 3 * MARGIN_PX, PAPER)
    baseline = MARGIN_PX + TEXT_PX
    draw_text(panel, title, MARGIN_PX, baseline, height=TEXT_PX, colour=(38, 42, 50))
    top = TEXT_PX + 2 * MARGIN_PX
    panel[top : top + height, MARGIN_PX : MARGIN_PX + width] = large
    return panel
