"""Verbs whose sense is another one than the act that the scene has for them."""

from __future__ import annotations

import re

from texvent.scenes.description import Claim, SceneDescription
from texvent.scenes.models.nouns import FAMILIES, NOUNS
from texvent.scenes.models.people.activities import DONE_SEATED, HAND_NOUNS, PERSON_NOUNS, SEATS

_OBJECTS = frozenset({"it", "him", "her", "them"})
_DETERMINERS = frozenset({"his", "her", "its", "their", "the", "a", "an"})
_AFTER_OBJECT = re.compile(
    r"^($|[.,;!?]|once|twice|again|around|round|slowly|quickly|gently|and|then|while|as|in|on|over"
    r"|under|with|to|into|between|by|at|before|across|through)"
)
_TURNING = re.compile(r"(twirl|spin|turn|rotat|whirl|swing|roll|flip)\w*")
_AT_REST = re.compile(r"(hang|hung|rest)\w*")
_FALLING = re.compile(r"(fall|fell)\w*")
_SITTING = re.compile(r"sit|sits|sat|sitting|seated")
_GRASPING = re.compile(r"(grab|seiz|snatch|bring|brought)\w*")
_FLAPPING = frozenset(
    noun.name
    for family in ("animals flying birds", "animals coloured birds")
    for noun in FAMILIES[family]
    if noun.motion == "fly"
)
_ON_FOOT = {"walk", "run"}
"""How who brings something comes with it; who grabs it has it in hand only then."""
_BACKWARD = ("backward", "backwards", "back")
_WINGS = re.compile(r"(glid|soar)\w*")
_ON_LEGS = re.compile(r"waddl\w*")
_BY_HAND = re.compile(r"(tap|typ|press|click|rest|touch|grasp|grab|grip|pok)\w*")
_AIRBORNE = re.compile(r"(catch|caught|throw|threw|thrown|toss|hurl|climb)\w*")
_MOUTH = re.compile(r"(laugh|giggl|chuckl|smil|grin)\w*")


def judge_sense(claim: Claim, description: SceneDescription) -> str | None:
    """Why the act shown for a verb is not what the verb says, or None.

    Args:
        claim: a verb of an object.
        description: the prompt as it was understood.
    """
    kinds = {_kind(description, index, claim.motion) for index in claim.things}
    rests = _rests(claim.word, description.prompt.casefold())
    plain = _judge_word(claim, description, kinds, rests)
    if plain is not None:
        return plain
    for rest in rests:
        first, _, after = rest.partition(" ")
        word = first.strip(".,;!?")
        is_turning = not claim.relations and _TURNING.fullmatch(claim.word) is not None
        if is_turning and _is_alive(claim, description):
            is_done_to = word in _OBJECTS and (word != "her" or _AFTER_OBJECT.match(after))
            if is_done_to or ("spin" in kinds and word in _DETERMINERS):
                return "it is not done to " + (word if is_done_to else after.split(" ")[0])
    return None


_WITH_ITS_OWN = frozenset({"punch", "climb rope", "rock climb"})
"""Motions that need nothing, or bring what they are done with."""


def _nouns(claim: Claim, description: SceneDescription) -> list[str]:
    return [description.objects[index].noun for index in claim.things]


def _is_alive(claim: Claim, description: SceneDescription) -> bool:
    nouns = _nouns(claim, description)
    return any(noun in NOUNS and NOUNS[noun].motion in ("walk", "run") for noun in nouns)


def _judge_word(
    claim: Claim, description: SceneDescription, kinds: set[str], rests: list[str]
) -> str | None:
    """What the word itself says that bodies here never do."""
    word, nouns = claim.word, _nouns(claim, description)
    is_alive = _is_alive(claim, description)
    is_person = any(noun in PERSON_NOUNS for noun in nouns)
    is_off = any(rest.startswith("off") for rest in rests)
    is_on_any = any(one.kind == "on" and one.subject in claim.things
                    for one in description.relations)  # fmt: skip
    is_hand = any(noun in HAND_NOUNS for noun in nouns)
    is_flier = any(noun in _FLAPPING for noun in nouns)
    is_afloat = any(noun in NOUNS and NOUNS[noun].habitat == "water" for noun in nouns)
    is_alone = not any(
        index in claim.things
        for one in description.relations
        for index in (one.subject, *one.targets)
    )
    is_held = any(one.kind in ("hold", "carry") for one in claim.relations)
    faults = {
        "faces do not move": _MOUTH.fullmatch(word),
        "stays upright": word.startswith("wobbl") and _is_going(claim, description),
        "the box bursts": word.startswith("pop") and "popcorn" in nouns,
        "stands": _AT_REST.fullmatch(word) and "stand" in kinds and is_alive,
        "touches nothing": is_hand and _BY_HAND.fullmatch(word) and is_alone,
        "flaps its wings": is_flier and _WINGS.fullmatch(word),
        "swims": _ON_LEGS.fullmatch(word) and is_afloat,
        "with nothing": (
            is_person and _AIRBORNE.fullmatch(word) and is_alone and not kinds & _WITH_ITS_OWN
        ),
        "only slides": word.startswith("slip") and "slide" in kinds,
        "stands, on no seat": (
            _SITTING.fullmatch(word) and kinds & DONE_SEATED and not _has_seat(claim, description)
        ),
        "it only bobs and turns": word.startswith("danc") and "dance" in kinds and not is_person,
        "falls forwards": word in _BACKWARD and "fall over" in kinds,
        "holds it from the start": (
            is_held and _GRASPING.fullmatch(word) and not (kinds & _ON_FOOT and word[0] == "b")
        ),
        "on nothing": word.startswith("perch") and not is_on_any,
        "falls where it is": is_off and _FALLING.fullmatch(word) and "fall over" in kinds,
    }
    return next((reason for reason, holds in faults.items() if holds), None)


def _has_seat(claim: Claim, description: SceneDescription) -> bool:
    """Whether a relation puts it on a seat, at a table or on what it rides."""
    return any(
        one.subject in claim.things
        and (one.kind != "on" or description.objects[one.targets[0]].noun in SEATS)
        for one in description.relations
        if one.kind in ("on", "at", "in", "ride", "ride along", "work on")
    )


def _is_going(claim: Claim, description: SceneDescription) -> bool:
    """Whether it is a person, an animal or a vehicle, which moves as smoothly as ever."""
    nouns = [NOUNS[description.objects[index].noun] for index in claim.things]
    return any(noun.motion in ("walk", "run", "drive") for noun in nouns)


def _kind(description: SceneDescription, index: int, number: int | None) -> str:
    said = description.objects[index]
    if said.motion is None:
        return "stand"
    motions = (said.motion, *said.then)
    return motions[min(number or 0, len(motions) - 1)].kind


def _rests(word: str, prompt: str) -> list[str]:
    """What follows a word, at each place where the prompt has it."""
    pattern = re.compile(rf"\b{re.escape(word.casefold())}\b\s*")
    return [" ".join(prompt[found.end() :].split()) for found in pattern.finditer(prompt)]
