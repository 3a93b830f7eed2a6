"""Samples cut into windows, each of which becomes an array: stored and simulated ones alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from texvent.events import EventStream
from texvent.represent.named import load_representation, represent_window
from texvent.sensor import SensorSize


def check_representation(name: str, options: Mapping[str, Any], size: SensorSize | None) -> None:
    """Refuse a representation and options that no sample could have.

    Args:
        name: of the representation.
        options: of the representation.
        size: of the sensor; None if it is not known yet.

    Raises:
        ConfigError: an unknown name or option, or a value out of range.
    """
    load_representation(name, options)
    if size is not None:
        represent_window(name, EventStream.empty(size), (0, 1), **options)


def stack_windows(parts: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Arrays by name of several windows, along a first axis of time."""
    return {name: np.stack([part[name] for part in parts]) for name in parts[0]}
