"""Scenes as staging takes them, and in words: nouns, colours and ids checked, relations by index.

All else are the values of `spec.scene`; fields without a text mean the same there.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from typing import Any

from texvent.scenes.inflection import list_finite_forms, pluralise
from texvent.scenes.report import PromptReport
from texvent.scenes.spec.scene import Effect, Motion, Scene, SceneObject, object_ids

SPIN_RATE_HZ = 0.5
"""Usual turns per second of what spins."""
STANDING = Motion("stand")


@dataclass(frozen=True)
class Relation:
    """A position or an action of an object with respect to others."""

    kind: str
    subject: int
    """Index of an object."""
    targets: tuple[int, ...]
    """Indices of objects; the subject itself is its target if its copies collide."""
    distance_m: float | None = None


@dataclass(frozen=True)
class SceneDescription(Scene):
    """A scene whose objects have ids of their own, which their nouns may no longer tell."""

    relations: tuple[Relation, ...] = ()
    words: PromptReport = field(default_factory=PromptReport)
    """What became of the words of a prompt that was read."""
    notes: tuple[str, ...] = ()
    """What was decided where the scene leaves it open, as sentences."""

    def index(self, id: str | None) -> int | None:
        """Index of the object of an id."""
        return None if id is None else object_ids(self).index(id)


def to_description(scene: Scene) -> SceneDescription:
    """The description of a scene that `scene_from_data` accepts; what is open stays open."""
    ids = object_ids(scene)
    objects = tuple(replace(one, id=id) for one, id in zip(scene.objects, ids, strict=True))
    relations = tuple(
        Relation(one.kind, number, tuple(map(ids.index, one.to)), one.distance_m)
        for number, subject in enumerate(objects)
        for one in subject.relations
    )
    return SceneDescription(**{**vars(scene), "objects": objects}, relations=relations)


_UNITS = {"_m_s": "m/s", "_hz": "Hz", "_m": "m", "_s": "s", "_deg": "degrees"}
"""End of a field's name → its unit."""
_SIDES = {"left": "on the left", "right": "on the right", "centre": "in the middle",
          "far": "far away", "lane": "on the road", "near": "in the foreground"}  # fmt: skip
RELATIONS = {"front": "in front of", "collide": "meets"}
"""Kind of relation → its words, where they differ."""
_VERBS = {"throw": "fly through the air", "work": "move in place", "stand": "stand still"}


def report_of(description: SceneDescription) -> PromptReport:
    """What becomes of a scene and of the words of its prompt, before it is staged.

    Example:
        >>> car = SceneObject("car", motions=(Motion("drive", "left", speed_m_s=5.0),))
        >>> report_of(SceneDescription(objects=(car,))).lines()
        ['1 car, drives left, speed 5 m/s', 'place: open', 'light: day', 'camera: static']
    """
    camera, place, light = description.camera, description.place, description.light
    moves = [_join(f"{move.kind} {move.direction or ''}".strip(), *_fields(move, "kind",
             "direction", "phase")) for move in camera.moves]  # fmt: skip
    lines = [
        *(_line_of(description, index) for index in range(len(description.objects))),
        *(_effect(description, one) for one in description.effects),
        f"place: {_join(place.name or 'open', *_fields(place, 'name'))}",
        f"light: {_join(light.kind or 'day', *_fields(light, 'kind', 'lamps'))}",
        f"camera: {_join(*(moves or ['static']), *_fields(camera, 'moves', 'target'))}",
    ]
    if description.absent:
        lines.append(f"left out as asked: {', '.join(description.absent)}")
    return replace(description.words, scene=tuple(lines), notes=description.notes)


def _line_of(description: SceneDescription, index: int) -> str:
    thing = description.objects[index]
    relations = [one for one in description.relations if one.subject == index]
    words = [_count(thing), thing.colour or ""]
    for n, motion in enumerate(thing.motions):
        words += [f"{'then ' if n else ''}{_verb(motion, thing.count)}"]
        words += _fields(motion, "kind", "direction")
    words.append(_SIDES.get(thing.placement or "", ""))
    for one in relations:
        others = " and ".join(_count(description.objects[target]) for target in one.targets)
        others = "each other" if one.targets == (index,) else others
        words.append(f"{RELATIONS.get(one.kind, one.kind)} {others}")
    return _join(*words, *_fields(thing, "noun", "model", "id", "count", "colour", "placement",
                                  "motions", "relations"))  # fmt: skip


def _effect(description: SceneDescription, effect: Effect) -> str:
    index = description.index(effect.source)
    source = "" if index is None else f"from {description.objects[index].noun}"
    return _join(effect.kind, source, *_fields(effect, "kind", "source"))


def _count(thing: SceneObject) -> str:
    return f"{thing.count} {thing.noun if thing.count == 1 else pluralise(thing.noun)}"


def _verb(motion: Motion, count: int) -> str:
    """As "runs towards"; activities of two words are quoted."""
    verb, _, rest = _VERBS.get(motion.kind, motion.kind).partition(" ")
    if rest and motion.kind not in _VERBS:
        verb, rest = "do", f"'{motion.kind}'"
    verb = verb if count > 1 else list_finite_forms(verb)[1]
    return " ".join(filter(None, (verb, rest, motion.direction)))


def _fields(value: Any, *skipped: str) -> list[str]:
    """Fields of a dataclass that are not at their defaults: "flicker 50 Hz", "low", "sky red"."""
    found = []
    for one in fields(value):
        now = getattr(value, one.name)
        if one.name in skipped or now in (None, (), one.default):
            continue
        end = next((end for end in _UNITS if one.name.endswith(end)), "")
        name = one.name.removesuffix(end).removeprefix("is_").removeprefix("has_")
        name = "scale" if name == "size" else name
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
