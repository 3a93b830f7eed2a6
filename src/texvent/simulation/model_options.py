"""Contrast threshold of any pixel model, and options drawn at random per clip for training."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, Literal, NamedTuple, TypeAlias, TypeVar

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent.options.values import option_names
from texvent.simulation.random.draws import draw_normals, draw_uniforms, frame_key

Config = TypeVar("Config")


def contrast_threshold_of(config: Any) -> float:
    """Contrast threshold δ of a simulator's options, log units.

    Where ON and OFF have thresholds of their own it is their geometric mean; DVS-Voltmeter's is
    the relative change of one event, `1 / k1`.

    Raises:
        ConfigError: the simulator has no contrast threshold.
    """
    names = option_names(type(config))
    if "contrast_threshold" in names:
        return float(config.contrast_threshold)
    if "contrast_threshold_on" in names:
        return math.sqrt(float(config.contrast_threshold_on * config.contrast_threshold_off))
    if "constants" in names:
        return 1.0 / float(config.k.k1)
    raise _no_threshold(config)


def with_contrast_threshold(
    config: Config, threshold: float, *, on_off_ratio: float | None = None
) -> Config:
    """A copy of a simulator's options with another contrast threshold.

    Args:
        config: options.
        threshold: δ, log units; the geometric mean where ON and OFF differ.
        on_off_ratio: ON threshold divided by OFF threshold; default: as it is. Models with one
            threshold for both have no ratio, and ignore it.

    Raises:
        ConfigError: the simulator has no contrast threshold, or does not allow this one.
    """
    options: Any = config
    names = option_names(type(options))
    changes: dict[str, Any]
    if "contrast_threshold" in names:
        changes = {"contrast_threshold": threshold}
        if on_off_ratio is not None and "on_off_ratio" in names:
            changes["on_off_ratio"] = on_off_ratio
    elif "contrast_threshold_on" in names:
        ratio = on_off_ratio or options.contrast_threshold_on / options.contrast_threshold_off
        changes = {
            "contrast_threshold_on": threshold * math.sqrt(ratio),
            "contrast_threshold_off": threshold / math.sqrt(ratio),
        }
    elif "constants" in names:
        changes = {"constants": str(options.k._replace(k1=1.0 / threshold))}
    else:
        raise _no_threshold(config)
    changed: Config = dataclasses.replace(options, **changes)
    return changed


def _no_threshold(config: Any) -> ConfigError:
    model = type(config).__name__.removesuffix("Config").lower()
    return ConfigError(
        f"simulator {model!r} has no contrast threshold that could be changed; "
        "leave out target_rate and randomize, or use another simulator"
    )


Recipe: TypeAlias = Literal["stoffregen", "v2v"]

CLIP_FRAME = -2
"""Frame number in keys of draws that belong to the whole clip; the sensor's have −1."""


class Range(NamedTuple):
    """Range of a drawn option."""

    low: float
    high: float
    is_log: bool = False
    """Uniform in the logarithm instead of in the value."""

    def at(self, chance: float) -> float:
        """The value at a chance 0..1."""
        if self.is_log:
            return self.low * math.pow(self.high / self.low, chance)
        return self.low + chance * (self.high - self.low)


THRESHOLDS: Mapping[str, Range] = {
    "stoffregen": Range(0.1, 1.5),
    "v2v": Range(0.05, 2.0),
}
"""Contrast threshold by recipe, log units. Stoffregen's range is that of the authors' simulator
configurations, which the project ercanburak/HyperE2VID on GitHub carries: 0.100 to 1.500 in steps
of 0.005."""
RATIO_SIGMA = 0.1
"""Stoffregen et al.: ON is OFF times a normal number of mean 1 and this sd."""
RATIO_LIMIT = 1.5
"""V2V: one threshold is at most this many times the other."""
NOISE: Mapping[str, Range] = {
    "noise_scale": Range(0.1, 10.0, is_log=True),
    "shot_noise_rate_hz": Range(0.01, 10.0, is_log=True),
    "threshold_sigma": Range(0.0, 0.05),
    "leak_rate_hz": Range(0.001, 0.1, is_log=True),
    "hot_pixel_fraction": Range(1e-5, 1e-3, is_log=True),
}
"""Noise options and where they are drawn from, for the models that have them: our choice, one
decade to either side of a DAVIS346. Both papers add their noise to tensors instead of events."""


def draw_training_config(config: Config, recipe: Recipe, *, seed: int) -> Config:
    """A copy of a simulator's options with thresholds and noise drawn for one clip.

    The drawn values depend on the recipe and the seed only, and are in the returned options, so
    they are stored with every other option. Each option has a draw of its own: a model that lacks
    one draws the same for the others.

    Args:
        config: options of any simulator with a contrast threshold.
        recipe: "stoffregen" or "v2v": which thresholds.
        seed: of the clip, 0..2⁶³−1.

    Raises:
        ConfigError: an unknown recipe, or a simulator without a contrast threshold.

    Source: T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras", ECCV 2020;
        V2V's training ranges: threshold uniform over 0.05..2, ratio of the two up to 1.5.
    """
    if recipe not in THRESHOLDS:
        raise ConfigError(f"unknown recipe {shown(recipe)}; {suggest(recipe, tuple(THRESHOLDS))}")
    key = frame_key(seed, CLIP_FRAME)
    chances = draw_uniforms(key, 0, 0, range(2 + len(NOISE))).tolist()
    if recipe == "v2v":
        ratio = math.pow(RATIO_LIMIT, 2 * chances[1] - 1)
    else:
        ratio = 1.0 + RATIO_SIGMA * float(draw_normals(key, 0, 1, 0))
    drawn = with_contrast_threshold(config, THRESHOLDS[recipe].at(chances[0]), on_off_ratio=ratio)
    options: Any = drawn
    known = option_names(type(options))
    noise = {
        name: where.at(chance)
        for (name, where), chance in zip(NOISE.items(), chances[2:], strict=True)
        if name in known
    }
    varied: Config = dataclasses.replace(options, **noise)
    return varied
