"""Things and noun groups of a prompt while more may still be said about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from texvent.scenes.description import Motion, Paint, Thing
from texvent.scenes.language import lexicon
from texvent.scenes.language.tagging import Phrase, Role
from texvent.scenes.model import Noun

_GREY_LEVELS = {"light": "silver", "pale": "silver", "dark": "black"}


@dataclass
class Draft:
    """A thing while more may still be said about it."""

    noun: str
    count: int = 1
    paint: Paint | None = None
    scale: float = 1.0
    motion: Motion | None = None
    pace: float = 1.0
    side: str | None = None

    def finish(self) -> Thing:
        """The thing as understood."""
        motion = self.motion
        if motion is None and self.pace != 1.0:
            motion = Motion("move")
        if motion is not None and self.pace != 1.0:
            motion = Motion(
                motion.kind, motion.direction, motion.pace * self.pace, motion.speed_m_s
            )
        return Thing(self.noun, self.count, self.paint, self.scale, motion, self.side)


_TRAVELS = ("walk", "run", "drive", "fly", "swim", "sail")


def list_able(
    subjects: Sequence[Draft], motion: Motion, nouns: Mapping[str, Noun]
) -> Sequence[Draft]:
    """Those of several subjects that can do it: of "a crane, workers walking", the workers."""
    if motion.kind not in _TRAVELS:
        return subjects
    able = [draft for draft in subjects if nouns[draft.noun].habitat != "fixed"]
    return able or subjects


@dataclass
class NounGroup:
    """Adjectives waiting for their noun."""

    is_definite: bool = False
    count: int | None = None
    number: float | None = None
    paint: Paint | None = None
    shade: str | None = None
    scale: float | None = None
    motion: Motion | None = None
    pace: float = 1.0
    side: str | None = None
    phrases: list[Phrase] = field(default_factory=list)

    def mark_roles(self, *roles: Role) -> None:
        """Its words of these roles had an effect."""
        for phrase in self.phrases:
            if phrase.role in roles:
                phrase.is_used = True

    def mark_used(self) -> None:
        """All its words had an effect."""
        for phrase in self.phrases:
            phrase.is_used = True

    def take_number(self) -> tuple[float, Phrase] | None:
        """Remove the number, which is no count, and return it with its phrase."""
        for phrase in reversed(self.phrases):
            if phrase.role is Role.NUMBER:
                self.phrases.remove(phrase)
                self.number = None
                return float(phrase.meaning.value), phrase
        return None

    def decide_count(self, *, is_plural: bool, is_all_around: bool) -> int:
        """How many: as said, at most `MAX_COUNT`, or what a bare singular or plural means."""
        if self.number is not None:
            return round(min(self.number, lexicon.MAX_COUNT))
        if self.count is not None:
            return self.count
        if not is_plural:
            return 1
        return lexicon.SURROUND_COUNT if is_all_around else lexicon.PLURAL_COUNT

    def decide_paint(self) -> Paint | None:
        """The colour, or the grey that "dark" and "light" alone mean.

        A shade that means nothing alone ("vivid") leaves the group's words, to be reported.
        """
        if self.paint is not None or self.shade is None:
            return self.paint
        level = _GREY_LEVELS.get(self.shade)
        if level is None:
            self.phrases = [phrase for phrase in self.phrases if phrase.role is not Role.SHADE]
            return None
        return Paint(self.shade, lexicon.COLOURS[level])
