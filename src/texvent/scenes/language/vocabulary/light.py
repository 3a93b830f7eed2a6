"""Words that say how the light is: its colour, hardness, brightness and direction."""

from __future__ import annotations

TINTS: dict[str, tuple[str, ...]] = {
    "warm": ("warm", "mellow", "cosy", "cozy"),
    "golden": ("golden", "gold", "amber", "honey", "honeyed"),
    "cold": ("cold", "cool", "chilly", "icy", "wintry", "bluish"),
}
"""Tint of light → adjectives."""
HARDNESSES: dict[str, tuple[str, ...]] = {
    "soft": ("soft", "softer", "diffuse", "diffused", "even", "flat", "gentle", "shadowless"),
    "hard": ("hard", "harsh", "strong", "stark", "intense", "glaring"),
}
BRIGHTNESSES: dict[str, tuple[str, ...]] = {
    "bright": ("bright", "brilliant", "brightly lit"),
    "gloomy": ("gloomy",),
    "dim": ("dim", "dimly lit", "faint", "weak", "subdued", "low light"),
}
DIRECTIONS: dict[str, tuple[str, ...]] = {
    "left": ("side", "lateral"),
    "above": ("overhead", "top"),
    "front": ("frontal", "front"),
    "back": ("back", "rim"),
}
"""Direction of light → adjectives; which side is not said."""
LOW = ("low", "slanting", "slanted", "low angle")
"""Adjectives of light from near the horizon."""
COLOURED = ("red", "orange", "yellow", "green", "turquoise", "blue", "violet", "purple", "pink",
            "magenta", "cyan", "teal", "indigo", "crimson", "scarlet")  # fmt: skip
"""Colours that light may have."""
CLOUDED = frozenset({"cloudy", "grey", "gray", "overcast"})
"""Adjectives of the light under clouds."""
LIT = frozenset({"lit", "illuminated", "lighted"})
BACKLIGHTS = ("backlit", "backlight", "backlighting", "back lit", "contre jour")
"""Words that say by themselves that light comes from behind."""

SOURCES = frozenset(
    {"light", "lighting", "illumination", "sunlight", "sunshine", "sun", "daylight", "moonlight",
     "lamplight", "lamp light", "candlelight", "indoor light", "artificial light", "neon light",
     "fluorescent light", "street lighting", "early sunlight", "midday sun"}
)  # fmt: skip
"""Nouns of light that all of these words may describe."""
GLOWS = frozenset({"glow", "lights"})
"""Nouns that may be those of a lamp or a thing."""
TIMES = frozenset({"day", "morning", "afternoon", "noon", "midday", "summer"})
"""Nouns of time that are bright; when they are warm or cold, the air is."""
SEASONS = frozenset({"spring", "autumn", "winter"})
FIXTURES = frozenset({"window", "lamp", "tube", "bulb", "candle", "candles", "fire", "torch"})
"""Things whose light lights the scene."""
ARRIVALS = frozenset(
    {"come", "fall", "enter", "pour", "stream", "shine", "hit", "slant", "flow", "filter"}
)
"""Verbs of light that comes from somewhere."""
FROM = {
    "left": "left", "right": "right", "side": "left", "behind": "back", "back": "back",
    "rear": "back", "front": "front", "above": "above", "overhead": "above", "top": "above",
}  # fmt: skip
"""Where light is said to come from → its direction."""
