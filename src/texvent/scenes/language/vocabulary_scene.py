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

CLOUDS: dict[float, tuple[str, ...]] = {
    0.8: ("cloudy", "cloudy sky"),
    0.5: ("clouds",),
    0.4: ("partly cloudy",),
    0.0: ("cloudless", "clear sky", "clear skies"),
}  # fmt: skip

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

HERTZ: dict[float, tuple[str, ...]] = {1.0: ("hz", "hertz"), 1000.0: ("khz",)}

SHADOW_WORDS = ("shadow", "shadows", "casting shadows", "long shadows", "casts a shadow")

GLOW_WORDS = ("light", "lights", "lit", "shine", "shines", "shining", "glow", "glows", "glowing",
              "illuminated", "lighting", "illuminates")  # fmt: skip
"""Understood when a light is described; alone they change nothing and are reported."""

CAMERA_WORDS = ("camera", "cameras", "viewpoint")

CAMERA_MOVES: dict[tuple[str, str | None], tuple[str, ...]] = {
    ("pan", None): ("pan", "pans", "panning"),
    ("tilt", None): ("tilt", "tilts", "tilting"),
    ("zoom", None): ("zoom", "zooms", "zooming"),
    ("zoom", "in"): ("zoom in", "zooms in", "zooming in"),
    ("zoom", "out"): ("zoom out", "zooms out", "zooming out"),
    ("dolly", None): ("dolly", "dollies", "dollying"),
    ("dolly", "in"): ("dolly in", "dollies in", "push in", "pushes in"),
    ("dolly", "out"): (
        "dolly out", "dollies out", "pull back", "pulls back", "pull out", "pulls out",
    ),
    ("follow", None): ("tracking shot", "tracking", "tracks", "follow shot"),
    ("handheld", None): ("handheld", "hand held", "shaky", "camera shake"),
    ("orbit", None): ("orbiting shot",),
    ("static", None): (
        "static camera", "fixed camera", "still camera", "stationary camera", "static",
        "static shot",
    ),
}  # fmt: skip

CAMERA_VERBS: dict[str, str] = {
    **dict.fromkeys(("move", "drive", "fly", "walk", "run", "slide", "sail"), "truck"),
    **dict.fromkeys(("hover", "stand"), "static"),
    **dict.fromkeys(("orbit", "spin"), "orbit"),
    **dict.fromkeys(("rise", "sink", "fall"), "pedestal"),
    "sway": "handheld",
    "swing": "pan",
}
"""What a motion means when the camera does it."""

VIEWS: dict[str, tuple[str, ...]] = {
    "aerial": (
        "aerial view", "aerial shot", "aerial", "drone view", "drone shot", "drone footage",
        "bird eye view", "birds eye view", "bird eye", "from above", "seen from above",
        "high angle", "from a drone", "by a drone",
    ),
    "top": ("overhead", "overhead view", "top view", "top down", "top down view"),
    "low": ("low angle", "from below"),
    "side": ("side view", "from the side"),
    "front": ("front view", "from the front"),
    "back": ("rear view", "back view", "from behind"),
}  # fmt: skip

FRAMINGS: dict[str, tuple[str, ...]] = {
    "close": ("close up", "close up of", "closeup", "close shot", "extreme close up", "macro"),
    "wide": ("wide shot", "wide angle", "wide view", "long shot", "panorama", "establishing shot"),
}  # fmt: skip

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
