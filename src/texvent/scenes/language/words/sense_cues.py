"""Words with several senses take the one that the other words of the prompt tell."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import takewhile

from texvent.scenes.language.vocabulary.senses import (
    DEVICES,
    IN_VESSELS,
    NO_OBJECT,
    ONLY_WITH,
    OPEN_WATER,
    OWNED,
    PARTICLES,
    SENSES,
    VERB_SENSES,
    WOODEN,
    Sense,
)
from texvent.scenes.language.vocabulary.usual_senses import USUAL_SENSES
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Lexicon, Meaning, Role
from texvent.scenes.language.words.word import Word

_SHAPES = frozenset({"circle", "ring", "square", "triangle", "disc", "line"})
"""What "of" makes an arrangement: "a circle of friends"."""
_LIGHTS = frozenset({"spark", "sparks", "light", "glow", "flame", "fire"})
"""What is orange in colour, where "orange" might be read as the fruit."""
_DARK = ("black", "dark", "darkness")
"""What "pitch" says how dark it is of, and is no field: "pitch-black"."""
_OF_SHOTS = frozenset({Role.FRAMING, Role.VIEW, Role.CAMERA, Role.CAMERA_MOVE})
"""Roles of what "overhead" is a view of: "overhead close-up"."""
_OUTLINES = frozenset({"flat", "square"})
"""Nouns that before another one say how it looks: "square black markers"."""
_BECOMING = frozenset({"shrink", "dwindle", "reduce", "fade", "melt", "blur"})
"""Verbs of what comes to look like something that is not there: "shrink to dots"."""
_OUTER = frozenset({"outer", "deep", "dark", "endless", "infinite", "vast", "black", "starry"})
"""Adjectives of the space between the stars."""
_OWNERS = ("his", "her", "their", "its", "my", "your", "our")
_FAR = 4
"""Words after a verb among which its object is looked for."""


def choose_senses(words: Sequence[Word], known: Lexicon) -> None:
    """Give words with several senses the one that the other words of the prompt tell.

    Nouns in a sense that is not shown, and verbs with a particle, lose their meaning: "a tower of
    cards", "call out". The words change.
    """
    is_told = sum(
        word.pos in (Pos.NOUN, Pos.VERB) or word.role is Role.CAMERA_MOVE for word in words
    ) > 1  # fmt: skip
    said = {word.lemma for word in words} | {part for word in words for part in word.text.split()}
    for index, word in enumerate(words):
        follower = words[index + 1] if index + 1 < len(words) else None
        others = said - {word.lemma, word.text} if is_told else set()
        is_start = index == 0 and word.meaning.form is VerbForm.ING
        is_attribute = is_start and follower is not None and follower.pos is Pos.NOUN
        if word.pos is Pos.VERB and not is_attribute:
            _choose_verb(word, words[index + 1 :], others, known)
        if word.text == "after" and word.pos is Pos.SUBORDINATOR:
            _lose_time(word, words[index + 1 :])
        if word.lemma in _BECOMING and follower is not None and follower.text in ("to", "into"):
            _forget_result(words[index + 2 :])
        if word.pos is Pos.NOUN:
            _choose_noun(word, words[:index], follower, others, known)
            _leave_room(word, words[max(index - 1, 0)])
            _leave_substance(word, words[:index])
        if follower is not None:
            _choose_before(word, follower)
        if word.text == "water":
            word.is_content = bool(IN_VESSELS & others) and not OPEN_WATER & others
        if word.text == "lamp lights":
            word.lose(Pos.NOUN)
        if word.text == "spray" and follower is not None and follower.lemma == "paint":
            word.lose(Pos.ADVERB)


def _choose_before(word: Word, follower: Word) -> None:
    """As in "overhead close-up", "orange sparks"."""
    if word.text == "overhead" and follower.role in _OF_SHOTS:
        word.mean(Meaning(Role.VIEW, Pos.ADJUNCT, "top"))
    colour = word.read_as(Role.COLOUR)
    if word.text == "orange" and follower.lemma in _LIGHTS and colour is not None:
        word.mean(colour)


def _choose_verb(word: Word, after: Sequence[Word], others: set[str], known: Lexicon) -> None:
    follower = after[0] if after else None
    if follower is not None and _is_switching(word, after):
        word.lose(Pos.VERB)
        follower.lose(Pos.ADVERB)
        return
    if follower is not None and follower.text in PARTICLES.get(word.lemma, ()):
        word.lose(Pos.VERB)
        if follower.pos is Pos.PREPOSITION:
            follower.lose(Pos.ADVERB)  # a coat that is put on is not under who does it
        return
    if NO_OBJECT.get(word.lemma, frozenset()) & {
        one.lemma.split()[-1] for one in _take_object(after)
    }:
        word.lose(Pos.VERB)
        return
    if word.text == "saw" and not WOODEN & {one.lemma for one in after}:
        word.lose(Pos.VERB)
        return
    sense = _find_sense(VERB_SENSES.get(word.lemma, ()), others)
    if sense is not None:
        _give(word, sense, known, Pos.VERB)


def _leave_room(word: Word, before: Word) -> None:
    """As in "a cramped space", "a parking space": no space between the stars."""
    is_kind = before.pos in (Pos.ADJECTIVE, Pos.NOUN) and before.text not in _OUTER
    is_one = before.text in ("a", "an", *_OWNERS)
    if word.lemma == "space" and before is not word and (is_kind or is_one):
        word.lose(Pos.NOUN)


def _leave_substance(word: Word, before: Sequence[Word]) -> None:
    """As in "is made of glass", "frosted glass": what something is of, and no thing."""
    texts = [one.text for one in before[-3:]]
    is_made = texts[-1:] in (["of"], ["from"]) and "made" in texts
    is_pane = texts[-1:] in (["frosted"], ["stained"], ["tinted"], ["etched"])
    is_substance = word.text == "glass" and (is_made or is_pane)
    if is_substance or (is_made and word.read_as(Role.MATERIAL) is not None):
        word.lose(Pos.NOUN)


def _find_determiner(before: Sequence[Word]) -> Word | None:
    """The word before a noun and its adjectives: "his" of "his empty palm"."""
    return next((word for word in reversed(before) if word.pos is not Pos.ADJECTIVE), None)


def _is_switching(word: Word, after: Sequence[Word]) -> bool:
    """As in "turns on a lamp": neither does one turn, nor on a lamp."""
    if word.lemma not in ("turn", "switch") or after[0].text not in ("on", "off"):
        return False
    return bool(DEVICES & {one.lemma.split()[-1] for one in _take_object(after[1:])})


def _take_object(after: Sequence[Word]) -> list[Word]:
    """Words up to the noun that ends the object of a verb."""
    found: list[Word] = []
    for word in after[:_FAR]:
        if word.pos in (Pos.SIGN, Pos.PREPOSITION, Pos.CONJUNCTION):
            break
        found.append(word)
    return found


def _find_sense(senses: Sequence[Sense], others: set[str]) -> Sense | None:
    return next((one for one in senses if one.cues & others), None)


def _choose_noun(
    word: Word, words: Sequence[Word], follower: Word | None, others: set[str], known: Lexicon
) -> None:
    """Give a noun after `words` its sense."""
    if word.text == "park" and words and words[-1].text == "to":
        word.lose(Pos.VERB)  # as in "looks for where to park"
        return
    before = _find_determiner(words)
    is_of = follower is not None and follower.text == "of"
    needed = ONLY_WITH.get(word.lemma)
    is_owned = before is not None and (before.text in _OWNERS or before.is_possessive)
    is_before_noun = follower is not None and (
        follower.pos in (Pos.NOUN, Pos.ADJECTIVE) or follower.read_as(Role.PART) is not None
    )
    is_darkness = word.text == "pitch" and follower is not None and follower.text in _DARK
    if is_darkness or (word.lemma in _OUTLINES and is_before_noun):
        word.lose(Pos.ADJECTIVE)
        return
    if word.lemma == "flat":
        if is_before_noun:
            word.lose(Pos.ADJECTIVE)
        return
    is_other = _find_sense(SENSES.get(word.lemma, ()), others) is not None
    if (
        (word.lemma in _SHAPES and is_of)
        or (needed is not None and others and not needed & others and not is_other)
        or (word.lemma in OWNED and is_owned)
    ):
        word.lose(Pos.NOUN)
        return
    singular = next((one for one in _singulars(word.lemma) if one in SENSES), word.lemma)
    sense = _find_sense(SENSES.get(singular, ()), others)
    if sense is not None:
        _give(word, sense, known, Pos.NOUN)
        return
    usual = USUAL_SENSES.get(word.lemma)
    if usual is not None and others and not usual.cues & others:
        word.usual_sense = usual.said_as


def _singulars(word: str) -> tuple[str, ...]:
    """The word, and what it may be the plural of: kinds of things keep their plural."""
    return (word, word.removesuffix("s"), word.removesuffix("es"))


def _give(word: Word, sense: Sense, known: Lexicon, pos: Pos) -> None:
    """Its meaning in that sense, or none."""
    found = known.find(sense.phrase.split())[1] if sense.phrase is not None else []
    found = [one for one in found if one.pos is pos or pos is Pos.NOUN]
    if not found:
        word.lose(pos)
    elif pos is Pos.VERB:
        form = word.meaning.form
        first, *rest = [replace(one, form=form) for one in found]
        word.meaning, word.others, word.lemma = first, tuple(rest), str(sense.phrase)
        word.has_other_sense = True
    else:
        word.meaning, word.others = found[0], tuple(found[1:])


_OTHER_TIMES = (Role.UNIT, Role.WEATHER, Role.SNOW)
"""Roles of what "after" is read of elsewhere: "after two seconds", "after the rain"."""


def _lose_time(word: Word, after: Sequence[Word]) -> None:
    """As in "players after a football game": neither the game nor that it is over is shown."""
    coming = list(takewhile(lambda one: one.pos is not Pos.SIGN, after))
    is_clause = any(one.pos in (Pos.VERB, Pos.AUXILIARY) for one in coming)
    if not coming or is_clause or any(one.role in _OTHER_TIMES for one in coming):
        return
    group = list(takewhile(lambda one: one.pos is not Pos.PREPOSITION, coming))
    if group and group[-1].read_as(Role.NOUN) is not None:
        return  # "goes after a mouse"
    word.mean(Meaning(Role.UNKNOWN, Pos.PREPOSITION))
    for one in group:
        if one.pos is Pos.NOUN:
            one.lose(Pos.NOUN)


def _forget_result(after: Sequence[Word]) -> None:
    for word in after:
        if word.pos is Pos.NOUN:
            word.lose(Pos.NOUN)
        elif word.pos not in (Pos.DETERMINER, Pos.ADJECTIVE, Pos.NUMBER):
            return
