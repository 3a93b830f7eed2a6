"""Words that say of a thing or a place what it is anyway: "rocky mountains", "on the floor"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word, mark_used

_ROCKS = frozenset({"mountain", "canyon", "cliff", "hills", "rock", "boulder", "cave"})
_WATERS = frozenset({"sea", "lake", "river", "underwater", "swimming pool", "harbour"})
_GREEN = frozenset({"grass", "hills", "savanna", "park", "forest", "jungle", "farmyard"})
_ROOMS = frozenset(
    {"museum", "gym", "swimming pool", "indoor", "kitchen", "office", "corridor", "library",
     "restaurant", "stadium", "market", "bathroom", "classroom", "station", "living room"}
)  # fmt: skip
_INHERENT: dict[str, frozenset[str]] = {
    "rocky": _ROCKS,
    "rugged": _ROCKS,
    "craggy": _ROCKS,
    "deep": frozenset({"canyon", "sea", "forest", "jungle", "underwater", "space"}),
    "high": frozenset({"mountain", "cliff", "skyscraper", "tower"}),
    "elevated": frozenset({"mountain"}),
    "towering": frozenset({"mountain", "cliff", "skyscraper", "tower"}),
    "grassy": _GREEN,
    "lush": _GREEN,
    "leafy": frozenset({"forest", "park", "jungle", "tree"}),
    "sandy": frozenset({"beach", "desert", "sand"}),
    "open": frozenset({"grass", "savanna", "plain", "sea", "sky", "road", "hills", "desert"}),
    "watery": _WATERS,
    "indoor": _ROOMS,
    "wild": frozenset({"savanna", "forest", "jungle", "lion", "tiger", "bear", "zebra", "wolf"}),
}
"""Adjective → things and places that are so as they are drawn."""
_PEAKS = frozenset({"mountain", "mountains"})
_RESTING = frozenset({"lie", "sit", "stand", "kneel", "crawl", "sleep", "walk", "rest", "roll",
                      "play", "crouch", "squat", "lay"})  # fmt: skip
_BEFORE_NOUN = frozenset({Pos.ADJECTIVE, Pos.NOUN})


def read_inherent(words: Sequence[Word]) -> None:
    """Count as read what is so anyway; the words change.

    * "Rocky" of mountains, "deep" of a canyon, "grassy" of a field, "indoor" of a museum.
    * "Some" of a place or of what is not counted: "some water".
    * "On the floor" of a place that is named, "on the ground" of who lies or walks there.
    * "Mountains" before "peaks".
    """
    for number, word in enumerate(words):
        noun = _noun_after(words, number)
        if noun is not None and _is_anyway(word, noun):
            _take(word, word.pos if word.pos is Pos.DETERMINER else Pos.ADJECTIVE)
        elif word.text in ("some", "any") and noun is not None and not _is_counted(noun):
            _take(word, Pos.DETERMINER)
        elif word.text in ("floor", "ground") and _is_on_it(words, number):
            for one in words[number - 2 : number + 1]:
                _take(one, Pos.ADVERB)


def _is_anyway(word: Word, noun: Word) -> bool:
    """Whether a word says of the noun after it what it is as it is drawn."""
    is_peak = word.text in _PEAKS and noun.meaning.value == "mountain"
    return is_peak or word.text == "other" or noun.meaning.value in _INHERENT.get(word.text, ())


def _take(word: Word, pos: Pos) -> None:
    word.mean(Meaning(Role.FUNCTION, pos))
    mark_used([word])


def _noun_after(words: Sequence[Word], number: int) -> Word | None:
    """The head of the group in which a word is, after it."""
    found = None
    for word in words[number + 1 :]:
        if word.pos not in _BEFORE_NOUN and word.meaning.form is not VerbForm.PAST:
            break
        if word.pos is Pos.NOUN:
            found = word
    return found


def _is_counted(noun: Word) -> bool:
    return noun.role is not Role.PLACE and (noun.meaning.is_plural or noun.meaning.can_be_both)


def _is_on_it(words: Sequence[Word], number: int) -> bool:
    """Whether "on the floor" says no more than where one is anyway."""
    if number < 3 or [one.text for one in words[number - 2 : number]] != ["on", "the"]:
        return False
    after = words[number + 1] if number + 1 < len(words) else None
    if after is not None and after.text in ("of", "near"):
        return False
    if words[number].text == "floor":
        others = [one for one in words if one is not words[number]]
        return any(one.role is Role.PLACE and one.pos is Pos.NOUN for one in others)
    before = words[number - 3]
    return before.pos is Pos.VERB and before.lemma in _RESTING
