"""Words of models and prompts → what scenes can show."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from typing import get_args

from texvent.scenes.colours import SURFACES
from texvent.scenes.inflection import list_finite_forms, list_plurals
from texvent.scenes.models.effects import EFFECTS
from texvent.scenes.models.motions import MOTIONS
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.people.activities import ACTIVITIES
from texvent.scenes.models.places import PLACES
from texvent.scenes.spec import scene as spec
from texvent.scenes.spec.data import field_types, inner_type


def resolve(word: str, kind: str) -> str | None:
    """What a word or phrase stands for; None where scenes have nothing for it.

    Args:
        word: as a model or a prompt has it.
        kind: "noun", "motion", "place", "colour", "material", "effect", "relation", "direction",
            "light", "weather", "view" or "move" (of the camera).

    Example:
        >>> resolve("Automobiles", "noun"), resolve("driving", "motion"), resolve("wug", "noun")
        ('car', 'drive', None)
    """
    return _tables()[kind].get(" ".join(word.casefold().replace("_", " ").split()))


@cache
def _tables() -> Mapping[str, Mapping[str, str]]:
    """Kind → form → what it stands for; the first that has a form keeps it."""
    light, place, camera = (field_types(one) for one in (spec.Light, spec.Place, spec.Camera))
    closed = {
        "relation": get_args(spec.RelationKind),
        "direction": (*get_args(spec.Direction), *get_args(spec.MoveDirection)),
        "material": get_args(spec.Material),
        "light": get_args(inner_type(light["kind"])),
        "weather": get_args(inner_type(place["weather"])),
        "view": get_args(inner_type(camera["view"])),
        "place": tuple(PLACES),
        "colour": tuple(SURFACES),
        "effect": tuple(EFFECTS),
    }
    return {
        **{kind: {one: one for one in words} for kind, words in closed.items()},
        "noun": _first(_nouns()),
        "motion": _first(_motions()),
        "move": _first((form, one) for one in get_args(spec.MoveKind) for form in _forms(one)),
    }


def _first(pairs: Iterator[tuple[str, str]]) -> dict[str, str]:
    found: dict[str, str] = {}
    for form, meaning in pairs:
        found.setdefault(form, meaning)
    return found


def _nouns() -> Iterator[tuple[str, str]]:
    for noun in NOUNS.values():
        yield noun.name, noun.name
    for noun in NOUNS.values():
        for name in (noun.name, *noun.synonyms):
            yield from ((form, noun.name) for form in (name, *list_plurals(name)))
        yield from ((name, noun.name) for name in noun.plurals)


def _motions() -> Iterator[tuple[str, str]]:
    for name in (*sorted(MOTIONS), *ACTIVITIES):
        yield from ((form, name) for form in _forms(name))
    for name, activity in ACTIVITIES.items():
        for words in (*activity.words, *activity.named):
            yield from ((form, name) for form in _forms(words))


def _forms(verb: str) -> Iterator[str]:
    """A verb in its regular forms, and some that nobody writes; its first word changes."""
    yield verb
    first, _, rest = verb.partition(" ")
    stem = first[:-1] if first.endswith("e") and not first.endswith("ee") else first
    doubled = f"{first}{first[-1]}"
    forms = (f"{one}{end}" for one in (stem, first, doubled) for end in ("ing", "ed"))
    for form in (*list_finite_forms(first), *forms):
        yield f"{form} {rest}".strip()
