"""Relations as positions: on, in, at, under, between, beside, past, behind and so on."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.description import IndexedRelation
from texvent_scenes.models.activities import (
    DONE_SEATED,
    PERSON_NOUNS,
    SEATED,
    TIMED,
    TO_AND_FROM_SEATS,
)
from texvent_scenes.models.anchors import Support, find_room, find_support
from texvent_scenes.models.people.person import SEAT
from texvent_scenes.models.protocol import Pose
from texvent_scenes.models.shapes import bounds, moved, shift, turn_about
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.data import WAYS
from texvent_scenes.staging.actors import is_centred, lowest_point, size_of
from texvent_scenes.staging.interactions.holding import hides_riders
from texvent_scenes.staging.placement.along_surface import (
    carry_along,
    go_down,
    is_leap,
    leap_over,
    leap_up,
    stop_at_edge,
)
from texvent_scenes.staging.placement.apart import SIDES
from texvent_scenes.staging.placement.approaches import lead_over
from texvent_scenes.staging.placement.containers import (
    depth_in,
    go_inside,
    hollow_of,
    reach_of,
)
from texvent_scenes.staging.placement.object_groups import (
    GAP_M,
    Goal,
    ObjectGroup,
    find_gap,
    list_around,
)
from texvent_scenes.staging.placement.on_way import place_on_way
from texvent_scenes.staging.placement.rings import STANDING_M, stand_before, stand_in_ring
from texvent_scenes.staging.placement.rows import line_up
from texvent_scenes.staging.placement.zones import hangs_on, is_before_face, zone_of
from texvent_scenes.staging.tracks.phases import PATH_KINDS

ON_TARGET = WAYS | {"at", "on", "in", "above", "around", "under", "between", "follow"}
"""Relations in which the subject's place follows from the target's; in the others the target's
follows from the subject's."""
INVERSE: Mapping[str, str] = {
    "behind": "front", "front": "behind", "left of": "right of", "right of": "left of",
    "beside": "beside",
}  # fmt: skip
"""Relation of a subject to its target → that of the target to the subject."""
_FIXED, _AWAY, _ALONG_X = np.zeros(3), np.array([0.0, 1.0, 0.0]), np.array([1.0, 0.0, 0.0])
_INTO_PICTURE = 0.6
"""Angle to the picture of the way between two things, rad."""
_OUT = 0.45
"""Share of its way that who comes out of a gap has beyond the half of it."""
_COVERED = 0.55
"""Share of what stands behind that may be hidden where it stands right behind."""
_ASIDE_RAD, _CLEAR_M = 0.25, 0.3
"""Angle by which the camera may see past an edge, and room beside a passed object."""


_FRONT_M = 0.40
"""From the front edge of a seat to the hips."""
_SEATED_M = 0.28
"""From the edge of a table to the middle of who sits at it."""
_ROOF = 1.5
"""Height near which the roof of a closed vehicle is, in heights of that."""
_HUNG = 0.58
"""Height of the middle of what hangs on a wall, as a share of the wall's."""
_OFF_MIDDLE, _FACE_GAP_M = 0.25, 0.01
"""Place of a shape on another one that turns, above its middle, by its height; gap between them."""


def place_on_targets(
    group: ObjectGroup,
    kind: str,
    targets: Sequence[ObjectGroup],
    height: float,
    neighbours: Sequence[int],
) -> Goal:
    """A subject's position with respect to objects that are placed already, by one of `ON_TARGET`.

    What it does may change: it rides or orbits the target. `height` is that of its
    origin where the relation does not decide it, m; `neighbours` are as for `rest_on`.
    """
    if kind == "at" and targets[0].noun.acts & TIMED and group.noun.name in PERSON_NOUNS:
        return Goal(stand_before(group, targets[0]), _FIXED)
    if kind == "on" and is_before_face(group.scene_object, targets[0].scene_object):
        return Goal(stand_before(group, targets[0]), _FIXED)
    if kind == "at" and targets[0].noun.name not in nouns_with("table"):
        return place_by_subject(group, "beside", targets[0], height)
    if kind == "between":  # where `object_placement` has left room
        return _place_between(group, targets, height)
    rest = {"on": rest_on, "in": rest_in, "at": place_at}.get(kind)
    if rest is not None:
        return Goal(rest(group, targets[0], neighbours), _FIXED)
    if kind == "around":
        return _place_around(group, targets, height, neighbours)
    return _PLACE_BY_KIND[kind](group, targets, height)


def leads_between(group: ObjectGroup) -> bool:
    """Whether a group goes a straight way between things, as no vehicle on a road does."""
    plan = group.plan
    is_free = plan.motion.direction is None and group.scene_object.heading_deg is None
    return plan.is_path and plan.path is None and is_free and zone_of(group.noun) != "road"


def _place_between(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """In the middle of targets, or in the widest gap of one; what flies is as high as they are."""
    if leads_between(group):
        group.plan = replace(group.plan, yaw=_INTO_PICTURE)
        group.fit()
    x, y = np.mean([target.centre for target in targets], axis=0)[:2]
    if len(targets) == 1 and len(targets[0].models) > 1:
        x, y = find_gap(targets[0])
    if group.plan.is_path and zone_of(targets[0].noun) == "road":  # it comes out of the gap
        yaw, out = group.plan.yaw, _OUT * group.plan.travel_m
        x, y = x + out * math.cos(yaw), y + out * math.sin(yaw)
    if group.noun.habitat == "air" and group.scene_object.height_m is None:
        low = max(0.5 * min(one.top_m for one in targets), group.models[0].height)
        height = min(height, low)
    is_said = all(target.scene_object.position_m is not None for target in targets)
    is_fixed = is_said or len(targets) == 1
    return Goal(np.array([x, y, height]), _FIXED if is_fixed else -_AWAY)


def _place_around(
    group: ObjectGroup, targets: Sequence[ObjectGroup], height: float, neighbours: Sequence[int]
) -> Goal:
    """Circle around a target for moving objects; objects at rest stand around it and face it."""
    target = targets[0]
    x, y, level = target.centre
    if group.plan.motion.kind not in PATH_KINDS | {"orbit", "spin"}:
        is_table = target.noun.name in nouns_with("table")
        return Goal((place_at if is_table else stand_in_ring)(group, target, neighbours), _FIXED)
    group.orbits = target
    level += 0.8 * target.top_m if group.noun.habitat == "air" else 0.0
    return Goal(np.array([x, y, max(level, 0.0)]), _FIXED)


def _place_above(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    target, own = targets[0], group.models[0].height
    kinds = [one.kind for one in group.scene_object.motions]
    if "jump" in kinds and {*kinds} <= PATH_KINDS | {"jump", "stand", "sink", "fall"}:
        leap_over(group, target)
        return Goal(_on_ground(target, height), _FIXED)
    clear = target.top_m + 0.7 * own + _CLEAR_M + (0.5 * own if is_centred(group.noun) else 0.0)
    if group.noun.name in nouns_with("hangs from a ceiling"):
        clear = target.top_m + _CLEAR_M - lowest_point(group.models[0])
    return Goal(target.centre + np.array([0.0, 0.0, max(clear, height)]), _FIXED)


def _place_under(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """Before what holds its target up in its middle, or beside one that is too low for it."""
    if height + group.models[0].height > targets[0].top_m:
        beside = targets[0].half[0] + group.half[0] + _CLEAR_M
        return Goal(_shift(_on_ground(targets[0], height), beside, 0.0), _ALONG_X)
    nearer = 0.4 * float(targets[0].half[1])
    return Goal(_shift(_on_ground(targets[0], height), 0.0, -nearer), _FIXED)


def _place_follower(group: ObjectGroup, targets: Sequence[ObjectGroup], height: float) -> Goal:
    """Behind its target, on the same path, the foremost copy too."""
    target, own = targets[0], group.models[0]
    reach = 0.5 * (target.models[0].length + own.length)
    group.half = 0.5 * np.array([own.length, own.width, own.height])
    way = np.array([math.cos(target.plan.yaw), math.sin(target.plan.yaw)])
    foremost = float((np.array(group.offsets)[:, :2] @ way).max())
    back_m = 1.6 * reach + 0.4 + foremost
    return Goal(target.to_world(-back_m, 0.0, height - target.centre[2]), _FIXED)


_PLACE_BY_KIND: Mapping[str, Callable[[ObjectGroup, Sequence[ObjectGroup], float], Goal]] = {
    "above": _place_above,
    "under": _place_under,
    "follow": _place_follower,
}


def place_by_subject(group: ObjectGroup, kind: str, subject: ObjectGroup, height: float) -> Goal:
    """A target's position with respect to the subject that the scene relates to it.

    `height` is that of the target's origin, m; the subject is placed already.
    """
    goal = place_on_way(group, kind, subject, height)
    if goal is not None:
        return goal
    if kind == "from behind" and subject.plan.is_path:
        return _hide_start(group, subject, height)
    gap = GAP_M * min(subject.size_m, group.size_m)
    near = subject.half_at_rest()
    x, y, _ = subject.half + group.half + gap
    yaw, here = subject.plan.yaw, _on_ground(subject, height)
    along = (math.cos(yaw), math.sin(yaw))
    goes = subject.plan.is_path or subject.plan.path is not None
    is_aside = goes and abs(along[0]) > 0.5
    # Beside what goes across the image is behind it; else at its right, and smaller things nearer.
    beside = (0.0, y + _CLEAR_M, _AWAY) if is_aside else (x + _CLEAR_M, 0.0, _ALONG_X)
    level = 0.0 if goes else float(group.half[1] - subject.half[1])
    # What is behind one who looks to the right is seen on the left.
    looking = [one.plan.yaw for one in (subject, group) if one.noun.motion == "walk"]
    side = -1.0 if any(math.cos(yaw) > _OBLIQUE for yaw in looking) else 1.0
    ahead = 0.55 * (subject.models[0].length + group.models[0].length) + 0.2
    goals = {
        "from": (-x * along[0], -y * along[1], _AWAY),
        "away from": (-x * along[0], -y * along[1], _AWAY),
        "towards": (x * along[0], y * along[1], _AWAY),
        "overtake": (0.0, y + _CLEAR_M, _AWAY),
        "past": beside,
        "beside": beside if is_aside else (x, level, _ALONG_X),
        "with": (ahead * along[0], y + 0.1, _AWAY) if is_aside else (x, level, _ALONG_X),
        "left of": (x, level, _ALONG_X),
        "right of": (-x, level, -_ALONG_X),
        "behind": (-side * _look_past(subject, group.half_at_rest(), y), -y, -_AWAY),
        "front": (side * _look_past(group, near, y), y, _AWAY),
    }
    if along[1] < -_OBLIQUE and (subject.plan.gesture or "").startswith(SEATED):
        aside_m = math.copysign(_look_past(group, near, y), along[0])
        goals["towards"] = (aside_m, y * along[1], -_AWAY)
    right, back, slide = goals.get(kind, (x, 0.0, _ALONG_X))
    return Goal(_shift(here, right, back), slide)


def _hide_start(group: ObjectGroup, subject: ObjectGroup, height: float) -> Goal:
    """Between the camera and where a subject begins, so that it comes out at an edge at once."""
    yaw = 0.0 if math.cos(subject.plan.yaw) > 0.0 else math.pi
    subject.plan = replace(subject.plan, yaw=yaw)
    subject.fit()
    sign, own = math.cos(yaw), subject.half_at_rest()
    x, y, _ = group.half_at_rest()
    if group.noun.habitat == "fixed":  # behind the trunk of a tree
        x = y = group.reach_below(subject.top_m)
    start = -sign * (float(subject.half[0]) - own[0])
    aside = start - sign * max(float(x - 1.5 * own[0]), 0.0)
    return Goal(_shift(_on_ground(subject, height), aside, -float(y + own[1]) - _CLEAR_M), _FIXED)


def _look_past(rear: ObjectGroup, near: Float64Array, apart_m: float) -> float:
    """Metres to the right at which what stands behind is seen past the edge of what is before it.

    0 where enough of it is seen above and beside. `near` are the half extents [3] of what is
    before it, m, `apart_m` the way from one middle to the other.
    """
    covered = np.minimum(1.0, near / rear.half_at_rest())
    if covered[0] * covered[2] <= _COVERED:
        return 0.0
    return float(near[0] + (apart_m + near[1]) * _ASIDE_RAD)


def _on_ground(group: ObjectGroup, height: float) -> Float64Array:
    return np.array([group.centre[0], group.centre[1], height])


def _shift(place: Float64Array, x: float, y: float) -> Float64Array:
    return np.asarray(place + np.array([x, y, 0.0]))


def place_at_distance(
    goal: Goal, group: ObjectGroup, relation: IndexedRelation, other: ObjectGroup, sign: float
) -> Goal:
    """The goal of a group at the distance of the relation to another one, if it has one.

    `sign` is 1 for the goal of the relation's subject, -1 for that of a target.
    """
    if relation.distance_m is None:
        return goal
    place = other.begin + sign * relation.distance_m * np.array(SIDES[relation.kind])
    group.begins = place
    return Goal(np.array([*place, goal.position[2]]), _FIXED)


_OBLIQUE = 0.3
"""Cosine of the angle from which on a body looks to a side of the picture."""


def rest_on(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """[3] the middle of a group that is put on the supporting surface of another object, m.

    People who sit or lie take that posture and the target's heading; a target that moves carries
    the group along. `neighbours` are the indices of all objects on the target, one for each copy.
    """
    kind, is_person = group.plan.motion.kind, group.noun.name in PERSON_NOUNS
    if (on_face := _rest_on_face(group, target, neighbours)) is not None:
        return on_face
    if target.takes_along:
        group.carrier = target
    if is_person and _sits(group, target):
        return _seat_on(group, target, neighbours)
    if trait_value("slope", target.noun.name) and group.plan.is_path:
        go_down(group, target)
        return target.to_world(0.0, 0.0, group.origin_m)
    support = find_support(target.models[0])
    is_free = group.plan.is_path or not hides_riders(target.noun)
    if not is_free and _find_room(group, target, support, 1) != support.middle:
        support = find_support(target.models[0], _ROOF * target.models[0].height)
    line_up(group, target, support, neighbours)
    if is_leap(group):
        has_hollow = trait_value("container", target.noun.name) is not None
        leap_up(group, target, support.height, target.models[0].height if has_hollow else None)
    if kind == "stand":
        carry_along(group, target, support)
    elif group.plan.is_path and not target.is_going:
        stop_at_edge(group, target, support)
    _turn_along(group, target, support)
    group.fit()
    count = len(group.models)
    x, y = support.middle if group.plan.is_path else _find_room(group, target, support, count)
    return target.to_world(x, y, support.height + group.origin_m)


def _find_room(
    group: ObjectGroup, target: ObjectGroup, support: Support, count: int
) -> tuple[float, float]:
    """Place of the first of a group on a support, before what rises there for the camera, m."""
    back = turn_about("z", -target.plan.yaw)
    rest, turn = Pose(0.0, 0.0, 0.0, "stand"), turn_about("z", group.plan.yaw)
    offsets = group.offsets if count > 1 else [(0.0, 0.0, 0.0)]
    parts = [
        each for model, offset in zip(group.models, offsets, strict=False)
        for each in moved(moved(moved(model.parts(rest), turn), shift(*offset)), back)
    ]  # fmt: skip
    x, y, _ = back[:, :3] @ -_AWAY
    return find_room(parts, target.models[0], support, (float(x), float(y)))


def _turn_along(group: ObjectGroup, target: ObjectGroup, support: Support) -> None:
    """Turn who lies, stands or goes on something along it."""
    kind, is_way = group.plan.motion.kind, target.noun.name in nouns_with("way")
    if group.noun.name in PERSON_NOUNS and kind in ("lie", "stand"):
        body = target.models[0]
        is_across = kind == "lie" and body.width > body.length
        yaw = target.plan.yaw + 0.5 * math.pi * is_across
        group.plan = replace(group.plan, yaw=yaw, gesture=kind)
    elif group.plan.is_path and target.noun.name in nouns_with("has approaches"):
        lead_over(group, target, support)
    elif zone_of(group.noun) == "road" and is_way:
        group.plan = replace(group.plan, yaw=target.plan.yaw)  # along a bridge, parked too


def _rest_on_face(
    group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]
) -> Float64Array | None:
    """The middle of what hangs on a wall, or is drawn on a shape, m; None: it rests on a top."""
    if hangs_on(group.noun.name, target.noun.name):
        return _hang_on(group, target, neighbours)
    is_mark = {group.noun.name, target.noun.name} <= nouns_with("flat pattern")
    return _put_on_face(group, target) if is_mark else None


def _put_on_face(group: ObjectGroup, target: ObjectGroup) -> Float64Array:
    """The middle of a shape before another one, off its middle where that turns, m.

    What circles there goes round with it.
    """
    own, face = group.models[0], target.models[0]
    turns = target.plan.motion.kind == "spin"
    if target.takes_along:
        group.carrier = target
    group.fit()
    up_m = 0.5 * (face.height - own.height) + _OFF_MIDDLE * face.height * turns
    return target.to_world(0.5 * (face.length + own.length) + _FACE_GAP_M, 0.0, up_m)


def _hang_on(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """The middle of what hangs on the face of a wall that is turned to the camera, m."""
    own, wall = group.models[0], target.models[0]
    face_m = float(bounds(wall.parts(Pose(0.0, 0.0, 0.0, "stand"))[:1])[1][0])
    support = Support(0.0, (0.0, -0.45 * wall.width), (0.0, 0.45 * wall.width))
    line_up(group, target, support, neighbours)
    group.bearer = None  # it hangs before the face
    group.plan = replace(group.plan, yaw=target.plan.yaw)
    group.fit()
    low_m = max(_HUNG * wall.height - 0.5 * own.height, 0.02 * wall.height)
    if group.plan.motion.kind == "fall":  # to the foot of the wall
        group.plan = replace(group.plan, start_m=low_m)
        low_m = 0.0
    return target.to_world(face_m + 0.5 * own.length, 0.0, low_m + group.origin_m)


def _sits(group: ObjectGroup, target: ObjectGroup) -> bool:
    """Whether a person sits there: on a seat, unless the scene has them stand, lie or jump."""
    kind = group.plan.motion.kind
    may_sit = kind in DONE_SEATED or group.scene_object.motion is None
    is_seated = kind in ("sit", "drive", "sail", *TO_AND_FROM_SEATS)
    return is_seated or (may_sit and target.noun.name in nouns_with("seat"))


def _seat_on(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """People on a seat."""
    scale = size_of(group.models[0])
    is_seat = target.noun.name in nouns_with("seat")
    seat_m = SEAT * size_of(target.models[0])
    support = find_support(target.models[0], near_m=seat_m if is_seat else None)
    line_up(group, target, support, neighbours)
    x, y = support.middle
    if support.high[0] > support.low[0] and target.noun.name not in nouns_with("sat on"):
        x = max(x, support.high[0] - _FRONT_M * scale)
    kind = group.plan.motion.kind
    done = {one.kind for one in group.scene_object.motions} & DONE_SEATED
    doing = SEATED + min(done) if done else "sit"
    doing = kind if kind in TO_AND_FROM_SEATS else doing
    group.plan = replace(group.plan, yaw=target.plan.yaw, gesture=doing)
    if done:
        group.plan = replace(group.plan, path=None)
    group.fit()
    return target.to_world(x, y, support.height - SEAT * scale)


def rest_in(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """As `rest_on`, in a container so that its top looks out, and unseen in what is closed."""
    open_below = nouns_with("passage") | nouns_with("stood in")
    if target.noun.name in nouns_with("closed") | open_below:
        if target.takes_along:
            group.carrier = target
        low = 0.05 * target.models[0].height if target.noun.name in nouns_with("closed") else 0.0
        return target.to_world(0.0, 0.0, low + group.origin_m)
    is_person = group.noun.name in PERSON_NOUNS
    is_within = not is_person or target.noun.name in nouns_with("see-through")
    if trait_value("container", target.noun.name) and is_within:
        return _put_in(group, target, neighbours)
    place = rest_on(group, target, neighbours)
    if is_person or target.noun.habitat == "ground":
        return place
    low = depth_in(group, target)
    return np.array([place[0], place[1], target.centre[2] + low + group.origin_m])


def _put_in(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """The middle of a group in a container, where what goes somewhere goes to and fro."""
    support = hollow_of(target)
    if target.takes_along:
        group.carrier = target
    reach_m = reach_of(group.models[0], len(neighbours))
    line_up(group, target, support, neighbours, reach_m)
    if len(neighbours) > 1:  # side by side in their row
        is_wide = target.models[0].width > target.models[0].length
        is_long = group.models[0].length > reach_m
        turns = is_wide + is_long
        group.plan = replace(group.plan, yaw=target.plan.yaw + 0.5 * math.pi * turns)
    is_circling = group.plan.motion.kind == "orbit" and group.noun.habitat == "water"
    if is_leap(group) and group.carrier is None:
        leap_up(group, target, depth_in(group, target), target.models[0].height)
    elif (group.plan.is_path or is_circling) and group.carrier is None:
        go_inside(group, target, support)
    group.fit()
    return target.to_world(*support.middle, depth_in(group, target) + group.origin_m)


def place_at(group: ObjectGroup, target: ObjectGroup, neighbours: Sequence[int]) -> Float64Array:
    """As `rest_on`, around a thing and turned to it, the camera's side last.

    People sit on chairs at a table unless what they do is done standing; at a piano at its keys.
    """
    kinds = {one.kind for one in group.scene_object.motions}
    scale = size_of(group.models[0])
    is_person = group.noun.name in PERSON_NOUNS
    may_sit = is_person and target.noun.name in nouns_with("table")
    group.on_chairs = may_sit and (not kinds or bool(kinds & {"sit", "sit down", *DONE_SEATED}))
    reach = (_SEATED_M if group.on_chairs else STANDING_M) * scale
    wide, deep, _ = target.half_at_rest() + reach
    places = list_around(len(neighbours), float(wide), float(deep))
    first = neighbours.index(group.index)
    chosen = [places[(first + number) % len(places)] for number in range(len(group.models))]
    if target.noun.name in nouns_with("played from the front"):
        yaw, far = target.plan.yaw, 0.5 * target.models[0].length + reach
        chosen = [(far * math.cos(yaw), far * math.sin(yaw), yaw + math.pi)]
    lift = SEAT * (1.0 - min(scale, 1.0)) if group.on_chairs else 0.0
    group.offsets = [(x, y, lift) for x, y, _ in chosen]
    group.yaws = [yaw for _, _, yaw in chosen]
    if group.on_chairs:
        done = sorted(kinds & DONE_SEATED)
        group.plan = replace(group.plan, gesture=SEATED + done[0] if done else "sit", path=None)
    group.fit()
    return np.array([target.centre[0], target.centre[1], group.origin_m])
