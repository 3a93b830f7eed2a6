"""texvent: text prompts and videos to the stream of an event camera.

    import texvent

    events = texvent.generate("a red car drives left past two trees at dusk", seed=3)
    events.save("out.h5")
    events.show()

Importing texvent loads neither torch nor numba nor OpenCV; each loads when a part needs it.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

# Two stage packages share their name with an API function. Importing the (empty) packages here,
# before the functions exist, keeps Python from replacing `texvent.generate` by the package when
# something imports a module inside it later.
import texvent.generate
import texvent.simulate  # noqa: F401
from texvent._version import __version__

del generate, simulate  # noqa: F821

if TYPE_CHECKING:
    from texvent.api import generate, load, simulate
    from texvent.errors import (
        ConfigError,
        FileFormatError,
        InputError,
        MissingDependencyError,
        OutputError,
        TexventError,
    )
    from texvent.event_packets import EventPackets
    from texvent.events import EventStream
    from texvent.sensor import SENSORS, Sensor, SensorSize
    from texvent.video import Frame, FrameStream, Video

_HOMES = {
    "api": ("generate", "load", "simulate"),
    "errors": (
        "ConfigError",
        "FileFormatError",
        "InputError",
        "MissingDependencyError",
        "OutputError",
        "TexventError",
    ),
    "event_packets": ("EventPackets",),
    "events": ("EventStream",),
    "sensor": ("SENSORS", "Sensor", "SensorSize"),
    "video": ("Frame", "FrameStream", "Video"),
}
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "SENSORS",
    "ConfigError",
    "EventPackets",
    "EventStream",
    "FileFormatError",
    "Frame",
    "FrameStream",
    "InputError",
    "MissingDependencyError",
    "OutputError",
    "Sensor",
    "SensorSize",
    "TexventError",
    "Video",
    "__version__",
    "generate",
    "load",
    "simulate",
]


def __getattr__(name: str) -> Any:
    """Load a public name on first use (PEP 562)."""
    if name not in _HOME_OF:
        raise AttributeError(f"module 'texvent' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"texvent.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
