"""Clothes and hats that lie or hang alone; worn ones are drawn on the body (`dressing`)."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import CLOTH_COLOURS, Material, cloth
from texvent.scenes.models.objects.figures import centred
from texvent.scenes.models.people.posture import Posture, solve
from texvent.scenes.models.people.roles.garments import GARMENTS
from texvent.scenes.models.people.roles.hanging import (
    draw_cape,
    draw_robe,
    draw_skirt,
    draw_suit,
    draw_top,
    draw_trousers,
)
from texvent.scenes.models.people.roles.hats import HATS, HEAD_SIZE
from texvent.scenes.models.protocol import ModelPart, Noun, fixed_noun
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour

_DARK: Colour = (0.02, 0.02, 0.024)
_STRAW: Colour = (0.66, 0.50, 0.20)


def build_hat(
    name: str, usual: Colour, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a hat that lies on its brim; `colour` is its cloth."""
    skin = cloth(colour if colour is not None else usual)
    return ArticulatedModel(centred(HATS[name](skin, HEAD_SIZE)), scale=scale)


def build_over(
    name: str, usual: Colour | None, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a garment in the shape that a body gives it; `colour` is its cloth."""
    hue = colour if colour is not None or usual is None else usual
    skin = cloth(paint(hue, seed, "cloth", CLOTH_COLOURS))
    return ArticulatedModel(centred(GARMENTS[name](skin, solve(Posture()))), scale=scale)


def build_hanging(
    draw: Callable[[Material], list[ModelPart]],
    usual: Colour | None,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make a garment by its outline; `colour` is its cloth."""
    hue = colour if colour is not None or usual is None else usual
    skin = cloth(paint(hue, seed, "cloth", CLOTH_COLOURS))
    return ArticulatedModel(centred(draw(skin)), scale=scale)


def _hat(name: str, hat: str, usual: Colour, *same: str) -> Noun:
    return fixed_noun(name, partial(build_hat, hat, usual), same)


def _over(name: str, garment: str, usual: Colour | None, *same: str) -> Noun:
    return fixed_noun(name, partial(build_over, garment, usual), same)


def _hung(
    name: str, draw: Callable[[Material], list[ModelPart]], usual: Colour | None, *same: str
) -> Noun:
    return fixed_noun(name, partial(build_hanging, draw, usual), same)


_SWEATER = partial(draw_top, long=0.66, is_open=False, has_hood=False)
_HOODIE = partial(draw_top, long=0.68, is_open=False, has_hood=True)

NOUNS = (
    _hat("cowboy hat", "cowboy", (0.16, 0.08, 0.03), "stetson"),
    _hat("straw hat", "straw", _STRAW, "sun hat"),
    _hat("top hat", "top hat", _DARK),
    _hat("chef hat", "toque", (0.80, 0.80, 0.78), "toque", "chef s hat"),
    _hat("witch hat", "pointed", _DARK, "wizard hat", "pointed hat"),
    _hat("santa hat", "santa", (0.55, 0.03, 0.02)),
    _hat("turban", "turban", (0.60, 0.30, 0.05)),
    _hat("woolly hat", "woolly", (0.45, 0.05, 0.04), "beanie", "bobble hat", "knit cap"),
    _over("apron", "apron", (0.80, 0.80, 0.78)),
    _hung("skirt", draw_skirt, None),
    _hung("robe", draw_robe, None, "bathrobe", "gown robe"),
    _hung("cape", draw_cape, (0.55, 0.03, 0.02)),
    _over("tutu", "tutu", (0.80, 0.45, 0.50)),
    _over("overalls", "overalls", (0.04, 0.10, 0.28), "dungarees", "overall"),
    _hung("wetsuit", partial(draw_suit, legs=0.78), _DARK, "diving suit"),
    _hung("suit", partial(draw_suit, legs=0.78), _DARK, "tuxedo", "business suit"),
    _hung("pyjamas", partial(draw_suit, legs=0.78), (0.35, 0.50, 0.68), "pajamas", "onesie"),
    _hung("spacesuit", partial(draw_suit, legs=0.78), (0.80, 0.80, 0.78), "space suit"),
    _hung("sweater", _SWEATER, None, "pullover", "jumper", "sweatshirt", "cardigan", "jersey"),
    _hung("hoodie", _HOODIE, None, "hooded sweatshirt"),
    _hung("trousers", partial(draw_trousers, legs=0.78), (0.04, 0.07, 0.18), "jeans", "pants"),
    _hung("shorts", partial(draw_trousers, legs=0.30), None, "swimming trunks"),
)
