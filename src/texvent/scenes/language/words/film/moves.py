"""Moves of the camera that stand as nouns or orders: "a slow pan left", "truck past a fence"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

FILM_ROLES = frozenset({Role.CAMERA, Role.CAMERA_MOVE, Role.VIEW, Role.FRAMING, Role.STYLE})
FILM_NOUNS = frozenset({"shot", "view", "footage", "angle", "clip", "video", "framing"})
FILMED = frozenset({"filmed", "shot", "seen", "captured", "viewed", "recorded", "taken",
                     "photographed"})  # fmt: skip
_MOVES: dict[str, tuple[str, str | None]] = {
    "pan": ("pan", None), "tilt": ("tilt", None), "zoom": ("zoom", None),
    "dolly": ("dolly", None), "truck": ("truck", None), "crane": ("crane", "up"),
    "pedestal": ("pedestal", "up"), "orbit": ("orbit", None), "arc": ("orbit", None),
    "jib": ("crane", "up"), "boom": ("crane", "up"),
}  # fmt: skip
"""Noun of a move → the move; most of them are things too."""
_SIDES = frozenset({"left", "right"})
_HEIGHTWISE = frozenset({"up", "down", "upward", "upwards", "downward", "downwards"})
_OF_NO_THING = frozenset({"tilt", "zoom", "jib", "boom", "arc", "orbit"})
"""Moves whose nouns name nothing else before a way."""
_AFTER_ARTICLE: dict[str, frozenset[str]] = {
    "pan": _SIDES | _HEIGHTWISE | {"across", "along", "through", "around"},
    "pedestal": _HEIGHTWISE,
    "dolly": _SIDES | {"in", "out", "forward", "back", "along", "past", "through"},
    "truck": _SIDES,
    "crane": _HEIGHTWISE,
}
"""Noun of a move, as in "a pan left through a market" → ways after it that tell it from a thing."""
_GOING_ON = frozenset(
    {"along", "past", "through", "around", "over", "from", "into", "towards", "toward",
     "across", "between", "down", "showing", "revealing", "following", "with"}
)  # fmt: skip
"""What follows a side where it is the camera's; a truck left "on" a beach was left there."""
_PLAIN = frozenset({"pan", "tilt", "zoom", "dolly", "pedestal"})
"""Moves that a way alone tells: "pan across a desert", but not "truck across a desert"."""
_HOW = frozenset(
    {"smooth", "gentle", "whip", "swish", "crash", "snap", "steady", "subtle", "lateral",
     "horizontal", "vertical", "sideways", "short", "long", "continuous", "dramatic", "quick",
     "slow", "fast", "rapid", "graceful", "sweeping", "final", "camera"}
)  # fmt: skip
_SIDEWAYS = frozenset({"lateral", "sideways", "horizontal"})
_WAYS = frozenset(
    {"left", "right", "up", "down", "in", "out", "across", "over", "past", "along", "from",
     "to", "toward", "towards", "around", "through", "into", "upward", "upwards", "downward",
     "downwards", "forward", "back", "onto", "between"}
)  # fmt: skip
_ASKED = {"pan": ("left", "right"), "tilt": ("up", "down"), "zoom": ("in", "out"),
          "truck": ("left", "right"), "orbit": ("left", "right")}  # fmt: skip


def is_film(word: Word) -> bool:
    """Whether a word speaks of the camera or of a piece of film."""
    if word.pos is Pos.VERB:
        return word.role is Role.CAMERA_MOVE and word.meaning.form is VerbForm.BASE
    return word.role in FILM_ROLES or word.text in FILM_NOUNS


def silence(word: Word, pos: Pos = Pos.ADVERB) -> None:
    """Make a word one of grammar."""
    word.meaning, word.is_used = Meaning(Role.FUNCTION, pos), True


def speaks_of_film(words: Sequence[Word]) -> bool:
    """Whether one of the words is of the camera or of film."""
    return any(is_film(word) or word.text in FILMED for word in words)


def read_move(words: Sequence[Word], begin: int, end: int) -> None:
    """As in "Slow dolly past the desks", "a pull-out from a child": what the camera does."""
    at = begin
    has_determiner = words[at].pos is Pos.DETERMINER
    at += has_determiner
    first = at
    while at < end and _tells_how(words[at]):
        at += 1
    if at >= end:
        return
    follower = words[at + 1] if at + 1 < end else None
    if at > begin and _is_inward(words[at]) and follower is not None:
        if follower.text in _INWARD_OF:
            _order(words[begin:at], words[at], words[at].read_as(Role.CAMERA_MOVE))
        return
    if words[at].lemma not in _MOVES or words[at].text != words[at].lemma:
        return
    goes = follower is not None and follower.text.split()[0] in _WAYS
    is_paced = at > first
    is_plain = words[at].lemma in _PLAIN or (follower is not None and follower.text in _SIDES)
    if has_determiner:
        is_plain = _is_told_by_way(words[at:end])
    is_told = is_paced or is_plain or speaks_of_film(words[begin:end])
    if is_told and (goes or (is_paced and follower is None)):
        move = Meaning(Role.CAMERA_MOVE, Pos.VERB, _MOVES[words[at].lemma])
        _order(words[begin:at], words[at], move)


def _tells_how(word: Word) -> bool:
    return word.text in _HOW or word.role is Role.PACE


def _order(before: Sequence[Word], word: Word, move: Meaning | None) -> None:
    """Read a noun as what the camera is to do, and the words before it as how it does so."""
    value = None if move is None else move.value
    for one in before:
        pace = one.read_as(Role.PACE)
        if one.text in _SIDEWAYS:
            value = ("truck", None)
        if pace is None:
            silence(one)
        else:
            one.meaning = replace(pace, pos=Pos.ADVERB)
    word.mean(Meaning(Role.CAMERA_MOVE, Pos.VERB, value, VerbForm.BASE))


def _is_inward(word: Word) -> bool:
    """As in "push in", "slow pull out", "zoom out": to or from what is named."""
    move = word.read_as(Role.CAMERA_MOVE)
    is_known = move is not None and move.value[0] in ("zoom", "dolly")
    return is_known and word.text.split()[-1] in ("in", "out", "back", "away", "pullback")


_INWARD_OF = ("on", "from", "to", "onto", "into")


def _is_told_by_way(words: Sequence[Word]) -> bool:
    """Whether a noun after an article is a move: "a truck left past a fence", "a tilt up"."""
    lemma, follower = words[0].lemma, words[1].text.split()[0] if len(words) > 1 else ""
    if lemma in _OF_NO_THING:
        return follower in _WAYS
    if follower not in _AFTER_ARTICLE.get(lemma, ()):
        return False
    coming = [word.text.split()[0] for word in words[2:4]]
    goes_on = not coming or coming[0] in _GOING_ON or coming in (["to", "reveal"], ["to", "show"])
    return follower not in _SIDES or goes_on


def direct_moves(words: Sequence[Word]) -> None:
    """As in "a slow pan left", "the aerial shot rises": its direction; what has a verb."""
    for index, word in enumerate(words):
        if word.pos is not Pos.ADJUNCT or word.role not in (Role.CAMERA_MOVE, Role.VIEW):
            continue
        pace = words[index - 1].read_as(Role.PACE) if index else None
        if pace is not None and word.role is Role.CAMERA_MOVE:
            words[index - 1].meaning = replace(pace, pos=Pos.ADVERB)
        if word is words[-1]:
            return
        coming = words[index + 1]
        is_finite = coming.meaning.form is VerbForm.THIRD or coming.role is Role.FUNCTION
        if coming.pos is Pos.VERB and is_finite and coming.text.endswith("s"):
            word.meaning = replace(word.meaning, pos=Pos.NOUN)
        elif word.role is Role.CAMERA_MOVE and word.meaning.value[1] is None:
            way = coming.meaning.value if coming.role is Role.DIRECTION else coming.text
            if way in _ASKED.get(word.meaning.value[0], ()):
                word.meaning = replace(word.meaning, value=(word.meaning.value[0], way))
                silence(coming)
