"""Water whose waves are said: higher ones change more, foam, and roll onto a shore."""

from __future__ import annotations

import math
from dataclasses import replace

import numba
import numpy as np
import pytest
from tests.scenes.sentences import parse_prompt

from texvent.scenes.raycast.records import INSTANT_RECORD
from texvent.scenes.raycast.render import render
from texvent.scenes.raycast.shading.road import _foam_share
from texvent.scenes.scene import Ground
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
def test_high_waves_foam_and_move(prompt) -> None:
    flat, high = (draw(prompt, 0.0, height) for height in (1.0, 2.2))
    assert np.count_nonzero(high > flat + 40.0) > 30
    later = draw(prompt, 0.4, 2.2)
    assert np.abs(later - high).mean() > 1.3 * np.abs(draw(prompt, 0.4, 1.0) - flat).mean()


@numba.njit
def foam_share(instant, strip, feet):
    return _foam_share(instant, strip, feet)


def test_foam_rolls_towards_the_beach() -> None:
    """What is at a distance from the shore is nearer by 2 m/s later, and thicker there."""
    record = np.zeros(1, dtype=INSTANT_RECORD)
    record["wave_height"], record["ground"] = 2.2, Ground.LAKE
    feet = (0.05, 0.05)

    def foam(along_m: float, far_m: float, time_s: float) -> float:
        record["time"] = time_s
        share = foam_share(record[0], (along_m, far_m, 1.0, 0.0), feet)
        return float(share) * math.exp(far_m / (8.0 * 2.2))

    shares = [foam(x, d, 0.0) for x in (0.0, 3.0, 7.5) for d in np.arange(3.0, 15.0, 0.5)]
    later = [foam(x, d - 1.0, 0.5) for x in (0.0, 3.0, 7.5) for d in np.arange(3.0, 15.0, 0.5)]
    assert later == pytest.approx(shares)
    assert max(shares) > 0.8
    assert min(shares) < 0.05
    record["wave_height"] = 1.0
    assert foam(0.0, 4.0, 0.0) == 0.0
