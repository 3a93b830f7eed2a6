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
    """Names of text-to-video generators, for `generator=`; the first is the default.

    Example:
        >>> import texvent
        >>> texvent.generators()[0]
        'procedural'
    """
    return GENERATORS.names()


def interpolators() -> tuple[str, ...]:
    """Names of interpolators, for `interpolate=`.

    Example:
        >>> import texvent
        >>> texvent.interpolators()
        ('none', 'blend', 'flow', 'exact', 'motion', 'rife', 'super-slomo')
    """
    return INTERPOLATORS.names()


def simulators() -> tuple[str, ...]:
    """Names of pixel models, for `simulator=`; the first is the default.

    Example:
        >>> import texvent
        >>> texvent.simulators()
        ('texvent', 'physical', 'esim', 'v2e', 'voltmeter', 'senpi', 'v2ce')
    """
    return SIMULATORS.names()


def presets(simulator: str = "texvent") -> tuple[str, ...]:
    """Names of a simulator's presets, for `preset=`; the first is the default.

    Raises:
        ConfigError: there is no such simulator.

    Example:
        >>> import texvent
        >>> texvent.presets("v2e")
        ('default', 'noisy', 'peer-common')
    """
    return tuple(SIMULATORS.load(simulator).presets)


def sensors() -> tuple[str, ...]:
    """Names of sensors, for `sensor=`; `SENSORS` has their sizes.

    Example:
        >>> import texvent
        >>> texvent.sensors()[:3]
        ('dvs128', 'davis240c', 'davis346')
    """
    return tuple(SENSORS)


def formats() -> tuple[str, ...]:
    """Names of event formats, for `format=`.

    Example:
        >>> import texvent
        >>> "hdf5" in texvent.formats(), "evt3" in texvent.formats()
        (True, True)
    """
    return CODECS.names()


def representations() -> tuple[str, ...]:
    """Names of dense arrays, for `EventStream.represent`.

    Example:
        >>> import texvent
        >>> "voxel-e2vid" in texvent.representations()
        True
    """
    return REPRESENTATIONS.names()
