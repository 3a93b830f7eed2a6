"""Ground of every place."""

from __future__ import annotations

from texvent.scenes.scene import Colour, Ground, Texture
from texvent.scenes.staging.surroundings.built_places import BUILT_GROUNDS
from texvent.scenes.staging.surroundings.ground_appearance import (
    ASPHALT,
    MEADOW,
    WATER,
    GroundAppearance,
    room,
)

_OAK: tuple[Colour, Colour] = ((0.36, 0.20, 0.10), (0.46, 0.28, 0.15))

PLACES: dict[str, GroundAppearance] = {
    "road": GroundAppearance(Ground.ROAD, MEADOW[0], ASPHALT),
    "dirt road": GroundAppearance(Ground.DIRT_ROAD, (0.07, 0.12, 0.03), (0.34, 0.22, 0.12), 2.4),
    "city": GroundAppearance(Ground.CITY, (0.3, 0.3, 0.3), ASPHALT, 4.5),
    "grass": GroundAppearance(Ground.GRASS, *MEADOW),
    "savanna": GroundAppearance(Ground.GRASS, (0.30, 0.22, 0.075), (0.42, 0.33, 0.13)),
    "forest": GroundAppearance(
        Ground.GRASS, (0.085, 0.065, 0.028), (0.17, 0.095, 0.03), surface=Texture.LEAVES
    ),
    "gravel": GroundAppearance(
        Ground.PLAIN, (0.26, 0.25, 0.23), (0.36, 0.34, 0.30), surface=Texture.GRAVEL
    ),
    "soil": GroundAppearance(
        Ground.PLAIN, (0.20, 0.125, 0.07), (0.29, 0.20, 0.12), surface=Texture.SOIL
    ),
    "river": GroundAppearance(Ground.RIVER, MEADOW[0], WATER, 4.5),
    "lake": GroundAppearance(Ground.LAKE, MEADOW[0], WATER),
    "sea": GroundAppearance(Ground.SEA, (0.012, 0.07, 0.11), (0.03, 0.13, 0.16)),
    "underwater": GroundAppearance(Ground.UNDERWATER, (0.34, 0.31, 0.22), (0.5, 0.47, 0.36)),
    "sand": GroundAppearance(Ground.SAND, (0.56, 0.43, 0.25), (0.68, 0.55, 0.35)),
    "snow": GroundAppearance(Ground.SNOW, (0.66, 0.70, 0.75), (0.76, 0.79, 0.83)),
    "mountain": GroundAppearance(Ground.GRASS, (0.10, 0.13, 0.05), (0.22, 0.20, 0.12)),
    "indoor": room(Texture.BOARDS, _OAK, Texture.PLASTER, (0.75, 0.69, 0.61)),
    "living room": room(Texture.BOARDS, _OAK, Texture.WALLPAPER, (0.62, 0.60, 0.48)),
    "bedroom": room(
        Texture.CARPET,
        ((0.30, 0.27, 0.33), (0.42, 0.38, 0.42)),
        Texture.WALLPAPER,
        (0.55, 0.62, 0.70),
    ),
    "kitchen": room(
        Texture.TILES, ((0.62, 0.60, 0.55), (0.30, 0.29, 0.28)), Texture.TILES, (0.74, 0.74, 0.72)
    ),
    "office": room(
        Texture.CARPET,
        ((0.12, 0.14, 0.18), (0.20, 0.22, 0.26)),
        Texture.PLASTER,
        (0.72, 0.72, 0.70),
    ),
    "workshop": room(
        Texture.CONCRETE,
        ((0.30, 0.29, 0.28), (0.22, 0.21, 0.20)),
        Texture.BRICK,
        (0.36, 0.15, 0.10),
    ),
    "warehouse": room(
        Texture.CONCRETE,
        ((0.36, 0.36, 0.35), (0.27, 0.27, 0.26)),
        Texture.CONCRETE,
        (0.46, 0.45, 0.43),
    ),
    "gym": room(
        Texture.BOARDS,
        ((0.50, 0.33, 0.16), (0.58, 0.40, 0.21)),
        Texture.BRICK,
        (0.60, 0.57, 0.50),
    ),
    "sky": GroundAppearance(Ground.NONE, (0.3, 0.3, 0.3), (0.3, 0.3, 0.3)),
    "space": GroundAppearance(Ground.NONE, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "construction site": GroundAppearance(
        Ground.SAND, (0.36, 0.27, 0.18), (0.44, 0.34, 0.23), surface=Texture.SOIL
    ),
    **BUILT_GROUNDS,
    "plain": GroundAppearance(Ground.PLAIN, (0.42, 0.42, 0.42), (0.48, 0.48, 0.48)),
}
"""Ground of every place the grammar knows."""


def is_room(place: str) -> bool:
    """Whether a place has walls and a ceiling."""
    return PLACES[place].ground is Ground.FLOOR
