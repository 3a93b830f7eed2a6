"""Whether the staged scene shows the relations that the prompt states; what it does not show."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.evidence import Unmet
from texvent.scenes.inflection import pluralise
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.work.verbs import HOVERING
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.acts.climbing import ClimbingAt
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.hand_work.working import WorkingAt, tool_tip
from texvent.scenes.staging.acts.holding import WORN
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.claims.contact import (
    holds_for_all,
    is_in,
    is_on,
    moves_parts,
    rides,
    strikes,
    touches,
)
from texvent.scenes.staging.claims.courses import approaches, comes_from, goes_round
from texvent.scenes.staging.placement.at_table import turned_to
from texvent.scenes.staging.placement.cages import CAGES
from texvent.scenes.wording import RELATION_WORDS

_INSTANTS = 13
_FINER = 8
_PHRASES = {**RELATION_WORDS, "beside": "next to"}
"""Relation → words for it, where they differ from its name."""
_SMALL = 0.35
"""Share of a low thing's size up to which what it is "with" stands on it or in it."""
_LOW_M = 2.0


_Course = Callable[[Sequence[Actor], Sequence[Actor], float], bool]


class _Body(NamedTuple):
    """All copies of an object over the clip."""

    places: Float64Array
    """[n, 3] mean of their middles at each instant, m."""
    low: Float64Array
    """[n, 3] least corner of all, m."""
    high: Float64Array
    copies: tuple[Actor, ...] = ()
    duration_s: float = 1.0


def list_not_shown(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> list[Unmet]:
    """Relations of the prompt that its objects do not have in the scene.

    Args:
        description: what the prompt says.
        actors: the objects on their trajectories; what stands around as scenery is none of them.
        duration_s: length of the clip, s.

    Returns:
        As "under the table", in the order of the relations.
    """
    bodies: dict[int, _Body] = {}
    times = np.linspace(0.0, duration_s, _INSTANTS)
    missing = []
    for relation in description.relations:
        check = _CHECKS.get(relation.kind)
        known = {actor.object_index for actor in actors}
        if check is None or not {relation.subject, *relation.targets} <= known:
            continue
        for index in (relation.subject, *relation.targets):
            if index not in bodies:
                copies = [actor for actor in actors if actor.object_index == index]
                bodies[index] = _measure(copies, times)
        targets = [bodies[index] for index in relation.targets]
        if not check(bodies[relation.subject], targets):
            names = " and ".join(_name(description, index) for index in relation.targets)
            words = f"{_PHRASES.get(relation.kind, relation.kind)} the {names}"
            is_named = relation.kind in _BY_CONTACT
            text = f"{_name(description, relation.subject)} {words}" if is_named else words
            missing.append(Unmet(text, relation=(relation.subject, relation.targets)))
    return missing


def _name(description: SceneDescription, index: int) -> str:
    scene_object = description.objects[index]
    return scene_object.noun if scene_object.count == 1 else pluralise(scene_object.noun)


def _measure(actors: Sequence[Actor], times: Float64Array) -> _Body:
    corners = np.array([[actor.corners(float(t)) for actor in actors] for t in times])
    middles = np.array([[actor.middle(float(t)) for actor in actors] for t in times])
    low, high = corners.min(axis=(1, 2)), corners.max(axis=(1, 2))
    return _Body(middles.mean(axis=1), low, high, tuple(actors), float(times[-1]))


def _gaps(subject: _Body, target: _Body) -> Float64Array:
    """[n] metres over the ground between the boxes of two bodies; 0 where they overlap."""
    apart = np.maximum(subject.low - target.high, target.low - subject.high)[:, :2]
    return np.asarray(np.hypot(*np.maximum(apart, 0.0).T))


def _size(body: _Body) -> float:
    return float(np.max(body.high - body.low))


def _is_near(subject: _Body, targets: list[_Body]) -> bool:
    reach = _BESIDE * max(_size(one) for one in (subject, *targets)) + _BESIDE_M
    return all(float(_gaps(subject, target).min()) < reach for target in targets)


def _is_at(subject: _Body, targets: list[_Body]) -> bool:
    """Everyone is within reach of a table, and turned to it."""
    half = 0.5 * subject.duration_s

    def is_there(own: Actor) -> bool:
        state = own.trajectory.at(half)
        return any(
            turned_to(state.position, state.yaw, one.middle(half))
            and gap(part_boxes(own, half), part_boxes(one, half)) < _AT_M
            for one in targets[0].copies
        )

    return all(is_there(own) for own in subject.copies)


_AT_M = 0.5
_BESIDE, _BESIDE_M = 0.6, 0.6
"""Gap up to which something is beside another: share of the larger one's size, m."""


def _middle(body: _Body) -> Float64Array:
    return np.asarray(body.places[len(body.places) // 2])


def _is_above(subject: _Body, targets: list[_Body]) -> bool:
    half = len(subject.low) // 2
    over = all(
        float(subject.high[half, 2]) > float(target.high[half, 2])
        and float(_gaps(subject, target).min()) < 0.6 * _size(subject) + 0.5
        for target in targets
    )
    return over


def _is_under(subject: _Body, targets: list[_Body]) -> bool:
    target = targets[0]
    gaps = _gaps(subject, target)
    is_there = (gaps <= 0.05) & (subject.places[:, 2] < target.high[:, 2])
    if target.copies and target.copies[0].noun.name in _CLOSED_BELOW:
        places, low, high = subject.places[:, :2], target.low[:, :2], target.high[:, :2]
        is_there &= np.all((low < places) & (places < high), axis=1)
    return bool(np.any(is_there))


_CLOSED_BELOW = frozenset({"bush"})
"""Nouns without room below them: what is at their edge is beside them."""


def _is_between(subject: _Body, targets: list[_Body]) -> bool:
    if len(targets) < 2:
        return len(targets[0].copies) < 2 or _is_among_copies(subject, targets[0])
    first, second = _middle(targets[0])[:2], _middle(targets[1])[:2]
    way = second - first
    share = float((_middle(subject)[:2] - first) @ way) / max(float(way @ way), 1e-9)
    return 0.1 < share < 0.9


def _is_among_copies(subject: _Body, target: _Body) -> bool:
    """Whether copies of the target stand to both sides of it at some instant."""
    half = len(subject.places) // 2
    others = np.array([copy.middle(0.5 * target.duration_s) for copy in target.copies])[:, :2]
    for place in subject.places[:: max(half // 6, 1), :2]:
        ways = others - place
        near = np.linalg.norm(ways, axis=1) < 2.0 * _size(target) + _size(subject)
        if near.sum() > 1 and np.min(ways[near] @ ways[near].T) < 0.0:
            return True
    return False


def _by_copies(holds: _Course) -> Callable[[_Body, list[_Body]], bool]:
    """A check of the single copies."""
    return lambda subject, targets: holds(
        subject.copies, [copy for one in targets for copy in one.copies], subject.duration_s
    )


def _goes_away(subject: _Body, targets: list[_Body]) -> bool:
    apart = np.linalg.norm(subject.places - targets[0].places, axis=1)
    return bool(apart[-1] > apart[0])


def _along(subject: _Body, target: _Body) -> Float64Array:
    """[n] metres by which the subject is ahead of the target, along the subject's way."""
    way = subject.places[-1] - subject.places[0]
    way = way / max(float(np.linalg.norm(way)), 1e-9)
    return np.asarray((subject.places - target.places) @ way)


def _passes(subject: _Body, targets: list[_Body]) -> bool:
    moved = float(np.linalg.norm(subject.places[-1] - subject.places[0]))
    moved += float(np.linalg.norm(targets[0].places[-1] - targets[0].places[0]))
    ahead = _along(subject, targets[0])
    beside = 0.5 * (_size(subject) + _size(targets[0]))
    return moved < 0.1 or bool(ahead.min() < beside and ahead.max() > -beside)


def _overtakes(subject: _Body, targets: list[_Body]) -> bool:
    ahead = _along(subject, targets[0])
    return bool(ahead[0] < 0.0 < ahead[-1])


def _goes_through(subject: _Body, targets: list[_Body]) -> bool:
    target = targets[0]
    places, low, high = (_finely(one) for one in (subject.places, target.low, target.high))
    inside = np.all((places > low) & (places < high), axis=1)
    return bool(np.any(inside))


def _finely(values: Float64Array) -> Float64Array:
    """[n, 3] between the instants too."""
    known = np.arange(len(values))
    wanted = np.linspace(0.0, len(values) - 1.0, _FINER * (len(values) - 1) + 1)
    return np.stack([np.interp(wanted, known, column) for column in values.T], axis=1)


def _is_behind_in_line(subject: _Body, targets: list[_Body]) -> bool:
    target = targets[0]
    if np.linalg.norm(target.places[-1] - target.places[0]) < 0.05:
        return True
    return bool(np.all(_along(target, subject) > 0.0))


def _is_on(subject: _Body, targets: list[_Body]) -> bool:
    """On it; where the target's parts move and it stays in its place, it is carried along."""
    target = targets[0]
    if not holds_for_all(is_on, subject.copies, target.copies, subject.duration_s):
        return False
    if not target.copies[0].noun.is_working or subject.copies[0].is_mover:
        return True
    times = np.linspace(0.0, subject.duration_s, 5) * 0.93
    return moves_parts(subject.copies[0], times) or not moves_parts(target.copies[0], times)


def _is_in(subject: _Body, targets: list[_Body]) -> bool:
    is_caged = targets[0].copies[0].noun.name in CAGES
    return holds_for_all(
        is_in, subject.copies, targets[0].copies, subject.duration_s, always=is_caged
    )


def _is_with(subject: _Body, targets: list[_Body]) -> bool:
    """Near it; a small thing that does not move is on what is low and as still, or in it."""
    if not _is_near(subject, targets):
        return False
    own, other = subject.copies[0], targets[0].copies[0]
    if own.is_mover and other.noun.motion == "stand":
        # What goes along is near all the time.
        reach = _BESIDE * max(_size(subject), _size(targets[0])) + _BESIDE_M
        return float(_gaps(subject, targets[0]).max()) < reach
    is_still = own.noun.habitat == "fixed" and other.noun.habitat == "fixed"
    is_load = other.size_m < _SMALL * own.size_m and own.model.height < _LOW_M
    if not (is_still and is_load):
        return True
    return holds_for_all(touches, targets[0].copies, subject.copies, subject.duration_s)


def _is_touching(subject: _Body, targets: list[_Body]) -> bool:
    """Each target is at one of the subjects: "two people wearing three jackets"."""
    return holds_for_all(
        lambda target, own, t: touches(own, target, t),
        targets[0].copies, subject.copies, subject.duration_s, always=True,
    )  # fmt: skip


def _is_worn(subject: _Body, targets: list[_Body]) -> bool:
    """It touches them, at a place where such a thing is worn."""
    return targets[0].copies[0].noun.name in WORN and _is_touching(subject, targets)


def _is_on_body(subject: _Body, targets: list[_Body], *, least: float) -> bool:
    """Each target is at one of the subjects, its foot above that share of the subject's height."""

    def is_there(target: Actor, own: Actor, time_s: float) -> bool:
        base, top = part_boxes(own, time_s).hull
        low, high = part_boxes(target, time_s).hull
        # The legs of a child on a back hang down.
        foot = float(low[2] if target.noun.name not in PERSON_NOUNS else 0.5 * (low + high)[2])
        return touches(own, target, time_s) and foot > base[2] + least * (top[2] - base[2])

    copies = targets[0].copies
    return holds_for_all(is_there, copies, subject.copies, subject.duration_s, always=True)


def _is_riding(subject: _Body, targets: list[_Body]) -> bool:
    """Every rider is over it and at it, and not on its roof; no two share a seat."""
    riders, mounts = subject.copies, targets[0].copies
    return holds_for_all(rides, riders, mounts, subject.duration_s, always=True)


def _is_worked_on(subject: _Body, targets: list[_Body]) -> bool:
    """Every worker's hand, or the tip of its tool, touches the thing, and moves."""
    times = [float(t) for t in np.linspace(0.0, subject.duration_s, _HAND_SAMPLES)]
    for worker in subject.copies:
        if worker.noun.name not in PERSON_NOUNS:
            if not holds_for_all(touches, [worker], targets[0].copies, subject.duration_s):
                return False
            continue
        path = worker.trajectory
        hovers = isinstance(path, WorkingAt) and path.work.pattern in HOVERING
        least = _HOVER_M if hovers else _TOUCH_M
        least = _GRASP_M if isinstance(path, ClimbingAt) else least
        tips = np.array([tool_tip(worker, t) for t in times])
        if float(np.ptp(tips, axis=0).max()) < _LEAST_STROKE_M:
            return False
        if not any(
            sample_surface(thing, t).gap(tip) < least
            for t, tip in zip(times, tips, strict=True)
            for thing in targets[0].copies
        ):
            return False
    return True


def _is_given(subject: _Body, targets: list[_Body]) -> bool:
    """The first target is at the subject in the beginning and at the other one in the end."""
    thing = targets[0].copies
    ends = ((subject.copies, 0.0), (targets[-1].copies, subject.duration_s))
    return all(
        any(touches(person, one, time_s) for person in people)
        for people, time_s in ends
        for one in thing
    )


def _is_striking(subject: _Body, targets: list[_Body], *, moves: bool) -> bool:
    return strikes(subject.copies, targets[0].copies, subject.duration_s, moves=moves)


_MOST = 0.5
"""Share of the clip for which it must be there."""
_HAND_SAMPLES = 13
_TOUCH_M = 0.08
"""From the middle of a palm, or the tip of a tool, to a surface that it touches."""
_HOVER_M, _GRASP_M = 0.35, 0.2
_LEAST_STROKE_M = 0.03
_BY_CONTACT = frozenset({"on", "in", "with", *ACTS})
"""Relations that the report names with their subject: "bottle on the conveyor belt"."""
_CHECKS: Mapping[str, Callable[[_Body, list[_Body]], bool]] = {
    "left of": lambda s, t: bool(_middle(s)[0] < _middle(t[0])[0]),
    "right of": lambda s, t: bool(_middle(s)[0] > _middle(t[0])[0]),
    "behind": lambda s, t: bool(np.mean(s.places[:, 1] > t[0].places[:, 1]) > _MOST),
    "front": lambda s, t: bool(np.mean(s.places[:, 1] < t[0].places[:, 1]) > _MOST),
    "beside": _is_near,
    "at": _is_at,
    "with": _is_with,
    "on": _is_on,
    "in": _is_in,
    "on head": partial(_is_on_body, least=0.85),
    "on shoulder": partial(_is_on_body, least=0.4),
    "on back": partial(_is_on_body, least=0.3),
    "on lap": partial(_is_on_body, least=0.2),
    "wear": _is_worn,
    **dict.fromkeys(("hold", "carry", "push", "pull"), _is_touching),
    **dict.fromkeys(("ride", "ride along"), _is_riding),
    "work on": _is_worked_on,
    **dict.fromkeys(("kick", "hit", "throw"), partial(_is_striking, moves=True)),
    "give": _is_given,
    "catch": partial(_is_striking, moves=False),
    "around": _by_copies(goes_round),
    "above": _is_above,
    "under": _is_under,
    "between": _is_between,
    "past": _passes,
    "overtake": _overtakes,
    "through": _goes_through,
    "towards": _by_copies(approaches),
    "from": _by_copies(comes_from),
    "away from": _goes_away,
    "follow": _is_behind_in_line,
}
"""Relation → whether a scene shows it; x is to the right, y away from the viewer."""
