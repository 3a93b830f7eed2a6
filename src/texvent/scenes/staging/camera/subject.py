"""The subject: which object the camera is about, and how it and others move."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.anchors import has_places
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.trajectories.trajectory import Stationary

KEPT_TOGETHER = frozenset(
    {"at", "on", "in", "above", "under", "behind", "front", "beside", "between", "around",
     "left of", "right of", "look at"}
)  # fmt: skip
"""Relations of which both things must be in the picture."""
_CROSSED = 0.7
"""How far, in its lengths or heights, a subject goes in the image of a camera that goes along."""
_ALONG = 0.7
"""What goes along with the subject strays by so many of its sizes at most."""
_STIRS = 0.25
"""How far, in its own sizes, a thing that works in its place may stir."""
_RESTS = 0.05
"""How far, in its heights, the lower body of a person on the spot may move."""
_BELOW = ("left foot", "right foot", "seat")
_OF_WHOLE_BODY = frozenset(
    {"sit", "kneel", "crouch", "squat", "lie", "push-up", "dribble", "sweep", "row", "surf"}
)
"""Activities of which the legs, or what is at the feet, tell."""


def choose_main(description: SceneDescription, actors: Sequence[Actor]) -> Actor:
    """The object the camera is about: as said, or the first that moves or could."""
    target = description.shot.target
    for actor in actors:
        if target is not None and actor.object_index == target:
            return actor
    for actor in actors:
        if actor.enters or actor.leaves:
            return actor
    able = (one for one in actors if one.is_mover or _is_able(one))
    return next(able, actors[0])


def _is_able(actor: Actor) -> bool:
    return actor.noun.speed_m_s > 0.0 and actor.noun.habitat != "fixed"


def list_related(description: SceneDescription, main: Actor) -> set[int]:
    """The objects that a relation ties to the subject."""
    related = {
        index
        for relation in description.relations
        if main.object_index in (relation.subject, *relation.targets)
        for index in (relation.subject, *relation.targets)
    }
    return related - {main.object_index}


def has_landmark(description: SceneDescription, main: Actor) -> bool:
    """Whether the subject is placed by something that must stay in the picture."""
    return any(
        relation.kind in KEPT_TOGETHER and relation.subject == main.object_index
        for relation in description.relations
    )


def goes_in_depth(description: SceneDescription, main: Actor) -> bool:
    """Whether the scene says that it comes towards the camera or goes away from it."""
    motion = description.objects[main.object_index].motion
    return motion is not None and motion.direction in ("towards", "away")


def share_to_follow(actors: Sequence[Actor], main: Actor, duration_s: float) -> float:
    """Share of the subject's way that the camera should go along, so that it can be large.

    It still crosses the image. 0 where it hardly goes, or where other things do not go with it.
    """
    way = main.middle(duration_s) - main.middle(0.0)
    span = max(main.model.length, main.model.height)
    apart = [
        float(np.linalg.norm(actor.middle(duration_s) - actor.middle(0.0) - way))
        for actor in actors
    ]
    if max(apart) > _ALONG * span or main.enters or main.leaves:
        return 0.0
    return max(0.0, 1.0 - _CROSSED * span / max(float(np.linalg.norm(way)), 1e-6))


def goes(actor: Actor, times: Float64Array) -> bool:
    """Whether it moves from where it is; a lighthouse and a swing only work there."""
    if not actor.is_mover or actor.noun.habitat != "fixed":
        return actor.is_mover
    places = [actor.middle(float(time)) for time in times]
    return float(np.ptp(places, axis=0).max()) > _STIRS * actor.size_m


def acts_with_arms(actor: Actor, times: Float64Array) -> bool:
    """Whether it is a hand that stays, or a person who acts on the spot with arms and head."""
    if actor.noun.name in HAND_NOUNS:
        return isinstance(actor.trajectory, Stationary)
    if actor.noun.name not in PERSON_NOUNS or not has_places(actor.model) or not actor.is_mover:
        return False
    if actor.pose(float(times[0])).activity in _OF_WHOLE_BODY:
        return False
    places = np.array([[actor.anchor(one, float(t))[:, 3] for one in _BELOW] for t in times])
    return float(np.ptp(places, axis=0).max()) < _RESTS * actor.model.height
