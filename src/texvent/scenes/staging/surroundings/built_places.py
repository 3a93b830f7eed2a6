"""Grounds and scenery of the places of `vocabulary.built_places`."""

from __future__ import annotations

from texvent.scenes.scene import Colour, Ground, Texture
from texvent.scenes.staging.surroundings.ground_appearance import (
    ASPHALT,
    BOARDS,
    GREY,
    MEADOW,
    PALE,
    GroundAppearance,
    room,
)
from texvent.scenes.staging.surroundings.more_places import MORE_GROUNDS, MORE_SCENERY
from texvent.scenes.staging.surroundings.scenery.scatter_rule import (
    ScatterRule,
    along_walls,
    facing,
    under,
)

_CHEQUERED: tuple[Colour, Colour] = ((0.74, 0.72, 0.66), (0.06, 0.055, 0.05))
_DARK_BOARDS: tuple[Colour, Colour] = ((0.20, 0.10, 0.05), (0.27, 0.15, 0.08))
_WHITE: Colour = (0.74, 0.75, 0.75)
_SOIL: tuple[Colour, Colour] = ((0.30, 0.20, 0.11), (0.38, 0.27, 0.16))
_SAND: tuple[Colour, Colour] = ((0.60, 0.45, 0.24), (0.70, 0.55, 0.33))
_ICE: tuple[Colour, Colour] = ((0.78, 0.84, 0.88), (0.70, 0.78, 0.84))


def _grass(first: Colour = MEADOW[0], second: Colour = MEADOW[1]) -> GroundAppearance:
    return GroundAppearance(Ground.GRASS, first, second)


def _plain(colours: tuple[Colour, Colour], surface: Texture) -> GroundAppearance:
    return GroundAppearance(Ground.PLAIN, *colours, surface=surface)


BUILT_GROUNDS: dict[str, GroundAppearance] = {
    "laboratory": room(Texture.TILES, PALE, Texture.PLASTER, _WHITE),
    "classroom": room(Texture.BOARDS, BOARDS, Texture.PLASTER, (0.72, 0.70, 0.58)),
    "bathroom": room(Texture.TILES, PALE, Texture.TILES, (0.45, 0.62, 0.70)),
    "museum": room(Texture.BOARDS, BOARDS, Texture.PLASTER, (0.70, 0.68, 0.64)),
    "church hall": room(Texture.PAVING, GREY, Texture.STONE, (0.50, 0.47, 0.42)),
    "ballroom": room(Texture.TILES, _CHEQUERED, Texture.WALLPAPER, (0.62, 0.48, 0.26)),
    "stage": room(Texture.BOARDS, _DARK_BOARDS, Texture.CLOTH, (0.10, 0.03, 0.035)),
    "operating theatre": room(Texture.TILES, PALE, Texture.TILES, (0.40, 0.60, 0.55)),
    "hospital room": room(Texture.TILES, PALE, Texture.PLASTER, (0.66, 0.74, 0.76)),
    "subway station": room(Texture.PAVING, GREY, Texture.TILES, (0.62, 0.63, 0.60)),
    "train carriage": room(Texture.CARPET, ((0.14, 0.15, 0.18), (0.20, 0.21, 0.24)),
        Texture.PLASTER,
                           (0.66, 0.67, 0.68)),
    "supermarket": room(Texture.TILES, PALE, Texture.PLASTER, _WHITE),
    "library": room(Texture.CARPET, ((0.24, 0.09, 0.06), (0.32, 0.14, 0.09)), Texture.PLASTER,
                    (0.52, 0.44, 0.32)),
    "restaurant": room(Texture.BOARDS, _DARK_BOARDS, Texture.WALLPAPER, (0.55, 0.38, 0.24)),
    "bar": room(Texture.BOARDS, _DARK_BOARDS, Texture.WOOD, (0.24, 0.13, 0.07)),
    "nightclub": room(Texture.TILES, ((0.05, 0.04, 0.10), (0.12, 0.05, 0.20)), Texture.PLASTER,
                      (0.08, 0.05, 0.14)),
    "factory": room(Texture.CONCRETE, GREY, Texture.CONCRETE, (0.42, 0.43, 0.44)),
    "garage": room(Texture.CONCRETE, GREY, Texture.BRICK, (0.42, 0.36, 0.32)),
    "car wash": room(Texture.CONCRETE, GREY, Texture.TILES, (0.45, 0.62, 0.72)),
    "ice rink": room(Texture.SNOW, _ICE, Texture.PLASTER, (0.50, 0.56, 0.64)),
    "cave": room(Texture.SOIL, ((0.15, 0.12, 0.10), (0.22, 0.18, 0.15)), Texture.STONE,
                 (0.24, 0.20, 0.17)),
    "prison": room(Texture.CONCRETE, GREY, Texture.STONE, (0.40, 0.40, 0.38)),
    "bowling alley": room(Texture.BOARDS, BOARDS, Texture.PLASTER, (0.22, 0.16, 0.34)),
    "boxing hall": room(Texture.CONCRETE, GREY, Texture.BRICK, (0.34, 0.20, 0.16)),
    "basketball court": room(Texture.BOARDS, BOARDS, Texture.PLASTER, (0.50, 0.54, 0.60)),
    "street court": _plain(((0.16, 0.20, 0.24), (0.20, 0.24, 0.28)), Texture.ASPHALT),
    "corridor": room(Texture.CARPET, ((0.28, 0.08, 0.07), (0.34, 0.11, 0.09)), Texture.PLASTER,
                     (0.70, 0.66, 0.56)),
    "hospital corridor": room(Texture.TILES, PALE, Texture.PLASTER, (0.66, 0.74, 0.76)),
    "alley": _plain(((0.20, 0.20, 0.20), (0.26, 0.25, 0.24)), Texture.PAVING),
    "road tunnel": _plain((ASPHALT, (0.055, 0.055, 0.057)), Texture.ASPHALT),
    "rooftop": _plain(((0.40, 0.39, 0.37), (0.33, 0.32, 0.31)), Texture.CONCRETE),
    "balcony": _plain(((0.52, 0.47, 0.42), (0.44, 0.39, 0.34)), Texture.TILES),
    "square": _plain(((0.46, 0.43, 0.38), (0.38, 0.35, 0.31)), Texture.PAVING),
    "beach": GroundAppearance(Ground.LAKE, (0.62, 0.49, 0.30), (0.016, 0.13, 0.17),
                              surface=Texture.SAND),
    "school hallway": room(Texture.TILES, PALE, Texture.PLASTER, (0.62, 0.66, 0.60)),
    "airport hall": room(Texture.TILES, PALE, Texture.CONCRETE, (0.62, 0.64, 0.66)),
    "storeroom": room(Texture.BOARDS, _DARK_BOARDS, Texture.WOOD, (0.34, 0.22, 0.13)),
    "cafe terrace": _plain(((0.34, 0.31, 0.28), (0.42, 0.39, 0.35)), Texture.PAVING),
    "fairground": _plain(((0.30, 0.26, 0.22), (0.37, 0.33, 0.28)), Texture.GRAVEL),
    "driveway": _grass(),
    "swimming pool": GroundAppearance(Ground.LAKE, (0.56, 0.54, 0.48), (0.02, 0.24, 0.33),
                                      surface=Texture.PAVING),
    "motorway": GroundAppearance(Ground.ROAD, MEADOW[0], ASPHALT, 8.0),
    "market": _plain(((0.34, 0.31, 0.28), (0.42, 0.39, 0.35)), Texture.PAVING),
    "harbour": GroundAppearance(Ground.LAKE, (0.34, 0.33, 0.31), (0.016, 0.07, 0.10),
                                surface=Texture.CONCRETE),
    "runway": _grass(),
    "stadium": _grass((0.04, 0.17, 0.02), (0.09, 0.24, 0.04)),
    "running track": _grass((0.04, 0.17, 0.02), (0.09, 0.24, 0.04)),
    "tennis court": _plain(((0.04, 0.22, 0.10), (0.05, 0.25, 0.12)), Texture.CONCRETE),
    "farmyard": _plain(_SOIL, Texture.SOIL),
    "backyard": _grass(),
    "park": _grass(),
    "playground": _plain(_SAND, Texture.SAND),
    "railway": _grass(),
    "train station": _grass(),
    "parking lot": _plain(((0.07, 0.07, 0.072), (0.05, 0.05, 0.052)), Texture.ASPHALT),
    "hills": _grass(),
    "dunes": GroundAppearance(Ground.SAND, *_SAND),
    "desert": GroundAppearance(Ground.SAND, *_SAND),
    "canyon": GroundAppearance(Ground.SAND, (0.46, 0.22, 0.10), (0.56, 0.30, 0.15)),
    "cliffs": _grass((0.10, 0.13, 0.05), (0.22, 0.20, 0.12)),
    "volcanic land": _plain(((0.06, 0.05, 0.05), (0.10, 0.08, 0.075)), Texture.SOIL),
    "falls": _plain(((0.20, 0.20, 0.18), (0.28, 0.27, 0.24)), Texture.GRAVEL),
    "wheat field": _grass((0.46, 0.32, 0.08), (0.60, 0.45, 0.15)),
    "cornfield": _plain(_SOIL, Texture.SOIL),
    "vineyard": _plain(_SOIL, Texture.SOIL),
    "cemetery": _grass((0.05, 0.11, 0.025), (0.10, 0.16, 0.04)),
    "arena": GroundAppearance(Ground.SAND, (0.44, 0.32, 0.19), (0.52, 0.39, 0.24)),
    "ski slope": GroundAppearance(Ground.SNOW, (0.66, 0.70, 0.75), (0.76, 0.79, 0.83)),
    "village": GroundAppearance(Ground.DIRT_ROAD, (0.07, 0.12, 0.03), (0.34, 0.22, 0.12), 2.4),
    **MORE_GROUNDS,
}  # fmt: skip
"""Ground of every place of `vocabulary.built_places`."""


def _both_sides(noun: str) -> tuple[ScatterRule, ...]:
    """Walls along the view, wider where what goes there needs it."""
    return tuple(
        ScatterRule(noun, 1, 0.0, 0.0, (wide, wide), encloses=True) for wide in (1.0, 1.4, 2.0)
    )


def _across(noun: str) -> ScatterRule:
    return ScatterRule(noun, 1, 0.0, 0.0, (1.0, 1.0), is_beyond=True)


def _skyline(count: int, near_m: float, far_m: float) -> ScatterRule:
    """Houses beyond a parapet, whose feet it hides."""
    return ScatterRule("building", count, near_m, far_m, (0.6, 1.1), is_metres=True,
                       faces_camera=True)  # fmt: skip


BUILT_SCENERY: dict[str, tuple[ScatterRule, ...]] = {
    "laboratory": (*along_walls(("lab bench", 4), ("centrifuge", 1)), facing("lab bench", 1,
        0.2, 0.6)),
    "classroom": (*along_walls(("wall blackboard", 2)), *(facing("school desk", 8, 0.1, 1.2),)),
    "bathroom": along_walls(("bathtub", 1), ("toilet", 1), ("sink", 2), ("shower", 1), ("mirror",
        1)),
    "museum": (*along_walls(("large painting", 8)), facing("display case", 3, 0.2, 0.9),
               facing("statue", 1, 0.4, 1.0)),
    "church hall": (*along_walls(("stained glass", 6), ("altar", 1)), facing("church pew", 6,
        0.1, 1.0)),
    "ballroom": along_walls(("hall mirror", 4), ("hall column", 6)),
    "stage": along_walls(("stage curtain", 9)),
    "operating theatre": (facing("operating lamp", 1, 0.1, 0.4), facing("operating table", 1,
        0.2, 0.7),
                          *along_walls(("medical monitor", 3))),
    "hospital room": along_walls(("bed", 2), ("medical monitor", 3), ("curtain", 1)),
    "subway station": (under("platform edge"), *along_walls(("subway train", 2), ("bench", 2))),
    "train carriage": (*along_walls(("train window", 6)), facing("train seat", 6, 0.1, 1.0)),
    "supermarket": (*along_walls(("grocery shelf", 6)), facing("grocery shelf", 2, 0.4, 0.9),
                    facing("shopping cart", 1, 0.2, 0.6)),
    "library": (*along_walls(("bookshelf", 10)), facing("desk", 1, 0.3, 0.9)),
    "restaurant": (facing("restaurant table", 6, 0.1, 1.2), *along_walls(("potted plant", 2))),
    "bar": (*along_walls(("bar counter", 3)), facing("stool", 4, 0.1, 0.7)),
    "nightclub": (*along_walls(("disco lights", 4), ("speaker", 4)), facing("disco ball", 1,
        0.2, 0.6)),
    "factory": (*along_walls(("factory machine", 6)), facing("conveyor belt", 1, 0.3, 0.8)),
    "garage": (*along_walls(("tyre stack", 3), ("desk", 1), ("shelf", 2)),
               facing("car lift", 1, 0.3, 0.9)),
    "car wash": (under("car wash arch"), facing("car wash brush", 3, 0.1, 0.7)),
    "ice rink": along_walls(("rink boards", 12)),
    "cave": (*along_walls(("stalagmite", 8)), facing("stalagmite", 6, 0.1, 1.0, 0.6)),
    "prison": along_walls(("cell bars", 5), ("bunk bed", 1)),
    "bowling alley": (under("bowling lane"), *along_walls(("bench", 2))),
    "boxing hall": (under("boxing ring ropes"), *along_walls(("punching bag", 3), ("bench", 2))),
    "basketball court": (under("basketball court lines"), facing("basketball hoop", 2,
        0.1, 0.7, 1.0), *along_walls(("bench", 3))),
    "street court": (under("basketball court lines"), facing("basketball hoop", 2, 0.1, 0.8,
        1.0), facing("corral fence", 6, 0.9, 1.6), ScatterRule("building", 3, 2.0, 4.0, (0.5,
        0.8)),
                     ScatterRule("tree", 4, 1.6, 3.5)),
    "corridor": _both_sides("corridor walls"),
    "hospital corridor": _both_sides("ward walls"),
    "school hallway": _both_sides("locker walls"),
    "alley": _both_sides("alley walls"),
    "road tunnel": _both_sides("tunnel walls"),
    "rooftop": (_across("roof parapet"), facing("roof unit", 2, 0.05, 0.35, 1.0),
                _skyline(10, 45.0, 130.0)),
    "balcony": (_across("balcony rail"), ScatterRule("potted plant", 3, 0.02, 0.3),
                _skyline(8, 40.0, 100.0), ScatterRule("tree", 4, 25.0, 50.0, is_metres=True)),
    "square": (facing("fountain", 1, 0.5, 1.2, 1.0), facing("building", 6, 1.3, 2.4, 0.6),
               ScatterRule("bench", 3, 0.2, 1.0), ScatterRule("street lamp", 3, 0.3, 1.2)),
    "beach": (ScatterRule("palm", 2, 0.1, 0.5), ScatterRule("rock", 6, 0.02, 0.6, (0.2, 0.5))),
    "airport hall": (*along_walls(("check-in desk", 4), ("flight board", 2)), facing("train seat",
        4, 0.2, 1.0), facing("flight board", 1, 0.5, 0.9)),
    "storeroom": (*along_walls(("chest", 2), ("crate", 3), ("rocking chair", 1), ("box", 3),
        ("barrel", 1), ("mirror", 1)), facing("crate", 2, 0.3, 0.9)),
    "cafe terrace": (facing("terrace table", 7, 0.1, 1.2), facing("building", 3, 1.6, 2.6, 0.5),
                     ScatterRule("potted plant", 3, 0.3, 1.2), ScatterRule("tree", 2, 1.4, 2.4)),
    "fairground": (facing("ferris wheel", 1, 1.0, 1.8, 0.9), facing("merry-go-round", 1, 0.4,
        1.2),
                   facing("market stall", 5, 0.2, 1.2), ScatterRule("person", 4, 0.3, 1.2, (0.95,
                       1.05)), facing("roller coaster", 1, 1.6, 2.8, 0.9)),
    "driveway": (under("drive slab"), facing("garage front", 1, 0.5, 1.2, 1.0), facing(
        "wooden house", 2, 1.0, 2.4, 0.9), facing("garden fence", 4, 0.6, 1.4), ScatterRule("bush",
            4, 0.4, 1.2, (0.5, 0.9))),
    "swimming pool": (
        ScatterRule("lane rope", 6, 0.15, 1.2, (1.0, 1.0), is_afloat=True, faces_camera=True),
        facing("diving board", 1, 0.05, 0.3), ScatterRule("sun lounger", 4, 0.05,
        0.5)),
    "motorway": (facing("motorway sign", 2, 0.6, 2.0), facing("guard rail", 10, 0.2, 2.0),
                 ScatterRule("tree", 5, 1.0, 4.0)),
    "market": (facing("market stall", 8, 0.15, 1.3), ScatterRule("person", 6, 0.1, 1.0, (0.95,
        1.05)),
               ScatterRule("house", 3, 1.6, 3.0, (1.0, 1.3))),
    "harbour": (ScatterRule("mooring post", 6, 0.02, 0.3), ScatterRule("crate", 3, 0.02, 0.3),
                ScatterRule("barrel", 3, 0.02, 0.3),
                ScatterRule("sailboat", 5, 0.3, 1.6, (0.6, 1.0), is_afloat=True),
                ScatterRule("boat", 4, 0.25, 1.0, (0.7, 1.0), is_afloat=True)),
    "runway": (under("runway markings"), ScatterRule("runway light", 8, 0.0, 1.0, (0.8, 1.0)),
               facing("control tower", 1, 1.2, 2.2), facing("hangar", 2, 1.3, 2.6)),
    "stadium": (under("pitch lines"), facing("grandstand", 5, 1.2, 3.0),
                ScatterRule("floodlight mast", 3, 1.6, 3.0), facing("goal", 1, 0.6, 1.4, 1.0)),
    "running track": (under("running lanes"), facing("grandstand", 4, 1.2, 3.0),
                      ScatterRule("floodlight mast", 2, 1.6, 3.0)),
    "tennis court": (under("tennis court lines", 4.5), ScatterRule("garden fence", 6, 1.6, 3.0),
        ScatterRule("tree", 4, 2.2, 5.0),
                     facing("bench", 2, 0.9, 1.6)),
    "farmyard": (facing("barn", 2, 1.0, 2.5, 0.8), ScatterRule("hay bale", 5, 0.3, 1.4),
                 facing("corral fence", 6, 0.3, 1.6), ScatterRule("tractor", 1, 0.8, 1.6, (0.9,
                     1.0)),
                 ScatterRule("tree", 2, 1.8, 3.5)),
    "backyard": (facing("wooden house", 2, 0.9, 2.0, 0.9), facing("garden fence", 8, 0.4, 1.2),
                 ScatterRule("bush", 4, 0.3, 1.2, (0.5, 0.9)), ScatterRule("flower", 8, 0.1, 0.8,
                     (0.4, 0.7))),
    "park": (under("gravel path lines"), facing("bench", 3, 0.2, 1.0), ScatterRule("park lamp",
        3, 0.3,
        1.4),
             ScatterRule("tree", 7, 0.7, 3.5), ScatterRule("bush", 5, 0.4, 2.0)),
    "playground": (facing("slide", 2, 0.3, 1.1), facing("swing", 2, 0.3, 1.2),
        facing("seesaw", 1, 0.2, 0.9),
                   ScatterRule("tree", 4, 1.4, 3.5), facing("garden fence", 5, 1.0, 1.8)),
    "train station": (under("railway track"), _across("station platform")),
    "railway": (under("long railway track"), ScatterRule("bush", 6, 0.3, 2.0),
                ScatterRule("tree", 5, 1.0, 3.5),
                ScatterRule("power pylon", 2, 1.2, 3.0)),
    "parking lot": (under("parking lines"), ScatterRule("car", 6, 0.25, 1.5, (0.95, 1.05)),
                    ScatterRule("street lamp", 2, 0.5, 1.6), facing("building", 3, 2.0, 4.0, 0.6)),
    "hills": (ScatterRule("green hill", 7, 40.0, 110.0, (0.9, 1.5), is_metres=True),
        ScatterRule("tree", 4, 0.8, 3.0),
              ScatterRule("flower", 6, 0.1, 0.8, (0.4, 0.7))),
    "dunes": (ScatterRule("dune mound", 8, 1.0, 4.5, (0.8, 1.8)),),
    "desert": (ScatterRule("cactus", 5, 0.3, 2.5, (1.1, 2.0)), ScatterRule("dune mound", 5, 1.8,
        5.0, (0.8, 1.8)),
               ScatterRule("rock", 5, 0.2, 2.0, (0.4, 1.0))),
    "canyon": (facing("canyon wall", 7, 1.0, 3.5, 0.8), ScatterRule("rock", 6, 0.2, 1.5, (0.4,
        1.1))),
    "cliffs": (facing("cliff", 5, 1.0, 3.0, 0.8), ScatterRule("rock", 6, 0.2, 1.5, (0.4, 1.1))),
    "volcanic land": (ScatterRule("volcano", 2, 90.0, 170.0, (0.9, 1.2), is_metres=True),
                      ScatterRule("lava flow", 3, 0.4, 1.6), ScatterRule("rock", 7, 0.2, 2.0,
                        (0.4, 1.0))),
    "falls": (facing("rock waterfall", 1, 0.6, 1.2), facing("cliff", 3, 1.2, 2.5, 0.6),
              ScatterRule("rock", 6, 0.2, 1.2, (0.4, 1.0)), ScatterRule("tree", 4, 1.0, 2.5)),
    "wheat field": (facing("crop row", 14, 0.1, 1.8), ScatterRule("tree", 3, 2.0, 4.5)),
    "cornfield": (facing("corn row", 16, 0.1, 1.8), ScatterRule("tree", 3, 2.0, 4.5)),
    "vineyard": (facing("vine row", 12, 0.15, 1.8), ScatterRule("green hill", 2, 2.5, 5.0),
                 ScatterRule("house", 1, 2.0, 3.5)),
    "cemetery": (facing("gravestone", 12, 0.1, 1.3), ScatterRule("tree", 4, 1.0, 3.0),
                 ScatterRule("church", 1, 1.8, 3.0, (0.9, 1.0))),
    "arena": (facing("corral fence", 12, 0.4, 1.3), facing("grandstand", 3, 1.6, 3.0, 0.8)),
    "ski slope": (facing("slalom gate", 4, 0.1, 1.0), facing("ski lift", 1, 1.0, 2.0),
                  ScatterRule("mountain", 6, 120.0, 240.0, (0.9, 1.5), is_metres=True),
                  ScatterRule("pine", 9, 0.6, 3.0, (0.7, 1.2))),
    "village": (facing("wooden house", 4, 0.8, 2.6, 0.9), facing("garden fence", 4, 0.4, 1.2),
                ScatterRule("tree", 4, 0.8, 3.0), ScatterRule("church", 1, 1.8, 3.0, (0.9, 1.0))),
    **MORE_SCENERY,
}  # fmt: skip
"""Place → what stands around there."""

GENERIC = frozenset({"platform edge", "sailboat", "boat", "tree", "bush", "rock", "flower",
    "person", "bench", "house", "car", "barrel",
                     "crate", "pine", "potted plant", "stool", "building"})  # fmt: skip
"""Scenery of so many places that it marks none of these."""
BUILT_MARKS: dict[str, frozenset[str]] = {
    place: frozenset(rule.noun for rule in rules if rule.noun not in GENERIC)
    for place, rules in BUILT_SCENERY.items()
}
"""Place → nouns of which one must be in view for the place to be recognised."""
