"""Words for what objects do, which way, how fast, and where they are to one another."""

from __future__ import annotations

STILL_WORDS = ("still", "motionless", "stationary", "unmoving")

DIRECTIONS: dict[str, tuple[str, ...]] = {
    "left": (
        "left", "leftward", "leftwards", "to the left", "to left", "towards the left",
        "from right to left", "from the right to the left", "right to left", "to its left",
        "to their left",
    ),
    "right": (
        "right", "rightward", "rightwards", "to the right", "to right", "towards the right",
        "from left to right", "from the left to the right", "left to right",
    ),
    "right ": ("from the left", "from left", "in from the left"),
    "left ": ("from the right", "from right", "in from the right"),
    "towards": (
        "towards the camera", "toward the camera", "towards us", "toward us", "towards the viewer",
        "toward the viewer", "to the camera", "at the camera", "closer", "towards the lens",
        "toward the lens", "at the lens",
    ),
    "away": (
        "away", "away from the camera", "away from us", "away from the viewer", "into the distance",
        "off into the distance",
    ),
    "clockwise": ("clockwise",),
    "counter-clockwise": ("counter clockwise", "counterclockwise", "anticlockwise",
                          "anti clockwise"),
    "forward": ("forward", "forwards", "ahead", "straight ahead"),
    "backward": ("backward", "backwards"),
    "up": ("up", "upward", "upwards", "skyward"),
    "down": ("down", "downward", "downwards", "to the ground"),
    "across": (
        "across", "across the frame", "across the screen", "across the picture", "past the camera",
        "by the camera", "past the viewer", "sideways", "laterally", "horizontally",
    ),
    "diagonal": ("diagonally", "in a diagonal direction", "along a diagonal"),
    "circle": ("in circles", "in a circle", "around in circles"),
    "eight": ("in a figure eight", "in figure eights", "in a figure of eight", "a figure eight",
              "figure eights", "in a figure 8", "a figure 8", "in figure 8s"),
    "opposite": ("in opposite directions", "opposite ways", "in different directions",
                 "in both directions", "in opposite direction"),
    "to and fro": ("back and forth", "to and fro", "side to side", "from side to side",
                  "left and right", "from left to right and back", "right and left"),
    "up and down": ("up and down", "vertically"),
}  # fmt: skip

SIDES: dict[str, tuple[str, ...]] = {
    "left": ("on the left", "on the left side", "at the left"),
    "right": ("on the right", "on the right side", "at the right"),
    "centre": ("in the middle", "in the center", "in the centre"),
    "far": ("in the distance", "in the background", "far away", "distant"),
    "near": ("in the foreground",),
    "row": ("in a row", "in a line", "in line", "in a queue", "in single file", "single file",
            "lined up", "in a straight line"),
    "ring": ("in a ring",),
    "together": ("side by side", "together"),
}  # fmt: skip

PACES: dict[float, tuple[str, ...]] = {
    0.3: ("very slowly",),
    0.5: ("slowly", "slow", "lazily", "at low speed", "slightly"),
    0.6: ("gently", "gentle", "leisurely"),
    0.7: ("calmly",),
    1.0: ("steadily", "smoothly", "gradually",
          *(f"at {a}{one} {speed}" for a in ("", "a ") for one in ("constant", "steady", "uniform")
            for speed in ("speed", "velocity"))),
    2.0: ("quickly", "quick", "swiftly"),
    2.4: ("fast",),
    2.6: ("faster",),
    2.5: ("rapidly", "rapid"),
    3.2: ("very fast", "at top speed"),
    3.0: ("at high speed", "at full speed", "wildly"),
}  # fmt: skip

PACE_ADJECTIVES: dict[float, tuple[str, ...]] = {
    0.5: ("slow",),
    0.6: ("gentle",),
    2.0: ("quick",),
    2.4: ("fast", "speeding"),
    2.5: ("rapid",),
}
UNITS: dict[tuple[str, float], tuple[str, ...]] = {
    ("speed", 1 / 3.6): (
        "km / h", "kmh", "kph", "kilometers per hour", "kilometres per hour", "km per hour",
    ),
    ("speed", 0.44704): ("mph", "miles per hour"),
    ("speed", 1.0): ("m / s", "mps", "meters per second", "metres per second"),
    ("speed", 0.514444): ("knots",),
    ("rate", 1.0): ("hz", "hertz", "revolutions per second", "turns per second"),
    ("rate", 1000.0): ("khz", "kilohertz"),
    ("rate", 1 / 60): ("rpm", "revolutions per minute"),
    ("time", 1.0): ("second", "sec"),
    ("time", 0.001): ("ms", "millisecond"),
}  # fmt: skip
"""(Quantity, factor to m/s, Hz or s) → units."""

WORK_RATES_HZ: dict[str, float] = {
    "spinning disc": 0.7, "grating": 0.6, "spinning top": 3.57, "gyroscope": 4.0,
    "fidget spinner": 3.0, "fan": 3.37, "ceiling fan": 1.3, "dotted disc": 2.3, "spiral disc": 1.1,
    "propeller": 2.24, "pinwheel": 0.9, "hard disk": 2.0, "disco ball": 0.25, "globe": 0.25,
    "roulette wheel": 0.6, "record player": 0.55, "merry-go-round": 0.12, "ferris wheel": 0.05,
    "washing machine": 0.67,
}  # fmt: skip
"""Noun whose parts spin → turns per second of its model at its usual pace.

Blades stand elsewhere after .2 and .4 s, the steps between six stills of 1 and 2 s.
"""

RELATIONS: dict[str, tuple[str, ...]] = {
    "beside": (
        "next to", "beside", "alongside", "near", "close to", "across from", "against",
        "opposite", "outside",
    ),
    "behind": ("behind", "in back of"),
    "front": ("in front of",),
    "on": ("on", "on top of", "atop", "onto", "upon"),
    "in": ("in", "inside", "within", "into", "in the back of"),
    "above": ("above", "over"),
    "under": ("under", "underneath", "below", "beneath"),
    "between": ("between",),
    "among": ("among", "amongst", "amid"),
    "through": ("through", "throughout"),
    "left of": ("left of", "to the left of", "on the left of"),
    "right of": ("right of", "to the right of", "on the right of"),
    "past": ("past", "along"),
    "around": ("around",),
    "surround": ("surrounded by", "lined with", "lined by"),
    "towards": ("towards", "toward", "to"),
    "away from": ("away from",),
    "with": ("with",),
    "from": ("from", "out of", "off of"),
}  # fmt: skip

PREPOSITION_WAYS: dict[str, str] = {
    "into": "into", "onto": "onto", "out of": "out of", "off of": "off", "off": "off",
    "against": "against", "across": "across", "along": "along", "opposite": "opposite",
    "across from": "opposite", "at": "at",
    "up": "up", "down": "down",
}  # fmt: skip
"""Preposition → `Relation.way`: what it says besides the kind of the relation."""

LED = "lead"
"""What `Relation.way` is of an animal that someone walks: it is on a leash."""
APART = "not on"
"""The way of what is "not on" or "not in" something."""

SHORE_WAYS: dict[str, tuple[str, str]] = {
    "into": ("into", "away"), "to": ("towards", "away"), "towards": ("towards", "away"),
    "toward": ("towards", "away"), "out of": ("out of", "towards"),
    "from": ("away from", "towards"), "away from": ("away from", "towards"),
}  # fmt: skip
"""Preposition before a water → `ObjectMotion.shore`, and the direction in the picture: the water
lies behind the land."""
SHORES = frozenset({"sea", "lake", "river", "swimming pool", "harbour"})
"""Places with water beside land, or that become one."""
WINDS = frozenset({"wind", "breeze", "gust", "gusts", "winds"})
"""Nouns of moving air."""
ROAD_WORDS = frozenset({"road", "street", "highway", "lane", "motorway", "roadway"})
"""Words for what vehicles drive on."""
FLOWING = frozenset({"river"})
"""Places whose water goes one way."""
NO_WAYS = frozenset(
    {"into", "to", "towards", "toward", "out of", "from", "away from", "off", "onto", "against"}
)
"""Prepositions that say a way to or from a place, which is all around."""
SLOPES = frozenset({"hills", "mountain", "slope", "sand", "snow"})
"""Places of which "up" and "down" mean a slope; the ground is level."""

OTHER_PREPOSITIONS: dict[str, tuple[str, ...]] = {
    "of": ("of",),
    "with": (
        "full of",
        "filled with",
        "crowded with",
        "loaded with",
        "packed with",
        "covered with",
        "covered in",
        "decorated with",
    ),
    "by": ("by",),
    "at": ("at",),
    "for": ("for",),
    "like": ("like",),
    "during": ("during",),
    "via": ("via",),
    "about": ("about",),
    "up": ("up",),
    "down": ("down",),
    "off": ("off",),
    "out": ("out",),
    "across": ("across",),
    "facing": ("facing",),
}
"""Prepositions that say no relation between two objects, or only with some of them."""
WEAK_PREPOSITIONS: dict[object, str] = {
    "at": "beside", "by": "beside", "across": "on", "along": "past", "off": "from",
}  # fmt: skip
"""Prepositions of many senses → the relation they mean between two objects."""
