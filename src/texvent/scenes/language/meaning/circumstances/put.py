"""What is put somewhere: on a table, or in a bowl, are things, not who looks at them."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.grammar.syntax import PrepPhrase
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.nouns import FAMILIES
from texvent.scenes.models.objects.receptacles import CARRIERS, VESSELS
from texvent.scenes.models.people.activities import SEATS

FOOD = frozenset(
    noun.name for kind in ("food", "helpings") for noun in FAMILIES[f"objects kitchen {kind}"]
)
"""What is eaten: no animal is in it."""
_FLAT_FOOD = frozenset({"cake", "pizza"})
"""On which there is room for something else."""
TABLES = frozenset({"table", "desk"})
_HELD_AT_MOST_M = 1.3
"""A person "with" something up to this long holds it."""
OFF_GROUND = frozenset({"jump", "fly", "rise", "fall", "throw", "hover", "swing", "float", "climb"})
"""Motions in which someone is not on the ground."""
_ON = ("on", "on top of")


def is_small(draft: Draft, index: int) -> bool:
    """Whether someone may hold it."""
    return draft.length_m(index) <= _HELD_AT_MOST_M


def is_put(
    draft: Draft, phrase: PrepPhrase, near: Sequence[int], things: Sequence[int], scope: Scope
) -> bool:
    """As in "looks through a book on a table": the book is on it, not who looks.

    Args:
        draft: the scene so far.
        phrase: says where.
        near: objects that it follows: the book.
        things: where that is: the table.
        scope: what its clause is about.
    """
    where = {draft.noun(index).name for index in things}
    is_on = phrase.preposition.text in _ON and where <= TABLES | CARRIERS - SEATS
    is_in = phrase.preposition.text in ("in", "inside") and where <= VESSELS | {"plate"}
    if not (is_on or is_in) or set(near) & {*things, *scope.subjects}:
        return False
    is_thing = not any(is_living(draft.noun(index)) for index in near)
    return is_thing and all(is_person(draft.noun(index)) for index in scope.subjects)


def is_topped(word: Word) -> bool:
    """As in "a cake topped with cherries", which the reader knows as "with"."""
    return word.said.startswith("topped")


def top(draft: Draft, things: Sequence[int], hosts: Sequence[int]) -> bool:
    """Put things on what is topped with them; False for a sandwich, on which there is no room."""
    if draft.noun(hosts[0]).name in FOOD - _FLAT_FOOD:
        draft.relate("with", hosts, things)
        return False
    return draft.relate("on", things, hosts)


def take_out(draft: Draft, things: Sequence[int]) -> None:
    """Things that are said to be elsewhere are no longer in or on what they are "with"."""
    draft.relations[:] = [
        one for one in draft.relations if one.kind not in ("in", "on") or one.subject not in things
    ]


def list_put(
    draft: Draft, phrase: PrepPhrase, found: Sequence[Referent], scope: Scope
) -> list[int]:
    """As in "a bowl with rice and beans on a table": the bowl is on it; a lamp with a cup: both.

    Args:
        draft: the scene so far.
        phrase: what something has "with" it.
        found: what its nouns mean; the last one is followed by where that is.
        scope: what has them.

    Returns:
        Objects that are there; none where nothing is said, or the last noun alone is there.
    """
    last = found[-1].group
    if phrase.preposition.text == "with" and any(one.has_pronoun for one in last.phrases):
        # As in "a plate with a fork and a knife next to it": both are.
        return [i for one in found if one.is_things for i in one.things]
    rests = [
        group
        for one in last.phrases
        for group in one.groups
        if one.preposition.text in _ON and group.head is not None and group.head.lemma in TABLES
    ]
    hosts = scope.subjects
    if phrase.preposition.text != "with" or not rests or not hosts or scope.has_verb:
        return []
    if any(is_living(draft.noun(i)) or not is_small(draft, i) for i in hosts):
        return []
    is_vessel = all(draft.noun(i).name in VESSELS | CARRIERS for i in hosts)
    is_vessel |= is_topped(phrase.preposition)
    others = [] if is_vessel else [i for one in found if one.is_things for i in one.things]
    return [*hosts, *others]


def find_slid(draft: Draft, word: Word, things: Sequence[int], scope: Scope) -> list[int]:
    """As in "pushes a cup across the table", "a ball rolls over the desk": what goes on it."""
    names = {draft.noun(index).name for index in things}
    if word.text not in ("across", "over") or not names <= TABLES:
        return []
    doers = list(scope.movers or scope.subjects)
    pushed = [
        target
        for relation in draft.relations
        if relation.kind in ("push", "pull") and relation.subject in doers
        for target in relation.targets
    ]
    goes = [
        index
        for index in doers
        if draft.noun(index).habitat != "air"
        and not is_living(draft.noun(index))
        and any(one.kind not in OFF_GROUND for one in draft.objects[index].motions)
    ]
    return pushed or (goes if len(goes) == len(doers) else [])
