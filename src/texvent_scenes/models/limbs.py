"""Limbs: knees between two points, arms and legs that channels place, legs, waving chains."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise, product
from typing import Any

import numpy as np

from texvent_scenes.models.channel_track import Numbers, Values
from texvent_scenes.models.gait import Steps, foot_path
from texvent_scenes.models.joints import Instant, read_cycle
from texvent_scenes.models.materials import Material
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.models.shapes import (
    Affine,
    Point,
    affine,
    limb,
    moved,
    placed_along,
    plank,
    point,
    rotation,
    shift,
    turn_about,
)
from texvent_scenes.models.surfaces import Painted


def bend(start: Point, end: Point, upper: float, lower: float, towards: Point) -> Point:
    """The knee or elbow between two points.

    Args:
        start: hip or shoulder, m.
        end: ankle or wrist, m.
        upper: length of thigh or upper arm, m.
        lower: length of shin or forearm, m.
        towards: direction in which the joint points (need not be a unit vector).

    Returns:
        The joint. If the two lengths cannot meet, the joint lies on the straight line.
    """
    span = (end[0] - start[0], end[1] - start[1], end[2] - start[2])
    reach = max(math.sqrt(sum(v * v for v in span)), 1e-9)
    along = (span[0] / reach, span[1] / reach, span[2] / reach)
    near = (reach * reach + upper * upper - lower * lower) / (2.0 * reach)
    near = min(max(near, -upper), reach)
    out = math.sqrt(max(upper * upper - near * near, 0.0))
    slope = sum(a * t for a, t in zip(along, towards, strict=True))
    side = [t - slope * a for a, t in zip(along, towards, strict=True)]
    norm = max(math.sqrt(sum(v * v for v in side)), 1e-9)
    x, y, z = (s + near * a + out * v / norm for s, a, v in zip(start, along, side, strict=True))
    return (x, y, z)


@dataclass(frozen=True)
class Limb:
    """Two bones from a root in a group to a point that channels say: an arm or a leg of a person.

    Its channels: `reach` and `spot`, the end as a vector from the root in the axes of `on` and as a
    point in those of `ground`, and `free`, the share of the first; they add up, so postures mix
    number by number. `bend` is the direction of elbow or knee, `pitch` the downward turn of the
    end and `roll` that to the right, `tool` the upright of a hand. All are forward, outward, up.
    `posture` makes them of those that tables of activities have.
    """

    name: str
    """Name of its end; its bones are "upper NAME" and "lower NAME"."""
    channels: str
    """Prefix of the names of its channels."""
    side: float
    """1 = left, -1 = right."""
    on: str
    root: Point
    bones: tuple[float, float]
    """Lengths of the upper and the lower part, m."""
    ground: str
    bends_in: str
    """Group in whose axes its joint points."""
    bend: Point
    """Usual direction of its joint."""
    holds: bool = False
    """Whether its end is a hand, and not a foot on the ground."""
    drawn: Mapping[str, str] = field(default_factory=dict)
    """Part lines of "upper" and "lower", z along the bone, and of "end"."""

    def posture(self, values: Values, steps: Steps | None = None) -> Values:
        """Its channels from those of a table of activities, all or none.

        The end is where `hand` or `foot` says; or where upper and lower part hang that `swing`
        turns forward. Where it has a `lead` it steps about that place.
        """
        said = {name: values.get(channel) for name, channel in self._channel_of.items()}
        end, is_free = said["hand"] or said["foot"], self.holds and said["fixed"] is None
        if end is None:
            if said["swing"] is None:
                return {}
            end = self._hang(said["swing"])
        (pitch,) = said["pitch"] or (0.0,)
        if said["lead"] is not None and steps is not None:
            x, z = foot_path(steps, said["lead"][0])
            end = (end[0] + x, end[1], end[2] + (said["rise"] or (1.0,))[0] * z)
            pitch += (said["toes"] or (0.0,))[0] * z / steps.gait.lift
        (roll,) = said["roll"] or (0.0,)
        bend = said["elbow"] or said["knee"]
        return self.at(end, bend, is_free=is_free, pitch=pitch, roll=roll)

    @cached_property
    def _channel_of(self) -> Mapping[str, str]:
        """Channel of a limb in tables → its name for this one."""
        return {name: f"{self.channels}.{name}" for name in _SAID}

    def at(
        self, end: Numbers, bend: Numbers | None = None, *, is_free: bool = False,
        pitch: float = 0.0, roll: float = 0.0,
    ) -> Values:  # fmt: skip
        """Its channels with the end at a point of the body, or that far from its root."""
        away, there = (end, (0.0,) * 3) if is_free else ((0.0,) * 3, end)
        found = {
            "reach": away, "spot": there, "free": (float(is_free),), "bend": bend or self.bend,
            "pitch": (pitch,), "roll": (roll,),
        }  # fmt: skip
        return {f"{self.channels}.{name}": numbers for name, numbers in found.items()}

    def _hang(self, swing: Numbers) -> Numbers:
        """Its end from its root: turns of upper and lower part forward, rad; outward, m."""
        upper, lower = self.bones
        first, second, out = swing
        forward = upper * math.sin(first) + lower * math.sin(second)
        return forward, out, -upper * math.cos(first) - lower * math.cos(second)

    def locate(self, now: Instant, maps: Mapping[str, Affine | None]) -> dict[str, Affine]:
        """Maps of its bones and its end to body coordinates, by their names."""
        trunk, ground, bending = (
            np.eye(3, 4) if (found := maps[name]) is None else found
            for name in (self.on, self.ground, self.bends_in)
        )
        free = now.channels[f"{self.channels}.free"]
        root = trunk @ np.array([self.root[0], self.side * self.root[1], self.root[2], 1.0])
        reach, spot = trunk[:, :3] @ self._read(now, "reach"), self._read(now, "spot")
        end = free * root + reach + ground @ np.array([*spot, 1.0 - free])
        end = _within(root, end, sum(self.bones))
        towards = bending[:, :3] @ self._read(now, "bend")
        joint = np.array(bend(point(root), point(end), *self.bones, point(towards)))
        if self.holds:
            turned = _held(trunk, end - joint, trunk[:, :3] @ self._read(now, "tool"))
        else:
            pitch, roll = (now.channels[f"{self.channels}.{one}"] for one in ("pitch", "roll"))
            turned = ground[:, :3] @ rotation("x", roll) @ rotation("y", pitch)
        return {
            f"upper {self.name}": placed_along(point(root), point(joint)),
            f"lower {self.name}": placed_along(point(joint), point(end)),
            self.name: affine(turned, end),
        }

    def draw(self, painted: Painted) -> dict[str, list[ModelPart]]:
        """Its parts, painted, by the names of what carries them."""
        return {
            self.name if bone == "end" else f"{bone} {self.name}": painted.draw_lines(lines)
            for bone, lines in self.drawn.items()
        }

    def _read(self, now: Instant, channel: str) -> Affine:
        x, y, z = (now.channels[f"{self.channels}.{channel}.{axis}"] for axis in range(3))
        return np.array([x, self.side * y, z])


_SAID = (
    "hand", "foot", "swing", "fixed", "elbow", "knee", "pitch", "roll", "lead", "rise", "toes",
)  # fmt: skip
"""Channels of a limb in tables of activities."""


def _within(start: Affine, end: Affine, reach: float) -> Affine:
    """The end, or the point of the sphere of that reach in its direction."""
    span = end - start
    long = math.sqrt(float(span @ span))
    return end if long <= reach else start + span * (reach / long)


def _held(trunk: Affine, along: Affine, upright: Affine) -> Affine:
    """[3, 3] axes of a hand: z along what it holds, x near the forearm."""
    upright = _unit(upright)
    ahead = along - (along @ upright) * upright
    if float(ahead @ ahead) < 0.05**2:
        ahead = trunk[:, 0] - (trunk[:, 0] @ upright) * upright
    (ux, uy, uz), (x, y, z) = upright, _unit(ahead)
    left = uy * z - uz * y, uz * x - ux * z, ux * y - uy * x
    return np.array([[x, left[0], ux], [y, left[1], uy], [z, left[2], uz]])


def _unit(vector: Affine) -> Affine:
    return vector / max(math.sqrt(float(vector @ vector)), 1e-9)


def read_limbs(rows: Sequence[Mapping[str, Any]]) -> tuple[Limb, ...]:
    """Limbs on both sides from rows with the fields of `Limb`."""
    return tuple(
        Limb(
            **{**row, "name": f"{word} {row['name']}", "channels": f"{word}{row['channels']}"},
            side=side,
        )
        for row in rows
        for word, side in (("left", 1.0), ("right", -1.0))
    )


DrawLegs = Callable[[Steps, Affine, Mapping[str, float]], list[ModelPart]]
"""Steps, map of the body, and channels → all legs."""


@dataclass(frozen=True)
class Legs:
    """Pairs of legs of one make; lengths in m."""

    surface: str
    pairs: tuple[tuple[float, ...], ...]
    """Left legs: root x y z, foot x y on the ground, and lead, cycles."""
    bones: tuple[float, float]
    """Lengths of the upper and the lower part."""
    radii: tuple[float, float]
    """Half thicknesses of them."""
    towards: Point
    """Direction of its knee."""
    ankle: float = 0.0
    """Height of the ankle above the ground."""
    foot: str = ""
    """Part lines around the ankle."""
    apart: float = 0.5
    """Lead of the right legs over the left ones, cycles: 0 = it hops."""
    leads: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    """Gait → lead of the left legs, and of the right ones over them; of others it is as above."""
    feet_by: Mapping[str, Point] = field(default_factory=dict)
    """Channel → displacement of the feet at 1; "left_" and "right_" before it are of one side."""
    knees_by: Mapping[str, Point] = field(default_factory=dict)
    """Channel → change of the direction of the knees at 1."""

    def drawn_in(self, painted: Painted) -> DrawLegs:
        """Draws all legs."""
        material, foot = painted.material(self.surface), painted.draw_lines(self.foot)

        def draw(steps: Steps, body: Affine, channels: Mapping[str, float]) -> list[ModelPart]:
            parts: list[ModelPart] = []
            knee_x, knee_y, knee_z = _blend(self.towards, self.knees_by, channels)
            for (x, y, z, foot_x, foot_y, lead), side in product(self.pairs, (1.0, -1.0)):
                own = _of_side(channels, "left_" if side > 0.0 else "right_")
                far_x, far_y, far_z = _blend((0.0, 0.0, 0.0), self.feet_by, own)
                lead, apart = self.leads.get(steps.name, (lead, self.apart))
                ahead = lead + (0.0 if side > 0.0 else apart)
                step, lift = foot_path(steps, ahead)
                root = point(body @ np.array([x, side * y, z, 1.0]))
                ankle: Point = (
                    foot_x + step + far_x, side * (foot_y + far_y), self.ankle + lift + far_z
                )  # fmt: skip
                knee = bend(root, ankle, *self.bones, (knee_x, side * knee_y, knee_z))
                parts += [
                    limb(material, root, knee, self.radii[0]),
                    limb(material, knee, ankle, self.radii[1]),
                    *moved(foot, shift(*ankle)),
                ]
            return parts

        return draw


def _of_side(channels: Mapping[str, float], side: str) -> Mapping[str, float]:
    """Channels with those of a side by the names of both."""
    own = {name.removeprefix(side): value for name, value in channels.items()
           if name.startswith(side)}  # fmt: skip
    return {**channels, **own}


def _blend(start: Point, by: Mapping[str, Point], channels: Mapping[str, float]) -> Point:
    """A point shifted as far as channels say."""
    x, y, z = start
    for name, (far_x, far_y, far_z) in by.items():
        amount = channels.get(name, 0.0)
        x, y, z = x + amount * far_x, y + amount * far_y, z + amount * far_z
    return x, y, z


@dataclass(frozen=True)
class Chain:
    """Links from joint to joint along which a wave runs: a tail, a cord, an arm, a cloth."""

    surface: str
    start: Point
    step: Point
    """Vector from one joint to the next at rest, m."""
    links: int
    radii: tuple[float, float]
    """Radii of the first and the last link, m."""
    wave: str
    """Axis along which it waves, reach at its end, m, and the words of its rate."""
    lag: float
    """Lag of each joint's wave behind that of the joint before, cycles."""
    grows: float = 1.0
    """Power of the share of the length with which the reach grows; 0 = the same all along."""
    curl: float = 0.0
    """Upward turn of each link from the one before, rad."""
    tall: float = 0.0
    """Height of upright planks, m; 0 = the links are round."""
    around: int = 1
    """Number of such chains around the upright axis."""
    beads: str = ""
    """Part lines around each joint but the first."""
    head: str = ""
    """Part lines around the first joint."""

    def drawn_in(self, painted: Painted) -> Callable[[Instant, Any], list[ModelPart]]:
        """Draws all links."""
        material = painted.material(self.surface)
        beads, head = painted.draw_lines(self.beads), painted.draw_lines(self.head)
        axis, reach, *rate = self.wave.split()
        cycle = read_cycle(rate)

        def draw(now: Instant, _: Any) -> list[ModelPart]:
            parts: list[ModelPart] = []
            for turn in range(self.around):
                cycles = cycle(now) + 2.0 * turn / self.around
                joints = self._joints(axis, float(reach), cycles)
                drawn = moved(head, shift(*joints[0]))
                for index, (a, b) in enumerate(pairwise(joints)):
                    drawn += [self._link(material, a, b, index), *moved(beads, shift(*b))]
                parts += moved(drawn, turn_about("z", 2.0 * math.pi * turn / self.around))
            return parts

        return draw

    def _link(self, material: Material, start: Point, end: Point, index: int) -> ModelPart:
        share = index / max(self.links - 1, 1)
        radius = self.radii[0] + share * (self.radii[1] - self.radii[0])
        if self.tall:
            upright, thick = (0.0, 0.0, self.tall), (0.0, 2.0 * radius, 0.0)
            return plank(material, start, end, chord=upright, thickness=thick)
        return limb(material, start, end, radius)

    def _joints(self, axis: str, reach: float, cycles: float) -> list[Point]:
        across, up = math.hypot(*self.step[:2]), self.step[2]
        long, rise = math.hypot(across, up), math.atan2(up, across)
        ahead = (self.step[0] / across, self.step[1] / across) if across > 0.0 else (0.0, 0.0)
        x, y, z = self.start
        joints: list[Point] = []
        for index in range(self.links + 1):
            swing = math.sin(2.0 * math.pi * (cycles - self.lag * index))
            off = reach * (index / self.links) ** self.grows * swing
            joints.append(
                (x + off * (axis == "x"), y + off * (axis == "y"), z + off * (axis == "z"))
            )
            tilt = rise + self.curl * index
            x += long * math.cos(tilt) * ahead[0]
            y += long * math.cos(tilt) * ahead[1]
            z += long * math.sin(tilt)
        return joints


def read_legs(table: Mapping[str, Any], painted: Painted) -> list[DrawLegs]:
    """The legs of a noun's table: each of `legs` has the fields of `Legs`."""
    legs = []
    for one in table.get("legs", ()):  # pairs are lines of six numbers
        rows = (map(float, row.split()) for row in one["pairs"].splitlines() if row.strip())
        legs.append(Legs(**{**one, "pairs": tuple(map(tuple, rows))}).drawn_in(painted))
    return legs
