"""Prompts of the embedded generator as scenes of the oracle: articulated models, shadows, light."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

from texvent.generate.procedural import ProceduralConfig, ProceduralGenerator
from texvent.sensor import SensorSize
from texvent.video import MICROSECONDS
from texvent_lab.bench.oracle.camera import radiance_of

PROMPTS: Mapping[str, str] = {
    "prompt-car": "a red car drives left past two trees at dusk",
    "prompt-dog": "a dog runs across a meadow",
    "prompt-bird": "a bird flies over the sea at night",
}
"""Name of the scene → prompt; the seed varies what the words leave open."""
SECONDS = 0.5


def build_prompt_scene(
    prompt: str, seed: int, size: SensorSize
) -> Callable[[float], NDArray[np.float64]]:
    """What a prompt shows, at any instant.

    The generator draws each instant anew, so nothing between two frames is guessed. Its levels
    are taken for those of the benchmark's camera before rounding: the camera gives them back.

    Args:
        prompt: English sentences.
        seed: of the generator: which car, which trees.
        size: width and height, px.

    Raises:
        InputError: the prompt is empty.
    """
    generator = ProceduralGenerator(ProceduralConfig(duration=SECONDS), seed=seed, size=size)
    video = generator.generate(prompt)

    def show(seconds: float) -> NDArray[np.float64]:
        return radiance_of(video.at(round(seconds * MICROSECONDS)).luma)

    return show
