"""Whether a run fits into memory, estimated before it starts."""

from __future__ import annotations

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.errors import InputError
from texvent.run.settings import Settings
from texvent.runtime.memory import allow_memory, allowed_bytes
from texvent.sensor import SensorSize

UNMEASURED = 200
"""Bytes per pixel of a part that does not say what it takes."""


def estimate_bytes(settings: Settings, size: SensorSize) -> int:
    """Memory that the frames, the interpolator and the pixels of a run take, bytes.

    Simulators and interpolators state `bytes_per_pixel`, measured on moving texture; the frames
    that wait are among the simulator's. Memory does not grow with the length of a clip.
    """
    parts = (
        SIMULATORS.load(settings.run.simulator),
        INTERPOLATORS.load(settings.interpolate.interpolate),
    )
    per_pixel = sum(getattr(part, "bytes_per_pixel", UNMEASURED) for part in parts)
    return size.width * size.height * per_pixel


def check_memory(settings: Settings, size: SensorSize) -> None:
    """Refuse a run that does not fit into the memory allowed, before any of it is taken.

    Raises:
        InputError: it does not fit.
        ConfigError: the option `memory` is no size.
    """
    allow_memory(settings.run.memory)
    needed, allowed = estimate_bytes(settings, size), allowed_bytes()
    if needed > allowed:
        raise InputError(
            f"frames of {size} pixels need about {needed / 1e9:.3g} GB of memory with "
            f"{settings.run.simulator} and interpolator {settings.interpolate.interpolate}; "
            f"{allowed / 1e9:.3g} GB are allowed: choose a smaller --sensor, or allow more with "
            "--memory"
        )
