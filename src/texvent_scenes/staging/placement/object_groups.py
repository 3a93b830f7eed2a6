"""All copies of one object: the room they take, their formation, and what they wear and hold."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from texvent_scenes.colours import rgb_of
from texvent_scenes.description import STANDING, SceneDescription
from texvent_scenes.models.activities import HAND_NOUNS, PERSON_NOUNS, TRAVELLING
from texvent_scenes.models.anchors import Support, find_support
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.parts import with_parts
from texvent_scenes.models.people.outfit import CLOTHES, HOLDS, Prop, list_props
from texvent_scenes.models.people.person import SEAT, dress
from texvent_scenes.models.places import is_room
from texvent_scenes.models.protocol import Model, Noun, Pose
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.data import SENT
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import is_centred, lowest_point, size_of
from texvent_scenes.staging.tracks.choose_track import orbit_radius
from texvent_scenes.staging.tracks.keys import Vector
from texvent_scenes.staging.tracks.motion_plan import MotionPlan
from texvent_scenes.staging.tracks.track import sample_places

if TYPE_CHECKING:
    from texvent_scenes.staging.placement.apart import Spacing

GAP_M = 0.25
"""Least space between two objects, in units of the smaller one's size."""
_ROUNDING_M = 1e-9
"""Slack of a gap: objects just at it are apart, whichever way a processor rounds the last bit."""
OVERTAKEN = 0.4
"""Speed of what is overtaken, as a share of what overtakes it."""
_TURNING = ("spin", "roll", "sway", "dance", "fall")
"""Motions that need the same room at all sides."""


@dataclass
class ObjectGroup:
    """All copies of one object, and the room they take."""

    index: int
    scene_object: SceneObject
    noun: Noun
    models: list[Model]
    plan: MotionPlan
    offsets: list[Vector]
    """Places of the copies relative to the group's middle, m."""
    half: Float64Array
    """[3] half extents of the room taken over the whole clip, m."""
    centre: Float64Array = field(default_factory=lambda: np.zeros(3))
    carrier: ObjectGroup | None = None
    orbits: ObjectGroup | None = None
    ring_m: float | None = None
    """Radius of the ring about that, m; None = outside of it."""
    yaws: list[float] | None = None
    """Heading of each copy, where they differ."""
    on_chairs: bool = False
    """Whether each of its people sits on a chair that comes with them."""
    spacing: Spacing | None = None
    """Distances of what rests beside it on the same thing."""
    row_m: float | None = None
    """Length of the row in which it is on something; None: it is on the ground."""
    bearer: tuple[ObjectGroup, Support] | None = None
    """The thing on or in which it is, and the room there."""
    begins: Float64Array | None = None
    """[2] place of its middle at time 0 that stated metres decide, m; None: none do."""
    ends_m: tuple[float, float] | None = None
    """Ends of its way along what bears it, from where it begins, m; None: it goes through its
    middle."""
    stops_s: float | None = None
    """Time at which it comes to the end of a belt that runs on; None: it does not."""
    lag_m: Float64Array = field(default_factory=lambda: np.zeros(2))
    """[2] from its middle as it is placed to that at time 0: half its way back, m."""

    @property
    def middle(self) -> Float64Array:
        """[3] its middle, m: of what is in a row on something, that of its copies there."""
        if self.row_m is None:
            return self.centre
        return np.asarray(self.centre + np.mean(self.offsets, axis=0))

    @property
    def begin(self) -> Float64Array:
        """[2] its middle at time 0, once it is placed, m."""
        return np.asarray(self.middle[:2] + self.lag_m)

    @property
    def takes_along(self) -> bool:
        """Whether what is on it leaves its place with it: it goes, or is itself on what goes."""
        return self.is_going or self.carrier is not None

    @property
    def is_going(self) -> bool:
        """Whether it leaves its place or turns at any time."""
        path = self.plan.path
        return self.plan.motion.is_moving or not (path is None or path.is_resting)

    @property
    def size_m(self) -> float:
        """Largest extent of one copy."""
        model = self.models[0]
        return max(model.length, model.width, model.height)

    @property
    def top_m(self) -> float:
        """Height of its top above its origin."""
        return self.models[0].height * (0.5 if is_centred(self.noun) else 1.0)

    @property
    def origin_m(self) -> float:
        """Height of its origin above what it rests on."""
        return -lowest_point(self.models[0]) if is_centred(self.noun) else 0.0

    def reach_below(self, height_m: float) -> float:
        """Half its extent up to a height above its foot, m: of a tree, that of its trunk."""
        low, body = lowest_point(self.models[0]), self.models[0]
        boxes = [bounds([one]) for one in body.parts(Pose(0.0, 0.0, 0.0, "stand"))]
        below = [np.abs(box[:, :2]).max() for box in map(np.array, boxes)
                 if box[0, 2] - low < height_m]  # fmt: skip
        is_alone = len(self.models) == 1 and not self.plan.motion.is_moving
        return float(max(below)) if below and is_alone else float(np.max(self.half[:2]))

    def to_world(self, x: float, y: float, z: float) -> Float64Array:
        """[3] a place in its body coordinates, where its middle is, in the world, m."""
        cosine, sine = math.cos(self.plan.yaw), math.sin(self.plan.yaw)
        offset = np.array([x * cosine - y * sine, x * sine + y * cosine, z])
        return np.asarray(self.centre + offset)

    def fit(self) -> None:
        """Work out the room that it takes, after its plan or its copies' places have changed."""
        self.half = half_extents_over_clip(self.models, self.offsets, self.plan)

    def gather(self) -> None:
        """Move the middle of one that stands in a row of others to where it is there."""
        if len(self.offsets) == 1 and any(self.offsets[0]):
            self.centre = self.centre + np.array(self.offsets[0])
            self.offsets = [(0.0, 0.0, 0.0)]
            self.fit()

    def half_at_rest(self) -> Float64Array:
        """[3] half extents of all copies where they stand, without their way, m."""
        plan = replace(self.plan, motion=STANDING, path=None)
        return half_extents_over_clip(self.models, self.offsets, plan)


class Goal(NamedTuple):
    """Goal of a group's placement."""

    position: Float64Array
    """[3] middle of the group, m."""
    slide: Float64Array
    """[3] direction in which it may move from there to find room; zero = it stays."""


def half_extents_over_clip(
    models: list[Model], offsets: list[Vector], plan: MotionPlan
) -> Float64Array:
    """[3] half extents of what a group takes up over the clip, m."""
    model = models[0]
    cosine, sine = abs(math.cos(plan.yaw)), abs(math.sin(plan.yaw))
    length, width = model.length, model.width
    size = max(length, width)
    if plan.motion.kind in _TURNING:
        length = width = size
    half = 0.5 * np.array(
        [cosine * length + sine * width, sine * length + cosine * width, model.height]
    )
    spread = np.abs(np.array(offsets)).max(axis=0)
    if plan.path is not None:
        half[:2] = 0.5 * size
        places = sample_places(plan.path, plan.duration_s)
        return np.asarray(half + spread + 0.5 * np.ptp(places, axis=0))
    travel = 0.5 * plan.travel_m * np.array([cosine, sine, abs(plan.climb)])
    if plan.motion.kind == "orbit":
        travel = orbit_radius(plan, size) * np.array([1.0, 1.0, 0.0])
    return np.asarray(half + spread + travel)


def overlap(centre: Float64Array, group: ObjectGroup, other: ObjectGroup) -> bool:
    """Whether a group with its middle at `centre` would overlap with another at any time."""
    gap = GAP_M * min(group.size_m, other.size_m)
    apart = np.abs(centre - other.centre)[:2] - (group.half + other.half)[:2]
    (low, high), (other_low, other_high) = _vertical(centre, group), _vertical(other.centre, other)
    above = gap if group.noun.habitat == other.noun.habitat else 0.0
    is_near = bool(np.all(apart < gap - _ROUNDING_M))
    return is_near and max(low - other_high, other_low - high) < above


def _vertical(centre: Float64Array, group: ObjectGroup) -> tuple[float, float]:
    """Lowest and highest point of a group, m."""
    height = 2.0 * float(group.half[2])
    low = float(centre[2]) - (0.5 * height if is_centred(group.noun) else 0.0)
    return low, low + height


def join_way(group: ObjectGroup, others: Iterable[ObjectGroup]) -> None:
    """Turn who walks or runs the way in which others do so already: "a girl and her mother"."""
    alike = (one for one in others if _walks_freely(one)
             and one.plan.motion.kind == group.plan.motion.kind)  # fmt: skip
    other = next(alike, None) if _walks_freely(group) else None
    if other is not None:
        group.plan = replace(group.plan, yaw=other.plan.yaw)
        group.fit()


def _walks_freely(group: ObjectGroup) -> bool:
    """Whether one who goes on foot goes a straight way, of which no direction is said."""
    plan, said = group.plan, group.scene_object
    is_open = said.heading_deg is None and said.position_m is None and len(said.motions) == 1
    on_foot = group.noun.motion == "walk" and plan.motion.kind in ("walk", "run")
    return is_open and on_foot and plan.path is None and plan.motion.direction is None


def match_pace(group: ObjectGroup, partner: ObjectGroup, kind: str) -> None:
    """Give a companion the heading and speed of its partner, where both go somewhere.

    What follows goes behind the partner, which is placed already; what is overtaken or passed goes
    the same way, slower, unless the scene says how it goes.
    """
    motion, other = group.plan.motion, partner.plan
    if not (other.is_path and group.plan.is_path):
        return
    own_m_s, is_along = group.plan.speed_m_s, math.cos(group.plan.yaw - other.yaw) > 0.5
    if kind in ("follow", "with", "beside"):
        if kind == "follow" and other.motion.speed_m_s is None:
            other = replace(other, speed_m_s=max(other.speed_m_s, group.plan.speed_m_s))
        partner.plan, group.plan = other, replace(other, motion=motion)
        partner.fit()
    elif motion.direction is None and motion.speed_m_s is None:
        speed = OVERTAKEN * other.speed_m_s
        group.plan = replace(group.plan, yaw=other.yaw, speed_m_s=speed)
    elif kind == "overtake" and motion.speed_m_s is None and is_along:
        group.plan = replace(group.plan, speed_m_s=min(OVERTAKEN * other.speed_m_s, own_m_s))
    group.fit()


_RESTING = frozenset({"stand", "sit", "lie", "slide"})
_APART = 0.3
"""Space between copies of small things, in their sizes: apples do not lie half a metre apart."""


def rests(noun: Noun, kind: str) -> bool:
    """Whether it is on something while it does that."""
    return kind in _RESTING or kind in noun.acts - TRAVELLING


def stagger(
    models: list[Model], plan: MotionPlan, noun: Noun, rng: np.random.Generator, *,
    is_row: bool = False,
) -> list[Vector]:  # fmt: skip
    """Places of the copies about the middle of their group, m, staggered so none hides another.

    Those of whom a row is said, and parked vehicles, stand on a line at even gaps.
    """
    count, is_driven = len(models), noun.motion == "drive"
    if count == 1:
        return [(0.0, 0.0, 0.0)]
    along, across = _spacing(models, plan, noun)
    is_lifting = plan.motion.kind in ("rise", "sink") and noun.motion == "fly"
    is_on_ground = noun.habitat == "air" and rests(noun, plan.motion.kind)
    is_deep = is_centred(noun) and noun.name not in HAND_NOUNS and not (is_lifting or is_on_ground)
    is_deep &= not (noun.habitat == "water" and plan.motion.kind == "jump")  # all out of it
    tall = max(model.height for model in models) if is_deep else 0.0
    columns = count if count <= 3 else math.ceil(math.sqrt(1.6 * count))
    is_row |= is_driven and not (plan.is_path or plan.path)
    columns = count if is_row else math.ceil(count / 2) if is_driven else columns
    in_depth = plan.is_path and abs(math.sin(plan.yaw)) > 0.5 >= abs(math.cos(plan.yaw))
    offsets: list[Vector] = []
    for number in range(count):
        row, column = divmod(number, columns)
        in_row = min(columns, count - row * columns)
        a = (column - 0.5 * (in_row - 1) + 0.3 * (row % 2)) * along
        b = (row - 0.5 * ((count - 1) // columns)) * across
        a += float(rng.uniform(-0.12, 0.12)) * along * (not is_row)
        stray = float(rng.uniform(-0.08, 0.08)) * across
        if not (is_driven or is_row):  # vehicles keep to their lanes
            b = b + 0.6 * across * (number % 2) + stray
        up = (0.9 * (-1.0) ** number + float(rng.uniform(-0.35, 0.35))) * tall if is_deep else 0.0
        up *= not is_row
        offsets.append((b * 1.6, a, up) if in_depth else (a, b, up))
    return offsets


def _spacing(models: list[Model], plan: MotionPlan, noun: Noun) -> tuple[float, float]:
    """Metres from one copy to the next, along the heading and across it."""
    length = max(model.length for model in models)
    width = max(model.width for model in models)
    size = max(length, width)
    if plan.motion.kind == "orbit":
        return 4.0 * size, 4.0 * size
    if noun.motion == "drive":
        return 1.45 * length + 0.5, max(width + 0.9, 2.9)
    if plan.is_facing or noun.name in HAND_NOUNS:
        return 1.6 * width, 0.2 * width  # in one row, as the camera sees them
    apart = min(0.3, _APART * size)
    across = 1.4 * width + apart + min(0.1, 0.1 * size)
    if is_centred(noun):
        return 0.8 * length + apart, across
    return 1.2 * (length if plan.is_path else size) + apart, across


def list_around(count: int, wide_m: float, deep_m: float) -> list[tuple[float, float, float]]:
    """Offsets and headings of so many around something, the farthest first; two are at its ends."""
    first = 0.0 if count == 2 else 0.5 * math.pi
    found = []
    for number in range(count):
        # At alternate sides, so that the camera's side is taken last.
        turn = (number + 1) // 2 * (1.0 if number % 2 else -1.0)
        angle = first + 2.0 * math.pi * turn / count
        x, y = wide_m * math.cos(angle), deep_m * math.sin(angle)
        found.append((x, y, math.atan2(-y, -x)))
    return found


def part_in_midst(group: ObjectGroup, room_m: float) -> None:
    """Move one half of the copies of a group to the left, the others to the right, by that room.

    Two stand side by side, the room in their middle.
    """
    if len(group.models) == 2:
        plan = replace(group.plan, motion=STANDING, path=None)
        half = half_extents_over_clip(group.models, [(0.0, 0.0, 0.0)], plan)
        reach = float(half[0]) + room_m
        group.offsets = [(side * reach, 0.0, z) for side, (_, _, z) in
                         zip((-1.0, 1.0), group.offsets, strict=True)]  # fmt: skip
        group.fit()
    elif len(group.models) > 1:
        order = sorted(range(len(group.offsets)), key=lambda one: group.offsets[one][0])
        left = {*order[: len(order) // 2]}
        group.offsets = [(x + (-room_m if number in left else room_m), y, z)
                         for number, (x, y, z) in enumerate(group.offsets)]  # fmt: skip
        group.fit()


def find_gap(group: ObjectGroup) -> Float64Array:
    """[2] the middle of the widest gap between two copies of a group, in its midst if alike."""
    places = np.array(group.offsets)[:, :2]
    axis = int(np.ptp(places, axis=0).argmax())
    places = places[np.argsort(places[:, axis])]
    gaps, middle = np.diff(places[:, axis]), 0.5 * (len(places) - 2)
    widest = np.flatnonzero(gaps >= gaps.max() - _ALIKE_M)
    first = int(min(widest, key=lambda one: abs(one - middle)))
    return np.asarray(group.centre[:2] + 0.5 * (places[first] + places[first + 1]))


_ALIKE_M = 0.01
"""Difference of gaps that are as wide."""
_ARMS_HANG = frozenset({"stand", "walk", "run", "move"})
"""Acts in which somebody has something under an arm."""
_LEAPS = frozenset({"jump", "backflip"})
"""Acts of who goes on with what is on the feet."""
_SEAT_BACK_M = 0.03
"""Distance of the middle of a chair behind the hips."""


def dressed(description: SceneDescription, index: int, nouns: Mapping[str, Noun]) -> Noun:
    """The noun of an object: a person in what it wears, a box open if something is in it.

    A wall in a room is none of a garden.
    """
    objects = description.objects
    said = tuple((one.name, one.count, rgb_of(one.colour)) for one in objects[index].parts)
    noun = with_parts(nouns[objects[index].noun], said)
    opened, put = trait_value("drawn open", noun.name), trait_value("drawn put up", noun.name)
    inside, place = trait_value("drawn in a room", noun.name), description.place.name
    if inside and place and is_room(place):
        return replace(nouns[inside], name=noun.name)
    sends = {one.subject for one in description.relations if one.kind in SENT}
    for one in description.relations if opened or put else ():
        is_filled = one.kind in ("in", "into") or (one.kind == "towards" and one.subject in sends)
        if opened and is_filled and index in one.targets:
            return replace(nouns[opened], name=noun.name)
        if put and one.kind == "on" and index == one.subject:
            return replace(nouns[put], name=noun.name)
    worn = [
        (
            objects[target].noun,
            rgb_of(objects[target].colour),
            objects[target].material or "",
            rgb_of(objects[target].second_colour),
        )
        for one in description.relations
        if one.kind == "wear" and one.subject == index
        for target in one.targets
        if objects[target].noun in CLOTHES
    ]
    return dress(noun, worn) if worn and noun.name in PERSON_NOUNS else noun


def choose_props(description: SceneDescription, group: ObjectGroup) -> tuple[Prop, ...]:
    """Props of a person's activities, or else its usual ones, that the scene does not show."""
    if group.noun.name not in PERSON_NOUNS:
        return ()
    shown = {scene_object.noun: scene_object for scene_object in description.objects}
    said = group.scene_object.motions or (STANDING,)
    kinds = dict.fromkeys(motion.kind for motion in said)
    if group.plan.path is not None:  # as the way to a jump
        kinds |= dict.fromkeys(key.activity for key in group.plan.path.keys)
    if kinds.keys() & _LEAPS:  # with what it is on as it usually goes
        kinds[group.noun.motion] = None
    size = size_of(group.models[0])
    props = [prop for kind in kinds for prop in list_props(kind, size)]
    hangs = kinds.keys() <= _ARMS_HANG
    props = props or [one for one in HOLDS.get(group.noun.name, ())
                      if hangs or one.anchor != "torso"]  # fmt: skip
    if group.on_chairs and not shown.keys() & nouns_with("seat at a table"):
        props.append(_draw_chair(size))
    kept = (
        prop for prop in props
        if prop.is_below or prop.is_own or shown.keys().isdisjoint(prop.nouns)
    )  # fmt: skip
    named = [(prop, next((shown[one] for one in prop.nouns if one in shown), None))
             for prop in kept]  # fmt: skip
    return tuple(
        prop if one is None else prop.as_said(one.count, rgb_of(one.colour), one.noun)
        for prop, one in named
    )


def _draw_chair(scale: float) -> Prop:
    """The chair under who sits at a table; `scale` is the body's, relative to an adult."""
    (name,) = nouns_with("seat at a table")
    usual_m = find_support(NOUNS[name].build(colour=None, scale=1.0, seed=0), near_m=SEAT).height
    model = NOUNS[name].build(colour=None, scale=max(scale, 1.0) * SEAT / usual_m, seed=0)
    low = SEAT * (1.0 - min(scale, 1.0))
    axes = np.column_stack([np.eye(3), np.array([-_SEAT_BACK_M * scale, 0.0, -low])])
    placed = moved(model.parts(Pose(0.0, 0.0, 0.0, "stand")), axes)
    return Prop("ground", lambda _: placed)
