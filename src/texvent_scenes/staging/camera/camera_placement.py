"""Camera placement: where the camera stands and how it moves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.spec.scene import CameraMove
from texvent_scenes.staging.actors import Actor, corners_over
from texvent_scenes.staging.camera.camera_track import (
    CameraTrack,
    Tie,
    TimedMove,
    time_moves,
)
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
    path: CameraTrack
    """The camera's moves, around nothing yet."""

    @property
    def times(self) -> Float64Array:
        return np.linspace(0.0, self.path.duration_s, INSTANTS)


def place_camera(
    description: SceneDescription,
    actors: Sequence[Actor],
    place: str,
    *,
    seed: int,
    aspect: float,
    duration_s: float,
    travel: TravelPlan | None = None,
) -> CameraTrack:
    """The camera over the clip: near enough to recognise the objects and far enough to show them.

    `place` is a key of `PLACES`, `aspect` the image's height over its width; the seed decides the
    angle where nothing is said.
    """
    shot = description.camera
    main = choose_main(description, actors) if actors else None
    watched = main if travel is None and shot.position_m is None else None
    moves = _plan_moves(description, watched, duration_s)
    path = CameraTrack(
        _surroundings_of(description, place, travel), moves, duration_s,
        Tie.of(moves, main) if main is not None and travel is None else None,
        has_floor=PLACES[place].ground is not Ground.NONE and shot.position_m is None,
        journey=None if travel is None else travel.journey,
    )  # fmt: skip
    shooting = _Shooting(description, actors, place, seed, aspect, path)
    if watched is not None:
        path = replace(path, framing=_watch(shooting, watched))
    framing = seen_through(path.framing, shot.field_of_view_deg, is_fixed=watched is None)
    path = replace(path, framing=framing)
    if watched is not None:
        path = _keep_in_view(path, watched, aspect)
    return _keep_in_room(path, shooting, travel) if is_room(place) else path


def _surroundings_of(
    description: SceneDescription, place: str, travel: TravelPlan | None
) -> Framing:
    """The framing of a place, of a route, or of a pose in metres, which moves go through."""
    shot = description.camera
    if travel is not None:  # it looks some way ahead of the middle of the route
        target = np.array([0.0, 0.0, 0.5 * travel.journey.height_m])
        return Framing(target, 0.0, 0.05, max(16.0, 0.8 * travel.length_m), 0.9)
    if shot.position_m is not None:
        return pose(shot.position_m, shot.look_at_m or ())
    if is_room(place):
        return Framing(np.array([0.0, 0.6, 1.1]), 0.0, 0.12, 3.4, 0.9)
    usual = 0.2 if PLACES[place].ground is Ground.RIVER else 0.06
    elevation = ELEVATIONS.get(shot.view or "", usual)
    distance = 16.0 if elevation < 0.5 else 24.0
    return Framing(np.array([0.0, 0.0, 2.0]), 0.0, elevation, distance, 1.0)


def _watch(shooting: _Shooting, main: Actor) -> Framing:
    """The widest framing that shows the objects with a large subject."""
    description, actors, aspect = shooting.description, shooting.actors, shooting.aspect
    moves, times, place = shooting.path.moves, shooting.times, shooting.place
    azimuth, elevation = choose_angles(description, main, moves, place, shooting.seed)
    is_open = shooting.path.has_floor and not is_room(place)
    lift = _SKY_LIFT if is_open and abs(elevation) < 0.3 else 0.0
    copies = [actor for actor in actors if actor.object_index == main.object_index]
    boxes = [np.array([one.corners(float(time)) for one in copies]) for time in times]

    def prominence(framing: Framing) -> float:
        path = replace(shooting.path, framing=framing)
        views = zip(times, boxes, strict=True)
        return float(np.mean([measure_prominence(path.at(float(t)), b, aspect) for t, b in views]))

    views = list_framing_choices(description, actors, main, moves, times)
    framings = [
        fit(one.points, azimuth=azimuth, elevation=elevation, aspect=aspect, fill=one.fill,
            lift=lift)
        for one in views
    ]  # fmt: skip
    return come_near(framings, prominence, [view.goal for view in views[1:]])


def _keep_in_view(path: CameraTrack, main: Actor, aspect: float) -> CameraTrack:
    """The path with smaller moves if the subject would leave the picture."""
    for _ in range(_TRIES):
        if _is_visible(path, main, aspect):
            break
        damped = tuple(
            one._replace(move=replace(one.move, pace=0.75 * one.move.pace))
            if one.move.kind in _LEAVING
            else one
            for one in path.moves
        )
        path = replace(path, moves=damped)
    return path


def _is_visible(path: CameraTrack, main: Actor, aspect: float) -> bool:
    """Whether the middle of the subject is in the picture for nearly all of the clip."""
    half = np.array([0.49, 0.49 * aspect])
    times = np.linspace(0.0, path.duration_s, _CHECKS)
    seen = np.array([image_of(path.at(float(t)), main.middle(float(t))) for t in times])
    is_inside = np.all(np.abs(seen[:, :2]) < half, axis=1) & (seen[:, 2] > 0.0)
    return bool(is_inside.mean() >= _VISIBLE_SHARE)


def _keep_in_room(path: CameraTrack, shooting: _Shooting, travel: TravelPlan | None) -> CameraTrack:
    """The path in a room that holds the camera and the objects."""
    actors, objects = shooting.actors, shooting.description.objects
    if travel is not None:
        middle = [0.5 * path.duration_s]
        corners = corners_over(actors, middle) if actors else np.zeros((1, 3))
        reach = float(np.abs(corners[:, :2]).max())
        return replace(path, room_m=max(0.5 * travel.length_m + 3.5, reach + 0.8))
    near = [one for one in actors if objects[one.object_index].placement != "far"]
    corners = corners_over(near or actors, shooting.times) if actors else np.zeros((1, 3))
    return path.in_room(corners, shooting.times)


def _plan_moves(
    description: SceneDescription, main: Actor | None, duration_s: float
) -> tuple[TimedMove, ...]:
    """The moves that are said, each kind once at a time; else the subject is followed if fast."""
    timed = time_moves(description.camera.moves, duration_s)
    said = {(one.move.kind, one.begin_s, one.end_s): one for one in timed}
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
    if displacement_m <= least * span:
        return ()
    return tuple(time_moves([CameraMove("follow")], duration_s))
