"""Smoke, sparks, light shows: effects that a clause names."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import Effect, NamedColour
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import OF_SCENE, Scope
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.word import mark_used
from texvent.scenes.models.effects import EFFECTS, LIQUID_COLOURS

_OF_LIGHT_SHOWS = frozenset(
    {"changing", "moving", "sweeping", "flashing", "rotating", "colorful", "colourful",
     "coloured", "colored", "bright", "swirling", "dancing"}
)  # fmt: skip
"""What light shows and lightning do anyway."""

_FLASHING = frozenset({"beacon", "turn signal", "hazard lights"})
_OF_THINGS = frozenset({"steam", "smoke", "fire", "sparks", "splash", "drip"})
"""What comes from things where people have to do with them."""

GIVES_OFF = frozenset(
    {"blow", "make", "release", "leave", "raise", "spray", "send", "emit", "throw", "create",
     "produce", "shoot", "scatter", "kick"}
)  # fmt: skip
"""Verbs of who makes smoke, bubbles, dust."""
_MAKING = GIVES_OFF | {"give", "splash", "pour", "drip", "spill", "trail", "spit", "breathe",
                       "puff", "exhale", "cause", "light", "set", "whip", "churn", "toss",
                       "sprinkle", "shed", "drop", "shower", "fire", "have"}  # fmt: skip
"""These, and others after which an effect may come from the one who does it."""
_WATCHING = frozenset({"watch", "see", "look", "observe", "film", "photograph", "record"})


def comes_from_doer(draft: Draft, clause: Clause, doers: Sequence[int]) -> bool:
    """Whether an effect that a verb acts on comes from who does so: "blows bubbles"."""
    word = clause.verb
    if word is None or word.lemma in _MAKING:
        return True
    is_chase = isinstance(word.meaning.value, Verb) and word.meaning.value.relation == "follow"
    return not is_chase and not any(is_living(draft.noun(index)) for index in doers)


def is_done_to_effect(
    draft: Draft, clause: Clause, doers: Sequence[int], objects: Sequence[Referent]
) -> bool:
    """As in "chases bubbles", "throws snow": nothing that is drawn does so to an effect."""
    word = clause.verb
    if word is None or any(one.is_things for one in objects) or clause.is_passive:
        return False
    value = word.meaning.value
    is_thrown = isinstance(value, Verb) and value.kind == "throw"
    if is_thrown and any(is_living(draft.noun(index)) for index in doers):
        return any(one.kind in ("effect", *OF_SCENE) for one in objects)
    if word.lemma in _WATCHING or not any(one.kind == "effect" for one in objects):
        return False
    return not comes_from_doer(draft, clause, doers)


def _find_liquid(one: Referent) -> NamedColour | None:
    """The colour of milk, of honey: of what pours or drips."""
    name = one.group.head.lemma.split()[-1] if one.group.head is not None else ""
    rgb = LIQUID_COLOURS.get(name)
    return None if rgb is None else NamedColour(name, rgb)


def _take_colour(one: Referent) -> NamedColour | None:
    """The colour that is said of it, or that of its liquid."""
    for colour, words in one.attributes.colours[:1]:
        mark_used(words)
        return colour
    return _find_liquid(one)


_BURNING = frozenset({"fireplace", "campfire", "torch", "candle"})
"""Things whose models have flames."""


def add_effect(draft: Draft, one: Referent, scope: Scope, near: Sequence[int] = ()) -> bool:
    """Add smoke, sparks ... to the clause's subjects; whether there is something to add it to.

    Steam comes from no person but from what is `near` the word, acted on, or named last.
    """
    kind = str(one.value)
    if kind == "fire" and any(item.noun in _BURNING for item in draft.objects):
        mark_used(one.group.words[-1:])  # "the flames" of the fireplace
        return True
    source = scope.subjects[0] if scope.subjects and not EFFECTS[kind].is_around else None
    if source is not None and kind in _OF_THINGS and is_person(draft.noun(source)):
        named = reversed(range(len(draft.objects))) if kind == "steam" else ()
        found = (*near, *scope.acted_on, *named)
        source = next((one for one in found if not is_living(draft.noun(one))), source)
    if source is None and EFFECTS[kind].needs_source:
        return False
    colour = _take_colour(one)
    if EFFECTS[kind].is_around:
        mark_used(word for word in one.group.modifiers if word.text in _OF_LIGHT_SHOWS)
        if any(effect.kind == kind for effect in draft.effects):
            mark_used(one.group.words[-1:])
            return True
    flicker = one.attributes.flicker
    if kind == "string lights" and flicker is not None:
        kind, flicker.is_used = "blinking lights", True
    elif kind in _FLASHING and flicker is not None:
        flicker.is_used = True
    draft.effects.append(Effect(kind, source, colour))
    if one.group.head is not None:
        one.group.head.is_used = True
    return True
