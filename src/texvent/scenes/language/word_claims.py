"""What the words of a prompt that have an effect stand for."""

from __future__ import annotations

from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word

SILENT_PREPOSITIONS = frozenset(
    {"of", "by", "at", "for", "with", "in", "on", "to", "from", "as", "into", "about", "via",
     "within", "upon", "out", "off", "like"}
)  # fmt: skip
"""Prepositions that are not reported: the noun after them is, if it is not shown."""
_SILENT = frozenset(
    {Pos.SIGN, Pos.DETERMINER, Pos.CONJUNCTION, Pos.SUBORDINATOR, Pos.RELATIVE, Pos.AUXILIARY,
     Pos.TO, Pos.PRONOUN}
)  # fmt: skip
"""Parts of speech that need no effect of their own."""
CROWDED = 5
"""Things of a prompt from which on a lost word puts all of its sentence in doubt."""
MANY_LOST = 7
"""Words that are not understood from which on what others say of things is in doubt."""
_MISREAD = frozenset({"relation", "motion"})
"""Aspects of words that mean something else where words of their sentence are lost."""
_AS_SAID = frozenset({"light", "weather"})
"""Aspects of words that mean the same whatever is before them: "a cyberpunk night"."""
_MISPLACED = _MISREAD | {"colour", "size", "material"}
"""The same where many words are lost: what is said of things may be said of a lost one."""
_OF_NOUNS = frozenset({Pos.ADJECTIVE, Pos.NUMBER, Pos.DETERMINER})
"""Parts of speech of words that say more of a noun, but not what it or its verb is."""
_GRAMMAR = frozenset({Role.FUNCTION, Role.CAMERA, Role.GLOW})
"""Roles of words that show nothing of their own: "scene", "camera", "light"."""
_OF_MOTION = frozenset({Role.VERB, Role.DIRECTION, Role.PACE, Role.SIMILAR, Role.ACTIVITY})

_OF_OBJECTS = {
    Role.COUNT: "count", Role.COLOUR: "colour", Role.SHADE: "colour", Role.SIZE: "size",
    Role.MATERIAL: "material", Role.PART: "part", Role.SIDE: "side",
}  # fmt: skip
"""Role of a word that says something of objects → what."""
_OF_SCENE = {
    Role.LIGHT: "light", Role.LIGHTING: "lighting", Role.SHADE: "bright",
    Role.WEATHER: "weather", Role.CLOUDS: "clouds", Role.SNOW: "snow", Role.SKY: "sky",
    Role.STEEP: "steep", Role.DUST: "dust", Role.WAVES: "waves",
    Role.FLICKER: "flicker", Role.SHADOW: "shadow", Role.EFFECT: "effect", Role.PLACE: "place",
    Role.ROAD: "road", Role.VIEW: "view", Role.FRAMING: "framing", Role.COLOUR: "colour",
    Role.STYLE: "style",
}  # fmt: skip
"""Role of a word that says something of the scene → what."""


def says_something(word: Word) -> bool:
    """Whether a word that has an effect is worth a mention as shown: no mere grammar."""
    if not word.said:
        return False  # it belongs to a phrase that is reported with its first word
    if word.course:
        return True
    is_plain = word.pos is Pos.PREPOSITION or word.role is Role.VIEW
    if is_plain and word.text in SILENT_PREPOSITIONS:
        return False
    if word.role is Role.RELATION or word.pos is Pos.PREPOSITION:
        return bool(word.relations) or word.role is Role.DIRECTION
    return word.role not in _GRAMMAR


def is_silent(word: Word) -> bool:
    """Whether it needs no effect of its own."""
    return word.pos in _SILENT and not word.is_lost


def is_unread(word: Word) -> bool:
    """Whether it has no effect though it says something."""
    if word.is_used or word.shown_as is not None or is_silent(word):
        return False
    return word.is_lost or word.text not in SILENT_PREPOSITIONS
