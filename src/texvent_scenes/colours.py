"""Colours by name, in linear-light RGB: of surfaces and of light."""

from __future__ import annotations

import functools
import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.errors import ConfigError, shown
from texvent_scenes.rendered_scene import Colour, decode_hex

COLOURS: dict[str, Colour] = {
    name: decode_hex(code)
    for name, code in {
        "red": "c8201c",
        "orange": "e8791b",
        "yellow": "efc81f",
        "green": "2e8b3a",
        "blue": "2352c4",
        "purple": "7434a8",
        "violet": "7a3fc0",
        "pink": "ee7fae",
        "brown": "7a4b26",
        "black": "17171a",
        "white": "f2f2ee",
        "grey": "84868a",
        "gray": "84868a",
        "silver": "b9bdc3",
        "silvery": "b9bdc3",
        "gold": "d3a32c",
        "golden": "d3a32c",
        "cyan": "24b8c9",
        "turquoise": "2fc0b0",
        "teal": "1d7f80",
        "magenta": "c9278f",
        "beige": "d8c8a2",
        "tan": "c29c69",
        "cream": "efe6c8",
        "maroon": "6e1a22",
        "crimson": "b3142f",
        "navy": "1b2a5c",
        "olive": "70732b",
        "lime": "8ecb2d",
        "khaki": "b5a66b",
        "ivory": "f1ecd9",
        "scarlet": "d62718",
        "bronze": "a9713a",
        "copper": "b8693a",
        "indigo": "3a3a9a",
        "ochre": "b9822e",
    }.items()
}

SHADES: dict[str, tuple[float, float]] = {
    "light": (1.0, 0.45),
    "pale": (1.0, 0.55),
    "bright": (1.25, 0.0),
    "dark": (0.35, 0.0),
    "deep": (0.55, 0.0),
    "vivid": (1.2, 0.0),
}
"""Word → (factor on linear RGB, share of white mixed in)."""


def shade_colour(rgb: Colour, shade: str) -> Colour:
    """The colour made lighter or darker as the word says; stays in 0..1.

    Example:
        >>> shade_colour((0.5, 0.0, 0.0), "dark")
        (0.175, 0.0, 0.0)
    """
    factor, white = SHADES[shade]
    red, green, blue = (min(1.0, (c * factor) * (1.0 - white) + white) for c in rgb)
    return (red, green, blue)


SURFACES: Mapping[str, Colour] = {
    **COLOURS,
    **{
        f"{shade} {name}": shade_colour(COLOURS[name], shade)
        for shade in SHADES
        for name in COLOURS
    },
}
"""Colours of surfaces, with their shades: "dark red"."""
TINTS: Mapping[str, Colour] = {
    **COLOURS,
    "warm": (1.0, 0.75, 0.45),
    "golden": (1.0, 0.7, 0.3),
    "cold": (0.6, 0.8, 1.0),
}
"""Colours of light."""
PALETTES: Mapping[str, Mapping[str, Colour]] = {
    "surface": SURFACES,
    "light": TINTS,
}
"""Use of a colour → its colours."""
_HEX = re.compile(r"#[0-9a-fA-F]{6}")


def find_colour(name: str, colours: Mapping[str, Colour], where: str = "colour") -> Colour:
    """Linear-light RGB of a name of the table, or of an sRGB code such as "#ff8000".

    Raises:
        ConfigError: it is neither; the message begins with `where`.

    Example:
        >>> find_colour("#ffffff", SURFACES)
        (1.0, 1.0, 1.0)
    """
    if _HEX.fullmatch(name):
        return decode_hex(name[1:])
    if name not in colours:
        near = suggest(name, tuple(colours))
        raise ConfigError(f"{where} is {shown(name)}; {near}; or a code such as '#ff8000'")
    return colours[name]


def rgb_of(name: str | None, palette: str = "surface") -> Colour | None:
    """Linear-light RGB of a checked name of one of `PALETTES`; None: no colour is given."""
    return None if name is None else find_colour(name, PALETTES[palette])


_NEUTRAL, _CHROMA = (("black", 22.0), ("dark grey", 42.0), ("grey", 82.0), ("white", 101.0)), 9.0
"""Neutral colours with the CIE lightness up to which they are meant; chroma of the others."""
_HUES = {one: one for one in ("red", "orange", "yellow", "green", "blue", "purple", "pink",
                             "brown", "beige")}  # fmt: skip
_HUES |= {"cyan": "blue-green", "tan": "beige"}
"""Colour → its basic name."""
_LIGHTNESS, _HUE, _DEPTH = 0.5, 40.0, 0.4
"""Weights of differences in CIE lightness, in hue (per rad) and in chroma between names of hues: a
dark blue is no blue-green, whatever its chroma."""


def name_colour(colour: Sequence[float] | NDArray[np.floating[Any]]) -> str:
    """Basic name of a colour in linear-light RGB: neutral, or the nearest hue in CIELAB.

    Example:
        >>> name_colour((0.5, 0.02, 0.02)), name_colour((0.02, 0.02, 0.02)), name_colour((1, 1, 1))
        ('red', 'black', 'white')
    """
    lightness, *chroma = _to_lab(np.asarray(colour, np.float64))
    if math.hypot(*chroma) < _CHROMA:
        return next((name for name, most in _NEUTRAL if lightness <= most), "white")

    def distance(name: str) -> float:
        other, *hue = _lab_of_name(name)
        turn = math.remainder(math.atan2(*chroma) - math.atan2(*hue), math.tau)
        depth = math.hypot(*chroma) - math.hypot(*hue)
        return math.hypot(_LIGHTNESS * (lightness - other), _HUE * turn, _DEPTH * depth)

    return _HUES[min(_HUES, key=distance)]


@functools.cache
def _lab_of_name(name: str) -> tuple[float, float, float]:
    """CIELAB of a colour of `SURFACES`."""
    return _to_lab(np.asarray(SURFACES[name], np.float64))


def _to_lab(colour: NDArray[np.float64]) -> tuple[float, float, float]:
    """CIELAB of linear sRGB, white D65."""
    x, y, z = (_TO_XYZ @ np.clip(colour, 0.0, 1.0)) / _TO_XYZ.sum(axis=1)
    f, g, h = (one ** (1 / 3) if one > 0.008856 else 7.787 * one + 16 / 116 for one in (x, y, z))
    return 116.0 * g - 16.0, 500.0 * (f - g), 200.0 * (g - h)


_TO_XYZ = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
"""Linear sRGB to CIE XYZ (IEC 61966-2-1)."""
