"""Words for places, light, weather and the camera."""

from __future__ import annotations

PLACES: dict[str, tuple[str, ...]] = {
    "road": (
        "road", "highway", "motorway", "freeway", "lane", "asphalt", "race track", "racetrack",
        "country road", "paved road", "avenue road",
    ),
    "dirt road": ("dirt road", "dirt track", "gravel road", "trail", "dirt path", "path", "mud"),
    "city": (
        "city", "street", "town", "downtown", "urban", "avenue", "sidewalk", "pavement",
        "city street", "intersection", "crossing", "crossroads", "parking lot", "square",
    ),
    "grass": (
        "grass", "field", "meadow", "lawn", "park", "garden", "pasture", "farm", "yard",
        "grassy field", "countryside", "stadium", "pitch", "football field", "hill", "backyard",
        "playground",
    ),
    "savanna": ("savanna", "savannah", "grassland", "plain", "prairie", "steppe", "grasslands"),
    "forest": ("forest", "wood", "jungle", "rainforest", "woodland", "grove", "pine forest"),
    "sea": (
        "sea", "ocean", "lake", "river", "pond", "water", "bay", "waves", "harbor", "harbour",
        "open water", "open sea", "oceanic",
    ),
    "underwater": (
        "underwater", "under water", "seabed", "reef", "coral reef", "aquarium", "coral",
        "under the sea", "under the water", "deep sea", "beneath the waves", "fish tank",
    ),
    "sand": ("beach", "sand", "desert", "dune", "shore", "coast"),
    "snow": ("snowy field", "snowfield", "ice", "arctic", "snow covered ground", "glacier"),
    "mountain": (
        "mountain", "mountain slope", "mountain side", "mountainside", "mountainous", "alps",
        "valley", "slope", "hillside",
    ),
    "indoor": (
        "indoor", "indoors", "room", "living room", "kitchen", "house interior", "interior",
        "office", "hall", "gym", "bedroom", "floor", "warehouse", "factory", "corridor", "studio",
        "classroom", "museum",
    ),
    "sky": ("in the sky", "through the sky", "across the sky", "in the air", "through the air",
            "in midair", "mid air", "in the clouds", "through the clouds"),
    "space": ("space", "outer space", "galaxy", "in orbit"),
    "construction site": (
        "construction site", "building site", "construction zone", "construction work",
        "construction", "roadworks", "work site",
    ),
    "plain": ("plain background", "background", "backdrop", "empty background", "plain ground"),
}  # fmt: skip
"""Place → words for it, in the singular (regular plurals are understood too)."""

COLOURABLE = frozenset({"grass", "savanna", "sand", "indoor", "plain"})
"""Places whose ground takes the colour that the prompt says."""
NATURAL_COLOURS: dict[str, tuple[str, ...]] = {
    "sea": ("blue", "green", "turquoise"),
    "underwater": ("blue", "turquoise"),
    "forest": ("green",),
    "road": ("grey", "gray", "black"),
    "dirt road": ("brown",),
    "snow": ("white",),
    "mountain": ("grey", "gray", "green"),
}
"""Colours that a place has anyway, so that naming them is understood."""

LIGHTS: dict[str, tuple[str, ...]] = {
    "day": ("day", "daytime", "daylight", "noon", "midday", "by day", "morning", "afternoon",
            "well lit"),
    "sunny": ("sunny", "sunlight", "sunshine", "sun", "sunlit", "bright day", "bright sun",
              "bright sunlight", "clear day", "sunny day", "summer"),
    "overcast": ("overcast", "gloomy", "grey day", "gray day", "cloudy day", "overcast sky"),
    "dusk": ("dusk", "sunset", "evening", "twilight", "golden hour", "setting sun", "sundown"),
    "dawn": ("dawn", "sunrise", "daybreak", "rising sun", "early morning"),
    "night": ("night", "nighttime", "midnight", "at night", "in the dark", "darkness", "nightfall",
              "night sky", "starry night", "starry", "low light", "dim", "dimly lit"),
    "moonlight": ("moonlight", "moonlit", "moon", "full moon"),
    "lamp": ("lamplight", "lamp light", "candlelight", "indoor light", "street light glow",
             "artificial light", "spotlight", "neon", "neon light", "fluorescent",
             "fluorescent light", "street lighting", "streetlight"),
}  # fmt: skip

DARK_PLACES_LIGHT = "night"
"""Light that "dark" asks for before a place ("a dark street")."""

WEATHERS: dict[str, tuple[str, ...]] = {
    "fog": ("fog", "foggy", "mist", "misty", "haze", "hazy", "smog"),
    "rain": ("rain", "rainy", "raining", "rainstorm", "storm", "stormy", "downpour", "in the rain",
             "rains", "rain falls", "rain falling", "falling rain", "heavy rain"),
    "snow": ("snowing", "snowfall", "snowflake", "falling snow", "blizzard", "snowstorm",
             "snows", "snow falls", "snow falling"),
}  # fmt: skip

CLOUDS: dict[str, float] = {
    "cloudy": 0.8,
    "clouds": 0.5,
    "cloudy sky": 0.8,
    "partly cloudy": 0.4,
    "cloudless": 0.0,
    "clear sky": 0.0,
    "clear skies": 0.0,
}

SNOWY = ("snow", "snowy", "snow covered", "winter", "wintry")
"""Words that mean snow on the ground."""

STEEP = ("steep", "uphill", "downhill", "slope", "sloping", "hilly")
DUST = ("dust", "dusty", "dust kicks up", "dust cloud", "dust clouds", "kicking up dust",
        "kicks up dust", "dust trail")  # fmt: skip

SKY_WORDS = ("sky", "skies")

FLICKERS = (
    "flicker", "flickers", "flickering", "strobe", "strobing", "strobe light", "blinking",
    "blinks", "blink", "pulsing", "pulsating", "flashing", "flashes",
)  # fmt: skip
DEFAULT_FLICKER_HZ = 10.0
"""Flicker whose frequency is not said, Hz."""

HERTZ: dict[str, float] = {"hz": 1.0, "hertz": 1.0, "khz": 1000.0}

SHADOW_WORDS = ("shadow", "shadows", "casting shadows", "long shadows", "casts a shadow")

GLOW_WORDS = ("light", "lights", "lit", "shine", "shines", "shining", "glow", "glows", "glowing",
              "illuminated", "lighting", "illuminates")  # fmt: skip
"""Understood when a light is described; alone they change nothing and are reported."""

CAMERA_WORDS = ("camera", "cameras", "viewpoint")

CAMERA_MOVES: dict[str, tuple[str, str | None]] = {
    "pan": ("pan", None),
    "pans": ("pan", None),
    "panning": ("pan", None),
    "tilt": ("tilt", None),
    "tilts": ("tilt", None),
    "tilting": ("tilt", None),
    "zoom": ("zoom", None),
    "zooms": ("zoom", None),
    "zooming": ("zoom", None),
    "zoom in": ("zoom", "in"),
    "zooms in": ("zoom", "in"),
    "zooming in": ("zoom", "in"),
    "zoom out": ("zoom", "out"),
    "zooms out": ("zoom", "out"),
    "zooming out": ("zoom", "out"),
    "dolly": ("dolly", None),
    "dollies": ("dolly", None),
    "dollying": ("dolly", None),
    "dolly in": ("dolly", "in"),
    "dollies in": ("dolly", "in"),
    "dolly out": ("dolly", "out"),
    "dollies out": ("dolly", "out"),
    "push in": ("dolly", "in"),
    "pushes in": ("dolly", "in"),
    "pull back": ("dolly", "out"),
    "pulls back": ("dolly", "out"),
    "pull out": ("dolly", "out"),
    "pulls out": ("dolly", "out"),
    "tracking shot": ("follow", None),
    "tracking": ("follow", None),
    "tracks": ("follow", None),
    "follow shot": ("follow", None),
    "handheld": ("handheld", None),
    "hand held": ("handheld", None),
    "shaky": ("handheld", None),
    "camera shake": ("handheld", None),
    "orbiting shot": ("orbit", None),
    "static camera": ("static", None),
    "fixed camera": ("static", None),
    "still camera": ("static", None),
    "stationary camera": ("static", None),
    "static": ("static", None),
    "static shot": ("static", None),
}

CAMERA_VERBS: dict[str, str] = {
    "move": "truck",
    "drive": "truck",
    "fly": "truck",
    "walk": "truck",
    "run": "truck",
    "slide": "truck",
    "sail": "truck",
    "hover": "static",
    "stand": "static",
    "orbit": "orbit",
    "spin": "orbit",
    "rise": "pedestal",
    "sink": "pedestal",
    "fall": "pedestal",
    "sway": "handheld",
    "swing": "pan",
}
"""What a motion means when the camera does it."""

VIEWS: dict[str, str] = {
    "aerial view": "aerial",
    "aerial shot": "aerial",
    "aerial": "aerial",
    "drone view": "aerial",
    "drone shot": "aerial",
    "drone footage": "aerial",
    "bird eye view": "aerial",
    "birds eye view": "aerial",
    "bird eye": "aerial",
    "from above": "aerial",
    "seen from above": "aerial",
    "high angle": "aerial",
    "overhead": "top",
    "overhead view": "top",
    "top view": "top",
    "top down": "top",
    "top down view": "top",
    "low angle": "low",
    "from below": "low",
    "from a drone": "aerial",
    "by a drone": "aerial",
    "side view": "side",
    "from the side": "side",
    "front view": "front",
    "from the front": "front",
    "rear view": "back",
    "back view": "back",
    "from behind": "back",
}

FRAMINGS: dict[str, str] = {
    "close up": "close",
    "close up of": "close",
    "closeup": "close",
    "close shot": "close",
    "extreme close up": "close",
    "macro": "close",
    "wide shot": "wide",
    "wide angle": "wide",
    "wide view": "wide",
    "long shot": "wide",
    "panorama": "wide",
    "establishing shot": "wide",
}

GENERIC_NOUNS: dict[str, str] = {
    "vehicle": "car",
    "animal": "dog",
    "pet": "dog",
    "insect": "butterfly",
    "creature": "dog",
    "human": "person",
    "building": "skyscraper",
    "furniture": "chair",
    "aircraft": "airplane",
    "toy": "ball",
    "object": "cube",
}
"""Words for whole classes → the noun that stands for them, where the noun table has no better."""

PARTS: dict[tuple[str, str], str] = {
    ("suv", "roof rack"): "black",
}
"""(noun, part) that a model shows in any case → the colour it has."""
VEHICLE_PARTS = ("tire", "tires", "tyre", "tyres", "wheels", "window", "windows", "roof")
"""Parts that every vehicle shows, in their usual colours."""
PART_WORDS = ("roof rack", "rack", "tire", "tires", "tyre", "tyres", "wheels", "headlight",
              "headlights", "roof", "window", "windows", "door", "doors", "hair", "hat", "shirt",
              "sail", "sails", "wings", "tail", "legs", "trunk", "leaves")  # fmt: skip
