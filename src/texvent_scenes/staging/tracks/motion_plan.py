"""Plan of an object's motion: heading, speed, gesture and the room it takes."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from texvent_scenes.default_work import AT_REST
from texvent_scenes.models.activities import (
    ACTIVITIES,
    HAND_GESTURES,
    HAND_NOUNS,
    ON_GROUND,
    PERSON_NOUNS,
)
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.scene import Direction, Motion
from texvent_scenes.staging.tracks.flight_keys import falls_sideways
from texvent_scenes.staging.tracks.phase_keys import build_path
from texvent_scenes.staging.tracks.phases import (
    COMING_DOWN,
    GOING,
    PATH_KINDS,
    YAWS,
    done_on_the_way,
    goes_straight_up,
    needs_steering,
    schedule,
    time_of_work,
    usual_speed,
    works_in_turn,
)
from texvent_scenes.staging.tracks.track import Term, Track
from texvent_scenes.staging.tracks.turning import axle_of

_OF_CAMERA, _LOOMING = ("towards", "away"), 45.0
"""Directions in depth; most way of what flies so in a clip, in its own sizes: farther off it is a
point."""
_MIRRORED: Mapping[Direction | None, Direction] = {
    "clockwise": "counter-clockwise", "counter-clockwise": "clockwise",
    "right": "left", "left": "right",
}  # fmt: skip
"""Sense of a spin → that of the same one, seen from behind."""
_DIAGONAL = 0.6
"""Metres up per metre along of what goes diagonally in the picture."""
_TALL = 1.2
"""Height over width from which on a thing lies on its side, not on its foot."""
FLAT, _WIDE = 0.62, 0.7
"""Objects whose length is below this share of their width show their front to the camera; the
second is for what slides: a board, a mirror."""


@dataclass(frozen=True)
class MotionPlan:
    """Heading, speed and room of an object's motion."""

    motion: Motion
    yaw: float
    speed_m_s: float
    duration_s: float
    path: Track | None = None
    """Its path about (0, 0), where it does more than one simple movement."""
    gesture: str | None = None
    """Activity of a person or a hand in place: a name of `models.activities`."""
    act: str = ""
    """Activity of the arms all along its way."""
    radius_m: float = 0.0
    """Rolling radius; 0 = it goes on wheels or feet."""
    spin_axis: str = "yaw"
    """Channel of a spin: the vertical, the body's width, or its length."""
    start_m: float | None = None
    """Height above the ground at which what falls, bounces or sinks begins; None: the usual one."""
    is_facing: bool = False
    """Whether it shows its front to the camera while it moves: a board with a pattern."""
    work: tuple[Term, ...] = ()
    """Time of the parts of what works and rests in turn."""
    is_laid: bool = False
    """Whether a thing that usually stands lies on its side."""
    is_headed: bool = False
    """Whether its heading at time 0 is stated."""

    @property
    def is_path(self) -> bool:
        """Whether it goes from one place to another along a straight line."""
        is_straight = self.motion.direction not in ("to and fro", "up and down")
        return self.path is None and self.motion.kind in PATH_KINDS and is_straight

    @property
    def travel_m(self) -> float:
        """Metres covered in the clip along the heading."""
        if self.is_path:
            return self.speed_m_s * self.duration_s
        if self.motion.direction == "to and fro":
            return 0.6 * self.speed_m_s * self.duration_s
        return 0.0

    @property
    def climb(self) -> float:
        """Metres up per metre along."""
        direction, is_free = (
            self.motion.direction or "",
            self.motion.kind in ("fly", "glide", "swim"),
        )
        if direction == "diagonal" and (is_free or self.is_facing):
            return _DIAGONAL
        is_free &= not self.is_facing
        return {"up": 0.45, "down": -0.45}.get(direction, 0.0) if is_free else 0.0


def plan_motion(
    motions: Sequence[Motion],
    noun: Noun,
    model: Model,
    duration_s: float,
    rng: np.random.Generator,
    start_m: float | None = None,
    heading_deg: float | None = None,
) -> MotionPlan:
    """Heading and speed of a motion: said by the prompt, or usual for the noun.

    Args:
        motions: what the prompt says, in order; the first decides the heading.
        noun: the object.
        model: its model, for its size.
        duration_s: length of the clip, s.
        rng: decides between left and right where nothing is said.
        start_m: height above the ground at time 0, if it is said.
        heading_deg: heading at time 0, if it is said, degrees.
    """
    if noun.name in nouns_with("on castors"):
        motions = [replace(one, kind="slide") if one.kind == "roll" else one for one in motions]
    act = done_on_the_way(motions, noun)
    motions = [_as_it_does(noun, one, start_m or 0.0) for one in motions[: 1 if act else None]]
    is_tall = noun.habitat == "fixed" and model.height > _TALL * max(model.length, model.width)
    if is_tall and motions[0].kind == "fall":
        motions = [replace(one, kind="topple") if one.kind == "lie" else one for one in motions]
    start_m = start_m if any(one.kind in COMING_DOWN for one in motions) else None
    motion, toss = motions[0], rng.random()
    yaw = _choose_yaw(motions, noun, model, toss)
    yaw = yaw if heading_deg is None else math.radians(heading_deg)
    stated = next((m.speed_m_s for m in motions if m.speed_m_s is not None), None)
    speed = _usual_speed(motion, noun, model, duration_s) if stated is None else stated
    if noun.is_working and works_in_turn(motions):
        terms = time_of_work(motions, model, duration_s)
        return MotionPlan(motion, yaw, speed, duration_s, work=terms)
    if noun.is_working and len(motions) == 1 and motion == AT_REST:
        stopped = Term("run_s", drift=-1.0)
        return MotionPlan(motion, yaw, speed, duration_s, work=(stopped,))
    is_wheeled = noun.motion == "drive" or getattr(model, "is_wheeled", False)
    going = next((one for one in motions if one.kind != "stand"), motion)
    is_flat = _faces_camera(noun, model, going)
    is_facing = is_flat and (heading_deg is None or going.kind in PATH_KINDS | {"orbit"})
    if is_flat and not is_facing and math.sin(yaw) > 0.0:
        motions = [_seen_from_behind(one) for one in motions]
        motion = motions[0]
    axle = "pitch" if noun.name in nouns_with("has an axle") else "yaw"
    plan = MotionPlan(
        motion, yaw, speed, duration_s, is_facing=is_facing, start_m=start_m,
        radius_m=_rolling_radius(model) if motion.kind == "roll" and not is_wheeled else 0.0,
        spin_axis="roll" if is_flat else axle, is_laid=is_tall and motion.kind == "lie", act=act,
        is_headed=heading_deg is not None,
    )  # fmt: skip
    is_straight = goes_straight_up(motion, noun)
    is_skid = motion.kind == "slide" and noun.motion == "drive"
    if needs_steering(motions) or is_skid or is_straight:
        path = build_path(
            motions, noun, model, yaw=yaw, stated_m_s=stated, duration_s=duration_s,
            spin_axis=plan.spin_axis, start_m=start_m,
        )  # fmt: skip
        path = replace(path, terms=(*path.terms, *_hasten(motions, noun, duration_s)))
        return replace(plan, yaw=path.yaw, path=path)
    pace = 1.0 if motion.speed_m_s is not None else motion.pace
    return replace(plan, speed_m_s=speed * pace, gesture=choose_gesture(noun, motion))


def _usual_speed(motion: Motion, noun: Noun, model: Model, duration_s: float) -> float:
    """Speed of a motion without a stated one, m/s; limited for what flies at the camera."""
    speed = usual_speed(noun, motion.kind)
    if motion.kind in ("fly", "glide") and motion.direction in _OF_CAMERA:
        size_m = max(model.length, model.width, model.height)
        speed = min(speed, _LOOMING * size_m / duration_s)
    return speed


def _hasten(motions: Sequence[Motion], noun: Noun, duration_s: float) -> Iterator[Term]:
    """Time of the limbs beside that of the clip: each act goes on at its pace."""
    for phase in schedule(motions, duration_s):
        motion, rate, begin_s = phase.motion, phase.motion.pace - 1.0, phase.start_s
        if rate and (motion.kind in noun.acts or choose_gesture(noun, motion) is not None):
            yield Term("run_s", offset=-rate * begin_s, drift=rate, begin_s=begin_s,
                       end_s=phase.end_s)  # fmt: skip


def _rolling_radius(model: Model) -> float:
    """Radius at which a body rolls, m: its middle is so high above the ground."""
    return axle_of(model, "pitch").height_m


def raised(plan: MotionPlan, by_m: float) -> MotionPlan:
    """The plan of what comes down, from so much higher above the place where it lands."""
    path, start_m = plan.path, max((plan.start_m or 0.0) + by_m, 0.0)
    if path is not None:
        x, y, z = path.start
        path = replace(path, start=(x, y, max(z + by_m, 0.0)))
    return replace(plan, start_m=start_m, path=path)


def _as_it_does(noun: Noun, motion: Motion, start_m: float) -> Motion:
    """Motion kind that suits a noun: only hands rotate, other nouns spin.

    What stands on a small foot, on legs or on wheels falls over.
    """
    if motion.kind == "rotate" and noun.name not in HAND_NOUNS:
        return replace(motion, kind="spin")
    if motion.kind == "throw" and motion.direction in _OF_CAMERA:
        return replace(motion, kind="fly")
    falls_over = noun.name in nouns_with("falls over") or falls_sideways(noun)
    is_falling_over = motion.kind == "fall" and falls_over and start_m < 0.1
    return replace(motion, kind="topple") if is_falling_over else motion


def _seen_from_behind(motion: Motion) -> Motion:
    """A spin of what shows its back: clockwise as the camera sees it is not as its front has it."""
    if motion.kind != "spin" or motion.direction not in _MIRRORED:
        return motion
    return replace(motion, direction=_MIRRORED[motion.direction])


def _choose_yaw(motions: Sequence[Motion], noun: Noun, model: Model, toss: float) -> float:
    motion, default = motions[0], YAWS["left" if toss < 0.5 else "right"]
    later = (m.direction for m in motions if m.kind in PATH_KINDS and m.direction in YAWS)
    direction = motion.direction or next(later, None) or ""
    goes = motion.kind in PATH_KINDS or any(m.kind in GOING | {"turn"} for m in motions)
    is_toppling = motion.kind == "topple" or any(one.kind == "fall" for one in motions[1:])
    if motion.kind == "turn":
        return default  # "turns left" is to its own left
    if motion.kind in ("rise", "sink") and noun.name in nouns_with("takes off"):
        return YAWS.get(direction, default)  # along a runway
    if noun.habitat == "fixed" and is_toppling:
        if falls_sideways(noun):
            return math.copysign(0.5 * math.pi, toss - 0.5)
        return default  # what falls over does so to a side of the picture
    if not goes and (motion.direction is None or _is_seen_from_front(noun, motion)):
        return _face_camera(noun, model, motion, toss)
    is_flat = noun.name in nouns_with("flat pattern")
    if direction == "diagonal" and is_flat:
        return default
    if motion.kind in ("fly", "glide", "swim") and direction in ("up", "down", "diagonal"):
        return default  # up or down in the picture, and to a side only as it likes
    return YAWS.get(direction, default)


def _faces_camera(noun: Noun, model: Model, motion: Motion) -> bool:
    """Whether it shows its front while it goes or spins: a board slides so, a shape always."""
    if noun.name in nouns_with("flat pattern"):
        return motion.kind in PATH_KINDS | {
            "orbit", "spin", "rise", "sink", "grow", "shrink"
        }  # fmt: skip
    if motion.kind == "spin":
        return noun.name in nouns_with("flat picture")
    is_wide = model.length < _WIDE * model.width
    return noun.habitat == "fixed" and is_wide and motion.kind == "slide"


def choose_gesture(noun: Noun, motion: Motion) -> str | None:
    """The activity of a person or hand that stays in its place; None = it is no such thing."""
    kinds = {**dict.fromkeys(PERSON_NOUNS, ACTIVITIES), **dict.fromkeys(HAND_NOUNS, HAND_GESTURES)}
    known = kinds.get(noun.name)
    if known is None or motion.kind in PATH_KINDS or motion.kind in ("jump", "spin", "fall"):
        return None
    handed = f"{motion.kind} {motion.direction}"
    if handed in known:
        return handed
    if motion.kind in ON_GROUND and noun.name in PERSON_NOUNS:
        return ON_GROUND[motion.kind]
    return motion.kind if motion.kind in known else None


def _is_seen_from_front(noun: Noun, motion: Motion) -> bool:
    """Whether its direction says which hand, or where it leans, not which way the body faces."""
    if motion.kind in ("sway", "tilt", "work"):
        return True
    gesture = choose_gesture(noun, motion)
    return gesture is not None and not (gesture in ACTIVITIES and ACTIVITIES[gesture].is_sideways)


def _face_camera(noun: Noun, model: Model, motion: Motion, toss: float) -> float:
    """Heading of what stays in place: animals from the side, the rest facing the camera.

    Of animals seen from the side the front is a little nearer than the rear.
    Fronts are at +x. Boards and flat objects turn it to the camera; others stand at an angle to it.
    """
    tilt = 0.5 * (2.0 * toss - 1.0)
    front, side = -0.5 * math.pi, math.pi if toss < 0.5 else 0.0
    is_person = noun.name in PERSON_NOUNS
    if is_person and motion.kind in ACTIVITIES and ACTIVITIES[motion.kind].is_sideways:
        return side + 0.5 * tilt
    turned = trait_value("side view", noun.name)
    if turned is not None:
        return turned * tilt if motion.direction != "left" else math.pi
    if noun.name in nouns_with("flat pattern") | nouns_with("faces the camera"):
        return front
    if model.length < FLAT * model.width or is_person:
        return front + 0.5 * tilt
    if noun.habitat == "fixed":
        return front + math.copysign(0.45, tilt) + 0.3 * tilt
    return side - tilt if noun.motion == "walk" else side + tilt
