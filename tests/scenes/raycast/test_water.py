"""Water whose waves are said: higher ones change more, foam, and roll onto a shore."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.raycast.render import render
from texvent.scenes.staging.compose import compose_scene
from texvent.sensor import SensorSize

SIZE = SensorSize(96, 72)


def draw(prompt: str, time_s: float, wave_height: float) -> np.ndarray:
    """[72, 96] mean of red, green and blue, 0..255."""
    description = parse_prompt(prompt)
    surroundings = replace(description.surroundings, wave_height=wave_height)
    shot = replace(description.shot, moves=())
    still = replace(description, surroundings=surroundings, shot=shot)
    scene = compose_scene(still, seed=0, size=SIZE, duration_s=2.0)
    return render(scene, time_s, SIZE).astype(np.float64).mean(axis=2)


@pytest.mark.parametrize("prompt", ["the ocean", "a beach"])
def test_high_waves_foam_and_move(prompt):
    flat, high = (draw(prompt, 0.0, height) for height in (1.0, 2.2))
    assert np.count_nonzero(high > flat + 40.0) > 30
    later = draw(prompt, 0.4, 2.2)
    assert np.abs(later - high).mean() > 1.3 * np.abs(draw(prompt, 0.4, 1.0) - flat).mean()
