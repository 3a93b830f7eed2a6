"""Scenes as plain values (tables, lists, text, numbers), as JSON and TOML hold them."""

from __future__ import annotations

import dataclasses
import math
import types
import typing
from collections.abc import Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from typing import Annotated, Any, get_args, get_origin

from texvent._registry import suggest
from texvent.errors import MAX_WORD, ConfigError, few, shown
from texvent.options.values import convert
from texvent.scenes.spec.limits import Vocabulary
from texvent.scenes.spec.scene import MAX_BODIES, MAX_LAMPS, Scene, object_ids

PLACING = frozenset(
    {"on", "in", "at", "above", "under", "behind", "front", "beside", "left of", "right of",
     "between"}
)  # fmt: skip
"""Relations that say where their subject stands: a circle of them places nothing."""

SPACED = ("left of", "right of", "front", "behind", "beside")
"""Relations with a distance."""
STEEPEST = 0.08
"""Least metres to the side per metre up or down between a camera and the point it looks at."""


def scene_to_data(scene: Scene) -> dict[str, Any]:
    """Plain values of a scene; fields at their defaults are left out."""
    data: dict[str, Any] = _plain(scene)
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
    scene: Scene = _build(Scene, data, "", words or {})
    _check_objects(scene)
    return scene


def checked_scene(scene: Scene, words: Vocabulary) -> Scene:
    """A scene that a program made, checked as one from a file; errors as `scene_from_data`."""
    return scene_from_data(scene_to_data(scene), words)


@cache
def field_types(owner: type) -> dict[str, Any]:
    """Field → its type with its limits, of a class of `spec.scene`."""
    return typing.get_type_hints(owner, include_extras=True)


def inner_type(hint: Any) -> Any:
    """The type of an optional field when it is given; any other type is its own."""
    if get_origin(hint) in (typing.Union, types.UnionType):
        return next(one for one in get_args(hint) if one is not types.NoneType)
    return hint


def plain_type(hint: Any) -> Any:
    """The type of a field when it is given, without its limits."""
    inner = inner_type(hint)
    return get_args(inner)[0] if get_origin(inner) is Annotated else inner


def required_fields(owner: type) -> list[str]:
    """Fields without a default."""
    return [
        one.name
        for one in dataclasses.fields(owner)
        if one.default is dataclasses.MISSING and one.default_factory is dataclasses.MISSING
    ]


def _plain(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        named = {one.name: _plain(getattr(value, one.name)) for one in dataclasses.fields(value)}
        usual = {one.name: _plain(_default(one)) for one in dataclasses.fields(value)}
        return {name: one for name, one in named.items() if one != usual[name]}
    if hasattr(value, "tolist"):  # NumPy's arrays and numbers
        value = value.tolist()
    return [_plain(one) for one in value] if isinstance(value, (list, tuple)) else value


def _default(field: dataclasses.Field[Any]) -> Any:
    if field.default_factory is not dataclasses.MISSING:
        return field.default_factory()
    return field.default


def _build(hint: Any, value: Any, where: str, words: Vocabulary) -> Any:
    """`value` as the type `hint`, whose path is `where`; see `scene_from_data`."""
    if value is None and inner_type(hint) is not hint:
        return None
    hint = inner_type(hint)
    if get_origin(hint) is Annotated:
        plain, *limits = get_args(hint)
        built = _build(plain, value, where, words)
        for limit in limits:
            limit.check(built, where, words)
        return built
    if get_origin(hint) is tuple:
        if not isinstance(value, (list, tuple)):
            raise ConfigError(f"{where} is {shown(value)}; it must be a list")
        items = get_args(hint)
        if items[-1] is Ellipsis:
            items = items[:1] * len(value)
        if len(items) != len(value):
            raise ConfigError(f"{where} is {shown(value)}; it must have {len(items)} numbers")
        return tuple(
            _build(item, one, f"{where}[{n}]", words)
            for n, (item, one) in enumerate(zip(items, value, strict=True))
        )
    if dataclasses.is_dataclass(hint):
        return _build_table(hint, value, where, words)
    return convert(value, hint, where)


def _build_table(owner: Any, value: Any, where: str, words: Vocabulary) -> Any:
    """An instance of a dataclass from the table of its fields."""
    kinds, table = field_types(owner), where or "scene"
    if not isinstance(value, Mapping):
        raise ConfigError(f"{table} is {shown(value)}; it must be a table of fields")
    for name in value:
        if name not in kinds:
            raise ConfigError(f"{table} has no field {shown(name)}; {suggest(name, tuple(kinds))}")
    for name in required_fields(owner):
        if name not in value:
            raise ConfigError(f"{table} has no {name}, which it must have")
    prefix = f"{where}." if where else ""
    return owner(
        **{name: _build(kinds[name], one, prefix + name, words) for name, one in value.items()}
    )


def _check_objects(scene: Scene) -> None:
    """Refuse too many bodies, ids that clash or are not there, and circles of relations."""
    bodies = sum(one.count for one in scene.objects)
    if bodies > MAX_BODIES:
        raise ConfigError(
            f"objects have {bodies:,} copies in all; a scene shows {MAX_BODIES} at most"
        )
    ids = object_ids(scene)
    for n, id in enumerate(ids):
        if id in ids[:n]:
            raise ConfigError(
                f"objects[{n}].id is {shown(id)}, which is that of objects[{ids.index(id)}]; give "
                "it another one"
            )
    for where, id in _references(scene):
        if id not in ids:
            known = suggest(id, tuple(one[:MAX_WORD] for one in ids)) if ids else "there are none"
            raise ConfigError(f"{where} is {shown(id)}, which is no object's id; {known}")
    for n, one in enumerate(scene.objects):
        for m, relation in enumerate(one.relations):
            if ids[n] in relation.to and one.count == 1:
                raise ConfigError(
                    f"objects[{n}].relations[{m}].to is {shown(ids[n])}, which is the object itself"
                )
    _check_circles(scene, ids)
    _check_metres(scene)
    _check_moves(scene)
    _check_models(scene)
    if len(scene.light.lamps) > MAX_LAMPS:
        raise ConfigError(
            f"light.lamps are {len(scene.light.lamps)}; a scene has {MAX_LAMPS} at most"
        )


def _check_models(scene: Scene) -> None:
    """Refuse two models of one noun."""
    first: dict[str, int] = {}
    for n, one in enumerate(scene.objects):
        other = scene.objects[first.setdefault(one.noun, n)]
        if one.model != other.model:
            raise ConfigError(
                f"objects[{n}].model is {shown(one.model)}, but objects[{first[one.noun]}] is "
                f"{shown(one.noun)} too and has {shown(other.model)}; give one of them another noun"
            )


def _references(scene: Scene) -> Iterator[tuple[str, str]]:
    """Path of every field that names an object, and the id that it names."""
    for n, one in enumerate(scene.objects):
        for m, relation in enumerate(one.relations):
            if not relation.to:
                raise ConfigError(f"objects[{n}].relations[{m}].to is empty; name an object's id")
            for k, id in enumerate(relation.to):
                yield f"objects[{n}].relations[{m}].to[{k}]", id
    for n, effect in enumerate(scene.effects):
        if effect.source is not None:
            yield f"effects[{n}].source", effect.source
    if scene.camera.target is not None:
        yield "camera.target", scene.camera.target


def _check_circles(scene: Scene, ids: tuple[str, ...]) -> None:
    """Refuse objects of which each stands with respect to the next, and the last to the first."""
    placed_by = {
        id: {to for relation in one.relations if relation.kind in PLACING for to in relation.to}
        - {id}
        for id, one in zip(ids, scene.objects, strict=True)
    }
    try:
        TopologicalSorter(placed_by).prepare()
    except CycleError as error:
        circle = [str(id) for id in error.args[1]]
        raise ConfigError(
            f"objects[{ids.index(circle[-1])}].relations go round in a circle "
            f"({few([*map(shown, reversed(circle))])}); leave one of them out"
        ) from None


_TIMED = ("pan", "tilt", "roll", "zoom", "dolly", "truck", "pedestal", "orbit", "crane",
          "dolly zoom")  # fmt: skip
"""Camera moves that start and stop; others last all of the clip."""


def _check_moves(scene: Scene) -> None:
    """Refuse times of camera moves that would have no effect."""
    for n, one in enumerate(scene.camera.moves):
        if not one.is_timed:
            continue
        if one.kind not in _TIMED:
            raise ConfigError(
                f"camera.moves[{n}] has a start or stop time, but {shown(one.kind)} lasts all of "
                f"the clip; {', '.join(_TIMED)} have times"
            )
        if one.stop_s is not None and one.stop_s <= (one.start_s or 0.0):
            raise ConfigError(
                f"camera.moves[{n}].stop_s is {one.stop_s:g}, not after its start at "
                f"{one.start_s or 0.0:g} s; give a later time"
            )


def _check_metres(scene: Scene) -> None:
    """Refuse distances and poses of the camera that would have no effect."""
    for n, one in enumerate(scene.objects):
        for m, relation in enumerate(one.relations):
            if relation.distance_m is not None and relation.kind not in SPACED:
                raise ConfigError(
                    f"objects[{n}].relations[{m}].distance_m is given, but "
                    f"{shown(relation.kind)} has no distance; {', '.join(SPACED)} have one"
                )
    position, goal = scene.camera.position_m, scene.camera.look_at_m
    if (position is None) != (goal is None):
        raise ConfigError("camera.position_m and camera.look_at_m are given together, or neither")
    if position is None or goal is None:
        return
    flat = math.dist(position[:2], goal[:2])
    if flat <= STEEPEST * abs(position[2] - goal[2]):
        raise ConfigError(
            f"camera.look_at_m is {shown(goal)}, straight above or below camera.position_m; move "
            "one of them aside"
        )
    if scene.camera.target is not None or any(one.kind == "travel" for one in scene.camera.moves):
        raise ConfigError(
            "camera.position_m is given with a target or with travel, which choose the position; "
            "leave one of them out"
        )
