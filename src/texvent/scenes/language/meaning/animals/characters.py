"""Animals that do what only people do stand upright: "a panda plays the guitar".

An animal whose acts its own body shows (it eats, runs, lies down) stays on its four legs.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.meaning.acts.activities import find_activity
from texvent.scenes.language.vocabulary.characters import (
    BY_PEOPLE_ONLY,
    DRINKS,
    EATERS,
    EATING_PLACES,
    HELD_IN_HANDS,
    HOOFED,
    IN_MOUTH,
    MEALS,
    PEOPLES_CLOTHES,
    PLAYED_BY_PEOPLE,
    SEATS_OF_PEOPLE,
    SHARED_ACTS,
    TOYS,
    WORK_OF_PEOPLE,
)
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.people.creatures.names import UPRIGHT
from texvent.scenes.models.people.work.verbs import HANDWORK
from texvent.scenes.models.protocol import Noun

_HOLDING = frozenset({"hold", "carry", "raise", "wave", "swing"})
_WEARING = frozenset({"wear", "dress", "clothe"})
_TRAVELS = frozenset({"walk", "run", "dance", "swim", "jump", "climb", "skate", "stroll", "jog"})


def stand_upright(
    clauses: Sequence[Clause], words: Sequence[Word], nouns: Mapping[str, Noun]
) -> list[str]:
    """Animals that do what only people do become upright ones, wherever the prompt names them.

    Args:
        clauses: of the prompt, with their subjects; they change.
        words: of the prompt.
        nouns: the objects that can be shown, by name.

    Returns:
        Notes that say which animals stand upright.
    """
    found: dict[str, None] = {}
    for clause in clauses:
        for group in (*clause.subjects, *clause.hosts):
            name = _name(group)
            if name is None or UPRIGHT[name] not in nouns:
                continue
            if _is_dressed(group, clause) or (
                group in clause.subjects and _does_as_people(clause, name)
            ):
                found[name] = None
    for word in words:
        meaning = word.read_as(Role.NOUN)
        if meaning is not None and meaning.value in found:
            word.meaning = replace(meaning, value=UPRIGHT[str(meaning.value)])
    return [f"the {name} stands upright, with a body like a person's" for name in found]


def _name(group: NounGroup) -> str | None:
    """The animal that a group names, if it can stand upright."""
    meaning = group.head.meaning if group.head is not None else None
    if meaning is None or meaning.role is not Role.NOUN:
        return None
    return str(meaning.value) if meaning.value in UPRIGHT else None


def _does_as_people(clause: Clause, name: str) -> bool:
    verb = clause.verb
    if verb is None or clause.negation is not None or verb.is_lost:
        return False
    if verb.role is Role.SIMILAR and verb.meaning.value[0] in ANIMAL_ACTS:
        return False  # what its own body does
    if name in TOYS and (verb.lemma in _TRAVELS or verb.lemma in ("eat", "drink", "sing")):
        return True
    said = set(_list_lemmas(clause))
    if verb.lemma in _HOLDING and said & HELD_IN_HANDS and not said & IN_MOUTH:
        return True
    if verb.lemma in ("eat", "drink", "sip", "enjoy", "have"):
        return _eats_as_people(verb.lemma, said, name)
    if verb.lemma in ("play", "sit", "swing") and said & SEATS_OF_PEOPLE:
        return True
    if verb.lemma == "play" and said & PLAYED_BY_PEOPLE:
        return True
    if verb.lemma == "dance":
        return name not in HOOFED
    if verb.lemma in BY_PEOPLE_ONLY:
        return True
    return _is_activity_of_people(clause)


def _eats_as_people(verb: str, said: set[str], name: str) -> bool:
    if verb in ("drink", "sip", "enjoy", "have") and said & DRINKS:
        return True
    if verb in ("eat", "enjoy", "have") and name in EATERS and said & MEALS:
        return True
    return verb != "have" and bool(said & EATING_PLACES)


def _is_activity_of_people(clause: Clause) -> bool:
    activity = find_activity(clause, is_hand=False)
    if activity is None:
        return False
    name, _, is_exact = activity
    if name in SHARED_ACTS:
        return False
    if name not in HANDWORK:
        return True
    if is_exact:
        return name in WORK_OF_PEOPLE
    return name in WORK_OF_PEOPLE and any(_is_thing(one) for one in clause.objects)


def _is_thing(group: NounGroup) -> bool:
    """Whether it is a thing to work at: no part of a body, no animal, not itself."""
    head = group.head
    if head is None or head.role is Role.PART or head.text.endswith(("self", "selves")):
        return False
    return group.owner is None and _name(group) is None and head.pos.name == "NOUN"


def _is_dressed(group: NounGroup, clause: Clause) -> bool:
    """As in "wears blue jeans", "a fox in a suit", "dressed in a robe"."""
    inner = [one for phrase in group.phrases if phrase.preposition.text == "in"
             for one in phrase.groups]  # fmt: skip
    if clause.verb is not None and clause.verb.lemma in _WEARING and clause.negation is None:
        inner += clause.objects
        inner += [one for phrase in clause.phrases if phrase.preposition.text == "in"
                  for one in phrase.groups]  # fmt: skip
    return any(_is_of_people(one.head) for one in inner if one.head is not None)


def _is_of_people(word: Word) -> bool:
    meaning: Meaning | None = word.read_as(Role.NOUN)
    return meaning is not None and meaning.value in PEOPLES_CLOTHES


def _list_lemmas(clause: Clause) -> Iterator[str]:
    """Lemmas of what the verb is done to, and of where and with what."""
    groups = [*clause.objects, *(one for phrase in clause.phrases for one in phrase.groups)]
    groups += [one for group in groups for phrase in group.phrases for one in phrase.groups]
    for group in groups:
        for word in group.words:
            yield word.lemma
            yield from word.text.split()
            if word.role is Role.NOUN:
                yield str(word.meaning.value)
