"""What tells one four-legged animal from another: its proportions and its surfaces."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import Point


@dataclass(frozen=True)
class Build:
    """Proportions of a four-legged animal, m."""

    shoulder: float
    """Height of the back at the shoulders."""
    body: tuple[float, float, float]
    """Length, width and height of the trunk."""
    neck: float
    """Length of the neck."""
    rise: float
    """Angle of the neck above horizontal, radians."""
    head: tuple[float, float]
    """Length of the skull, and of the muzzle in front of it."""
    tail: tuple[float, float]
    """Length, and angle above horizontal at its root, radians."""
    ear: tuple[float, str]
    """Length; "prick", "flop", "side", "round", "wide", "long" or "fan"."""
    stride: float = 0.0
    """Distance of one cycle of steps; 0 = 1.5 times the shoulder height."""
    thick: float = 1.0
    """Thickness of the legs relative to a dog's."""
    horns: str = ""
    """ "", "short", "antlers", "tusks", "knobs"."""
    mane: str = ""
    """ "", "ridge", "full"."""
    trunk: float = 0.0
    """Length of an elephant's trunk."""
    hop: float = 0.0
    """Height of a rabbit's hop."""
    fleece: bool = False
    patches: bool = False
    """Large dark patches, as on a cow."""
    bushy_tail: bool = False
    waist: float = 1.0
    """Height of the hind trunk relative to the chest."""


FaceDraw = Callable[[Build, Point], list[ModelPart]]
"""Marks of a face on a head whose neck ends at that point."""


@dataclass(frozen=True)
class Coat:
    """Surfaces of one animal."""

    trunk: Material
    limbs: Material
    dark: Material
    hoof: Material
    legs: Material | None = None
    """None = as the limbs, which neck and head belong to."""
    muzzle: Material | None = None
    """None = as the face."""
    ears: Material | None = None
    """None = as the limbs, or dark."""
    tail: Material | None = None
    """None = as the limbs."""
    face: FaceDraw | None = None
