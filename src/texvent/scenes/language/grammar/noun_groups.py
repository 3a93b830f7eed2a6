"""Words to noun groups."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.people.work.verbs import HANDWORK

_STARTS = frozenset({Pos.DETERMINER, Pos.NUMBER, Pos.ADJECTIVE, Pos.NOUN, Pos.PRONOUN})
_NOMINAL = frozenset({Pos.NOUN, Pos.ADJECTIVE, Pos.NUMBER})
_ACTS_ON_THINGS = frozenset({"throw", "kick", "hit", "push", "pull", "carry"})
_BOTH = frozenset(
    {"boil", "fry", "roast", "bake", "simmer", "drop", "open", "close", "pour", "shake", "rattle",
     "jiggle", "crumple", "change", "water", "spray", "press", "click", "spill", "drip", "crush",
     "smash", "beat", "unfold", "dry", "decant", "unwind", "cut", "put", "service", "scan", "tap",
     "knock", "squash", "shuffle"}
)  # fmt: skip
"""Verbs that are done to things, and that things do: "boiling water"."""
_GOALS = frozenset({"into", "onto"})
_PARTICIPLES = (VerbForm.ING, VerbForm.PAST)


def starts_group(words: Sequence[Word], at: int, *, is_opening: bool) -> bool:
    """Whether a noun group starts at `words[at]`.

    Args:
        words: the prompt.
        at: index.
        is_opening: whether a participle there may be an attribute: at the start of a sentence or
            after a preposition or comma, not after the subject.
    """
    if at >= len(words):
        return False
    if words[at].pos in _STARTS:
        return True
    if words[at].pos is Pos.ADJUNCT:
        return is_opening and _is_attribute_phrase(words, at)
    return is_opening and _is_attribute(words, at)


def read_group(words: Sequence[Word], at: int) -> tuple[NounGroup, int]:
    """The noun group at `words[at]` and the index after it."""
    group = NounGroup()
    if words[at].pos is Pos.PRONOUN:
        return NounGroup(head=words[at]), at + 1
    while at < len(words) and _belongs(words, at, group):
        word = words[at]
        at += 1
        if word.pos is Pos.DETERMINER:
            group.determiner = word
            continue
        if group.head is not None:
            group.modifiers.append(group.head)
            group.head = None
        if word.pos is not Pos.NOUN:
            group.modifiers.append(word)
            continue
        group.head = word
        if word.is_possessive and _continues(words, at):
            group = NounGroup(owner=group)
    return group, at


def _belongs(words: Sequence[Word], at: int, group: NounGroup) -> bool:
    """Whether `words[at]` is part of the group begun before it."""
    pos = words[at].pos
    if pos is Pos.DETERMINER:
        return not group.words and group.owner is None
    if pos is Pos.NOUN:
        return not _opens_subject(words, at, group)
    if pos in (Pos.NUMBER, Pos.ADJECTIVE):
        return group.head is None
    return pos is not Pos.PRONOUN and _is_modifier(words, at, group)


def _opens_subject(words: Sequence[Word], at: int, group: NounGroup) -> bool:
    """As in "On a narrow street people walk": who walks is no part of the street."""
    head = group.head
    if head is None or head.role is not Role.PLACE or group.determiner is None:
        return False
    after = words[at + 1].pos if at + 1 < len(words) else None
    return words[at].text in PEOPLE and after in (Pos.VERB, Pos.AUXILIARY)


PEOPLE = frozenset({"people", "men", "women", "children", "kids", "pedestrians"})
"""Nouns of people that are no second part of a compound."""


def _continues(words: Sequence[Word], at: int) -> bool:
    return at < len(words) and words[at].pos in _NOMINAL


def _is_modifier(words: Sequence[Word], at: int, group: NounGroup) -> bool:
    """Whether another word belongs into the group, before its head."""
    word = words[at]
    if not _continues(words, at + 1):
        return False
    if word.pos is Pos.ADVERB:
        return group.head is None and words[at + 1].pos is Pos.ADJECTIVE
    if word.pos is Pos.CONJUNCTION:
        return (
            word.text == "and" and group.head is None and bool(group.modifiers)
            and words[at + 1].pos is Pos.ADJECTIVE and _noun_follows(words, at + 2)
        )  # fmt: skip
    if word.pos is Pos.ADJUNCT:
        return group.head is None and group.determiner is not None
    if word.pos is not Pos.VERB or word.meaning.form not in _PARTICIPLES:
        return False
    if group.head is None or group.head.role is Role.UNIT:
        return True
    is_compound = word.meaning.form is VerbForm.PAST and words[at + 1].pos is Pos.NOUN
    return is_compound and group.determiner is not None


def _noun_follows(words: Sequence[Word], at: int) -> bool:
    while at < len(words) and words[at].pos is Pos.ADJECTIVE:
        at += 1
    return at < len(words) and words[at].pos is Pos.NOUN


def _is_attribute(words: Sequence[Word], at: int) -> bool:
    """A participle before its noun: "spinning blue brushes", "glowing lava"."""
    word = words[at]
    if word.pos is not Pos.VERB or word.meaning.form not in _PARTICIPLES:
        return False
    if _goes_on_doing(words, at):
        return False
    opens = at == 0 or words[at - 1].pos is Pos.SIGN
    is_gerund = opens and word.meaning.form is VerbForm.ING
    if is_gerund and (is_done_to_things(word.lemma, word.meaning) or _goes_into(words, at)):
        return False
    return _noun_follows(words, at + 1)


def _goes_on_doing(words: Sequence[Word], at: int) -> bool:
    """As in "people meeting and flying kites": they fly them."""
    if at < 3 or words[at - 1].text != "and" or words[at - 3].pos is not Pos.NOUN:
        return False
    first, form = words[at - 2], words[at].meaning.form
    return first.pos is Pos.VERB and first.meaning.form is form and form is VerbForm.ING


def _goes_into(words: Sequence[Word], at: int) -> bool:
    """Whether handwork brings something somewhere: "pouring coffee into a cup"."""
    if words[at].lemma not in HANDWORK:
        return False
    at += 1
    while at < len(words) and words[at].pos in (*_NOMINAL, Pos.DETERMINER):
        at += 1
    return at < len(words) and words[at].text in _GOALS


def is_done_to_things(lemma: str, verb: Meaning) -> bool:
    """Whether a verb before a noun is done to it: "chopping onions", unlike "spinning tops"."""
    act = verb.value.act if isinstance(verb.value, Verb) else None
    return act in _ACTS_ON_THINGS or (lemma in HANDWORK and lemma not in _BOTH)


def _is_attribute_phrase(words: Sequence[Word], at: int) -> bool:
    return at + 1 < len(words) and words[at + 1].pos in (Pos.NOUN, Pos.ADJECTIVE)
