"""How near the camera is to a person who acts with arms and head alone."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from itertools import product

import numpy as np

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.anchors import has_places, locate
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.people.props import Prop
from texvent.scenes.models.shapes import bounds, compose, moved
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.closeness import STAYING, is_open
from texvent.scenes.staging.camera.framed_points import FOREARM, upper_part
from texvent.scenes.staging.camera.framing import Framing, fit
from texvent.scenes.staging.trajectories.trajectory import Stationary

WAIST = 0.45
"""Share of a person's height below which the image may end."""
_FILL = 0.9
_NEARER = 0.95
"""The camera moves only for less than this share of its distance."""
_STILL = 0.05
"""What moves by less than this share of a person's height rests."""
_POSTURES = ("sit", "kneel", "crouch", "squat", "stretch leg", "bend back", "lean")
"""Told by the legs."""
_FEET = ("left foot", "right foot", "seat")


def come_near_arms(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    path: CameraPath,
    path_of: Callable[[Framing], CameraPath],
    times: Float64Array,
    aspect: float,
) -> CameraPath:
    """The camera as near as the waist of people who stand and move their arms alone.

    In a picture of the whole person a hand that plays an instrument is a few pixels. All else that
    the prompt names stays in the picture.

    Args:
        description: what the prompt says of the camera.
        actors: its objects.
        main: the subject.
        path: the camera that shows the subject.
        path_of: the camera over the clip from a framing.
        times: instants at which all must fit, s.
        aspect: image height over width.

    Returns:
        The path, from nearer where that shows the act better.
    """
    moves = (*description.shot.moves, *path.moves)
    if not is_open(description) or any(move.kind not in STAYING for move in moves):
        return path
    if _needs_whole_body(description, main):
        return path
    people = [one for one in actors if one.object_index == main.object_index]
    is_active = main.is_mover or main.noun.name in HAND_NOUNS
    if not is_active or not all(_stays_on_the_spot(one, times) for one in people):
        return path
    boxes = [_part_of_interest(one, times) for one in actors]
    boxes += [_box_of(prop, one, times) for one in actors for prop in one.props]
    wide = path.framing
    near = fit(np.vstack(boxes), azimuth=wide.azimuth, elevation=wide.elevation, aspect=aspect,
               fill=_FILL, focal=wide.focal)  # fmt: skip
    return path if near.distance_m > _NEARER * wide.distance_m else path_of(near)


def _needs_whole_body(description: SceneDescription, main: Actor) -> bool:
    """Whether the prompt says how its body is held, or what it wears: shoes perhaps."""
    wears = any(
        one.kind == "wear" and one.subject == main.object_index for one in description.relations
    )
    motion = description.objects[main.object_index].motion
    is_posture = motion is not None and motion.kind in _POSTURES
    return wears or is_posture or any(word.startswith("stand") for word in description.shown)


def _part_of_interest(actor: Actor, times: Float64Array) -> Float64Array:
    """[n, 3] corners of what the image must hold of it, m."""
    boxes = corners_over([actor], times)
    if not _stays_on_the_spot(actor, times):
        return boxes
    return upper_part(boxes, FOREARM if actor.noun.name in HAND_NOUNS else WAIST)


def _stays_on_the_spot(actor: Actor, times: Float64Array) -> bool:
    """Whether it is a hand that stays, or a person whose feet and seat do."""
    if actor.noun.name in HAND_NOUNS:
        return isinstance(actor.trajectory, Stationary)
    if actor.noun.name not in PERSON_NOUNS or not has_places(actor.model):
        return False
    limit = _STILL * actor.model.height
    return all(_reach(actor, name, times) < limit for name in _FEET)


def _reach(actor: Actor, name: str, times: Float64Array) -> float:
    """How far a named place of the body moves in the clip along any axis, m."""
    places = [actor.anchor(name, float(time))[:, 3] for time in times]
    return float(np.ptp(places, axis=0).max())


def _box_of(prop: Prop, actor: Actor, times: Float64Array) -> Float64Array:
    """[n, 3] corners of the boxes of what an activity needs, in the world, m."""
    parts = []
    for time in map(float, times):
        pose = actor.pose(time)
        axes = locate(actor.model, prop.anchor, pose)
        parts += moved(prop.draw(pose.time_s), compose(actor.trajectory.at(time).to_world(), axes))
    low, high = bounds(parts)
    return np.array(list(product(*zip(low, high, strict=True))))
