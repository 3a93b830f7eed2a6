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
_STAYING = frozenset({"static", "handheld"})
_FILMS = frozenset({"view", "shot", "footage", "video", "recording", "clip"})
_NAMES = frozenset({Pos.NOUN, Pos.PRONOUN})
_ENDS = frozenset({"of", "as", "while", "and", "with", "to", "toward", "towards", "into"})
_FARTHEST = 7
_HIGH = frozenset(
    {"stands", "bleachers", "grandstand", "tribune", "balcony", "bridge", "footbridge", "overpass",
     "flyover", "viaduct", "rooftop", "roof", "tower", "terrace"}
)  # fmt: skip
"""Standpoints high above what is filmed."""
_RAISED = frozenset({"high", "upper", "elevated", "tall", "upstairs", "second", "third", "fourth",
                     "fifth"})  # fmt: skip
"""As in "an upper window", "a third-floor window"."""
_EDGES = frozenset({"rail", "railing", "edge", "top", "side", "middle", "end", "parapet", "roof"})
"""Parts of them: "from the rail of a bridge"."""


def mark_standpoints(words: Sequence[Word]) -> None:
    """Take what the camera films from out of the picture; the words change."""
    for index, word in enumerate(words):
        if word.text not in _FROM:
            continue
        phrase = _take_phrase(words[index + 1 : index + 1 + _FARTHEST])
        nouns = [one for one in phrase if one.pos is Pos.NOUN]
        is_high = any(one.text.split()[-1] in _HIGH for one in nouns)
        is_high |= any(one.text in _RAISED for one in phrase)
        seen = _find_verb(words, index)
        if not nouns or any(one.is_viewpoint for one in phrase):
            continue
        is_view = (is_high and _is_view(words[:index])) or _is_of_camera(words, index)
        if seen is None and not is_view:
            continue
        for one in (*(() if seen is None else (seen,)), word, *phrase):
            if one.pos is Pos.NOUN:
                one.mean(Meaning(Role.CAMERA, Pos.NOUN))
                one.is_used, one.shown_as = True, "where the camera stands"
                one.course = "in stands" if one.text.split()[-1] in _HIGH else ""
            elif one.pos in (Pos.VERB, Pos.PREPOSITION) or one is seen or one.text in _RAISED:
                one.mean(Meaning(Role.FUNCTION, Pos.ADVERB))
                one.is_used = True
        if is_high:
            word.meaning = Meaning(Role.VIEW, Pos.ADJUNCT, "high")


def _find_verb(words: Sequence[Word], index: int) -> Word | None:
    """As in "filmed from", "shot from" at the begin of a phrase."""
    if index == 0:
        return None
    word = words[index - 1]
    is_first = index == 1 or words[index - 2].pos is Pos.SIGN
    return word if word.text in _SEEN or (word.text in _SHOT and is_first) else None


def _is_of_camera(words: Sequence[Word], index: int) -> bool:
    """As in "a fixed camera from a window", unlike "a pan from a window to a door"."""
    before = words[index - 1] if index else None
    if before is None or words[index].text != "from":
        return False
    rest = [one.text for one in words[index + 1 : index + 1 + _FARTHEST]]
    if before.text in _FILMS and (index == 1 or words[index - 2].pos not in _NAMES):
        return "to" not in rest
    stays = before.role is Role.CAMERA_MOVE and before.meaning.value[0] in _STAYING
    is_named = before.pos is not Pos.VERB
    return is_named and "to" not in rest and (stays or before.role in _VIEWS - {Role.CAMERA_MOVE})


def _is_view(before: Sequence[Word]) -> bool:
    """As in "traffic from an overpass", "the camera looks down from a roof": nobody leaves it."""
    sentence: list[Word] = []
    for word in reversed(before):
        if word.pos is Pos.SIGN:
            break
        sentence.append(word)
    if any(word.role is Role.CAMERA or word.text in _SEEN for word in sentence):
        return True
    acts = any(word.pos is Pos.VERB or word.role is Role.EFFECT for word in sentence)
    return bool(sentence) and not acts


def _take_phrase(after: Sequence[Word]) -> list[Word]:
    found: list[Word] = []
    for word in after:
        is_end = word.text in _ENDS and not (
            word.text == "of" and found[-1:] and _is_edge(found[-1])
        )
        if is_end or word.pos in (Pos.SIGN, Pos.VERB) or word.role in _VIEWS:
            break
        found.append(word)
    return found


def _is_edge(word: Word) -> bool:
    return word.text.split()[-1] in _EDGES
