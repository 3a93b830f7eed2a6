"""Who rides something: a named mount, or the bicycle that "cycling" means."""

from __future__ import annotations

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.sequence import add_motion
from texvent.scenes.language.meaning.capabilities import can_do, is_person
from texvent.scenes.language.meaning.draft import Draft, PartialObject
from texvent.scenes.language.vocabulary.verbs import Verb

RIDDEN_BY_VERB = {
    "cycle": "bicycle", "pedal": "bicycle", "bike": "bicycle", "bicycle": "bicycle",
    "motorcycle": "motorcycle", "motorbike": "motorcycle", "kayak": "kayak", "canoe": "canoe",
    "sail": "sailboat", "row": "rowing boat",
}  # fmt: skip
"""Verb of people → what they ride where nothing is named."""


_AFLOAT = frozenset({"kayak", "canoe", "rowing boat", "sailboat"})


def ride(
    draft: Draft, clause: Clause, verb: Verb, subjects: list[int], targets: list[int]
) -> list[int]:
    """What is ridden moves, and who rides it sits; those that are already related.

    Returns:
        What is ridden.
    """
    if verb.base == "row" and draft.noun(targets[0]).name == "boat":
        draft.objects[targets[0]].noun = "rowing boat"
    noun = draft.noun(targets[0])
    kind = "fly" if noun.motion == "fly" else "move"
    if verb.kind == "work" and can_do(noun, "work"):
        kind = "work"
    motion = ObjectMotion(kind, verb.direction, verb.pace)
    for index in targets:
        add_motion(draft, index, motion, clause)
    for index in subjects:
        if not draft.objects[index].motions:
            draft.objects[index].motions.append(ObjectMotion("sit"))
    return targets


def ride_unnamed(draft: Draft, clause: Clause, subjects: list[int]) -> list[int]:
    """As in "a boy is cycling": on a bicycle of his own.

    Returns:
        What is ridden; empty if the verb means no mount.
    """
    word = clause.verb_word
    mount = RIDDEN_BY_VERB.get(word.lemma)
    people = [index for index in subjects if is_person(draft.noun(index))]
    verb = word.meaning.value
    is_riding = any(one.kind == "ride" and one.subject in people for one in draft.relations)
    if is_riding and mount in _AFLOAT:
        word.is_used = True  # "canoeing or kayaking"
        return people
    if mount is None or not people or people != subjects or not isinstance(verb, Verb):
        return []
    count = sum(draft.objects[index].count for index in people)
    index = draft.add(PartialObject(mount, count))
    if index is None:
        return []
    word.is_used = draft.relate("ride", people, [index])
    return ride(draft, clause, verb, people, [index])
