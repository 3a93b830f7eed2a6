"""Figures: bodies given as data whose groups of parts move in joints, on legs and in chains."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.bodies.joints import RESTING, read_body_joint, read_wave
from texvent.scenes.models.bodies.limbs import Chain, Steps, read_legs, steps_at
from texvent.scenes.models.joints import Joint, place
from texvent.scenes.models.limb_kinematics import Gait
from texvent.scenes.models.materials import BLACK, WHITE, Material, shade
from texvent.scenes.models.part_lines import read_parts
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.models.shapes import Affine, ball, moved, part, shift
from texvent.scenes.models.surfaces import read_colour, read_surface
from texvent.scenes.models.variation import between, choose, fraction
from texvent.scenes.scene import Colour

FIXED_HUES: Mapping[str, Colour] = {"black": BLACK, "white": WHITE}
"""Colours that every body may name."""


@dataclass(frozen=True)
class Painted:
    """The colours of one body, and the surfaces that they give."""

    hues: Mapping[str, Colour]
    surfaces: Mapping[str, str]
    """Name → words of a surface."""
    made: dict[str, Material] = field(default_factory=dict)

    def material(self, name: str) -> Material:
        """The surface of that name, or that these words mean."""
        if name not in self.made:
            self.made[name] = read_surface(self.surfaces.get(name, name), self.hues)
        return self.made[name]

    def draw(self, lines: str) -> list[ModelPart]:
        """The parts of some lines."""
        placed, _ = read_parts(lines)
        return [part(one.shape, self.material(one.surface), one.to_body) for one in placed]


def paint_body(table: Mapping[str, Any], *, colour: Colour | None, seed: int) -> Painted:
    """The colours of a body: those of `colours` give way to the one that is said."""
    paints: Mapping[str, Sequence[str]] = table["colours"]
    hues = {
        name: choose(seed, name, [read_colour(one, FIXED_HUES) for one in usual])
        for name, usual in paints.items()
    }
    if colour is not None:
        hues = dict.fromkeys(hues, colour)
    return Painted({**FIXED_HUES, **hues}, table.get("surfaces", {}))


@dataclass(frozen=True)
class _Group:
    """Parts that move together, in the body and in a mirror of it if they are a pair."""

    parts: Sequence[ModelPart]
    joints: Sequence[Joint]
    at_rest: Sequence[Joint]
    """Its joints while the body stays where it is."""
    is_paired: bool

    def draw(self, pose: Pose, seed: int) -> list[ModelPart]:
        joints = self.at_rest if pose.activity in RESTING else self.joints
        drawn = moved(self.parts, place(joints, pose, seed)) if joints else list(self.parts)
        return [*drawn, *mirrored(drawn)] if self.is_paired else drawn


def mirrored(parts: Sequence[ModelPart]) -> list[ModelPart]:
    """The same parts on the other side of the body, their surfaces not turned inside out."""
    return [each.at(_MIRROR[:, None] * each.to_body * _TURNED_BACK) for each in parts]


_MIRROR: Affine = np.array([1.0, -1.0, 1.0])
_TURNED_BACK: Affine = np.array([-1.0, 1.0, 1.0, 1.0])
"""Signs of the columns of a map: its first axis the other way round."""


def build_figure(
    table: Mapping[str, Any],
    is_centred: bool,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make a body that is given as data; `colour` takes the place of its `colours`."""
    painted = paint_body(table, colour=colour, seed=seed)
    groups = [_read_group(one, painted) for one in table.get("moving", {}).values()]
    groups += [_read_clump(one, painted, seed) for one in table.get("clumps", ())]
    chains = [
        one.drawn_in(painted.material(one.surface), painted.draw(one.beads), painted.draw(one.head))
        for one in (Chain(**each) for each in table.get("chains", ()))
    ]
    legs = [
        one.drawn_in(painted.material(one.surface), painted.draw(one.foot))
        for one in (read_legs(each) for each in table.get("legs", ()))
    ]
    gait = Gait(**table["gait"]) if "gait" in table else None
    rigid = painted.draw(table.get("parts", ""))
    wave = read_wave(table["wave"]) if "wave" in table else None
    bob = table.get("bob", _NO_BOB)
    moves_all = wave is not None or gait is not None

    def articulate(pose: Pose) -> list[ModelPart]:
        parts = list(rigid) if moves_all else []
        if wave is not None:
            parts = [wave(part, pose, seed) for part in parts]
        parts += [part for group in groups for part in group.draw(pose, seed)]
        parts += [part for draw in chains for part in draw(pose, seed)]
        if gait is None:
            return parts
        steps = steps_at(gait, pose, seed)
        rise = _rise(steps, *bob)
        return [
            *moved(parts, shift(z=rise)),
            *(part for draw_legs in legs for part in draw_legs(steps, rise)),
        ]

    return ArticulatedModel(
        [] if moves_all else rigid,
        scale=scale * table.get("size", 1.0),
        articulate=articulate if moves_all or groups or chains else None,
        is_centred=is_centred,
    )


_NO_BOB = (0.0, 0.0, 0.0)


def _read_group(table: Mapping[str, Any], painted: Painted) -> _Group:
    joints = [read_body_joint(text) for text in table.get("joints", ())]
    at_rest = [read_body_joint(text) for text in table["rest"]] if "rest" in table else joints
    return _Group(painted.draw(table["parts"]), joints, at_rest, table.get("pair", False))


def _read_clump(table: Mapping[str, Any], painted: Painted, seed: int) -> _Group:
    """Balls around an upright axis, their places, sizes and shades chosen by the seed.

    Its table: count, surface; lowest and highest `out` (from the axis), `up`, `size` (m) and
    `shade`; `across` (their places and extents along y compared with those along x), `flat`
    (their extents along z).
    """
    material, count = painted.material(table["surface"]), table["count"]
    across, flat = table.get("across", 1.0), table.get("flat", 1.0)
    parts = []
    for index in range(count):
        angle = math.tau * (index + 0.6 * fraction(seed, f"angle {index}")) / count
        out, up, size, tint = (
            between(seed, f"{name} {index}", *table[name])
            for name in ("out", "up", "size", "shade")
        )
        tinted = replace(
            material,
            colour=shade(material.colour, tint),
            second_colour=shade(material.second_colour, tint),
        )
        at = (out * math.cos(angle), across * out * math.sin(angle), up)
        parts.append(ball(tinted, at, (size, across * size, flat * size)))
    joints = [read_body_joint(text) for text in table.get("joints", ())]
    return _Group(parts, joints, joints, is_paired=False)


def _rise(steps: Steps, reach: float, times: float, late: float) -> float:
    """How far a body is lifted: by `reach` m, some times a stride."""
    cycle = 2.0 * math.pi * (times * steps.strides - late)
    return steps.amount * reach * (0.5 - 0.5 * math.cos(cycle))
