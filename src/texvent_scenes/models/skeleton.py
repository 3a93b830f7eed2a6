"""Skeleton of a model: groups of parts on joints, one group on another, all on the body.

A group begins with a line of part lines: "moving JOINT, JOINT, ...", the outermost joint first.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from texvent_scenes.models.gait import Steps, Walk
from texvent_scenes.models.joints import (
    RESTING,
    Instant,
    Joint,
    LightModulation,
    place,
    read_joint,
    read_light,
    read_number,
)
from texvent_scenes.models.limbs import DrawLegs, Limb
from texvent_scenes.models.part_lines import Placed, read_groups, read_parts
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.models.shapes import Affine, Point, affine, compose, moved

Maps = Mapping[str, Affine | None]
"""Name of a group → its map to body coordinates; None leaves all where it is."""


@dataclass(frozen=True)
class PartGroup:
    """Parts that move together."""

    parts: tuple[Placed, ...]
    joints: tuple[Joint, ...] = ()
    """From the body, or the group that it is on; outermost first."""
    name: str = ""
    on: str = ""
    """Name of the group that carries it; "" = the body."""
    at_rest: tuple[Joint, ...] | None = None
    """Its joints while the body stays where it is; None = the same."""
    light: LightModulation | None = None
    clip: tuple[int, float, float] | None = None
    """Axis, least and greatest coordinate between which its boxes are seen, m."""
    is_paired: bool = False
    """Whether the other side of the body has the same."""
    is_usual: bool = False
    """Whether only a body of a usual colour has it."""

    def locate(self, now: Instant, carrier: Affine | None) -> Affine | None:
        """Map of its parts to body coordinates; `carrier` is that of what it is on.

        None is the map that leaves all where it is.
        """
        is_resting = self.at_rest is not None and now.pose.activity in RESTING
        joints = self.at_rest if self.at_rest is not None and is_resting else self.joints
        if not joints:
            return carrier
        own = place(joints, now)
        return own if carrier is None else compose(carrier, own)

    def draw(
        self, parts: Sequence[ModelPart], now: Instant, motion: Affine | None
    ) -> list[ModelPart]:
        """Its parts, painted, where a motion carries them."""
        lit = self.light.shine(parts, now) if self.light else list(parts)
        there = lit if motion is None else moved(lit, motion)
        if self.clip is not None:
            there = [_clip(one, *self.clip) for one in there]
        return [*there, *_mirrored(there)] if self.is_paired else there


@dataclass(frozen=True)
class Anchor:
    """A place of a body for other things."""

    on: tuple[str, ...]
    """Names of groups, between which it is in the middle; "ground" = none."""
    at: Point
    """In that group, m."""
    faces: str | None = None
    """Group whose x its upright axes face; None = its axes are those of the group that it is on."""

    def locate(self, maps: Maps) -> Affine:
        """[3, 4] axes at the place, in body coordinates, by the maps of named groups."""
        carriers = [_find(maps, name) for name in self.on]
        place = np.array([*self.at, 1.0])
        origin = sum(one @ place for one in carriers) / len(carriers)
        turn = carriers[0][:, :3] if self.faces is None else _level(_find(maps, self.faces)[:, 0])
        return affine(turn, origin)


def _find(maps: Maps, name: str) -> Affine:
    found = maps.get(name)
    return np.eye(3, 4) if found is None else found


def _level(forward: Affine) -> Affine:
    """[3, 3] upright axes that face `forward`."""
    x, y = map(float, forward[:2])
    long = math.hypot(x, y)
    x, y = (x / long, y / long) if long > 0.1 else (1.0, 0.0)
    return np.array([[x, -y, 0.0], [y, x, 0.0], [0.0, 0.0, 1.0]])


def read_anchor(text: str, names: Collection[str]) -> Anchor:
    """An anchor from its text, such as "head .1 0 .36", "head .1 0 .36 level" or "left hand + ...".

    It is on parts that have these names, or on "ground". Where it is level its axes are those of
    the body, or upright ones that face as a part whose name follows.

    Raises:
        ValueError: it cannot be read.
    """
    where, level, faces = text.partition(" level")
    *words, x, y, z = where.split()
    on = tuple(map(str.strip, " ".join(words).split("+")))
    known = {"ground", *names}
    if not known.issuperset((*on, faces.strip() or "ground")):
        raise ValueError(f"anchor {text!r} must be on one of {', '.join(sorted(known))}")
    place_m = read_number(x), read_number(y), read_number(z)
    return Anchor(on, place_m, (faces.strip() or "ground") if level else None)


def read_skeleton(
    texts: Iterable[tuple[str, bool]],
) -> tuple[tuple[Placed, ...], tuple[PartGroup, ...]]:
    """Parts that stay in the body, and groups of those that move.

    Args:
        texts: part lines, each with whether only a body of a usual colour has them.

    Raises:
        ValueError: a line cannot be read.
    """
    split = [(read_groups(text), is_usual) for text, is_usual in texts]
    rigid, wheels = read_parts("\n".join(first[1] for (first, *_), _ in split))
    groups, names = list[PartGroup](), set[str]()
    for (how, lines), is_usual in (
        (one, is_usual) for (_, *more), is_usual in split for one in more
    ):
        parts, more = read_parts(lines)
        group = replace(read_group(how, parts, names), is_usual=is_usual)
        if not how or not (parts or more or group.name):
            raise ValueError(f"'moving {how}' needs a joint or a light, and parts below it")
        groups.append(group)
        names.add(group.name)
        wheels += more
    return rigid, (*groups, *(PartGroup(shapes, (joint,)) for shapes, joint in wheels))


def read_group(how: str, parts: tuple[Placed, ...], names: Collection[str]) -> PartGroup:
    """A group from the words after "moving"; it may be on one of those that have these names.

    Raises:
        ValueError: it cannot be read.
    """
    joints: list[Joint] = []
    at_rest: list[Joint] | None = None
    light, clip, is_paired, name, on = None, None, False, "", ""
    for item in map(str.strip, how.rstrip(",").split(",")):
        first, _, rest = item.partition(" ")
        if first == "on":
            if rest not in names:
                raise ValueError(f"no moving part before it has the name {rest!r}")
            on = rest
        elif first == "called":
            name = rest
        elif first == "light":
            light = read_light(rest)
        elif first == "clip":
            axis, low, high = rest.split()
            clip = "xyz".index(axis), float(low), float(high)
        elif item == "pair":
            is_paired = True
        elif item == "at rest":
            at_rest = []
        else:
            (joints if at_rest is None else at_rest).append(read_joint(item))
    resting = None if at_rest is None else tuple(at_rest)
    return PartGroup(parts, tuple(joints), name, on, resting, light, clip, is_paired)


_MIRROR = np.array([1.0, -1.0, 1.0])
_TURNED_BACK = np.array([-1.0, 1.0, 1.0, 1.0])
"""Signs of the columns of a map: its first axis the other way round."""


def _mirrored(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """The same parts on the other side of the body, their surfaces not turned inside out."""
    return [each.at(_MIRROR[:, None] * each.to_body * _TURNED_BACK) for each in parts]


_SLIVER_M = 5e-5
"""Half of what is left of a box that is not seen."""


def _clip(box: ModelPart, axis: int, low: float, high: float) -> ModelPart:
    """A box along the axes, cut off at two planes across one of them."""
    to_body = box.to_body.copy()
    middle, half = to_body[axis, 3], to_body[axis, axis]
    first, last = max(middle - half, low), min(middle + half, high)
    to_body[axis, axis] = max(0.5 * (last - first), _SLIVER_M)
    to_body[axis, 3] = min(max(0.5 * (first + last), low + _SLIVER_M), high - _SLIVER_M)
    return box.at(to_body)


_Located = tuple[Affine | None, list[Affine | None], Maps]
"""Maps to body coordinates: of the body, of all groups, and of all that has a name."""


@dataclass(frozen=True)
class Body:
    """One body on its skeleton, at its usual size."""

    seed: int
    observe: Callable[[Pose, int], Mapping[str, float]]
    """Channels of its activity at a pose, by its seed."""
    groups: Sequence[tuple[PartGroup, Sequence[ModelPart]]]
    """Groups with their parts, painted; each is on the body or on one before it."""
    anchors: Mapping[str, Anchor]
    extras: Sequence[Callable[[Instant, Maps], Sequence[ModelPart]]]
    """Chains, riders and skirts, by the maps of named groups."""
    rigid: Sequence[ModelPart] = ()
    """Parts that stay in the body."""
    limbs: Sequence[tuple[Limb, Mapping[str, Sequence[ModelPart]]]] = ()
    """Limbs with their parts, painted."""
    joints: tuple[Joint, ...] = ()
    """Joints that carry the whole body."""
    wave: Callable[[ModelPart, Instant], ModelPart] | None = None
    walk: Walk | None = None
    legs: Sequence[DrawLegs] = ()
    _latest: dict[str, tuple[Pose, tuple[Instant, Steps | None, _Located]]] = field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def moves_all(self) -> bool:
        """Whether nothing of it stays where it is."""
        return self.wave is not None or bool(self.joints or self.legs)

    @property
    def rests(self) -> bool:
        """Whether it looks different at rest."""
        return self.moves_all or any(one.at_rest is not None for one, _ in self.groups)

    def articulate(self, pose: Pose) -> list[ModelPart]:
        """All parts that move, at that pose."""
        return self._draw(*self._stand(pose))

    def draw(self, now: Instant, steps: Steps | None = None) -> list[ModelPart]:
        """All parts that move, at an instant."""
        return self._draw(now, steps, self._locate_groups(now))

    def _draw(self, now: Instant, steps: Steps | None, groups: _Located) -> list[ModelPart]:
        body, motions, named = groups
        parts = list(self.rigid) if self.moves_all else []
        if self.wave is not None:
            parts = [self.wave(part, now) for part in parts]
        parts = _carried(parts, body)
        for (group, shapes), motion in zip(self.groups, motions, strict=True):
            parts += group.draw(shapes, now, motion)
        parts += _carried([part for draw in self.extras for part in draw(now, named)], body)
        for _, drawn in self.limbs:
            for name, shapes in drawn.items():
                parts += _carried(list(shapes), named[name])
        if steps is not None:
            upright = np.eye(3, 4) if body is None else body
            parts += [one for draw in self.legs for one in draw(steps, upright, now.channels)]
        return parts

    def locate(self, name: str, pose: Pose) -> Affine | None:
        """Axes [3, 4] at a named place; "other" is the one that a name without its own means."""
        anchor = self._anchor_of(name)
        return None if anchor is None else anchor.locate(self._stand(pose)[2][2])

    def locate_at(self, name: str, now: Instant) -> Affine | None:
        """The same at an instant."""
        anchor = self._anchor_of(name)
        return None if anchor is None else anchor.locate(self._locate_groups(now)[2])

    def _anchor_of(self, name: str) -> Anchor | None:
        return self.anchors.get(name, self.anchors.get("other"))

    def map_groups(self, pose: Pose) -> Maps:
        """Maps to body coordinates of all that has a name: groups, bones, ends of limbs."""
        return self._stand(pose)[2][2]

    def _stand(self, pose: Pose) -> tuple[Instant, Steps | None, _Located]:
        """State and maps at a pose; the latest are kept, as parts and places are asked for in turn.

        A tuple takes the place of another at once, so that threads may ask for different poses.
        """
        latest = self._latest.get("pose")
        if latest is None or latest[0] != pose:
            now, steps = self._observe(pose)
            latest = pose, (now, steps, self._locate_groups(now))
            self._latest["pose"] = latest
        return latest[1]

    def _observe(self, pose: Pose) -> tuple[Instant, Steps | None]:
        """State that joints follow, and steps of legs."""
        channels = self.observe(pose, self.seed)
        if self.walk is None:
            return Instant(pose, self.seed, channels), None
        steps = self.walk.steps(pose, self.seed)
        sizes = {"step": steps.amount, "run" if steps.name == "run" else "walk": steps.amount}
        channels = {**channels, **sizes}
        return Instant(pose, self.seed, channels, steps.strides), steps

    def _locate_groups(self, now: Instant) -> _Located:
        """Maps to body coordinates: of the body, of all groups, and of all that has a name."""
        body = place(self.joints, now) if self.joints else None
        motions, named = list[Affine | None](), {"": body}
        for group, _ in self.groups:
            motions.append(group.locate(now, named[group.on]))
            if group.name:
                named[group.name] = motions[-1]
        for limb, _ in self.limbs:
            named |= limb.locate(now, named)
        return body, motions, named


def _carried(parts: list[ModelPart], carrier: Affine | None) -> list[ModelPart]:
    return parts if carrier is None else moved(parts, carrier)
