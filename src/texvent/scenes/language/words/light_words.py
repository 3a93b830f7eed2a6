"""Words of light: "warm evening light", "hard sunlight from the left", "backlit", "a dim room".

Beside a noun of light they say how the scene is lit; elsewhere they mean something else: "a warm
coat", "a soft toy", "cold water".
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace

from texvent.scenes.colours import TINTS
from texvent.scenes.description import Illumination, NamedColour
from texvent.scenes.language.vocabulary import light as vocabulary
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word, mark_used

Quality = tuple[str, str]
"""Which side of the light is described, as a field of `Illumination`, and how it is."""


_TABLES = {
    "tint": vocabulary.TINTS,
    "hardness": vocabulary.HARDNESSES,
    "brightness": vocabulary.BRIGHTNESSES,
    "direction": vocabulary.DIRECTIONS,
}


def _list_qualities() -> Iterator[tuple[str, Quality]]:
    for side, table in _TABLES.items():
        for value, words in table.items():
            yield from ((word, (side, value)) for word in words)
    yield from ((word, ("tint", word)) for word in vocabulary.COLOURED)
    yield from ((word, ("height", "low")) for word in vocabulary.LOW)


_QUALITIES = dict(_list_qualities())
_WARM = frozenset({"warm", "golden", "orange", "yellow", "red"})
_COLD = frozenset({"cold", "blue", "cyan", "turquoise", "teal", "indigo"})
"""Tints that go together: "cold blue light"."""
_BRIGHTNESS = frozenset({"brightness"})
_ALL = frozenset({"tint", "hardness", "brightness", "direction", "height"})
_PASSED = frozenset({Role.LIGHT, Role.CLOUDS, Role.PLACE, Role.COLOUR, Role.SHADE, Role.SNOW,
                     Role.WEATHER, Role.PACE})  # fmt: skip
"""Roles of words that may stand between an adjective and its light: "warm evening light"."""
_OVER_ALL = frozenset({"in", "under", "by", "into", "beneath"})
"""Prepositions after which the light is that of the scene, not a lamp."""
_FROM = re.compile(
    r"from (?:directly |straight |high |just )?(?:the |one |a |his |her )?"
    rf"({'|'.join(vocabulary.FROM)})(?: side)?"
)
_DIM = frozenset(vocabulary.BRIGHTNESSES["dim"] + vocabulary.BRIGHTNESSES["gloomy"])
_HARD = frozenset(vocabulary.HARDNESSES["hard"])
_OTHERS = frozenset({Role.NOUN, Role.VIEW, Role.FRAMING})
"""Roles of words that are no adjectives of light: "a low angle, morning light"."""
_SIGNALS = frozenset({"red", "green", "yellow", "orange"})
"""Colours of traffic lights, which "the light" and "a light" may be."""
_MOST_PASSED = 3
_LONGEST = 5
"""Words of a phrase that says where light comes from."""
_SUNS = frozenset({"sun", "low sun", "rising sun", "setting sun", "bright sun"})
_WHO = frozenset({"him", "her", "it", "them", "the camera"})


def read_light_words(words: list[Word]) -> Illumination:
    """Tell which words say how the light is; the words change.

    Returns:
        What they say; the rest of it is open.
    """
    reader = _Reader(words)
    index = 0
    while index < len(words):
        reader.read(index)
        index += 1
    return reader.build()


class _Reader:
    """Collects what is said of the light; the first word for each of its sides wins."""

    def __init__(self, words: list[Word]) -> None:
        self._words = words
        self._said: dict[str, str] = {}

    def build(self) -> Illumination:
        """The light as said."""
        tint = self._said.get("tint")
        return Illumination(
            kind=self._said.get("kind"),
            tint=None if tint is None else NamedColour(tint, TINTS[tint]),
            hardness=self._said.get("hardness"),
            brightness=self._said.get("brightness"),
            direction=self._said.get("direction"),
            is_low="height" in self._said,
        )

    def read(self, index: int) -> None:
        """A word that is a noun of light, or says by itself how the light is."""
        word = self._words[index]
        if word.text in vocabulary.BACKLIGHTS:
            self._take(word, ("direction", "back"))
            self._read_before(index, _ALL)
        elif word.text in vocabulary.LIT and word.role is Role.UNKNOWN:
            if self._read_origin(index + 1):
                _silence(word)
        elif word.role is Role.LIGHT and word.text in _DIM:
            self._take(word, _QUALITIES[word.text])
            if word.text == "gloomy":
                self._said.setdefault("kind", "overcast")
        elif word.role is Role.SHADOW and index and self._words[index - 1].text in _HARD:
            self._take(self._words[index - 1], ("hardness", "hard"))
        elif word.role is Role.PLACE or word.text in vocabulary.TIMES:
            self._read_before(index, _BRIGHTNESS)
            self._read_copula(index + 1, _BRIGHTNESS)
        else:
            self._read_light(index)

    def _read_light(self, index: int) -> None:
        word = self._words[index]
        glow = word.read_as(Role.GLOW)
        is_last = index + 1 == len(self._words) or self._words[index + 1].pos is Pos.SIGN
        if glow is not None and is_last and index and self._words[index - 1].role is Role.LIGHT:
            word.meaning = glow  # "in harsh midday light", where it might be a verb
        is_source = word.text in vocabulary.SOURCES or word.text in vocabulary.GLOWS
        if not is_source or word.role not in (Role.GLOW, Role.LIGHT) or self._is_of_thing(index):
            return
        opening = self._find_opening(index)
        if opening is None or not self._lights_all(opening, word):
            return
        has_article = opening >= 0 and self._words[opening].pos is Pos.DETERMINER
        found = self._read_before(index, _ALL, signals=not has_article)
        found = self._read_origin(index + 1) or found
        found = self._read_copula(index + 1, _ALL) or found
        is_of_time = index > 0 and self._words[index - 1].role is Role.LIGHT
        if (found and word.role is Role.GLOW) or (is_of_time and word.text in _SUNS):
            word.is_used = True

    def _is_of_thing(self, index: int) -> bool:
        """As in "the front light of the bicycle"; not "the soft light of dawn"."""
        after = self._words[index + 1 : index + 5]
        if not after or after[0].text != "of":
            return False
        return not any(
            one.role is Role.LIGHT or one.text in vocabulary.FIXTURES for one in after[1:]
        )

    def _find_opening(self, index: int) -> int | None:
        """What stands before a noun and its adjectives, -1 = nothing; None = it is a thing's.

        "A blue police light" is no light of the scene.
        """
        at = index - 1
        while at >= 0 and self._words[at].pos in (Pos.ADJECTIVE, Pos.NOUN, Pos.ADJUNCT):
            one = self._words[at]
            is_thing = one.role is Role.NOUN and one.text not in vocabulary.FIXTURES
            if is_thing or one.text == "only":
                return None
            at -= 1
        return at

    def _lights_all(self, opening: int, word: Word) -> bool:
        """Whether it is no lamp: "a police car with a blue light", "red lights"."""
        first = self._words[opening] if opening >= 0 else None
        before = self._words[opening - 1] if opening > 0 else None
        is_over_all = any(one is not None and one.text in _OVER_ALL for one in (first, before))
        if word.text == "lights":
            return is_over_all
        if first is None or first.pos not in (Pos.DETERMINER, Pos.NUMBER):
            return True
        return first.text == "the" or is_over_all or word.role is Role.LIGHT

    def _read_before(self, index: int, sides: frozenset[str], *, signals: bool = True) -> bool:
        """The adjectives before a noun; whether one says how the light is.

        Args:
            index: of the noun.
            sides: of the light that they may describe.
            signals: whether colours of traffic lights may be meant.
        """
        found, at = False, index - 1
        while at >= 0:
            word = self._words[at]
            quality = _QUALITIES.get(word.text)
            is_other = word.role in _OTHERS or (word.text in _SIGNALS and not signals)
            if quality is not None and quality[0] in sides and not is_other:
                found = self._take(word, quality) or found
            elif word.text in vocabulary.CLOUDED and sides is _ALL:
                word.mean(Meaning(Role.LIGHT, Pos.ADJECTIVE, "overcast"))
                found = True
            elif not self._is_between(at, index) or (
                sides is _BRIGHTNESS and word.role is Role.COLOUR
            ):
                break
            at -= 1
        return found

    def _is_between(self, at: int, index: int) -> bool:
        """Whether a word may stand among the adjectives of the noun at `index`."""
        word = self._words[at]
        if word.text in ("and", ","):
            before = self._words[at - 1] if at else None
            is_listed = before is not None and before.text in _QUALITIES
            return is_listed and at + 1 < index
        is_adjective = word.pos is Pos.ADJECTIVE and word.role is not Role.NOUN
        return (
            is_adjective
            or word.role in _PASSED
            or word.text in vocabulary.FIXTURES
            or word.text in vocabulary.SEASONS
        )

    def _read_copula(self, at: int, sides: frozenset[str]) -> bool:
        """As in "the light is soft and warm"."""
        words, found = self._words, False
        if at >= len(words) or words[at].text not in ("is", "was", "looks", "stays"):
            return False
        at += 1
        while at < len(words):
            quality = _QUALITIES.get(words[at].text)
            if quality is not None and quality[0] in sides and words[at].text not in _SIGNALS:
                found = self._take(words[at], quality) or found
            elif words[at].text not in ("and", ","):
                break
            at += 1
        return found

    def _read_origin(self, at: int) -> bool:
        """As in "light comes from the left", "the sun is low behind them"."""
        words = self._words
        is_sun = words[at - 1].text in _SUNS
        passed: list[Word] = []
        while at < len(words) and len(passed) < _MOST_PASSED and _is_arrival(words[at]):
            passed.append(words[at])
            at += 1
        coming = [one.text for one in words[at : at + 2]]
        if is_sun and coming[:1] == ["behind"] and coming[-1] in _WHO:
            return self._merge(at, 2, "back", passed)
        for length in range(min(_LONGEST, len(words) - at), 0, -1):
            match = _FROM.fullmatch(" ".join(one.text for one in words[at : at + length]))
            follower = words[at + length] if at + length < len(words) else None
            is_whole = follower is None or (follower.text != "of" and follower.pos is not Pos.NOUN)
            if match is not None and is_whole:
                return self._merge(at, length, vocabulary.FROM[match[1]], passed)
        low = next((one for one in passed if one.text == "low"), None)
        return is_sun and low is not None and self._take(low, ("height", "low"))

    def _merge(self, at: int, length: int, direction: str, passed: Sequence[Word]) -> bool:
        """Make one word of a phrase that says where light comes from."""
        words = self._words
        tokens = tuple(token for one in words[at : at + length] for token in one.tokens)
        words[at : at + length] = [replace(words[at], tokens=tokens)]
        for one in passed:
            if one.text == "low":
                self._take(one, ("height", "low"))
            else:
                _silence(one)
        return self._take(words[at], ("direction", direction))

    def _take(self, word: Word, quality: Quality) -> bool:
        """Take a word, unless another one says something else."""
        side, value = quality
        said = self._said.setdefault(side, value)
        if said != value and not any({said, value} <= one for one in (_WARM, _COLD)):
            return False
        value = said
        is_phrase = side == "direction" and " " in word.text
        pos = Pos.ADVERB if is_phrase else Pos.ADJECTIVE
        word.mean(Meaning(Role.LIGHTING, pos, value))
        mark_used([word])
        return True


def _is_arrival(word: Word) -> bool:
    """Between light and where it comes from: "streams in", "hangs low"."""
    return word.lemma in vocabulary.ARRIVALS or word.text in ("is", "in", "hangs", "low")


def _silence(word: Word) -> None:
    word.mean(Meaning(Role.FUNCTION, Pos.ADVERB))
    word.is_used = True
