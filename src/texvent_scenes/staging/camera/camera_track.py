"""The camera as a function of time: a static pose, or a route, plus terms that add up."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np

from texvent.camera import PosedCamera
from texvent_scenes.rendered_scene import CEILING, CORRIDOR_HEIGHT_M, Float64Array
from texvent_scenes.spec.scene import CameraMove
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.framing import VERTICAL, Framing, direction, look_at
from texvent_scenes.staging.tracks.track import Term, Track, add_up

AMOUNTS = {
    "pan": 0.36, "tilt": 0.24, "roll": 0.7, "orbit": 1.0, "truck": 0.4, "pedestal": 0.3,
    "zoom": math.log(1.7), "dolly": math.log(1.6),
}  # fmt: skip
"""Kind of move, which is also its channel → usual amount: angles in rad, displacements in widths of
the picture at the subject, logarithms of the focal length and of the nearness."""
STATED = {"truck": "truck m", "pedestal": "pedestal m", "dolly": "dolly m", "zoom": "zoom rad"}
"""Kind of move → its channel where the scene says how fast it is, in m and rad; that of what turns
is the usual one."""
_NEAREST = ("zoom", "dolly", STATED["zoom"], STATED["dolly"])
"""Channels that are framed where they are nearest; the others in the middle of their range."""
_CHANNELS = (*AMOUNTS, *STATED.values())
_NEGATIVE = ("left", "down", "out", "counter-clockwise", "backward")
_NEGATIVE_ORBITS = ("left", "clockwise")
"""Ways round a subject that are clockwise as seen from above: the camera goes to the left."""
_LEAST_DISTANCE, _VIEWS_RAD = 0.02, (math.radians(1.0), math.radians(150.0))
"""Least share of its distance at which a stated dolly stops, and fields of view of a zoom."""
_HANDHELD = (
    Term("pan", 0.015, 1.1), Term("pan", 0.009, 2.7, 1.0),
    Term("tilt", 0.015, 1.4, 2.0), Term("tilt", 0.0075, 3.3),
)  # fmt: skip
ALL_AXES, _MORE = "all axes", 4.0
"""Direction of a handheld camera that moves in all six degrees of freedom, and how much more it
turns then."""
_ROAMING = (
    Term("truck", 0.02, 4.9 / math.tau), Term("along", 0.02, 3.7 / math.tau, 1.0),
    Term("pedestal", 0.02, 6.1 / math.tau, 2.0), Term("roll", 0.045, 5.5 / math.tau, 0.5),
)  # fmt: skip
_HIGH_WIDTHS = 1.3
"""Width of the picture of a camera that travels, in heights above the ground."""
LOWEST_M = 0.25
"""The camera stays at least this high above the ground."""
MOST_PITCH_RAD = 1.5
USUAL_S = 2.0
"""Length of a move that goes its usual way; shorter ones go less far."""


class TimedMove(NamedTuple):
    """A camera move and when it happens, s."""

    move: CameraMove
    begin_s: float
    end_s: float
    clip_s: float
    """Length of the clip, s."""

    @property
    def active_s(self) -> tuple[float, float]:
        """Instants between which it goes on, s.

        A move at an end of the clip goes on beyond it: the rates of an IMU are differences there.
        """
        begin_s = self.begin_s if self.begin_s > 0.0 else -math.inf
        return begin_s, self.end_s if self.end_s < self.clip_s else math.inf

    @property
    def tied_s(self) -> tuple[float, float]:
        """Instants between which it keeps its subject in place, s.

        Phases after it keep on following: "follows, then dollies in" loses nothing out of view.
        """
        begin_s, end_s = self.active_s
        has_times = self.move.start_s is not None or self.move.duration_s is not None
        return begin_s, end_s if has_times else math.inf


def time_moves(moves: Sequence[CameraMove], duration_s: float) -> list[TimedMove]:
    """Times of moves: those that are said, else those of their phases, which share the clip evenly.

    Moves that would begin at the end of the clip or later are left out.
    """
    span = duration_s / (1 + max((move.phase for move in moves), default=0))
    timed = []
    for move in moves:
        begin, end = move.phase * span, (move.phase + 1) * span
        if move.start_s is not None:
            begin, end = move.start_s, duration_s
        end = end if move.duration_s is None else begin + move.duration_s
        timed.append(TimedMove(move, begin, end, duration_s))
    return [one for one in timed if one.begin_s < min(one.end_s, duration_s)]


@lru_cache(maxsize=64)
def terms_of(
    moves: tuple[TimedMove, ...], duration_s: float, *, begins_there: bool = False
) -> tuple[Term, ...]:
    """Terms of all moves but those along a track, in the channels of `AMOUNTS` and "along".

    They begin at 0 or, unless `begins_there`, go through it half way.
    """
    terms = tuple(term for one in moves for term in _expand(one))
    if begins_there:
        return (*terms, *(Term(kind, offset=-at) for kind, at in add_up(terms, 0.0).items()))
    edges = {0.0, duration_s, *(time for one in moves for time in (one.begin_s, one.end_s))}
    middles = []
    for kind in _CHANNELS:
        going = [term for term in terms if term.channel == kind and term.drift]
        if not going:
            continue
        reached = [add_up(going, min(time, duration_s)).get(kind, 0.0) for time in edges]
        least = max(reached) if kind in _NEAREST else min(reached)
        middles.append(Term(kind, offset=-0.5 * (least + max(reached))))
    return (*terms, *middles)


def _expand(timed: TimedMove) -> Iterator[Term]:
    """Terms of one move."""
    move, (begin_s, end_s) = timed.move, timed.active_s
    is_roaming = move.direction == ALL_AXES
    scale = move.pace * (_MORE if is_roaming else 1.0)
    waves = _HANDHELD if move.kind == "handheld" else ()
    for wave in (*waves, *(_ROAMING if is_roaming else ())):
        yield wave._replace(amplitude=scale * wave.amplitude, begin_s=begin_s, end_s=end_s)
    if move.kind in AMOUNTS:
        channel, span = str(move.kind), timed.end_s - timed.begin_s
        amount = min(max(math.sqrt(span / USUAL_S), 0.5), 1.3) * move.pace * AMOUNTS[move.kind]
        rate, turn = amount / span, move.rate_deg_s
        stated = move.speed_m_s if turn is None else math.radians(turn)
        if stated is not None:
            rate, channel = stated, STATED.get(move.kind, move.kind)
        negative = _NEGATIVE_ORBITS if move.kind == "orbit" else _NEGATIVE
        drift = -rate if move.direction in negative else rate
        offset = -drift * timed.begin_s
        yield Term(channel, drift=drift, offset=offset, begin_s=begin_s, end_s=end_s)


@dataclass(frozen=True)
class Journey:
    """A camera that travels: ego-motion along a route."""

    route: Track
    """Position and heading on the ground."""
    height_m: float
    pitch_rad: float
    """Pitch below the horizon."""


@dataclass(frozen=True)
class Tie:
    """The motion that a camera which follows or orbits its subject shares with it."""

    track: Track
    """Track of the subject."""
    spans_s: tuple[tuple[float, float], ...]
    """Stretches of time in which it does, in order, s."""
    rises: bool = True
    """Whether it also rises and falls with it."""
    share: float = 1.0
    """Share of its displacement: below 1 the subject goes on through the picture."""

    @classmethod
    def of(cls, moves: Sequence[TimedMove], subject: Actor) -> Tie | None:
        """The tie that moves make; None where the camera or its subject stays."""
        tied = sorted(one.tied_s for one in moves if one.move.kind in ("follow", "orbit"))
        if not tied or not subject.is_mover:
            return None
        spans = tied[:1]
        for begin_s, end_s in tied[1:]:
            first_s, last_s = spans[-1]
            if begin_s <= last_s:
                spans[-1] = (first_s, max(last_s, end_s))
            else:
                spans.append((begin_s, end_s))
        return cls(subject.track, tuple(spans), subject.noun.habitat != "ground")

    def displacement(self, time_s: float) -> Float64Array:
        """[3] by which the camera has gone along since the start, m."""
        gone = np.zeros(3)
        for begin_s, end_s in self.spans_s:
            now_s = min(max(time_s, begin_s), end_s)
            start = self.track.at(max(begin_s, 0.0)).position
            gone += np.subtract(self.track.at(now_s).position, start)
        return self.share * gone * [1.0, 1.0, float(self.rises)]

    def relative(self, points: Float64Array, time_s: float) -> Float64Array:
        """Points [n, 3], m, as the camera sees them, at the place of the start."""
        return np.asarray(points - self.displacement(time_s))


@dataclass(frozen=True)
class CameraTrack:
    """Camera moves over a clip; a pure, smooth function of time."""

    framing: Framing
    moves: tuple[TimedMove, ...]
    duration_s: float
    tie: Tie | None = None
    """Tie to the object that a "follow" or "orbit" keeps in place in the image."""
    has_floor: bool = True
    """Whether there is ground to stay above."""
    room_m: float = math.inf
    """Half the side of the room it must stay in, m."""
    corridor_m: float | None = None
    """Half the width of the corridor that it is in, whose length is that side."""
    journey: Journey | None = None
    """The route of what travels."""
    is_stated: bool = False
    """Whether the scene states its pose, at which the moves begin."""
    passage_s: tuple[float, float] | None = None
    """Stretch of the clip in which a subject that is too fast crosses the picture, s; None: it is
    in the picture all along."""

    notes: tuple[str, ...] = ()
    """Sentences on what is seen of a subject that is too fast."""

    @property
    def framed_s(self) -> tuple[float, float]:
        """Stretch of the clip in which the subject must be in the picture, s."""
        return self.passage_s or (0.0, self.duration_s)

    @cached_property
    def _terms(self) -> tuple[Term, ...]:
        return terms_of(self.moves, self.duration_s, begins_there=self.is_stated)

    @property
    def _goes_through(self) -> bool:
        """Whether a stated dolly from a stated pose goes on past the point that it looks at."""
        return self.is_stated and all(one.move.kind != "orbit" for one in self.moves)

    def at(self, time_s: float) -> PosedCamera:
        """The camera at that instant."""
        framing, by = self.framing, dict.fromkeys((*_CHANNELS, "along"), 0.0)
        by |= add_up(self._terms, time_s)
        roll = by["roll"]
        if self.journey is not None:
            state, width = self.journey.route.at(time_s), _HIGH_WIDTHS * self.journey.height_m
            start = np.add(state.position, [0.0, 0.0, self.journey.height_m])
            roll -= state.roll
        else:
            width, target = framing.distance_m / framing.focal, framing.target
            if self.tie is not None:
                target = target + self.tie.displacement(time_s)
            away = direction(framing.azimuth + by["orbit"], framing.elevation)
            distance = framing.distance_m * math.exp(-by["dolly"])
            dolly_m = by[STATED["dolly"]]
            ahead_m = dolly_m if self._goes_through else 0.0
            distance = max(distance + ahead_m - dolly_m, _LEAST_DISTANCE * framing.distance_m)
            target = target - ahead_m * away
            start = target + distance * away
        slide = _aside(framing.azimuth, by, width)
        position = self._keep_inside(start + slide)
        if self.journey is not None:
            ahead = -direction(state.yaw - 0.5 * math.pi, self.journey.pitch_rad)
        else:
            ahead = target + slide - position
        azimuth = framing.azimuth + by["orbit"]
        ahead = _turned(ahead, by["pan"], by["tilt"], azimuth)
        focal = _zoomed(framing.focal, by)
        camera = look_at(position, position + ahead, focal, azimuth - by["pan"])
        return _rolled(camera, roll)

    def in_room(self, points: Float64Array, times: Float64Array) -> CameraTrack:
        """The path in a room that holds the camera at all times, s, and points [n, 3], m."""
        places = np.array([self.at(float(time)).position for time in times])
        reach = float(np.max(np.abs(places[:, :2])))
        spread = float(np.max(np.abs(points[:, :2])))
        height = float(np.max(points[:, 2])) / 0.6
        above = (float(np.max(places[:, 2])) + 0.35) / 0.6
        return replace(self, room_m=max(reach + 0.6, spread + 0.8, height + 0.5, above, 3.5))

    def _keep_inside(self, position: Float64Array) -> Float64Array:
        position = np.asarray(position, dtype=np.float64)
        if self.has_floor:
            position[2] = max(position[2], min(LOWEST_M, 0.4 * self.framing.distance_m))
        if math.isfinite(self.room_m):
            wall = self.room_m - 0.4
            position[:2] = np.clip(position[:2], -wall, wall)
            ceiling_m = CEILING * self.room_m if self.corridor_m is None else CORRIDOR_HEIGHT_M
            position[2] = min(position[2], ceiling_m - 0.3)
        return position


def _zoomed(focal: float, by: Mapping[str, float]) -> float:
    """Focal length after all zooms."""
    focal *= math.exp(by["zoom"])
    if not by[STATED["zoom"]]:
        return focal
    view = 2.0 * math.atan(0.5 / focal) - by[STATED["zoom"]]
    return 0.5 / math.tan(0.5 * min(max(view, _VIEWS_RAD[0]), _VIEWS_RAD[1]))


def _aside(azimuth: float, by: Mapping[str, float], width_m: float) -> Float64Array:
    """[3] by which camera and target move together, m; the picture is so wide at the subject."""
    right = np.array([math.cos(azimuth), math.sin(azimuth), 0.0])
    ahead = np.array([-right[1], right[0], 0.0])
    to_right = width_m * by["truck"] + by[STATED["truck"]]
    up = width_m * by["pedestal"] + by[STATED["pedestal"]]
    return np.asarray(to_right * right + width_m * by["along"] * ahead + [0.0, 0.0, up])


def _rolled(camera: PosedCamera, angle: float) -> PosedCamera:
    """The camera turned about its optical axis; positive = clockwise seen from behind it."""
    if angle == 0.0:
        return camera
    cosine, sine = math.cos(angle), math.sin(angle)
    right, down, forward = camera.rotation
    axes = np.stack([cosine * right + sine * down, cosine * down - sine * right, forward])
    return PosedCamera(camera.position, axes, camera.focal)


def _turned(forward: Float64Array, right: float, up: float, azimuth: float) -> Float64Array:
    """The vector turned to the right about the vertical, then up.

    One that is vertical turns up towards where a camera at that azimuth looks.
    """
    cosine, sine = math.cos(right), math.sin(right)
    x, y, z = forward
    flat, length = math.hypot(x, y), math.hypot(x, y, z)
    if flat <= VERTICAL * length:
        x, y, flat = -math.sin(azimuth), math.cos(azimuth), 0.0
    x, y = x * cosine + y * sine, y * cosine - x * sine
    pitch, most = math.atan2(z, flat), MOST_PITCH_RAD
    angle = min(max(pitch + up, min(pitch, -most)), max(pitch, most))
    scale = length * math.cos(angle) / math.hypot(x, y)
    return np.array([x * scale, y * scale, length * math.sin(angle)])
