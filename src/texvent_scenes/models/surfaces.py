"""Surfaces of nouns in text: "paint*.7", "paint:cloth", "(.3 .15 .06) wood", "#e8c020 glow 3"."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any

from texvent_scenes.models.materials import BLACK, WHITE, Material, made_of, shade
from texvent_scenes.models.part_lines import Placed, read_parts
from texvent_scenes.models.protocol import ModelPart, choose
from texvent_scenes.models.shapes import part
from texvent_scenes.models.tables import read_table
from texvent_scenes.rendered_scene import FIRST_SURFACE, Colour, Texture, decode_hex

PAINT = "paint"
"""Name of the colour that a prompt may say."""
FIXED_HUES: Mapping[str, Colour] = {"black": BLACK, "white": WHITE}
"""Colours that every noun may name."""
_GREY = "(.4 .4 .4)"
WORDS = re.compile(r"\([^)]*\)(?:\*[\d.]+)*|\S+")
"""Words of a surface; a colour in brackets is one."""
_TEXTURES = {one.name.lower(): one for one in Texture}


@cache
def shared_surfaces() -> Mapping[str, Material]:
    """Surfaces that all nouns may name, from `data/surfaces.toml`."""
    return {name: read_surface(text, {}) for name, text in read_table("surfaces").items()}


def read_colour(text: str, hues: Mapping[str, Colour]) -> Colour:
    """Linear-light RGB of "#rrggbb", "(r g b)" or a name of `hues`, each perhaps with "*factor".

    Raises:
        ValueError: it is none of these.
    """
    first, *factors = text.split("*")
    if re.fullmatch("#[0-9a-fA-F]{6}", first):
        colour = decode_hex(first[1:])
    elif first.startswith("("):
        channels = [float(one) for one in first.strip("()").split()]
        if len(channels) != 3 or not all(0.0 <= one <= 1.0 for one in channels):
            raise ValueError(f"colour {text!r} must be three numbers from 0 to 1")
        colour = (channels[0], channels[1], channels[2])
    elif first in hues:
        colour = hues[first]
    else:
        known = ", ".join([*hues, "#rrggbb", "(r g b)"])
        raise ValueError(f"unknown colour {text!r}; known: {known}")
    for factor in factors:
        colour = shade(colour, float(factor))
    return colour


def read_surface(text: str, hues: Mapping[str, Colour]) -> Material:
    """A surface: its colour, its texture, a second colour, "scale" and "glow" with numbers.

    A ":" stands for a blank, so that a line of parts can name a surface in one word: "paint:wood".

    Args:
        text: such as "paint cloth", "stripes", or a name of `shared_surfaces`.
        hues: colours by name.

    Raises:
        ValueError: a word is not understood.
    """
    first, *rest = WORDS.findall(text.replace(":", " "))
    base, *factors = first.split("*")
    if base[0] not in "#(" and base not in hues:
        shared = shared_surfaces() if hues else {}
        if base not in shared:
            raise ValueError(f"unknown surface {text!r}; known: {', '.join([*hues, *shared])}")
        return toned(shared[base], math.prod(map(float, factors)))
    colour, second = read_colour(first, hues), None
    texture, values = Texture.WORN, {"scale": 1.0, "glow": 0.0}
    for word, following in zip(rest, [*rest, ""][1:], strict=True):
        if word in values:
            values[word] = float(following)
        elif word in _TEXTURES:
            texture = _TEXTURES[word]
        elif not re.fullmatch(r"[\d.]+", word):
            second = read_colour(word, hues)
    is_material = texture >= FIRST_SURFACE and texture is not Texture.WORN
    if second is None and not is_material:
        second = (0.0, 0.0, 0.0)
    made = made_of(texture, colour, second, scale=values["scale"])
    return replace(made, emission=values["glow"])


def toned(surface: Material, factor: float) -> Material:
    """The same surface, darker or lighter."""
    return replace(
        surface,
        colour=shade(surface.colour, factor),
        second_colour=shade(surface.second_colour, factor),
    )


@dataclass(frozen=True)
class Painted:
    """The colours of one model, and the surfaces that they give."""

    hues: Mapping[str, Colour]
    surfaces: Mapping[str, str]
    """Name → words of a surface."""
    made: dict[str, Material] = field(default_factory=dict)

    def material(self, name: str) -> Material:
        """The surface of that name, or that these words mean."""
        if name not in self.made:
            base, *factors = name.split("*")
            if factors and base in self.surfaces and self.surfaces[base] != base:
                self.made[name] = toned(self.material(base), math.prod(map(float, factors)))
                return self.made[name]
            words = self.surfaces.get(name, name)
            is_other = words != name and words in self.surfaces
            self.made[name] = self.material(words) if is_other else read_surface(words, self.hues)
        return self.made[name]

    def draw(self, parts: Iterable[Placed]) -> list[ModelPart]:
        """Placed shapes in their surfaces."""
        return [part(one.shape, self.material(one.surface), one.to_body) for one in parts]

    def draw_lines(self, lines: str) -> list[ModelPart]:
        """The parts of some lines."""
        return self.draw(read_parts(lines)[0])


def paint_model(table: Mapping[str, Any], *, colour: Colour | None, seed: int) -> Painted:
    """The colours of a noun's table: those of `colours` give way to the one that is said.

    Raises:
        ValueError: a colour is not understood, or a list of them is empty.
    """
    said = table.get("colours", [_GREY])
    paints: Mapping[str, Sequence[str]] = said if isinstance(said, Mapping) else {PAINT: said}
    varied = {**paints, **table.get("varied", {})}
    if not all(varied.values()):
        raise ValueError("a list of colours is empty")
    hues = {
        name: choose(seed, name, [read_colour(one, FIXED_HUES) for one in options])
        for name, options in varied.items()
    }
    if colour is not None:
        hues.update(dict.fromkeys(paints, colour))
    return Painted({**FIXED_HUES, **hues}, table.get("surfaces", {}))
