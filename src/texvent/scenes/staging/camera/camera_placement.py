"""Camera placement: where the camera stands and how it moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import CameraMove, SceneDescription
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.actors import Actor, seeded
from texvent.scenes.staging.camera.camera_path import CameraPath
from texvent.scenes.staging.camera.framing import Framing, fit
from texvent.scenes.staging.camera.journey import TravelPlan

FILL = 0.84
"""Share of the image that what matters may fill."""
SKY_LIFT = 0.2
"""How far the camera looks above what matters outdoors, in half image heights."""
LIMIT = 0.7
"""What a mover passes counts for the framing up to this multiple of the mover's size."""
WHOLE = 3.5
"""Other objects must fit as a whole if they are at most this many times as large as the mover."""
TRACKING_LENGTHS = 4.5
"""An object that covers more of its own lengths in the clip is followed from the side."""
INSTANTS = 13
_ELEVATIONS = {"aerial": 0.80, "top": 1.45, "low": 0.02}
_AZIMUTHS = {"side": 0.0, "front": 0.0, "back": math.pi}
_FILL_BY_MOVE = {"pan": 0.62, "tilt": 0.7, "truck": 0.66, "pedestal": 0.7, "orbit": 0.66,
                 "handheld": 0.78}  # fmt: skip


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
    has_floor = place not in ("sky", "space")
    if travel is not None:
        return _travel(description, travel, actors, place, duration_s)
    if not actors:
        target = np.array([0.0, 0.0, 2.0])
        empty = Framing(target, 0.0, 0.06, 16.0, 1.0)
        return CameraPath(empty, _plan_moves(description, None, duration_s), duration_s,
                          has_floor=has_floor)  # fmt: skip
    main = _choose_main(description, actors)
    moves = _plan_moves(description, main, duration_s)
    points, fill = _choose_framing(description, actors, main, moves, duration_s)
    azimuth, elevation = _choose_angles(description, main, moves, place, seed)
    is_open = has_floor and place not in ("underwater", "indoor")
    lift = SKY_LIFT if is_open and abs(elevation) < 0.3 else 0.0
    framing = fit(points, azimuth=azimuth, elevation=elevation, aspect=aspect, fill=fill, lift=lift)
    follows_height = main.noun.habitat != "ground"
    path = CameraPath(framing, moves, duration_s, main.trajectory, follows_height, has_floor,
                      subject_corners=main.corners)  # fmt: skip
    if place == "indoor":
        path = replace(path, room_m=_size_room(path, points))
    return path


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
    if place == "indoor":
        corners = [actor.corners(0.5 * duration_s)[:, :2] for actor in actors]
        spread = float(np.abs(np.vstack(corners)).max()) + 0.8 if corners else 0.0
        room = max(0.5 * travel.length_m + 3.5, spread)
    has_floor = place not in ("sky", "space")
    return CameraPath(framing, moves, duration_s, has_floor=has_floor, room_m=room,
                      journey=travel.journey)  # fmt: skip


def _choose_framing(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    moves: Sequence[CameraMove],
    duration_s: float,
) -> tuple[Float64Array, float]:
    """[n, 3] points that must fit, m, and the share of the image that they may fill."""
    shot = description.shot
    follows = any(move.kind == "follow" for move in moves)
    approaches = any(move.kind in ("zoom", "dolly") for move in moves)
    times = np.linspace(0.0, duration_s, INSTANTS)
    is_aimed = approaches and main.object_index == shot.target
    if is_aimed or shot.framing == "close":
        is_still = follows and not is_aimed
        points = [main.corners(float(time)) for time in (times[:1] if is_still else times)]
        return np.vstack(points), 0.55 if is_aimed else 0.95
    points_to_frame = _points_to_frame(description, actors, main, times, follows)
    if shot.framing == "wide":
        return points_to_frame, 0.45
    fill = min([FILL, *(_FILL_BY_MOVE.get(move.kind, FILL) for move in moves)])
    if follows and main.is_mover:
        fill = min(fill, 0.5)
    return points_to_frame, fill


def _choose_main(description: SceneDescription, actors: Sequence[Actor]) -> Actor:
    """The object the camera is about: as said, or the first that moves."""
    target = description.shot.target
    for actor in actors:
        if target is not None and actor.object_index == target:
            return actor
    return next((actor for actor in actors if actor.is_mover), actors[0])


def _plan_moves(
    description: SceneDescription, main: Actor | None, duration_s: float
) -> tuple[CameraMove, ...]:
    moves = tuple(move for move in description.shot.moves if move.kind != "static")
    if main is None or moves or description.shot.moves:
        return moves
    span = max(main.model.length, main.model.height)
    start, end = main.middle(0.0), main.middle(duration_s)
    travel = float(np.hypot(*(end - start)[:2]))
    if main.is_mover and travel > TRACKING_LENGTHS * span:
        return (CameraMove("follow", "side"),)
    return ()


def _points_to_frame(
    description: SceneDescription,
    actors: Sequence[Actor],
    main: Actor,
    times: Float64Array,
    follows: bool,
) -> Float64Array:
    """[n, 3] what must fit, m: movers whole, the rest up to a multiple of their size."""
    near = [actor for actor in actors if description.objects[actor.object_index].side != "far"]
    movers = [actor for actor in near if actor.is_mover] or near or list(actors)
    largest = max(
        max(actor.model.length, actor.model.width, actor.model.height) for actor in movers
    )
    passed = {
        target
        for relation in description.relations
        if relation.kind in ("past", "among")
        for target in relation.targets
    }
    start = np.array(main.trajectory.at(0.0).position)
    points = []
    for actor in actors:
        is_far = description.objects[actor.object_index].side == "far"
        if is_far and actor is not main:
            continue
        for time in times:
            limit = math.inf if actor in movers else _limit_extent(actor, passed, largest)
            corners = actor.corners(float(time), limit)
            if follows:
                shift = np.array(main.trajectory.at(float(time)).position) - start
                shift[2] = shift[2] if main.noun.habitat != "ground" else 0.0
                if actor is not main and not actor.is_mover:
                    continue
                corners = corners - shift
            points.append(corners)
    return np.vstack(points)


def _limit_extent(actor: Actor, passed: set[int], largest_m: float) -> float:
    """How much of an object at rest must fit, m."""
    size = max(actor.model.length, actor.model.width, actor.model.height)
    is_whole = actor.object_index not in passed and size <= WHOLE * largest_m
    return math.inf if is_whole else LIMIT * largest_m


def _choose_angles(
    description: SceneDescription,
    main: Actor,
    moves: Sequence[CameraMove],
    place: str,
    seed: int,
) -> tuple[float, float]:
    """Azimuth and elevation of the camera, radians."""
    rng = seeded(seed, "camera")
    wander = float(rng.uniform(-0.14, 0.14))
    state = main.trajectory.at(0.0)
    later = main.trajectory.at(0.5)
    step = np.subtract(later.position, state.position)
    goes_in_depth = abs(step[1]) > 1.2 * abs(step[0]) and abs(step[1]) > 0.05
    azimuth = wander
    if goes_in_depth:
        azimuth = math.copysign(0.42, wander)
    follow = next((move for move in moves if move.kind == "follow"), None)
    if follow is not None and follow.direction in ("behind", "front"):
        heading = state.yaw if follow.direction == "behind" else state.yaw + math.pi
        azimuth = heading - 0.5 * math.pi + 0.1 * wander
    view = description.shot.view
    if view in _AZIMUTHS:
        azimuth = _AZIMUTHS[view] if view == "side" else _face(view, state.yaw)
    elevation = _ELEVATIONS.get(view or "")
    if elevation is None:
        elevation = _choose_elevation(main, follow, place, goes_in_depth)
    return azimuth, elevation


def _choose_elevation(
    main: Actor, follow: CameraMove | None, place: str, goes_in_depth: bool
) -> float:
    """Height of the camera above what it looks at, radians."""
    if follow is not None and follow.direction in _FOLLOW_ELEVATIONS:
        return _FOLLOW_ELEVATIONS[follow.direction]
    if place in _PLACE_ELEVATIONS:
        return _PLACE_ELEVATIONS[place]
    if main.noun.habitat == "air":
        return -0.03
    if not main.is_mover and main.model.height > 5.0:
        return 0.03
    if main.model.height < 0.7:
        return 0.24
    return 0.2 if goes_in_depth else 0.12


_FOLLOW_ELEVATIONS = {"behind": 0.22, "front": 0.22, "above": 0.7}
_PLACE_ELEVATIONS = {"sky": -0.42, "space": -0.1, "underwater": 0.04, "indoor": 0.24}


def _face(view: str, yaw: float) -> float:
    """Azimuth from which an object of that heading is seen from the front or from behind."""
    return yaw + 0.5 * math.pi if view == "front" else yaw - 0.5 * math.pi


def _size_room(path: CameraPath, points: Float64Array) -> float:
    """Half the side of a room that holds the camera and everything it looks at, m."""
    times = np.linspace(0.0, path.duration_s, INSTANTS)
    places = np.array([path.at(float(time)).position for time in times])
    reach = float(np.max(np.abs(places[:, :2])))
    spread = float(np.max(np.abs(points[:, :2])))
    height = float(np.max(points[:, 2])) / 0.6
    above = (float(np.max(places[:, 2])) + 0.35) / 0.6
    return max(reach + 0.6, spread + 0.8, height + 0.5, above, 3.5)
