"""Camera placement: where the camera stands and how it moves."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.places import PLACES, is_room
from texvent_scenes.models.tables import trait_value
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.spec.scene import CameraMove
from texvent_scenes.staging.actors import Actor, corners_over
from texvent_scenes.staging.camera.angles import (
    ALONG_IT,
    ELEVATIONS,
    choose_angles,
    goes_in_depth,
    is_said_room,
)
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
from texvent_scenes.staging.camera.subject import INSTANTS, choose_main, list_framing_choices
from texvent_scenes.staging.placement.zones import zone_of

_SKY_LIFT = 0.2
"""Height of the optical axis above what matters outdoors, in half image heights."""
_LEAST_ROOM_M = 6.5
"""Half the side of a room that a camera goes through: its furniture stands beside the way, m."""
_WALL_LIFT, _LOW_M, _STEEP = 0.5, 0.5, 0.4
"""Height above what matters in a room that is said, whose wall must be in view; height of a subject
up to which that would be out of it, m; elevation up to which it may be in view, rad."""
_NEAR_LENGTHS = 0.3
"""Lengths of its own from which on an object is followed in a close or medium shot."""
_STATIC, _ALONG, _LEAST_ALONG, _FOLLOWED, _LEAST_GAIN = 0.33, 0.65, 0.13, 0.25, 1.1
"""Prominence of the subject from which on a camera that stays shows all its way; with which the
camera goes along, that it would have at least if it went no faster than one can look, and that it
has however fast it goes; and by how much a passage must raise it."""
_STATIC_GROUP = 0.65
"""Prominence of several that go together from which on a camera that stays shows all their way."""
_WIDTHS_PER_S, _FILLED = 1.0, 0.75
"""Speed of a camera that goes along, in widths of the picture at the subject; the share of a width
in which the subject moves."""
_TRAFFIC_WIDTHS_PER_S, _LEAST_LENGTH = 0.25, 0.06
"""Greatest speed of traffic in the picture of a camera that stays, widths per second, as the cars
of a recorded street have; and length in widths that each of it has in spite of that."""
_STREET_AZIMUTH, _STREET_ELEVATION = 0.35, 0.24
"""Angles from which a street is seen as from a mast or a window: how much more along it, and from
above, rad."""
_TOGETHER, _STRAIGHT = 0.6, 0.5
"""Share of its way by which another one may get away from a subject that the camera goes along
with; and by which a subject leaves its place, which goes neither in circles nor to and fro."""
_PASSING = ("past", "through")
_TOLD = {"past": 0.8, "through": 0.8, "hold": 0.15, "follow": 0.15}
"""Relations to what is seen at mid clip; relation → prominence of what a subject passes, holds or
is after, from which on all the way is shown."""
_LEAST_PASSAGE, _SEEN = 0.4, 0.16
"""Least share of the clip that a passage lasts, where the subject is then as prominent as this."""
_LEAST_HORIZONTAL = 1e-6
"""Horizontal part of the direction of a camera, of 1, below which it looks straight up or down."""
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
        return np.linspace(*self.path.framed_s, INSTANTS)

    def along(self, path: CameraTrack) -> _Shooting:
        """The same on another path."""
        return replace(self, path=path)


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
        journey=None if travel is None else travel.journey, is_stated=shot.position_m is not None,
    )  # fmt: skip
    shooting = _Shooting(description, actors, place, seed, aspect, path)
    if watched is not None:
        path = _stand_back(shooting, _give_way(shooting, watched), watched)
    framing = seen_through(path.framing, shot.field_of_view_deg, is_fixed=watched is None)
    path = replace(path, framing=framing)
    if watched is not None:
        path = _keep_in_view(path, watched, aspect)
        path = replace(path, notes=tuple(_list_notes(path, watched, aspect)))
    path = _keep_in_room(path, shooting, travel) if is_room(place) else path
    return replace(path, notes=(*path.notes, *_tell_ends(path)))


def _tell_ends(path: CameraTrack) -> Iterator[str]:
    """Poses at the start and at the end of a camera that moves from a stated one."""
    first, last = (path.at(time_s) for time_s in (0.0, path.duration_s))
    if path.is_stated and any(one.move.kind != "static" for one in path.moves):
        yield f"the camera begins {_tell_pose(first)}; at the end it is {_tell_pose(last)}"


def _tell_pose(camera: PosedCamera) -> str:
    """Place, heading, pitch and field of view of a camera."""
    x, y, z = (round(float(one), 2) + 0.0 for one in camera.position)
    down, forward = camera.rotation[1:]
    has_heading = math.hypot(forward[0], forward[1]) > _LEAST_HORIZONTAL
    ahead = forward if has_heading else down * math.copysign(1.0, forward[2])  # top of a nadir view
    heading = math.degrees(math.atan2(ahead[1], ahead[0]))
    pitch = math.degrees(math.asin(min(max(float(forward[2]), -1.0), 1.0)))
    view = 2.0 * math.degrees(math.atan(0.5 / camera.focal))
    return (f"at ({x:g}, {y:g}, {z:g}) m, heading {round(heading % 360.0, 1) % 360.0:g} degrees, "
            f"pitch {round(pitch, 1) + 0.0:g}, field of view {view:.3g}")  # fmt: skip


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


def _give_way(shooting: _Shooting, main: Actor) -> CameraTrack:
    """The camera that shows a subject of any speed large enough.

    It stays and shows all the way; or goes along for a share of it, so that the subject crosses the
    picture in the clip; or stays and shows a passage at mid clip.
    """
    path, reached = _watch(shooting, main)
    middle_s = 0.5 * path.duration_s
    copies = [one for one in shooting.actors if one.object_index == main.object_index]
    size_m = max(main.size_m, float(np.ptp(corners_over(copies, [middle_s]), axis=0).max()))
    places = [main.middle(float(time)) for time in shooting.times]
    way_m = float(np.linalg.norm(np.ptp(places, axis=0)))
    gone_m = float(np.linalg.norm(places[-1] - places[0]))
    is_tied = path.tie is not None or shooting.description.camera.framing in ("close", "medium")
    is_across = gone_m > max(_STRAIGHT * way_m, size_m) and not goes_in_depth(main)
    is_group = len(copies) > 1 and zone_of(main.noun) != "road"  # traffic passes
    least, goal = (_STATIC_GROUP, 1.0) if is_group else (_STATIC, _ALONG)
    told = min(reached / least, _share_of_told(shooting, path, main))
    if told >= 1.0 or is_tied or not is_across:
        return path
    if (passage_s := _find_descent(shooting, main)) is not None:
        return _watch(shooting.along(replace(path, passage_s=passage_s)), main)[0]
    # Of what the image holds, the extent in metres times the prominence hardly changes.
    held_m = (way_m + size_m) * reached
    slow_m = (way_m + size_m) / (1.0 + _WIDTHS_PER_S * path.duration_s / _FILLED)
    extent_m = max(held_m / goal, slow_m)
    if held_m >= _LEAST_ALONG * extent_m and _may_go_along(shooting, main):
        tie = Tie.of(time_moves([CameraMove("follow")], path.duration_s), main)
        extent_m = min(extent_m, max(held_m / _FOLLOWED, size_m))
        share = 1.0 - max(extent_m - size_m, 0.0) / way_m
        for each in (share, 1.0):
            along = shooting.along(replace(path, tie=tie and replace(tie, share=each)))
            near = _watch(along, main)[0]
            if _share_of_told(shooting, near, main) >= 1.0:
                break
        return near
    told = min(reached / least, _share_of_told(shooting, path, main, _PASSING))
    if told >= 1.0:  # only what it holds or follows is small
        return path
    shares = [((way_m + size_m) * one - size_m) / way_m for one in (told, reached / _SEEN)]
    half_s = middle_s * max(shares[0], min(shares[1], _LEAST_PASSAGE), 0.1 * size_m / way_m)
    passage_s = middle_s - half_s, middle_s + half_s
    near, enough = _watch(shooting.along(replace(path, passage_s=passage_s)), main)
    return near if enough >= _LEAST_GAIN * reached else path


def _find_descent(shooting: _Shooting, main: Actor) -> tuple[float, float] | None:
    """Begin and end, s, of the way of a subject down a slope; None: there is none."""
    slopes = [one for one in shooting.actors if trait_value("slope", one.noun.name) is not None]
    times = np.linspace(0.0, shooting.path.duration_s, 4 * _CHECKS)
    for one in slopes:
        low, high = (
            end[:2] for end in (one.corners(0.0).min(axis=0), one.corners(0.0).max(axis=0))
        )
        places = np.array([main.middle(float(time))[:2] for time in times])
        on_it = times[((places >= low) & (places <= high)).all(axis=1)]
        if len(on_it) > 1:
            return float(on_it[0]), float(on_it[-1])
    return None


def _share_of_told(
    shooting: _Shooting, path: CameraTrack, main: Actor, kinds: Collection[str] = _TOLD.keys()
) -> float:
    """Least prominence at mid clip of what a subject passes, holds or follows, by what tells it."""
    middle_s = 0.5 * path.duration_s
    camera, shares = path.at(middle_s), [1.0]
    for one in shooting.description.relations:
        is_own = one.subject == main.object_index and one.kind in kinds
        for other in shooting.actors if is_own else ():
            if other.object_index in one.targets:
                box = other.corners(middle_s)[None]
                shares.append(measure_prominence(camera, box, shooting.aspect) / _TOLD[one.kind])
    return min(shares)


def _stand_back(shooting: _Shooting, path: CameraTrack, main: Actor) -> CameraTrack:
    """The path of a camera that stays, from where several on a road pass as in a street scene.

    How far away that is hangs on their speed, and not on the length of the clip.
    """
    traffic = [one for one in shooting.actors if one.is_mover and zone_of(one.noun) == "road"]
    is_about = main.object_index in {one.object_index for one in traffic}
    moves = [one for one in path.moves if one.move.kind != "static"]
    shot = shooting.description.camera
    is_near = shot.framing in ("close", "medium")
    if len(traffic) < 2 or not is_about or is_near or path.tie is not None or moves:
        return path
    framing, times = path.framing, np.linspace(*path.framed_s, INSTANTS)
    is_free = shot.view is None and not shooting.description.relations
    if is_free and not goes_in_depth(main):
        azimuth = min(abs(framing.azimuth) + _STREET_AZIMUTH, ALONG_IT)
        framing = replace(framing, azimuth=math.copysign(azimuth, framing.azimuth),
                          elevation=max(framing.elevation, _STREET_ELEVATION))  # fmt: skip
    right = np.array([math.cos(framing.azimuth), math.sin(framing.azimuth), 0.0])
    across = np.array([[one.corners(float(time)) @ right for time in times] for one in traffic])
    speed_m_s = np.abs(np.diff(across.mean(axis=2), axis=1)).max() / (times[1] - times[0])
    length_m = np.ptp(across, axis=2).min()
    width_m = float(min(speed_m_s / _TRAFFIC_WIDTHS_PER_S, length_m / _LEAST_LENGTH))
    distance_m = max(framing.distance_m, framing.focal * width_m)
    return replace(path, framing=replace(framing, distance_m=distance_m))


def _may_go_along(shooting: _Shooting, main: Actor) -> bool:
    """Whether the camera is free, and nothing that must be seen too is left behind."""
    description, duration_s = shooting.description, shooting.path.duration_s
    related = {
        n for one in description.relations for n in (one.subject, *one.targets)
        if main.object_index in (one.subject, *one.targets)
    }  # fmt: skip
    gone = main.middle(duration_s) - main.middle(0.0)
    for one in shooting.actors:
        behind = gone - (one.middle(duration_s) - one.middle(0.0))
        goes = one.is_mover and description.objects[one.object_index].placement != "far"
        is_left = np.linalg.norm(behind) > _TOGETHER * np.linalg.norm(gone)
        if is_left and (goes or one.object_index in related):
            return False
    return not description.camera.moves


def _watch(shooting: _Shooting, main: Actor) -> tuple[CameraTrack, float]:
    """The path with the widest framing that shows a large subject, and its prominence there."""
    description, actors, aspect = shooting.description, shooting.actors, shooting.aspect
    moves, times, place = shooting.path.moves, shooting.times, shooting.place
    azimuth, elevation = choose_angles(description, main, place, shooting.seed)
    is_open = shooting.path.has_floor and not is_room(place)
    lift = _SKY_LIFT if is_open and abs(elevation) < 0.3 else 0.0
    if (
        is_said_room(description, place)
        and 0.0 < elevation <= _STEEP
        and main.model.height < _LOW_M
    ):
        lift = _WALL_LIFT
    copies = [actor for actor in actors if actor.object_index == main.object_index]
    boxes = [np.array([one.corners(float(time)) for one in copies]) for time in times]

    def prominence(framing: Framing) -> float:
        path = replace(shooting.path, framing=framing)
        views = zip(times, boxes, strict=True)
        return float(np.mean([measure_prominence(path.at(float(t)), b, aspect) for t, b in views]))

    views = list_framing_choices(description, actors, main, moves, shooting.path.tie, times)
    framings = [
        fit(one.points, azimuth=azimuth, elevation=elevation, aspect=aspect, fill=one.fill,
            lift=lift)
        for one in views
    ]  # fmt: skip
    framing = come_near(framings, prominence, [view.goal for view in views[1:]])
    return replace(shooting.path, framing=framing), prominence(framing)


def _keep_in_view(path: CameraTrack, main: Actor, aspect: float) -> CameraTrack:
    """The path with smaller moves if the subject would leave the picture."""
    may_leave = any(one.move.kind in _LEAVING for one in path.moves)
    for _ in range(_TRIES if may_leave else 0):
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
    times = np.linspace(*path.framed_s, _CHECKS)
    seen = np.array([image_of(path.at(float(t)), main.middle(float(t))) for t in times])
    is_inside = np.all(np.abs(seen[:, :2]) < half, axis=1) & (seen[:, 2] > 0.0)
    return bool(is_inside.mean() >= _VISIBLE_SHARE)


def _list_notes(path: CameraTrack, main: Actor, aspect: float) -> Iterator[str]:
    """Notes on how the camera gives way to a fast subject, and how much of it is seen."""
    if path.tie is not None and path.tie.share < 1.0:
        gone = path.tie.displacement(path.duration_s) / path.duration_s
        speed_m_s = float(np.linalg.norm(gone))
        figure = f"{speed_m_s:.2g}" if speed_m_s < 10.0 else f"{speed_m_s:.0f}"
        yield (
            f"the {main.name} is fast: the camera goes along at {figure} m/s, so that it "
            "stays in view"
        )
    if path.passage_s is None:
        return
    begin_s, end_s = path.passage_s
    more_s = end_s - begin_s
    times = np.linspace(
        max(begin_s - more_s, 0.0), min(end_s + more_s, path.duration_s), 4 * _CHECKS
    )
    seen = np.array([image_of(path.at(float(t)), main.middle(float(t))) for t in times])
    reach = 0.5 * main.size_m * path.framing.focal / np.maximum(seen[:, 2], 1e-3)
    is_seen = np.all(np.abs(seen[:, :2]) < [0.5, 0.5 * aspect] + reach[:, None], axis=1)
    first_s, last_s = times[is_seen][[0, -1]] if is_seen.any() else path.passage_s
    if last_s - first_s < path.duration_s:
        yield (
            f"the {main.name} is fast: it is in view for {last_s - first_s:.2g} s, "
            f"from {first_s:.2g} s on"
        )


def _keep_in_room(path: CameraTrack, shooting: _Shooting, travel: TravelPlan | None) -> CameraTrack:
    """The path in a room that holds the camera and the objects."""
    actors, objects = shooting.actors, shooting.description.objects
    if travel is not None:
        middle = [0.5 * path.duration_s]
        corners = corners_over(actors, middle) if actors else np.zeros((1, 3))
        reach = float(np.abs(corners[:, :2]).max())
        path = replace(path, room_m=max(0.5 * travel.length_m + 3.5, reach + 0.8, _LEAST_ROOM_M))
        return _keep_in_corridor(_in_hall(path, shooting), shooting)
    near = [one for one in actors if objects[one.object_index].placement != "far"]
    corners = corners_over(near or actors, shooting.times) if actors else np.zeros((1, 3))
    path = _in_hall(path.in_room(corners, shooting.times), shooting)
    return _keep_in_corridor(path, shooting)


def _in_hall(path: CameraTrack, shooting: _Shooting) -> CameraTrack:
    """The path in a hall, which is large and high whatever is in it."""
    return replace(path, room_m=max(path.room_m, PLACES[shooting.place].hall_m))


def _keep_in_corridor(path: CameraTrack, shooting: _Shooting) -> CameraTrack:
    """The path in a corridor that is as wide as camera and objects need, and goes on."""
    usual_m = PLACES[shooting.place].corridor_m
    if not usual_m:
        return path
    actors = shooting.actors
    places = np.array([path.at(float(one)).position for one in shooting.times])
    corners = corners_over(actors, shooting.times) if actors else places
    reach = float(max(np.abs(places[:, 0]).max(), np.abs(corners[:, 0]).max()))
    half_m = max(usual_m, reach + _BESIDE_M)
    return replace(path, room_m=path.room_m + _GOES_ON_M, corridor_m=half_m)


_BESIDE_M, _GOES_ON_M = 0.25, 7.0
"""Room between what is in a corridor and its wall; from where that could end to its end, m."""


def _plan_moves(
    description: SceneDescription, main: Actor | None, duration_s: float
) -> tuple[TimedMove, ...]:
    """The moves that are said, each kind once at a time; else a near shot follows its subject."""
    timed = time_moves(description.camera.moves, duration_s)
    said = {(one.move.kind, one.begin_s, one.end_s): one for one in timed}
    is_near = description.camera.framing in ("close", "medium")
    if main is None or said or not (main.is_mover and is_near):
        return tuple(said.values())
    span = max(main.model.length, main.model.height)
    displacement_m = float(np.linalg.norm(main.middle(duration_s) - main.middle(0.0)))
    if displacement_m <= _NEAR_LENGTHS * span:
        return ()
    return tuple(time_moves([CameraMove("follow")], duration_s))
