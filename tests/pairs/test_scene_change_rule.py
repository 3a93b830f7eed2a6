"""Cuts and flashes as their rule says, cell by cell, for pairs near all of its limits."""

from collections import Counter
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.frames import Frame
from texvent.pairs.scene_change import SceneChange, detect_scene_change, shift_agreement

Image = NDArray[Any]
HEIGHT, WIDTH = 32, 48
"""Pixels; cells have 2 × 2."""


def matches(image: Image, other: Image) -> tuple[float, float, float]:
    """Residual, correlation and textured share of the blocks of 8 × 8 cells, each looked for within
    8 cells."""
    height, width = image.shape
    residuals, variances, correlations = [], [], []
    for top, left in np.ndindex(height // 8, width // 8):
        block = image[8 * top :, 8 * left :][:8, :8]
        block = block - block.mean()
        near = other[max(0, 8 * top - 8) : 8 * top + 16, max(0, 8 * left - 8) : 8 * left + 16]
        there = np.lib.stride_tricks.sliding_window_view(near, (8, 8)).reshape(-1, 8, 8)
        there = there - there.mean(axis=(1, 2), keepdims=True)
        scale = np.sqrt((block.var() + 1e-4) * (there.var(axis=(1, 2)) + 1e-4))
        residuals.append(((block - there) ** 2).mean(axis=(1, 2)).min())
        correlations.append(((block * there).mean(axis=(1, 2)) / scale).max())
        variances.append(block.var())
    has_texture = np.array(variances) > 0.03**2
    middle = np.median(np.array(correlations)[has_texture]) if has_texture.any() else 0.0
    return np.mean(residuals) / (np.mean(variances) + 1e-4), middle, has_texture.mean()


def defined(first: Image, second: Image) -> SceneChange:
    """The rule."""
    cells = [
        one.reshape(HEIGHT // 2, 2, WIDTH // 2, 2).mean(axis=(1, 3)) for one in (first, second)
    ]
    brightness = [balanced_log(one, 30.0) for one in cells]
    levels, log = cells[1] - cells[0], brightness[1] - brightness[0]
    middle, change = np.median(log), np.abs(levels).mean()
    is_cut = np.abs(log - middle).mean() >= 0.15 and change >= 12
    is_flash = abs(middle) >= 0.35 and abs(np.median(levels)) >= 32
    is_flash = is_flash and np.mean(np.sign(log) == np.sign(middle)) >= 0.75
    if not (is_cut or is_flash or change >= 32):
        return SceneChange.NONE
    ways = matches(*brightness), matches(*brightness[::-1])
    if min(one[2] for one in ways) < 0.1:
        if is_flash:
            return SceneChange.FLASH
        return SceneChange.CUT if change >= 32 else SceneChange.NONE
    is_lost = min(one[0] for one in ways) > 0.5 and max(one[1] for one in ways) < 0.8
    if is_lost and is_cut:
        return SceneChange.NONE if shift_agreement(*brightness) >= 0.6 else SceneChange.CUT
    return SceneChange.FLASH if is_flash and not is_lost else SceneChange.NONE


def texture(random: np.random.Generator, width: int = WIDTH) -> Image:
    """Smooth noise of any contrast around any level."""
    image = cv2.GaussianBlur(random.normal(size=(HEIGHT, width)), (0, 0), random.uniform(1, 4))
    contrast = random.choice([0.0, 5.0, 20.0, 60.0])
    return random.uniform(30, 160) + contrast * image / image.std()


def pair(random: np.random.Generator) -> tuple[Image, Image]:
    """An image, and one that is moved, brighter in a part, and mixed with another."""
    wide = texture(random, 2 * WIDTH)
    moved = int(random.choice([0, 0, 4, 20]))
    first, second = wide[:, :WIDTH], wide[:, moved : moved + WIDTH]
    share = random.choice([0.0, 0.0, 0.2, 0.5, 0.8, 1.0])
    second = (1 - share) * second + share * texture(random)
    lit = np.arange(HEIGHT)[:, None] < random.choice([0, 18, 22, 26, 32])
    gain, more = random.choice([0.5, 1.0, 1.4, 2.0]), random.choice([0.0, 25.0, 35.0, 80.0])
    second = np.where(lit, gain * second + more, second)
    return np.clip(first, 0, 255), np.clip(second, 0, 255)


def test_changes_are_those_of_the_rule() -> None:
    random = np.random.default_rng(3)
    found = Counter[SceneChange]()
    for _ in range(200):
        first, second = pair(random)
        change = detect_scene_change(Frame(first, 0), Frame(second, 40_000))
        assert change is defined(first, second)
        found[change] += 1
    assert min(found[one] for one in SceneChange) >= 25, found
