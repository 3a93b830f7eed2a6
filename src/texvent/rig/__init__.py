"""Rigs: several cameras on one body, with frames and an IMU, in the embedded scenes.

Such as:
    from texvent import rig

    rig.record("a red car drives left, handheld", "car", stereo=0.12, imu=1000, frames=30)
    left, right = rig.load("car").cameras
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from texvent.rig.loading import load
    from texvent.rig.recorder import record

__all__ = ["load", "record"]
_HOMES = {"load": "loading", "record": "recorder"}


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(importlib.import_module(f"texvent.rig.{_HOMES[name]}"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
