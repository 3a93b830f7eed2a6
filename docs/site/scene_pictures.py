"""Pictures of the page of twenty scenes: a frame of each sentence beside its events.

`python docs/site/scene_pictures.py FOLDER` makes them by themselves.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np

import texvent
from texvent.represent.event_frame import count_events
from texvent.view.drawing.canvas import Image, png_bytes, tile
from texvent.view.drawing.event_image import draw_events, frame_image
from texvent.view.drawing.palettes import get_palette

SENTENCES = (
    "a red car drives left past two trees",
    "a man rides a horse across a field",
    "rain falls on a street at night",
    "a drone flies over a forest",
    "a dog chases a ball in a park",
    "driving through a city",
    "a woman waves in a living room",
    "a checkerboard rotates",
    "a lamp flickers at 100 Hz on a desk",
    "a sailboat sails across a lake, mountains in the background",
    "two balls collide on a table, one is blue",
    "leaves fall in a park",
    "a man walks his dog along a snowy street",
    "a child kicks a football",
    "a spiral disc spins at 5 Hz",
    "a box on a conveyor belt",
    "a bus drives left on a wet road",
    "three fish swim in a coral reef",
    "a hand shows a thumbs up",
    "a wheel spins at 10 Hz",
)
OPTIONS = {"duration": 0.05, "sensor": "240x180"}
FRAME_US = 22_000
SCENES = Path(__file__).parents[2] / "src/texvent_scenes"
PALETTE = get_palette("paper")


def make_pictures(folder: Path) -> None:
    """Write a picture of each sentence, unless all are newer than the scenes and this file."""
    paths = [folder / f"scene-{number:02}.png" for number in range(1, 1 + len(SENTENCES))]
    sources = [Path(__file__), *(one for end in ("py", "toml") for one in SCENES.rglob(f"*.{end}"))]
    newest = max(one.stat().st_mtime for one in sources)
    if all(one.exists() and one.stat().st_mtime > newest for one in paths):
        return
    for path, sentence in zip(paths, SENTENCES, strict=True):
        path.write_bytes(png_bytes(picture(sentence)))


def picture(sentence: str) -> Image:
    """A frame, and all events of a short clip."""
    frame = texvent.video(sentence, **OPTIONS).at(FRAME_US)
    events = texvent.generate(sentence, **OPTIONS)
    drawn = draw_events(count_events(events), PALETTE)
    return tile([np.asarray(frame_image(frame)), drawn], 2, (255, 255, 255))


def cards() -> Iterator[str]:
    """Lines of Markdown: a card for each sentence, two beside each other where there is room."""
    yield "\n:::::{grid} 1 1 2 2\n:gutter: 3\n"
    for number, sentence in enumerate(SENTENCES, 1):
        yield from (
            "::::{grid-item-card}",
            f":img-top: /_build/made/scene-{number:02}.png",
            f":img-alt: Frame and events: {sentence}",
            ":class-card: scene-picture",
            "",
            f"`{sentence}`",
            "::::",
        )
    yield ":::::\n"


if __name__ == "__main__":
    make_pictures(Path(sys.argv[1]))
