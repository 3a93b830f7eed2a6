"""A drifting grating seen by five models: plots of site/grating.md, run when the site is built."""

from __future__ import annotations

import functools
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

import texvent
from texvent.errors import TexventWarning

FPS, SPEED, AMPLITUDE = 120, 40.0, 80.0
"""Of the grating, unless it is what the plot is about: px/s, and levels of 255."""
PERIOD_PX, SECONDS = 50, 1.0
WIDTH, HEIGHT = 100, 4
MODELS: Mapping[str, Mapping[str, Any]] = {
    "texvent": {"noise": "none"},
    "texvent paper": {"preset": "paper", "noise": "none"},
    "physical": {"simulator": "physical", "noise_scale": 0.0, "leak_rate_hz": 0.0},
    "esim": {"simulator": "esim"},
    "v2e": {"simulator": "v2e"},
}
RATES = (15, 30, 60, 120, 240, 480, 960)
SPEEDS = (5, 10, 20, 40, 80, 160, 320)
AMPLITUDES = (5, 10, 20, 40, 60, 80, 100)


@functools.cache
def events_per_pixel(model: str, fps: int, speed: float, amplitude: float) -> float:
    """Events per pixel in one second of the grating."""
    i = np.arange(round(SECONDS * fps) + 1)[:, None]
    phase = 2 * np.pi * (np.arange(WIDTH) - speed * i / fps) / PERIOD_PX
    row = np.round(128 + amplitude * np.sin(phase)).astype(np.uint8)
    frames = np.repeat(row[:, None], HEIGHT, axis=1)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TexventWarning)
        return len(texvent.simulate(frames, fps=fps, **MODELS[model])) / (WIDTH * HEIGHT)


def draw(axes: Axes, label: str, values: Any, count: Callable[..., float], colours: Any) -> None:
    """One line per model."""
    for model, colour, mark in zip(MODELS, colours, "osD^v", strict=True):
        axes.plot(
            values,
            [count(model, value) for value in values],
            color=colour,
            marker=mark,
            markersize=5,
            label=model,
        )
    axes.set_xscale("log")
    axes.set_xticks(values, [str(value) for value in values])
    axes.minorticks_off()
    axes.set_xlabel(label)
    axes.set_ylabel("events per pixel")
    axes.grid(axis="y")


def grating(colours: tuple[str, ...]) -> Figure:
    """Events by frame rate, by speed, by contrast."""
    figure, (by_rate, by_speed, by_contrast) = plt.subplots(3, 1, figsize=(5.8, 8.4))
    draw(
        by_rate, "frames per second", RATES,
        lambda model, rate: events_per_pixel(model, rate, SPEED, AMPLITUDE), colours,
    )  # fmt: skip
    draw(
        by_speed, "speed, px/s", SPEEDS,
        lambda model, speed: events_per_pixel(model, FPS, speed, AMPLITUDE), colours,
    )  # fmt: skip
    draw(
        by_contrast, "amplitude, levels of 255", AMPLITUDES,
        lambda model, amplitude: events_per_pixel(model, FPS, SPEED, amplitude), colours,
    )  # fmt: skip
    by_rate.set_ylim(bottom=-1)
    by_speed.set_yscale("symlog", linthresh=1)
    by_speed.set_ylim(bottom=-0.2)
    handles, labels = by_rate.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=3)
    return figure
