"""Clothes and hats that lie or hang alone; worn ones are drawn on the body (`dressing`)."""

from __future__ import annotations

from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import CLOTH_COLOURS, cloth
from texvent.scenes.models.objects.figures import centred
from texvent.scenes.models.people.posture import Posture, solve
from texvent.scenes.models.people.roles.garments import GARMENTS
from texvent.scenes.models.people.roles.hats import HATS, HEAD_SIZE
from texvent.scenes.models.protocol import ModelPart, Noun, fixed_noun
from texvent.scenes.models.shapes import ball, limb
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


def build_suit(
    has_top: bool,
    legs: float,
    usual: Colour | None,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make trousers, or trousers and a top in one; `legs` is their length, m."""
    hue = colour if colour is not None or usual is None else usual
    skin = cloth(paint(hue, seed, "cloth", CLOTH_COLOURS))
    parts: list[ModelPart] = [ball(skin, (0.0, 0.0, 0.92), (0.24, 0.36, 0.26))]
    if legs > 0.0:
        for y in (0.10, -0.10):
            parts.append(limb(skin, (0.0, y, 0.86), (0.0, 1.3 * y, 0.86 - legs), 0.08))
    if has_top:
        parts.append(limb(skin, (0.0, 0.0, 0.92), (0.0, 0.0, 1.38), 0.12, side_radius=0.18))
        parts.append(ball(skin, (0.0, 0.0, 1.40), (0.22, 0.43, 0.22)))
        for y in (0.20, -0.20):
            parts.append(limb(skin, (0.0, y, 1.40), (0.02, 1.4 * y, 0.90), 0.055))
    return ArticulatedModel(centred(parts), scale=scale)


def _hat(name: str, hat: str, usual: Colour, *same: str) -> Noun:
    return fixed_noun(name, partial(build_hat, hat, usual), same)


def _over(name: str, garment: str, usual: Colour | None, *same: str) -> Noun:
    return fixed_noun(name, partial(build_over, garment, usual), same)


def _suit(name: str, legs: float, usual: Colour | None, *same: str, has_top: bool = True) -> Noun:
    return fixed_noun(name, partial(build_suit, has_top, legs, usual), same)


NOUNS = (
    _hat("cowboy hat", "cowboy", (0.16, 0.08, 0.03), "stetson", "sombrero"),
    _hat("straw hat", "straw", _STRAW, "sun hat"),
    _hat("top hat", "top hat", _DARK),
    _hat("chef hat", "toque", (0.80, 0.80, 0.78), "toque", "chef s hat"),
    _hat("witch hat", "pointed", _DARK, "wizard hat", "pointed hat"),
    _hat("santa hat", "santa", (0.55, 0.03, 0.02)),
    _hat("turban", "turban", (0.60, 0.30, 0.05)),
    _hat("woolly hat", "woolly", (0.45, 0.05, 0.04), "beanie", "bobble hat", "knit cap"),
    _over("apron", "apron", (0.80, 0.80, 0.78)),
    _over("skirt", "skirt", None),
    _over("robe", "robe", None, "bathrobe", "cloak", "kimono", "gown robe"),
    _over("cape", "cape", (0.55, 0.03, 0.02)),
    _over("tutu", "tutu", (0.80, 0.45, 0.50)),
    _over("overalls", "overalls", (0.04, 0.10, 0.28), "dungarees", "overall"),
    _suit("wetsuit", 0.78, _DARK, "diving suit"),
    _suit("suit", 0.78, _DARK, "tuxedo", "business suit", "tracksuit"),
    _suit("pyjamas", 0.78, (0.35, 0.50, 0.68), "pajamas", "onesie"),
    _suit("spacesuit", 0.78, (0.80, 0.80, 0.78), "space suit"),
    _suit("sweater", 0.0, None, "pullover", "jumper", "sweatshirt", "cardigan", "jersey"),
    _suit("hoodie", 0.0, None, "hooded sweatshirt"),
    _suit("trousers", 0.78, (0.04, 0.07, 0.18), "jeans", "pants", has_top=False),
    _suit("shorts", 0.30, None, "swimming trunks", has_top=False),
)
