"""What carries the camera: "seen from the drone itself", "from the window of a train"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word

_CARRIERS = frozenset(
    {"drone", "train", "car", "bus", "taxi", "truck", "tram", "helicopter", "airplane", "plane",
     "boat", "motorcycle", "bicycle", "van", "cab", "limousine", "bird", "jeep", "tractor", "kayak"}
)  # fmt: skip
_SEATS = frozenset({"seat", "cockpit", "cab"})
_VIEWING = frozenset({"see", "film", "shoot", "view", "record", "shot", "footage", "video"})
_LOOKING = frozenset({"look", "point", "face", "aim"})
_NEAR = 3
"""Words before "from" of which one says that it is a view."""
_WINDOW = "window"
_FARTHEST = 5


def mark_viewpoints(words: Sequence[Word]) -> bool:
    """Mark what carries the camera, which is then not in the picture; the words change.

    Returns:
        Whether there is such a carrier.
    """
    for index, word in enumerate(words):
        if word.lemma in _CARRIERS and _looks_down(words[index + 1 :]):
            _mark([word], {word.lemma})
        if word.text != "from" or not _is_view(words[:index]):
            continue
        after = _take_phrase(words[index + 1 :])
        texts = [one.text for one in after]
        lemmas = {one.lemma for one in after}
        carried = lemmas & _CARRIERS
        if "itself" in texts or _WINDOW in lemmas:
            _mark(words, carried)
            _mark(after, {_WINDOW} if carried else set())
        elif any(text.split()[-1] in _SEATS for text in texts):
            own = {one.lemma for one in words if one.lemma in _CARRIERS}
            _mark(words, carried or set(sorted(own)[:1]))
            _mark(after, {one.lemma for one in after if one.text.split()[-1] in _SEATS})
    return any(word.is_viewpoint for word in words)


def _take_phrase(words: Sequence[Word]) -> list[Word]:
    found = []
    for word in words[: _FARTHEST + 2]:
        if word.text in (",", ".", ";", "and"):
            break
        found.append(word)
    return found


def _looks_down(after: Sequence[Word]) -> bool:
    """As in "a drone looking straight down at a roundabout"."""
    texts = [one.text for one in after[:_NEAR]]
    return bool(after) and after[0].lemma in _LOOKING and "down" in texts


def _is_view(before: Sequence[Word]) -> bool:
    """Whether it is seen or filmed from there, unlike "jumps from there"."""
    return any(one.lemma in _VIEWING for one in before[-_NEAR:])


def _mark(words: Sequence[Word], lemmas: set[str]) -> None:
    for word in words:
        if word.lemma in lemmas and word.read_as(Role.NOUN) is not None:
            word.is_viewpoint = True
