"""Rigs: several cameras on one body, with frames and an IMU, in the embedded scenes.

Such as:
    import texvent

    texvent.rig.record("a red car drives left, handheld", "car", stereo=0.12, imu=1000, frames=30)
    left, right = (texvent.load(f"car/cam{number}/events.h5") for number in (0, 1))
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from texvent_scenes.rig.recorder import record

__all__ = ["record"]


def __getattr__(name: str) -> Any:
    if name == "record":
        return importlib.import_module("texvent_scenes.rig.recorder").record
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
