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

_OF_OBJECTS = {
    Role.COUNT: "count", Role.COLOUR: "colour", Role.SHADE: "colour", Role.SIZE: "size",
    Role.MATERIAL: "material", Role.PART: "part", Role.SIDE: "side",
}  # fmt: skip
"""Role of a word that says something of objects → what."""
_OF_SCENE = {
    Role.LIGHT: "light", Role.SHADE: "bright", Role.WEATHER: "weather", Role.CLOUDS: "clouds",
    Role.SNOW: "snow", Role.SKY: "sky", Role.STEEP: "steep", Role.DUST: "dust",
    Role.FLICKER: "flicker", Role.SHADOW: "shadow", Role.EFFECT: "effect", Role.PLACE: "place",
    Role.ROAD: "road", Role.VIEW: "view", Role.FRAMING: "framing", Role.COLOUR: "colour",
}  # fmt: skip
"""Role of a word that says something of the scene → what."""


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
        Claim(
            word.text,
            _aspect_of(word),
            word.things,
            word.relations,
            word.motion,
            _move_of(word),
            str(word.meaning.value) if word.role in _OF_SCENE else "",
        )
        for word in words
        if (word.is_used or word.shown_as is not None) and says_something(word)
    )


def _aspect_of(word: Word) -> str:
    if word.role in _OF_MOTION:
        return "motion"
    if word.things and word.role in _OF_OBJECTS:
        return _OF_OBJECTS[word.role]
    if word.role in (Role.EFFECT, Role.DUST):
        return _OF_SCENE[word.role]
    if word.relations:
        return "relation"
    if word.pos is Pos.NOUN and word.things:
        return "name"
    return _OF_SCENE.get(word.role, "quality")


def _move_of(word: Word) -> str | None:
    """Kind of the camera's move that it asks for."""
    move = word.read_as(Role.CAMERA_MOVE)
    return None if move is None or word.things else str(move.value[0])
