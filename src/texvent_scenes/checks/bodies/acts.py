"""Act check: motions and activities that are claimed of bodies or of the camera, over the clip."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent_scenes.checks.clip.staged_clip import StagedClip, is_inside
from texvent_scenes.description import Claim
from texvent_scenes.models.activities import (
    ACTIVITIES,
    ANIMAL_ACTIVITIES,
    PERSON_NOUNS,
    SAT,
    TIMED,
    TRAVELLING,
)
from texvent_scenes.models.tables import trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.surroundings.environment import is_afloat
from texvent_scenes.staging.tracks.phases import YAWS

_OUT, _BACK, _STILL = 0.6, 0.3, 1e-3
"""Shares of the greatest departure from the first pose at which a repetition is begun and done;
departure below which a body does not move, in its sizes."""
_GROUNDED = 0.1
"""Height, in sizes of a body, up to which it is on the ground."""
_MEETINGS, _JUST_S = 97, 1e-3
"""Instants at which it may come down on that; time before it breaks at which it is whole, s."""
_NEAR_END, _RESTING = 3.0, 0.15
"""Gap before what something stops for, in its lengths; speed at the end, as a share of the mean."""
_HANDS, _REACH = ("left hand", "right hand"), 0.12
"""Places that act on things; from there to what is acted upon, in sizes of the body."""
_BEGUN, _SLOWER = 0.1, 0.4
"""Share of the clip at the beginning in which what begins later hardly moves; most speed then, as a
share of the greatest."""
_SEEN = 0.9
"""Share of the clip after which what breaks leaves no time to see its pieces."""
_BESIDE = 0.2
"""Least length of what something goes along, as a share of its way."""
_ASIDE = 0.5
"""Most share of a way, along the heading, of what goes sideways."""
_CHANGED, _INSTANT_S, _EDGE_S = 0.2, 1e-3, 0.05
"""Least change of a rate of turning, as a share of it; time over which one is taken, and from the
ends of the clip, s."""
_TURNED = 0.7
"""Least angle of a turn, and most angle from where what turns heads then, rad."""
_UPRIGHT, _MET = 0.7, 0.6
"""Cosine of the greatest angle at which a body still stands; distance of bodies that meet, in the
sum of their sizes."""
_STILL_M, _ROUND, _LEAST_ARC = 1e-3, 0.08, math.pi / 3.0
"""Extent of a way that goes nowhere, m; most departure of a way from its circle, in radii; least
angle of that circle that it covers."""

_WALLS = 0.3
"""Least share of the image that shows the walls of what a camera is in."""


def stops_before(staged: StagedClip, claim: Claim) -> bool:
    """Whether it comes to rest on its way, before what it stops for."""
    for one in staged.own_boxes(claim):
        steps = np.linalg.norm(np.diff(one.middle, axis=0), axis=1)
        way = one.middle[-1] - one.middle[0]
        length = float(np.linalg.norm(way))
        if steps[-1] > _RESTING * steps.mean() or length <= _STILL:
            return False
        for other in (body for target in claim.targets for body in staged.boxes[target]):
            off = other.middle[-1] - one.middle[-1]
            ahead = float(off @ way) / length
            aside = float(np.linalg.norm((off - ahead * way / length)[:2]))
            room = one.size[-1].max()
            if not (0.0 < ahead <= _NEAR_END * room and aside <= room):
                return False
    return True


def _count(staged: StagedClip, actor: Actor) -> float:
    """Times that it leaves its first pose and comes back to it; half a time: it is not back."""
    departure, count, is_out = staged.departure(actor), 0.0, False
    most = float(departure.max())
    if most <= _STILL * actor.size_m:
        return 0.0
    for one in departure / most:
        if not is_out and one >= _OUT:
            count, is_out = count + 0.5, True
        elif is_out and one <= _BACK:
            count, is_out = count + 0.5, False
    return count


def repeats(staged: StagedClip, claim: Claim) -> bool:
    """Whether it comes back to its first pose so often, or rests after so many repetitions."""
    said = () if claim.subject is None else staged.description.objects[claim.subject].motions
    rate_hz = ACTIVITIES[said[0].kind].repeats_hz if said and said[0].kind in ACTIVITIES else 0.0
    if rate_hz and len(said) == 2 and said[1].start_s is not None:
        counted = said[1].start_s * rate_hz * said[0].pace
        return said[1].start_s <= staged.duration_s and abs(counted - float(claim.value)) < 0.01
    return all(_count(staged, one) == claim.value for one in staged.own(claim))


def returns(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is again as it was: at the end, or several times."""
    counts = [_count(staged, one) for one in staged.own(claim)]
    return all(one >= 1.0 and (one.is_integer() or one > 2.0) for one in counts)


def is_circling(staged: StagedClip, claim: Claim) -> bool:
    """Whether a body or the camera goes along a circle."""
    if claim.subject is None:
        ways = [np.array([staged.scene.camera(one).position[:2] for one in staged.times])]
    else:
        ways = [one.middle[:, :2] for one in staged.own_boxes(claim)]
    return all(map(is_arc, ways))


def is_arc(way: Float64Array) -> bool:
    """Whether a way on the ground, [t, 2] m, lies on a circle, and covers enough of it."""
    if np.ptp(way, axis=0).max() < _STILL_M:
        return False
    terms = np.column_stack([2.0 * way, np.ones(len(way))])
    x, y, rest = np.linalg.lstsq(terms, (way**2).sum(axis=1), rcond=None)[0]
    radius = math.sqrt(max(rest + x * x + y * y, 0.0))
    off = way - [x, y]
    angles = np.unwrap(np.arctan2(off[:, 1], off[:, 0]))
    strays = np.abs(np.linalg.norm(off, axis=1) - radius).max()
    return bool(strays <= _ROUND * radius and np.ptp(angles) >= _LEAST_ARC)


def swings(staged: StagedClip, claim: Claim) -> bool:
    """Whether the part that moves most turns back on its way."""
    for one in staged.own(claim):
        steps = np.diff(staged.places(one), axis=0)
        most = steps[:, np.linalg.norm(steps, axis=2).sum(axis=0).argmax()]
        if not (most[1:] * most[:-1]).sum(axis=1).min() < 0.0:
            return False
    return True


def rises_from(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is on the ground of a place at first, and above it later."""
    return all(
        one.lowest_m(0.0) <= _GROUNDED * one.size_m < max(map(one.lowest_m, staged.times))
        for one in staged.own(claim)
    )


def stops(staged: StagedClip, claim: Claim) -> bool:
    """Whether it goes at first, and rests at the end."""
    for one in staged.own_boxes(claim):
        steps = np.linalg.norm(np.diff(one.middle, axis=0), axis=1)
        if steps[-1] > _RESTING * steps.mean() or steps.max() <= _STILL * one.size.max():
            return False
    return True


def begins(staged: StagedClip, claim: Claim) -> bool:
    """Whether its parts hardly move or turn at first, and do later: "starts to spin"."""
    edge = max(int(_BEGUN * len(staged.fine_times)), 1)
    for one in staged.own(claim):
        at = [one.place(time_s) for time_s in staged.fine_times]
        parts = np.array([[each.to_world[:, :3] @ part.to_body for part in each.parts]
                          for each in at])  # fmt: skip
        parts[..., 3] += np.array([each.to_world[:, 3] for each in at])[:, None]
        steps = np.abs(np.diff(parts, axis=0)).max(axis=(1, 2, 3))
        if steps[:edge].max() >= _SLOWER * steps.max():
            return False
    return True


def lands(staged: StagedClip, claim: Claim) -> bool:
    """Whether it comes to the ground of a place, or onto another body."""
    heights = [[one.lowest_m(time_s) for time_s in staged.times] for one in staged.own(claim)]
    if all(min(each) <= _GROUNDED * one.size_m
           for one, each in zip(staged.own(claim), heights, strict=True)):  # fmt: skip
        return True
    low = int(np.argmin(heights[0]))
    others = [n for n, own in enumerate(staged.boxes) if own and n != claim.subject]
    return any(staged.relates(replace(claim, targets=(one,)), "on", slice(low, low + 1))
               for one in others)  # fmt: skip


def goes_along(staged: StagedClip, claim: Claim) -> bool:
    """Whether a good part of its way is beside a body, or a row: a short fence is only passed."""
    ends = np.array([end for n in claim.targets for one in staged.boxes[n]
                     for end in (one.middle[0] - 0.5 * one.size[0],
                                 one.middle[0] + 0.5 * one.size[0])])  # fmt: skip
    beside_m = float(np.ptp(ends[:, :2], axis=0).max()) if len(ends) else 0.0
    ways = [one.middle[-1] - one.middle[0] for one in staged.own_boxes(claim)]
    return all(beside_m >= _BESIDE * np.linalg.norm(way) for way in ways)


def goes_aside(staged: StagedClip, claim: Claim) -> bool:
    """Whether it goes another way than it faces: "sideways"."""
    for one in staged.own_boxes(claim):
        steps = np.diff(one.middle[:, :2], axis=0)
        ahead = np.abs((steps * one.ahead[:-1]).sum(axis=1)).sum()
        if ahead > _ASIDE * np.linalg.norm(steps, axis=1).sum():
            return False
    return True


def descends(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is lower at some instant than before: what dives."""
    heights = [one.middle[:, 2] for one in staged.own_boxes(claim)]
    depths = [float((np.maximum.accumulate(each) - each).max()) for each in heights]
    return all(one > 0.1 * body.size_m for one, body in zip(depths, staged.own(claim), strict=True))


def keeps_to_ground(staged: StagedClip, claim: Claim) -> bool:
    """Whether it goes on the ground, or on another body, or in the air, for a part of the clip.

    Of what goes up something, that relation tells.
    """
    own, others = staged.own(claim), [one for one in staged.scene.actors]
    objects = staged.description.objects
    climbs = any(one.subject == claim.subject and (one.kind in ("up", "down") or (
        one.kind == "on" and trait_value("slope", objects[one.targets[0]].noun) is not None))
        for one in staged.description.relations)  # fmt: skip
    for one in () if climbs else own:
        if not claim.value and is_afloat(one):
            continue
        low = np.array([one.lowest_m(time_s) for time_s in staged.times])
        gaps = np.abs(low)
        places = np.array([one.middle(time_s)[:2] for time_s in staged.times])
        for box in (each.corners(0.0) for each in others if each not in own):
            room = 0.5 * one.size_m
            is_by = (places > box.min(axis=0)[:2] - room) & (places < box.max(axis=0)[:2] + room)
            over = np.where(is_by.all(axis=1), np.abs(low - float(box[:, 2].max())), np.inf)
            gaps = np.minimum(gaps, over)
        is_near = gaps <= _GROUNDED * one.size_m
        if not (is_near.mean() >= 0.5 if claim.value else not is_near.all()):
            return False
    return True


def meets_ground(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is on the ground for half of the clip, or comes down on it at some instant."""
    for one in staged.own(claim):
        end_s = staged.duration_s if one.breaks_s is None else one.breaks_s - _JUST_S
        low = np.array([one.lowest_m(time_s) for time_s in np.linspace(0.0, end_s, _MEETINGS)])
        is_low = np.abs(low) <= _GROUNDED * one.size_m
        if not (is_low.mean() >= 0.5 or (is_low.any() and not is_low[0])):
            return False
    return True


def stays(staged: StagedClip, claim: Claim) -> bool:
    """Whether its middle stays where it is, by a part of its own size."""
    return all(
        float(np.ptp(one.middle[:, :2], axis=0).max()) <= _GROUNDED * float(one.size.max())
        for one in staged.own_boxes(claim)
    )


def goes_back(staged: StagedClip, claim: Claim) -> bool:
    """Whether it goes against its heading; of one motion, all the time that it goes."""
    said = () if claim.subject is None else staged.description.objects[claim.subject].motions
    for one in staged.own_boxes(claim):
        ahead = (np.diff(one.middle[:, :2], axis=0) * one.ahead[:-1]).sum(axis=1)
        least = _STILL * one.size.max()
        if ahead.min() >= -least or (len(said) < 2 and ahead.max() > least):
            return False
    return True


def handles(staged: StagedClip, claim: Claim) -> bool:
    """Whether a hand or a mouth reaches what an act is done to, and a limb moves as it does so."""
    targets = [one for n in claim.targets for one in staged.list_actors(n)]
    for one in staged.own(claim):
        places = _HANDS if one.noun.name in PERSON_NOUNS else ("mouth", "right foot", "left foot")
        room = _REACH * one.size_m
        ends = {name: np.array([one.anchor(name, at)[:, 3] for at in staged.times])
                for name in places}  # fmt: skip
        gaps = []
        for other in targets:
            boxes = [other.corners(at) for at in staged.times]
            low, high = (np.array([getattr(each, way)(axis=0) for each in boxes])
                         for way in ("min", "max"))  # fmt: skip
            gaps += [np.linalg.norm(each - np.clip(each, low, high), axis=1).min()
                     for each in ends.values()]  # fmt: skip
        if not gaps or min(gaps) > room or staged.departure(one).max() <= _STILL * one.size_m:
            return False
    return True


def has_in_mouth(staged: StagedClip, claim: Claim) -> bool:
    """Whether an animal has what it holds at its mouth all the time."""
    said = staged.description.relations
    held = [n for one in said if (one.kind, one.subject) == ("hold", claim.subject)
            for n in one.targets]  # fmt: skip
    things = [one for n in held for one in staged.list_actors(n)]
    return bool(things) and all(
        any(np.linalg.norm(one.anchor("mouth", at)[:, 3] - each.middle(at)) <= each.size_m
            for each in things)
        for one in staged.own(claim) for at in staged.times
    )  # fmt: skip


def is_laid(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is no higher than long at the end: a glass that lies."""
    sizes = [one.size[-1] for one in staged.own_boxes(claim)]
    return all(each[2] < max(each[:2]) for each in sizes)


def moves(staged: StagedClip, claim: Claim) -> bool:
    """Whether it leaves its place, or is on foot where it is; parts of machines move."""
    for one in staged.own(claim):
        is_fixed = one.noun.is_working and one.noun.speed_m_s == 0.0
        if is_fixed and staged.departure(one).max() > _GROUNDED * one.size_m:
            continue
        places = np.array([one.middle(at) for at in staged.fine_times])
        does = {one.track.at(at).activity.split()[0] for at in staged.times}
        if np.ptp(places, axis=0).max() < _GROUNDED * one.size_m and not does & TRAVELLING:
            return False
    return True


def changes_pace(staged: StagedClip, claim: Claim) -> bool:
    """Whether it, or its parts, turn faster or slower at the end than at first."""
    for one in staged.own(claim):
        first = _turning_rate(one, staged.times[0] + _EDGE_S)
        last = _turning_rate(one, staged.times[-1] - _EDGE_S)
        if abs(last - first) <= _CHANGED * max(first, last):
            return False
    return True


def _turning_rate(one: Actor, time_s: float) -> float:
    """Rate at which a body turns, rad/s; of a machine that stays, the tempo of its parts."""
    if one.noun.is_working:
        return (one.pose(time_s + _INSTANT_S).time_s - one.pose(time_s).time_s) / _INSTANT_S
    first, second = (one.track.at(time_s + late).to_world()[:, :3] for late in (0.0, _INSTANT_S))
    cosine = 0.5 * (float(np.trace(first.T @ second)) - 1.0)
    return math.acos(min(max(cosine, -1.0), 1.0)) / _INSTANT_S


def turns(staged: StagedClip, claim: Claim) -> bool:
    """Whether it heads another way at some instant; to the camera or away from it, at the end.

    Machines turn by themselves.
    """
    said = () if claim.subject is None else staged.description.objects[claim.subject].motions
    goals = [YAWS[str(one.direction)] for one in said
             if one.kind == "turn" and one.direction in ("towards", "away")]  # fmt: skip
    for one in (each for each in staged.own(claim) if not each.noun.is_working):
        yaws = np.unwrap(np.array([one.track.at(at).yaw for at in staged.times]))
        off = [abs(math.remainder(float(yaws[-1]) - goal, math.tau)) for goal in goals]
        if float(np.ptp(yaws)) < _TURNED or max(off, default=0.0) > _TURNED:
            return False
    return True


def tips(staged: StagedClip, claim: Claim) -> bool:
    """Whether each thing stands at first and lies at the end, and who does it comes up to it."""
    fallen = [one for n in claim.targets for one in staged.list_actors(n)]
    up = np.array([[one.track.at(at).to_world()[2, 2] for at in (0.0, staged.duration_s)]
                   for one in fallen])  # fmt: skip
    pairs = [(one, other) for one in staged.own(claim) for other in fallen]
    gaps = [np.linalg.norm(one.middle(at) - other.middle(at)) / (one.size_m + other.size_m)
            for one, other in pairs for at in staged.fine_times]  # fmt: skip
    is_fallen = (up[:, 0] > _UPRIGHT).all() and (up[:, 1] < 1.0 - _UPRIGHT).all()
    return bool(is_fallen and min(gaps, default=math.inf) <= _MET)


def bounces(staged: StagedClip, claim: Claim) -> bool:
    """Whether it comes down in the image, to the ground or onto something, and then up again."""
    for one in staged.own(claim):
        found = [one.lowest_m(at) for at in staged.fine_times if staged.has_in_image(one, at)]
        height = np.array(found or [0.0])
        is_held = any(each.kind in ("throw", "catch") and one.object_index in each.targets
                      for each in staged.description.relations)  # fmt: skip
        if is_held and height.min() > _GROUNDED * one.size_m:
            return False
        lowest = np.minimum.accumulate(height)
        fallen = np.maximum.accumulate(height) - lowest
        if np.minimum(height - lowest, fallen).max() < _GROUNDED * one.size_m:
            return False
    return True


def passes_mouth(staged: StagedClip, claim: Claim) -> bool:
    """Whether the camera goes "into" or "out of" something, whose walls it sees from within."""
    bodies = [one for n in claim.targets for one in staged.list_actors(n)]
    ends = [[is_inside(one, staged.scene.camera(at).position, at) for one in bodies]
            for at in (0.0, staged.duration_s)]  # fmt: skip
    within, without = ends[::-1] if claim.value == "into" else ends
    at_s = staged.duration_s if claim.value == "into" else 0.0
    walls = staged.share_of({one.instance for one in bodies}, at_s)
    return any(within) and not any(without) and walls >= _WALLS


def breaks(staged: StagedClip, claim: Claim) -> bool:
    """Whether it goes to pieces in the image, within the clip."""
    return all(
        one.breaks_s is not None and one.breaks_s < _SEEN * staged.duration_s
        and staged.has_in_image(one, one.breaks_s)
        for one in staged.own(claim)
    )  # fmt: skip


def falls(staged: StagedClip, claim: Claim) -> bool:
    """Whether it comes down by its size from where it is at first, its highest place."""
    for one in staged.own(claim):
        height = [one.lowest_m(at) for at in staged.fine_times]
        if height[0] < max(height) - 1e-6 or height[0] - min(height) < one.size_m:
            return False
    return True


def is_doing(staged: StagedClip, claim: Claim) -> bool:
    """Whether a person, a hand or an animal does it at some instant.

    Who sits down, sits; it may be done seated ("sit and read"); what jumps leaves the ground; what
    opens and closes is closed again; what switches is in another state before.
    """
    first, own = str(claim.value).split()[0], staged.own(claim)
    does = [{part for time_s in staged.times
             for part in one.track.at(time_s).activity.split(" and ")} for one in own]  # fmt: skip
    done = [
        {part.split()[0] for part in each} | ({"sit"} if each & SAT else set()) for each in does
    ]
    act = ANIMAL_ACTIVITIES.get(str(claim.value))
    if act is not None and act.to_state and all(len(each) > 1 for each in does):
        return all(act.to_state in each for each in does)
    is_up = first == "jump" and all(
        max(map(one.lowest_m, staged.times)) > _GROUNDED * one.size_m for one in own
    )
    is_to_and_fro = claim.value in TIMED and " and " in str(claim.value)
    if is_to_and_fro and not all(_count(staged, one) >= 1.0 for one in own):
        return False
    is_on_foot = first in ("walk", "run")  # in circles too
    return is_up or all(first in each or (is_on_foot and "move" in each) for each in done)
