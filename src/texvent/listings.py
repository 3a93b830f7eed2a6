"""Names of parts, formats and sensors for the Python API."""

from __future__ import annotations

from texvent._registry import (
    CODECS,
    GENERATORS,
    INTERPOLATORS,
    REPRESENTATIONS,
    SIMULATORS,
)
from texvent.sensor import SENSORS


def generators() -> tuple[str, ...]:
    """Names of text-to-video generators, for `generator=`; the first is the default."""
    return GENERATORS.names()


def interpolators() -> tuple[str, ...]:
    """Names of interpolators, for `interpolate=`."""
    return INTERPOLATORS.names()


def simulators() -> tuple[str, ...]:
    """Names of pixel models, for `simulator=`; the first is the default."""
    return SIMULATORS.names()


def presets(simulator: str = "texvent") -> tuple[str, ...]:
    """Names of a simulator's presets, for `preset=`; the first is the default.

    Raises:
        ConfigError: there is no such simulator.
    """
    return tuple(SIMULATORS.load(simulator).presets)


def sensors() -> tuple[str, ...]:
    """Names of sensors, for `sensor=`; `SENSORS` has their sizes."""
    return tuple(SENSORS)


def formats() -> tuple[str, ...]:
    """Names of event formats, for `format=`."""
    return CODECS.names()


def representations() -> tuple[str, ...]:
    """Names of dense arrays, for `EventStream.represent`."""
    return REPRESENTATIONS.names()
