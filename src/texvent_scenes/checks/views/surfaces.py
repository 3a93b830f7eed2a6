"""Surfaces of bodies as small pictures show them: colours and textures in words."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.colours import name_colour
from texvent_scenes.raycast.ground_truth import cast_centres
from texvent_scenes.raycast.render import world_and_shapes
from texvent_scenes.rendered_scene import Texture

_WIDTH, _MUCH, _MOST_COLOURS, _MOSTLY = 120, 0.15, 3, 0.6
"""Width of the small pictures in which surfaces are counted, pixels; share of a surface from which
on a colour is named; most that are; share of a texture that is named."""
_NEUTRAL = {"black", "dark grey", "grey", "white"}
"""Names of colours without a hue."""
_MATERIALS = {Texture.STRIPES, Texture.CHECKS, Texture.SPOTS, Texture.TILES, Texture.BOARDS,
              Texture.STONE, Texture.CONCRETE, Texture.BRICK, Texture.WOOD, Texture.FUR,
              Texture.FEATHERS, Texture.CLOTH, Texture.METAL, Texture.RUST, Texture.LEATHER,
              Texture.SCALES, Texture.FOLIAGE, Texture.MIRROR}  # fmt: skip
"""Textures that are named, of a surface of which they are the greater part."""
_TWO_COLOURED = {Texture.STRIPES, Texture.CHECKS, Texture.SPOTS}
"""Textures of which both colours are about as large."""


def list_surfaces(staged: StagedClip) -> dict[int, Counter[tuple[str, Texture]]]:
    """Instance id → colour and texture of its surface, counted over points of small pictures."""
    size = SensorSize(_WIDTH, max(round(_WIDTH * staged.size.height / staged.size.width), 1))
    found: dict[int, Counter[tuple[str, Texture]]] = {}
    for time_s in staged.times[:: len(staged.times) // 2]:
        world, shapes = world_and_shapes(staged.scene, time_s, size, shadows=False)
        held = _list_props(staged, shapes.instance, time_s)
        numbers = cast_centres(world, size).number
        seen = np.unique(numbers[numbers >= 0], return_counts=True)
        for number, count in zip(*seen, strict=True):
            if shapes.mesh is not None and shapes.mesh[number] is not None:
                continue  # its colours are its own
            if number in held:
                continue  # a piano is no part of who plays it
            texture = Texture(int(shapes.texture[number]))
            own = found.setdefault(int(shapes.instance[number]), Counter())
            pair = (shapes.colour, shapes.second_colour)[: 1 + (texture in _TWO_COLOURED)]
            for colours in pair:
                own[name_colour(colours[number]), texture] += round(int(count) / len(pair))
    return found


def _list_props(staged: StagedClip, instances: NDArray[np.int32], time_s: float) -> set[int]:
    """Numbers of the shapes that are props of an activity, which follow those of the body."""
    found = set[int]()
    for one in (one for one in staged.scene.actors if one.props):
        own = np.flatnonzero(instances == one.instance)
        found |= {*map(int, own[len(one.model.parts(one.pose(time_s))) :])}
    return found


def tell_look(surface: Counter[tuple[str, Texture]]) -> str:
    """Colours of most of a surface, the usual one first, and a texture of the greater part."""
    colours, textures = Counter[str](), Counter[Texture]()
    for (colour, texture), count in surface.items():
        colours[colour] += count
        textures[texture] += count
    (first, _), *others = colours.most_common(_MOST_COLOURS) or [("", 0)]
    named = [first, *(name for name, count in others if count >= _MUCH * colours.total())]
    hues = [name for name, _ in colours.most_common() if name not in _NEUTRAL]
    if hues and not {*named} - _NEUTRAL and colours[hues[0]] >= _MUCH * colours.total():
        named[-1] = hues[0]  # three greys hide no green
    mostly = [one.name.lower() for one, count in textures.items()
              if one in _MATERIALS and count >= _MOSTLY * textures.total()]  # fmt: skip
    return ", ".join(filter(None, [join_words(named), *mostly]))


def join_words(words: Sequence[str]) -> str:
    """Words with commas, and "and" before the last."""
    *most, last = words
    return f"{', '.join(most)} and {last}" if most else last
