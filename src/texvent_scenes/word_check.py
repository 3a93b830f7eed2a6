"""Word check: words that are shown only if the staged scene holds what they claim.

A reader that places nothing by a word, or that cannot know whether what it says comes about, leaves
a `Claim`. Boxes, parts and places of the bodies over the clip decide.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from texvent.camera import project
from texvent.sensor import SensorSize
from texvent_scenes.body_boxes import BodyBoxes, body_of
from texvent_scenes.description import SEEN, Claim, IndexedRelation, SceneDescription
from texvent_scenes.models.activities import ACTIVITIES
from texvent_scenes.part_check import (
    Place,
    has_colour,
    is_blinking,
    is_lit_in,
    is_moving_inside,
    is_of_material,
)
from texvent_scenes.relation_check import find_violations
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.rows_and_arcs import is_arc, is_in_line
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene
from texvent_scenes.staging.surroundings.environment import RoadLine

_INSTANTS, _PER_S, _MOST = 9, 24.0, 1000
"""Instants at which bodies are compared; per second and at most, those that count repetitions."""
_LEAST_CLIP_S = 1.0
_DONE = ("bounce", "ground", "activity", "stop before", "stop", "land", "descend")
"""Length of a clip in which motions get so far that they are judged, s; claims of read motions."""
_OF_CAMERA = (SEEN, "circle")
"""Claims that may be made of the camera."""
_OUT, _BACK, _STILL = 0.6, 0.3, 1e-3
"""Shares of the greatest departure from the first pose at which a repetition is begun and done;
departure below which a body does not move, in its sizes."""
_MOSTLY = 0.75
"""Share of the clip in which what swims is in the water."""
_GROUNDED = 0.1
"""Height, in sizes of a body, up to which it is on the ground."""
_NEAR_END, _RESTING = 3.0, 0.15
"""Gap before what something stops for, in its lengths; speed at the end, as a share of the mean."""


def find_held(
    claims: Sequence[Claim],
    scene: ComposedScene,
    description: SceneDescription,
    gone: frozenset[int],
    size: SensorSize,
    duration_s: float,
) -> tuple[frozenset[str], frozenset[str]]:
    """Words of which all that is claimed holds, and the others.

    Args:
        claims: what is claimed of words.
        scene: the staged scene.
        description: the scene before it was staged.
        gone: indices of objects that are out of view.
        size: of the image, pixels.
        duration_s: length of the clip, s.
    """
    staged, failed = _Staged(scene, description, size, duration_s), set[str]()
    if duration_s < _LEAST_CLIP_S:
        claims = [one for one in claims if one.kind not in _DONE]
    for one in claims:
        about = [*([] if one.subject is None else [one.subject]), *one.targets]
        is_seen = gone.isdisjoint(about) and scene.missing.isdisjoint(one.targets)
        is_seen &= one.kind == SEEN or all(map(staged.list_actors, about))  # a coat has no body
        is_seen &= bool(about) or one.kind in _OF_CAMERA
        if not (is_seen and CHECKS[one.kind](staged, one)):
            failed.add(one.word)
    return frozenset({one.word for one in claims if one.is_open} - failed), frozenset(failed)


@dataclass(frozen=True)
class _Staged:
    """A staged scene over its clip."""

    scene: ComposedScene
    description: SceneDescription
    size: SensorSize
    duration_s: float

    @cached_property
    def times(self) -> list[float]:
        """Instants, s."""
        return [float(one) for one in np.linspace(0.0, self.duration_s, _INSTANTS)]

    @cached_property
    def boxes(self) -> list[list[BodyBoxes]]:
        """Boxes of the copies of each object."""
        cameras = [self.scene.camera(one) for one in self.times]
        return [[body_of(one, cameras, self.times) for one in self.list_actors(index)]
                for index in range(len(self.description.objects))]  # fmt: skip

    def list_actors(self, index: int) -> list[Actor]:
        """Copies of an object."""
        return [one for one in self.scene.actors if one.object_index == index]

    @cached_property
    def fine_times(self) -> list[float]:
        """Instants at which repetitions are counted, s."""
        count = min(max(int(self.duration_s * _PER_S), 2), _MOST) + 1
        return [float(one) for one in np.linspace(0.0, self.duration_s, count)]

    def own(self, claim: Claim) -> list[Actor]:
        """Copies of the object of which something is claimed."""
        return [] if claim.subject is None else self.list_actors(claim.subject)

    def own_boxes(self, claim: Claim) -> list[BodyBoxes]:
        """Boxes of those copies."""
        return [] if claim.subject is None else self.boxes[claim.subject]

    def has_in_image(self, actor: Actor, time_s: float) -> bool:
        """Whether a part of a body is neither left nor right of the image."""
        x = project(self.scene.camera(time_s), self.size, actor.corners(time_s))[:, 0]
        return bool(((x >= 0.0) & (x <= self.size.width)).any())

    def places(self, actor: Actor) -> Float64Array:
        """[t, n, 3] Places of its parts, beside its own place on the ground, m."""
        at = [actor.place(one) for one in self.fine_times]
        places = np.array([[part.to_body[:, 3] for part in one.parts] for one in at])
        world = [one.to_world for one in at]
        moved = np.array([each @ one[:, :3].T + one[:, 3]
                          for each, one in zip(places, world, strict=True)])  # fmt: skip
        moved -= np.array([[one.to_world[0, 3], one.to_world[1, 3], 0.0] for one in at])[:, None]
        return moved

    def departure(self, actor: Actor) -> Float64Array:
        """[t] Departure of its parts from where they are at first, the greatest of all, m."""
        moved = self.places(actor)
        return np.asarray(np.linalg.norm(moved - moved[0], axis=2).max(axis=1))


def _of_parts(
    check: Callable[[Sequence[Actor], Claim, Sequence[float], Place], bool],
) -> Callable[[_Staged, Claim], bool]:
    """A check of the parts of bodies, at the instants of the clip."""
    return lambda staged, claim: check(
        staged.own(claim), claim, staged.fine_times, staged.scene.lamps.place
    )


def _is_related(staged: _Staged, claim: Claim) -> bool:
    """Whether a relation that nothing placed holds all the same."""
    return _relates(staged, claim, str(claim.value))


def _relates(staged: _Staged, claim: Claim, kind: str, when: slice = slice(None)) -> bool:
    about = [] if claim.subject is None else [claim.subject, *claim.targets]
    return bool(about) and _holds(staged, kind, about, [
        [BodyBoxes(one.middle[when], one.size[when], one.seen[when], one.displacement, one.parts)
         for one in staged.boxes[index]]
        for index in about
    ])  # fmt: skip


def _holds(
    staged: _Staged, kind: str, about: Sequence[int], copies: Sequence[Sequence[BodyBoxes]]
) -> bool:
    """Whether the first bodies are so to the others, which are copies of these objects."""
    objects = tuple(staged.description.objects[index] for index in about)
    relation = IndexedRelation(kind, 0, tuple(range(1, len(copies))))
    apart = replace(staged.description, objects=objects, relations=(relation,))
    return not any(one.kind == "relation" for one in find_violations(apart, copies))


def _are_mutual(staged: _Staged, claim: Claim) -> bool:
    """Whether two bodies are so to each other."""
    objects = staged.description.objects
    nouns = {objects[one].noun for one in (claim.subject, *claim.targets) if one is not None}
    about = [n for n, one in enumerate(objects) if one.noun in nouns]  # halves of a group too
    bodies = [(index, one) for index in dict.fromkeys(about) for one in staged.boxes[index]]
    if claim.value == "towards":  # they may pass each other afterwards
        gaps = (np.linalg.norm(one.middle - other.middle, axis=1)
                for (_, one), (_, other) in itertools.combinations(bodies, 2))  # fmt: skip
        return any(gap.min() <= 0.5 * gap[0] for gap in gaps)
    return any(
        _holds(staged, str(claim.value), (first, second), [[one], [other]])
        and _holds(staged, str(claim.value), (second, first), [[other], [one]])
        for (first, one), (second, other) in itertools.combinations(bodies, 2)
    )


def _leaves(staged: _Staged, claim: Claim) -> bool:
    """Whether it is on something at first and no more at the end: "off"."""
    first, last = (_relates(staged, claim, "on", when) for when in (slice(1), slice(-1, None)))
    return first and not last


def _arrives(staged: _Staged, claim: Claim) -> bool:
    """Whether it is in or on something at the end and was not at first: "into", "onto"."""
    kind = str(claim.value)
    first, last = (_relates(staged, claim, kind, when) for when in (slice(1), slice(-1, None)))
    return last and not first


def _stops_before(staged: _Staged, claim: Claim) -> bool:
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


def _is_row(staged: _Staged, claim: Claim) -> bool:
    """Whether copies stand on a line; "side by side" it is across their way."""
    own = staged.own(claim)
    first, last = (np.array([one.middle(share * staged.duration_s)[:2] for one in own])
                   for share in (0.0, 1.0))  # fmt: skip
    places, way = 0.5 * (first + last), (last - first).mean(axis=0)
    along = np.abs((places[-1] - places[0]) @ way)
    whole = float(np.linalg.norm(way) * np.linalg.norm(places[-1] - places[0]))
    is_across = along <= math.sqrt(0.5) * whole
    return is_in_line(places) and (bool(is_across) or claim.value != "across")


def _count(staged: _Staged, actor: Actor) -> float:
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


def _repeats(staged: _Staged, claim: Claim) -> bool:
    """Whether it comes back to its first pose so often, or rests after so many repetitions."""
    said = () if claim.subject is None else staged.description.objects[claim.subject].motions
    rate_hz = ACTIVITIES[said[0].kind].repeats_hz if said and said[0].kind in ACTIVITIES else 0.0
    if rate_hz and len(said) == 2 and said[1].start_s is not None:
        counted = said[1].start_s * rate_hz * said[0].pace
        return said[1].start_s <= staged.duration_s and abs(counted - float(claim.value)) < 0.01
    return all(_count(staged, one) == claim.value for one in staged.own(claim))


def _returns(staged: _Staged, claim: Claim) -> bool:
    """Whether it is again as it was: at the end, or several times."""
    counts = [_count(staged, one) for one in staged.own(claim)]
    return all(one >= 1.0 and (one.is_integer() or one > 2.0) for one in counts)


def _is_circling(staged: _Staged, claim: Claim) -> bool:
    """Whether a body or the camera goes along a circle."""
    if claim.subject is None:
        ways = [np.array([staged.scene.camera(one).position[:2] for one in staged.times])]
    else:
        ways = [one.middle[:, :2] for one in staged.own_boxes(claim)]
    return all(map(is_arc, ways))


def _swings(staged: _Staged, claim: Claim) -> bool:
    """Whether the part that moves most turns back on its way."""
    for one in staged.own(claim):
        steps = np.diff(staged.places(one), axis=0)
        most = steps[:, np.linalg.norm(steps, axis=2).sum(axis=0).argmax()]
        if not (most[1:] * most[:-1]).sum(axis=1).min() < 0.0:
            return False
    return True


def _rises_from(staged: _Staged, claim: Claim) -> bool:
    """Whether it is on the ground of a place at first, and above it later."""
    return all(
        one.lowest_m(0.0) <= _GROUNDED * one.size_m < max(map(one.lowest_m, staged.times))
        for one in staged.own(claim)
    )


def _stops(staged: _Staged, claim: Claim) -> bool:
    """Whether it goes at first, and rests at the end."""
    for one in staged.own_boxes(claim):
        steps = np.linalg.norm(np.diff(one.middle, axis=0), axis=1)
        if steps[-1] > _RESTING * steps.mean() or steps.max() <= _STILL * one.size.max():
            return False
    return True


def _lands(staged: _Staged, claim: Claim) -> bool:
    """Whether it comes to the ground of a place, or onto another body."""
    heights = [[one.lowest_m(time_s) for time_s in staged.times] for one in staged.own(claim)]
    if all(min(each) <= _GROUNDED * one.size_m
           for one, each in zip(staged.own(claim), heights, strict=True)):  # fmt: skip
        return True
    low = int(np.argmin(heights[0]))
    others = [n for n, own in enumerate(staged.boxes) if own and n != claim.subject]
    return any(_relates(staged, replace(claim, targets=(one,)), "on", slice(low, low + 1))
               for one in others)  # fmt: skip


def _descends(staged: _Staged, claim: Claim) -> bool:
    """Whether it is lower at some instant than before: what dives."""
    heights = [one.middle[:, 2] for one in staged.own_boxes(claim)]
    depths = [float((np.maximum.accumulate(each) - each).max()) for each in heights]
    return all(one > 0.1 * body.size_m for one, body in zip(depths, staged.own(claim), strict=True))


def _is_in_water(staged: _Staged, claim: Claim) -> bool:
    """Whether the place has water in which it may swim, or it is in another body: an aquarium."""
    place, said = staged.scene.place, staged.description.relations
    is_inside = any(one.kind == "in" and one.subject == claim.subject for one in said)
    if is_inside or not place.has_shore:
        return is_inside or place.ground in (Ground.SEA, Ground.UNDERWATER)
    base = staged.scene.animated_environment.base
    x, y = map(float, base.road_offset)
    half_m = float(base.road_half_width) if place.ground is not Ground.LAKE else 0.0
    line, ways = RoadLine(base.road_angle, (x, y)), staged.own_boxes(claim)
    across_m = np.array([line.across(one.middle[:, :2]) for one in ways])
    is_wet = (across_m > -half_m) & (across_m < (half_m or math.inf))
    return bool(is_wet.mean() >= _MOSTLY)


def _keeps_to_ground(staged: _Staged, claim: Claim) -> bool:
    """Whether it goes on the ground, or on another body, or in the air, for a part of the clip."""
    own, others = staged.own(claim), [one for one in staged.scene.actors]
    for one in own:
        low = np.array([one.lowest_m(time_s) for time_s in staged.times])
        tops = [float(each.corners(0.0)[:, 2].max()) for each in others if each not in own]
        gaps = np.min([np.abs(low - height) for height in (0.0, *tops)], axis=0)
        is_near = gaps <= _GROUNDED * one.size_m
        if not (is_near.mean() >= 0.5 if claim.value else not is_near.all()):
            return False
    return True


def _goes_back(staged: _Staged, claim: Claim) -> bool:
    """Whether it goes against its heading; of one motion, all the time that it goes."""
    said = () if claim.subject is None else staged.description.objects[claim.subject].motions
    for one in staged.own_boxes(claim):
        ahead = (np.diff(one.middle[:, :2], axis=0) * one.ahead[:-1]).sum(axis=1)
        least = _STILL * one.size.max()
        if ahead.min() >= -least or (len(said) < 2 and ahead.max() > least):
            return False
    return True


def _is_laid(staged: _Staged, claim: Claim) -> bool:
    """Whether it is no higher than long at the end: a glass that lies."""
    sizes = [one.size[-1] for one in staged.own_boxes(claim)]
    return all(each[2] < max(each[:2]) for each in sizes)


def _bounces(staged: _Staged, claim: Claim) -> bool:
    """Whether it comes down in the image, and then up again."""
    for one in staged.own(claim):
        height = [one.lowest_m(at) for at in staged.fine_times if staged.has_in_image(one, at)]
        if not height:
            return False
        low = int(np.argmin(height))
        if min(max(height[: low + 1]), max(height[low:])) - height[low] < _GROUNDED * one.size_m:
            return False
    return True


def _falls(staged: _Staged, claim: Claim) -> bool:
    """Whether it comes down by its size from where it is at first, its highest place."""
    for one in staged.own(claim):
        height = [one.lowest_m(at) for at in staged.fine_times]
        if height[0] < max(height) - 1e-6 or height[0] - min(height) < one.size_m:
            return False
    return True


def _each_holds(staged: _Staged, claim: Claim) -> bool:
    """Whether there is something for each to hold: one table is carried by one."""
    objects, said = staged.description.objects, staged.description.relations
    holders = {one.subject for one in said
               if one.kind == "hold" and not {*claim.targets}.isdisjoint(one.targets)}  # fmt: skip
    held = sum(objects[one].count for one in claim.targets)
    return sum(objects[one].count for one in holders) <= held


def _shines(staged: _Staged, claim: Claim) -> bool:
    """Whether a lamp of it is on at some time, or it is a pattern that blinks."""
    lit = {one.actor.instance for one in staged.scene.lamps.lit if one.shines or one.flashes}
    return all(one.instance in lit for one in staged.own(claim))


def _is_doing(staged: _Staged, claim: Claim) -> bool:
    """Whether a person, a hand or an animal does it at some instant.

    Who sits down, sits; it may be done seated ("sit and read"); what jumps leaves the ground.
    """
    first, own = str(claim.value).split()[0], staged.own(claim)
    done = [
        {part.split()[0] for time_s in staged.times
         for part in one.track.at(time_s).activity.split(" and ")}
        for one in own
    ]  # fmt: skip
    is_up = first == "jump" and all(
        max(map(one.lowest_m, staged.times)) > _GROUNDED * one.size_m for one in own
    )
    return is_up or all(first in each for each in done)


def _sits_at(staged: _Staged, claim: Claim) -> bool:
    """Whether each is on a seat, turned to the thing and within reach of it."""
    goals = [(n, one) for n in claim.targets for one in staged.boxes[n]]
    about = [n for n in (claim.subject,) if n is not None]
    return not any(one.pose(0.5 * staged.duration_s).activity.endswith("on ground")
                   for one in staged.own(claim)) and all(
        any(_holds(staged, "facing", (about[0], n), [[body], [goal]])
            and _holds(staged, "at", (about[0], n), [[body], [goal]]) for n, goal in goals)
        for body in staged.own_boxes(claim)
    )  # fmt: skip


CHECKS: Mapping[str, Callable[[_Staged, Claim], bool]] = {
    "colour": _of_parts(has_colour), "material": _of_parts(is_of_material),
    "blink": _of_parts(is_blinking), "lit colour": _of_parts(is_lit_in),
     "relation": _is_related, "off": _leaves,
    "arrive": _arrives, "stop before": _stops_before, "row": _is_row, "times": _repeats,
    "again": _returns, "circle": _is_circling, "parts": _of_parts(is_moving_inside),
    "lie": _is_laid, "shine": _shines, "hold": _each_holds,
    "activity": _is_doing, "direction": _swings, "rise": _rises_from, "ground": _keeps_to_ground,
    "mutual": _are_mutual, "bounce": _bounces, SEEN: lambda *_: True,
    "reverse": _goes_back, "fall": _falls, "water": _is_in_water, "descend": _descends,
    "land": _lands, "stop": _stops, "sit at": _sits_at,
}  # fmt: skip
"""Kind of claim → its check."""
