"""Scenes of the oracle: linear radiance at any instant, from a name and a seed."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.sensor import SensorSize
from texvent_lab.bench.oracle.prompt_scenes import PROMPTS, build_prompt_scene
from texvent_lab.bench.oracle.smooth_texture import ValueNoise

Float64Array = NDArray[np.float64]
Scene: TypeAlias = Callable[[float], Float64Array]
"""Time, s → radiance, [H, W]; 1 is about white for the camera, 0 is dark."""

DARK, RANGE = 0.06, 12.0
"""Radiance of the darkest texture, and how many times brighter the brightest is."""
CONTRAST = 1.5
"""Stretch of the value noise, whose octaves average each other out."""


def build_scene(name: str, seed: int, size: SensorSize) -> Scene:
    """The scene called `name`.

    Args:
        name: one of `scene_names()`.
        seed: which texture, or which scene of a prompt.
        size: width and height, px.

    Raises:
        ConfigError: no scene has that name.
    """
    check_scene(name)
    if name in PROMPTS:
        return build_prompt_scene(PROMPTS[name], seed, size)
    return partial(SCENES[name], ValueNoise(seed), size)


def scene_names() -> tuple[str, ...]:
    """All scenes: those drawn here, and prompts of the embedded generator."""
    return (*SCENES, *PROMPTS)


def check_scene(name: str) -> None:
    """Refuse a scene that does not exist.

    Raises:
        ConfigError: no scene has that name.
    """
    if name not in scene_names():
        raise ConfigError(f"unknown scene {shown(name)}; {suggest(name, scene_names())}")


def known_flow(name: str) -> tuple[float, float] | None:
    """Velocity (vx, vy) of everything in a scene, px/s, where the whole scene moves as one."""
    return FLOWS.get(name)


def panning_texture(
    noise: ValueNoise, size: SensorSize, seconds: float, velocity: tuple[float, float]
) -> Float64Array:
    """A texture of `DARK` to `DARK · RANGE` that moves at a constant velocity, px/s."""
    return _shifted(noise, size, velocity[0] * seconds, velocity[1] * seconds).copy()


@lru_cache(maxsize=1)
def _shifted(noise: ValueNoise, size: SensorSize, right: float, down: float) -> Float64Array:
    """The texture shifted, px; at rest it is drawn once."""
    x = np.arange(size.width, dtype=np.float64) - right
    y = np.arange(size.height, dtype=np.float64) - down
    level = np.clip(0.5 + CONTRAST * (noise.sample(x, y) - 0.5), 0.0, 1.0)
    return np.asarray(DARK * RANGE**level)


def _pan(
    noise: ValueNoise, size: SensorSize, seconds: float, *, velocity: tuple[float, float]
) -> Float64Array:
    return panning_texture(noise, size, seconds, velocity)


def _flicker(noise: ValueNoise, size: SensorSize, seconds: float) -> Float64Array:
    """A texture at rest under a lamp on 50 Hz mains: its light beats at 100 Hz."""
    lamp = 1 + 0.2 * math.sin(2 * math.pi * 100 * seconds)
    return panning_texture(noise, size, 0.0, (0.0, 0.0)) * lamp


def _hdr(noise: ValueNoise, size: SensorSize, seconds: float) -> Float64Array:
    """A texture that moves from deep shade (1/50) into full sun (8): the camera clips both."""
    light = np.geomspace(0.02, 8.0, size.width, dtype=np.float64)
    return np.asarray(panning_texture(noise, size, seconds, (90.0, 15.0)) * light)


def _mixed(noise: ValueNoise, size: SensorSize, seconds: float) -> Float64Array:
    """Panning texture from dark to over-range; fast disc, slow faint disc, bar, 37 Hz lamp."""
    width, height = size
    image = panning_texture(noise, size, seconds, (60.0, 10.0))
    image *= np.linspace(0.15, 1.8, width)
    y, x = np.ogrid[:height, :width]
    faint = _disc(x, y, 0.35 * width + 12 * seconds, 0.75 * height, 0.13 * height)
    image *= 1 + 0.25 * faint
    there = _bounce(400 * seconds, 0.1 * width, 0.9 * width)
    _paint(image, _disc(x, y, there, 0.25 * height, 0.08 * height), 0.9)
    bar = _bar(x - 0.68 * width, y - 0.6 * height, 4 * math.pi * seconds, 0.18 * height, 2.5)
    _paint(image, bar, 0.05)
    lamp = slice(height // 2, height // 2 + 8), slice(4, 12)
    image[lamp] = 0.5 + 0.4 * math.sin(2 * math.pi * 37 * seconds)
    return image


def _disc(
    x: NDArray[np.int64], y: NDArray[np.int64], centre_x: float, centre_y: float, radius: float
) -> Float64Array:
    """Coverage 0..1 of a disc, its edge one pixel soft."""
    distance = np.hypot(x - centre_x, y - centre_y)
    return np.asarray(np.clip(radius - distance + 0.5, 0.0, 1.0))


def _bar(
    x: Float64Array, y: Float64Array, angle: float, half_length: float, half_width: float
) -> Float64Array:
    """Coverage 0..1 of a bar turned about the origin."""
    along = np.abs(x * math.cos(angle) + y * math.sin(angle))
    across = np.abs(y * math.cos(angle) - x * math.sin(angle))
    inside = np.clip(half_length - along + 0.5, 0.0, 1.0)
    return inside * np.clip(half_width - across + 0.5, 0.0, 1.0)


def _paint(image: Float64Array, coverage: Float64Array, radiance: float) -> None:
    image += coverage * (radiance - image)


def _bounce(distance: float, low: float, high: float) -> float:
    """Where something is that runs to and fro between two ends."""
    phase = distance % (2 * (high - low))
    return low + min(phase, 2 * (high - low) - phase)


FLOWS: Mapping[str, tuple[float, float]] = {
    "slow": (6.0, 0.0),
    "fast": (700.0, 0.0),
    "translate": (120.0, 35.0),
    "static": (0.0, 0.0),
}
"""Scenes that move as one, px/s."""
SCENES: Mapping[str, Callable[[ValueNoise, SensorSize, float], Float64Array]] = {
    "mixed": _mixed,
    **{name: partial(_pan, velocity=velocity) for name, velocity in FLOWS.items()},
    "flicker": _flicker,
    "hdr": _hdr,
}
"""Name → what it shows."""
