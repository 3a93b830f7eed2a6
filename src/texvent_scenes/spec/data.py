"""Scenes as plain values, as JSON and TOML hold them: built, checked, read and set by path."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from graphlib import CycleError, TopologicalSorter
from typing import Any

from texvent._registry import suggest
from texvent.errors import MAX_WORD, ConfigError, InputError, few, shown
from texvent_scenes.spec.limits import Vocabulary
from texvent_scenes.spec.scene import (
    MAX_BODIES,
    MAX_LAMPS,
    Camera,
    Scene,
    SceneObject,
    object_ids,
)
from texvent_scenes.spec.tables import build_table, field_types, plain_values

PLACING = frozenset(
    {"on", "in", "at", "above", "under", "behind", "front", "beside", "left of", "right of",
     "between"}
)  # fmt: skip
"""Relations that say where their subject stands: a circle of them places nothing."""

WAYS = frozenset({"to", "into", "out of", "off", "up", "down"})
"""Relations whose subject goes a way that its target decides."""

ACTED = frozenset(
    {
        "push",
        "kick",
        "throw",
        "roll",
        "lift",
        "set down",
        "drop",
        "collide",
        "knock over",
        "catch",
        "hit",
        "pull",
        "move over",
        "rally",
    }
)
"""Relations in which the subject moves its target."""

HANDLED = frozenset(("lift", "move over", "set down", "drop", "throw", "roll", "catch"))
"""Acts whose target is where the hands of the subject have it, or comes from there."""
SENT = ("kick", "throw", "roll", "hit")
"""Those after which the target goes on by itself."""

SPACED = ("left of", "right of", "front", "behind", "beside")
"""Relations that say where something is beside another thing."""
DISTANCED = (*SPACED, "follow")
"""Relations with a distance."""
LEAST_LOOK_M = 1e-3
"""Least way from a camera to the point it looks at, m."""


def scene_to_data(scene: Scene) -> dict[str, Any]:
    """Plain values of a scene; fields at their defaults are left out."""
    data: dict[str, Any] = plain_values(scene)
    return data


def scene_from_data(data: Any, words: Vocabulary | None = None) -> Scene:
    """A scene from plain values, checked.

    Args:
        data: a table of tables and lists, as `scene_to_data` gives.
        words: the words that a generator shows; None: words are not checked.

    Raises:
        ConfigError: a field is unknown, missing, of a wrong type or out of range; a word or a
            colour is unknown; or relations name objects that are not there, or go round in a
            circle. The message begins with the path of the field.
    """
    scene: Scene = build_table(Scene, data, "", words or {})
    for fault in _faults(scene):
        raise ConfigError(fault)
    return scene


def checked_scene(scene: Scene, words: Vocabulary | None = None) -> Scene:
    """A scene that a program made, checked as one from a file; errors as `scene_from_data`."""
    return of_file(scene_from_data(scene_to_data(scene), words), scene.file_name)


def of_file(scene: Scene, name: str) -> Scene:
    """The same scene, whose errors begin with the name of a file; a changed one has none."""
    scene = replace(scene)
    object.__setattr__(scene, "file_name", name)
    return scene


@contextmanager
def naming_file(subject: object) -> Iterator[None]:
    """Errors of a scene that was read from a file begin with the file's name."""
    try:
        yield
    except InputError as error:
        name = getattr(subject, "file_name", "")
        if not name:
            raise
        raise type(error)(f"{name}: {error}") from None


def _faults(scene: Scene) -> Iterator[str]:
    """Errors of the scene as a whole, as lines: what no field alone can show."""
    bodies, ids = sum(one.count for one in scene.objects), object_ids(scene)
    if bodies > MAX_BODIES:
        yield f"objects have {bodies:,} copies in all; a scene shows {MAX_BODIES} at most"
    for n, id in enumerate(ids):
        if id in ids[:n]:
            yield (f"objects[{n}].id is {shown(id)}, which is that of objects[{ids.index(id)}]; "
                   "give it another one")  # fmt: skip
    for where, id in _references(scene):
        if id not in ids:
            known = suggest(id, tuple(one[:MAX_WORD] for one in ids)) if ids else "there are none"
            yield f"{where} is {shown(id)}, which is no object's id; {known}"
    first: dict[str, int] = {}
    for n, one in enumerate(scene.objects):
        yield from _relation_faults(f"objects[{n}]", ids[n], one)
        other = first.setdefault(one.noun, n)
        if one.model != (of := scene.objects[other].model):
            yield (f"objects[{n}].model is {shown(one.model)}, but objects[{other}] is "
                   f"{shown(one.noun)} too and has {shown(of)}; give one of them another noun"
                   )  # fmt: skip
    yield from _circles(scene, ids)
    yield from _camera_faults(scene.camera)
    if scene.place.is_wet is False and scene.place.weather == "rain":
        yield "place.is_wet is false, but rain wets the ground; leave one of them out"
    if (lamps := len(scene.light.lamps)) > MAX_LAMPS:
        yield f"light.lamps are {lamps}; a scene has {MAX_LAMPS} at most"


def _references(scene: Scene) -> Iterator[tuple[str, str]]:
    """Path of every field that names an object, and the id that it names."""
    for n, one in enumerate(scene.objects):
        for m, relation in enumerate(one.relations):
            yield from ((f"objects[{n}].relations[{m}].to[{k}]", id)
                        for k, id in enumerate(relation.to))  # fmt: skip
    for n, effect in enumerate(scene.effects):
        if effect.source is not None:
            yield f"effects[{n}].source", effect.source
    if scene.camera.target is not None:
        yield "camera.target", scene.camera.target


def _relation_faults(where: str, id: str, one: SceneObject) -> Iterator[str]:
    for m, relation in enumerate(one.relations):
        if not relation.to:
            yield f"{where}.relations[{m}].to is empty; name an object's id"
        if id in relation.to and one.count == 1:
            yield f"{where}.relations[{m}].to is {shown(id)}, which is the object itself"
        if relation.distance_m is not None and relation.kind not in DISTANCED:
            yield (f"{where}.relations[{m}].distance_m is given, but {shown(relation.kind)} has no "
                   f"distance; {', '.join(DISTANCED)} have one")  # fmt: skip
        if relation.distance_m is not None and relation.kind == "follow" and one.position_m:
            yield (f"{where}.relations[{m}].distance_m is given beside position_m, which says how "
                   "far behind it begins; leave one of them out")  # fmt: skip


def _circles(scene: Scene, ids: tuple[str, ...]) -> Iterator[str]:
    """Objects of which each stands with respect to the next, and the last to the first."""
    placed_by = {
        id: {to for relation in one.relations if relation.kind in PLACING for to in relation.to}
        - {id}
        for id, one in zip(ids, scene.objects, strict=True)
    }
    try:
        TopologicalSorter(placed_by).prepare()
    except CycleError as error:
        circle = [str(id) for id in error.args[1]]
        yield (f"objects[{ids.index(circle[-1])}].relations go round in a circle "
               f"({few([*map(shown, reversed(circle))])}); leave one of them out")  # fmt: skip


def _camera_faults(camera: Camera) -> Iterator[str]:
    """Poses of the camera that have no meaning."""
    position, goal = camera.position_m, camera.look_at_m
    if (position is None) != (goal is None):
        yield "camera.position_m and camera.look_at_m are given together, or neither"
    elif position is not None and goal is not None:
        if math.dist(position, goal) < LEAST_LOOK_M:
            yield (f"camera.look_at_m is {shown(goal)}, the place of camera.position_m itself; "
                   "give a point in front of it")  # fmt: skip
        if camera.target is not None or any(one.kind == "travel" for one in camera.moves):
            yield ("camera.position_m is given with a target or with travel, which choose the "
                   "position; leave one of them out")  # fmt: skip


_PATH = re.compile(r"[a-z_]+(\[\d+\]|\.[a-z_]+)*")
_STEP = re.compile(r"\[(\d+)\]|([a-z_]+)")


def get_field(scene: Scene, path: str) -> Any:
    """The value of a field by its path, such as `objects[0].motions[0].speed_m_s`.

    Raises:
        ConfigError: there is no such field; the message has the nearest one.

    Example:
        >>> get_field(Scene(), "light.wave")
        'sine'
    """
    value: Any = scene
    done = ""
    for step in steps_of(path):
        if isinstance(step, int):
            count = len(value) if isinstance(value, tuple) else 0
            if step >= count:
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
        *way, last = steps_of(path)
        place: Any = data
        for step in way:
            # A table at its defaults is left out of the data.
            place = place[step] if isinstance(step, int) else place.setdefault(step, {})
        place[last] = value
    return scene_from_data(data)


def steps_of(path: str) -> list[int | str]:
    """Names and numbers on the way to a field."""
    if not _PATH.fullmatch(path):
        raise ConfigError(f"{shown(path)} is no path of a field, such as 'objects[0].colour'")
    return [int(number) if number else name for number, name in _STEP.findall(path)]
