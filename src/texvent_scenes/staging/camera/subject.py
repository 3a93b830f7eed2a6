"""The subject of the camera, and what the image must hold."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType
from typing import NamedTuple

import numpy as np

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.activities import HAND_NOUNS, OF_ARMS, PERSON_NOUNS
from texvent_scenes.models.anchors import has_rim
from texvent_scenes.models.effects import EFFECTS
from texvent_scenes.models.shapes import bounds, moved
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.camera.camera_track import Tie, TimedMove

INSTANTS = 13
"""Instants of the clip at which everything must fit."""
_FILL, _WIDE_FILL, _FOLLOWED_FILL, _NEAR_FILL = 0.88, 0.55, 0.75, 0.95
"""Share of the image that what matters may fill: usually, in a wide shot, where the camera goes
along with it, and in a close shot."""
_FILL_BY_MOVE = {"pan": 0.62, "tilt": 0.7, "truck": 0.66, "pedestal": 0.7, "orbit": 0.66,
                 "handheld": 0.84, "roll": 0.7}  # fmt: skip
_WHOLE = 3.5
"""Other objects must fit as a whole if they are at most this many times as large as the movers."""
_LOWER = 2.0
"""Height of the part of what is tall beside something, in sizes of the largest mover."""
_PIECE, _MOST_PIECE, _TOLD, _TOUCHED = 0.7, 3.0, 0.25, 0.1
"""Least and greatest reach of the piece of a larger one that must fit, in sizes of the largest
mover; in its own, so that one tells what it is, and where the subject would be a speck."""
_GOALS = (1.0, 1.0, 0.9, 0.4, 0.3)
"""Prominence of the subject for which the image may hold no more than each of the views."""
_LARGE_IN_WIDE, _SMALL_TARGET = 0.75, 0.4
"""Prominence of the subject in a wide shot, and of what the camera is said to be about if those
who act are more than twice as large, relative to its usual one."""
_SMALL_AMONG_PLACED = 0.25
"""Prominence of the subject among things whose places a file states: all of them are meant."""
_KEPT_TOGETHER = frozenset(
    {"at", "on", "in", "above", "under", "behind", "front", "beside", "between", "around",
     "left of", "right of", "from behind"}
)  # fmt: skip
"""Relations of which both things must be in the picture."""
_SIDED = ("between", "from behind")
"""Relations to things that must be in it from side to side."""
_SENT = {"kick": 3.2, "throw": 3.2, "roll": 3.2, "hit": 1.7}
"""Acts after which a thing flies off → how far it must be seen, in sizes of the subject."""
_UPPER = {"close": 0.62, "medium": 0.42}
"""Framing → share of a person's height below which the image may end."""
_HANDS = ("right hand", "left hand")
_AT_WORK, _AROUND_HANDS = np.array([0.012, -0.12, 0.22]), 0.1
"""Least way of hands at work, the head's greatest, negative, and least distance between them; and
what is in a close shot around hands: all in heights of the person."""
_MOST_NEAR = 3
"""Greatest number of copies that a near shot holds together."""
_POURED = 1.6
"""Length of a stream that is in a close shot of what it is poured into, in heights of that."""
_FOREARM = 0.28
"""Share of a hand with its forearm below which the image may end: it comes from outside."""


def choose_main(description: SceneDescription, actors: Sequence[Actor]) -> Actor:
    """The object the camera is about: as said, or the first that moves or could."""
    target = description.index(description.camera.target)
    asked = [one for one in actors if target is not None and one.object_index == target]
    able = [one for one in actors if one.is_mover or
            (one.noun.speed_m_s > 0.0 and one.noun.habitat != "fixed")]  # fmt: skip
    return [*asked[:1], *able[:1], actors[0]][0]


def acts_with_arms(actor: Actor, times: Float64Array) -> bool:
    """Whether it is a hand that stays, or a person who acts with arms and head all along."""
    if actor.noun.name in HAND_NOUNS:
        return actor.track.is_resting
    activities = {actor.pose(float(time)).activity for time in times}
    return actor.noun.name in PERSON_NOUNS and activities <= OF_ARMS


class FramingChoice(NamedTuple):
    """Points that the image must hold, and their share of it."""

    points: Float64Array
    """[n, 3] m."""
    fill: float
    """Share of the image that they may fill."""
    goal: float = 1.0
    """Prominence of the subject for which the image may hold no more than this."""


class _Scope(NamedTuple):
    """Criteria of the part of each object that must be seen."""

    main: Actor
    times: Float64Array
    tie: Tie | None
    passed: Collection[int]
    """Objects that something goes past."""
    cut: Collection[int]
    """Objects of which the lower part may be out of the image: people who act with their arms."""
    whole: Collection[int] = ()
    """Containers and passages, which tell what they are as a whole."""
    sent: Mapping[int, float] = MappingProxyType({})
    """Objects that are thrown or struck → how far they must be seen, in sizes of the subject."""
    told: float = _TOLD
    """Reach of the piece of a larger thing, in its own sizes."""
    sided: Collection[int] = ()
    """Objects between which something is: of what is tall, the lower part from side to side."""
    rises: Mapping[int, float] = MappingProxyType({})
    """Objects from which steam or smoke rises → how far it must be seen, in their mean sizes."""


def list_framing_choices(
    description: SceneDescription, actors: Sequence[Actor], main: Actor,
    moves: Sequence[TimedMove], tie: Tie | None, times: Float64Array,
) -> list[FramingChoice]:  # fmt: skip
    """Choices of what the image holds, from all objects to the subject alone, at instants, s."""
    shot, relations = description.camera, description.relations
    passed = {n for r in relations if r.kind in ("past", "overtake") for n in r.targets}
    first = {one.object_index: one for one in reversed(actors)}
    cut = {n for n, one in first.items() if shot.framing is None and acts_with_arms(one, times)}
    whole = {n for r in relations for n in r.targets if _tells_as_a_whole(r.kind, description, n)}
    sided = {n for r in relations if r.kind in _SIDED for n in r.targets}
    sent = {n: _SENT[r.kind] for r in relations if r.kind in _SENT for n in r.targets}
    rises = {n: EFFECTS[one.kind].rise for one in description.effects
             if (n := description.index(one.source)) is not None}  # fmt: skip
    scope = _Scope(main, times, tie, passed, cut, whole, sent, sided=sided, rises=rises)
    near = [one for one in actors if description.objects[one.object_index].placement != "far"]
    framing = shot.framing
    if framing == "close" or (framing == "medium" and main.noun.name in PERSON_NOUNS):
        same = [one for one in actors if one.object_index == main.object_index][:_MOST_NEAR]
        parts = [near_part(one, framing, times, tie).reshape(-1, 3) for one in same]
        parts += _list_poured(description, actors, main, times)
        return [FramingChoice(np.vstack(parts), _NEAR_FILL)]
    fill = min([_FILL, *(_FILL_BY_MOVE.get(one.move.kind, _FILL) for one in moves)])
    fill = fill if tie is None else min(fill, _FOLLOWED_FILL)
    if shot.framing == "wide":
        fill = _WIDE_FILL
    goal = _LARGE_IN_WIDE if shot.framing == "wide" else 1.0
    is_large = any(one.is_mover and one.size_m > 2.0 * main.size_m for one in near)
    goal *= _SMALL_TARGET if shot.target is not None and is_large else 1.0
    placed = [one for one in description.objects if one.position_m is not None]
    goal *= _SMALL_AMONG_PLACED if len(placed) > 1 and shot.framing is None else 1.0
    copies = [one for one in actors if one.object_index == main.object_index]
    groups = _list_groups(description, near, main, whole)
    scopes = [*([scope] * (len(groups) - 1)), scope._replace(told=_TOUCHED)]
    return [
        FramingChoice(_points_of([*copies, *group], each), fill, goal * least)
        for group, each, least in zip(groups, scopes, _GOALS, strict=True)
    ]


def _list_groups(
    description: SceneDescription, near: Sequence[Actor], main: Actor, whole: set[int]
) -> list[Sequence[Actor]]:
    """Groups of bodies beside a subject, fewer and fewer: all that is near, to what it is bound to.

    Args:
        description: the scene.
        near: bodies that are not in the distance.
        main: the subject.
        whole: objects that tell what they are as a whole.
    """
    relations, own = description.relations, main.object_index
    tied = [{r.subject, *r.targets} for r in relations if own in (r.subject, *r.targets)]
    related = set().union(*tied) - {own}
    catching = {r.subject for r in relations if r.kind == "catch" and related & {*r.targets}}
    related |= catching - {own}
    for r in (r for r in relations if r.kind == "on"):  # said from the lowest one of a stack on
        related |= {r.subject} - {own} if related.intersection(r.targets) else set()
    landmarks = {n for r in relations if r.kind in _KEPT_TOGETHER for n in r.targets}
    agents = {r.subject for r in relations if r.kind in _SENT.keys() | {"follow"}
              and own in r.targets}  # fmt: skip
    sides = {n for n, one in enumerate(description.objects) if one.placement in ("left", "right")}
    partners = [one for one in near if one.object_index in (related | sides) - {own}]
    # A lighthouse and a swing only work where they are.
    goes = [one for one in near if one.is_mover and one.noun.habitat != "fixed"]
    told = landmarks | whole | agents | catching
    kept = [one for one in partners if one.object_index in told | sides]
    bound = [one for one in partners if one.object_index in told & related]
    return [near, [*(goes if main.is_mover else near), *partners], partners, kept, bound]


def near_part(
    main: Actor, framing: str, times: Float64Array, tie: Tie | None = None
) -> Float64Array:
    """[times, n, 3] what a near shot holds, m: of a person the upper part, or hands at work.

    Args:
        main: the subject.
        framing: "close" or "medium".
        times: instants, s.
        tie: of a camera that goes along.
    """
    hands = _hands_at_work(main, times) if framing == "close" and tie is None else None
    if hands is not None:
        return hands
    boxes = [_box_at(main, time, tie) for time in map(float, times)]
    return np.array([_upper_part(main, box, framing) for box in boxes])


def _list_poured(
    description: SceneDescription, actors: Sequence[Actor], main: Actor, times: Float64Array
) -> list[Float64Array]:
    """[2, 3] ends, m, of what is poured into the subject by who holds it: the last of its way."""
    holders = {r.subject for r in description.relations
               if r.kind == "hold" and main.object_index in r.targets}  # fmt: skip
    jets = [
        np.array(bounds(moved(prop.draw(time), one.anchor(prop.anchor, time))))
        for one in actors if one.object_index in holders
        for prop in one.props if prop.anchor == "hands"
        for time in map(float, times)
    ]  # fmt: skip
    for jet in jets:
        jet[1, 2] = min(jet[1, 2], jet[0, 2] + _POURED * main.model.height)
    return jets


def _hands_at_work(main: Actor, times: Float64Array) -> Float64Array | None:
    """[times, 4, 3] places around hands, m, of a person who acts with them alone.

    They have something in them or before them, as none who laughs has, are away from the face, and
    not on what is worn or held before the chest, as a guitar.
    """
    held = {"ground", "hands", *_HANDS}
    anchors = {one.anchor for one in main.props}
    if main.noun.name not in PERSON_NOUNS or not anchors or anchors - held:
        return None
    ways = np.array([[main.anchor(one, float(time))[:, 3] for time in times]
                     for one in (*_HANDS, "head")])  # fmt: skip
    hands, head = ways[:2], ways[2]
    stirs_m, nods_m = np.ptp(hands, axis=1).max(), np.ptp(head, axis=0).max()
    from_face_m = np.linalg.norm(hands - head, axis=2).min()
    if (np.array([stirs_m, -nods_m, from_face_m]) < _AT_WORK * main.size_m).any():
        return None
    reach_m = _AROUND_HANDS * main.size_m
    return np.vstack([hands - reach_m, hands + reach_m]).swapaxes(0, 1)


def _tells_as_a_whole(kind: str, description: SceneDescription, index: int) -> bool:
    """Whether a thing that something is in, or goes through or around, must be seen as a whole."""
    noun = description.objects[index].noun
    if kind == "around":
        return True
    if kind == "through":
        return noun in nouns_with("passage")
    if kind == "into":
        return has_rim(noun)
    if kind == "on":
        return trait_value("slope", noun) is not None
    return kind == "in" and trait_value("container", noun) is not None


def _points_of(actors: Sequence[Actor], scope: _Scope) -> Float64Array:
    """[n, 3] what must fit, m: movers whole, of much larger things the piece near the subject.

    Where the camera goes along with the subject, places are those relative to it.
    """
    main, times = scope.main, scope.times
    movers = [actor for actor in actors if actor.is_mover or actor is main]
    largest = max(actor.size_m for actor in movers)
    points = []
    for actor in actors:
        is_mover = actor.is_mover or actor is main
        if scope.tie is not None and not is_mover:
            continue
        is_large = actor.size_m > _WHOLE * largest or actor.object_index in scope.passed
        if is_large and not is_mover and actor.object_index not in scope.whole:
            reach_m = max(_PIECE * largest, min(scope.told * actor.size_m, _MOST_PIECE * largest))
            piece = _near_piece(actor, main, times, reach_m)
            if actor.object_index in scope.sided:
                piece = actor.corners(float(times[0])).copy()
                piece[:, 2] = np.minimum(piece[:, 2], piece[:, 2].min() + _LOWER * largest)
            points.append(piece)
            continue
        for time in map(float, times):
            box = _box_at(actor, time, scope.tie)
            gone_m = np.linalg.norm(actor.middle(time) - main.middle(time))
            if gone_m > scope.sent.get(actor.object_index, math.inf) * main.size_m:
                continue
            is_cut = actor.object_index in scope.cut
            points.append(_upper_part(actor, box, "medium") if is_cut else box)
            if rise := scope.rises.get(actor.object_index):
                points.append(np.add(box, [0.0, 0.0, rise * actor.mean_size_m]))
    return np.vstack(points)


def _box_at(actor: Actor, time_s: float, tie: Tie | None) -> Float64Array:
    """[8, 3] corners of its box as a camera sees them that is tied like this, m."""
    box = actor.corners(time_s)
    return box if tie is None else tie.relative(box, time_s)


def _upper_part(actor: Actor, points: Float64Array, framing: str) -> Float64Array:
    """[n, 3] corners of boxes, m, of a person or a hand without what is below the image."""
    if actor.noun.name not in PERSON_NOUNS | HAND_NOUNS:
        return points
    share = _FOREARM if actor.noun.name in HAND_NOUNS else _UPPER[framing]
    low, high = float(points[:, 2].min()), float(points[:, 2].max())
    cut = points.copy()
    cut[:, 2] = np.maximum(cut[:, 2], low + share * (high - low))
    return cut


def _near_piece(actor: Actor, main: Actor, times: Float64Array, reach_m: float) -> Float64Array:
    """[8, 3] the piece of an object's box that is nearest to the subject's way, m."""
    box = actor.corners(float(times[0]))
    low, high = box.min(axis=0), box.max(axis=0)
    places = np.array([main.middle(float(time)) for time in times])
    nearest = np.clip(places, low, high)
    point = nearest[int(np.argmin(np.linalg.norm(nearest - places, axis=1)))]
    ends = np.stack([np.maximum(low, point - reach_m), np.minimum(high, point + reach_m)])
    return np.array([[x, y, z] for x in ends[:, 0] for y in ends[:, 1] for z in ends[:, 2]])
