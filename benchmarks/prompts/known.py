"""What the reader knows: asked of itself, by sentences of one clause."""

from __future__ import annotations

import functools

from benchmarks.prompts.gold import GoldAction
from benchmarks.prompts.wording import stem, stems
from texvent.errors import InputError
from texvent.scenes.description import ObjectMotion, SceneObject
from texvent.scenes.inflection import list_finite_forms
from texvent.scenes.language.parser import parse_prompt
from texvent.scenes.models.nouns import NOUNS


def motions_of(scene_object: SceneObject) -> list[ObjectMotion]:
    """What an object does, in order."""
    first = [] if scene_object.motion is None else [scene_object.motion]
    return [*first, *scene_object.then]


@functools.cache
def canonical_nouns(noun: str) -> frozenset[str]:
    """Names of the models that a noun of a person may be shown by."""
    found = {name for name, one in NOUNS.items() if noun.lower() in (name, *one.synonyms)}
    try:
        description = parse_prompt(f"a {noun}")
    except InputError:
        return frozenset(found)
    if not description.not_understood:
        found |= {one.noun for one in description.objects[:1]}
    return frozenset(found)


@functools.cache
def place_of(text: str) -> str | None:
    """The place that a person's word for it stands for, as far as the reader knows it."""
    try:
        description = parse_prompt(f"a car in the {text}")
    except InputError:
        return None
    known = description.surroundings.place
    return None if stems([text]) & stems(description.not_understood) else known


@functools.cache
def action_kinds(action: GoldAction) -> frozenset[str]:
    """Stems of the kinds of motion or act that a verb stands for, as far as the reader knows it."""
    verb, *rest = action.verb.lower().split()
    kinds = {stem(verb)}
    target = f" the {action.object}" if action.object else ""
    text = " ".join([f"the {action.subject}", list_finite_forms(verb)[1], *rest]) + target
    try:
        description = parse_prompt(text)
    except InputError:
        return frozenset(kinds)
    report = description.report()
    if stem(verb) in stems((*report.not_understood, *report.not_shown)) or not description.objects:
        return frozenset(kinds)
    kinds |= {stem(motion.kind) for motion in motions_of(description.objects[0])}
    kinds |= {stem(one.kind) for one in description.relations if one.subject == 0}
    return frozenset(kinds)
