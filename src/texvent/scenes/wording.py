"""A scene in words, line by line, for a person to check."""

from __future__ import annotations

import dataclasses
from typing import Any

from texvent.scenes.description import Effect, ObjectMotion, SceneDescription, SceneObject
from texvent.scenes.inflection import list_finite_forms, pluralise
from texvent.scenes.report import PromptReport

_UNITS = {"_m_s": "m/s", "_hz": "Hz", "_m": "m", "_s": "s", "_deg": "degrees"}
"""End of a field's name → its unit."""
_SIDES = {"left": "on the left", "right": "on the right", "centre": "in the middle",
          "far": "far away", "lane": "on the road", "near": "in the foreground",
          "row": "in a row", "together": "side by side", "ring": "in a circle"}  # fmt: skip
RELATIONS = {"front": "in front of", "surround": "surrounded by", "collide": "meets"}
"""Kind of relation → its words, where they differ."""
_VERBS = {"throw": "fly through the air", "work": "move in place", "stand": "stand still"}


def report_of(description: SceneDescription) -> PromptReport:
    """What becomes of a scene and of the words of its prompt, before it is staged.

    Example:
        >>> car = SceneObject("car", motion=ObjectMotion("drive", "left", speed_m_s=5.0))
        >>> report_of(SceneDescription("", objects=(car,))).lines()
        ['1 car, drives left, speed 5 m/s', 'place: open', 'light: day', 'camera: static']
    """
    shot, place, light = description.shot, description.surroundings, description.light
    moves = [_join(f"{move.kind} {move.direction or ''}".strip(), *_fields(move, "kind",
             "direction", "phase")) for move in shot.moves]  # fmt: skip
    lines = [
        *(_object(description, index) for index in range(len(description.objects))),
        *(_effect(description, one) for one in description.effects),
        f"place: {_join(place.name or 'open', *_fields(place, 'name'))}",
        f"light: {_join(light.kind or 'day', *_fields(light, 'kind', 'lamps'))}",
        f"camera: {_join(*(moves or ['static']), *_fields(shot, 'moves', 'target'))}",
    ]
    if description.absent:
        lines.append(f"left out as asked: {', '.join(description.absent)}")
    return dataclasses.replace(description.words, scene=tuple(lines), notes=description.notes)


def _object(description: SceneDescription, index: int) -> str:
    thing = description.objects[index]
    motions = [one for one in (thing.motion, *thing.then) if one is not None]
    relations = [one for one in description.relations if one.subject == index]
    words = [_count(thing), thing.colour or ""]
    for n, motion in enumerate(motions):
        words += [f"{'then ' if n else ''}{_verb(motion, thing.count)}"]
        words += _fields(motion, "kind", "direction")
    words.append(_SIDES.get(thing.side or "", ""))
    for one in relations:
        others = " and ".join(_count(description.objects[target]) for target in one.targets)
        others = "each other" if one.targets == (index,) else others
        words.append(f"{RELATIONS.get(one.kind, one.kind)} {others}")
    return _join(*words, *_fields(thing, "noun", "count", "colour", "motion", "then", "side"))


def _effect(description: SceneDescription, effect: Effect) -> str:
    source = "" if effect.source is None else f"from {description.objects[effect.source].noun}"
    return _join(effect.kind, source, *_fields(effect, "kind", "source"))


def _count(thing: SceneObject) -> str:
    return f"{thing.count} {thing.noun if thing.count == 1 else pluralise(thing.noun)}"


def _verb(motion: ObjectMotion, count: int) -> str:
    """As "runs towards"; activities of two words are quoted."""
    verb, _, rest = _VERBS.get(motion.kind, motion.kind).partition(" ")
    if rest and motion.kind not in _VERBS:
        verb, rest = "do", f"'{motion.kind}'"
    verb = verb if count > 1 else list_finite_forms(verb)[1]
    return " ".join(filter(None, (verb, rest, motion.direction)))


def _fields(value: Any, *skipped: str) -> list[str]:
    """Fields of a dataclass that are not at their defaults: "flicker 50 Hz", "low", "sky red"."""
    found = []
    for one in dataclasses.fields(value):
        now = getattr(value, one.name)
        if one.name in skipped or now in (None, (), one.default):
            continue
        end = next((end for end in _UNITS if one.name.endswith(end)), "")
        name = one.name.removesuffix(end).removeprefix("is_").removeprefix("has_")
        if isinstance(now, bool):
            words = ["" if now else "no", name]
        else:
            each = now if isinstance(now, tuple) else (now,)
            numbers = (f"{one:g}" if isinstance(one, float) else str(one) for one in each)
            words = [name, " ".join(numbers), _UNITS.get(end, "")]
        found.append(" ".join(filter(None, words)).replace("_", " "))
    return found


def _join(*words: str) -> str:
    return ", ".join(filter(None, words))
