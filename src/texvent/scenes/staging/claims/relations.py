"""Whether the staged scene shows the relations that the prompt states; what it does not show."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial

import numpy as np

from texvent.scenes.description import Relation, SceneDescription
from texvent.scenes.evidence import Unmet
from texvent.scenes.inflection import pluralise
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.people.work.verbs import HOVERING
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.acts import ACTS
from texvent.scenes.staging.acts.climbing import ClimbingAt, OnStairs
from texvent.scenes.staging.acts.hand_work.surface_points import sample_surface
from texvent.scenes.staging.acts.hand_work.working import WorkingAt, tool_tip
from texvent.scenes.staging.acts.holding import GARMENTS, WORN
from texvent.scenes.staging.claims.bodies import gap, part_boxes
from texvent.scenes.staging.claims.contact import (
    collide,
    hangs_on,
    holds_for_all,
    is_in,
    is_on,
    moves_parts,
    rides,
    strikes,
    touches,
)
from texvent.scenes.staging.claims.courses import (
    approaches,
    comes_from,
    faces,
    goes_round,
    lifts_from,
)
from texvent.scenes.staging.claims.positions import (
    BESIDE,
    BESIDE_M,
    Body,
    gaps,
    goes_away,
    goes_through,
    is_above,
    is_behind_in_line,
    is_between,
    is_near,
    is_under,
    measure,
    middle_of,
    moves,
    overtakes,
    passes,
    size_of,
)
from texvent.scenes.staging.claims.ways import WAYS
from texvent.scenes.staging.placement.cages import CAGES
from texvent.scenes.staging.placement.faced import LOOKED_AT, hangs
from texvent.scenes.staging.placement.spatial_relations import GATES
from texvent.scenes.staging.placement.tables.at_table import turned_to
from texvent.scenes.wording import RELATION_WORDS

_INSTANTS = 13
_PHRASES = {**RELATION_WORDS, "beside": "next to"}
"""Relation → words for it, where they differ from its name."""
_SMALL = 0.35
"""Share of a low thing's size up to which what it is "with" stands on it or in it."""
_LOW_M = 2.0


_Check = Callable[[Body, list[Body]], bool]
_LIFTING = frozenset({"rise", "jump", "fall"})
"""Motions that begin at the surface of what they lead away from."""
_Course = Callable[[Sequence[Actor], Sequence[Actor], float], bool]


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
    bodies: dict[int, Body] = {}
    times = np.linspace(0.0, duration_s, _INSTANTS)
    missing = []
    for relation in description.relations:
        known = {actor.object_index for actor in actors}
        if not {relation.subject, *relation.targets} <= known:
            continue
        for index in (relation.subject, *relation.targets):
            if index not in bodies:
                copies = [actor for actor in actors if actor.object_index == index]
                bodies[index] = measure(copies, times)
        targets = [bodies[index] for index in relation.targets]
        checks = _list_checks(relation, description)
        if not all(check(bodies[relation.subject], targets) for check in checks):
            names = " and ".join(_name(description, index) for index in relation.targets)
            said = relation.way or _PHRASES.get(relation.kind, relation.kind)
            words = f"{said} the {names}"
            is_named = relation.kind in _BY_CONTACT
            text = f"{_name(description, relation.subject)} {words}" if is_named else words
            missing.append(Unmet(text, relation=(relation.subject, relation.targets)))
    return missing


def _list_checks(relation: Relation, description: SceneDescription) -> list[_Check]:
    """What must hold of a relation: what its preposition says, and the verb of its subject."""
    motion = description.objects[relation.subject].motion
    checks = [CHECKS[relation.kind]]
    is_lifting = motion is not None and motion.kind in _LIFTING and relation.way != "out of"
    if relation.kind == "from" and is_lifting:
        checks = [_by_copies(lifts_from)]
    if relation.kind == "past" and not relation.way and motion is not None and motion.is_moving:
        checks.append(_one_goes)
    return checks + ([WAYS[relation.way]] if relation.way else [])


def _one_goes(subject: Body, targets: list[Body]) -> bool:
    """Whether who goes past something leaves its place, or the thing does."""
    return moves(subject) or any(moves(one) for one in targets)


def _name(description: SceneDescription, index: int) -> str:
    scene_object = description.objects[index]
    return scene_object.noun if scene_object.count == 1 else pluralise(scene_object.noun)


def _is_in_front(subject: Body, targets: list[Body]) -> bool:
    """Nearer to the viewer; before a mirror or a screen, near it and turned to it."""
    target = targets[0]
    if subject.copies[0].noun.name == "crosswalk" and target.copies[0].noun.motion == "drive":
        return _lead(target, subject, target.duration_s) > _PAST_END
    looks = target.copies[0].noun.name in LOOKED_AT and subject.copies[0].noun.habitat == "ground"
    if looks and not subject.copies[0].noun.is_working:
        goals = list(target.copies)
        return is_near(subject, targets) and faces(subject.copies, goals, subject.duration_s)
    return _is_behind(target, [subject])


def _is_in_traffic(subject: Body, vehicle: Body) -> bool:
    """Whether "behind" means behind its tail: of who drives or walks, at a vehicle that drives."""
    one, other = subject.copies[0], vehicle.copies[0]
    return other.noun.motion == "drive" and other.is_mover and one.noun.motion in _IN_TRAFFIC


_IN_TRAFFIC = frozenset({"drive", "walk", "run"})
_PAST_END = 0.5
"""Lengths of a vehicle from its middle to its ends."""


def _lead(vehicle: Body, other: Body, time_s: float) -> float:
    """How far something is ahead of a vehicle's middle, along its heading, in its lengths."""
    one = vehicle.copies[0]
    way = (other.copies[0].middle(time_s) - one.middle(time_s))[:2]
    front = one.trajectory.at(time_s).to_world()[:2, 0]
    return float(way @ front) / one.model.length


def _is_behind(subject: Body, targets: list[Body]) -> bool:
    """Farther from the viewer, and in line with the target at some instant."""
    target = targets[0]
    if _is_in_traffic(subject, target):
        return _lead(target, subject, 0.0) < -_PAST_END
    aside = np.maximum(subject.low - target.high, target.low - subject.high)[:, 0]
    reach = _ASIDE * max(size_of(subject), size_of(target))
    is_farther = np.mean(subject.places[:, 1] > target.places[:, 1]) > _MOST
    return bool(is_farther and np.any(aside <= reach))


def _is_amid(subject: Body, targets: list[Body]) -> bool:
    """Copies of the targets stand to several sides of it."""
    copies = [copy for target in targets for copy in target.copies]
    return len(copies) > 1 and goes_round(copies, subject.copies, subject.duration_s)


def _is_at(subject: Body, targets: list[Body]) -> bool:
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


def _by_copies(holds: _Course) -> Callable[[Body, list[Body]], bool]:
    """A check of the single copies."""
    return lambda subject, targets: holds(
        subject.copies, [copy for one in targets for copy in one.copies], subject.duration_s
    )


def _is_on(subject: Body, targets: list[Body]) -> bool:
    """On it; where the target's parts move and it stays in its place, it is carried along."""
    target = targets[0]
    is_cloth = target.copies[0].noun.name in {*WORN, *GARMENTS}
    if is_cloth and subject.copies[0].noun.name in PERSON_NOUNS:
        return False  # "works on a scarf" does not mean to stand on it
    if hangs(subject.copies[0].noun, target.copies[0].noun):
        return holds_for_all(hangs_on, subject.copies, target.copies, subject.duration_s)
    if not holds_for_all(is_on, subject.copies, target.copies, subject.duration_s):
        return False
    if not target.copies[0].noun.is_working or subject.copies[0].is_mover:
        return True
    times = np.linspace(0.0, subject.duration_s, 5) * 0.93
    return moves_parts(subject.copies[0], times) or not moves_parts(target.copies[0], times)


def _is_in(subject: Body, targets: list[Body]) -> bool:
    if targets[0].copies[0].noun.name in GATES:
        return goes_through(subject, targets) or WAYS["into"](subject, targets)
    is_caged = targets[0].copies[0].noun.name in CAGES
    copies = subject.copies
    if len(copies) >= _PILED and copies[0].noun.habitat == "fixed":
        # The upper ones of a pile lie on those that are in it.
        upwards = sorted(copies, key=lambda one: float(one.middle(0.0)[2]))
        copies = tuple(upwards[: len(copies) // 2])
    return holds_for_all(is_in, copies, targets[0].copies, subject.duration_s, always=is_caged)


_PILED = 4


def _is_with(subject: Body, targets: list[Body]) -> bool:
    """Near it; a small thing that does not move is on what is low and as still, or in it."""
    if not is_near(subject, targets):
        return False
    own, other = subject.copies[0], targets[0].copies[0]
    if own.is_mover and other.noun.motion == "stand":
        # What goes along is near all the time.
        reach = BESIDE * max(size_of(subject), size_of(targets[0])) + BESIDE_M
        return float(gaps(subject, targets[0]).max()) < reach
    if _is_fitted(own, other) or (own.noun.name in HAND_NOUNS and other.noun.motion == "stand"):
        return holds_for_all(
            touches, targets[0].copies, subject.copies, subject.duration_s, always=True
        )
    is_still = own.noun.habitat == "fixed" and other.noun.habitat == "fixed"
    is_load = other.size_m < _SMALL * own.size_m and own.model.height < _LOW_M
    if not (is_still and is_load):
        return True
    return holds_for_all(touches, targets[0].copies, subject.copies, subject.duration_s)


def _is_fitted(own: Actor, other: Actor) -> bool:
    """As in "a truck with two flags": a thing with what goes nowhere by itself has it on it."""
    goes = own.noun.motion in ("drive", "sail", "fly", "orbit") or own.noun.name in _MACHINES
    return goes and other.noun.motion == "stand" and other.size_m < own.size_m


_MACHINES = frozenset({"satellite", "rover"})


def _is_touching(subject: Body, targets: list[Body]) -> bool:
    """Each target is at one of the subjects: "two people wearing three jackets"."""
    return holds_for_all(
        lambda target, own, t: touches(own, target, t),
        targets[0].copies, subject.copies, subject.duration_s, always=True,
    )  # fmt: skip


def _is_worn(subject: Body, targets: list[Body]) -> bool:
    """It touches them, at a place where such a thing is worn."""
    return targets[0].copies[0].noun.name in WORN and _is_touching(subject, targets)


def _is_on_body(subject: Body, targets: list[Body], *, least: float) -> bool:
    """Each target is at one of the subjects, its foot above that share of the subject's height."""

    def is_there(target: Actor, own: Actor, time_s: float) -> bool:
        base, top = part_boxes(own, time_s).hull
        low, high = part_boxes(target, time_s).hull
        # The legs of a child on a back hang down.
        foot = float(low[2] if target.noun.name not in PERSON_NOUNS else 0.5 * (low + high)[2])
        return touches(own, target, time_s) and foot > base[2] + least * (top[2] - base[2])

    copies = targets[0].copies
    return holds_for_all(is_there, copies, subject.copies, subject.duration_s, always=True)


def _is_riding(subject: Body, targets: list[Body]) -> bool:
    """Every rider is over it and at it, and not on its roof; no two share a seat."""
    riders, mounts = subject.copies, targets[0].copies
    return holds_for_all(rides, riders, mounts, subject.duration_s, always=True)


def _is_worked_on(subject: Body, targets: list[Body]) -> bool:
    """Every worker's hand, or the tip of its tool, touches the thing, and moves."""
    times = [float(t) for t in np.linspace(0.0, subject.duration_s, _HAND_SAMPLES)]
    for worker in subject.copies:
        if worker.noun.name not in PERSON_NOUNS:
            if not holds_for_all(touches, [worker], targets[0].copies, subject.duration_s):
                return False
            continue
        path = worker.trajectory
        if isinstance(path, OnStairs):
            continue
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


def _is_given(subject: Body, targets: list[Body]) -> bool:
    """The first target is at the subject in the beginning and at the other one in the end."""
    thing = targets[0].copies
    ends = ((subject.copies, 0.0), (targets[-1].copies, subject.duration_s))
    return all(
        any(touches(person, one, time_s) for person in people)
        for people, time_s in ends
        for one in thing
    )


def _is_striking(subject: Body, targets: list[Body], *, moves: bool) -> bool:
    return strikes(subject.copies, targets[0].copies, subject.duration_s, moves=moves)


_ASIDE = 0.1
"""Gap to the side, as a share of the larger one, up to which one thing is behind another."""
_MOST = 0.5
"""Share of the clip for which it must be there."""
_HAND_SAMPLES = 13
_TOUCH_M = 0.08
"""From the middle of a palm, or the tip of a tool, to a surface that it touches."""
_HOVER_M, _GRASP_M = 0.35, 0.2
_LEAST_STROKE_M = 0.03
_BY_CONTACT = frozenset({"on", "in", "with", *ACTS})
"""Relations that the report names with their subject: "bottle on the conveyor belt"."""
CHECKS: Mapping[str, Callable[[Body, list[Body]], bool]] = {
    "left of": lambda s, t: bool(middle_of(s)[0] < middle_of(t[0])[0]),
    "right of": lambda s, t: bool(middle_of(s)[0] > middle_of(t[0])[0]),
    "behind": _is_behind,
    "front": _is_in_front,
    "beside": is_near,
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
    "collide": lambda s, t: collide(s.copies, t[0].copies, s.duration_s),
    **dict.fromkeys(("surround", "among"), _is_amid),
    "catch": partial(_is_striking, moves=False),
    "around": _by_copies(goes_round),
    "above": is_above,
    "under": is_under,
    "between": is_between,
    "past": passes,
    "overtake": overtakes,
    "through": goes_through,
    "towards": _by_copies(approaches),
    "from": _by_copies(comes_from),
    "away from": goes_away,
    "follow": is_behind_in_line,
    "look at": _by_copies(faces),
}
"""Relation → whether a scene shows it; x is to the right, y away from the viewer. What surrounds
as scenery is counted where it is placed (`compose`)."""
