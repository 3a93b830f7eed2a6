"""Who does what a participle right after a noun says: that noun, or who is at it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from texvent.scenes.language.grammar.syntax import Clause, NounGroup, PrepPhrase
from texvent.scenes.language.meaning.capabilities import can_do, is_hand, is_living
from texvent.scenes.language.meaning.referents.resolver import OWNERS
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.protocol import Noun

_BY_BODIES = frozenset({"hold", "wear", "throw", "catch", "kick", "hit", "give", "ride"})
"""Acts that no furniture does."""
_THERE = frozenset(
    {"in", "on", "through", "along", "across", "down", "up", "over", "around", "under", "at",
     "into", "onto", "inside", "by", "beside", "near", "against", "from", "to", "next to"}
)  # fmt: skip
"""Prepositions of where someone is who does something there."""
_HAD_BY = ("with", "in")
PLACED = frozenset(
    {"next to", "near", "beside", "by", "close to", "in front of", "behind", "outside",
     "outside of", "at", "along", "across from"}
)  # fmt: skip
"""Prepositions of where a whole is, not what it has."""
_ON_FEET = frozenset({"walk", "run", "jump", "crawl", "climb"})
_POSED = frozenset({"stand", "sit", "lie"})
_DRESSED = frozenset({"robot", "mannequin", "doll", "teddy bear", "snowman", "scarecrow", "statue",
                      "skeleton", "puppet", "humanoid robot"})  # fmt: skip
"""Things that wear clothes."""
_LIFELESS = frozenset({Role.PLACE, Role.WEATHER, Role.SNOW, Role.SKY, Role.LIGHT, Role.PART})


def take_hosts(clauses: Sequence[Clause], nouns: Mapping[str, Noun]) -> None:
    """As in "a fox runs through the snow looking for food": the fox looks; the clauses change.

    Args:
        clauses: of the prompt; only participles right after a noun have hosts.
        nouns: the objects that can be shown, by name.
    """
    for clause in clauses:
        _take_host(clause, nouns)


def _take_host(clause: Clause, nouns: Mapping[str, Noun]) -> None:
    verb = clause.verb
    if not clause.hosts or verb is None or not clause.subjects or clause.is_passive:
        return
    if not _is_alive(clause.hosts[0], nouns):
        return
    if not _can_do_it(clause.subjects[0], verb, clause, nouns):
        clause.subjects[:] = clause.hosts  # also of participles in this one
    elif not clause.is_relative and _go_together(clause, verb, nouns):
        clause.subjects = [*clause.hosts, *clause.subjects]


def lift_places(clause: Clause, nouns: Mapping[str, Noun]) -> None:
    """As in "a man with a sack next to a train": the man is next to it; the clause changes.

    Only of what somebody has or holds, and only where the preposition puts nothing onto something.
    """
    for group in clause.subjects:
        for phrase in list(group.phrases if _is_alive(group, nouns) else ()):
            if phrase.preposition.text in _HAD_BY and _is_had(phrase.groups[-1], nouns):
                _lift(phrase.groups[-1].phrases, group)
                _lift_held(phrase.groups[-1], group, nouns)
    verb = clause.verb
    if verb is not None and _is_of_bodies(verb) and len(clause.subjects) == 1:
        host, had = clause.subjects[0], [one for one in clause.objects if _is_had(one, nouns)]
        for phrase in clause.phrases if _is_alive(host, nouns) else ():
            if phrase.near in had and phrase.preposition.text in PLACED:
                phrase.near = host


def _lift(phrases: list[PrepPhrase], host: NounGroup) -> None:
    """Move the phrases of place to the host."""
    lifted = [one for one in phrases if one.preposition.text in PLACED]
    phrases[:] = [one for one in phrases if one not in lifted]
    for one in lifted:
        one.near = host
    host.phrases.extend(lifted)


def _lift_held(worn: NounGroup, host: NounGroup, nouns: Mapping[str, Noun]) -> None:
    """As in "a girl in boots with an umbrella": the girl has it; a hat has a feather."""
    noun = _find(worn, nouns)
    if noun is None or noun.name not in WEARABLE:
        return
    for one in list(worn.phrases):
        held = _find(one.groups[-1], nouns)
        if one.preposition.text == "with" and held is not None and held.name not in _TRIMMINGS:
            worn.phrases.remove(one)
            one.near = host
            host.phrases.append(one)


_TRIMMINGS = frozenset({"feather", "flower", "rose", "bow", "star", "heart", "leaf", "button",
                        "ribbon", "letter", "dot", "skull"})  # fmt: skip


def _is_had(group: NounGroup, nouns: Mapping[str, Noun]) -> bool:
    """Whether it goes where its owner goes: no animal, no vehicle."""
    noun = _find(group, nouns)
    return noun is not None and not is_living(noun) and noun.motion not in ("drive", "sail")


def _go_together(clause: Clause, verb: Word, nouns: Mapping[str, Noun]) -> bool:
    """As in "a man with a dog walking on a beach"."""
    value = verb.meaning.value
    goes = isinstance(value, Verb) and value.kind in _ON_FEET and value.act is None
    hosts = [_find(one, nouns) for one in clause.hosts]
    fellows = [_find(one, nouns) for one in clause.subjects]
    return goes and clause.hosts_by == "with" and all(
        one is not None and is_living(one) and can_do(one, str(value.kind))
        for one in (*hosts, *fellows)
    )  # fmt: skip


def _find(group: NounGroup, nouns: Mapping[str, Noun]) -> Noun | None:
    meaning = group.head.read_as(Role.NOUN) if group.head is not None else None
    return nouns.get(str(meaning.value)) if meaning is not None else None


def _is_alive(group: NounGroup, nouns: Mapping[str, Noun]) -> bool:
    if group.head is not None and group.head.pos is Pos.PRONOUN:
        return group.head.text not in ("it", "itself")
    noun = _find(group, nouns)
    return noun is not None and is_living(noun)


def _can_do_it(group: NounGroup, verb: Word, clause: Clause, nouns: Mapping[str, Noun]) -> bool:
    """Whether the noun right before the participle may do it."""
    head = group.head
    if head is None or head.pos is Pos.PRONOUN:
        return True
    noun = _find(group, nouns)
    if clause.hosts_by == "with" and (noun is None or head.role is Role.PART):
        # As in "a man with a beard wearing a suit".
        return not (_is_of_bodies(verb) or _is_posed(verb, clause))
    if noun is None or head.role in _LIFELESS:
        is_there = clause.hosts_by in _THERE
        return not is_there or (head.role is Role.UNKNOWN and not _is_of_bodies(verb))
    if isinstance(verb.meaning.value, Verb) and verb.meaning.value.act == "wear":
        return is_living(noun) or is_hand(noun) or noun.name in _DRESSED
    if not (is_living(noun) or is_hand(noun)) and _is_posed(verb, clause):
        return False
    is_furniture = noun.motion == "stand" and not (
        is_living(noun) or is_hand(noun) or noun.is_working or noun.acts
    )
    return not (is_furniture and _is_of_bodies(verb))


def _is_posed(verb: Word, clause: Clause) -> bool:
    """Whether no thing that someone has does it: "a man with a sack walking", "... sitting"."""
    value = verb.meaning.value
    if not isinstance(value, Verb) or value.act is not None:
        return False
    on_own = any(
        group.determiner is not None and group.determiner.text in OWNERS
        for phrase in clause.phrases
        for group in phrase.groups
    )  # "with a laptop sitting on her lap"
    is_posed = value.kind in _POSED and clause.hosts_by in _HAD_BY and not on_own
    return is_posed or (value.kind in _ON_FEET and clause.hosts_by in (*_HAD_BY, ""))


def _is_of_bodies(verb: Word) -> bool:
    """Whether only people and animals do it."""
    value = verb.meaning.value
    if isinstance(value, Verb):
        return value.act in _BY_BODIES
    return verb.role in (Role.ACTIVITY, Role.SIMILAR)
