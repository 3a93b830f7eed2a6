"""Fields of a scene by their paths, such as `objects[0].motions[0].speed_m_s`."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from typing import Any

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent.scenes.spec.data import field_types, scene_from_data, scene_to_data
from texvent.scenes.spec.scene import Scene

_PATH = re.compile(r"[a-z_]+(\[\d+\]|\.[a-z_]+)*")
_STEP = re.compile(r"\[(\d+)\]|([a-z_]+)")


def get_field(scene: Scene, path: str) -> Any:
    """The value of a field.

    Raises:
        ConfigError: there is no such field; the message has the nearest one.

    Example:
        >>> get_field(Scene(), "light.wave")
        'sine'
    """
    value: Any = scene
    done = ""
    for step in _steps(path):
        if isinstance(step, int):
            if not isinstance(value, (list, tuple)) or step >= len(value):
                count = len(value) if isinstance(value, (list, tuple)) else 0
                raise ConfigError(f"{path} is not there: {done} has {count} items")
            value, done = value[step], f"{done}[{step}]"
            continue
        owner: Any = type(value)
        names = tuple(field_types(owner)) if dataclasses.is_dataclass(value) else ()
        if step not in names:
            of = done or "scene"
            left = suggest(step, names) if names else f"{of} has no fields or is left out"
            raise ConfigError(f"{of} has no field {shown(step)}; {left}")
        value, done = getattr(value, step), f"{done}.{step}" if done else step
    return value


def with_fields(scene: Scene, values: Mapping[str, Any]) -> Scene:
    """The scene with other values of fields: path → value.

    Raises:
        ConfigError: there is no such field, or it cannot have that value.
    """
    data = scene_to_data(scene)
    for path, value in values.items():
        get_field(scene, path)
        *way, last = _steps(path)
        place: Any = data
        for step in way:
            # A table at its defaults is left out of the data.
            place = place[step] if isinstance(step, int) else place.setdefault(step, {})
        place[last] = value
    return scene_from_data(data)


def _steps(path: str) -> list[int | str]:
    if not _PATH.fullmatch(path):
        raise ConfigError(f"{shown(path)} is no path of a field, such as 'objects[0].colour'")
    return [int(number) if number else name for number, name in _STEP.findall(path)]
