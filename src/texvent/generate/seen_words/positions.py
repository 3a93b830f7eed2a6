"""Whether one thing is seen behind another, before it, or copies at each other's side."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.generate.seen_words.picture import USUAL, Picture, View
from texvent.scenes.description import Claim, Relation, SceneDescription
from texvent.scenes.evidence import is_to_move
from texvent.scenes.language.meaning.capabilities import is_person
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.placement.faced import LOOKED_AT

_IN_DEPTH = ("behind", "front")
ASIDE = 0.1
"""Gap to the side in the picture up to which they are in line, as a share of the wider one."""
LEAST_DEEPER = 0.5
"""Share of the instants at which it must be farther away."""
APART = 0.5
"""Gap to the nearest copy from which on they are not together, as a share of their width."""
AT_BODY_M = 0.05
"""Gap up to which clothes are worn or held."""
IN_FILE = 0.94
"""Cosine between the heading and the way to the next copy from which on they go in file."""


def judge_position(picture: Picture, claim: Claim) -> str | None:
    """Why "behind" or "in front of" is not seen, or None.

    Args:
        picture: of the staged scene.
        claim: of a relation.
    """
    for relation in claim.relations:
        if relation.kind in _IN_DEPTH and not _is_flat(picture, relation):
            rear, front = _all_of(claim, relation), [relation.targets[0]]
            if relation.kind == "front":
                rear, front = front, rear
            if not _is_seen_behind(picture, rear, front):
                return "not in line in the picture"
    return None


def _is_flat(picture: Picture, relation: Relation) -> bool:
    """Stripes on a road, and what one looks at, are not judged by what hides what."""
    own = {one.noun.name for one in picture.scene.actors
           if one.object_index in (relation.subject, *relation.targets)}  # fmt: skip
    return bool(own & ({"crosswalk"} | LOOKED_AT))


def _all_of(claim: Claim, relation: Relation) -> list[int]:
    """All subjects of a word with the same target: two to its sides stand before it together."""
    return [
        one.subject
        for one in claim.relations
        if (one.kind, one.targets) == (relation.kind, relation.targets)
    ]


def _is_seen_behind(picture: Picture, rear: Sequence[int], front: Sequence[int]) -> bool:
    """Farther away at most instants, and in line with it at one; True where one is never seen."""
    is_deeper, is_in_line = [], []
    for view in picture.views:
        back, near = (_find(picture, view, indices) for indices in (rear, front))
        if back is None or near is None:
            continue
        is_deeper.append(back[2] > near[2])
        gap = max(back[0] - near[1], near[0] - back[1])
        is_in_line.append(gap <= ASIDE * max(back[1] - back[0], near[1] - near[0]))
    return not is_deeper or (np.mean(is_deeper) >= LEAST_DEEPER and any(is_in_line))


def _find(picture: Picture, view: View, indices: Sequence[int]) -> Float64Array | None:
    """[3] left and right end in the picture, pixels, and depth, m, of objects."""
    own = [one for one, number in picture.scene.object_of.items() if number in indices]
    where = np.isin(view.instance, own)
    if not where.any():
        return None
    columns = picture.points[where, 0]
    return np.array([columns.min(), columns.max(), np.median(view.depth[where])])


def judge_together(picture: Picture, index: int) -> str | None:
    """Why copies of an object are not seen at each other's side, or None."""
    copies = [one for one in picture.scene.actors if one.object_index == index]
    if len(copies) < 2:
        return None
    furniture = [prop.furniture for one in copies for prop in one.props if prop.furniture]
    if len(furniture) >= len(copies):
        return f"each at a {furniture[0]} of its own"
    time_s = 0.5 * picture.views[-1].time_s
    boxes = [part_boxes(one, time_s) for one in copies]
    for number, own in enumerate(boxes):
        gaps = {k: gap(own, other) for k, other in enumerate(boxes) if k != number}
        nearest = min(gaps, key=lambda k: gaps[k])
        low, high = own.hull
        if gaps[nearest] > APART * float(np.mean((high - low)[:2])):
            return "apart"
        if _goes_behind(copies[number], copies[nearest], time_s):
            return "one behind the other"
    return None


def _goes_behind(one: Actor, other: Actor, time_s: float) -> bool:
    """Whether two that go along go in single file."""
    if not one.is_mover:
        return False
    between = (other.middle(time_s) - one.middle(time_s))[:2]
    yaw = one.trajectory.at(time_s).yaw
    along = abs(float(between @ np.array([np.cos(yaw), np.sin(yaw)])))
    return along > IN_FILE * float(np.linalg.norm(between))


def judge_depth(picture: Picture, index: int, *, is_far: bool) -> str | None:
    """What is in the background lies behind all other things in view, or is small."""
    own, others = [], []
    copies = [one for one, of in picture.scene.object_of.items() if of == index]
    for number in USUAL:
        view = picture.views[number]
        mine = np.isin(view.instance, copies)
        own += [float(np.median(view.depth[mine]))] if mine.any() else []
        rest = (view.instance > 0) & ~mine
        others += [float(np.median(view.depth[rest]))] if rest.any() else []
    if not own:
        return None
    if not others:
        return "nothing is before it" if is_far else None
    if is_far:
        return None if np.median(own) > np.median(others) else "not behind the others"
    return None if np.median(own) < np.median(others) else "not before the others"


def lies_by_itself(picture: Picture, description: SceneDescription, index: int) -> bool:
    """Whether clothes lie about that no relation names, away from people who may wear them."""
    ends = {end for one in description.relations for end in (one.subject, *one.targets)}
    if index in ends or is_to_move(index, description):
        return False
    actors = picture.scene.actors
    people = [part_boxes(one, 0.0) for one in actors if is_person(one.noun)]
    own = [part_boxes(one, 0.0) for one in actors if one.object_index == index]
    return bool(people) and all(gap(one, body) > AT_BODY_M for one in own for body in people)
