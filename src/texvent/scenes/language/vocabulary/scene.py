"""Words for places, light and weather."""

from __future__ import annotations

from texvent.scenes.language.vocabulary.built_places import BUILT_PLACES

PLACES: dict[str, tuple[str, ...]] = {
    "road": ("road", "lane", "asphalt", "country road", "paved road", "avenue road"),
    "dirt road": ("dirt road", "dirt track", "gravel road", "trail", "dirt path", "path", "mud"),
    "city": (
        "city", "skyline", "city skyline",
        "street", "town", "downtown", "urban", "sidewalk", "pavement",
        "city street", "intersection", "crossing", "crossroads", "junction",
        "street crossing", "road junction", "street corner",
    ),
    "grass": ("grass", "field", "meadow", "lawn", "pasture", "grassy field", "countryside",
              "landscape", "green landscape", "rural landscape", "open landscape"),
    "savanna": ("savanna", "savannah", "grassland", "plain", "prairie", "steppe", "grasslands"),
    "forest": ("forest", "wood", "jungle", "rainforest", "woodland", "grove", "pine forest"),
    "sea": ("sea", "ocean", "water", "open water", "open sea", "surf"),
    "lake": ("lake", "pond", "lakeside", "lake shore", "waterside", "reservoir"),
    "river": ("river", "stream", "riverbank", "river bank", "riverside", "creek", "brook", "canal"),
    "gravel": ("gravel",),
    "soil": ("soil", "dirt", "ploughed field", "plowed field", "earth", "clay ground"),
    "underwater": ("seabed", "reef", "coral reef", "coral", "deep sea"),
    "sand": ("sand",),
    "snow": ("snowy field", "snowfield", "arctic", "snow covered ground", "snowy landscape",
             "winter landscape", "snow covered landscape", "snow landscape"),
    "mountain": (
        "mountain", "mountain slope", "mountain side", "mountainside", "alps", "valley", "slope",
        "mountain range", "mountain peak", "mountain landscape", "mountain valley",
    ),
    "indoor": ("room", "house interior", "interior", "hall", "floor"),
    "living room": ("living room", "lounge", "sitting room"),
    "kitchen": ("kitchen",),
    "bedroom": ("bedroom",),
    "office": ("office",),
    "workshop": ("workshop",),
    "warehouse": ("warehouse", "warehouse aisle", "storehouse"),
    "gym": ("gym", "gymnasium", "sports hall"),
    "space": ("space", "outer space", "galaxy", "star field", "starfield", "field of stars"),
    "construction site": (
        "construction site", "building site", "construction zone", "construction work",
        "construction", "roadworks", "work site",
    ),
    **BUILT_PLACES,
    "plain": ("plain background", "background", "backdrop", "empty background", "plain ground"),
}  # fmt: skip
"""Place → words for it, in the singular (regular plurals are understood too)."""

PLACE_KINDS: dict[str, tuple[str, ...]] = {
    "city": (
        "avenue", "london", "paris", "new york", "tokyo",
        "boulevard", "promenade", "high street", "main street",
        "bus station", "railroad crossing", "railway crossing",
    ),
    "square": ("courtyard", "cloister"),
    "church hall": ("church",),
    "grass": (
        "orchard", "zoo", "riverbank", "picnic area",
        "clearing",
    ),
    "soil": ("farmland", "vegetable patch", "crop field"),
    "sand": ("island", "oasis", "sandpit", "sandbox"),
    "snow": ("ice", "frozen lake", "tundra"),
    "mountain": ("ridge", "summit", "peak"),
    "sea": ("bay", "lagoon", "fjord"),
    "lake": ("water hole", "waterhole"),
    "river": ("rapids", "ditch", "white water", "whitewater", "white water rapids"),
    "forest": ("park trail", "bamboo grove", "swamp forest"),
    "indoor": (
        "studio", "lobby", "palace", "court", "circus", "club", "courtroom", "dungeon",
        "waiting hall", "vestibule", "entrance hall", "foyer",
    ),
    "storeroom": ("attic", "basement", "cellar", "loft", "pantry", "shed interior"),
    "living room": ("dining room", "conservatory", "apartment", "flat", "hotel lobby"),
    "kitchen": ("restaurant kitchen",),
    "bedroom": ("hotel room", "dormitory"),
    "office": ("study", "home office", "conference room", "meeting room", "control room",
        "server room", "call center", "reception", "open plan office", "school", "waiting room"),
    "workshop": ("forge",),
    "warehouse": ("hangar", "mall", "barn", "depot"),
    "gym": ("dojo", "dance studio", "yoga studio"),
    "underwater": ("aquarium", "fish tank"),
}  # fmt: skip
"""Place → words for places that are shown as it, and reported so."""

PLACE_ADVERBS: dict[str, tuple[str, ...]] = {
    "rooftop": ("on a roof", "on the rooftop", "on a rooftop", "on the roof of a building",
                "on the roof of a skyscraper"),
    "sky": ("in the sky", "through the sky", "across the sky", "in the air", "through the air",
            "in midair", "mid air", "midair", "in the clouds", "through the clouds", "overhead"),
    "underwater": ("underwater", "under water", "under the sea", "under the water",
                   "beneath the waves"),
    "indoor": ("indoor", "indoors"),
    "train carriage": ("inside a train",),
    "church hall": ("inside a church",),
    "space": ("in orbit",),
    "city": ("downtown", "urban"),
    "mountain": ("mountainous", "alpine"),
}  # fmt: skip
"""Place → phrases that need no preposition."""

CROSSINGS = ("intersection", "crossing", "crossroads", "junction", "street crossing",
             "road junction", "street corner")  # fmt: skip
"""Places where another road crosses."""
ROAD_SHAPES: dict[str, tuple[str, ...]] = {
    "curved": ("curved", "winding", "curvy", "bending", "twisting"),
    "straight": ("straight",),
}

COLOURABLE = frozenset(
    {"grass", "savanna", "sand", "indoor", "plain", "beach", "living room", "kitchen", "bedroom",
     "office", "workshop", "warehouse", "gym"}
)  # fmt: skip
"""Places whose ground takes the colour that the prompt says."""
NATURAL_COLOURS: dict[str, tuple[str, ...]] = {
    "sea": ("blue", "green", "turquoise"),
    "lake": ("blue", "green"),
    "river": ("blue", "green"),
    "underwater": ("blue", "turquoise"),
    "forest": ("green",),
    "road": ("grey", "gray", "black"),
    "dirt road": ("brown",),
    "snow": ("white",),
    "mountain": ("grey", "gray", "green"),
}
"""Colours that a place has anyway, so that naming them is understood."""

LIGHTS: dict[str, tuple[str, ...]] = {
    "day": ("day", "daytime", "daylight", "noon", "midday", "morning", "afternoon"),
    "sunny": ("sunlight", "sunshine", "sun", "bright sun", "bright sunlight", "summer",
              "midday sun"),
    "dusk": ("dusk", "sunset", "evening", "twilight", "golden hour", "setting sun", "sundown",
             "low sun"),
    "dawn": ("dawn", "sunrise", "daybreak", "rising sun", "early morning", "early sunlight"),
    "night": ("night", "nighttime", "midnight", "darkness", "nightfall", "night sky", "dark"),
    "moonlight": ("moonlight", "moon", "full moon"),
    "lamp": ("lamplight", "lamp light", "candlelight", "indoor light", "street light glow",
             "artificial light", "neon light", "fluorescent light", "street lighting",
             "streetlight"),
}  # fmt: skip
LIGHT_ADJECTIVES: dict[str, tuple[str, ...]] = {
    "day": ("well lit", "brightly lit"),
    "sunny": ("sunny", "sunlit"),
    "overcast": ("overcast", "gloomy", "cloudy day", "grey day", "gray day"),
    "night": ("starry", "dim", "dimly lit", "unlit", "nocturnal", "low light"),
    "moonlight": ("moonlit",),
    "lamp": ("neon", "fluorescent", "candlelit", "lamplit", "gaslit"),
}  # fmt: skip
LIGHT_PHRASES: dict[str, tuple[str, ...]] = {
    "day": ("by day", "during the day", "in daylight"),
    "sunny": ("in the sun", "bright day", "sunny day", "clear day"),
    "overcast": ("overcast sky", "under an overcast sky"),
    "night": (
        "at night",
        "in the dark",
        "by night",
        "in darkness",
        "starry night",
        "under the stars",
        "beneath the stars",
        "full of stars",
        "stars twinkle",
        "stars shine",
        "stars sparkle",
        "stars glitter",
        "stars glow",
        "stars twinkling",
        "stars shining",
        "twinkling stars",
        "stars above",
        "stars overhead",
        "stars come out",
        "stars appear",
        "stars in the sky",
        "stars in the night sky",
        "thousands of stars",
        "under a canopy of stars",
        "starlit",
    ),
}

DARK_PLACES_LIGHT = "night"
"""Light that "dark" asks for before a place ("a dark street")."""

WEATHERS: dict[str, tuple[str, ...]] = {
    "fog": ("fog", "mist", "haze", "smog", "morning mist"),
    "rain": (
        "rain",
        "raindrops",
        "rainstorm",
        "storm",
        "downpour",
        "heavy rain",
        "falling rain",
        "drizzle",
        "rain shower",
    ),
    "snow": ("snowfall", "falling snow", "blizzard", "snowstorm"),
}
WEATHER_ADJECTIVES: dict[str, tuple[str, ...]] = {
    "fog": ("foggy", "misty", "hazy"),
    "rain": ("rainy", "raining", "stormy"),
    "snow": ("snowing",),
}
WEATHER_VERBS: dict[str, str] = {
    "rain": "rain", "rains": "rain", "raining": "rain", "snows": "snow", "snowing": "snow",
}  # fmt: skip
"""Verbs of "it": "it rains"."""

CLOUDS: dict[float, tuple[str, ...]] = {
    0.8: ("cloudy", "cloudy sky"),
    0.5: ("clouds",),
    0.4: ("partly cloudy",),
    0.0: ("cloudless", "clear sky", "clear skies"),
}  # fmt: skip

SNOWY = ("snow", "snowy", "snow covered", "winter", "wintry")
"""Words that mean snow on the ground."""
SNOW_CAPPED = ("snow capped", "snowcapped", "snow topped", "snow peaked")
"""What mountains are anyway."""

STEEP = ("steep", "uphill", "downhill", "slope", "sloping", "hilly")
WAVES = tuple(
    f"{kind} {waves} {moving}".strip()
    for kind in ("", "ocean", "sea", "water", "big", "high", "huge")
    for waves in ("waves", "swell")
    for moving in ("", "crash", "crashing", "break", "breaking", "roll", "rolling", "lap",
                   "lapping", "wash", "washing", "move", "moving", "rise and fall")
)  # fmt: skip
"""Waves of water, with what they do."""
ROUGH = ("rough", "choppy", "wavy", "turbulent", "raging")
"""What water with waves is."""
DUST = ("dust", "dust cloud", "dust clouds", "dust trail")

SKY_WORDS = ("sky", "skies")

STROBES = ("strobe light", "strobe", "stroboscope", "strobe lamp", "strobe lighting",
           "stroboscopic light", "strobe effect", "strobe flash")  # fmt: skip
"""Nouns of light that flashes in the dark."""
STROBE_HZ = 7.0
SWITCH_HZ = 0.8
"""How often a light is switched on and off."""
FLICKERS = ("flicker", "strobe", "blink", "flash", "twinkle")
"""Verbs of lights that go on and off."""
DEFAULT_BLINK_HZ = 2.0
"""Blinking of one lamp whose frequency is not said, Hz."""
DEFAULT_FLICKER_HZ = 10.0
"""Flicker whose frequency is not said, Hz."""

TIMELAPSES = ("timelapse", "time lapse", "timelapse video", "time lapse video", "hyperlapse",
              "time lapse shot", "timelapse footage")  # fmt: skip
"""Nouns of clips whose sky goes much faster than in life."""

SHADOW_WORDS = ("shadow", "shadows", "casting shadows", "long shadows", "casts a shadow")

GLOW_NOUNS = ("light", "lights", "lighting", "glow")
"""Understood when a light is described; alone they change nothing and are reported."""

PARTS_SHOWN: dict[str, tuple[str, ...]] = {
    "drive": ("tire", "tires", "tyre", "tyres", "wheel", "wheels", "window", "windows", "roof",
              "windscreen", "windshield", "headlight", "headlights", "tail light", "tail lights"),
    "suv": ("roof rack", "rack"),
    **dict.fromkeys(("mobile robot", "trolley", "shopping cart", "wheelchair", "stroller",
                     "skateboard", "luggage cart"), ("wheel", "wheels")),
    "walk": ("leg", "legs", "head", "tail", "ear", "ears", "foot", "feet", "paw", "paws", "body"),
    "swim": ("tail", "fin", "fins"),
    "fly": ("wing", "wings", "tail", "rotor", "rotors", "propeller", "propellers"),
    "sail": ("hull",),
    "sailboat": ("sail", "sails", "mast"),
    "person": ("arm", "arms", "hand", "hands", "hair", "face", "head", "leg", "legs", "neck"),
    "excavator": ("arm", "boom", "bucket"),
    "spinning disc": ("sector", "sectors", "segment", "segments", "stripe", "stripes"),
    **dict.fromkeys(("flower", "sunflower", "rose", "tulip", "daisy"), ("petal", "petals")),
    "mushroom": ("cap", "caps"),
    "tree": ("trunk", "branch", "branches", "leaves"),
    "satellite": ("solar panel", "solar panels", "solar array", "solar arrays"),
    "house": ("door", "window", "windows", "roof", "wall", "walls"),
}  # fmt: skip
"""Usual motion or name of a noun, "person" for all people → parts that its model shows in any
case."""
PART_WORDS = tuple(sorted({part for parts in PARTS_SHOWN.values() for part in parts}))
PART_COLOURS: dict[tuple[str, str], str] = {
    ("suv", "roof rack"): "black",
    **{
        ("spinning disc", part): "black"
        for part in ("sector", "sectors", "segment", "segments", "stripe", "stripes")
    },
}
"""(noun, part) that a model shows in any case → the colour it has."""
SPELT = ("letter", "letters", "digit", "number", "word", "words")
"""Nouns before what is written: "the letter B"."""

PLACE_PREPOSITIONS = frozenset(
    {"in", "on", "at", "through", "across", "along", "into", "inside", "over", "by", "past", "down",
     "up", "around", "near", "onto", "within", "throughout", "above", "upon", "next to", "beside",
     "from", "to", "towards", "toward", "off", "under", "of", "against", "facing", "with",
     "in front of", "behind", "during", "out of", "among", "surrounded by", "between", "amid",
     "beneath", "below", "on top of", "atop"}
)  # fmt: skip
"""Prepositions after which a place is where the scene is."""
LIGHT_PREPOSITIONS = frozenset(
    {"in", "at", "by", "under", "during", "on", "with", "into", "of", "against", "before", "from",
     "as", "through"}
)  # fmt: skip
