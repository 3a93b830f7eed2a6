"""Words for how many, how big and what colour; and stop words."""

from __future__ import annotations

from texvent.scenes.colours import COLOURS as COLOURS
from texvent.scenes.colours import SHADES as SHADES

MAX_COUNT = 24
"""Most copies of one object; a larger count is shown as this many, and said."""

COUNTS: dict[int, tuple[str, ...]] = {
    2: ("a couple of", "a pair of", "pair of", "two", "both"),
    3: ("a few", "few", "some", "three"),
    5: ("a group of", "group of", "several", "a pack of", "five", "a number of", "number of",
        "a handful of", "a collection of", "a selection of", "an array of"),
    4: ("various", "four", "multiple", "assorted", "an assortment of", "a variety of",
        "assortment of", "variety of", "a family of", "a team of", "a set of"),
    9: ("a flock of", "flock of", "nine"),
    7: ("a herd of", "herd of", "seven"),
    10: ("a school of", "school of", "a shoal of", "rows of", "ten"),
    14: ("a swarm of", "swarm of"),
    12: ("a crowd of", "crowd of", "countless", "dozens of", "a dozen", "dozen", "twelve"),
    6: ("a row of", "row of", "a line of", "a fleet of", "a bunch of", "six",
        "a pile of", "a stack of", "half a dozen"),
    8: ("a colony of", "many", "a lot of", "lots of", "numerous", "eight"),
    24: ("hundreds of",),
    1: ("one", "a single", "single", "lone", "lonely"),
    11: ("eleven",),
    15: ("fifteen",),
    20: ("twenty",),
}  # fmt: skip

PLURAL_COUNT = 3
"""What a bare plural means: "birds fly"."""

SURROUND_COUNT = 14
"""What a bare plural means all around something: "surrounded by trees"."""
MAX_BODIES = 60
"""Most bodies in a scene; copies beyond it are left out, and said."""

SIZES: dict[float, tuple[str, ...]] = {
    0.4: ("tiny", "miniature"),
    0.5: ("toy", "baby"),
    0.65: ("small", "little", "low"),
    0.7: ("young",),
    0.8: ("short",),
    1.4: ("big", "large"),
    1.3: ("tall", "long"),
    2.0: ("huge", "massive"),
    2.2: ("giant", "enormous"),
    2.4: ("gigantic",),
}  # fmt: skip

MATERIALS: dict[str, tuple[str, ...]] = {
    "wood": ("wooden", "wood", "oak", "pine wood"),
    "brick": ("brick",),
    "stone": ("stone", "cobblestone", "limestone"),
    "marble": ("marble",),
    "concrete": ("concrete", "cement"),
    "metal": ("metal", "metallic", "steel", "iron", "tin", "aluminium", "aluminum", "chrome"),
    "brass": ("brass",),
    "glass": ("glass", "crystal"),
    "plastic": ("plastic",),
    "ceramic": ("ceramic", "porcelain", "clay"),
    "cloth": ("cloth", "fabric", "woollen", "woolen", "cotton"),
    "leather": ("leather",),
    "rubber": ("rubber",),
    "paper": ("paper", "cardboard"),
    "rust": ("rusty", "rusted"),
    "ice": ("ice",),
}  # fmt: skip
"""Material → words for it, before a noun."""

COMPOUNDS: dict[str, tuple[str, ...]] = {
    "candle": ("candle light",),
    "led": ("led matrix", "led array", "led light", "led lamp", "led strip light"),
    "checkerboard": ("checkerboard calibration pattern", "checkerboard pattern",
                     "calibration pattern", "calibration target", "chessboard pattern"),
}  # fmt: skip
"""Noun → compounds that mean it, though their last word alone does not."""

LIQUIDS = frozenset(
    {
        "coffee",
        "tea",
        "water",
        "milk",
        "juice",
        "soup",
        "beer",
        "wine",
        "lemonade",
        "cocoa",
        "champagne",
        "whiskey",
        "cider",
        "vodka",
    }
)
"""What fills a vessel: "a cup of coffee" is one thing."""
LIKENESSES = frozenset(
    {"poster", "picture", "painting", "photo", "photograph", "drawing", "statue", "sculpture",
     "figurine", "model", "portrait", "logo", "silhouette", "reflection", "map", "toy", "image",
     "replica", "costume", "shadow"}
)  # fmt: skip
"""What shows a thing without its being there: "a statue of a horse"."""
CHANGES = frozenset(
    {"turn", "curl", "transform", "change", "form", "shape", "morph", "grow", "fold", "twist",
     "melt", "crumple", "cut", "break", "split", "roll", "make", "bend", "carve", "slice", "chop",
     "tear", "evolve", "blossom", "develop", "burst", "explode", "dissolve", "merge", "arrange",
     "weave", "knit", "mold", "mould", "wobble", "fall", "bake", "grind", "mix", "blend", "divide",
     "collapse", "crush", "shatter", "crack", "stack", "pile", "rake", "braid", "knead", "sculpt",
     "paint", "draw", "become", "dress", "fashion", "whip", "beat", "cook", "tie", "wrap"}
)  # fmt: skip
"""Verbs after which "into" names what becomes of something: not "drops its load into a truck"."""
