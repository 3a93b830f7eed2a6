"""Nouns with several senses, and the words beside which each of them is meant."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Lexicon, Meaning, Role
from texvent.scenes.language.words.word import Word


class Sense(NamedTuple):
    """What a noun means where one of the cues is said."""

    cues: frozenset[str]
    """Base forms of words."""
    phrase: str | None
    """Phrase of the lexicon for it; None = nothing that is shown."""


def _sense(cues: str, phrase: str | None = None) -> Sense:
    return Sense(frozenset(cues.split()), phrase)


SENSES: dict[str, tuple[Sense, ...]] = {
    "lane": (
        _sense("bowling pin bowler skittle", "bowling alley"),
        _sense("swim swimmer pool swimming"),
    ),
    "court": (
        _sense("tennis badminton clay baseline", "tennis court"),
        _sense("basketball hoop dunk", "basketball court"),
        _sense("judge lawyer trial king queen"),
    ),
    "tower": (_sense("block card cup brick dice domino stack stacking crate lego pile jenga can"),),
    "board": (
        _sense("surfer wave surf surfing", "surfboard"),
        _sense("chess checkers", "chessboard"),
    ),
    "club": (
        _sense("golf golfer caddie", "golf club"),
        _sense("dance dancer dj nightclub strobe dancing", "nightclub"),
        _sense("student member book"),
    ),
    "track": (
        _sense("train locomotive rail railway tram", "railway"),
        _sense("racing race car motorcycle kart", "race track"),
        _sense("song music album animal"),
    ),
    "bat": (
        _sense("baseball batter pitcher inning homer", "baseball bat"),
        _sense("cricket cricketer wicket", "cricket bat"),
    ),
    "crane": (_sense("bird wing marsh nest feather wetland heron flock beak"),),
    "mouse": (_sense("computer click laptop monitor cursor", "computer mouse"),),
    "ring": (
        _sense("boxer boxing fighter wrestler referee punch", "boxing ring"),
        _sense("circus phone bell"),
    ),
    "stage": (_sense("rocket booster race launch"),),
    "bar": (
        _sense("iron metal steel gold blacksmith anvil gymnast chocolate candy barbell weight soap"
               " pull-up forge glowing"),
    ),
    "bank": (_sense("money robber teller customer cash vault"),),
    "flat": (_sense("flat"),),
    "pitch": (_sense("throw pitcher voice"),),
    "plant": (_sense("power nuclear factory chemical"),),
    "tripod": (_sense("camera shot filmed film view recording"),),
    "coach": (_sense("team player match game school child kid practice training whistle soccer"),),
    "carton": (_sense("milk juice cream egg"),),
}  # fmt: skip
"""Noun → its senses other than the usual one; the first whose cue is said counts."""
PARTICLES: dict[str, frozenset[str]] = {
    "call": frozenset({"out", "for", "off"}),
    "show": frozenset({"off"}),
    "track": frozenset({"down"}),
    "duck": frozenset({"under", "down", "behind", "out"}),
    "break": frozenset({"into"}),
    "fish": frozenset({"out"}),
    "bear": frozenset({"down"}),
    "put": frozenset({"on", "away", "down", "out", "up"}),
    "putt": frozenset({"on", "away", "down", "out", "up"}),
    "push": frozenset({"out"}),
}
"""Verb → particles with which it is none of what the word shows alone."""

_SHAPES = frozenset({"circle", "ring", "square", "triangle", "disc", "line"})
"""What "of" makes an arrangement: "a circle of friends"."""
_RUN_ALONG = frozenset({"thumb", "hand", "finger", "fingertip", "palm", "eye", "brush", "tongue"})
"""Objects with which "run" is no running: "runs his thumb along the edge"."""
_BECOMING = frozenset({"shrink", "dwindle", "reduce", "fade", "melt", "blur"})
"""Verbs of what comes to look like something that is not there: "shrink to dots"."""


def choose_senses(words: Sequence[Word], known: Lexicon) -> None:
    """Give nouns with several senses the one that the other words of the prompt tell.

    Nouns in a sense that is not shown, and verbs with a particle, lose their meaning: "a tower of
    cards", "call out". The words change.
    """
    said = {word.lemma for word in words} | {part for word in words for part in word.text.split()}
    for index, word in enumerate(words):
        follower = words[index + 1] if index + 1 < len(words) else None
        is_particle = follower is not None and follower.text in PARTICLES.get(word.lemma, ())
        if is_particle and word.pos is Pos.VERB:
            _forget(word, Pos.VERB)
        if word.lemma in _BECOMING and follower is not None and follower.text in ("to", "into"):
            _forget_result(words[index + 2 :])
        if word.lemma == "run" and _RUN_ALONG & {one.lemma for one in words[index + 1 : index + 4]}:
            _forget(word, Pos.VERB)
        if word.lemma in _SHAPES and follower is not None and follower.text == "of":
            _forget(word, Pos.NOUN)
        if word.pos is Pos.NOUN and word.lemma in SENSES:
            _choose_noun(word, follower, said - {word.lemma, word.text}, known)


def _choose_noun(word: Word, follower: Word | None, others: set[str], known: Lexicon) -> None:
    if word.lemma == "flat":
        if follower is not None and follower.pos is Pos.NOUN:
            _forget(word, Pos.ADJECTIVE)
        return
    sense = next((one for one in SENSES[word.lemma] if one.cues & others), None)
    if sense is None:
        return
    found = known.find(sense.phrase.split())[1] if sense.phrase is not None else []
    if not found:
        _forget(word, Pos.NOUN)
    else:
        word.meaning, word.others = found[0], tuple(found[1:])


def _forget_result(after: Sequence[Word]) -> None:
    for word in after:
        if word.pos is Pos.NOUN:
            _forget(word, Pos.NOUN)
        elif word.pos not in (Pos.DETERMINER, Pos.ADJECTIVE, Pos.NUMBER):
            return


def _forget(word: Word, pos: Pos) -> None:
    """The word is known, but shows nothing."""
    form = word.meaning.form if pos is Pos.VERB else None
    word.is_lost = True
    word.meaning, word.others = Meaning(Role.UNKNOWN, pos, form=form), ()
