"""Prompts to start from, each with a small image that the embedded generator rendered."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

PROMPTS = {
    "car.jpg": "a red car drives left past two trees at dusk",
    "ostriches.jpg": "two ostriches run across a grassland",
    "sharks.jpg": "three sharks swim in the ocean",
    "drone.jpg": "a white drone hovers at night",
    "ball.jpg": "a yellow ball bounces on the grass, slow zoom",
    "lamp.jpg": "a person walks past a lamp that flickers at 25 Hz, at night",
}
"""Image → prompt."""


def examples() -> list[tuple[Path, str]]:
    """Image and prompt of every example."""
    folder = Path(str(resources.files(__name__)))
    return [(folder / name, prompt) for name, prompt in PROMPTS.items()]
