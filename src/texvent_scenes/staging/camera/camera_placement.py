"""Camera placement: where the camera stands and how it moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.spec.scene import CameraMove
from texvent_scenes.staging.actors import Actor, corners_over
from texvent_scenes.staging.camera.camera_trajectory import CameraTrajectory, Tie
from texvent_scenes.staging.camera.framing import (
    Framing,
    come_near,
    fit,
    image_of,
    measure_prominence,
    pose,
    seen_through,
)
from texvent_scenes.staging.camera.journey import TravelPlan
from texvent_scenes.staging.camera.subject import (
    ELEVATIONS,
    INSTANTS,
    KEPT_TOGETHER,
    choose_angles,
    choose_main,
    list_framing_choices,
)

_SKY_LIFT = 0.2
"""Height of the optical axis above what matters outdoors, in half image heights."""
_TRACKING_LENGTHS, _NEAR_LENGTHS = 3.0, 0.3
"""Lengths of its own from which on an object is followed: usually, and in a close or medium shot.
"""
_LEAVING = frozenset({"pan", "tilt", "truck", "pedestal", "zoom", "dolly"})
"""Moves that can lose the subject."""
_VISIBLE_SHARE, _CHECKS, _TRIES = 0.97, 41, 10
"""Share of the clip in which the subject's middle is in the image at least, at so many instants;
and how often moves are made smaller for it."""


@dataclass(frozen=True)
class _Shooting:
    """Constraints on the camera's placement."""

    description: SceneDescription
    actors: Sequence[Actor]
    place: str
    seed: int
    aspect: float
    """Image height over width."""
    duration_s: float

    @property
    def has_floor(self) -> bool:
        return PLACES[self.place].ground is not Ground.NONE

    @property
    def times(self) -> Float64Array:
        return np.linspace(0.0, self.duration_s, INSTANTS)


def place_camera(
    description: SceneDescription,
    actors: Sequence[Actor],
    place: str,
    *,
    seed: int,
    aspect: float,
    duration_s: float,
    travel: TravelPlan | None = None,
) -> CameraTrajectory:
    """The camera over the clip: near enough to recognise the objects and far enough to show them.

    `place` is a key of `PLACES`, `aspect` the image's height over its width; the seed decides the
    angle where nothing is said.
    """
    shooting = _Shooting(description, actors, place, seed, aspect, duration_s)
    is_fixed = travel is not None or description.camera.position_m is not None or not actors
    if travel is not None:
        path = _travel(shooting, travel)
    elif description.camera.position_m is not None:
        path = _stand_at(shooting)
    else:
        path = _watch(shooting) if actors else _look_around(shooting)
    angle_deg = description.camera.field_of_view_deg
    path = replace(path, framing=seen_through(path.framing, angle_deg, is_fixed=is_fixed))
    if actors and not is_fixed:
        path = _keep_in_view(path, choose_main(description, actors), shooting)
    if travel is not None or not is_room(place):
        return path
    near = [one for one in actors if description.objects[one.object_index].placement != "far"]
    corners = corners_over(near or actors, shooting.times) if actors else np.zeros((1, 3))
    return path.in_room(corners, shooting.times)


def _watch(shooting: _Shooting) -> CameraTrajectory:
    """The widest camera that shows the objects with a large subject."""
    description, actors, aspect = shooting.description, shooting.actors, shooting.aspect
    main, times = choose_main(description, actors), shooting.times
    moves = _plan_moves(description, main, shooting.duration_s)
    place = shooting.place
    azimuth, elevation = choose_angles(description, main, moves, place, shooting.seed)
    is_open = shooting.has_floor and not is_room(place)
    lift = _SKY_LIFT if is_open and abs(elevation) < 0.3 else 0.0
    copies = [actor for actor in actors if actor.object_index == main.object_index]
    boxes = [np.array([one.corners(float(time)) for one in copies]) for time in times]
    tie = Tie.of(moves, main)

    def path_of(framing: Framing) -> CameraTrajectory:
        return CameraTrajectory(framing, moves, shooting.duration_s, tie, shooting.has_floor)

    def prominence(framing: Framing) -> float:
        path, views = path_of(framing), zip(times, boxes, strict=True)
        return float(np.mean([measure_prominence(path.at(float(t)), b, aspect) for t, b in views]))

    views = list_framing_choices(description, actors, main, moves, times)
    framings = [
        fit(one.points, azimuth=azimuth, elevation=elevation, aspect=aspect, fill=one.fill,
            lift=lift)
        for one in views
    ]  # fmt: skip
    return path_of(come_near(framings, prominence, [view.goal for view in views[1:]]))


def _keep_in_view(path: CameraTrajectory, main: Actor, shooting: _Shooting) -> CameraTrajectory:
    """The path with smaller moves if the subject would leave the picture."""
    for _ in range(_TRIES):
        if _is_visible(path, main, shooting.aspect):
            break
        damped = tuple(
            replace(move, pace=0.75 * move.pace) if move.kind in _LEAVING else move
            for move in path.moves
        )
        path = replace(path, moves=damped)
    return path


def _is_visible(path: CameraTrajectory, main: Actor, aspect: float) -> bool:
    """Whether the middle of the subject is in the picture for nearly all of the clip."""
    half = np.array([0.49, 0.49 * aspect])
    times = np.linspace(0.0, path.duration_s, _CHECKS)
    seen = np.array([image_of(path.at(float(t)), main.middle(float(t))) for t in times])
    is_inside = np.all(np.abs(seen[:, :2]) < half, axis=1) & (seen[:, 2] > 0.0)
    return bool(is_inside.mean() >= _VISIBLE_SHARE)


def _look_around(shooting: _Shooting) -> CameraTrajectory:
    """A camera in a place where the scene has no object."""
    usual = 0.2 if PLACES[shooting.place].ground is Ground.RIVER else 0.06
    elevation = ELEVATIONS.get(shooting.description.camera.view or "", usual)
    distance = 16.0 if elevation < 0.5 else 24.0
    empty = Framing(np.array([0.0, 0.0, 2.0]), 0.0, elevation, distance, 1.0)
    if is_room(shooting.place):
        empty = Framing(np.array([0.0, 0.6, 1.1]), 0.0, 0.12, 3.4, 0.9)
    moves = _plan_moves(shooting.description, None, shooting.duration_s)
    return CameraTrajectory(empty, moves, shooting.duration_s, has_floor=shooting.has_floor)


def _stand_at(shooting: _Shooting) -> CameraTrajectory:
    """The camera where metres say; its moves go through that pose at mid clip."""
    description, actors = shooting.description, shooting.actors
    framing = pose(description.camera.position_m or (), description.camera.look_at_m or ())
    moves = _plan_moves(description, None, shooting.duration_s)
    tie = Tie.of(moves, choose_main(description, actors)) if actors else None
    return CameraTrajectory(framing, moves, shooting.duration_s, tie, has_floor=False)


def _travel(shooting: _Shooting, travel: TravelPlan) -> CameraTrajectory:
    """A camera on a route; what it looks at is some way ahead of the middle of the route."""
    target = np.array([0.0, 0.0, 0.5 * travel.journey.height_m])
    framing = Framing(target, 0.0, 0.05, max(16.0, 0.8 * travel.length_m), 0.9)
    moves = _plan_moves(shooting.description, None, shooting.duration_s)
    room = math.inf
    if is_room(shooting.place):
        middle = [0.5 * shooting.duration_s]
        corners = corners_over(shooting.actors, middle) if shooting.actors else np.zeros((1, 3))
        room = max(0.5 * travel.length_m + 3.5, float(np.abs(corners[:, :2]).max()) + 0.8)
    return CameraTrajectory(framing, moves, shooting.duration_s, has_floor=shooting.has_floor,
                      room_m=room, journey=travel.journey)  # fmt: skip


def _plan_moves(
    description: SceneDescription, main: Actor | None, duration_s: float
) -> tuple[CameraMove, ...]:
    """The moves that are said, each kind once at a time; else the subject is followed if fast."""
    said = {(one.kind, one.phase): one for one in description.camera.moves}
    if main is None or said or not main.is_mover:
        return tuple(said.values())
    has_landmark = any(
        relation.kind in KEPT_TOGETHER and relation.subject == main.object_index
        for relation in description.relations
    )
    motion = description.objects[main.object_index].motion
    if has_landmark or (motion is not None and motion.direction in ("towards", "away")):
        return ()
    span = max(main.model.length, main.model.height)
    displacement_m = float(np.hypot(*(main.middle(duration_s) - main.middle(0.0))[:2]))
    is_near = description.camera.framing in ("close", "medium")
    least = _NEAR_LENGTHS if is_near else _TRACKING_LENGTHS
    return (CameraMove("follow"),) if displacement_m > least * span else ()
