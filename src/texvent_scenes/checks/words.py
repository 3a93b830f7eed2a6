"""Word check: words that are shown only if the staged scene holds what they claim.

A reader that places nothing by a word, or that cannot know whether what it says comes about, leaves
a `Claim`. Boxes, parts and places of the bodies over the clip decide.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np

from texvent.sensor import SensorSize
from texvent_scenes.checks.bodies.acts import (
    begins,
    bounces,
    breaks,
    changes_pace,
    descends,
    falls,
    goes_along,
    goes_aside,
    goes_back,
    handles,
    has_in_mouth,
    is_circling,
    is_doing,
    is_laid,
    keeps_to_ground,
    lands,
    meets_ground,
    moves,
    passes_mouth,
    repeats,
    returns,
    rises_from,
    stays,
    stops,
    stops_before,
    swings,
    tips,
    turns,
)
from texvent_scenes.checks.bodies.grips import handles_by_hand
from texvent_scenes.checks.bodies.lit import shows_lamp, shows_lit_colour
from texvent_scenes.checks.bodies.looks import has_look
from texvent_scenes.checks.bodies.parts import (
    Place,
    goes_round,
    has_colour,
    is_blinking,
    is_moving_inside,
    is_of_material,
)
from texvent_scenes.checks.bodies.phases import runs
from texvent_scenes.checks.clip.body_boxes import BodyBoxes, is_any_inside
from texvent_scenes.checks.clip.relation_rules import RULES
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.checks.surroundings.places import is_before_sky, shows_sky, shows_sun
from texvent_scenes.checks.surroundings.streets import are_many, gets_on, is_on_pavement
from texvent_scenes.checks.surroundings.water import is_above_way, wet_share
from texvent_scenes.checks.views.camera_ways import (
    is_at_eye_level,
    is_camera_so,
    is_macro,
    is_overtaken,
)
from texvent_scenes.description import SEEN, Claim, SceneDescription
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene

_LEAST_CLIP_S = 1.0
_DONE = (
    "act on",
    "aside",
    "grip",
    "bounce",
    "break",
    "ground",
    "activity",
    "stop before",
    "stop",
    "land",
    "descend",
    "move",
    "tip",
    "turn",
    "rounds",
    "begin",
    "run",
    "out between",
)
"""Length of a clip in which motions get so far that they are judged, s; claims of read motions."""
_OF_CAMERA = (SEEN, "circle", "camera", "macro", "eye level", "sky", "sun")
"""Claims that may be made of the camera."""
_COVERED = 0.6
"""Most distance in the image of what is covered, in half extents of both."""
_LARGE, _TELLING = 0.25, 0.12
"""Least size of what is close to the camera, and of that of which one sees parts, as a share of its
distance."""
_LOW = 0.3
"""Height of what one steps over, in heights of a body."""
_LIT_SHARE = 0.5
"""Share of the period of a lamp that blinks for which it is lit."""
_MOSTLY = 0.75
"""Share of the clip in which what swims is in the water."""
_CENTRAL = 0.17
"""Most distance from the middle of the image of what is there, in its widths."""
_STRAY, _UNEVEN, _LOOSE = 0.12, 2.0, 0.3
"""Most departure of a row from its line, in gaps; most ratio of its gaps; most gap in a stack, in
heights."""


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
    staged, failed = StagedClip(scene, description, size, duration_s), set[str]()
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


def _of_parts(
    check: Callable[[Sequence[Actor], Claim, Sequence[float], Place], bool],
) -> Callable[[StagedClip, Claim], bool]:
    """A check of the parts of bodies, at the instants of the clip."""
    return lambda staged, claim: check(
        staged.own(claim), claim, staged.fine_times, staged.scene.lamps.place
    )


def _is_related(staged: StagedClip, claim: Claim) -> bool:
    """Whether a relation that nothing placed holds all the same."""
    return staged.relates(claim, str(claim.value))


def _are_mutual(staged: StagedClip, claim: Claim) -> bool:
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
        staged.holds(str(claim.value), (first, second), [[one], [other]])
        and staged.holds(str(claim.value), (second, first), [[other], [one]])
        for (first, one), (second, other) in itertools.combinations(bodies, 2)
    )


def _leaves(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is on something at first and no more at the end: "off"."""
    first, last = (staged.relates(claim, "on", when) for when in (slice(1), slice(-1, None)))
    return first and not last


def _arrives(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is in or on something at the end and was not at first: "into", "onto"."""
    kind = str(claim.value)
    first, last = (staged.relates(claim, kind, when) for when in (slice(1), slice(-1, None)))
    return last and not first


def _leaves_gap(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is between two that are near at first, and no more at the end: "out between".

    It is out as well where it has gone farther than they are wide.
    """
    first, last = (staged.relates(claim, "between", when) for when in (slice(1), slice(-1, None)))
    others = [one for n in claim.targets for one in staged.boxes[n]]
    wide = min(float(one.size[0, :2].min()) for one in others)
    last &= not all(np.linalg.norm(one.middle[-1, :2] - one.middle[0, :2]) > wide
                    for one in staged.own_boxes(claim))  # fmt: skip
    near = [sum(bool(RULES["at"](one, other)[0]) for other in others)
            for one in staged.own_boxes(claim)]  # fmt: skip
    return first and not last and min(near, default=0) >= 2


def _is_on_edge(staged: StagedClip, claim: Claim) -> bool:
    """Whether it is on what it goes along the edge of, or that is as low as the ground: a pool."""
    others = [one for n in claim.targets for one in staged.boxes[n]]
    is_low = all(other.size[0, 2] <= _LOW * one.size[0, 2]
                 for one in staged.own_boxes(claim) for other in others)  # fmt: skip
    return is_low or staged.relates(claim, "on")


def _is_row(staged: StagedClip, claim: Claim) -> bool:
    """Whether copies stand on a line; "side by side" it is across their way.

    In a queue those on feet are one behind the other.
    """
    own, objects = staged.own(claim), staged.description.objects
    if len(own) == 1:  # of those that begin in turn each is an object
        own = [one for one in staged.scene.actors
               if objects[one.object_index].noun == objects[claim.subject or 0].noun]  # fmt: skip
    if not own:
        return False
    first, last = (np.array([one.middle(share * staged.duration_s)[:2] for one in own])
                   for share in (0.0, 1.0))  # fmt: skip
    places, way = 0.5 * (first + last), (last - first).mean(axis=0)
    along = np.abs((places[-1] - places[0]) @ way)
    whole = float(np.linalg.norm(way) * np.linalg.norm(places[-1] - places[0]))
    is_across = along <= math.sqrt(0.5) * whole
    heads = np.array([one.track.at(0.0).to_world()[:2, 0] for one in own])
    line = (places[-1] - places[0]) / max(float(np.linalg.norm(places[-1] - places[0])), 1e-9)
    is_queue = own[0].noun.motion != "walk" or bool((np.abs(heads @ line) > math.sqrt(0.5)).all())
    is_so = {"across": bool(is_across), "queue": is_queue}.get(str(claim.value), True)
    return is_in_line(places) and is_so


def is_in_line(places: Float64Array) -> bool:
    """Whether places on the ground, [n, 2] m, are on a line, at even gaps."""
    if len(places) < 2:
        return False
    off = places - places.mean(axis=0)
    _, _, axes = np.linalg.svd(off)
    gaps = np.diff(np.sort(off @ axes[0]))
    is_straight = np.abs(off @ axes[1]).max() <= _STRAY * gaps.mean()
    return bool(is_straight and gaps.max() <= _UNEVEN * gaps.min())


def _is_stack(staged: StagedClip, claim: Claim) -> bool:
    """Whether bodies of its noun are on top of each other, all but the lowest; at the end, one."""
    objects = staged.description.objects
    noun = objects[claim.subject or 0].noun
    is_end = claim.value == "end"
    boxes = [one.corners(staged.duration_s * is_end) for one in staged.scene.actors
             if objects[one.object_index].noun == noun]  # fmt: skip
    if not boxes:
        return False
    low, high = (np.array([getattr(one, way)(axis=0) for one in boxes]) for way in ("min", "max"))
    room = _LOOSE * (high - low)[:, 2]
    rests = [bool(((np.abs(low[n, 2] - high[:, 2]) <= room) & (low[n, :2] < high[:, :2]).all(axis=1)
                   & (high[n, :2] > low[:, :2]).all(axis=1)).any())
             for n in range(len(boxes))]  # fmt: skip
    return sum(rests) >= (1 if is_end else max(len(boxes) - 1, 1))


def _is_in_water(staged: StagedClip, claim: Claim) -> bool:
    """Whether the place has water in which it may swim, or it is in another body: an aquarium."""
    said = staged.description.relations
    is_inside = any(one.kind == "in" and one.subject == claim.subject for one in said)
    ways = np.concatenate([one.middle[:, :2] for one in staged.own_boxes(claim)])
    return is_inside or wet_share(staged.scene, ways) >= _MOSTLY


def _each_holds(staged: StagedClip, claim: Claim) -> bool:
    """Whether there is something for each to hold: one table is carried by one."""
    objects, said = staged.description.objects, staged.description.relations
    holders = {one.subject for one in said
               if one.kind == "hold" and not {*claim.targets}.isdisjoint(one.targets)}  # fmt: skip
    held = sum(objects[one].count for one in claim.targets)
    return sum(objects[one].count for one in holders) <= held


def _shines(staged: StagedClip, claim: Claim) -> bool:
    """Whether a lamp of it is on at some time, or it is a pattern, and one that blinks goes off."""
    is_short = staged.duration_s < _LEAST_CLIP_S
    lit = {
        one.actor.instance for one in staged.scene.lamps.lit
        if (one.shines or one.flashes)
        and (not one.blink_hz or is_short or one.blink_hz * staged.duration_s > _LIT_SHARE)
    }  # fmt: skip
    return all(one.instance in lit for one in staged.own(claim))


def _is_near(staged: StagedClip, claim: Claim) -> bool:
    """Whether a body takes a good part of the image at some instant: "close to the camera"."""
    return any((one.size.max(axis=1) >= _LARGE * np.maximum(one.seen[:, 2], 1e-3)).any()
               for one in staged.own_boxes(claim))  # fmt: skip


def _tells_parts(staged: StagedClip, claim: Claim) -> bool:
    """Whether a body is so large in the image at some instant that one sees its parts: a mane."""
    return any((one.size.max(axis=1) >= _TELLING * np.maximum(one.seen[:, 2], 1e-3)).any()
               for one in staged.own_boxes(claim))  # fmt: skip


def _covers(staged: StagedClip, claim: Claim) -> bool:
    """Whether each body is before another one in the image at some time, and over much of it."""
    others = [one for n in claim.targets for one in staged.boxes[n]]
    return bool(others) and all(
        any(is_covered(one, other) for other in others) for one in staged.own_boxes(claim)
    )


def is_covered(one: BodyBoxes, other: BodyBoxes) -> bool:
    """Whether a body is before another one, and their middles are near in the image."""
    off, half = np.abs(one.seen - other.seen)[:, :2], np.zeros((len(one.seen), 2))
    for body in (one, other):
        extents = np.column_stack([body.size[:, :2].max(axis=1), body.size[:, 2]])
        half += 0.5 * extents / np.maximum(body.seen[:, 2:], 1e-3)
    is_before = one.seen[:, 2] < other.seen[:, 2]
    return bool((is_before & (off <= _COVERED * half).all(axis=1)).any())


def _sits_at(staged: StagedClip, claim: Claim) -> bool:
    """Whether each is on a seat, turned to the thing and within reach of it."""
    goals = [(n, one) for n in claim.targets for one in staged.boxes[n]]
    about = [n for n in (claim.subject,) if n is not None]
    return not any(one.pose(0.5 * staged.duration_s).activity.endswith("on ground")
                   for one in staged.own(claim)) and all(
        any(staged.holds("facing", (about[0], n), [[body], [goal]])
            and staged.holds("at", (about[0], n), [[body], [goal]]) for n, goal in goals)
        for body in staged.own_boxes(claim)
    )  # fmt: skip


def _is_taken_in(staged: StagedClip, claim: Claim) -> bool:
    """Whether what is sent is in the box of what takes it in: at the end, or through a hoop."""
    takers = [one for n in claim.targets for one in staged.list_actors(n)]
    return all(
        any(_is_in_box(one, other, at) for other in takers for at in staged.fine_times[1:])
        for one in staged.own(claim)
    )


def _is_in_box(one: Actor, other: Actor, time_s: float) -> bool:
    """Whether the middle of a body is in the box of another one."""
    corners, middle = other.corners(time_s), one.middle(time_s)
    return bool(((corners.min(axis=0) <= middle) & (middle <= corners.max(axis=0))).all())


def _stays_in_image(staged: StagedClip, claim: Claim) -> bool:
    """Whether the middle of each body is in the image all the time, of what is "centred" there."""
    off = np.array([one.seen[:, 0] for one in staged.own_boxes(claim)])
    focal = np.array([staged.scene.camera(time_s).focal for time_s in staged.times])
    for one in staged.own(claim):
        for time_s in staged.times:
            corners = one.corners(time_s)
            middle = 0.5 * (corners.min(axis=0) + corners.max(axis=0))
            if not is_any_inside(middle[None], staged.scene.camera(time_s), staged.size):
                return False
    return claim.value != "centre" or bool((np.abs(off * focal) <= _CENTRAL).all())


def _is_before_sky(staged: StagedClip, claim: Claim) -> bool:
    """Whether around each body nothing but the sky is seen, at most instants that show it."""
    return all(is_before_sky(staged.scene, one, staged.times) for one in staged.own(claim))


CHECKS: Mapping[str, Callable[[StagedClip, Claim], bool]] = {
    "colour": _of_parts(has_colour), "material": _of_parts(is_of_material),
    "look": _of_parts(has_look),
    "blink": _of_parts(is_blinking), "lit colour": shows_lit_colour, "lamp": shows_lamp,
     "relation": _is_related, "off": _leaves,
    "arrive": _arrives, "stop before": stops_before, "row": _is_row, "stack": _is_stack,
    "times": repeats,
    "again": returns, "stays": stays, "circle": is_circling, "parts": _of_parts(is_moving_inside),
    "lie": is_laid, "shine": _shines, "hold": _each_holds,
    "act on": handles, "in_mouth": has_in_mouth,
    "activity": is_doing, "direction": swings, "rise": rises_from, "ground": keeps_to_ground,
    "mutual": _are_mutual, "bounce": bounces, "break": breaks, SEEN: lambda *_: True,
    "camera mouth": passes_mouth, "on_ground": meets_ground,
    "reverse": goes_back, "fall": falls, "water": _is_in_water, "descend": descends,
    "land": lands, "aside": goes_aside, "along": goes_along,
    "grip": handles_by_hand, "camera": is_camera_so, "stop": stops, "move": moves, "tip": tips,
    "rounds": _of_parts(goes_round), "way": gets_on,
    "turn": turns, "begin": begins, "near": _is_near, "pace": changes_pace,
    "in image": _stays_in_image, "run": runs, "out between": _leaves_gap,
    "on edge": _is_on_edge,
    "sky": lambda staged, _: shows_sky(staged.scene, staged.times),
    "sun": lambda staged, _: shows_sun(staged.scene, staged.times, staged.size),
    "many": are_many, "pavement": is_on_pavement,
    "sky behind": _is_before_sky, "taken in": _is_taken_in,
    "sit at": _sits_at, "macro": is_macro, "overtaken": is_overtaken, "cover": _covers,
    "eye level": is_at_eye_level, "above way": is_above_way, "part": _tells_parts,
}  # fmt: skip
"""Kind of claim → its check."""
