"""The scene while its sentence is being read."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

from texvent.scenes.description import (
    STANDING,
    Effect,
    NamedColour,
    ObjectMotion,
    Picture,
    Relation,
    SceneObject,
)
from texvent.scenes.language.words.word import Word, link
from texvent.scenes.models.protocol import Noun

_ONE_EACH = ("hold", "carry", "wear", "ride", "ride along", "push", "pull")
MAX_OBJECTS = 12
"""Most different things of a prompt that are shown."""


@dataclass
class PartialObject:
    """An object that the reader is still reading about."""

    noun: str
    count: int = 1
    is_plural: bool = False
    is_counted: bool = True
    """Whether the prompt says how many there are."""
    said: str | None = None
    """The word for it, where that is a kind such as "goalkeeper"."""
    colour: NamedColour | None = None
    scale: float = 1.0
    pace: float = 1.0
    side: str | None = None
    material: str | None = None
    picture: Picture | None = None
    blink_hz: float | None = None
    is_lit: bool | None = None
    motions: list[ObjectMotion] = field(default_factory=list)
    sentence: int = 0
    """Number of the sentence that said its last motion."""
    owner: str | None = None
    """Pronoun of whose it is: "her basket"."""
    traffic: str | None = None
    """The word of which it is a part: "traffic", "traffic jam"."""
    is_verb_lost: bool = False
    """Whether the prompt says that it does something that is not shown."""

    def build(self, tempo: float) -> SceneObject:
        """The object as understood; `tempo` multiplies every pace (slow motion)."""
        motions = list(self.motions)
        if not motions and self.is_verb_lost:
            motions = [STANDING]
        motions = _topple(motions)
        if not motions and self.pace != 1.0:
            motions = [ObjectMotion("move")]
        factor = self.pace * tempo
        paced = [replace(one, pace=one.pace * factor) for one in motions]
        return SceneObject(
            self.noun, self.count, self.colour, self.scale, paced[0] if paced else None,
            self.side, tuple(paced[1:]), self.material, self.picture, self.blink_hz, self.is_lit,
        )  # fmt: skip


def _topple(motions: list[ObjectMotion]) -> list[ObjectMotion]:
    """What stands and then falls, falls over; what only falls comes down from above."""
    found = [replace(one, kind="fall") if one.kind == "topple" else one for one in motions]
    found = [_lift(one) for one in found]
    return [STANDING, *found] if motions and motions[0].kind == "topple" else found


def _lift(motion: ObjectMotion) -> ObjectMotion:
    """As in "an elevator goes up": what has no way of its own to go rises or sinks."""
    kind = {"up": "rise", "down": "sink"}.get(motion.direction or "")
    if motion.kind != "slide" or kind is None:
        return motion
    return replace(motion, kind=kind, direction=None)


class Draft:
    """Objects, relations and effects named so far."""

    def __init__(self, nouns: Mapping[str, Noun]) -> None:
        self.nouns = nouns
        self.objects: list[PartialObject] = []
        self.relations: list[Relation] = []
        self.effects: list[Effect] = []
        self.absent: list[str] = []
        self.notes: list[str] = []
        self.subjects: list[int] = []
        """What "it" and "they" mean."""
        self.tempo = 1.0

    def add(self, item: PartialObject) -> int | None:
        """A new object's index; None if there are too many."""
        if len(self.objects) >= MAX_OBJECTS:
            self.note(f"only the first {MAX_OBJECTS} things are shown")
            return None
        self.objects.append(item)
        return len(self.objects) - 1

    def find(self, noun: str, is_plural: bool | None, said: str | None = None) -> int | None:
        """The last object of that noun, singular or plural alike, and of that kind, if any.

        None as `is_plural` fits both: "the sheep".
        """
        for index in range(len(self.objects) - 1, -1, -1):
            item = self.objects[index]
            is_of_kind = said is None or item.said == said
            if item.noun == noun and is_plural in (None, item.count > 1) and is_of_kind:
                return index
        return None

    def split(self, index: int) -> list[int]:
        """Several things of one noun as two halves that move each in its own way.

        Returns:
            Both halves; the thing alone if it is only one or there is no room.
        """
        item = self.objects[index]
        if item.count < 2 or len(self.objects) >= MAX_OBJECTS:
            return [index]
        rest = item.count // 2
        item.count -= rest
        self.objects.append(replace(item, count=rest, motions=list(item.motions)))
        return [index, len(self.objects) - 1]

    def noun(self, index: int) -> Noun:
        """The model of an object."""
        return self.nouns[self.objects[index].noun]

    def length_m(self, index: int) -> float:
        """The largest extent of an object, m."""
        model = self.noun(index).build(colour=None, scale=self.objects[index].scale, seed=0)
        return float(max(model.length, model.width, model.height))

    def relate(
        self, kind: str, subjects: Iterable[int], targets: Sequence[int], way: str = ""
    ) -> bool:
        """Relate every subject to the targets; whether there was anything to relate.

        `way` is that of the `Relation`.
        """
        is_related = False
        for subject in subjects:
            kept = tuple(target for target in targets if target != subject)
            if kept:
                self._share_out(kind, subject, kept)
                relation = Relation(kind, subject, kept, way)
                if relation not in self.relations:
                    self.relations.append(relation)
                is_related = True
        return is_related

    def _share_out(self, kind: str, subject: int, targets: Sequence[int]) -> None:
        """As in "two people with umbrellas": one each."""
        count = self.objects[subject].count
        for target in targets:
            item = self.objects[target]
            if kind in _ONE_EACH and count > 1 and not item.is_counted:
                item.count = count

    def link_motion(self, words: Iterable[Word], things: Sequence[int]) -> None:
        """These words are about the last motion of these objects."""
        if things:
            link(words, things, max(len(self.objects[things[0]].motions) - 1, 0))

    def note(self, text: str) -> None:
        """Say something once."""
        if text not in self.notes:
            self.notes.append(text)

    def exclude(self, noun: str) -> None:
        """The prompt says that there is none of it."""
        if noun not in self.absent:
            self.absent.append(noun)
