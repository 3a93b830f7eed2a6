"""One number for every pixel model's contrast threshold, whatever its options are called."""

from __future__ import annotations

import dataclasses
import math
from typing import Any, TypeVar

from texvent.errors import ConfigError
from texvent.options.fields import option_names

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
    if "k1" in names:
        return 1.0 / float(config.k1)
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
    elif "k1" in names:
        changes = {"k1": 1.0 / threshold}
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
