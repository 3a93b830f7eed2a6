"""What the nouns of a prompt tell of its place: seen from outside, inside or outdoors."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import zip_longest

from texvent.scenes.language.vocabulary.place_cues import (
    APPROACHES,
    BUILDINGS,
    ENCLOSED,
    FARM_CUES,
    FIELD_ACTS,
    FIELD_WORKERS,
    FOOD_ACTS,
    FOODS,
    INDOOR_CUES,
    KITCHEN_ACTS,
    OUTDOOR_CUES,
    OUTDOOR_LIGHTS,
    OUTSIDE,
    OWN_GROUND,
)
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word

_FARTHEST = 6
"""Most words between a preposition and the place that it is about: "past a row of shops"."""
_LOOKED_OUT_OF = frozenset({"window", "floor"})
"""Where a camera stands that looks outside: "a camera in a third-floor window"."""
_BETWEEN = (Pos.DETERMINER, Pos.ADJECTIVE, Pos.NOUN, Pos.NUMBER)


@dataclass(frozen=True)
class PlaceCues:
    """What the words tell of a place that the prompt does not say."""

    outdoor: str | None = None
    """The outdoor place that they tell of; None = none."""
    indoor: str | None = None
    """The enclosed place that they tell of; None = none."""

    @property
    def is_outdoors(self) -> bool:
        """Whether all that is told is outdoors."""
        return self.outdoor is not None and self.indoor is None

    @property
    def is_indoors(self) -> bool:
        """Whether all that is told is inside."""
        return self.indoor is not None and self.outdoor is None


NO_CUES = PlaceCues()


def read_outsides(words: Sequence[Word]) -> bool:
    """Read enclosed places that are seen from outside as things, or not at all.

    As in "past a row of shops", "outside a cafe", "leaves the station"; and all in the plural,
    because a scene is in one of them. The words change.

    Returns:
        Whether a building is seen from outside.
    """
    is_any = False
    for index, word in enumerate(words):
        place = word.read_as(Role.PLACE)
        if place is None or place.value not in ENCLOSED:
            continue
        is_plural = word.text != word.lemma and word.text.endswith("s")
        if not is_plural and (word.lemma in OWN_GROUND or not _is_outside(words, index)):
            continue
        is_any = is_any or place.value in BUILDINGS
        thing = word.read_as(Role.NOUN)
        word.others = tuple(
            one for one in (word.meaning, *word.others)
            if one.role is not Role.PLACE and one is not thing
        )  # fmt: skip
        word.meaning = thing or Meaning(Role.UNKNOWN, Pos.NOUN, None)
    return is_any


def read_titles(words: Sequence[Word]) -> None:
    """Read a place that is all the prompt is about as that place, not as a building.

    As in "restaurant", "an office with two desks". The words change.
    """
    for index, word in enumerate(words):
        place = word.read_as(Role.PLACE)
        thing = word.read_as(Role.NOUN)
        is_title = thing is not None and thing.is_substitute
        is_title = is_title and place is not None and place.value in _TITLES
        if place is None or place.is_substitute or not is_title:
            if word.pos in _BEFORE_TITLE or word.text in _TITLE_WORDS:
                continue
            return
        if index and words[0].text == "the" and "of" not in [one.text for one in words[:index]]:
            return
        after = words[index + 1] if index + 1 < len(words) else None
        if after is None or after.text in _AFTER_TITLE or not after.text.isalpha():
            word.meaning = place
            word.others = tuple(one for one in word.others if one is not thing)
        return


_TITLES = (ENCLOSED - {"hospital room", "museum", "church hall", "indoor", "stage"}) | {
    "museum", "campus", "baseball field", "golf course"}  # fmt: skip
"""Places that a prompt may be about as a whole; hospitals and churches are known from outside."""
_BEFORE_TITLE = (Pos.DETERMINER, Pos.ADJECTIVE, Pos.NUMBER)
_TITLE_WORDS = frozenset({"indoor", "inside", "interior", "view", "of", "a", "an", "the", "in",
                          "photo", "picture", "image", "video", "scene"})  # fmt: skip
_AFTER_TITLE = frozenset({"with", "filled", "full", "interior", "that", "in", "at", "by", "during",
                          "under"})  # fmt: skip


def _is_outside(words: Sequence[Word], index: int) -> bool:
    for word in reversed(words[max(index - _FARTHEST, 0) : index]):
        if word.text in OUTSIDE or (word.pos is Pos.VERB and word.lemma in APPROACHES):
            return True
        if word.pos not in _BETWEEN and word.text != "of":
            return False
    return False


def find_cues(words: Sequence[Word], *, is_outside: bool) -> PlaceCues:
    """What the nouns tell of the place.

    Args:
        words: the prompt.
        is_outside: whether a building is seen from outside.
    """
    said = {word.lemma for word in words if word.pos in (Pos.NOUN, Pos.ADVERB, Pos.ADJECTIVE)}
    said |= {word.lemma for word in words if word.read_as(Role.NOUN) and word.pos is not Pos.VERB}
    said -= {word.lemma for word in words if word.role is Role.CAMERA} & _LOOKED_OUT_OF
    is_fair = bool(_list_outdoors(words)) or any(
        word.role in (Role.WEATHER, Role.SKY, Role.CLOUDS) for word in words
    )
    is_fair = is_fair or any(
        word.role is Role.LIGHT
        and (word.meaning.value in ("sunny", "moonlight") or word.lemma in OUTDOOR_LIGHTS)
        for word in words
    )
    if "window" in said:
        # As in "rain on a window": seen from either side.
        said, is_fair = said - OUTDOOR_CUES["grass"], False
    outdoor = _find(said, OUTDOOR_CUES)
    if outdoor in (None, "grass") and is_outside:
        outdoor = "farmyard" if said & FARM_CUES else "city"
    outdoor = outdoor or ("grass" if is_fair else None)
    return _read_acts(words, said, PlaceCues(outdoor, _find(said, INDOOR_CUES)))


def use_outdoors(words: Sequence[Word], place: str | None, cues: PlaceCues) -> None:
    """Count "outside", "outdoor" as shown where nothing puts the scene into a room.

    Args:
        words: the prompt; those words change.
        place: the place that it says.
        cues: what else it tells.
    """
    if place in ENCLOSED or not cues.is_outdoors:
        return
    for word in _list_outdoors(words):
        word.is_used = not word.is_lost or word.pos is Pos.PREPOSITION
        word.is_lost = not word.is_used


def _list_outdoors(words: Sequence[Word]) -> list[Word]:
    """As "outdoor", and "outside" that is before no noun."""
    return [
        word
        for word, after in zip_longest(words, words[1:])
        if word.text == "outdoor"
        or (word.text == "outside" and (after is None or after.pos not in (*_BETWEEN, Pos.PRONOUN)))
    ]


def _read_acts(words: Sequence[Word], said: set[str], cues: PlaceCues) -> PlaceCues:
    """With what the verbs tell: who ploughs is in a field, and who whisks in a kitchen."""
    done = {word.lemma for word in words if word.pos is Pos.VERB}
    if cues.outdoor in (None, "grass") and said & FIELD_WORKERS:
        cues = replace(cues, outdoor=_find(done, FIELD_ACTS) or cues.outdoor)
    cooks = done & KITCHEN_ACTS or (done & FOOD_ACTS and said & FOODS)
    if cooks and cues.outdoor is None and cues.indoor in (None, "indoor"):
        return replace(cues, indoor="kitchen")
    return cues


def _find(said: set[str], cues: dict[str, frozenset[str]]) -> str | None:
    return next((place for place, nouns in cues.items() if said & nouns), None)
