"""Scenes as staging takes them, and in lines: nouns, colours and ids checked, relations by index.

All else are the values of `spec.scene`; fields without a text mean the same there.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace

from texvent.prompt_report import PromptReport
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.data import scene_to_data
from texvent_scenes.spec.files import inline_text
from texvent_scenes.spec.scene import Direction, Motion, Scene, SceneObject, object_ids

SPIN_RATE_HZ = 0.5
"""Usual turns per second of what spins."""
STANDING = Motion("stand")
WAYS_DEG: Mapping[Direction | None, float] = {
    "right": 0.0, "away": 90.0, "left": 180.0, "towards": 270.0,
}  # fmt: skip
"""Direction of goods on a belt → its heading."""


@dataclass(frozen=True)
class IndexedRelation:
    """A position or an action of an object with respect to others."""

    kind: str
    subject: int
    """Index of an object."""
    targets: tuple[int, ...]
    """Indices of objects; the subject itself is its target if its copies collide."""
    distance_m: float | None = None
    start_s: float | None = None
    """Stated time at which an act begins, s."""
    direction: str | None = None
    """Stated way of who kicks, throws or runs into something."""
    is_caught: bool = False
    """Whether the target of what is sent catches it."""


SEEN = "seen"
"""Kind of claim that holds of what is in view: acts, ways and relations of what is not are lost."""


@dataclass(frozen=True)
class Claim:
    """A word that is shown only if a check of the staged scene holds."""

    word: str
    """As the report has it, such as "row of"."""
    kind: str
    """Check that decides: a key of `checks.words.CHECKS`, such as "colour" or "relation"."""
    value: str | float = ""
    """As "black" of colours, "behind" of relations, 3 of repetitions."""
    subject: int | None = None
    """Index of the object of which it is said; None: the camera."""
    targets: tuple[int, ...] = ()
    """Indices of the other objects of a relation."""

    @property
    def is_open(self) -> bool:
        """Whether a word that is not shown otherwise is shown if the claim holds."""
        return self.kind != SEEN


@dataclass(frozen=True)
class Dependence:
    """Words of a prompt whose meaning is known only if all of some others are understood."""

    words: tuple[str, ...]
    """The words that depend, such as "runs" and "past" of a clause."""
    on: tuple[str, ...]
    """The others: their clause, or what leads to a thing, such as "steep"."""
    is_staged: bool = False
    """Whether they depend too on words that are understood and that the staged scene lacks."""


@dataclass(frozen=True)
class SceneDescription(Scene):
    """A scene whose objects have ids of their own, which their nouns may no longer tell."""

    relations: tuple[IndexedRelation, ...] = ()
    words: PromptReport = field(default_factory=PromptReport)
    """Report of the words of a prompt that was read."""
    claims: tuple[Claim, ...] = ()
    """Words that the report of the staged scene takes in."""
    dependences: tuple[Dependence, ...] = ()
    """Words that are uncertain where others are not understood."""
    notes: tuple[str, ...] = ()
    """Decisions where the scene leaves a choice open, as sentences."""

    @property
    def is_sentence(self) -> bool:
        """Whether a sentence was read; a file may have a `prompt` too."""
        return self.words != PromptReport()

    def index(self, id: str | None) -> int | None:
        """Index of the object of an id."""
        return None if id is None else object_ids(self).index(id)

    def replaced(self, new: Mapping[int, SceneObject]) -> SceneDescription:
        """The description with some objects replaced, by their indices."""
        objects = tuple(new.get(n, one) for n, one in enumerate(self.objects))
        return replace(self, objects=objects)


def label_of(description: SceneDescription, index: int) -> str:
    """Name of an object in lines: its noun, or its id in a file that has several of the noun.

    Example:
        >>> from texvent_scenes.spec.scene import SceneObject
        >>> three = (SceneObject("car", id="taxi"), SceneObject("car"), SceneObject("tree"))
        >>> [label_of(SceneDescription(objects=three), n) for n in range(3)]
        ['car "taxi"', 'car "car 2"', 'tree']
    """
    noun = description.objects[index].noun
    several = [one.noun for one in description.objects].count(noun) > 1
    if not several or description.is_sentence:
        return noun
    return f'{noun} "{object_ids(description)[index]}"'


def to_description(scene: Scene) -> SceneDescription:
    """The description of a scene that `scene_from_data` accepts; what is open stays open."""
    ids = object_ids(scene)
    objects = tuple(replace(one, id=id) for one, id in zip(scene.objects, ids, strict=True))
    relations = tuple(
        IndexedRelation(one.kind, number, tuple(map(ids.index, one.to)), one.distance_m)
        for number, subject in enumerate(objects)
        for one in subject.relations
    )
    values = {one.name: getattr(scene, one.name) for one in fields(scene)}
    return SceneDescription(**{**values, "objects": objects}, relations=relations)


def _name_sides(one: SceneObject) -> tuple[Motion, ...]:
    """Motions of an object, those of a belt with the side to which its goods go, not its sense."""
    first = next((each.direction for each in one.motions if each.kind == "work"), None)
    base_deg = one.heading_deg if one.heading_deg is not None else WAYS_DEG.get(first)
    is_belt = trait_value("belt speed", one.noun) is not None
    if not is_belt or one.noun in nouns_with("flat pattern") or base_deg is None:
        return one.motions
    return tuple(
        replace(each, direction=_side_of(base_deg + 180.0 * (each.direction == "clockwise")))
        if each.kind == "work" and each.direction in (None, "clockwise", "counter-clockwise")
        else each
        for each in one.motions
    )


def _side_of(heading_deg: float) -> Direction | None:
    """The direction nearest to a heading."""
    return max(WAYS_DEG, key=lambda way: math.cos(math.radians(WAYS_DEG[way] - heading_deg)))


def said(motion: Motion) -> Motion:
    """A motion as a file has it: without the pace that its rate or its belt's speed makes."""
    is_made = motion.kind == "spin" and motion.rate_hz is not None
    is_made |= motion.kind == "work" and (motion.rate_hz, motion.speed_m_s) != (None, None)
    return replace(motion, pace=Motion.pace) if is_made else motion


def report_of(description: SceneDescription) -> PromptReport:
    """Report of a scene and of the words of its prompt, before it is staged.

    Its lines are those of a scene file, an object each; `Scene.prompt` is left out.

    Example:
        >>> from texvent_scenes.spec.scene import SceneObject
        >>> car = SceneObject("car", motions=(Motion("drive", "left"),))
        >>> report_of(SceneDescription(objects=(car,))).lines()
        ['objects: noun = "car", motions = [{ kind = "drive", direction = "left" }]']
    """
    objects = tuple(
        replace(one, id="" if one.id == one.noun else one.id,
                motions=tuple(map(said, _name_sides(one))))
        for one in description.objects
    )  # fmt: skip
    values = {one.name: getattr(description, one.name) for one in fields(Scene)}
    data = scene_to_data(Scene(**{**values, "objects": objects, "prompt": ""}))
    parts = [(name, part if isinstance(part, list) else [part]) for name, part in data.items()]
    lines = (f"{name}: {inline_text(one)[2:-2] if isinstance(one, dict) else one}"
             for name, part in parts for one in part)  # fmt: skip
    return replace(description.words, scene=tuple(lines), notes=description.notes)
