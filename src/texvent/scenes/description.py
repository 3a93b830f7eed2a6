"""Scenes as staging takes them, and in words: nouns, colours and ids checked, relations by index.

Motions, pictures, camera moves, lamps, light and place are the values of `spec.scene`; fields
without a text mean the same there.
"""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from typing import Any

from texvent.scenes.inflection import list_finite_forms, pluralise
from texvent.scenes.report import PromptReport
from texvent.scenes.spec import scene as spec
from texvent.scenes.spec.scene import CameraMove as CameraMove
from texvent.scenes.spec.scene import Lamp as SceneLamp
from texvent.scenes.spec.scene import Light as Illumination
from texvent.scenes.spec.scene import Motion as ObjectMotion
from texvent.scenes.spec.scene import Picture as Picture
from texvent.scenes.spec.scene import Place as Surroundings

__all__ = [
    "RELATIONS", "SPIN_RATE_HZ", "STANDING", "CameraMove", "Effect",
    "Illumination", "ObjectMotion", "Picture", "Relation", "SceneDescription", "SceneLamp",
    "SceneObject", "Shot", "Surroundings", "report_of", "to_description",
]  # fmt: skip

SPIN_RATE_HZ = 0.5
"""Usual turns per second of what spins."""
STANDING = ObjectMotion("stand")


@dataclass(frozen=True)
class SceneObject:
    """A body of the scene, or several copies of it."""

    noun: str
    count: int = 1
    colour: str | None = None
    scale: float = 1.0
    """Its `size`."""
    motion: ObjectMotion | None = None
    """The first of its `motions`; None: not stated."""
    side: str | None = None
    """Its `placement`."""
    then: tuple[ObjectMotion, ...] = ()
    """Its motions after the first, in order."""
    material: str | None = None
    picture: Picture | None = None
    blink_hz: float | None = None
    is_lit: bool | None = None
    position_m: tuple[float, float] | None = None
    height_m: float | None = None
    heading_deg: float | None = None


@dataclass(frozen=True)
class Effect:
    """A particle effect."""

    kind: str
    source: int | None = None
    """Index of the object that it comes from."""
    start_s: float | None = None


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
class Shot:
    """The camera: its moves, viewpoint and framing."""

    moves: tuple[CameraMove, ...] = ()
    view: str | None = None
    framing: str | None = None
    target: int | None = None
    """Index of the object that it looks at or follows."""
    position_m: tuple[float, float, float] | None = None
    look_at_m: tuple[float, float, float] | None = None
    field_of_view_deg: float | None = None

    @property
    def is_moving(self) -> bool:
        """Whether the camera moves."""
        return any(move.kind != "static" for move in self.moves)


@dataclass(frozen=True)
class SceneDescription:
    """A scene whose relations, effects and camera name objects by index."""

    prompt: str
    objects: tuple[SceneObject, ...] = ()
    relations: tuple[Relation, ...] = ()
    effects: tuple[Effect, ...] = ()
    shot: Shot = field(default_factory=Shot)
    light: Illumination = field(default_factory=Illumination)
    surroundings: Surroundings = field(default_factory=Surroundings)
    is_timelapse: bool = False
    is_grey: bool = False
    absent: tuple[str, ...] = ()
    words: PromptReport = field(default_factory=PromptReport)
    """What became of the words of a prompt that was read."""
    notes: tuple[str, ...] = ()
    """What was decided where the scene leaves it open, as sentences."""


def to_description(scene: spec.Scene) -> SceneDescription:
    """The description of a scene that `scene_from_data` accepts; what is open stays open."""
    ids = spec.object_ids(scene)
    camera = scene.camera
    return SceneDescription(
        scene.prompt,
        objects=tuple(map(_object, scene.objects)),
        relations=tuple(
            Relation(one.kind, number, tuple(map(ids.index, one.to)), one.distance_m)
            for number, subject in enumerate(scene.objects)
            for one in subject.relations
        ),
        effects=tuple(
            Effect(one.kind, _index(one.source, ids), one.start_s)
            for one in scene.effects
        ),
        shot=Shot(
            camera.moves, camera.view, camera.framing, _index(camera.target, ids),
            camera.position_m, camera.look_at_m, camera.field_of_view_deg,
        ),
        light=scene.light,
        surroundings=scene.place,
        is_timelapse=scene.is_timelapse,
        is_grey=camera.is_grey,
        absent=scene.absent,
    )  # fmt: skip


def _object(one: spec.SceneObject) -> SceneObject:
    motion, *then = one.motions or (None,)
    return SceneObject(
        one.noun, one.count, one.colour, one.size, motion, one.placement, tuple(filter(None, then)),
        one.material, one.picture, one.blink_hz, one.is_lit, one.position_m, one.height_m,
        one.heading_deg,
    )  # fmt: skip


def _index(id: str | None, ids: tuple[str, ...]) -> int | None:
    return None if id is None else ids.index(id)


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
        >>> car = SceneObject("car", motion=ObjectMotion("drive", "left", speed_m_s=5.0))
        >>> report_of(SceneDescription("", objects=(car,))).lines()
        ['1 car, drives left, speed 5 m/s', 'place: open', 'light: day', 'camera: static']
    """
    shot, place, light = description.shot, description.surroundings, description.light
    moves = [_join(f"{move.kind} {move.direction or ''}".strip(), *_fields(move, "kind",
             "direction", "phase")) for move in shot.moves]  # fmt: skip
    lines = [
        *(_line_of(description, index) for index in range(len(description.objects))),
        *(_effect(description, one) for one in description.effects),
        f"place: {_join(place.name or 'open', *_fields(place, 'name'))}",
        f"light: {_join(light.kind or 'day', *_fields(light, 'kind', 'lamps'))}",
        f"camera: {_join(*(moves or ['static']), *_fields(shot, 'moves', 'target'))}",
    ]
    if description.absent:
        lines.append(f"left out as asked: {', '.join(description.absent)}")
    return replace(description.words, scene=tuple(lines), notes=description.notes)


def _line_of(description: SceneDescription, index: int) -> str:
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
    for one in fields(value):
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
