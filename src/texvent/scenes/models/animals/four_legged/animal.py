"""One kind of four-legged animal, and how it is drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

from texvent.scenes.models.animals.four_legged.body import draw_animal
from texvent.scenes.models.animals.four_legged.build import Build, Coat, FaceDraw
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    Material,
    checked,
    cloth,
    fur,
    shade,
    striped,
)
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Animal:
    """One kind of four-legged animal."""

    build: Build
    colours: tuple[Colour, ...]
    """Usual coats; the seed picks one."""
    pattern: str = "plain"
    """ "plain", "stripes", "checks"."""
    second_colour: Colour = BLACK
    """Of stripes or checks."""
    checks: float = 2.6
    """Repeats of the checks per half body part."""
    dark: Colour | None = None
    """Muzzle, mane and tail; None = a darker shade of the coat."""
    hoof: Colour = (0.03, 0.025, 0.02)
    leg_colour: Colour | None = None
    muzzle_colour: Colour | None = None
    ear_colour: Colour | None = None
    tail_ring: Colour | None = None
    """Of the rings of a tail; None = it has none."""
    face: FaceDraw | None = None
    """Marks on the head."""
    cloth: Colour | None = None
    """Of what it wears around its trunk; None = nothing."""
    extras: Callable[[Build, Coat], list[ModelPart]] | None = None
    """What else goes with the trunk: humps, spines."""


def build_animal(
    animal: Animal, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a four-legged animal; `colour` is its coat."""
    coat = paint_coat(animal, colour=colour, seed=seed)
    is_bare = animal.cloth is None
    extras = animal.extras(animal.build, coat) if animal.extras is not None and is_bare else ()
    # A white cow has no patches, and no brown one.
    build = animal.build if colour is None else replace(animal.build, patches=False)
    return draw_animal(build, coat, scale=scale, seed=seed, extras=extras)


def paint_coat(animal: Animal, *, colour: Colour | None, seed: int) -> Coat:
    """Surfaces of one animal; `colour` is its coat."""
    hue = paint(colour, seed, "coat", animal.colours)
    coat_fur = fur(hue)
    trunk, limbs = coat_fur, coat_fur
    if animal.pattern == "stripes":
        trunk = striped(hue, animal.second_colour, 2.5)
        limbs = striped(hue, animal.second_colour, 2.0)
    elif animal.pattern == "checks":
        trunk = checked(hue, animal.second_colour, animal.checks)
    dark = animal.dark if animal.dark is not None else shade(hue, 0.45)
    rings = animal.tail_ring
    return Coat(
        trunk=trunk if animal.cloth is None else cloth(animal.cloth),
        limbs=limbs,
        dark=fur(dark),
        hoof=Material(animal.hoof),
        legs=_fur_of(animal.leg_colour),
        muzzle=_fur_of(animal.muzzle_colour),
        ears=_fur_of(animal.ear_colour),
        tail=striped(hue, rings, 2.5) if rings is not None else None,
        face=animal.face,
    )


def _fur_of(hue: Colour | None) -> Material | None:
    return fur(hue) if hue is not None else None
