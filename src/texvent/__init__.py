"""texvent: text prompts and videos to the stream of an event camera.

    import texvent

    events = texvent.generate("a red car drives left past two trees at dusk", seed=3)
    events.save("out.h5")
    events.show()

Importing texvent loads neither torch nor numba nor OpenCV; each loads when a part needs it.
"""

from __future__ import annotations

import importlib
import sys
from types import ModuleType
from typing import TYPE_CHECKING, Any

from texvent._version import __version__

if TYPE_CHECKING:
    from texvent import dataset, pixel_models, rig
    from texvent.api import compare, generate, load, open, simulate, video
    from texvent.errors import (
        ConfigError,
        FileFormatError,
        InputError,
        MissingDependencyError,
        OutputError,
        TexventError,
        TexventWarning,
    )
    from texvent.event_camera import EventCamera
    from texvent.event_packets import EventPackets
    from texvent.events import EventStream
    from texvent.generate.scene_input import read
    from texvent.listings import (
        formats,
        generators,
        interpolators,
        presets,
        representations,
        sensors,
        simulators,
    )
    from texvent.run.truth import TruthFolder
    from texvent.sensor import SENSORS, Sensor, SensorSize
    from texvent.simulate.build import check_simulator
    from texvent.truth.clip import load_truth
    from texvent.truth.recorder import save_truth
    from texvent.video import Frame, FrameStream, Video

_HOMES = {
    "api": ("compare", "generate", "load", "open", "simulate", "video"),
    "errors": (
        "ConfigError",
        "FileFormatError",
        "InputError",
        "MissingDependencyError",
        "OutputError",
        "TexventError",
        "TexventWarning",
    ),
    "event_camera": ("EventCamera",),
    "event_packets": ("EventPackets",),
    "events": ("EventStream",),
    "generate.scene_input": ("read",),
    "listings": (
        "formats",
        "generators",
        "interpolators",
        "presets",
        "representations",
        "sensors",
        "simulators",
    ),
    "run.truth": ("TruthFolder",),
    "simulate.build": ("check_simulator",),
    "truth.clip": ("load_truth",),
    "truth.recorder": ("save_truth",),
    "sensor": ("SENSORS", "Sensor", "SensorSize"),
    "video": ("Frame", "FrameStream", "Video"),
}
_HOME_OF = {name: module for module, names in _HOMES.items() for name in names}

__all__ = [
    "SENSORS",
    "ConfigError",
    "EventCamera",
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
    "TexventWarning",
    "TruthFolder",
    "Video",
    "__version__",
    "check_simulator",
    "compare",
    "dataset",
    "formats",
    "generate",
    "generators",
    "interpolators",
    "load",
    "load_truth",
    "open",
    "pixel_models",
    "presets",
    "read",
    "representations",
    "rig",
    "save_truth",
    "sensors",
    "simulate",
    "simulators",
    "video",
]


class _Package(ModuleType):
    """This package: where a module inside it has the name of a function, the function stays.

    Python makes every imported module an attribute of its package: `import texvent.simulate.esim`
    would put the package `simulate` in the place of the function.
    """

    def __setattr__(self, name: str, value: Any) -> None:
        if not (isinstance(value, ModuleType) and name in _HOME_OF):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _Package


def __getattr__(name: str) -> Any:
    """Load a public name on first use (PEP 562)."""
    if name in ("dataset", "pixel_models", "rig"):
        return importlib.import_module(f"texvent.{name}")
    if name not in _HOME_OF:
        raise AttributeError(f"module 'texvent' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"texvent.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
