"""Options whose values are drawn for every video: uniform, log-uniform, whole numbers, choices."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from texvent._registry import suggest
from texvent.batch.identity import derived_seed
from texvent.errors import ConfigError, shown

RANGES = ("uniform", "log_uniform", "integer", "choice")
_UNITS = 2.0**63


def is_range(value: Any) -> bool:
    """True if an option's value is a table, and so to be drawn."""
    return isinstance(value, Mapping)


def range_values(option: str, value: Mapping[str, Any]) -> tuple[str, Sequence[Any]]:
    """Kind and values of a range.

    Raises:
        ConfigError: no such kind, or its values do not fit.
    """
    if len(value) != 1 or next(iter(value)) not in RANGES:
        kind = next(iter(value), "")
        raise ConfigError(f"range of {option}: {shown(dict(value))}; {suggest(kind, RANGES)}")
    kind, values = next(iter(value.items()))
    if not isinstance(values, list | tuple) or not values:
        raise ConfigError(f"range of {option}: {kind} is {shown(values)}; it must be a list")
    if kind == "choice":
        return kind, values
    is_number = [type(one) in (int, float) and math.isfinite(one) for one in values]
    if len(values) != 2 or not all(is_number) or values[0] > values[1]:
        raise ConfigError(
            f"range of {option}: {kind} is {shown(list(values))}; it must be [lowest, highest]"
        )
    if kind == "log_uniform" and values[0] <= 0:
        raise ConfigError(f"range of {option}: log_uniform begins at {values[0]}; give more than 0")
    if kind == "integer" and not all(float(one).is_integer() for one in values):
        raise ConfigError(f"range of {option}: integer is {shown(list(values))}; whole numbers")
    return kind, values


def draw_options(options: Mapping[str, Any], *key: object) -> dict[str, Any]:
    """The options with each range replaced by a value that depends on the key and its name alone.

    Example:
        >>> draw_options({"fps": 24, "duration": {"choice": [1.0]}}, 7, "clip")
        {'fps': 24, 'duration': 1.0}
    """
    return {
        name: _drawn(name, value, derived_seed("option", name, *key) / _UNITS)
        if is_range(value)
        else value
        for name, value in options.items()
    }


def _drawn(option: str, value: Mapping[str, Any], u: float) -> Any:
    """The value at a share 0 ≤ u < 1 of a range."""
    kind, values = range_values(option, value)
    if kind == "choice":
        return values[min(int(u * len(values)), len(values) - 1)]
    low, high = values
    if kind == "integer":
        return min(int(low) + int(u * (int(high) - int(low) + 1)), int(high))
    if kind == "log_uniform":
        return math.exp(math.log(low) + u * (math.log(high) - math.log(low)))
    return low + u * (high - low)


def extreme_options(options: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Options without ranges that together hold every end and every choice of each range."""
    ends: dict[str, Sequence[Any]] = {
        name: range_values(name, value)[1] for name, value in options.items() if is_range(value)
    }
    first = {name: ends[name][0] if name in ends else value for name, value in options.items()}
    others = [{**first, name: end} for name, values in ends.items() for end in values[1:]]
    return [first, *others]
