"""The paper's figures on a recording: a column per simulator, a row per picture of its events.

Figure 5 shows events and images that a network makes of them, Figure 6 events warped along their
motion and depth, Figure 7 events of the ablations, Figure 12 optical flow.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from texvent.errors import InputError, MissingDependencyError, TexventError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.represent.contrast_maximisation import find_flow, warp_events
from texvent.represent.event_frame import count_events
from texvent.view.drawing.canvas import Image, blank, draw_text, fit_text, png_bytes, tile
from texvent.view.drawing.event_image import draw_events, draw_flow, frame_image
from texvent.view.drawing.palettes import get_palette
from texvent_lab.bench.fidelity.entries import Entry
from texvent_lab.bench.jobs import Progress
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.bench.paper.published_tables import FIGURES
from texvent_lab.bench.real.recording import RealScene
from texvent_lab.reconstruct.reconstructor import Reconstructor, load_reconstructor

ABLATION_FIGURE = 7
ABLATED = ("Texvent", "E1", "E2", "E3", "E4", "E5")
"""Columns of Figure 7."""
NETWORKS = {5: "e2vid", 6: "e2depth"}
RECORDED = "recorded"
SLICE_US = 50_000
"""Events of one picture: short enough for a constant motion, and a step of the network."""
WHITE, INK = (255, 255, 255), (38, 38, 46)
TITLE_PX, GAP_PX = 9, 4
Draw = Callable[[EventStream], Image]


def draw_figure(
    number: int,
    scene: RealScene,
    columns: Mapping[str, Entry],
    config: PaperConfig,
    progress: Progress,
) -> tuple[bytes, list[str]]:
    """A figure as a PNG, and notes: what it shows, and what is left out and why.

    Args:
        number: one of `FIGURES`.
        scene: the recording; its slice with the most recorded events is shown.
        columns: name → simulator.
        config: network and weights, and whether thresholds are fitted to the recorded count.
        progress: told of every simulator.

    Raises:
        InputError, FileFormatError: weights that were named are missing or damaged.
    """
    notes = []
    network: Reconstructor | None = None
    if number in NETWORKS:
        try:
            network = load_reconstructor(config.network or NETWORKS[number], config.weights)
        except (InputError, MissingDependencyError) as error:
            if config.weights is not None:
                raise
            notes.append(f"not drawn: {config.network or NETWORKS[number]}; {error}")
    slices = [_slices(scene, scene.references)]
    names = [RECORDED]
    for name, entry in columns.items():
        progress(f"{scene.scene}: {name}")
        try:
            events = scene.simulate(entry, _threshold(scene, entry, config))
        except TexventError as error:
            notes.append(f"not drawn: {name}; {error}")
            continue
        slices.append(_slices(scene, events))
        names.append(name)
    shown = int(np.argmax([len(one) for one in slices[0]]))
    rows = [[draw(one[shown]) for one in slices] for draw in _pictures(number)]
    if network is not None:
        rows.append([_last_image(network.twin(), one[: shown + 1]) for one in slices])
    start_us = scene.whole.start_us + shown * SLICE_US
    stop_us = start_us + SLICE_US
    place = int(np.searchsorted(scene.video.times_us, stop_us, "right")) - 1
    frame = frame_image(Frame(scene.video.pixels[place], scene.video.times_us[place]))
    notes.insert(0, f"{scene.scene}: {FIGURES[number]}; {start_us} to {stop_us} µs")
    return _grid(["frame", *names], rows, frame), notes


def _slices(scene: RealScene, spans: Sequence[EventStream]) -> list[EventStream]:
    """Events of all scored spans, cut into slices."""
    events = EventStream.concat(list(spans))
    edges = range(scene.whole.start_us, scene.whole.stop_us, SLICE_US)
    return [events.cut(edge, edge + SLICE_US) for edge in edges]


def _threshold(scene: RealScene, entry: Entry, config: PaperConfig) -> float | None:
    """δ that gives the recorded number of events, if the simulator has one that is to be fitted."""
    if not config.match_rate or entry.default_threshold is None:
        return None
    found, _ = entry.fit(lambda one: scene.count(entry, one), scene.fit_count)
    return None if found is None else found.threshold


def _pictures(number: int) -> list[Draw]:
    """Pictures of a slice that need no network."""
    if number == 6:
        return [lambda events: _events(warp_events(events, find_flow(events)))]
    return [lambda events: draw_flow(find_flow(events))] if number == 12 else [_events]


def _events(events: EventStream) -> Image:
    return draw_events(count_events(events), get_palette("paper"))


def _last_image(network: Reconstructor, slices: Sequence[EventStream]) -> Image:
    """The network's image after the last of consecutive slices."""
    for events in slices:
        image = network.reconstruct(events)
    levels = np.rint(255 * np.atleast_3d(network.picture(image))).astype(np.uint8)
    return np.broadcast_to(levels, (*image.shape[:2], 3)).copy()


def _grid(names: Sequence[str], rows: Sequence[Sequence[Image]], frame: Image) -> bytes:
    """Rows of pictures below their names, the frame at the left of the last one."""
    height, width = frame.shape[:2]
    empty = blank(width, height, WHITE)
    panels = [one for row in rows[:-1] for one in (empty, *row)] + [frame, *rows[-1]]
    grid = tile(panels, len(names), WHITE, gap=GAP_PX)
    head = blank(grid.shape[1], 3 * TITLE_PX, WHITE)
    for place, name in enumerate(names):
        text = fit_text(name, TITLE_PX, width)
        draw_text(head, text, place * (width + GAP_PX), 2 * TITLE_PX, height=TITLE_PX, colour=INK)
    return png_bytes(np.concatenate([head, grid]), level=9)
