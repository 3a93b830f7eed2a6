"""Where the camera stands: "filmed from a boat", "seen from behind a fence".

Its standpoint is not in the picture, and the camera is not carried by it.
"""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

_SEEN = frozenset({"seen", "filmed", "viewed", "watched", "recorded", "captured", "observed",
                   "photographed"})  # fmt: skip
_SHOT = frozenset({"shot", "taken"})
"""Of the camera only at the begin of a phrase: "an arrow shot from a bow"."""
_FROM = frozenset({"from", "from behind", "from inside", "from within", "from under"})
_VIEWS = frozenset({Role.VIEW, Role.FRAMING, Role.CAMERA, Role.CAMERA_MOVE})
_ENDS = frozenset({"of", "as", "while", "and", "with", "to", "toward", "towards", "into"})
_FARTHEST = 7
_STANDS = frozenset({"stands", "bleachers", "grandstand", "tribune", "balcony"})
"""Standpoints high above what is filmed."""


def mark_standpoints(words: Sequence[Word]) -> None:
    """Take what the camera films from out of the picture; the words change."""
    for index, word in enumerate(words):
        is_first = index == 0 or words[index - 1].pos is Pos.SIGN
        if word.text not in _SEEN and not (word.text in _SHOT and is_first):
            continue
        after = words[index + 1 : index + 1 + _FARTHEST]
        if not after or after[0].text not in _FROM:
            continue
        phrase = _take_phrase(after[1:])
        nouns = [one for one in phrase if one.pos is Pos.NOUN]
        if not nouns or any(one.is_viewpoint for one in phrase):
            continue
        for one in (word, *after[:1], *phrase):
            if one.pos is Pos.NOUN:
                one.meaning, one.others = Meaning(Role.CAMERA, Pos.NOUN), ()
                one.is_used, one.shown_as = True, "where the camera stands"
                one.course = "in stands" if one.text in _STANDS else ""
            elif one.pos in (Pos.VERB, Pos.PREPOSITION) or one is word:
                one.meaning, one.others = Meaning(Role.FUNCTION, Pos.ADVERB), ()
                one.is_used = True


def _take_phrase(after: Sequence[Word]) -> list[Word]:
    found = []
    for word in after:
        if word.text in _ENDS or word.pos in (Pos.SIGN, Pos.VERB) or word.role in _VIEWS:
            break
        found.append(word)
    return found
