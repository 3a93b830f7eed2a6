"""One kind of four-legged animal: its proportions, its surfaces, and the marks on its body."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from texvent_scenes.models.materials import Material, fur, shade
from texvent_scenes.models.protocol import ModelPart
from texvent_scenes.models.shapes import Point
from texvent_scenes.models.surfaces import FIXED_HUES, Painted, paint_model, read_colour
from texvent_scenes.rendered_scene import Colour


@dataclass(frozen=True)
class Build:
    """Proportions of a four-legged animal, m."""

    shoulder: float
    """Height of the back at the shoulders."""
    body_size: tuple[float, float, float]
    """Length, width and height of the trunk."""
    neck: tuple[float, float]
    """Length of the neck, and its angle above horizontal, radians."""
    head: tuple[float, float]
    """Length of the skull, and of the muzzle in front of it."""
    tail: tuple[float, float]
    """Length, and angle above horizontal at its root, radians."""
    ear: tuple[float, str]
    """Length; "prick", "flop", "side", "round", "long" or "broad"."""
    stride: float = 0.0
    """Distance of one cycle of steps; 0 = 1.5 times the shoulder height."""
    thick: float = 1.0
    """Thickness of the legs relative to a dog's."""
    mane: str = ""
    """ "", "ridge", "full"."""
    trunk_length: float = 0.0
    """Length of an elephant's trunk."""
    hop: float = 0.0
    """Height of a rabbit's hop."""
    fleece: bool = False
    bushy_tail: bool = False
    waist: float = 1.0
    """Height of the hind trunk relative to the chest."""


@dataclass(frozen=True)
class Coat:
    """Surfaces of one animal, and its marks."""

    trunk: Material
    limbs: Material
    """Also of neck and head."""
    dark: Material
    hoof: Material
    legs: Material
    muzzle: Material
    ears: Material
    tail: Material
    marks: tuple[ModelPart, ...]
    """On the trunk: its middle is the origin, and it is 1 long, wide and high."""
    face: tuple[ModelPart, ...]
    """On the head: the neck's end is the origin, and the skull is 1 long."""


QUADRUPED_KEYS: Mapping[str, tuple[type, ...]] = {
    "build": (list,), "coat": (list,), "pattern": (str,), "limb_pattern": (str,), "dark": (str,),
    "hoof": (str,), "leg": (str,), "muzzle": (str,), "ears": (str,), "tail_rings": (str,),
    "marks": (str,), "usual_marks": (str,), "face": (str,), "stride": (float, int),
    "thick": (float, int), "mane": (str,), "trunk_length": (float, int), "hop": (float, int),
    "fleece": (bool,), "bushy_tail": (bool,), "waist": (float, int),
}  # fmt: skip
"""Keys of a four-legged animal besides those of every noun, and what their values are."""


def read_build(table: Mapping[str, Any]) -> Build:
    """The proportions in the table of an animal: `build` holds those that all have, in order."""
    more = {one.name: table[one.name] for one in fields(Build) if one.name in table}
    return Build(*table["build"], **more)


def paint_coat(table: Mapping[str, Any], *, colour: Colour | None, seed: int) -> Coat:
    """Surfaces of one animal.

    `coat` of its table are its usual colours, `pattern` and `limb_pattern` the words of surfaces
    on them; `dark` is that of nose, mane and tail, and `hoof`, `leg`, `muzzle`, `ears` and
    `tail_rings` are colours too: without them these are as the coat. `marks` and `face` are part
    lines; only an animal of a usual colour has `usual_marks`: a white cow has no patches.
    """
    painted = paint_model({**table, "colours": {"coat": table["coat"]}}, colour=colour, seed=seed)
    hue = painted.hues["coat"]
    plain, fleece = fur(hue), table.get("fleece", False)
    trunk = painted.material(table["pattern"]) if "pattern" in table else plain
    limbs = painted.material(table["limb_pattern"]) if "limb_pattern" in table else plain
    dark = _fur(table, "dark") or fur(shade(hue, 0.45))
    flops = fleece or read_build(table).ear[1] == "flop"
    lined = Painted(
        painted.hues,
        painted.surfaces,
        {"trunk": trunk, "limbs": limbs, "dark": dark},
    )
    lines = [table.get("marks", ""), table.get("usual_marks", "") if colour is None else ""]
    rings = table.get("tail_rings")
    return Coat(
        trunk=trunk,
        limbs=limbs,
        dark=dark,
        hoof=Material(read_colour(table.get("hoof", "(.03 .025 .02)"), FIXED_HUES)),
        legs=_fur(table, "leg") or limbs,
        muzzle=_fur(table, "muzzle") or (dark if fleece else limbs),
        ears=_fur(table, "ears") or (dark if flops else limbs),
        tail=painted.material(f"coat stripes {rings} scale 2.5") if rings else limbs,
        marks=tuple(lined.draw_lines("\n".join(lines))),
        face=tuple(lined.draw_lines(table.get("face", ""))),
    )


def _fur(table: Mapping[str, Any], name: str) -> Material | None:
    return fur(read_colour(table[name], FIXED_HUES)) if name in table else None


def placed_marks(marks: tuple[ModelPart, ...], origin: Point, units: Point) -> list[ModelPart]:
    """Marks in the units of the trunk or head that they are on."""
    scale = np.array(units)[:, None]
    shift = np.column_stack([np.zeros((3, 3)), np.array(origin)])
    return [mark.at(scale * mark.to_body + shift) for mark in marks]
