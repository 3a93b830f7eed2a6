"""Holding, wearing, riding and pushing: where bodies are fixed, and where hands are then."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import NamedTuple

import numpy as np

from texvent_scenes.models.activities import HAND_NOUNS, PERSON_NOUNS
from texvent_scenes.models.anchors import find_support, top_heights
from texvent_scenes.models.people.outfit import CLOTHES, Prop, list_props
from texvent_scenes.models.protocol import Noun, Pose
from texvent_scenes.models.shapes import Affine, bounds, compose, point, shift
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.tracks.keys import Vector
from texvent_scenes.staging.tracks.track import Grips, Swing, Track, attached, rotation, seated

_LARGE_M = 0.36
"""Size above which a thing is held in both arms."""
_RAISED: Vector = (0.30, -0.24, 1.16)
"""Right hand of who holds something up, adult's body coordinates, m."""
_UP_HIGH: Vector = (0.24, -0.24, 1.55)
_STYLES: dict[str, Vector | None] = {
    "held as a tool": _RAISED, "held upright": _RAISED, "held up high": _UP_HIGH,
    "held hanging": None,
}  # fmt: skip
"""Trait that says how a noun is held → the right hand; None = where the arm hangs."""
_HANDS_FREE = frozenset({"stand", "move", "walk", "run"})
"""Activities that leave the hands to what they hold."""
_HANDS = ("left hand", "right hand")
_BACK_M = 0.12
"""From the middle of the body of an adult to the back, m."""
_ARMS = 1.06
"""Height of the arms of an adult that carry a person across them, m."""
_STRETCH = 0.60
"""Distance from shoulder to palm of an arm that is nearly straight, m."""

_SEAT_M = 0.42
"""Height of the hips over the origin of who sits, for an adult, m."""


_IN_PALM, _HAND_M = 0.35, 0.1
"""Height at which a hand alone holds a thing, as a share of its own, and at most, m."""
_WIDE_M, _AT_RIM_M, _BEHIND_M = 0.2, 0.03, 0.02
"""Size from which on a board would hide the hand, which therefore holds it at its lower rim; height
of the palm above that, and place of the board behind it, m."""


class Hold(NamedTuple):
    """Attachment of a thing to a body."""

    anchor: str
    """Place of the holder."""
    offset: Affine
    """[3, 4] the thing's body coordinates in the axes of that place."""
    is_upright: bool = True
    """Whether the thing stays upright."""
    grips: Grips = ()
    """Places of hands, in the holder's body coordinates, m."""


def hides_riders(noun: Noun) -> bool:
    """Whether it is a closed vehicle."""
    return noun.habitat != "fixed" and noun.name in nouns_with("closed")


def is_person(actor: Actor) -> bool:
    """Whether it has hands."""
    return actor.noun.name in PERSON_NOUNS


def scaled(point: Vector, size: float) -> Vector:
    """A point of an adult's body on one of that size."""
    return (size * point[0], size * point[1], size * point[2])


def _gripping(path: Track, grips: Grips) -> Track:
    return replace(path, grips=grips + path.grips)


def moving(actor: Actor, path: Track) -> Actor:
    """The actor on another track, with nothing in its hands."""
    return replace(actor, track=path, is_mover=True, lead_m=0.0, props=())


def held_at(
    holder: Actor, anchor: str, offset: Affine, *, is_upright: bool = False,
    activity: str = "stand", swing: Swing | None = None,
) -> Track:  # fmt: skip
    """A track fixed to a named place of a body: `offset` [3, 4] are axes at that place.

    What is upright faces as its holder does.
    """
    axes = partial(_upright, holder, anchor) if is_upright else partial(holder.anchor, anchor)
    return attached(holder.track, offset, activity, axes, swing)


def _upright(holder: Actor, anchor: str, time_s: float) -> Float64Array:
    yaw = holder.track.at(time_s).yaw
    return np.column_stack([rotation(yaw, 0.0, 0.0), holder.anchor(anchor, time_s)[:, 3]])


def hold(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Both, the thing in the hands of who holds it; who sits keeps them where they are.

    What tilts, sways or turns does so in the hand, and the hands go with it.
    """
    if subject.noun.name in HAND_NOUNS:
        return _in_palm(subject, target)
    if subject.noun.name in nouns_with("carries below"):
        hung = shift(0.0, 0.0, target.foot_m - target.model.height)
        return subject, carried(target, held_at(subject, "hands", hung), subject)
    if not is_person(subject):
        offset = _in_mouth(target)
        held = held_at(subject, "mouth", offset, swing=_swing(target, offset))
        return subject, carried(target, held, subject)
    doing = subject.track.at(0.0).activity
    props = list_props(doing, size_of(subject.model))
    same = (one for one in props if target.noun.name in one.nouns and one.anchor in _HANDS)
    prop = next(same, None)
    named = (style for style in _STYLES if target.noun.name in nouns_with(style))
    by_size = "in both arms" if target.size_m > _LARGE_M else "held upright"
    hold = place_in_hold(next(named, by_size), subject, target)
    is_in_arms = hold.anchor == "ground"
    swing = _swing(target, hold.offset, is_in_arms=is_in_arms)
    if doing in _HANDS_FREE:
        path = _gripping(subject.track, hold.grips)
        if swing is not None and is_in_arms and swing.is_to_and_fro:
            path = replace(path, grips_turn=partial(_turn_of, swing, hold.offset))
        subject = replace(subject, track=path)
    anchor = prop.anchor if prop is not None and hold.anchor in _HANDS else hold.anchor
    if prop is not None and any(one.anchor == "hands" for one in props):
        hold = _put_for(prop, subject, hold)
    held = held_at(subject, anchor, hold.offset, is_upright=hold.is_upright, swing=swing)
    return subject, carried(target, held, subject)


def _put_for(prop: Prop, holder: Actor, hold: Hold) -> Hold:
    """A hold with the thing where a prop would be, into which something is poured."""
    low, high = bounds(prop.draw(0.0))
    axes = holder.anchor(prop.anchor, 0.0)[:, :3]
    turn = rotation(holder.track.at(0.0).yaw, 0.0, 0.0).T @ axes if hold.is_upright else np.eye(3)
    x, y, _ = turn @ (0.5 * (low + high))
    offset = hold.offset.copy()
    offset[:2, 3] += x, y
    return hold._replace(offset=offset)


def _swing(thing: Actor, offset: Affine, *, is_in_arms: bool = False) -> Swing | None:
    """Motion of a thing in a hand, about the hand; in both arms about its middle."""
    path = thing.track
    if path.is_resting and path.at(0.0).activity == "stand":
        return None
    middle = (0.0, 0.0, 0.5 * thing.model.height - thing.foot_m)
    return Swing(path, middle if is_in_arms else point(_inverse(offset)[:, 3]))


def _inverse(axes: Affine) -> Affine:
    turn = axes[:, :3].T
    return np.column_stack([turn, -turn @ axes[:, 3]])


def _turn_of(swing: Swing, offset: Affine, time_s: float) -> Affine:
    """[3, 4] by which what is held has turned, in the axes of the place that it is held at."""
    return compose(compose(offset, swing.turned(time_s)), _inverse(offset))


def _in_palm(hand: Actor, thing: Actor) -> tuple[Actor, Actor]:
    """A thing before the palm of a hand, by its foot or handle; the hand turns with it."""
    below = min(_IN_PALM * thing.model.height, _HAND_M)
    depth = 0.5 * thing.model.length if thing.model.length < _HAND_M else 0.0
    is_thin = thing.model.length < _HAND_M or thing.noun.name in nouns_with("upright")
    if is_thin and min(thing.model.width, thing.model.height) > _WIDE_M:
        below, depth = _AT_RIM_M, -_BEHIND_M
    offset = along_tool(thing) if is_tool(thing) else shift(depth, 0.0, thing.foot_m - below)
    swing, free = _swing(thing, offset), hand
    if swing is not None:
        palm = compose(_inverse(hand.track.at(0.0).to_world()), hand.anchor("palm", 0.0))
        turn = partial(_turned_hand, free, palm, swing, offset)
        gesture = hand.track.at(0.0).activity
        hand = moving(hand, attached(hand.track, shift(0.0, 0.0, 0.0), gesture, turn))
    return hand, carried(thing, held_at(hand, "palm", offset, swing=_looks(swing)), hand)


def _looks(swing: Swing | None) -> Swing | None:
    """The same activities of a thing, with which the hand turns."""
    return None if swing is None else replace(swing, is_turned=False)


def _turned_hand(
    hand: Actor, palm: Affine, swing: Swing, offset: Affine, time_s: float
) -> Affine:  # fmt: skip
    """[3, 4] body of a hand in the world, turned about its palm as what it holds."""
    own = compose(compose(palm, _turn_of(swing, offset, time_s)), _inverse(palm))
    return compose(hand.track.at(time_s).to_world(), own)


def _in_mouth(thing: Actor) -> Affine:
    """Its longer side across, its middle at the mouth."""
    turn = rotation(0.5 * math.pi if thing.model.length > thing.model.width else 0.0, 0.0, 0.0)
    return np.column_stack([turn, [0.0, 0.0, thing.foot_m - 0.5 * thing.model.height]])


def wear(subject: Actor, target: Actor) -> tuple[Actor, Actor | None]:
    """Both, the thing at its place on the body; None for clothes, which the body has on."""
    if target.noun.name in CLOTHES:
        return subject, None
    worn = trait_value("worn", target.noun.name) or {"place": "crown"}
    turn = rotation(worn.get("yaw", 0.0), worn.get("pitch", 0.0), 0.0)
    x, y, z = scaled(worn.get("at", (0.0, 0.0, 0.0)), size_of(subject.model))
    offset = np.column_stack([turn, np.array([x, y, z + target.foot_m])])
    path = held_at(subject, worn["place"], offset, swing=_swing(target, offset))
    return subject, carried(target, path, subject)


def carried(target: Actor, held: Track, holder: Actor) -> Actor:
    """The thing on a track that its holder gives it."""
    return replace(target, track=held, is_mover=holder.is_mover, lead_m=0.0)


def place_in_hold(style: str, holder: Actor, thing: Actor) -> Hold:
    """Place of a thing that is held in a style, and places of the hands."""
    model, size = thing.model, size_of(holder.model)
    if style == "in both arms" and holder.track.at(0.0).activity in _HANDS_FREE:
        return (_cradled if is_person(thing) else _in_both_arms)(thing, size)
    hand = _STYLES.get(style)
    grips: Grips = () if hand is None else (("right hand", scaled(hand, size)),)
    if style == "held as a tool":
        return Hold("right hand", along_tool(thing), False, grips)
    below, x = min(0.35 * model.height, 0.06), 0.0
    if style == "held hanging":
        below = model.height - 0.02
    elif model.height < 1.6 * model.length:
        x = min(0.5 * model.length, 0.06)
    if holder.track.at(0.0).activity == "drink":
        below = 0.8 * model.height  # so that the rim is at the mouth
    return Hold("right hand", shift(x, 0.0, thing.foot_m - below), grips=grips)


def _in_both_arms(thing: Actor, size: float) -> Hold:
    """Both arms around it; its longer side goes across."""
    model = thing.model
    is_long = model.length > 1.2 * model.width
    deep, wide = (model.width, model.length) if is_long else (model.length, model.width)
    along = 0.16 * size + 0.5 * deep
    bottom = max(1.08 * size - 0.5 * model.height, 0.75 * size)
    z = min(max(bottom + 0.15 * model.height, 0.9 * size), 1.25 * size)
    turn = rotation(0.5 * math.pi if is_long else 0.0, 0.0, 0.0)
    offset = np.column_stack([turn, [along, 0.0, bottom + thing.foot_m]])
    grips = _both_hands(min(along, 0.42 * size), min(0.5 * wide, 0.34 * size), z)
    return Hold("ground", offset, grips=grips)


def _cradled(thing: Actor, size: float) -> Hold:
    """A baby or a child across both arms, face up."""
    middle, deep = 0.5 * thing.model.height - thing.foot_m, _BACK_M * size_of(thing.model)
    x, z = 0.18 * size + deep, _ARMS * size
    turn = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    offset = np.column_stack([turn, [x, -middle, z + deep]])
    return Hold("ground", offset, False, _both_hands(x + 0.06 * size, 0.14 * size, z))


def _both_hands(x: float, y: float, z: float) -> Grips:
    return (("left hand", (x, y, z)), ("right hand", (x, -y, z)))


def is_tool(thing: Actor) -> bool:
    """Whether it is held by a handle."""
    return thing.noun.name in nouns_with("held as a tool")


def along_tool(thing: Actor) -> Affine:
    """The handle in the hand, the rest along what the hand points to."""
    model = thing.model
    if model.width > 2.0 * max(model.length, model.height):
        # It lies along its y.
        return np.column_stack([rotation(0.0, 0.0, 0.5 * math.pi), [0.0, 0.0, 0.36 * model.width]])
    if model.length < 2.0 * model.height:
        return shift(0.0, 0.0, thing.foot_m - 0.12 * model.height)
    side = -1.0 if thing.noun.name in nouns_with("handle at the rear") else 1.0
    turn = rotation(0.0, 0.5 * math.pi * side, 0.0)
    return np.column_stack([turn, [0.0, 0.0, 0.38 * model.length]])


def push(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """Hands at the thing's back."""
    size, model = size_of(subject.model), target.model
    shoulder = 1.38 * size if is_person(subject) else 0.75 * subject.model.height
    height = max(min(0.85 * model.height, 0.95 * shoulder), 0.64 * shoulder)
    reach = 0.5 * subject.model.length
    if is_person(subject):
        drop = 1.34 - height / size
        reach = size * (0.10 + math.sqrt(max(_STRETCH**2 - drop**2, 0.04)))
        grips = _both_hands(reach, min(0.16 * size, 0.45 * model.width), height)
        subject = replace(
            subject, track=replace(_gripping(subject.track, grips), activity="push along")
        )
    offset = shift(reach + 0.02 + 0.5 * model.length, 0.0, target.foot_m)
    path = held_at(subject, "ground", offset, is_upright=True, activity="move")
    return subject, replace(target, track=path, lead_m=subject.lead_m, is_mover=subject.is_mover)


_BEHIND: Vector = (-0.32, -0.2, 0.62)
"""Right hand of who pulls something along, adult's body coordinates, m."""


def pull(subject: Actor, target: Actor) -> tuple[Actor, Actor]:
    """The thing behind, its front at the hand or below it."""
    model, hand = target.model, scaled(_BEHIND, size_of(subject.model))
    if is_person(subject):
        grips = (("right hand", hand),)
        subject = replace(subject, track=_gripping(subject.track, grips))
        gap = -hand[0]
    else:
        gap = 0.55 * subject.model.length
    offset = shift(-gap - 0.5 * model.length, hand[1] * is_person(subject), target.foot_m)
    path = held_at(subject, "ground", offset, is_upright=True, activity="move")
    return subject, replace(target, track=path, lead_m=subject.lead_m, is_mover=subject.is_mover)


def board(subject: Actor, ridden: Actor) -> tuple[Actor | None, Actor]:
    """Both, who rides on its seat.

    A person on a bicycle is the one that its model brings; those in a closed vehicle are not seen.
    """
    is_own = is_person(subject) and style_of(ridden) == "built-in"
    return None if is_own or hides_riders(ridden.noun) else mount(subject, ridden), ridden


def style_of(ridden: Actor) -> str:
    """Style in which something is ridden; most is sat on."""
    return trait_value("ridden", ridden.noun.name) or "sat on"


def mount(rider: Actor, ridden: Actor) -> Actor:
    """The rider, on what it rides."""
    style, size = style_of(ridden), size_of(rider.model)
    doing, up = trait_value("posture of riders", style)
    own_seat, props = trait_value("seats", ridden.noun.name), rider.props
    grips: Grips = ()
    if not is_person(rider):
        seat: Vector = (0.0, 0.0, find_support(ridden.model).height + rider.foot_m)
    elif own_seat is not None:
        x, y, z = scaled(own_seat, size_of(ridden.model))
        seat, doing = (x, y, z - _SEAT_M * size), "sit"
    elif style == "astride":
        seat, grips = _astride_back(ridden, size)
    else:
        support = find_support(ridden.model)
        seat = (*support.middle, support.height + up * size)
        props = list_props(doing) if style == "paddled" and ridden.is_mover else ()
    path = seated(ridden.track, seat, doing)
    return replace(
        rider, track=_gripping(path, grips), is_mover=ridden.is_mover, lead_m=0.0, props=props
    )


def _astride_back(ridden: Actor, size: float) -> tuple[Vector, Grips]:
    """On the back, a leg on each side, hands ahead."""
    model = ridden.model
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    back = float(top_heights(parts, np.zeros(1), np.zeros(1))[0])
    across = np.linspace(0.0, 0.5 * model.width, 24)
    inside = across[top_heights(parts, np.zeros_like(across), across) > 0.6 * back]
    half = float(inside.max()) if inside.size else 0.2
    side = min(half + 0.07 * size, 0.45 * size)
    drop = -0.66 * size if half < 0.45 * size else -0.35 * size
    return (0.0, 0.0, back), (
        ("hips", (0.0, 0.0, 0.10 * size)),
        ("left foot", (0.14 * size, side, drop)),
        ("right foot", (0.14 * size, -side, drop)),
        ("left hand", (0.40 * size, 0.10 * size, 0.30 * size)),
        ("right hand", (0.40 * size, -0.10 * size, 0.30 * size)),
    )
