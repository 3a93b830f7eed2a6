"""Who and what rests where only is said what people hold, wear or sit on."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.people.activities import DONE_SEATED, PERSON_NOUNS, SEATS

_AT_REST = ("sit", "sat", "perch", "stand", "stood", "pos")
"""How the words begin that say so: who only rides something sits on it too."""


def list_posing(description: SceneDescription) -> set[int]:
    """People, and animals, of whom only is said what they hold or wear: they stand and show it.

    What they hold and what is sat or stood on rests, too: "sits on a motorcycle", "poses on skis".
    """
    shown = [
        relation
        for relation in description.relations
        if relation.kind == "wear"
        or (relation.kind == "hold" and description.objects[relation.subject].noun in PERSON_NOUNS)
    ]
    rested_on = [
        relation.targets
        for relation in description.relations
        if relation.kind in ("on", "ride") and _rests(description.objects[relation.subject])
    ]
    if not any(word.startswith(_AT_REST) for word in description.shown):
        rested_on = []
    posing = {one.subject for one in shown} | {n for one in shown for n in one.targets}
    return posing | {n for targets in rested_on for n in targets}


def lose_standing(words: Sequence[Word], description: SceneDescription) -> None:
    """As in "stands on a bed playing the guitar": who does that on a seat is shown seated."""
    seated = {
        one.subject
        for one in description.relations
        if one.kind == "on" and description.objects[one.targets[0]].noun in SEATS
        and (motion := description.objects[one.subject].motion) is not None
        and motion.kind in DONE_SEATED
    }  # fmt: skip
    for word in words:
        if word.lemma == "stand" and word.is_used and seated & set(word.things):
            word.is_used, word.is_lost = False, True


def _rests(one: SceneObject) -> bool:
    return one.motion is not None and one.motion.kind in ("sit", "stand")
