"""Smoke, sparks, light shows: effects that a clause names."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import Effect
from texvent.scenes.language.meaning.capabilities import is_living, is_person
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

_OF_THINGS = frozenset({"steam", "smoke", "fire", "sparks", "splash", "drip"})
"""What comes from things where people have to do with them."""


def add_effect(draft: Draft, one: Referent, scope: Scope, near: Sequence[int] = ()) -> bool:
    """Add smoke, sparks ... to the clause's subjects; whether there is something to add it to.

    Steam comes from no person but from what is `near` the word, acted on, or named last.
    """
    kind = str(one.value)
    source = scope.subjects[0] if scope.subjects and not EFFECTS[kind].is_around else None
    if source is not None and kind in _OF_THINGS and is_person(draft.noun(source)):
        named = reversed(range(len(draft.objects))) if kind == "steam" else ()
        found = (*near, *scope.acted_on, *named)
        source = next((one for one in found if not is_living(draft.noun(one))), source)
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
