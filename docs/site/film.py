"""The film of the start page: what the first notebook computes, told in a minute.

`python docs/site/film.py FOLDER` makes it by itself, from the repository's folder.
"""

import json
import sys
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import chdir
from fractions import Fraction
from itertools import count
from pathlib import Path
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.represent.event_frame import count_events
from texvent.view.drawing.canvas import (
    Image,
    blank,
    draw_text,
    enlarge,
    png_bytes,
    text_width,
    tile,
)
from texvent.view.drawing.event_image import draw_events, frame_image
from texvent.view.drawing.palettes import get_palette
from texvent.view.video_encoder import VideoEncoder

NOTEBOOK = Path(__file__).parents[1] / "notebooks/first-events.ipynb"
WIDTH, HEIGHT, STRIP, RATE = 960, 360, 56, 24
GROUND, INK, FAINT = (23, 24, 27), (240, 240, 240), (150, 155, 165)
PALETTE = get_palette("paper")
LEAST_US = 10_000
"""Events of the last milliseconds stay in sight, so that slow motion shows outlines."""


def make_film(folder: Path) -> None:
    """Write start.mp4 and start.png, unless they are newer than the notebook and this file."""
    film, still = folder / "start.mp4", folder / "start.png"
    newest = max(path.stat().st_mtime for path in (NOTEBOOK, Path(__file__)))
    if film.exists() and still.exists() and film.stat().st_mtime > newest:
        return
    story, times = run_notebook(NOTEBOOK), count(step=Fraction(1_000_000, RATE))
    size = {"width": WIDTH, "height": STRIP + HEIGHT}
    with VideoEncoder(film, fps=Fraction(RATE), overwrite=True, **size) as video:
        for caption, images in chapters(story):
            for image in images:
                video.write(_captioned(image, caption), int(next(times)))
    moment = int(np.argmax(np.histogram(story["events"].t, bins=_starts(story))[0]))
    picture = beside(story, int(_starts(story)[moment + 1]) - 1, 40_000)
    still.write_bytes(png_bytes(_captioned(picture, f'"{story["PROMPT"]}"')))


def run_notebook(path: Path) -> dict[str, Any]:
    """The values that a notebook's cells leave behind."""
    values: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
            if cell["cell_type"] == "code":
                exec(compile("".join(cell["source"]), path.name, "exec"), values)
    return {**values, "shown": [(one.t_us, frame_image(one)) for one in values["frames"]]}


def chapters(story: dict[str, Any]) -> Iterator[tuple[str, Iterable[Image]]]:
    """Captions and images."""
    command = f'$ texvent generate "{story["PROMPT"]}" -o events.h5'
    yield "A sentence ...", typed(command, seconds=6)
    yield "... becomes frames, and the events of an event camera", 3 * list(played(story, 6, 0.08))
    yield "Slow motion: the frames stand still, the events go on", played(story, 14, 0.02)
    yield "A voxel grid: five bins of 20 ms, as networks read them", grids(story, seconds=9)
    learned = f"A linear classifier of {(~story['is_test']).sum()} clips names new ones"
    yield learned, named(story)
    yield "Your turn", typed("$ make demo", seconds=4)


def typed(text: str, *, seconds: int) -> Iterator[Image]:
    """A line that is typed in half of the time."""
    for number in range(seconds * RATE):
        image = blank(WIDTH, HEIGHT, GROUND)
        shown = text[: 1 + len(text) * 2 * number // (seconds * RATE)]
        left = (WIDTH - text_width(text, 17)) // 2
        draw_text(image, shown, left, HEIGHT // 2, height=17, colour=INK)
        yield image


def played(story: dict[str, Any], seconds: int, speed: float) -> Iterator[Image]:
    """Frames and events side by side, `speed` times as fast as in life."""
    step_us = speed * 1_000_000 / RATE
    for number in range(seconds * RATE):
        yield beside(story, round((number + 1) * step_us), max(LEAST_US, round(step_us)))


def beside(story: dict[str, Any], t_us: int, window_us: int) -> Image:
    """The last frame, and the last events."""
    frame = [image for start_us, image in story["shown"] if start_us <= t_us][-1]
    events = _between(story["events"], t_us - window_us, t_us)
    return tile([_enlarged(frame, "smooth"), _enlarged(_drawn(events), "blocks")], 2, GROUND)


def grids(story: dict[str, Any], *, seconds: int) -> Iterator[Image]:
    """Voxel grids of 100 ms, later and later."""
    last = story["events"].time_range[1] - 100_000
    for start_us in np.linspace(0, last, seconds * RATE).astype(int):
        part = _between(story["events"], start_us, start_us + 100_000)
        bins = np.rint(4 * part.represent("voxel-e2vid", bins=5)).astype(int)
        panels = [draw_events(np.stack([-one, one]).clip(0), PALETTE) for one in bins]
        row = tile(panels, 5, GROUND, gap=8)
        image = blank(WIDTH, HEIGHT, GROUND)
        top, left = (HEIGHT - row.shape[0]) // 2, (WIDTH - row.shape[1]) // 2
        image[top : top + row.shape[0], left : left + row.shape[1]] = row
        for number in range(5):
            label = f"{(start_us + 20_000 * number) / 1000:.0f} ms"
            x = left + number * row.shape[1] // 5
            draw_text(image, label, x, top - 14, height=14, colour=FAINT)
        yield image


def named(story: dict[str, Any]) -> Iterator[Image]:
    """Clips that were not trained on, one after another, and what the classifier calls them."""
    right = 0
    chosen = np.flatnonzero(story["is_test"])
    for place, number in enumerate(np.random.default_rng(0).permutation(chosen), 1):
        clip, guess = story["clips"][number], story["MOTIONS"][story["named"][number]]
        right += int(story["named"][number] == story["labels"][number])
        for moment in range(RATE):
            t_us = 200_000 * (moment + 1) // RATE
            image = blank(WIDTH, HEIGHT, GROUND)
            image[:, :480] = _enlarged(_drawn(_between(clip, 0, t_us)), "blocks")
            draw_text(image, guess, 530, 170, height=28, colour=INK)
            score = f"{right} of {place} named right"
            draw_text(image, score, 530, 226, height=17, colour=FAINT)
            yield image


def _starts(story: dict[str, Any]) -> np.ndarray:
    return np.array([start_us for start_us, _ in story["shown"]])


def _between(events: EventStream, start_us: int, stop_us: int) -> EventStream:
    """As `EventStream.between`, which warns where there is none."""
    return events[slice(*np.searchsorted(events.t, [start_us, stop_us]))]


def _drawn(events: EventStream) -> Image:
    return draw_events(count_events(events), PALETTE)


def _enlarged(image: Image, how: Any) -> Image:
    return enlarge(image, HEIGHT // image.shape[0], how=how)


def _captioned(image: Image, caption: str) -> Image:
    strip = blank(WIDTH, STRIP, GROUND)
    draw_text(strip, caption, 24, STRIP // 2 + 10, height=20, colour=INK)
    return np.vstack([strip, image])


if __name__ == "__main__":
    make_film(Path(sys.argv[1]))
