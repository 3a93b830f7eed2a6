"""Whether a material is seen on a thing: by its colour and its texture."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from texvent.generate.seen_words.colours import share_like
from texvent.generate.seen_words.picture import USUAL, Picture
from texvent.scenes.language.vocabulary.objects import COLOURS, MATERIALS
from texvent.scenes.scene import Float64Array

LEAST_COVERED = 0.4
"""Share of a thing's pixels that look like its material."""
LEAST_TEXTURE = 0.04
"""Standard deviation of a thing's luma, as a share of white, that a texture or a gloss has."""
GREY = 0.15
"""Difference of the highest and lowest of R, G, B that grey may have."""
METAL = (0.12, 0.57)
"""Mean luma of grey metal: what is lighter looks like china, what is darker like plastic."""
DARK_LUMA = 0.4
_LUMA = np.array([0.299, 0.587, 0.114])
_NOT_TOLD = "not to be told from other ones"

Look = Callable[[Float64Array], bool]


def _is_coloured(*colours: tuple[float, float, float]) -> Look:
    return lambda pixels: max(share_like(pixels, one) for one in colours) >= LEAST_COVERED


def _is_grey(pixels: Float64Array) -> bool:
    return float(np.mean(np.ptp(pixels, axis=1) < GREY)) >= LEAST_COVERED


def _is_metal(pixels: Float64Array) -> bool:
    luma = float(np.mean(pixels @ _LUMA))
    return _is_grey(pixels) and METAL[0] <= luma <= METAL[1]


LOOKS: Mapping[str, Look] = {
    "wood": _is_coloured(COLOURS["brown"], COLOURS["tan"]),
    "brick": lambda pixels: True,
    "stone": _is_grey,
    "concrete": _is_grey,
    "marble": _is_grey,
    "metal": _is_metal,
    "brass": _is_coloured(COLOURS["gold"]),
    "rust": _is_coloured(COLOURS["copper"], COLOURS["brown"]),
    "rubber": lambda pixels: bool(np.mean(pixels @ _LUMA < DARK_LUMA) >= LEAST_COVERED),
    "ceramic": lambda pixels: True,
}
"""Material → whether pixels [k, 3], sRGB-coded 0..1, have its look; others are never told."""
_COLOURED = {"cardboard": _is_coloured(COLOURS["brown"], COLOURS["tan"])}
"""Words with a look of their own."""
_SMOOTH = frozenset({"ceramic", "rubber"})
_OWN_LOOK = frozenset({"wood", "stone", "concrete", "metal", "marble", "brick"})
"""Materials that are told by their texture where a colour is said too."""


def judge_material(
    picture: Picture, word: str, instances: list[int], *, has_colour: bool
) -> str | None:
    """Why a material is not seen, or None.

    Args:
        picture: of the staged scene.
        word: for the material.
        instances: ids of the things that are made of it; none: it is part of another one.
        has_colour: whether the prompt says their colour.
    """
    kind = next((name for name, words in MATERIALS.items() if word in words), word)
    look = _COLOURED.get(word, LOOKS.get(kind))
    if look is None or not instances or (has_colour and kind not in _OWN_LOOK):
        return _NOT_TOLD
    for number in USUAL:
        own = np.isin(picture.views[number].instance, instances)
        if not own.any():
            continue
        pixels = picture.colours(number)[own]
        is_rough = kind in _SMOOTH or float(np.std(pixels @ _LUMA)) >= LEAST_TEXTURE
        if is_rough and (has_colour or look(pixels)):
            return None
    return f"does not look like {word}"
