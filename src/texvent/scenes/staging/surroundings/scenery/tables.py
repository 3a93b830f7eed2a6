"""What stands around in each place: tables for `scatter.scatter`."""

from __future__ import annotations

from texvent.scenes.scene import Colour
from texvent.scenes.staging.surroundings.built_places import BUILT_SCENERY
from texvent.scenes.staging.surroundings.more_places import REEF
from texvent.scenes.staging.surroundings.scenery.scatter_rule import ScatterRule, along_walls

_DRY: Colour = (0.25, 0.22, 0.06)

_MOUNTAINS = ScatterRule("mountain", 7, 190.0, 330.0, (0.9, 1.5), is_metres=True)

SCENERY: dict[str, tuple[ScatterRule, ...]] = {
    **BUILT_SCENERY,
    "road": (
        ScatterRule("house", 1, 1.6, 2.6, (1.0, 1.2)),
        ScatterRule("tree", 5, 0.5, 3.5, (0.8, 1.3)),
        ScatterRule("bush", 6, 0.25, 2.0, (0.6, 1.1)),
    ),
    "dirt road": (ScatterRule("bush", 7, 0.2, 2.0, (0.5, 1.1)), ScatterRule("tree", 4, 0.7, 3.0),
                  ScatterRule("rock", 5, 0.2, 2.0, (0.4, 1.0))),
    "city": (
        ScatterRule("street lamp", 4, 0.2, 1.5, (1.0, 1.0)),
        ScatterRule("building", 7, 0.9, 3.5, (0.45, 0.9)),
        ScatterRule("building", 6, 24.0, 60.0, (0.5, 0.9), is_metres=True),
        ScatterRule("tree", 3, 0.3, 1.0, (0.6, 0.8)),
    ),
    "grass": (
        ScatterRule("bush", 5, 0.6, 3.0, (0.6, 1.2)),
        ScatterRule("tree", 5, 1.0, 4.0),
        ScatterRule("flower", 8, 0.1, 0.8, (0.4, 0.7)),
    ),
    "savanna": (
        ScatterRule("tree", 5, 1.2, 4.5, (0.9, 1.3)),
        ScatterRule("bush", 9, 0.4, 3.0, (0.4, 0.9), (_DRY,)),
    ),
    "forest": (
        ScatterRule("pine", 12, 0.25, 3.0, (0.8, 1.4)),
        ScatterRule("tree", 8, 0.35, 2.5, (0.9, 1.4)),
        ScatterRule("bush", 5, 0.2, 1.0, (0.5, 1.0)),
        ScatterRule("pine", 16, 2.0, 7.0, (1.0, 1.5)),
    ),
    "underwater": REEF,
    "sand": (ScatterRule("palm", 3, 0.7, 2.5), ScatterRule("rock", 4, 0.3, 2.0, (0.4, 1.0))),
    "snow": (ScatterRule("pine", 8, 0.7, 3.5, (0.7, 1.2)),),
    "mountain": (
        _MOUNTAINS,
        ScatterRule("pine", 10, 0.6, 3.5, (0.7, 1.2)),
        ScatterRule("rock", 5, 0.2, 1.5, (0.4, 1.2)),
    ),
    "river": (
        ScatterRule("tree", 5, 0.3, 3.0, (0.7, 1.2)),
        ScatterRule("bush", 9, 0.15, 2.0, (0.4, 1.0)),
        ScatterRule("rock", 6, 0.1, 1.5, (0.2, 0.6)),
    ),
    "lake": (
        ScatterRule("tree", 3, 0.2, 1.0, (0.7, 1.2)),
        ScatterRule("bush", 7, 0.1, 1.0, (0.3, 0.8)),
        ScatterRule("rock", 5, 0.1, 1.0, (0.2, 0.5)),
    ),
    "gravel": (ScatterRule("rock", 6, 0.2, 2.0, (0.2, 0.6)),
               ScatterRule("bush", 4, 0.5, 2.5, (0.4, 0.8))),
    "soil": (ScatterRule("rock", 6, 0.2, 2.0, (0.15, 0.5)),
             ScatterRule("bush", 4, 0.6, 2.5, (0.4, 0.8))),
    "indoor": along_walls(("bookshelf", 1), ("chair", 2), ("lamp", 1), is_told=False),
    "living room": along_walls(
        ("sofa", 1), ("fireplace", 1), ("armchair", 2), ("lamp", 1), ("large painting", 2),
        ("chest of drawers", 1), ("bookshelf", 1), ("potted plant", 2), ("grandfather clock", 1),
    ),
    "kitchen": along_walls(
        ("kitchen cabinet", 2), ("refrigerator", 1), ("oven", 1), ("kitchen sink", 1),
        ("kitchen cabinet", 1), ("table", 1), ("chair", 2),
    ),
    "bedroom": along_walls(
        ("bed", 1), ("wardrobe", 1), ("lamp", 1), ("chest of drawers", 1), ("large painting", 1),
        ("bookshelf", 1), ("chair", 1),
    ),
    "office": along_walls(
        ("computer desk", 3), ("bookshelf", 2), ("whiteboard", 1), ("potted plant", 1),
        ("office chair", 1), ("wardrobe", 1),
    ),
    "workshop": along_walls(
        ("desk", 2), ("chest", 1), ("shelf", 2), ("ladder", 1), ("box", 3), ("barrel", 2),
        ("table", 1),
    ),
    "warehouse": (
        *along_walls(("shelf", 8), ("crate", 3), ("barrel", 2)),
        ScatterRule("shelf", 3, 0.3, 0.9, (1.2, 1.4), faces_camera=True),
        ScatterRule("pallet", 2, 0.2, 0.8), ScatterRule("crate", 2, 0.3, 0.9),
    ),
    "gym": along_walls(("treadmill", 2), ("bench", 3), ("dumbbell", 2), ("basketball", 2)),
    "construction site": (
        ScatterRule("barrier", 3, 0.25, 0.8, (1.0, 1.0)),
        ScatterRule("scaffold", 2, 0.6, 1.6, (1.2, 1.6), faces_camera=True),
        ScatterRule("cement mixer", 1, 0.3, 0.9),
        ScatterRule("crane", 1, 1.2, 2.2, (0.9, 1.0)),
        ScatterRule("box", 4, 0.3, 1.0, (0.8, 1.4)),
    ),
}  # fmt: skip
"""Place → what stands around there."""

BACKDROPS: dict[str, tuple[ScatterRule, ...]] = {
    "mountain": (_MOUNTAINS,
                 ScatterRule("pine", 6, 0.8, 3.0, (0.8, 1.2))),
    "forest": SCENERY["forest"],
    "city": SCENERY["city"],
}  # fmt: skip
