"""Smoke, sparks, light shows: effects that a clause names."""

from __future__ import annotations

from texvent.scenes.description import Effect
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.word import mark_used
from texvent.scenes.models.effects import EFFECTS

_OF_LIGHT_SHOWS = frozenset(
    {"changing", "moving", "sweeping", "flashing", "rotating", "colorful", "colourful",
     "coloured", "colored", "bright", "swirling", "dancing"}
)  # fmt: skip
"""What light shows and lightning do anyway."""


def add_effect(draft: Draft, one: Referent, scope: Scope) -> bool:
    """Add smoke, sparks ... to the clause's subjects; whether there is something to add it to."""
    kind = str(one.value)
    source = scope.subjects[0] if scope.subjects and not EFFECTS[kind].is_around else None
    if source is None and EFFECTS[kind].needs_source:
        return False
    colours = one.attributes.colours
    colour = colours[0][0] if colours else None
    for _, words in colours[:1]:
        mark_used(words)
    if EFFECTS[kind].is_around:
        mark_used(word for word in one.group.modifiers if word.text in _OF_LIGHT_SHOWS)
        if any(effect.kind == kind for effect in draft.effects):
            mark_used(one.group.words[-1:])
            return True
    flicker = one.attributes.flicker
    if kind == "string lights" and flicker is not None:
        kind, flicker.is_used = "blinking lights", True
    draft.effects.append(Effect(kind, source, colour))
    if one.group.head is not None:
        one.group.head.is_used = True
    return True
