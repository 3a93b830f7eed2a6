"""Camera placement: where the camera stands and how it moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.models.places import is_room
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, corners_over
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.closeness import come_near_small, eye_level
from texvent.scenes.staging.camera.following import (
    crosses_picture,
    goes_in_depth,
    has_landmark,
    share_to_follow,
    stay_together,
)
from texvent.scenes.staging.camera.framed_points import INSTANTS, list_related, list_views
from texvent.scenes.staging.camera.framing import Framing, fit, pose, seen_through
from texvent.scenes.staging.camera.journey import TravelPlan
from texvent.scenes.staging.camera.laid_table import ELEVATION_RAD, is_on_table, list_laid
from texvent.scenes.staging.camera.main_actor import choose_main
from texvent.scenes.staging.camera.pieces import KEPT_TOGETHER
from texvent.scenes.staging.camera.prominence import Prominence, come_near, has_clear_view
from texvent.scenes.staging.camera.upper_body import come_near_arms
from texvent.scenes.staging.camera.view_angles import ELEVATIONS, choose_angles, level_out

SKY_LIFT = 0.2
"""How far the camera looks above what matters outdoors, in half image heights."""
TRACKING_LENGTHS = 4.5
"""An object that covers more of its own lengths in the clip is followed from the side."""
_SMALL = 0.5
"""Prominence below which a subject is followed that all others go along with."""
_TINY = 0.35
"""Prominence below which it is followed, whatever else moves."""
SLOWEST = 0.16
"""What crosses fewer image widths per second is followed from the side."""
_WORTH = 1.15
"""How much larger the subject must become for the camera to follow it."""
_OUTSIDE_SHARES = (0.3, 0.38, 0.46, 0.54, 0.62, 0.7)
"""Shares of the clip at whose beginning or end what enters or leaves may be out of the picture."""
_WITH_FOLLOWING = frozenset({"pan", "tilt", "zoom", "handheld", "roll"})
"""Moves that are said of a camera which may go along with its subject besides."""
_VISIBLE_SHARE = 0.97
"""Share of the clip in which the subject's middle is in the image at least."""
_CHECKS = 41


class _How(NamedTuple):
    seed: int
    aspect: float
    """Image height over width."""
    duration_s: float


def place_camera(
    description: SceneDescription,
    actors: Sequence[Actor],
    place: str,
    *,
    seed: int,
    aspect: float,
    duration_s: float,
    travel: TravelPlan | None = None,
) -> CameraPath:
    """The camera over the clip: near enough to recognise the objects and far enough to show them.

    Args:
        description: what the prompt says of the camera.
        actors: the objects of the prompt on their trajectories.
        place: key of `environment.PLACES`.
        seed: decides the angle where nothing is said.
        aspect: image height over width.
        duration_s: length of the clip, s.
        travel: the route of a camera that travels.
    """
    if travel is not None:
        path = _travel(description, travel, actors, place, duration_s)
    elif description.shot.position_m is not None:
        path = _stand_at(description, actors, place, duration_s)
    elif not actors:
        path = _look_around(description, place, duration_s)
    else:
        return _watch(description, actors, place, _How(seed, aspect, duration_s))
    angle_deg = description.shot.field_of_view_deg
    return replace(path, framing=seen_through(path.framing, angle_deg, is_fixed=True))


def _watch(
    description: SceneDescription, actors: Sequence[Actor], place: str, how: _How
) -> CameraPath:
    """The camera that shows the objects."""
    main = choose_main(description, actors)
    moves = _plan_moves(description, main, how.duration_s)
    path = _frame(description, actors, main, moves, place, how)
    angle_deg = description.shot.field_of_view_deg
    path = replace(path, framing=seen_through(path.framing, angle_deg, is_fixed=False))
    return _in_room(_keep_in_view(path, main, actors, how.aspect), description, actors, place)


def _frame(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    moves: tuple[CameraMove, ...],
    place: str,
    how: _How,
) -> CameraPath:
    """The camera from which the subject is large enough; followed where it is small or creeps."""
    duration_s = how.duration_s
    is_said = description.shot.framing == "wide" or goes_in_depth(description, main)
    is_said |= any(move.kind not in _WITH_FOLLOWING for move in description.shot.moves)
    path = _fit_path(description, actors, main, moves, place, how)
    if is_said:
        return path
    copies = [actor for actor in actors if actor.object_index == main.object_index]
    prominence = Prominence.of(copies, np.linspace(0.0, duration_s, INSTANTS), how.aspect)
    share = share_to_follow(actors, main, duration_s)
    if share > 0.0:
        slower = (*moves, CameraMove("follow", "slower", pace=share))
        near = _fit_path(description, actors, main, slower, place, how)
        path = near if prominence(near) > _WORTH * prominence(path) else path
    if not main.is_mover or description.shot.moves or has_landmark(description, main):
        return path
    size = prominence(path)
    is_tiny, is_small = size < _TINY, size < _SMALL or _creeps(path, main)
    is_small &= not crosses_picture(description, main)
    if not (is_tiny or (is_small and stay_together(actors, main, duration_s))):
        return path
    followed = _fit_path(description, actors, main, (CameraMove("follow", "side"),), place, how)
    least = _WORTH if size < _SMALL else 1.0 / _WORTH
    return followed if prominence(followed) > least * size else path


def _fit_path(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    moves: tuple[CameraMove, ...],
    place: str,
    how: _How,
) -> CameraPath:
    """The widest camera with a large subject, for moves."""
    seed, aspect, duration_s = how
    has_floor = place not in ("sky", "space")
    is_open = has_floor and place != "underwater" and not is_room(place)
    azimuth, elevation = choose_angles(description, main, moves, place, seed)
    if list_laid(description, {one.object_index: one.noun for one in actors}):
        elevation = ELEVATION_RAD
    elif is_on_table(description, main.object_index):
        elevation = max(elevation, ELEVATION_RAD)
    elevation = level_out(description, elevation)
    lift = SKY_LIFT if is_open and abs(elevation) < 0.3 else 0.0
    copies = [actor for actor in actors if actor.object_index == main.object_index]

    def path_of(framing: Framing) -> CameraPath:
        return CameraPath(
            framing, moves, duration_s, main.trajectory, main.noun.habitat != "ground",
            has_floor, subject_corners=main.corners,
        )  # fmt: skip

    def come(times: Float64Array, elevation: float) -> CameraPath:
        views = list_views(description, actors, main, moves, times)
        framings = [
            fit(view.points, azimuth=azimuth, elevation=elevation, aspect=aspect, fill=view.fill,
                lift=lift)
            for view in views
        ]  # fmt: skip
        goals = [view.goal for view in views[1:]]
        prominence = Prominence.of(copies, times, aspect)
        known = {main.object_index, *list_related(description, main)}
        others = [actor for actor in actors if actor.object_index not in known]
        is_clear = partial(has_clear_view, main=main, others=others, times=times, aspect=aspect)
        path = come_near(framings, path_of, prominence, goals, is_clear)
        path = come_near_small(description, actors, main, path, path_of, times, aspect)
        return come_near_arms(description, actors, main, path, path_of, times, aspect)

    paths: list[CameraPath] = []
    for times in _instants(main, duration_s):
        paths.append(come(times, elevation))
        level = eye_level(description, actors, main, paths[-1].framing) if has_floor else None
        if level is not None:
            paths[-1] = come(times, level)
        if _begins_and_ends_outside(paths[-1], main, aspect):
            break
    return paths[-1]


def _creeps(path: CameraPath, main: Actor) -> bool:
    """Whether the subject goes on, but so slowly that a still camera would see next to nothing.

    Only over ground: a camera that follows a fish through plain water would see even less.
    """
    if main.noun.habitat != "ground":
        return False
    start, end = (main.middle(time) for time in (0.0, path.duration_s))
    if float(np.linalg.norm(end - start)) < 0.1 * main.size_m:
        return False
    places = [
        _project(path, main.middle(time)[None], time)[0, :2] for time in (0.0, path.duration_s)
    ]
    moved = float(np.linalg.norm(places[1] - places[0]))
    return moved / path.duration_s < SLOWEST


def _instants(main: Actor, duration_s: float) -> list[Float64Array]:
    """Instants at which everything must be in the picture; choices for what enters or leaves."""
    if not (main.enters or main.leaves):
        outside = _share_outside(main, duration_s)
        return [np.linspace(outside * duration_s, (1.0 - outside) * duration_s, INSTANTS)]
    choices = []
    for share in _OUTSIDE_SHARES:
        first = share * duration_s if main.enters else 0.0
        last = (1.0 - share) * duration_s if main.leaves else duration_s
        choices.append(np.linspace(min(first, last), max(first, last), INSTANTS))
    return choices


_HALF_OUTSIDE = 0.4
"""Share of its length by which a subject that goes across may be out of the picture."""
_MOST_OUTSIDE = 0.25
_LONG_M = 5.0
"""Only what is that long: a bus, a train."""


def _share_outside(main: Actor, duration_s: float) -> float:
    """Share of the clip at its beginning, and at its end, at which not all of it need be seen.

    What covers more than its own length would be small in a picture that holds all of its way.
    """
    way = float(np.abs(main.middle(duration_s)[0] - main.middle(0.0)[0]))
    long = main.model.length
    if long < _LONG_M or way < long or not main.is_mover:
        return 0.0
    return min(_HALF_OUTSIDE * long / way, _MOST_OUTSIDE)


def _project(path: CameraPath, points: Float64Array, time_s: float) -> Float64Array:
    """[n, 3]: x and y in image widths from the middle, y down; and depth, m."""
    camera = path.at(time_s)
    seen = (points - camera.position) @ camera.rotation.T
    depth = np.maximum(seen[:, 2:], 1e-3)
    return np.hstack([camera.focal * seen[:, :2] / depth, seen[:, 2:]])


def _begins_and_ends_outside(path: CameraPath, main: Actor, aspect: float) -> bool:
    """Whether what enters begins out of the picture, and what leaves ends there."""
    instants = [0.0] * main.enters + [path.duration_s] * main.leaves
    half = np.array([0.5, 0.5 * aspect])
    for time in instants:
        seen = _project(path, main.corners(time), time)
        low, high = seen[:, :2].min(axis=0), seen[:, :2].max(axis=0)
        if not (np.any(low > half) or np.any(high < -half)):
            return False
    return True


def _keep_in_view(
    path: CameraPath, main: Actor, actors: Sequence[Actor], aspect: float
) -> CameraPath:
    """The path with smaller moves if the subject would leave the picture, and clear of bodies."""
    for _ in range(10):
        if _runs_into(path, actors):
            framing = replace(path.framing, distance_m=1.2 * path.framing.distance_m)
            path = replace(path, framing=framing)
            continue
        if main.enters or main.leaves or _visible_share(path, main, aspect) >= _VISIBLE_SHARE:
            break
        damped = tuple(
            replace(move, pace=0.75 * move.pace) if move.kind in _LEAVING else move
            for move in path.moves
        )
        path = replace(path, moves=damped)
    return path


_LEAVING = frozenset({"pan", "tilt", "truck", "pedestal", "zoom", "dolly"})
"""Moves that can lose the subject."""


def _visible_share(path: CameraPath, main: Actor, aspect: float) -> float:
    """Share of the clip in which the middle of the subject is in the picture."""
    half = np.array([0.49, 0.49 * aspect])
    times = np.linspace(0.0, path.duration_s, _CHECKS)
    seen = [_project(path, main.middle(float(t))[None], float(t))[0] for t in times]
    return float(np.mean([bool(np.all(np.abs(p[:2]) < half) and p[2] > 0.0) for p in seen]))


def _runs_into(path: CameraPath, actors: Sequence[Actor]) -> bool:
    """Whether the camera comes into the box of an object."""
    for time in np.linspace(0.0, path.duration_s, INSTANTS):
        position = path.at(float(time)).position
        for actor in actors:
            corners = actor.corners(float(time))
            near = 0.05 * actor.size_m
            if np.all(position > corners.min(axis=0) - near) and np.all(
                position < corners.max(axis=0) + near
            ):
                return True
    return False


_ABOVE_WATER = 0.2
"""How far down one looks on a river where there is nothing else, radians."""


def _look_around(description: SceneDescription, place: str, duration_s: float) -> CameraPath:
    """A camera in a place where the prompt names no object."""
    usual = _ABOVE_WATER if place == "river" else 0.06
    elevation = ELEVATIONS.get(description.shot.view or "", usual)
    distance = 16.0 if elevation < 0.5 else 24.0
    empty = Framing(np.array([0.0, 0.0, 2.0]), 0.0, elevation, distance, 1.0)
    if is_room(place):
        empty = Framing(np.array([0.0, 0.6, 1.1]), 0.0, 0.12, 3.4, 0.9)
    moves = _plan_moves(description, None, duration_s)
    path = CameraPath(empty, moves, duration_s, has_floor=place not in ("sky", "space"))
    return _in_room(path, description, (), place)


def _stand_at(
    description: SceneDescription, actors: Sequence[Actor], place: str, duration_s: float
) -> CameraPath:
    """The camera where metres say; its moves go through that pose at mid clip."""
    shot = description.shot
    main = choose_main(description, actors) if actors else None
    path = CameraPath(
        pose(shot.position_m or (), shot.look_at_m or ()),
        _plan_moves(description, None, duration_s), duration_s,
        None if main is None else main.trajectory, has_floor=False,
        subject_corners=None if main is None else main.corners,
    )  # fmt: skip
    return _in_room(path, description, actors, place)


def _travel(
    description: SceneDescription,
    travel: TravelPlan,
    actors: Sequence[Actor],
    place: str,
    duration_s: float,
) -> CameraPath:
    """A camera on a route; what it looks at is some way ahead of the middle of the route."""
    x, y, heading = travel.point(0.5 * travel.length_m, 0.0)
    target = np.array([x, y, 0.5 * travel.journey.height_m])
    framing = Framing(target, heading - 0.5 * math.pi, 0.05, max(16.0, 0.8 * travel.length_m), 0.9)
    moves = tuple(move for move in description.shot.moves if move.kind != "static")
    room = math.inf
    if is_room(place):
        corners = [actor.corners(0.5 * duration_s)[:, :2] for actor in actors]
        spread = float(np.abs(np.vstack(corners)).max()) + 0.8 if corners else 0.0
        room = max(0.5 * travel.length_m + 3.5, spread)
    has_floor = place not in ("sky", "space")
    return CameraPath(framing, moves, duration_s, has_floor=has_floor, room_m=room,
                      journey=travel.journey)  # fmt: skip


def _plan_moves(
    description: SceneDescription, main: Actor | None, duration_s: float
) -> tuple[CameraMove, ...]:
    said = (move for move in description.shot.moves if move.kind != "static")
    moves = tuple({(move.kind, move.phase): move for move in said}.values())  # each kind once
    if main is None or moves or description.shot.moves:
        return moves
    span = max(main.model.length, main.model.height)
    start, end = main.middle(0.0), main.middle(duration_s)
    travel = float(np.hypot(*(end - start)[:2]))
    if has_landmark(description, main, KEPT_TOGETHER) or goes_in_depth(description, main):
        return ()
    if main.is_mover and travel > TRACKING_LENGTHS * span:
        return (CameraMove("follow", "side"),)
    return ()


def _in_room(
    path: CameraPath, description: SceneDescription, actors: Sequence[Actor], place: str
) -> CameraPath:
    """The path; indoors in a room that holds the camera and what it looks at."""
    if not is_room(place):
        return path
    near = [a for a in actors if description.objects[a.object_index].side != "far"]
    times = np.linspace(0.0, path.duration_s, INSTANTS)
    points = corners_over(near or actors, times) if actors else np.zeros((1, 3))
    return path.in_room(points, times)
