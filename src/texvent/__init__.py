"""texvent: text prompts and videos to the stream of an event camera.

    import texvent

    events = texvent.generate("a red car drives left past two trees at dusk", seed=3)
    events.save("out.h5")
    events.show()

Importing texvent loads neither torch nor numba nor OpenCV; each loads when a part needs it.
The public names, and their modules, are the lines of `__init__.pyi`, which editors read too.
"""

from __future__ import annotations

import importlib
import re
from pathlib import Path
from typing import Any

_STUB = Path(__file__).with_suffix(".pyi").read_text(encoding="utf-8")
_HOME_OF = {name: home for home, name in re.findall(r"from (\S+) import (\w+) as", _STUB)}
__all__ = sorted(_HOME_OF)


def __getattr__(name: str) -> Any:
    """Load a public name on first use (PEP 562)."""
    if name not in _HOME_OF:
        raise AttributeError(f"module 'texvent' has no attribute {name!r}")
    if _HOME_OF[name] == __name__:
        return importlib.import_module(f"{__name__}.{name}")
    try:
        value = getattr(importlib.import_module(_HOME_OF[name]), name)
    except ModuleNotFoundError as error:
        from texvent._registry import absent_package, say_absent
        from texvent.errors import MissingDependencyError

        package = absent_package(_HOME_OF[name])
        if package is None:
            raise
        raise MissingDependencyError(f"texvent.{name}: {say_absent(package)}") from error
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
