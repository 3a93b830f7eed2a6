"""What the words of a prompt that have an effect stand for."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import Claim
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word

SILENT_PREPOSITIONS = frozenset(
    {"of", "by", "at", "for", "with", "in", "on", "to", "from", "as", "into", "about", "via",
     "within", "upon", "out", "off", "like"}
)  # fmt: skip
"""Prepositions that are not reported: the noun after them is, if it is not shown."""
_GRAMMAR = frozenset({Role.FUNCTION, Role.CAMERA, Role.GLOW})
"""Roles of words that show nothing of their own: "scene", "camera", "light"."""
_OF_MOTION = frozenset({Role.VERB, Role.DIRECTION, Role.PACE, Role.SIMILAR, Role.ACTIVITY})


def says_something(word: Word) -> bool:
    """Whether a word that has an effect is worth a mention as shown: no mere grammar."""
    if word.pos is Pos.PREPOSITION and word.text in SILENT_PREPOSITIONS:
        return False
    if word.role is Role.RELATION or word.pos is Pos.PREPOSITION:
        return bool(word.relations) or word.role is Role.DIRECTION
    return word.role not in _GRAMMAR


def list_claims(words: Sequence[Word]) -> tuple[Claim, ...]:
    """What each word that is shown, or substituted, stands for."""
    return tuple(
        Claim(word.text, _aspect_of(word), word.things, word.relations, word.motion, _move_of(word))
        for word in words
        if (word.is_used or word.shown_as is not None) and says_something(word)
    )


def _aspect_of(word: Word) -> str:
    if word.role in _OF_MOTION:
        return "motion"
    if word.role is Role.COUNT:
        return "count"
    if word.relations:
        return "relation"
    is_name = word.pos is Pos.NOUN and bool(word.things) and word.role is not Role.PART
    return "name" if is_name else "quality"


def _move_of(word: Word) -> str | None:
    """Kind of the camera's move that it asks for."""
    move = word.read_as(Role.CAMERA_MOVE)
    return None if move is None or word.things else str(move.value[0])
