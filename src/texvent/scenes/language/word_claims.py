"""What the words of a prompt that have an effect stand for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from texvent.scenes.description import Claim
from texvent.scenes.language.grammar.clauses import SENTENCE_SIGNS
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


def list_claims(words: Sequence[Word], *, is_crowded: bool = False) -> tuple[Claim, ...]:
    """What each word that is shown, or substituted, stands for.

    Args:
        words: of the prompt, in order.
        is_crowded: whether it names `CROWDED` things or more.
    """
    unread = tuple(dict.fromkeys(one.said for one in words if is_unread(one)))
    everywhere = unread if len(unread) >= MANY_LOST else ()
    claims: list[Claim] = []
    for sentence in _cut_sentences(words):
        lost = tuple(one.said for one in sentence if _changes_meaning(one))
        for word in sentence:
            if (word.is_used or word.shown_as is not None) and says_something(word):
                claims.append(_claim(word, lost if is_crowded else (), everywhere))
    return tuple(claims)


def _claim(word: Word, sentence: tuple[str, ...], everywhere: tuple[str, ...]) -> Claim:
    """A word's claim.

    A word depends on those that it goes with (`link_companions`); in a crowded prompt verbs and
    relations do on all of the sentence; where many are lost, what is said of things on all of them.
    Nouns, places and light mean the same in any company: of those that a whole sentence, or many
    lost words, once put in doubt nine in ten were plainly seen. What is shown as something else is
    reported as that.

    Args:
        word: that is shown, or substituted.
        sentence: words of its sentence that put its verbs and relations in doubt.
        everywhere: words that put what is said of things in doubt.
    """
    aspect = _aspect_of(word)
    own = () if aspect in _AS_SAID else word.companions
    lost = [one.said for one in own if _changes_meaning(one)]
    lost += sentence if aspect in _MISREAD else ()
    lost += everywhere if aspect in _MISPLACED else ()
    return Claim(
        word.said,
        aspect,
        word.things,
        word.relations,
        word.motion,
        _move_of(word),
        _value_of(word, aspect),
        () if word.shown_as is not None else tuple(dict.fromkeys(lost)),
    )


def _changes_meaning(word: Word) -> bool:
    """Whether it is lost, and words around it may mean something else without it."""
    return is_unread(word) and word.pos not in _OF_NOUNS


def _cut_sentences(words: Sequence[Word]) -> Iterator[list[Word]]:
    sentence: list[Word] = []
    for word in words:
        sentence.append(word)
        if word.pos is Pos.SIGN and word.text in SENTENCE_SIGNS:
            yield sentence
            sentence = []
    yield sentence


def is_silent(word: Word) -> bool:
    """Whether it needs no effect of its own."""
    return word.pos in _SILENT and not word.is_lost


def is_unread(word: Word) -> bool:
    """Whether it has no effect though it says something."""
    if word.is_used or word.shown_as is not None or is_silent(word):
        return False
    return word.is_lost or word.text not in SILENT_PREPOSITIONS


def _aspect_of(word: Word) -> str:
    if word.course:
        return "course"
    if word.is_viewpoint and not word.things:
        return "viewpoint"
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
    if word.pos is Pos.NOUN and word.role is Role.NOUN and word.read_as(Role.PLACE):
        return "place"
    return _OF_SCENE.get(word.role, "quality")


def _value_of(word: Word, aspect: str) -> str:
    """What it means, where it is a word of the scene; or why it is not shown."""
    if aspect == "course":
        return word.course
    if aspect == "viewpoint":
        return "the camera is there, nothing of it is in view"
    place = word.read_as(Role.PLACE) if aspect == "place" else None
    if place is not None:
        return str(place.value)
    return str(word.meaning.value) if word.role in _OF_SCENE else ""


def _move_of(word: Word) -> str | None:
    """Kind of the camera's move that it asks for."""
    move = word.read_as(Role.CAMERA_MOVE)
    is_another = bool(word.things) or word.role is Role.PLACE  # a trail that one walks on
    return None if move is None or is_another else str(move.value[0])
