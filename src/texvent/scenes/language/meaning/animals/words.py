"""How animals and their acts are found in clauses, and how a word becomes an act."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from texvent.scenes.language.grammar.syntax import NounGroup, PrepPhrase
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.vocabulary.verbs import VERBS, Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.animals.acts import ANIMAL_ACTS
from texvent.scenes.models.protocol import Noun


def split_words(text: str) -> frozenset[str]:
    """The words of a list."""
    return frozenset(text.split())


OWN = split_words("tongue trunk mouth jaw jaws teeth tooth paw beak horn tail claw hoof")
"""Parts with which an animal does what it does."""


def find_animal(group: NounGroup, nouns: Mapping[str, Noun]) -> str | None:
    """The name of the animal that a group names."""
    meaning = group.head.meaning if group.head is not None else None
    if meaning is None or meaning.role is not Role.NOUN:
        return None
    noun = nouns.get(str(meaning.value))
    return noun.name if noun is not None and is_living(noun) and not is_person(noun) else None


def say(word: Word, act: str) -> None:
    """Make a word the verb of an animal's act, or of a motion."""
    form = word.meaning.form
    if act in ANIMAL_ACTS:
        word.mean(Meaning(Role.SIMILAR, Pos.VERB, (act, False), form))
    else:
        word.mean(Meaning(Role.VERB, Pos.VERB, find_verb(act), form))


def find_verb(base: str) -> Verb:
    """The verb with that base form."""
    return next(one for one in VERBS if one.base == base)


def is_own(group: NounGroup) -> bool:
    """Itself, or a part of it."""
    head = group.head
    if head is None:
        return False
    return head.text in ("itself", "themselves", "himself", "herself") or (
        group.determiner is not None
        and group.determiner.text in ("its", "his", "her", "their")
        and head.text in OWN | split_words("fur coat face body leg paws feathers wing wings back")
    )


def list_heads(phrase: PrepPhrase) -> Iterator[Word]:
    """The nouns of a phrase."""
    for group in phrase.groups:
        if group.head is not None:
            yield group.head
