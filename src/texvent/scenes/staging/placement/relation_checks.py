"""Whether the staged scene shows the relations that the prompt states; what it does not show."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.inflection import pluralise
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor

_INSTANTS = 25
_PHRASES = {
    "beside": "next to",
    "front": "in front of",
    "follow": "following",
    "overtake": "overtaking",
    "with": "with",
}
"""Relation → words for it, where they differ from its name."""


class _Body(NamedTuple):
    """All copies of an object over the clip."""

    places: Float64Array
    """[n, 3] mean of their middles at each instant, m."""
    low: Float64Array
    """[n, 3] least corner of all, m."""
    high: Float64Array


def list_not_shown(
    description: SceneDescription, actors: Sequence[Actor], duration_s: float
) -> list[str]:
    """Relations of the prompt that its objects do not have in the scene.

    Args:
        description: what the prompt says.
        actors: the objects on their trajectories; what stands around as scenery is none of them.
        duration_s: length of the clip, s.

    Returns:
        Words such as "under the table", in the order of the relations.
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
            missing.append(f"{_PHRASES.get(relation.kind, relation.kind)} the {names}")
    return missing


def _name(description: SceneDescription, index: int) -> str:
    scene_object = description.objects[index]
    return scene_object.noun if scene_object.count == 1 else pluralise(scene_object.noun)


def _measure(actors: Sequence[Actor], times: Float64Array) -> _Body:
    corners = np.array([[actor.corners(float(t)) for actor in actors] for t in times])
    middles = np.array([[actor.middle(float(t)) for actor in actors] for t in times])
    return _Body(middles.mean(axis=1), corners.min(axis=(1, 2)), corners.max(axis=(1, 2)))


def _gaps(subject: _Body, target: _Body) -> Float64Array:
    """[n] metres over the ground between the boxes of two bodies; 0 where they overlap."""
    apart = np.maximum(subject.low - target.high, target.low - subject.high)[:, :2]
    return np.asarray(np.hypot(*np.maximum(apart, 0.0).T))


def _size(body: _Body) -> float:
    return float(np.max(body.high - body.low))


def _is_near(subject: _Body, targets: list[_Body]) -> bool:
    reach = 1.5 * (_size(subject) + max(_size(target) for target in targets)) + 1.0
    return all(float(_gaps(subject, target).min()) < reach for target in targets)


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
    is_lower = subject.places[:, 2] < target.high[:, 2]
    return bool(np.any((gaps <= 0.05) & is_lower))


def _is_between(subject: _Body, targets: list[_Body]) -> bool:
    if len(targets) < 2:
        return True
    first, second = _middle(targets[0])[:2], _middle(targets[1])[:2]
    way = second - first
    share = float((_middle(subject)[:2] - first) @ way) / max(float(way @ way), 1e-9)
    return 0.1 < share < 0.9


def _comes_nearer(subject: _Body, targets: list[_Body]) -> bool:
    apart = np.linalg.norm(subject.places - targets[0].places, axis=1)
    return bool(apart[-1] < apart[0])


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
    inside = np.all((subject.places > target.low) & (subject.places < target.high), axis=1)
    return bool(np.any(inside))


def _is_behind_in_line(subject: _Body, targets: list[_Body]) -> bool:
    target = targets[0]
    if np.linalg.norm(target.places[-1] - target.places[0]) < 0.05:
        return True
    return bool(np.all(_along(target, subject) > 0.0))


_CHECKS: Mapping[str, Callable[[_Body, list[_Body]], bool]] = {
    "left of": lambda s, t: bool(_middle(s)[0] < _middle(t[0])[0]),
    "right of": lambda s, t: bool(_middle(s)[0] > _middle(t[0])[0]),
    "behind": lambda s, t: bool(np.any(s.places[:, 1] > t[0].places[:, 1])),
    "front": lambda s, t: bool(np.any(s.places[:, 1] < t[0].places[:, 1])),
    "beside": _is_near,
    "with": _is_near,
    "around": _is_near,
    "above": _is_above,
    "under": _is_under,
    "between": _is_between,
    "past": _passes,
    "overtake": _overtakes,
    "through": _goes_through,
    "towards": _comes_nearer,
    "from": _goes_away,
    "away from": _goes_away,
    "follow": _is_behind_in_line,
}
"""Relation → whether a scene shows it; x is to the right, y away from the viewer."""
