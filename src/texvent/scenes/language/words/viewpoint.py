"""What carries the camera: "seen from the drone itself", "a camera on the bow of a kayak"."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.nouns import NOUNS

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
_MEANS = {"drive": "drive", "sail": "sail", "fly": "fly", "swim": "swim", "walk": "walk",
          "run": "run"}  # fmt: skip
"""Usual motion of what carries the camera → how the camera travels."""
_THROUGH = ("out of", "out", "through")
_FARTHEST = 5
_MOVING = frozenset({"moving", "speeding", "driving", "inside", "flying", "rolling"})
_MOUNTED = frozenset(
    {"mount", "attach", "fix", "place", "strap", "sit", "ride", "clip", "bolt", "position",
     "fasten", "perch", "be", "rig", "station", "stay", "film", "set"}
)  # fmt: skip
_FASTENED = frozenset({"mount", "attach", "fix", "strap", "clip", "bolt", "fasten", "rig"})
_ACTION_CAMERAS = ("gopro", "go pro", "action cam", "onboard")
_MOUNTS = ("on", "to", "in", "inside", "onto", "at", "aboard", "from", "under", "is")
_PARTS = frozenset(
    {"bow", "hood", "bonnet", "dashboard", "dash", "bumper", "windshield", "windscreen",
     "handlebar", "handlebars", "roof", "wing", "mast", "stern", "deck", "cockpit", "cab", "seat",
     "fender", "grille", "prow", "passenger seat", "car seat", "interior", "gondola", "basket"}
)  # fmt: skip
"""Parts of vehicles on which a camera is mounted."""
_WORN = frozenset(
    {"helmet", "chest", "head", "back", "shoulder", "forehead", "collar", "body", "wrist", "cap",
     "backpack", "eye", "eyes"}
)  # fmt: skip
"""Parts of bodies, and what is worn there."""
_FILMS = ("footage", "view", "shot", "video", "perspective")
_DASHCAM = ("dashcam", "dash cam", "dashboard cam")
_AHEAD = ("ahead", "forward", "forwards", "out")


def mark_viewpoints(words: Sequence[Word]) -> bool:
    """Mark what carries the camera, which is then not in the picture; the words change.

    Returns:
        Whether there is such a carrier.
    """
    for index, word in enumerate(words):
        if word.lemma in _CARRIERS and _looks_down(words[index + 1 :]):
            _mark([word], {word.lemma})
        if word.role is Role.CAMERA or word.text.startswith(_ACTION_CAMERAS):
            _read_mount(words, index)
        if word.text.startswith(_DASHCAM) or word.meaning.value == "first person":
            _read_own_view(words, index)
        if word.text in _THROUGH and (_is_view(words[:index]) or _looks(words[:index])):
            _look_out(words, index)
        if word.text != "from" or not _is_view(words[:index]):
            continue
        after = _take_phrase(words[index + 1 :])
        texts = [one.text for one in after]
        lemmas = {part for one in after for part in one.lemma.split()}
        carried = lemmas & _CARRIERS
        if "itself" in texts or _WINDOW in lemmas:
            _mark(words, carried)
            _mark(after, {_WINDOW} if carried else set())
        elif any(text.split()[-1] in _SEATS for text in texts):
            own = {one.lemma for one in words if one.lemma in _CARRIERS}
            _mark(words, carried or set(sorted(own)[:1]))
            _mark(after, {one.lemma for one in after if one.text.split()[-1] in _SEATS})
        elif carried and _MOVING & set(texts):
            _mark(after, carried)
            _take_in(after, _MOVING)
    return any(word.is_viewpoint for word in words)


def find_means(words: Sequence[Word]) -> str | None:
    """How what carries the camera goes, or "window" where it looks out sideways; None = unknown."""
    carriers = [word for word in words if word.is_viewpoint]
    if any(_WINDOW in word.lemma.split() for word in carriers):
        return _WINDOW
    nouns = [NOUNS[value] for one in carriers if (value := _value(one) or "") in NOUNS]
    return next((_MEANS[noun.motion] for noun in nouns if noun.motion in _MEANS), None)


def _look_out(words: Sequence[Word], index: int) -> None:
    """As in "view out of a train window", "looking through the window of a bus"."""
    after = _take_phrase(words[index + 1 :])
    parts = {part for one in after for part in one.lemma.split()}
    if _WINDOW in parts and parts & _CARRIERS:
        glass = {one.lemma for one in after if _WINDOW in one.lemma.split()}
        _mark(after, glass | (parts & _CARRIERS))
        _take_in([words[index], *after], {_WINDOW} | _MOVING)
        words[index].is_used = True
        for one in words[max(index - 1, 0) : index]:
            one.is_used = one.is_used or one.lemma in _LOOKING


def _looks(before: Sequence[Word]) -> bool:
    """As in "looking out of the window of a train", where it is not said who looks."""
    is_alone = not any(one.pos is Pos.NOUN for one in before)
    return bool(before) and is_alone and before[-1].lemma in _LOOKING


def _read_mount(words: Sequence[Word], index: int) -> None:
    """As in "a camera mounted on the bow of a kayak", "the camera sits inside the car"."""
    at = index + 1
    while at < len(words) and (
        words[at].lemma in _MOUNTED
        or words[at].text in _FILMS
        or words[at].pos in (Pos.AUXILIARY, Pos.ADVERB)
    ):
        at += 1
    is_it = at > index + 1 and words[at - 1].text == "is"
    if at >= len(words) or not (words[at].text in _MOUNTS or is_it):
        return
    phrase = _take_phrase(words[at : at + 1]) + _take_phrase(words[at + 1 :])
    lemmas = {part for one in phrase for part in (one.lemma, one.text.split()[-1])}
    is_part, is_worn = bool(lemmas & _PARTS), bool(lemmas & _WORN)
    is_riding = any(one.lemma == "ride" for one in words[index + 1 : at])
    is_fixed = any(one.lemma in _FASTENED for one in words[index + 1 : at])
    is_fixed |= words[index].text.startswith(_ACTION_CAMERAS)
    is_inside = words[at].text in ("inside", "aboard") or is_riding or is_fixed
    own = [one for one in phrase if (_is_living if is_worn else _is_vehicle)(one)]
    if not own and (is_part or is_worn):
        own = [one for one in words if (_is_living if is_worn else _is_vehicle)(one)][:1]
    if not own or not (is_part or is_worn or is_inside):
        return
    kinds = {_value(one) for one in own} | {_value(words[index])} - {None}
    for word in words:
        if _value(word) in kinds:
            word.is_viewpoint = True
    _take_in([words[at], *phrase], _PARTS | _WORN | set(_MOUNTS))
    for one, coming in zip(words[at:], words[at + 1 :], strict=False):
        if one.lemma in _LOOKING and coming.text in _AHEAD:
            _take_in([one, coming], {one.lemma, coming.lemma})


def _read_own_view(words: Sequence[Word], index: int) -> None:
    """As in "dashcam view of a car driving", "POV of a skier": who looks is not in the picture."""
    is_dashcam = words[index].text.startswith(_DASHCAM)
    if is_dashcam:
        _mark_own_car(words[index:])
    if index + 1 < len(words) and words[index + 1].text in ("of", "from"):
        after = _take_phrase(words[index + 2 :])
    elif words[index].text.endswith(" of"):
        after = _take_phrase(words[index + 1 :])
    else:
        before = words[index - 1] if index else None
        after = [before] if before is not None and before.is_possessive else []
    for one in after:
        if one.pos is Pos.VERB:
            return
        if one.pos is Pos.NOUN:
            is_car = _value(one) in ("car", "van")
            if is_car if is_dashcam else (_is_living(one) or _is_vehicle(one)):
                one.is_viewpoint = True
            return


def _mark_own_car(after: Sequence[Word]) -> None:
    """As in "a dashcam view of a road. The car brakes": the one with the camera."""
    cars = [number for number, one in enumerate(after) if _value(one) in ("car", "van")]
    if cars and cars[0] and after[cars[0] - 1].text == "the":
        after[cars[0]].is_viewpoint = True


def _take_in(words: Sequence[Word], taken: frozenset[str] | set[str]) -> None:
    """These words say where the camera is, and need no effect of their own."""
    for word in words:
        if word.is_viewpoint:
            continue
        if word.lemma in taken or word.text.split()[-1] in taken:
            role = Role.CAMERA if word.pos is Pos.NOUN else Role.FUNCTION
            pos = Pos.NOUN if word.pos is Pos.NOUN else Pos.ADVERB
            if word.pos is not Pos.PREPOSITION:
                word.mean(Meaning(role, pos))
            word.is_used = True


def _value(word: Word) -> str | None:
    meaning = word.read_as(Role.NOUN)
    return None if meaning is None or word.pos is not Pos.NOUN else str(meaning.value)


def _is_vehicle(word: Word) -> bool:
    noun = NOUNS.get(_value(word) or "")
    return word.lemma in _CARRIERS or (
        noun is not None and noun.motion in ("drive", "sail") and noun.speed_m_s > 0.0
    )


def _is_living(word: Word) -> bool:
    noun = NOUNS.get(_value(word) or "")
    return (
        noun is not None and noun.name != "hand" and noun.motion in ("walk", "run", "swim", "ski")
    )


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
    looks = any(one.lemma in _LOOKING or one.text in _AHEAD for one in before[-_NEAR:])
    is_camera = looks and any(one.is_viewpoint for one in before)
    return is_camera or any(one.lemma in _VIEWING for one in before[-_NEAR:])


def _mark(words: Sequence[Word], lemmas: set[str]) -> None:
    for word in words:
        if word.lemma in lemmas and word.read_as(Role.NOUN) is not None:
            word.is_viewpoint = True
