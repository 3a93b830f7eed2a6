"""The contract of every pixel model: the same motion gives the same events at any frame rate.

One film has four bands that are known at any instant. Sampled at 30 to 500 frames per second, it is
given to every model and preset without noise.
"""

from collections import defaultdict
from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

import texvent
from texvent._registry import SIMULATORS
from texvent.options.values import option_names
from texvent.settings.presets import frame_bound_presets

RATES = (30, 100, 500)
SECONDS = 0.8
ROWS, WIDTH = 4, 48
X = np.arange(WIDTH, dtype=np.float64)
BANDS = {
    "grating": lambda t: 128 + 80 * np.sin(2 * np.pi * (X - 40 * t) / 50),
    "edge": lambda t: 60 + 140 / (1 + np.exp((X - 4 - 40 * t) / 3)),
    "ramp": lambda t: 30 + 200 * t + 0 * X,
    "flicker": lambda t: 120 + 90 * np.sin(2 * np.pi * 1.5 * t) + 0 * X,
}
QUIET: Mapping[str, Any] = {
    "noise": "none",
    "noise_scale": 0.0,
    "leak_rate_hz": 0.0,
    "hot_pixel_fraction": 0.0,
    "shot_noise_rate_hz": 0.0,
}
BY_DEFINITION = {
    ("texvent", "paper"),  # its cache forgets at every source frame
    ("v2e", "noisy"),  # its 30 Hz low-pass takes one Euler step per frame
    ("senpi", "default"),  # a pixel fires once per frame, however far the light has changed
    ("senpi", "peer-common"),
}
"""Presets whose published definition has the frame in it; docs/simulators.md names them."""
CASES = [
    (simulator, preset)
    for simulator in SIMULATORS.builtin
    for preset in SIMULATORS.load(simulator).presets
    if (simulator, preset) not in BY_DEFINITION
]


def film(rate: int) -> np.ndarray:
    """[N, H, W] float32 on the 0..255 scale."""
    times = np.arange(round(SECONDS * rate) + 1) / rate
    bands = [[np.tile(band(t), (ROWS, 1)) for band in BANDS.values()] for t in times]
    return np.asarray(bands, np.float32).reshape(len(times), -1, WIDTH)


def events_at(rate: int, simulator: str, preset: str) -> texvent.EventStream:
    names = option_names(SIMULATORS.load(simulator).config_type)
    quiet = {name: value for name, value in QUIET.items() if name in names}
    if "noise" in quiet:
        quiet.pop("noise_scale", None)  # it would have no effect
    return texvent.simulate(
        film(rate), fps=rate, simulator=simulator, preset=preset, seed=3, **quiet
    )


def times_by_pixel(events: texvent.EventStream, band: int) -> dict[Any, list[int]]:
    """(y, x, polarity) → times of its events, µs."""
    found: dict[Any, list[int]] = defaultdict(list)
    for x, y, t, p in zip(events.x, events.y, events.t.tolist(), events.p, strict=True):
        if y // ROWS == band:
            found[y, x, p].append(t)
    return found


def test_the_help_marks_these_presets_and_no_other():
    assert frame_bound_presets() == BY_DEFINITION


@pytest.mark.long
@pytest.mark.parametrize(("simulator", "preset"), CASES)
def test_the_frame_rate_changes_neither_counts_nor_times(simulator, preset):
    slowest, *others = (events_at(rate, simulator, preset) for rate in RATES)
    for band, name in enumerate(BANDS):
        wanted = times_by_pixel(slowest, band)
        number = sum(map(len, wanted.values()))
        assert number > 200, name
        for rate, events in zip(RATES[1:], others, strict=True):
            found = times_by_pixel(events, band)
            assert sum(map(len, found.values())) == pytest.approx(number, rel=0.03), (name, rate)
            apart = [
                abs(one - other)
                for where in wanted.keys() & found.keys()
                for one, other in zip(wanted[where], found[where], strict=False)
            ]
            assert np.mean(apart) < 1e6 / RATES[0] / 2, (name, rate)
