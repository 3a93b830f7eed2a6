"""Relation check: relations and directions of a scene that its bodies do not realise.

Boxes around the bodies at a few instants decide; what holds at one instant holds, but for "on" and
"in". Left, right, front and behind are those of the image.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from texvent.scenes.description import RELATIONS, SceneDescription
from texvent.scenes.models.tables import nouns_with
from texvent.scenes.scene import Camera, Float64Array, Primitives, Shape
from texvent.scenes.spec.scene import SceneObject

_TRAVELS = frozenset({"move", "walk", "run", "drive", "fly", "swim", "sail", "paddle", "slide",
                      "roll", "crawl", "rise", "sink"})  # fmt: skip
_DIRECTED = _TRAVELS | {"hover", "float", "bounce", "jump", "fall"}
_LEAST_WAY, _MOST_COPIES = 0.1, 0.75
"""Way, in sizes of a body, that is motion; share of a subject's copies in a relation."""
_AXES = {"left": (0, -1), "right": (0, 1), "up": (1, -1), "down": (1, 1), "towards": (2, -1),
         "away": (2, 1), "across": (0, 0)}  # fmt: skip
"""Direction → axis of the camera (right, down, forward) and sign; 0: either one."""


class Unheld(NamedTuple):
    """A word of a scene that no instant shows."""

    kind: str
    """"relation", "direction", "motion", "noun", "effect" or a field of light or place."""
    value: str
    """Such as "under", "left" or "snow"."""
    line: str
    """For the report, such as "the ball under the chair"."""


class Body(NamedTuple):
    """Boxes around a body at the instants of a clip; arrays [t, 3]."""

    middle: Float64Array
    """m."""
    size: Float64Array
    """Extents, m."""
    parts: Float64Array
    """[k, 2, 3] boxes around its shapes at the first instant, m."""
    seen: Float64Array
    """Middle in the image: tangents to the right and downwards, and depth, m."""
    way: Float64Array
    """[3] from the first place to the last along the camera's axes of mid clip, m."""

    @property
    def is_still(self) -> bool:
        """Whether it stays in its place."""
        far = np.linalg.norm(self.middle - self.middle[0], axis=1).max()
        return bool(far <= _LEAST_WAY * self.size.max())


def bodies_of(
    shots: Sequence[tuple[Primitives, Camera]], instances: Sequence[int]
) -> dict[int, Body]:
    """Instance id → its body; one without shapes, as a hidden rider, has none."""
    boxes = [_boxes(shapes) for shapes, _ in shots]
    found = {}
    for one in instances:
        own = [box[shapes.instance == one] for box, (shapes, _) in zip(boxes, shots, strict=True)]
        if not all(map(len, own)):
            continue
        low = np.array([box[:, 0].min(axis=0) for box in own])
        high = np.array([box[:, 1].max(axis=0) for box in own])
        middle = 0.5 * (low + high)
        seen = np.array([camera.rotation @ (place - camera.position)
                         for place, (_, camera) in zip(middle, shots, strict=True)])  # fmt: skip
        seen[:, :2] /= np.maximum(seen[:, 2:], 1e-3)
        way = shots[len(shots) // 2][1].rotation @ (middle[-1] - middle[0])
        found[one] = Body(middle, high - low, own[0], seen, way)
    return found


def _boxes(shapes: Primitives) -> Float64Array:
    """[n, 2, 3] least and greatest coordinates of every shape, m."""
    axes, middle = shapes.to_world[:, :, :3], shapes.to_world[:, :, 3]
    is_round = (shapes.shape == Shape.ELLIPSOID)[:, None]
    half = np.where(is_round, np.linalg.norm(axes, axis=2), np.abs(axes).sum(axis=2))
    return np.stack([middle - half, middle + half], axis=1)


Copies = Sequence[Sequence[Body]]
"""Bodies of each object."""


def find_unheld(
    description: SceneDescription, bodies: Mapping[int, Body], object_of: Mapping[int, int]
) -> Iterator[Unheld]:
    """What the bodies do not realise; without a line where a body is out of view."""
    copies = [
        [body for one, body in bodies.items() if object_of[one] == index]
        for index in range(len(description.objects))
    ]
    yield from _unrelated(description, copies)
    led = {target for one in description.relations for target in one.targets}
    for index, thing in enumerate(description.objects):
        others = [body for n, group in enumerate(copies) if n != index for body in group]
        if copies[index]:
            yield from _unmoved(thing, copies[index], others, is_led=index in led)


def _unrelated(description: SceneDescription, copies: Copies) -> Iterator[Unheld]:
    names = [f"the {one.noun.removeprefix('parked ')}" for one in description.objects]
    sent = {one.subject: one.targets[0] for one in description.relations
            if one.kind in ("kick", "throw")}  # fmt: skip
    for one in description.relations:
        who = sent.get(one.subject, one.subject) if one.kind == "towards" else one.subject
        own, others = copies[who], [body for t in one.targets for body in copies[t]]
        nouns = [description.objects[n].noun for n in (one.subject, one.targets[0])]
        side = description.objects[one.subject].placement
        if one.kind in ("past", "overtake") and side in ("left", "right"):
            yield Unheld("placement", side, f"{names[one.subject]} passing on the {side}")
        is_flat = one.kind == "on" and nouns_with("flat pattern").issuperset(nouns)
        rule = _RULES.get("in" if is_flat else one.kind)
        if one.kind == "wear" and not own:
            yield Unheld("noun", nouns[1], f"{names[one.targets[0]]} on {names[who]}")
        if rule is None or one.subject in one.targets or (one.kind == "ride" and not own):
            continue
        if not own or not others:
            yield Unheld("relation", one.kind, "")
        elif sum(rule(body, others) for body in own) < _MOST_COPIES * len(own):
            said = RELATIONS.get(one.kind, one.kind)
            targets = " and ".join(names[target] for target in one.targets)
            yield Unheld("relation", one.kind, f"{names[one.subject]} {said} {targets}")


def _unmoved(
    thing: SceneObject, own: Sequence[Body], others: Sequence[Body], *, is_led: bool
) -> Iterator[Unheld]:
    """Side, way and direction of an object that its copies do not have."""
    name, motion = f"the {thing.noun.removeprefix('parked ')}", thing.motion
    if thing.placement in ("left", "right") and others:
        middle, rest = (np.mean([one.seen[:, 0] for one in group]) for group in (own, others))
        if (middle < rest) != (thing.placement == "left"):
            yield Unheld("placement", thing.placement, f"{name} on the {thing.placement}")
    if motion is None or is_led:
        return
    gone = [one.kind for one in thing.motions if one.kind in _TRAVELS]
    if gone and all(one.is_still for one in own):
        yield from (Unheld("motion", kind, f"{name}'s way: it stays in its place") for kind in gone)
    elif len(thing.motions) == 1 and motion.kind in _DIRECTED and motion.direction in _AXES:
        axis, sign = _AXES[motion.direction]
        ways = [sign * one.way[axis] if sign else abs(one.way[axis]) for one in own]
        sizes = [max(float(np.linalg.norm(one.way)), 1e-6) for one in own]
        if not any(way >= 0.33 * size for way, size in zip(ways, sizes, strict=True)):
            yield Unheld("direction", motion.direction, f"{name} going {motion.direction}")


_Flags = NDArray[np.bool_]
_Rule = Callable[[Body, Sequence[Body]], bool]


def _at_once(rule: Callable[[Body, Body], _Flags]) -> _Rule:
    """Whether a rule of instants [t] holds at one of them, for one of the targets."""
    return lambda one, others: any(bool(rule(one, other).any()) for other in others)


def _mostly(rule: Callable[[Body, Body], _Flags]) -> _Rule:
    """Whether it holds at half of the instants at least, for one of the targets."""
    return lambda one, others: any(bool(rule(one, other).mean() >= 0.5) for other in others)


def _within(one: Body, other: Body, axes: int, share: float = 0.0) -> _Flags:
    """Whether its middle is in the other's box, grown by a share of its own size, along `axes`."""
    room = 0.55 * other.size + share * one.size + 0.02
    return np.asarray((np.abs(one.middle - other.middle) <= room)[:, :axes].all(axis=1))


def _clears(one: Body, other: Body, share: float) -> Float64Array:
    """[t] height of its lowest point above a level of the other, -0.5 below to 0.5 on top, m."""
    level = other.middle[:, 2] + share * other.size[:, 2]
    return np.asarray(one.middle[:, 2] - 0.5 * one.size[:, 2] - level)


def _columns(one: Body, other: Body) -> _Flags:
    """[t, k] whether its middle is above or below each part of the other."""
    middle = one.middle[:, None, :2]
    return np.asarray(
        ((other.parts[:, 0, :2] < middle) & (other.parts[:, 1, :2] > middle)).all(axis=2)
    )


def _is_on(one: Body, other: Body) -> _Flags:
    """Whether it is over its upper half and not above it, or right on a part of it."""
    room = 0.5 * one.size[:, 2] + 0.05 + np.ptp(one.middle[:, 2])  # it may bounce
    is_over = (_clears(one, other, 0.5) <= room) & (one.middle[:, 2] >= other.middle[:, 2])
    foot = (one.middle - 0.5 * one.size)[:, 2:]
    is_top = np.asarray(np.abs(other.parts[:, 1, 2] - foot) <= room[:, None])
    is_part = np.any(_columns(one, other) & is_top, axis=1)
    return np.asarray((_within(one, other, 2) & is_over) | is_part)


def _is_under(one: Body, other: Body) -> _Flags:
    """Whether a part of the other is above it, and none where it is itself."""
    low, high = other.parts[:, 0], other.parts[:, 1]
    middle, slim = one.middle[:, None], 0.4 * one.size[:, None]
    is_met = ((low < middle + slim) & (high > middle - slim)).all(axis=2)
    is_roof = _columns(one, other) & np.asarray(low[:, 2] >= middle[:, :, 2])
    return np.asarray(~np.any(is_met, axis=1) & np.any(is_roof, axis=1))


def _aside(one: Body, other: Body) -> Float64Array:
    """[t] how far it is to the other's right in the image, in half widths of both."""
    half = sum(0.5 * body.size[:, :2].max(axis=1) / np.maximum(body.seen[:, 2], 1e-3)
               for body in (one, other))  # fmt: skip
    return np.asarray((one.seen - other.seen)[:, 0] / half)


def _is_deeper(sign: int) -> _Rule:
    return _at_once(lambda one, other: (np.abs(_aside(one, other)) <= 1.5)
                    & (sign * (one.seen - other.seen)[:, 2] > 0.0))  # fmt: skip


def _recedes(sign: int) -> _Rule:
    """Whether the distance grows, or shrinks."""

    def rule(one: Body, other: Body) -> _Flags:
        away = np.linalg.norm(one.middle - other.middle, axis=1)
        return np.asarray(sign * (away - away[0]) > _LEAST_WAY * one.size.max())

    return _at_once(rule)


def _passes(share: float, beside: float = 0.5) -> _Rule:
    """Whether its way leads past the other, at most a share of that one's size beside it.

    It may begin and end that far from the other's middle, in sizes of both.
    """

    def rule(one: Body, other: Body) -> _Flags:
        off = one.middle - other.middle
        length = float(np.linalg.norm(off[-1] - off[0]))
        way = (off[-1] - off[0]) / max(length, 1e-9)
        aside = float(np.linalg.norm(off[0] - (off[0] @ way) * way))
        is_near = aside <= share * other.size.max() + 0.1 and length > _LEAST_WAY * one.size.max()
        room = beside * (one.size.max() + other.size.max())
        return np.array([is_near and off[0] @ way < room and off[-1] @ way > -room])

    return _at_once(rule)


def _is_between(one: Body, others: Sequence[Body]) -> bool:
    """Whether two of them are on both sides."""
    for first, second in ((a, b) for a in others for b in others if a is not b):
        line, off = second.middle - first.middle, one.middle - first.middle
        share = ((off * line).sum(axis=1) / (line * line).sum(axis=1))[:, None]
        beside = np.linalg.norm(off - share * line, axis=1) / np.linalg.norm(line, axis=1)
        if ((beside <= 0.4) & (share[:, 0] > 0.1) & (share[:, 0] < 0.9)).any():
            return True
    return False


def _is_around(one: Body, other: Body) -> _Flags:
    """Whether it goes half of the way around, or stays, as in a ring."""
    x, y = (one.middle - other.middle)[:, :2].T
    return np.array([np.ptp(np.unwrap(np.arctan2(y, x))) >= 1.05 * np.pi or one.is_still])


_RULES: Mapping[str, _Rule] = {
    "on": _mostly(_is_on), "under": _at_once(_is_under), "between": _is_between,
    "in": _mostly(lambda one, other: _within(one, other, 3)),
    "ride": _mostly(lambda one, other: _within(one, other, 2, 0.5)),
    "above": _at_once(lambda one, other: _within(one, other, 2, 0.5)
                      & (_clears(one, other, 0.4) >= 0.0)),
    "behind": _is_deeper(1), "front": _is_deeper(-1),
    "left of": _at_once(lambda one, other: _aside(one, other) <= -0.5),
    "right of": _at_once(lambda one, other: _aside(one, other) >= 0.5),
    "around": _at_once(_is_around), "past": _passes(3.0), "overtake": _passes(3.0, 0.0),
    "through": _passes(0.5, 0.0), "towards": _recedes(-1), "away from": _recedes(1),
    "from": _recedes(1),
}  # fmt: skip
"""Kind of relation → whether a body is so to others; "with" and acts have none."""
