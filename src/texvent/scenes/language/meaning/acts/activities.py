"""Finds the activity of a person or a hand that a clause names: "waves with the right hand"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import lru_cache

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.vocabulary.acts import (
    ALL_LIGHT,
    EXACT_ACTS,
    GESTURE_VERBS,
    LIGHT_VERBS,
    NAMED_ACTS,
    TAKEN_ACTS,
)
from texvent.scenes.language.vocabulary.function import DETERMINERS
from texvent.scenes.language.vocabulary.verbs import VERBS
from texvent.scenes.language.words.english import Pos, VerbForm, list_readings, list_verb_forms
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.people.activities import ACTIVITIES, HAND_GESTURES
from texvent.scenes.models.people.acts.activity import Activity
from texvent.scenes.models.people.work.verbs import HANDWORK, WITH_PARTICLE

_NAMING = frozenset({Pos.NOUN, Pos.ADJECTIVE, Pos.VERB})
Key = tuple[str, ...]


def find_activity(clause: Clause, *, is_hand: bool) -> tuple[str, list[Word], bool] | None:
    """The longest activity phrase that the clause's verb begins.

    Returns:
        Name of the activity, the words that say it, and whether more than the verb says it; None
        if the clause names none.
    """
    if clause.verb_word.is_lost:
        return None
    table = _phrases(is_hand)
    said = [(lemma, word) for word in _list_words(clause) for lemma in _split(word)]
    lemmas = tuple(lemma for lemma, _ in said)
    verb = len(_split(clause.verb_word))
    for length in range(len(said), verb, -1):
        name = table.get(lemmas[:length])
        if name is not None:
            return name, [word for _, word in said[:length]], True
    light = _find_named(lemmas, verb, table, is_hand=is_hand)
    if light is not None:
        name, length = light
        return name, [word for _, word in said[:length]], True
    by_heads = _find_by_heads(clause, lemmas[:verb], table)
    if by_heads is not None:
        return by_heads
    is_plain = len(said) > verb and not clause.phrases
    name = table.get((*lemmas[:verb], lemmas[-1])) if is_plain else None
    if name is not None:
        return name, [said[0][1], said[-1][1]], True
    name = table.get(lemmas[:verb])
    return None if name is None else (name, [clause.verb_word], False)


PORTIONS = frozenset(
    {"piece", "slice", "plate", "bowl", "bite", "portion", "bunch", "lot", "game", "round", "match"}
)


def _of_portion(group: NounGroup) -> NounGroup:
    """The cake of "a piece of cake"."""
    is_portion = group.head is not None and group.head.lemma in PORTIONS
    if is_portion and len(group.phrases) == 1 and group.phrases[0].preposition.text == "of":
        return (group.phrases[0].groups or [group])[0]
    return group


def _find_by_heads(
    clause: Clause, verb: Key, table: Mapping[Key, str]
) -> tuple[str, list[Word], bool] | None:
    """As in "swings a tennis racket on the court", "talks on her pink phone": verb and head noun.

    Returns:
        Name of the activity, the words that say it, True; None if they name none.
    """
    heads: list[tuple[Word | None, tuple[Word, ...]]]
    heads = [(_of_portion(group).head, ()) for group in clause.objects[:1]]
    heads += [(group.head, (phrase.preposition,)) for phrase in clause.phrases
              for group in phrase.groups[:1]]  # fmt: skip
    portion = [group.head for group in clause.objects[:1]
               if group.head is not None and _of_portion(group) is not group]  # fmt: skip
    for head, between in heads:
        if head is None or (between and clause.objects):
            continue
        key = (*verb, *(word.text for word in between), _split(head)[-1])
        if len(key) > len(verb) and key in table:
            return table[key], [clause.verb_word, *portion, *between, head], True
    return None


def _find_named(
    lemmas: Key, verb: int, table: Mapping[Key, str], *, is_hand: bool
) -> tuple[str, int] | None:
    """As in "does a hula hoop", "shows thumbs up": the activity that follows a light verb.

    Returns:
        Its name and the number of words up to its end; None if none follows.
    """
    light = GESTURE_VERBS if is_hand else LIGHT_VERBS
    if verb != 1 or lemmas[0] not in light:
        return None
    for length in range(len(lemmas), verb, -1):
        key = lemmas[verb:length]
        if key in table and (is_hand or lemmas[0] in ALL_LIGHT or key[0] in TAKEN_ACTS):
            return table[key], length
    return None


def base_form(text: str) -> str:
    """Base form of a verb of one or more words: "shakes off" → "shake off"."""
    first, *rest = text.split()
    return " ".join((_normalise(first), *rest))


def note_near(name: str, words: Sequence[Word]) -> None:
    """Where words that `find_activity` found say more than the activity shows, the verb says so."""
    key = tuple(lemma for word in dict.fromkeys(words) for lemma in _split(word))
    if key in _near_phrases():
        for word in words:
            is_object = word.pos is Pos.NOUN and not word.things
            if is_object or (word is words[0] and word.lemma != name):
                word.shown_as = name


def _split(word: Word) -> list[str]:
    """Base forms of the parts of a word: "pick up" of "picks" once its particle is read."""
    if word.lemma in WITH_PARTICLE:
        return word.lemma.split()
    if word.has_other_sense:
        return word.lemma.split()
    return [_normalise(part) for part in word.text.split()]


def _list_words(clause: Clause) -> list[Word]:
    """The verb and what follows it, without determiners and owners."""
    said = [clause.verb_word]
    for group in clause.objects:
        said.extend(_plain(group))
    for phrase in clause.phrases:
        said.append(phrase.preposition)
        for group in phrase.groups:
            said.extend(_plain(group))
    said.extend(clause.adverbs)
    return said


def _plain(group: NounGroup) -> list[Word]:
    return [word for word in group.words if word is not group.determiner]


def name_activity(words: Sequence[Word]) -> tuple[str, str, bool] | None:
    """Who does what, where words name an activity alone: "jumping jacks", "table tennis".

    Returns:
        Noun, activity, and whether it is only like the one that is named; None if they name none.
    """
    is_exact = len(words) == 1 and words[0].text in EXACT_ACTS
    if len(words) == 1 and not (is_exact or _is_act(words[0])):
        return None
    text = " ".join(word.text for word in words if word.pos in _NAMING)
    near = _near_acts().get(text)
    if near is not None:
        return "person", near, text not in EXACT_ACTS
    key = tuple(
        _normalise(part)
        for word in words
        for part in word.text.split()
        if part not in DETERMINERS and part not in ("gesture", "gestures")
    )
    if not key:
        return None
    if key in (found := _phrases(is_hand=True)):
        return "hand", found[key], False
    if words[0].text.split()[0].endswith("ed") or words[0].meaning.form is VerbForm.PAST:
        return None  # "fried fish" is no act
    people = _phrases(is_hand=False)
    is_hand_of_person = key[:1] == ("hand",) and key[1:] in found
    if is_hand_of_person:
        return "hand", found[key[1:]], False
    return ("person", people[key], False) if key in people else None


def is_named(words: Sequence[Word]) -> bool:
    """Whether a gerund, with what stands before it, names an act: "fencing", "sumo wrestling"."""
    is_gerund = words[-1].meaning.form is VerbForm.ING
    return is_gerund and " ".join(word.text for word in words) in _near_acts()


def _is_act(word: Word) -> bool:
    """Whether a word alone names an act: "squat", not "playing card" or "sandpaper"."""
    is_long = " " in word.text and word.role is not Role.NOUN
    return is_long or (word.role is Role.UNKNOWN and word.lemma not in HANDWORK)


@lru_cache(maxsize=1)
def _near_acts() -> Mapping[str, str]:
    return {text: name for name, texts in NAMED_ACTS.items() for text in texts}


_FORMS: Mapping[str, str] = {
    **{form: base for base in ("put", "breakdance", "deadlift", "handstand", "backflip", "do",
                         "text", "headbang", "snorkel", "cheerlead",
                         "skydive", "barbecue", "barbeque", "rollerblade", "boulder")
       for form, _ in list_verb_forms(base)},
    "deadlifts": "deadlift", "handstands": "handstand", "backflips": "backflip",
}  # fmt: skip
"""Forms that the dictionary lacks, or has for another verb too."""


@lru_cache(maxsize=1024)
def _normalise(word: str) -> str:
    """Base form of a word, of its verb if it can be one."""
    if word in HANDWORK:
        return word  # "feed" is no past of "fee"
    if word in _FORMS:
        return _FORMS[word]
    readings = list_readings(word)
    verbs = [one.lemma for one in readings if one.pos is Pos.VERB]
    return (verbs or [one.lemma for one in readings] or [word])[0]


@lru_cache(maxsize=2)
def _phrases(is_hand: bool) -> Mapping[Key, str]:
    """Phrases of base forms, without determiners → activity."""
    table: Mapping[str, Activity] = HAND_GESTURES if is_hand else ACTIVITIES
    plain = {verb.base for verb in VERBS if verb.act or verb.kind == "move" or verb.relation}
    found: dict[Key, str] = {}
    for name, activity in table.items():
        for text in (*activity.words, *activity.near, *activity.named):
            key = _key_of(text)
            if len(key) > 1 or key[0] not in plain:
                found.setdefault(key, name)
    return found


@lru_cache(maxsize=1)
def _near_phrases() -> frozenset[Key]:
    return frozenset(_key_of(text) for one in ACTIVITIES.values() for text in one.near)


def _key_of(text: str) -> Key:
    """Base forms of a phrase, without determiners."""
    words = text.replace("-", " ").split()
    return tuple(_normalise(word) for word in words if word not in DETERMINERS)
