"""What a staged scene shows of its description, and the report that follows from it."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

from texvent.scenes.description import AMID, Claim, SceneDescription
from texvent.scenes.inflection import pluralise
from texvent.scenes.report import PromptReport

_EXACT_COUNTS = frozenset(
    {"a couple of", "a pair of", "pair of", "two", "both", "three", "four", "five", "six", "seven",
     "eight", "nine", "ten", "eleven", "twelve", "fifteen", "twenty", "a dozen", "dozen",
     "half a dozen", "one", "a single", "single", "lone", "lonely"}
)  # fmt: skip
"""Words of number of which each copy counts; of "several", some more or less are as many."""
MOST_COUNTED = 6
"""Copies of an object that are counted one by one; of more, some may hide each other."""
PLURAL = 3
"""Copies of what a plural names, of which more than one must be seen."""
MOST_OF_VAGUE = 3
"""One copy in so many may be out of sight where a word like "several" counts them."""
MANY = 4
"""Copies that must be seen where there are more than are counted."""
STILL = "no motion to be seen"
TOO_SMALL = "too small"
_AT_REST = frozenset({"hang", "stand", "sit", "lie"})
MOST_REASONS = 2
"""Lost words that are named for a word in doubt."""
_OF_NOUN = frozenset({"quality", "bright", "colour"})
"""Aspects of adjectives that say something of the noun after them."""
_OF_THINGS = frozenset({"size", "material", "relation"})
"""Aspects of words that are as much in doubt as the nouns that they go with."""
_NAMELESS = frozenset({"relation", "motion"})


class Unmet(NamedTuple):
    """Something that the prompt says and the staged scene does not show."""

    text: str
    """For the report, such as "under the table"."""
    relation: tuple[int, tuple[int, ...]] | None = None
    """Subject and targets of the relation that does not hold."""
    motion: tuple[int, int] | None = None
    """Object, and which of its motions it does not make, from 0."""
    move: str | None = None
    """Kind of the move that the camera does not make."""


@dataclass(frozen=True)
class Evidence:
    """What a staged scene shows."""

    unmet: Sequence[Unmet] = ()
    """What its bodies do not do."""
    faults: Mapping[int, Sequence[str | None]] = field(default_factory=dict)
    """Object → for each copy why it is not seen, such as "hidden", or None."""
    still: frozenset[int] = frozenset()
    """Objects that do not move in the image."""
    places: Mapping[str, str] = field(default_factory=dict)
    """Words of the scene that are not seen, of its place, light, weather ... → why."""
    qualities: Mapping[tuple[str, int], str] = field(default_factory=dict)
    """Aspect of a claim, such as "colour", and the object → why it is not seen."""
    scenery: Sequence[str] = ()
    """Nouns of the scenery that is in view."""
    notes: Sequence[str] = ()
    """What is seen that the prompt does not say, as sentences."""


def report_on(description: SceneDescription, evidence: Evidence) -> PromptReport:
    """What becomes of the prompt's words in a staged scene.

    A word is shown if, at every place where the prompt has it, what it stands for is to be seen:
    one of its objects, all copies of a count, all objects of a relation, an object that moves. Else
    it is listed as not shown, with the reason.
    """
    missing = dict.fromkeys(one.text for one in evidence.unmet)
    missing |= dict.fromkeys(_name_unseen(description, evidence))
    missing |= {f"{word} ({reason})": None for word, reason in evidence.places.items()}
    named = {phrase.partition(" (")[0] for phrase in missing} | set(evidence.places)
    lost: dict[str, str | None] = {}
    for claim in description.claims:
        if _fails(claim, description, evidence):
            reason = _find_reason(claim, description, evidence)
            is_named = claim.word in named or (
                claim.aspect == "name" and any(_is_unseen(one, evidence) for one in claim.things)
            )
            lost[claim.word] = None if is_named else reason or lost.get(claim.word)
    gone = named | set(lost)
    replaced = {one.said for one in description.substituted}
    for word, noun in _find_idle_adjectives(description, gone | replaced).items():
        if word not in gone:
            lost[word] = f"of the {noun}"
    missing |= {f"{word} ({reason})": None for word, reason in lost.items() if reason}
    gone = named | set(lost)
    doubts = _find_doubts(description, gone)
    plain = description.report()
    around = [f"around: {', '.join(evidence.scenery)}"]
    return replace(
        plain,
        scene=(*plain.scene, *(around if evidence.scenery else ())),
        shown=tuple(word for word in plain.shown if word not in gone | set(doubts)),
        substituted=tuple(one for one in plain.substituted if one.said not in gone),
        in_doubt=tuple(
            f"{word} (without {', '.join(why[:MOST_REASONS])})" for word, why in doubts.items()
        ),
        not_shown=tuple(missing),
        notes=(*plain.notes, *evidence.notes),
    )


def _find_idle_adjectives(description: SceneDescription, gone: set[str]) -> dict[str, str]:
    """Adjectives of the scene right before a noun that is not shown, and that noun."""
    prompt = description.prompt.casefold()
    nouns = gone - {one.word for one in description.claims if one.aspect == "motion"}
    found = {}
    for claim in description.claims:
        if claim.things or claim.move is not None or claim.aspect not in _OF_NOUN:
            continue
        for after in re.split(rf"\b{re.escape(claim.word)}\b", prompt)[1:]:
            noun = next((one for one in nouns if re.match(rf"[ -]{re.escape(one)}\b", after)), None)
            if noun is not None:
                found[claim.word] = noun
    return found


def _find_doubts(description: SceneDescription, gone: set[str]) -> dict[str, tuple[str, ...]]:
    """Words, but those `gone`, that may mean something else, and the lost words they go with."""
    doubts: dict[str, tuple[str, ...]] = {}
    for claim in description.claims:
        if claim.lost and claim.word not in gone:
            doubts[claim.word] = (*doubts.get(claim.word, ()), *claim.lost)
    names = [one for one in description.claims if one.aspect == "name"]
    for claim in description.claims:
        if claim.aspect not in _OF_THINGS or claim.word in gone | set(doubts):
            continue
        ends = {end for one in claim.relations for end in (one.subject, *one.targets)}
        of = [one for one in names if (ends or set(claim.things)) & set(one.things)]
        is_unsure = any if ends else all
        if of and is_unsure(one.word in doubts for one in of):
            unsure = next(one.word for one in of if one.word in doubts)
            doubts[claim.word] = doubts[unsure]
    return {word: tuple(dict.fromkeys(lost)) for word, lost in doubts.items()}


def _name_unseen(description: SceneDescription, evidence: Evidence) -> list[str]:
    """As in "seagulls (too small)" or "1 of 3 dogs (hidden)".

    What no word names comes with another word, as the vans of a traffic jam do. Copies are counted
    where the prompt does: of "dogs" two are as good as three.
    """
    names: dict[int, list[str]] = {}
    for claim in description.claims:
        for index in claim.things if claim.aspect == "name" else ():
            names.setdefault(index, []).append(claim.word)
    counted = {index for one in description.claims if is_exact_count(one) for index in one.things}
    found = []
    for index, faults in evidence.faults.items():
        noun = description.objects[index].noun
        reasons = Counter(fault for fault in faults if fault is not None)
        if _is_unseen(index, evidence):
            for word in dict.fromkeys(names.get(index, ())):
                found.append(f"{word} ({reasons.most_common(1)[0][0]})")
        elif index in counted and len(faults) <= MOST_COUNTED:
            for reason, count in reasons.items():
                found.append(f"{count} of {len(faults)} {pluralise(noun)} ({reason})")
    return found


def _is_unseen(index: int, evidence: Evidence) -> bool:
    """Whether no copy of it is seen, or of many too few."""
    faults = evidence.faults.get(index, ())
    seen = sum(fault is None for fault in faults)
    return bool(faults) and seen < (MANY if len(faults) > MOST_COUNTED else 1)


def _find_speck(claim: Claim, description: SceneDescription, evidence: Evidence) -> str | None:
    """Why nothing is told of things that are too small to be named; None where they are not."""
    if claim.aspect == "name":
        return None
    ends = {end for one in claim.relations for end in (one.subject, *one.targets)}
    of = ends or set(claim.things)
    specks = [one for one in sorted(of) if evidence.qualities.get(("name", one)) == TOO_SMALL]
    if not specks or (not ends and len(specks) < len(of)):
        return None
    return f"{description.objects[specks[0]].noun} {TOO_SMALL}"


def _is_alone(index: int, evidence: Evidence) -> bool:
    """Whether of three or more only one is seen, so that a plural is not."""
    faults = evidence.faults.get(index, ())
    return len(faults) >= PLURAL and sum(fault is None for fault in faults) == 1


def _fails(claim: Claim, description: SceneDescription, evidence: Evidence) -> bool:
    """Whether a word does not hold in the scene."""
    unmet = {one.relation for one in evidence.unmet}
    if any((one.subject, one.targets) in unmet for one in claim.relations):
        return True
    if claim.move is not None and any(one.move == claim.move for one in evidence.unmet):
        return True
    if claim.motion is not None and any(
        one.motion == (index, claim.motion) for one in evidence.unmet for index in claim.things
    ):
        return True
    return _find_reason(claim, description, evidence) is not None


def _find_reason(claim: Claim, description: SceneDescription, evidence: Evidence) -> str | None:
    """Why what a word stands for is not to be seen, such as "dog hidden"; None where it is."""
    for relation in claim.relations:
        ends = [relation.subject, *relation.targets]
        unseen = [index for index in ends if _is_unseen(index, evidence)]
        if unseen and (relation.kind not in AMID or len(unseen) == len(ends)):
            return _reason(unseen[0], description, evidence)
    unseen = [index for index in claim.things if _is_unseen(index, evidence)]
    if unseen and len(unseen) == len(claim.things):
        return _reason(unseen[0], description, evidence)
    if claim.aspect == "name" and any(_is_alone(one, evidence) for one in claim.things):
        return "only one in view"
    poor = _find_poor_quality(claim, description, evidence)
    poor = poor or _find_speck(claim, description, evidence)
    if poor is not None:
        return poor
    if claim.aspect == "motion":
        untold = [one for one in claim.things if ("name", one) in evidence.qualities]
        if untold and len(untold) == len(claim.things):
            return f"{description.objects[untold[0]].noun} {evidence.qualities['name', untold[0]]}"
        movers = [index for index in claim.things if is_to_move(index, description)]
        if movers and evidence.still.issuperset(movers):
            return STILL
    return None


def _find_poor_quality(
    claim: Claim, description: SceneDescription, evidence: Evidence
) -> str | None:
    """Why the number, the colour ... of objects that are in view is not seen; None where it is."""
    for index in claim.things:
        noun = description.objects[index].noun
        faults = evidence.faults.get(index, ())
        unseen = sum(fault is not None for fault in faults)
        if claim.aspect == "count" and unseen > _most_unseen(claim, len(faults)):
            return f"not all {pluralise(noun)} in view"
        if (claim.aspect, index) in evidence.qualities:
            return f"{noun} {evidence.qualities[claim.aspect, index]}"
    return None


def is_exact_count(claim: Claim) -> bool:
    """Whether a word says how many there are: "three", "12", and not "several"."""
    return claim.aspect == "count" and (
        claim.word in _EXACT_COUNTS or any(map(str.isdigit, claim.word))
    )


def _most_unseen(claim: Claim, copies: int) -> int:
    """How many copies may be out of sight where a word says how many there are."""
    if copies > MOST_COUNTED:
        return copies // 2
    return 0 if is_exact_count(claim) else copies // MOST_OF_VAGUE


def _reason(index: int, description: SceneDescription, evidence: Evidence) -> str:
    fault = next(fault for fault in evidence.faults[index] if fault is not None)
    return f"{description.objects[index].noun} {fault}"


def is_to_move(index: int, description: SceneDescription) -> bool:
    """Whether an object is to move."""
    said = description.objects[index]
    return any(
        one is not None and one.kind not in _AT_REST and not one.is_stuck
        for one in (said.motion, *said.then)
    )
