"""Grounds and scenery of shops, halls for many, sites and grounds beside `built_places`."""

from __future__ import annotations

from texvent.scenes.scene import Colour, Ground, Texture
from texvent.scenes.staging.surroundings.ground_appearance import (
    BOARDS,
    GREY,
    MEADOW,
    PALE,
    GroundAppearance,
    room,
)
from texvent.scenes.staging.surroundings.scenery.scatter_rule import (
    ScatterRule,
    along_walls,
    facing,
    under,
)

_LAWN: tuple[Colour, Colour] = ((0.06, 0.20, 0.03), (0.10, 0.27, 0.05))
_CORAL: tuple[Colour, ...] = ((0.75, 0.25, 0.30), (0.80, 0.40, 0.12), (0.55, 0.20, 0.50),
                              (0.75, 0.65, 0.20))  # fmt: skip

MORE_GROUNDS: dict[str, GroundAppearance] = {
    "pharmacy": room(Texture.TILES, PALE, Texture.PLASTER, (0.70, 0.78, 0.72)),
    "bakery": room(Texture.TILES, ((0.62, 0.52, 0.40), (0.50, 0.38, 0.26)), Texture.PLASTER,
                   (0.76, 0.66, 0.48)),
    "cafeteria": room(Texture.TILES, PALE, Texture.PLASTER, (0.74, 0.72, 0.62)),
    "cinema": room(Texture.CARPET, ((0.12, 0.02, 0.03), (0.18, 0.04, 0.05)), Texture.CLOTH,
                   (0.16, 0.04, 0.06)),
    "recording studio": room(Texture.BOARDS, BOARDS, Texture.WOOD, (0.34, 0.20, 0.10)),
    "nursery": room(Texture.CARPET, ((0.50, 0.56, 0.66), (0.60, 0.66, 0.74)), Texture.WALLPAPER,
                    (0.76, 0.62, 0.66)),
    "science museum": room(Texture.TILES, PALE, Texture.PLASTER, (0.40, 0.50, 0.62)),
    "pool hall": room(Texture.TILES, PALE, Texture.TILES, (0.50, 0.66, 0.74)),
    "campsite": GroundAppearance(Ground.GRASS, *MEADOW),
    "golf course": GroundAppearance(Ground.GRASS, *_LAWN),
    "junkyard": GroundAppearance(Ground.PLAIN, (0.28, 0.22, 0.15), (0.36, 0.29, 0.20),
                                 surface=Texture.SOIL),
    "industrial area": GroundAppearance(Ground.PLAIN, *GREY, surface=Texture.CONCRETE),
    "race track": GroundAppearance(Ground.ROAD, _LAWN[0], (0.05, 0.05, 0.055), 5.0),
    "baseball field": GroundAppearance(Ground.GRASS, *_LAWN),
    "glacier": GroundAppearance(Ground.SNOW, (0.66, 0.74, 0.80), (0.76, 0.82, 0.86)),
    "marsh": GroundAppearance(Ground.LAKE, (0.10, 0.12, 0.03), (0.03, 0.07, 0.04)),
    "botanical garden": GroundAppearance(Ground.GRASS, *_LAWN),
    "campus": GroundAppearance(Ground.GRASS, *_LAWN),
}  # fmt: skip
"""Ground of each of these places."""


MORE_SCENERY: dict[str, tuple[ScatterRule, ...]] = {
    "pharmacy": (*along_walls(("medicine shelf", 5)), facing("medicine shelf", 1, 0.5, 0.8)),
    "bakery": (*along_walls(("bread shelf", 5)), facing("food counter", 1, 0.2, 0.6)),
    "cafeteria": (*along_walls(("food counter", 3)), facing("canteen table", 4, -0.1, 0.9)),
    "cinema": (*along_walls(("film screen", 1)), facing("cinema seats", 5, -0.2, 0.8)),
    "recording studio": (*along_walls(("mixing desk", 2), ("speaker", 2), ("electric guitar", 2),
        ("drum kit", 1), ("music keyboard", 1)), facing("microphone", 1, -0.2, 0.4)),
    "nursery": (*along_walls(("crib", 1), ("chest of drawers", 1), ("rocking horse", 1),
        ("teddy bear", 2), ("lamp", 1)), facing("toy block", 3, -0.3, 0.3),
        facing("rocking horse", 1, -0.2, 0.4), facing("rug", 1, -0.3, 0.2)),
    "science museum": (*along_walls(("skeleton", 2), ("display case", 3), ("large painting", 2)),
        facing("display case", 2, 0.0, 0.8), facing("globe", 1, -0.2, 0.4),
        facing("telescope", 1, 0.0, 0.5)),
    "pool hall": (under("pool basin"), *along_walls(("bench", 2), ("potted plant", 1)),
                  ScatterRule("sun lounger", 2, 0.2, 0.6)),
    "campsite": (facing("tent", 4, 0.05, 1.0), ScatterRule("campfire", 1, -0.2, 0.2),
                 ScatterRule("log", 2, -0.1, 0.4), ScatterRule("pine", 7, 0.7, 2.5),
                 ScatterRule("tree", 4, 0.9, 3.0)),
    "golf course": (facing("golf green", 1, 0.0, 0.3, 1.0), facing("sand bunker", 3, 0.1, 1.3),
                    ScatterRule("golf cart", 1, 0.2, 0.8, (0.95, 1.05)),
                    ScatterRule("tree", 6, 1.2, 3.5),
                    ScatterRule("green hill", 3, 60.0, 120.0, is_metres=True)),
    "junkyard": (facing("scrap heap", 6, 0.1, 1.4), facing("tyre stack", 4, 0.0, 1.0),
                 ScatterRule("barrel", 4, 0.0, 1.0), facing("corral fence", 3, 1.6, 2.2)),
    "industrial area": (facing("factory building", 3, 1.6, 3.4, 0.9),
                        facing("shipping container", 4, 0.2, 1.2),
                        ScatterRule("barrel", 4, 0.1, 0.8), ScatterRule("crate", 3, 0.1, 0.8),
                        ScatterRule("truck", 1, 0.4, 1.0, (0.95, 1.05))),
    "race track": (facing("race kerb", 4, 0.3, 1.2), facing("grandstand", 4, 0.9, 2.4),
                   facing("start arch", 1, 0.9, 1.4, 1.0), ScatterRule("tree", 3, 2.0, 4.0)),
    "baseball field": (under("baseball diamond"), facing("grandstand", 5, 1.6, 3.0),
                       ScatterRule("floodlight mast", 3, 1.8, 3.0)),
    "glacier": (facing("glacier front", 3, 0.8, 2.2, 0.9), facing("ice block", 5, 0.1, 0.8),
                ScatterRule("mountain", 6, 120.0, 240.0, (0.9, 1.5), is_metres=True)),
    "marsh": (ScatterRule("reed", 16, 0.0, 0.9, (0.9, 1.6)),
              ScatterRule("reed", 10, 0.05, 0.9, (0.9, 1.5), is_afloat=True),
              ScatterRule("lily pad", 8, 0.1, 0.7, (1.0, 2.0), is_afloat=True),
              ScatterRule("grass tuft", 8, 0.0, 0.6), ScatterRule("bare tree", 3, 0.5, 2.0)),
    "botanical garden": (under("gravel path lines"), facing("greenhouse", 1, 0.7, 1.2),
                         facing("flower bed", 6, 0.0, 0.8), ScatterRule("palm", 3, 0.5, 1.8),
                         ScatterRule("rose", 8, 0.0, 0.5, (1.2, 1.8)),
                         ScatterRule("bush", 5, 0.3, 1.5), ScatterRule("tree", 3, 1.0, 3.0)),
    "campus": (under("gravel path lines"), facing("mansion", 2, 1.2, 2.2, 0.9),
               ScatterRule("tree", 6, 0.4, 2.5), ScatterRule("bench", 3, 0.1, 0.8),
               ScatterRule("person", 4, 0.1, 1.0, (0.95, 1.05))),
}  # fmt: skip
"""Place → what stands around there."""

REEF: tuple[ScatterRule, ...] = (
    ScatterRule("rock", 5, 0.1, 1.0, (0.6, 1.4), fits_view=True),
    ScatterRule("coral branch", 14, 0.0, 0.9, (1.5, 4.0), _CORAL, fits_view=True),
    ScatterRule("anemone", 6, 0.0, 0.6, (1.5, 3.5), fits_view=True),
    ScatterRule("seaweed", 8, 0.0, 1.0, (0.9, 2.0), fits_view=True),
    ScatterRule("bush", 6, 0.15, 1.2, (0.3, 0.8), _CORAL, fits_view=True),
)
"""What grows on the sea bed."""
