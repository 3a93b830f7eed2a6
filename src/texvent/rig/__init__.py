"""Rigs: several cameras on one body, with frames and an IMU, in the embedded scenes.

from texvent import rig

rig.record("a red car drives left, handheld", "car", stereo=0.12, imu=1000, frames=30)
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from texvent.rig.recorder import record

__all__ = ["record"]


def __getattr__(name: str) -> Any:
    if name in __all__:
        return getattr(importlib.import_module("texvent.rig.recorder"), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
