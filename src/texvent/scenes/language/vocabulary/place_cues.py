"""Which places are inside, and which nouns tell whether a scene is inside or outside."""

from __future__ import annotations

ROOMS = frozenset(
    {"indoor", "living room", "kitchen", "bedroom", "gym", "classroom", "bathroom", "ballroom",
     "stage", "operating theatre", "hospital room", "train carriage", "cave", "boxing hall",
     "basketball court", "ice rink", "corridor", "hospital corridor",
     "school hallway", "airport hall", "storeroom", "cafeteria", "recording studio", "nursery",
     "pool hall"}
)  # fmt: skip
"""Enclosed places that are not known by their outside."""
BUILDINGS = frozenset(
    {"office", "workshop", "warehouse", "laboratory", "museum", "church hall", "subway station",
     "supermarket", "library", "restaurant", "bar", "nightclub", "factory", "garage", "car wash",
     "prison", "bowling alley", "pharmacy", "bakery", "cinema", "science museum"}
)  # fmt: skip
"""Enclosed places that are buildings to look at from outside."""
ENCLOSED = ROOMS | BUILDINGS
OUTSIDE = frozenset(
    {"past", "in front of", "outside", "outside of", "near", "behind", "over", "between",
     "next to", "beside", "opposite", "beyond", "above", "towards", "toward", "across from"}
)  # fmt: skip
"""Words after which an enclosed place is seen from outside."""
APPROACHES = frozenset({"leave", "exit", "pass", "approach", "near", "reach"})
"""Verbs whose object is seen from outside."""
OWN_GROUND = frozenset({"floor", "room", "stage", "hall", "ice", "court", "pool"})
"""Words of enclosed places that one may be above, or beside, while in them."""


def _words(text: str) -> frozenset[str]:
    return frozenset(text.split())


OUTDOOR_CUES: dict[str, frozenset[str]] = {
    "space": _words("spacecraft cosmonaut spacewalk")
    | {"space station", "space capsule", "space probe", "space telescope"},
    "sea": _words("wave surf surfer surfboard wakeboard seagull gull whale dolphin sailor yacht"),
    "stadium": _words(
        "referee penalty soccer footballer goalkeeper goalpost striker quarterback touchdown"
    ),
    "city": _words(
        "street shop taxi pedestrian traffic avenue sidewalk pavement curb bus tram limousine"
        " crosswalk skyline busker skyscraper storefront streetlight lamppost"
    ),
    "wheat field": _words("farmland farmhouse harvester crop") | {"combine harvester", "combine"},
    "soil": _words("plough plow furrow"),
    "railway": _words("train locomotive"),
    "forest": _words("branch monkey squirrel owl woodpecker lumberjack ape gorilla fern bear wolf"),
    "hills": _words("shepherd hiker"),
    "village": _words("villager rooftop"),
    "snow": _words("skier snowboarder sled snowman snowball"),
    "road": _words("car truck motorcycle van lorry motorbike cyclist"),
    "savanna": _words("safari"),
    "grass": _words(
        "sun sky sunshine sunlight moon star rain rainbow snow storm wind breeze fog mist cloud"
        " lightning thunder mud puddle grass field hill village mountain river lake tree bush"
        " flower bunker golfer golf bird eagle hawk falcon fox deer lion elephant zebra giraffe"
        " horse cow sheep goat tractor farmer gardener tent campfire kite airplane plane helicopter"
        " balloonist archer cowboy hunter picnic climber tiger kangaroo camel butterfly bee hedge"
        " panda stork crane peacock frog football frisbee javelin outdoors outdoor deckchair"
        " garden patio"
    )
    | {
        "picnic table",
        "picnic bench",
        "park bench",
        "garden table",
        "garden chair",
        "garden bench",
        "patio table",
        "patio chair",
        "lawn chair",
        "camping table",
        "camping chair",
        "market stall",
        "stall",
    },
}
"""Outdoor place → nouns that are found there or in places like it, the most telling first."""
OUTDOOR_LIGHTS = _words("sunset sunrise dusk dawn sundown daybreak twilight") | {
    "golden hour", "setting sun", "rising sun", "night sky"
}  # fmt: skip
"""Lights that are seen under the sky."""
FIELD_ACTS: dict[str, frozenset[str]] = {
    "soil": _words("plough plow harrow till sow"),
    "wheat field": _words("harvest reap thresh"),
}
"""Outdoor place → verbs of the farm work that is done there."""
KITCHEN_ACTS = _words("whisk knead fry grate saute simmer bake")
"""Verbs of what is done in a kitchen."""
FIELD_WORKERS = _words(
    "tractor farmer harvester ox horse wheat corn barley rye grain crop seed"
) | {"combine harvester"}
"""Nouns beside which these verbs are of a field: who does the work, and what grows there."""
FOOD_ACTS = _words("crack beat chop slice dice mince peel stir mix roll boil cook flip")
"""Verbs of what is done in a kitchen with food."""
FOODS = _words(
    "egg dough batter pancake onion carrot tomato potato vegetable garlic cucumber soup sauce"
    " stew omelette pasta noodle rice flour bacon mushroom celery pastry"
)
"""What is made or cut up in a kitchen."""
FARM_CUES = _words("barn stable farm farmer farmhouse hay cow sheep goat hen tractor")
"""Nouns beside buildings that stand on a farm, in no city."""
INDOOR_CUES: dict[str, frozenset[str]] = {
    "kitchen": _words("sink stove oven refrigerator fridge dishwasher microwave cooker kettle"
                      " countertop saucepan chef"),
    "bathroom": _words("bath bathtub shower toilet washbasin"),
    "laboratory": _words("microscope scientist chemist"),
    "workshop": _words("anvil lathe blacksmith workbench potter loom welder forge"),
    "ice rink": frozenset({"figure skater", "ice skater", "hockey player", "ice hockey player"}),
    "gym": _words("treadmill barbell dumbbell gymnast"),
    "classroom": _words("blackboard chalkboard pupil"),
    "indoor": _words(
        "bed pillow mattress crib bedside sofa couch armchair"
        " carpet rug wardrobe cupboard drawer shelf bookshelf ceiling wallpaper"
        " television tv screen monitor keyboard desk studio laboratory corridor lobby hallway"
        " elevator escalator piano chandelier fireplace radiator atrium stage indoors indoor floor"
        " parquet kitchen bedroom office basement attic cellar gym arena tabletop cutting"
    ),
}  # fmt: skip
"""Enclosed place → nouns that are found there, or in rooms of all kinds, the most telling first."""
