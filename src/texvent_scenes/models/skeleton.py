"""Skeleton of a model: groups of parts on joints, one group on another, all on the body.

A group begins with a line of part lines: "moving JOINT, JOINT, ...", the outermost joint first.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from texvent_scenes.models.activities import find_channels
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
from texvent_scenes.models.limbs import DrawLegs, Steps, Walk
from texvent_scenes.models.part_lines import Placed
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.models.shapes import Affine, Point, affine, compose, moved, point


@dataclass(frozen=True)
class Group:
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

    on: str
    """Name of a group; "ground" = none."""
    at: Point
    """In that group, m."""
    is_level: bool = False
    """Whether its axes are those of the body, and not of the group."""

    def locate(self, motions: Mapping[str, Affine | None]) -> Affine:
        """[3, 4] axes at the place, in body coordinates, by the maps of named groups."""
        motion = motions.get(self.on)
        if motion is None:
            motion = np.eye(3, 4)
        turn = np.eye(3) if self.is_level else motion[:, :3]
        return affine(turn, motion @ np.array([*self.at, 1.0]))


def read_anchor(text: str, groups: Sequence[Group]) -> Anchor:
    """An anchor from its text, such as "head .1 0 .36", or "head .1 0 .36 level".

    It is on one of the groups that have names, or on "ground".

    Raises:
        ValueError: it cannot be read.
    """
    on, *place_words = text.split()
    is_level = place_words[-1:] == ["level"]
    known = {"ground", *(one.name for one in groups if one.name)}
    if on not in known:
        raise ValueError(f"anchor {text!r} must be on one of {', '.join(sorted(known))}")
    return Anchor(on, point([read_number(one) for one in place_words[:3]]), is_level)


def read_group(how: str, parts: tuple[Placed, ...], names: Collection[str]) -> Group:
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
    return Group(parts, tuple(joints), name, on, resting, light, clip, is_paired)


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


@dataclass(frozen=True)
class Body:
    """One body on its skeleton, at its usual size."""

    seed: int
    acts: str
    """Table of its activities."""
    rigid: Sequence[ModelPart]
    """Parts that stay in the body."""
    groups: Sequence[tuple[Group, Sequence[ModelPart]]]
    """Groups with their parts, painted; each is on the body or on one before it."""
    extras: Sequence[Callable[[Instant], Sequence[ModelPart]]]
    """Chains and riders."""
    joints: tuple[Joint, ...]
    """Joints that carry the whole body."""
    wave: Callable[[ModelPart, Instant], ModelPart] | None
    walk: Walk | None
    legs: Sequence[DrawLegs]
    anchors: Mapping[str, Anchor]

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
        now, steps = self._observe(pose)
        body, motions, _ = self._locate_groups(now)
        parts = list(self.rigid) if self.moves_all else []
        if self.wave is not None:
            parts = [self.wave(part, now) for part in parts]
        parts = _carried(parts, body)
        for (group, shapes), motion in zip(self.groups, motions, strict=True):
            parts += group.draw(shapes, now, motion)
        parts += _carried([part for draw in self.extras for part in draw(now)], body)
        if steps is not None:
            upright = np.eye(3, 4) if body is None else body
            parts += [one for draw in self.legs for one in draw(steps, upright, now.channels)]
        return parts

    def locate(self, name: str, pose: Pose) -> Affine | None:
        """Axes [3, 4] at a named place; "other" is the one that a name without its own means."""
        anchor = self.anchors.get(name, self.anchors.get("other"))
        if anchor is None:
            return None
        now, _ = self._observe(pose)
        return anchor.locate(self._locate_groups(now)[2])

    def _observe(self, pose: Pose) -> tuple[Instant, Steps | None]:
        """State that joints follow, and steps of legs."""
        channels = find_channels(
            self.acts, pose.activity, pose.time_s, before=pose.before, share=pose.share
        )
        if self.walk is None:
            return Instant(pose, self.seed, channels), None
        steps = self.walk.steps(pose, self.seed)
        channels |= {"step": steps.amount, "run" if steps.runs else "walk": steps.amount}
        return Instant(pose, self.seed, channels, steps.strides), steps

    def _locate_groups(
        self, now: Instant
    ) -> tuple[Affine | None, list[Affine | None], Mapping[str, Affine | None]]:
        """Maps to body coordinates: of the body, of all groups, and of those with names."""
        body = place(self.joints, now) if self.joints else None
        motions, named = list[Affine | None](), {"": body}
        for group, _ in self.groups:
            motions.append(group.locate(now, named[group.on]))
            if group.name:
                named[group.name] = motions[-1]
        return body, motions, named


def _carried(parts: list[ModelPart], carrier: Affine | None) -> list[ModelPart]:
    return parts if carrier is None else moved(parts, carrier)
