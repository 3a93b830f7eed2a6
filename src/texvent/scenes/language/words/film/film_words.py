"""Language of film among the words of a prompt: what is the camera's there is no thing.

"Slow dolly past the desks" is a move of the camera, "camera on a tripod" one that stands still, and
"shallow depth of field" a style. Elsewhere the same words name things: "a man carries a tripod".
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import pairwise, takewhile

from texvent.scenes.language.vocabulary.film import FRAMING_ADJECTIVES
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.film.moves import (
    FILM_NOUNS,
    FILM_ROLES,
    FILMED,
    direct_moves,
    is_film,
    read_move,
    silence,
    speaks_of_film,
)
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

_GEAR = frozenset(
    {"gimbal", "steadicam", "slider", "dolly", "crane", "jib", "rail", "track", "cable", "rig",
     "boom", "stabilizer", "stabiliser", "gantry", "mount"}
)  # fmt: skip
_STANDS = frozenset({"tripod", "monopod"})
_CARRYING = ("on", "from", "with", "by", "via", "using", "upon")
_LOOKING = frozenset({"look", "point", "film", "capture", "reveal", "track", "shoot", "record"})
_LOOK = frozenset({"look", "point", "face", "aim", "angle", "peer", "gaze"})
_STRAIGHT = frozenset({"straight", "directly", "vertically"})
_HEIGHTS = frozenset({"down", "up", "high", "low"})
_WAYS_TO_SEE = frozenset(
    {"street", "road", "alley", "alleyway", "lane", "avenue", "boulevard", "highway", "motorway",
     "path", "trail", "track", "tracks", "corridor", "hallway", "aisle", "tunnel", "runway",
     "platform", "canal", "hall", "driveway"}
)  # fmt: skip
"""What a camera looks along that "looks down" it."""
_OF_GROUPS = frozenset({Pos.DETERMINER, Pos.ADJECTIVE, Pos.NOUN, Pos.NUMBER})
_LIT = frozenset({"lit", "lamp", "lamps", "spotlight", "spotlights", "beam", "beams", "backlit",
                  "lighted", "illuminated", "shining", "shines", "sun"})  # fmt: skip
_OF_SCENE_TOO = frozenset(
    {"from a height", "from high up", "low to the ground",
     "close to the ground", "near the ground", "from underneath", "from below", "head on",
     "from one side", "from the back", "from the rear", "from high above", "at ground level",
     "at floor level", "at street level", "at eye level", "at head height", "at shoulder height",
     "at chest height", "at waist height", "at knee height", "at head level"}
)  # fmt: skip
"""Views that also say where things come from or are, where nothing speaks of the camera."""


def read_film_words(words: Sequence[Word]) -> list[str]:
    """Tell what words of film mean where they speak of the camera; the words change.

    Returns:
        A note with the words of style that ask for nothing that is seen by itself.
    """
    for begin, end in _list_fragments(words):
        read_move(words, begin, end)
        _read_gear(words[begin:end])
        _part_adjectives(words[begin:end])
        _read_views(words, begin, end)
        _frame_shots(words[begin:end])
    _read_looks(words)
    _part_fragments(words)
    direct_moves(words)
    for index, word in enumerate(words):
        _skip_filmed(words, index, word)
        if word.text == "drone" and _is_camera_drone(words, index):
            word.meaning, word.shown_as = (
                Meaning(Role.CAMERA, Pos.NOUN),
                "the camera's view from it",
            )
    return _read_styles(words)


def _part_adjectives(words: Sequence[Word]) -> None:
    """As in "static overhead camera", "a shaky close-up": how the camera moves, and a view."""
    for word, after in pairwise(words):
        is_move = word.role is Role.CAMERA_MOVE and word.pos is Pos.ADJECTIVE
        if is_move and after.pos is Pos.ADJUNCT and is_film(after):
            word.meaning = replace(word.meaning, pos=Pos.ADJUNCT)


def _list_fragments(words: Sequence[Word]) -> Iterator[tuple[int, int]]:
    """Begin and end of what stands between signs."""
    begin = 0
    for index, word in enumerate(words):
        if word.pos is Pos.SIGN:
            if index > begin:
                yield begin, index
            begin = index + 1
    if begin < len(words):
        yield begin, len(words)


def _read_looks(words: Sequence[Word]) -> None:
    """As in "a drone shot, looking straight down", "the camera sits low": from where it looks."""
    sentence: list[Word] = []
    for index, word in enumerate(words):
        if word.pos is Pos.SIGN and word.text in ".;!?":
            sentence = []
            continue
        sentence.append(word)
        if word.text not in _HEIGHTS or not _is_of_camera(sentence[:-1]):
            continue
        coming = words[index + 1] if index + 1 < len(words) else None
        before = sentence[-2] if len(sentence) > 1 else word
        if before.text in _STRAIGHT:
            before, is_straight = sentence[-3], sentence[-2]
        else:
            is_straight = None
        if before.lemma in _LOOK and _is_along(words[index + 1 :]):
            silence(before)
            silence(word)
            continue
        if before.lemma in _LOOK and word.text in ("down", "up"):
            view = "low" if word.text == "up" else "top" if is_straight else "aerial"
            for one in (before, *([is_straight] if is_straight else [])):
                silence(one)
        elif word.text in ("high", "low") and (
            coming is None or coming.pos not in (Pos.NOUN, Pos.ADJECTIVE)
        ):
            view = "low" if word.text == "low" else "aerial"
            if coming is not None and coming.text == "above" and _ends(words, index + 2):
                silence(coming)
        else:
            continue
        word.mean(Meaning(Role.VIEW, Pos.ADJUNCT, view))


def _is_along(after: Sequence[Word]) -> bool:
    """As in "looks down a narrow street", unlike "looks down at a street"."""
    group = list(takewhile(lambda one: one.pos in _OF_GROUPS, after))
    return bool(group) and group[-1].text.split()[-1] in _WAYS_TO_SEE


def _ends(words: Sequence[Word], index: int) -> bool:
    return index >= len(words) or words[index].pos is Pos.SIGN


def _is_of_camera(before: Sequence[Word]) -> bool:
    """Whether a sentence is about the camera alone so far."""
    others = [one for one in before if one.role is Role.NOUN and one.text != "drone"]
    return not others and any(
        (is_film(one) and one.pos is not Pos.VERB) or one.text == "drone" for one in before
    )


def _read_gear(words: Sequence[Word]) -> None:
    """As in "camera on a tripod", "a shot from a crane"."""
    if not speaks_of_film(words):
        return
    for index, word in enumerate(words):
        is_stand = word.lemma in _STANDS
        if not (is_stand or word.lemma in _GEAR) or word.pos is not Pos.NOUN:
            continue
        first = index
        while first > 0 and words[first - 1].pos in (Pos.DETERMINER, Pos.ADJECTIVE):
            first -= 1
        if first == 0 or words[first - 1].text not in _CARRYING:
            continue
        if not any(is_film(one) for one in words[: first - 1]):
            continue
        for one in words[first - 1 : index]:
            silence(one)
        silence(word)
        if is_stand:
            word.meaning = Meaning(Role.CAMERA_MOVE, Pos.ADJUNCT, ("static", None))
            word.is_used = False


def _read_views(words: Sequence[Word], begin: int, end: int) -> None:
    """As in "fruit falls from the sky", "strong light from above": no view of the camera."""
    own = words[begin:end]
    for before, word in pairwise(own):
        is_light = before.role in (Role.LIGHT, Role.GLOW) or before.text in _LIT
        if is_light and word.role is Role.VIEW and word.text.startswith("from "):
            word.meaning, word.is_lost = Meaning(Role.UNKNOWN, Pos.ADVERB), True
    has_verb = any(one.pos is Pos.VERB and one.text not in FILMED for one in own)
    for word in own:
        if word.role is not Role.VIEW or word.text not in _OF_SCENE_TOO or not has_verb:
            continue
        others = [one for one in own if one is not word]
        if not speaks_of_film(others):
            word.meaning, word.is_lost = Meaning(Role.UNKNOWN, Pos.ADVERB), True


def _frame_shots(words: Sequence[Word]) -> None:
    """As in "a wide locked shot", "a medium static shot of": how near the camera is."""
    for index, word in enumerate(words[:-1]):
        framing = FRAMING_ADJECTIVES.get(word.text)
        coming = list(words[index + 1 : index + 4])
        while coming and coming[0].pos is Pos.ADJECTIVE and not is_film(coming[0]):
            coming.pop(0)
        if framing is not None and word.pos is not Pos.VERB and coming and is_film(coming[0]):
            is_of_shot = coming[0].text in FILM_NOUNS or coming[0].role is not Role.CAMERA
            if is_of_shot and coming[0].role is not Role.STYLE:
                word.meaning = Meaning(Role.FRAMING, Pos.ADJUNCT, framing)


def _part_fragments(words: Sequence[Word]) -> None:
    """As in "a hand opens a door, camera on a tripod": what is after the comma is by itself."""
    fragments = list(_list_fragments(words))
    for number, (begin, end) in enumerate(fragments):
        own = words[begin:end]
        is_shot = any(is_film(one) for one in own) and not any(
            one.pos is Pos.VERB and not is_film(one) and one.text not in FILMED for one in own
        )
        if not is_shot:
            continue
        if number and any(
            one.pos in (Pos.NOUN, Pos.VERB, Pos.ADJUNCT)
            for one in words[fragments[number - 1][0] : begin]
        ):
            _part(words[begin - 1])
        is_alone = not any(one.role is Role.NOUN for one in own)
        coming = words[end + 1] if end + 1 < len(words) else None
        is_open = coming is not None and coming.pos is Pos.VERB
        if is_alone and coming is not None and not is_open:
            _part(words[end])


def _part(sign: Word) -> None:
    if sign.text == ",":
        sign.tokens = (replace(sign.tokens[0], text=";"),)


def _skip_filmed(words: Sequence[Word], index: int, word: Word) -> None:
    """As in "a swimmer, filmed from the side": who films is not in the picture."""
    if word.text not in FILMED or (index and words[index - 1].pos is Pos.AUXILIARY):
        return
    coming = list(words[index + 1 : index + 4])
    while coming and (
        coming[0].pos in (Pos.PREPOSITION, Pos.DETERMINER) or coming[0].role is Role.PACE
    ):
        coming.pop(0)
    is_view = bool(coming) and coming[0].role in FILM_ROLES and coming[0].pos is not Pos.VERB
    if is_view and (word.pos is Pos.VERB or word.text == "shot"):
        silence(word)


def _is_camera_drone(words: Sequence[Word], index: int) -> bool:
    """As in "The drone hovers, looking straight down", after a view from the air."""
    is_from_air = any(
        one.role is Role.VIEW and one.meaning.value in ("aerial", "top") for one in words
    )
    is_known = index > 0 and words[index - 1].text == "the"
    coming = words[index + 1 : index + 3]
    films = any(one.lemma in _LOOKING and one.pos is Pos.VERB for one in coming)
    return (is_from_air and is_known) or films


def _read_styles(words: Sequence[Word]) -> list[str]:
    asked: dict[str, None] = {}
    for index, word in enumerate(words):
        if word.role is not Role.STYLE:
            continue
        word.is_used = True
        before = words[index - 1] if index else None
        if before is not None and before.role is Role.UNKNOWN and before.pos is Pos.ADJECTIVE:
            silence(before, Pos.ADJECTIVE)
        if word.meaning.value == "":
            asked[word.text] = None
            silence(word, word.pos)
    return [f"words of style change nothing here: {', '.join(asked)}"] if asked else []
