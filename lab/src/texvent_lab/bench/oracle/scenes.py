"""Scenes whose brightness is known at every instant: textures, discs, and prompts."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.errors import ConfigError, shown
from texvent.extending import suggest
from texvent.frames import MICROSECONDS
from texvent.sensor import SensorSize
from texvent_scenes.procedural import ProceduralConfig, ProceduralGenerator

EXPOSURE = 0.9
GAMMA = 2.2
WHITE = 255.0


def camera_level(radiance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Radiance as the camera records it: exposed, clipped, gamma-coded, 0..255, not rounded."""
    return np.asarray(WHITE * np.clip(EXPOSURE * radiance, 0.0, 1.0) ** (1 / GAMMA))


def radiance_of(level: NDArray[np.float32]) -> NDArray[np.float64]:
    """Radiance that the camera records as these levels, 0..255: the inverse of `camera_level`."""
    return np.asarray((level.astype(np.float64) / WHITE) ** GAMMA / EXPOSURE)


TABLE = 64
"""Lattice points per side; the texture repeats after them."""
OCTAVES = ((16.0, 0.55), (5.0, 0.30), (2.3, 0.15))
"""Lattice spacing, px, and weight."""

Float64Array = NDArray[np.float64]


class ValueNoise:
    """Random lattices, interpolated with smoothstep, in three octaves."""

    def __init__(self, seed: int) -> None:
        """Draw the lattices.

        Args:
            seed: which texture.
        """
        self._lattices = [
            np.random.default_rng([seed, octave]).random((TABLE, TABLE))
            for octave in range(len(OCTAVES))
        ]

    def sample(self, x: Float64Array, y: Float64Array) -> Float64Array:
        """The texture on a grid of columns and rows.

        Args:
            x: position of each column, px, [W]; any numbers.
            y: position of each row, px, [H].

        Returns:
            [H, W], 0..1, mean near 0.5.
        """
        total = np.zeros((len(y), len(x)))
        for lattice, (spacing, weight) in zip(self._lattices, OCTAVES, strict=True):
            # Bilinear in smoothstep weights: one sparse matrix per axis, so two products.
            total += weight * (_weights(y / spacing) @ lattice @ _weights(x / spacing).T)
        return total


def _weights(position: Float64Array) -> Float64Array:
    """Share of each lattice line at each position, [n, TABLE]."""
    cell = np.floor(position)
    rest = position - cell
    upper = rest * rest * (3 - 2 * rest)
    first = cell.astype(np.int64) % TABLE
    weights = np.zeros((len(position), TABLE))
    row = np.arange(len(position))
    weights[row, first] = 1 - upper
    weights[row, (first + 1) % TABLE] = upper
    return weights


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
    """Position of an object that runs to and fro between two ends."""
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
    """Radiance of a prompt's scene at any instant.

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
