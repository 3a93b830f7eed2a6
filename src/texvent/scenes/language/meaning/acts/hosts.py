"""Who does what a participle right after a noun says: that noun, or who is at it."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.meaning.capabilities import is_hand, is_living
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
_DRESSED = frozenset({"robot", "mannequin", "doll", "teddy bear", "snowman", "scarecrow", "statue",
                      "skeleton", "puppet", "humanoid robot"})  # fmt: skip
"""Things that wear clothes."""
_LIFELESS = frozenset({Role.PLACE, Role.WEATHER, Role.SNOW, Role.SKY, Role.LIGHT, Role.PART})


def take_host(clause: Clause, nouns: Mapping[str, Noun]) -> None:
    """As in "a fox runs through the snow looking for food": the fox looks; the clause changes.

    Args:
        clause: any clause; only participles right after a noun have hosts.
        nouns: the objects that can be shown, by name.
    """
    verb = clause.verb
    if not clause.hosts or verb is None or not clause.subjects or clause.is_passive:
        return
    if _is_alive(clause.hosts[0], nouns) and not _can_do_it(
        clause.subjects[0], verb, clause, nouns
    ):
        clause.subjects = clause.hosts


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
        return not _is_of_bodies(verb)  # "a man with a beard wearing a suit"
    if noun is None or head.role in _LIFELESS:
        is_there = clause.hosts_by in _THERE
        return not is_there or (head.role is Role.UNKNOWN and not _is_of_bodies(verb))
    if isinstance(verb.meaning.value, Verb) and verb.meaning.value.act == "wear":
        return is_living(noun) or is_hand(noun) or noun.name in _DRESSED
    is_furniture = noun.motion == "stand" and not (
        is_living(noun) or is_hand(noun) or noun.is_working or noun.acts
    )
    return not (is_furniture and _is_of_bodies(verb))


def _is_of_bodies(verb: Word) -> bool:
    """Whether only people and animals do it."""
    value = verb.meaning.value
    if isinstance(value, Verb):
        return value.act in _BY_BODIES
    return verb.role in (Role.ACTIVITY, Role.SIMILAR)
