"""Contact sheet of the embedded generator's nouns, each alone on a plain ground.

    python -m texvent_lab.measure.noun_sheet -o nouns.png [--columns 8] [NOUN ...]

To judge by eye: would a stranger recognise it?
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from texvent.io.atomic import atomic_file
from texvent.scenes.description import STANDING, SceneDescription, SceneObject, Surroundings
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.raycast.render import render
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize
from texvent.view.drawing.canvas import Image, draw_text, png_bytes, tile

SIZE = SensorSize(128, 96)
LABEL_PX = 9


def draw_noun(name: str, seed: int = 0) -> Image:
    """[96, 128, 3] a still of one noun with its name."""
    description = SceneDescription(
        name,
        objects=(SceneObject(name, motion=STANDING),),
        surroundings=Surroundings("plain"),
    )
    scene = compose_scene(description, seed=seed, size=SIZE, duration_s=1.0)
    image = np.rint(render(scene, 0.3, SIZE)).astype(np.uint8)
    draw_text(image, name, 3, 3 + LABEL_PX, height=LABEL_PX, colour=(0, 0, 0))
    return image


def main() -> None:
    """Draw the nouns named, or all, into one image."""
    parser = argparse.ArgumentParser(description="Contact sheet of the embedded generator's nouns.")
    parser.add_argument("nouns", nargs="*", metavar="NOUN")
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--columns", type=int, default=8)
    asked = parser.parse_args()
    panels = [draw_noun(name) for name in asked.nouns or NOUNS]
    with atomic_file(asked.output, overwrite=True) as path:
        path.write_bytes(png_bytes(tile(panels, asked.columns, (255, 255, 255))))


if __name__ == "__main__":
    main()
