"""Relation check: relations and directions of a scene that its bodies do not realise.

Boxes around the bodies at a few instants decide, by the rules of `relation_rules.py`.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from texvent_scenes.checks.clip.body_boxes import BodyBoxes
from texvent_scenes.checks.clip.relation_rules import RULES, are_still, is_between
from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.models.anchors import has_rim
from texvent_scenes.models.nouns import AFLOAT, NOUNS
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.spec.data import PLACING
from texvent_scenes.spec.scene import Motion, SceneObject
from texvent_scenes.staging.placement.zones import are_driven, hangs_on, is_before_face
from texvent_scenes.staging.tracks.phases import PATH_KINDS, STEERED, ends_at_rest

_DIRECTED = frozenset({"move", "walk", "run", "drive", "fly", "glide", "swim", "sail", "paddle",
                       "slide", "roll", "crawl", "rise", "sink", "hover", "float", "bounce", "jump",
                       "fall"})  # fmt: skip
"""Motions whose direction is that of the displacement."""
_ON_GROUND = frozenset({"walk", "run", "crawl", "drive", "roll", "slide"})
"""Motions of which "up and down" means back and forth."""
_AXES = {"left": (0, -1), "right": (0, 1), "up": (1, -1), "down": (1, 1), "towards": (2, -1),
         "away": (2, 1)}  # fmt: skip
"""Direction → axis of the camera (right, down, forward) and sign."""
_LEAST_GONE = 0.5
"""Least way across the image, in sizes of a body."""
_ON_SIDES, _ASIDE = {"left": -1.0, "right": 1.0}, 0.05
"""Placement → side of the image; least tangent of the angle to its middle."""
_LASTING = ("on", "in", "at", "with", "contained", "enclosed", "hung", "follow", "push", "pull",
            "act on", "on a seat", "on a face", "facing")  # fmt: skip
"""Relations that hold at half of the instants at least, as places do of what stays; others hold at
one instant."""
_TOGETHER = (
    "behind",
    "front",
    "behind a body",
    "front of a body",
    "front of what drives",
    "beside",
    "going beside",
)
_HANDLED, _MACHINES = ("lift", "move over", "set down", "drop"), trait_values("gripper").keys()
"""Relations to what machines take from somewhere or leave there: it is there at one end."""
_ON_SIDE = {"front": "front of a body", "behind": "behind a body"}
"""Relations to who has a face, which are of that body as well as of the image."""
_PASSED_ALL = ("past", "overtake")
"""Relations that last where both go, and those that hold of all targets: "passes two cars"."""
_PASSAGE = "through an opening"
"""Rule of gates, of which who goes through several goes through each."""
_ROW = 4
"""Targets from which on they are a row, of which it passes some."""
_BY = ("at", "to", "towards")
"""Words for "beside" of what one cannot be at otherwise, such as a pier."""
_SAID = {"front": "in front of", "follow": "following", "act on": "at"}
"""Kinds of relation that a line of the report says in other words."""
_RESTING, _AMID = ("stand", "hover", "spin"), 0.12
"""Motions in one place; greatest tangent of the angle to what is in the middle."""
_MOST_COPIES = 0.75
"""Share of a subject's copies in a relation."""


class Violation(NamedTuple):
    """A word of a scene that no instant shows."""

    kind: str
    """"relation", "direction", "motion", "noun", "effect" or a field of light or place."""
    value: str | float
    """Such as "under", "left" or "snow"; 2 of a count."""
    line: str
    """For the report, such as "the ball under the chair"."""


def find_violations(
    description: SceneDescription, copies: Sequence[Sequence[BodyBoxes]]
) -> Iterator[Violation]:
    """Words that the bodies do not realise; without a line where one of them is out of view."""
    names = [f"the {label_of(description, n)}" for n in range(len(description.objects))]
    sent = {one.subject: one.targets[0] for one in description.relations
            if one.kind in ("kick", "throw", "roll", "hit")}  # fmt: skip
    queues = {one.subject for one in description.claims
              if (one.kind, one.value) == ("row", "queue")}  # fmt: skip
    piles = {one.subject for one in description.claims if one.kind == "stack"}
    down, handled = _list_knocked(description), _list_handled(description)
    for one in description.relations:
        who = sent.get(one.subject, one.subject) if one.kind == "towards" else one.subject
        own, others = copies[who], [body for t in one.targets for body in copies[t]]
        side = description.objects[one.subject].placement
        if one.kind in ("past", "overtake") and side in ("left", "right"):
            yield Violation("placement", side, f"{names[one.subject]} passing on the {side}")
        kind = _rule_for(one.kind, *(description.objects[n] for n in (one.subject, one.targets[0])))
        kind = "catch" if one.is_caught else "sent" if who != one.subject else kind
        kind = "with" if who in queues and kind in PLACING else kind
        if kind not in (*RULES, "between") or one.subject in one.targets:
            continue
        goes_on = len(description.objects[one.subject].motions) > 1
        is_into = one.kind == "in" and has_rim(description.objects[one.targets[0]].noun)
        kind = "down into" if who in handled and is_into else kind
        ends = [slice(1), slice(-1, None)] if who in handled and not is_into else [slice(None)]
        falls = any(each.kind == "fall" for each in description.objects[who].motions)
        is_first = (kind == "on" and one.targets[0] in down) or (kind == "hung" and falls)
        if is_first:  # it goes down with what is knocked over, or off the wall
            ends = [slice(1)]
        held = [any(holds(kind, body.cut(when), [each.cut(when) for each in others], at_end=goes_on)
                    for when in ends) for body in own]  # fmt: skip
        if kind == "sent" and not all(
            holds("facing", each, others) for each in copies[one.subject]
        ):
            held = []
        is_queue = (
            who in queues
            or (kind == "on" and who in piles)
            or (one.kind == "beside" and are_driven(description.objects[who].noun))
        )
        # Only the first stands at the light, only the lowest of a pile is on a pallet.
        least = 1 if is_queue else _MOST_COPIES * len(own)
        passed = [any(holds(kind, body, [each]) for body in own) for each in others]
        is_part = kind == _PASSAGE and not all(passed)
        if sum(held) < least or not own or is_part:
            targets = " and ".join(names[target] for target in one.targets)
            said = _SAID.get(one.kind, one.kind)
            line = f"{names[one.subject]} {said} {targets}"
            line = f"{names[who]} caught by {targets}" if one.is_caught else line
            line += f": {sum(passed)} of {len(passed)}" if is_part and any(passed) else ""
            said = "catch" if one.is_caught else one.kind
            yield Violation("relation", said, line if own and others else "")
            yield from _list_read_as(one.kind, description)
    passing = {one.subject for one in description.relations if one.kind in ("past", "overtake")}
    led = {target for one in description.relations for target in one.targets}
    for index, (thing, own) in enumerate(zip(description.objects, copies, strict=True)):
        if index not in passing and (part := _list_side(thing, own)):
            yield Violation("placement", str(thing.placement), f"{names[index]} {part}")
        motion = thing.motion if len(thing.motions) == 1 and index not in led else None
        if own and motion and not any(goes_so(one, motion) for one in own):
            line = f"{names[index]} going {motion.direction}"
            yield Violation("direction", str(motion.direction), line)


def _list_side(said: SceneObject, own: Sequence[BodyBoxes]) -> str:
    """Words for the part of the image in which a body should be, and is not; "" = it is."""
    sign = _ON_SIDES.get(said.placement or "", 0.0)
    if own and sign and not any(np.mean(sign * one.seen[:, 0]) > _ASIDE for one in own):
        return f"on the {said.placement}"
    return "in the middle" if own and said.placement == "centre" and not _is_amid(said, own) else ""


def _is_amid(said: SceneObject, own: Sequence[BodyBoxes]) -> bool:
    """Whether one that stays in its place at first is about the middle of the image then."""
    first = [one.seen[: len(one.seen) // 3 + 1, 0] for one in own]
    rests = bool(said.motions) and said.motions[0].kind in _RESTING
    return not rests or any(bool((np.abs(one) <= _AMID).any()) for one in first)


def _list_knocked(description: SceneDescription) -> list[int]:
    """Objects that are knocked over, and those that stand on them."""
    down = [one.targets[0] for one in description.relations if one.kind == "knock over"]
    for index in down:
        down += [one.subject for one in description.relations if one.kind == "on"
                 and index in one.targets and one.subject not in down]  # fmt: skip
    return down


def goes_so(body: BodyBoxes, motion: Motion) -> bool:
    """Whether a body goes in the direction of its motion, as far as its way tells it."""
    kind, direction = motion.kind, motion.direction
    if direction == "across" and kind in _DIRECTED:
        aside, away = np.abs(body.displacement[[0, 2]])
        return bool(aside > max(0.33 * away, _LEAST_GONE * body.size.max()))
    if direction == "diagonal" and kind in _DIRECTED:
        _, second, most = np.sort(np.abs(body.displacement))
        return bool(second > 0.33 * most)
    if direction in _AXES and kind in _DIRECTED:
        axis, sign = _AXES[direction]
        moved = body.displacement
        return bool(sign * moved[axis] > 0.33 * np.linalg.norm(moved))
    if direction == "up and down" and kind in _DIRECTED - _ON_GROUND:
        extent = np.ptp(body.middle, axis=0)
        return bool(extent[2] > max(extent[:2]))
    return True


def _list_read_as(kind: str, description: SceneDescription) -> Iterator[Violation]:
    """Other words that are read as a kind of relation, if nothing else is said by them."""
    said = {one.kind for one in description.relations}
    for word in _BY if kind == "beside" else ():
        if word not in said:
            yield Violation("relation", word, "")


def _list_handled(description: SceneDescription) -> set[int]:
    """Objects that machines take, move or leave."""
    said, objects = description.relations, description.objects
    return {target for one in said if one.kind in _HANDLED for target in one.targets
            if objects[one.subject].noun in _MACHINES}  # fmt: skip


def _rule_for(kind: str, who: SceneObject, what: SceneObject) -> str:
    """Name of the rule for a kind of relation between these bodies."""
    noun, target = who.noun, what.noun
    if kind in ("front", "behind", "beside") and ends_at_rest(who.motions):
        return "stopped"
    if kind == "beside" and _go_on_foot(who) and _go_on_foot(what):
        return "going beside"
    if kind == "towards" and _is_walker(who) and not {m.kind for m in who.motions} & STEERED:
        return "facing"
    is_waiting = not any(motion.is_moving for motion in (*who.motions, *what.motions))
    if kind in ("front", "behind") and is_waiting and are_driven(noun, target):
        return f"{kind} in a lane"
    is_driven = are_driven(target, target) and any(one.is_moving for one in what.motions)
    if kind == "front" and _is_walker(who) and is_driven:
        return "front of what drives"
    if kind == "into" and has_rim(target):
        return "down into"
    if kind in ("front", "behind") and _is_walker(what):
        return _ON_SIDE[kind]
    if kind == "through" and target in nouns_with("passage"):
        return _PASSAGE
    if kind == "in" and trait_value("container", target) is not None:
        is_swimmer = noun in NOUNS and NOUNS[noun].habitat == "water" and noun not in AFLOAT
        is_seen = target in nouns_with("see-through")
        is_out = target in nouns_with("lidded") or (is_swimmer and not is_seen)
        return "never" if is_out else "enclosed" if is_seen else "contained"
    return _rule_on(who, what) if kind == "on" else kind


def _rule_on(who: SceneObject, what: SceneObject) -> str:
    """Name of the rule for what is on another thing."""
    if what.noun in nouns_with("swings"):
        return "on a seat"
    goes = bool(who.motions) and who.motions[0].kind in PATH_KINDS
    if trait_value("slope", what.noun) is not None and any(
        one.kind == "turn" for one in who.motions
    ):
        return "never"  # its way is level
    if goes and trait_value("slope", what.noun) is not None:
        return "on a slope"  # and past its foot
    if what.noun in nouns_with("of ground"):
        return "on a tip"
    if is_before_face(who, what):
        return "never"  # who writes there has a pad in hand
    if hangs_on(who.noun, what.noun):
        return "hung"
    return "on a face" if {who.noun, what.noun} <= nouns_with("flat pattern") else "on"


def _go_on_foot(one: SceneObject) -> bool:
    """Whether a person or an animal goes somewhere all the time."""
    return _is_walker(one) and len(one.motions) == 1 and one.motions[0].kind in PATH_KINDS


def _is_walker(one: SceneObject) -> bool:
    """Whether it is a person or an animal on feet."""
    return one.noun in NOUNS and NOUNS[one.noun].motion == "walk"


def holds(kind: str, body: BodyBoxes, others: Sequence[BodyBoxes], *, at_end: bool = False) -> bool:
    """Whether a body is so to another one, or between two of them, for long enough.

    `at_end`: it does several things one after the other, and so is there when the last is done.
    """
    if kind == "between":
        pairs = itertools.combinations(others, 2)
        flags = [(is_between(body, *pair), are_still(body, *pair)) for pair in pairs]
    else:
        flags = [(RULES[kind](body, other), are_still(body, other)) for other in others]
    is_lasting = kind in _LASTING
    are_both_going = kind in _TOGETHER and not are_still(body) and not any(map(are_still, others))
    found = [
        (at_end and is_lasting and held[-2:].all())
        or np.mean(held) >= (0.5 if is_lasting or are_both_going
                             or (is_still and kind in PLACING) else 1e-9)
        for held, is_still in flags
    ]  # fmt: skip
    is_all = kind in _PASSED_ALL and len(others) < _ROW
    return all(found) if is_all else any(found)
