"""Objects and noun phrases of a prompt, while the parser is still reading about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

from texvent.scenes.description import NamedColour, ObjectMotion, SceneObject
from texvent.scenes.language import vocabulary_objects
from texvent.scenes.language.lexicon import Role
from texvent.scenes.language.tagging import Phrase, mark_used
from texvent.scenes.models.protocol import Noun

_GREY_LEVELS = {"light": "silver", "pale": "silver", "dark": "black"}


@dataclass
class PartialObject:
    """An object that the parser is still reading about."""

    noun: str
    count: int = 1
    colour: NamedColour | None = None
    scale: float = 1.0
    motion: ObjectMotion | None = None
    pace: float = 1.0
    side: str | None = None

    def move(self, motion: ObjectMotion, noun: Noun) -> None:
        """Give it a motion, in its noun's own way; an unsaid direction stays what it was."""
        if (kind := motion.kind) == "move":
            kind = noun.motion if noun.motion != "stand" else "slide"
        old, direction = self.motion, motion.direction
        if direction is None and old is not None and old.is_moving:
            direction = old.direction
        self.motion = ObjectMotion(kind, direction, motion.pace)

    def build(self) -> SceneObject:
        """The object as understood."""
        motion = self.motion
        if motion is None and self.pace != 1.0:
            motion = ObjectMotion("move")
        if motion is not None and self.pace != 1.0:
            motion = replace(motion, pace=motion.pace * self.pace)
        return SceneObject(self.noun, self.count, self.colour, self.scale, motion, self.side)


_TRAVEL_KINDS = ("walk", "run", "drive", "fly", "swim", "sail")


def list_capable(
    subjects: Sequence[PartialObject], motion: ObjectMotion, nouns: Mapping[str, Noun]
) -> Sequence[PartialObject]:
    """The subjects that are capable of a motion: of "a crane, workers walking", the workers."""
    if motion.kind not in _TRAVEL_KINDS:
        return subjects
    capable = [partial for partial in subjects if nouns[partial.noun].habitat != "fixed"]
    return capable or subjects


@dataclass
class NounPhrase:
    """Adjectives waiting for their noun."""

    is_definite: bool = False
    count: int | None = None
    number: float | None = None
    colour: NamedColour | None = None
    shade: str | None = None
    scale: float | None = None
    motion: ObjectMotion | None = None
    pace: float = 1.0
    side: str | None = None
    phrases: list[Phrase] = field(default_factory=list)

    def mark_roles(self, *roles: Role) -> None:
        """Its words of these roles had an effect."""
        mark_used(phrase for phrase in self.phrases if phrase.role in roles)

    def mark_used(self) -> None:
        """All its words had an effect."""
        mark_used(self.phrases)

    def take_number(self) -> tuple[float, Phrase] | None:
        """Remove the number, which is no count, and return it with its phrase."""
        for phrase in reversed(self.phrases):
            if phrase.role is Role.NUMBER:
                self.phrases.remove(phrase)
                self.number = None
                return float(phrase.meaning.value), phrase
        return None

    def decide_count(self, *, is_plural: bool, is_all_around: bool) -> int:
        """How many: as stated, at most `MAX_COUNT`, or what a bare singular or plural means."""
        if self.number is not None:
            return round(min(self.number, vocabulary_objects.MAX_COUNT))
        if self.count is not None:
            return self.count
        if not is_plural:
            return 1
        return (
            vocabulary_objects.SURROUND_COUNT if is_all_around else vocabulary_objects.PLURAL_COUNT
        )

    def decide_colour(self) -> NamedColour | None:
        """The colour, or the grey that "dark" and "light" alone mean.

        A shade that means nothing alone ("vivid") leaves the group's words, to be reported.
        """
        if self.colour is not None or self.shade is None:
            return self.colour
        level = _GREY_LEVELS.get(self.shade)
        if level is None:
            self.phrases = [phrase for phrase in self.phrases if phrase.role is not Role.SHADE]
            return None
        return NamedColour(self.shade, vocabulary_objects.COLOURS[level])
