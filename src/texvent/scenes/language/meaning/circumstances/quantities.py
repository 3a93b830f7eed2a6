"""Speeds, rates and times that a prompt states: "at 50 km/h", "at 2 Hz", "after two seconds"."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.meaning.acts.devices import set_rate
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.meaning.surroundings_reader import SurroundingsReader
from texvent.scenes.language.words.word import mark_used

MAX_RATE_HZ = 100_000.0
"""Faster ones are reported: no pixel follows them, and paths of a billion turns fill the memory."""


class QuantityReader:
    """Applies quantities to the motions of a clause."""

    def __init__(self, draft: Draft, surroundings: SurroundingsReader) -> None:
        self._draft = draft
        self._surroundings = surroundings

    def read(self, one: Referent, scope: Scope, preposition: str = "at") -> bool:
        """Apply a speed, a rate or a time; return whether it had an effect."""
        if not isinstance(one.value, tuple):
            return False
        quantity, factor = one.value
        attributes = one.attributes
        number = attributes.number if attributes.number is not None else attributes.count
        if number is None:
            return False
        value = float(number) * factor
        is_used = False
        if quantity == "speed":
            is_used = self._set_speed(value, scope)
        elif quantity == "rate" and value <= MAX_RATE_HZ:
            is_used = set_rate(self._draft, scope.movers or scope.subjects, value)
            is_used = is_used or self._surroundings.read_hertz(value)
        elif quantity == "time" and preposition in ("after", "at"):
            is_used = self._set_start(value, scope)
        if is_used:
            mark_used([one.group.head_word, *attributes.numbers])
        return is_used

    def _set_speed(self, speed: float, scope: Scope) -> bool:
        is_used = False
        for index in scope.movers or ([] if scope.has_verb else scope.subjects):
            motions = self._draft.objects[index].motions
            if not motions and self._draft.noun(index).motion != "stand":
                motions.append(ObjectMotion("move"))
            if motions and motions[-1].is_moving:
                motions[-1] = replace(motions[-1], pace=1.0, speed_m_s=speed)
                self._draft.objects[index].pace = 1.0
                is_used = True
        return is_used

    def _set_start(self, start: float, scope: Scope) -> bool:
        moving = [self._draft.objects[index].motions for index in scope.movers]
        for motions in filter(None, moving):  # lamps that blink have none
            motions[-1] = replace(motions[-1], start_s=start)
        return any(moving)
