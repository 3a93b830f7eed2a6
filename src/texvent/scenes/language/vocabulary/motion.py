"""Words for what objects do, which way, how fast, and where they are to one another."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Verb:
    """A verb and what it means for its subject and its object."""

    base: str
    kind: str
    """A `ObjectMotion.kind` of the subject; "move" = its usual motion; "" = none of its own."""
    pace: float = 1.0
    direction: str | None = None
    relation: str | None = None
    """Relation of the subject to its object, as in "passes two trees"."""
    act: str | None = None
    """What the subject does to its object: a `Relation.kind` such as "hold"."""
    object_kind: str | None = None
    """Motion of the object, as in "spins a wheel"."""
    end_pace: float | None = None
    """As `ObjectMotion.end_pace`."""
    way: str = ""
    """`Relation.way` of that relation."""


_PLAIN_VERBS: dict[str, dict[float, tuple[str, ...]]] = {
    "move": {
        1.0: ("move", "head", "proceed", "advance", "journey", "go", "travel"),
        2.4: ("race", "speed"), 2.2: ("rush",), 2.6: ("zip",), 1.8: ("hurry",),
        0.4: ("creep",), 0.7: ("drift",),
    },
    "drive": {0.8: ("cruise",)},
    "run": {
        1.4: ("dash", "sprint"), 0.8: ("jog",), 1.3: ("gallop",), 0.7: ("trot",),
    },
    "walk": {
        1.0: ("walk", "waddle"), 0.7: ("stroll", "wander"),
        1.2: ("march", "stride"), 0.8: ("step",), 0.9: ("hike",),
    },
    "fly": {0.8: ("glide",), 0.7: ("flutter",), 1.0: ("soar",)},
    "hover": {1.0: ("hover", "float")},
    "swim": {1.0: ("swim",)},
    "slide": {1.0: ("slide", "slip", "glide over")},
    "bounce": {1.0: ("bounce",)},
    "fall": {1.0: ("plummet",)},
    "topple": {1.0: ("fall down", "fall over", "topple", "topple over", "tumble down", "collapse",
                     "tip over", "keel over")},
    "rise": {1.0: ("ascend", "lift off", "take off", "rise", "blast off"), 1.5: ("launch",)},
    "sink": {1.0: ("descend",), 0.8: ("land",), 0.7: ("sink",)},
    "swing": {1.0: ("oscillate",), 0.6: ("dangle",)},
    "sway": {1.0: ("sway", "rock"), 1.5: ("wobble",), 4.6: ("tremble", "vibrate"),
             3.0: ("shiver",)},
    "dance": {1.0: ("dance",)},
    "jump": {1.0: ("jump",), 0.7: ("hop",), 0.8: ("skip",), 1.2: ("leap",)},
    "work": {1.0: ("flap", "work", "tick", "operate", "beat", "pulse", "throb", "pulsate",
                   "print")},
    "stand": {
        1.0: ("park", "wait", "rest", "stay", "pause", "pose", "stand", "hang", "remain",
               "perch", "idle"),
    },
    "sit": {1.0: ("sit",)},
    "lie": {1.0: ("lie", "doze", "sleep")},
    "sit down": {1.0: ("sit down",)},
    "lie down": {1.0: ("lie down",)},
    "stand up": {1.0: ("stand up", "get up")},
}  # fmt: skip
"""Motion → pace → verbs of which there is nothing else to say."""

VERBS: tuple[Verb, ...] = (
    Verb("come", "move", direction="towards"),
    Verb("approach", "move", direction="towards", relation="towards"),
    Verb("oncome", "move", direction="towards"),  # "oncoming traffic"
    *(
        Verb(f"{base} {way} the {goal}", "move", direction="away")
        for base in ("disappear", "vanish")
        for way in ("in", "into", "over")
        for goal in ("distance", "horizon")
    ),
    Verb("leave", "leave"),
    Verb("exit", "leave"),
    Verb("depart", "move", 0.0, direction="away", end_pace=1.0),
    Verb("retreat", "move", direction="away"),
    Verb("recede", "move", direction="away"),
    Verb("back up", "reverse"),
    Verb("reverse", "reverse"),
    Verb("enter", "enter"),
    Verb("arrive", "enter", end_pace=0.0),
    Verb("appear from behind", "appear", relation="behind"),
    Verb("pass", "move", relation="past"),
    Verb("pass by", "move", relation="past"),
    Verb("overtake", "move", 1.5, relation="overtake"),
    Verb("zoom past", "move", 1.8, relation="past"),
    Verb("cross", "move", direction="across", relation="on"),
    Verb("traverse", "move", direction="across", relation="on"),
    Verb("accelerate", "move", 0.5, end_pace=1.8),
    Verb("speed up", "move", 0.5, end_pace=1.8),
    *(
        Verb(base, "move", 1.8, end_pace=0.0)
        for base in (
            "brake",
            "slow to a stop",
            "slow to a halt",
            "screech to a halt",
            "screech to a stop",
            "grind to a halt",
            "roll to a stop",
            "brake to a stop",
            "brake suddenly",
            "brake hard",
            "brake abruptly",
            "stop suddenly",
            "stop abruptly",
        )
    ),
    *(Verb(base, "move", 1.6, end_pace=0.2) for base in ("slow down", "slow", "decelerate")),
    Verb("stop", "stand"),
    Verb("halt", "stand"),
    Verb("come to a stop", "stand"),
    Verb("come to rest", "stand"),
    Verb("turn", "turn", object_kind="spin"),
    Verb("swerve", "turn", 1.3),
    Verb("curve", "turn"),
    Verb("veer", "turn", 1.2),
    Verb("turn around", "turn", direction="around"),
    Verb("make a u turn", "turn", direction="around"),
    *(Verb(base, "zigzag") for base in ("zigzag", "weave", "slalom", "snake")),
    *(Verb(f"{base} a wheelie", "wheelie") for base in ("do", "pop", "pull", "perform")),
    Verb("wheelie", "wheelie"),
    Verb("pick and place", "pick and place"),
    *(
        Verb(base, "change lane")
        for base in (
            "change lane",
            "change lanes",
            "switch lane",
            "switch lanes",
            "merge",
        )
    ),
    Verb("flip", "flip", object_kind="flip"),
    Verb("skid", "slide"),
    Verb("roll over", "roll over"),
    Verb("taxi", "roll"),
    Verb("drive", "drive", act="ride"),
    Verb("ride", "drive", act="ride"),
    Verb("steer", "drive", act="ride"),
    *(Verb(base, "drive", act="ride") for base in ("pedal", "cycle", "bicycle", "bike")),
    Verb("operate", "work", act="ride"),
    Verb("fly", "fly", act="hold"),
    Verb("run", "run"),
    Verb("crawl", "crawl"),
    Verb("chase", "run", 1.2, relation="follow"),
    Verb("pursue", "run", 1.2, relation="follow"),
    Verb("follow", "move", relation="follow"),
    Verb("swoop", "fly", 1.4, direction="down"),
    Verb("dive", "swim", 1.2, direction="down"),
    Verb("sail", "sail"),
    Verb("row", "sail", 0.7, act="ride"),
    Verb("paddle", "sail", 0.7, act="ride"),
    Verb("spin", "spin", object_kind="spin"),
    Verb("rotate", "spin", 0.7, object_kind="spin"),
    Verb("twirl", "spin", 1.2, object_kind="spin"),
    Verb("whirl", "spin", 1.5, object_kind="spin"),
    Verb("revolve", "spin", 0.7, relation="around"),
    Verb("orbit", "orbit", relation="around"),
    Verb("circle", "orbit", relation="around"),
    Verb("roll", "roll", object_kind="roll"),
    Verb("tumble", "roll"),
    Verb("skate", "skate"),
    Verb("ski", "ski", 1.5),
    Verb("surf", "surf"),
    Verb("fall", "fall"),
    Verb("drop", "fall", object_kind="fall"),
    Verb("climb", "rise", 0.6),
    Verb("lift", "rise", 0.6, act="hold", object_kind="rise"),
    Verb("swing", "swing", object_kind="swing"),
    Verb("shake", "sway", 3.0, object_kind="sway"),
    Verb("tilt", "sway", object_kind="sway"),
    Verb("throw", "throw", act="throw"),
    Verb("toss", "throw", 0.8, act="throw"),
    Verb("hurl", "throw", 1.3, act="throw"),
    Verb("kick", "kick", act="kick"),
    Verb("hit", "", act="hit"),
    Verb("strike", "", act="hit"),
    *(Verb(base, "", act="collide") for base in ("collide", "crash", "bump", "meet")),
    Verb("catch", "catch", act="catch"),
    Verb("grab", "", act="hold"),
    Verb("hold", "", act="hold"),
    Verb("carry", "", act="carry"),
    Verb("bring", "", act="carry"),
    Verb("wear", "", act="wear"),
    Verb("push", "", act="push"),
    Verb("pull", "", act="pull"),
    Verb("drag", "", act="pull"),
    Verb("tow", "", act="pull"),
    Verb("dribble", "dribble", object_kind="bounce"),
    Verb("wave", "wave"),
    Verb("dig", "work"),
    *(Verb(base, "work", object_kind="work") for base in ("ring", "toll", "chime")),
    Verb("blow", "work"),
    *(
        Verb(base, kind, pace)
        for kind, by_pace in _PLAIN_VERBS.items()
        for pace, verbs in by_pace.items()
        for base in verbs
    ),
)

GETTING = frozenset({"sit down", "lie down", "stand up"})
"""Motions from one posture to another, of people and of animals."""
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
        "toward the viewer", "to the camera", "at the camera", "closer",
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
        "by the camera", "past the viewer", "sideways",
    ),
    "circle": ("in circles", "in a circle", "around in circles"),
    "eight": ("in a figure eight", "in figure eights", "in a figure of eight", "a figure eight",
              "figure eights", "in a figure 8", "a figure 8", "in figure 8s"),
    "opposite": ("in opposite directions", "opposite ways", "in different directions",
                 "in both directions", "in opposite direction"),
    "to and fro": ("back and forth", "to and fro", "side to side", "from side to side"),
    "up and down": ("up and down",),
}  # fmt: skip

SIDES: dict[str, tuple[str, ...]] = {
    "left": ("on the left", "on the left side", "at the left"),
    "right": ("on the right", "on the right side", "at the right"),
    "centre": ("in the middle", "in the center", "in the centre"),
    "far": ("in the distance", "in the background", "far away", "distant"),
    "near": ("in the foreground",),
    "row": ("in a row", "in a line", "in line", "in a queue", "in single file", "single file",
            "side by side", "lined up", "in a straight line"),
    "ring": ("in a ring",),
}  # fmt: skip

PACES: dict[float, tuple[str, ...]] = {
    0.3: ("very slowly",),
    0.5: ("slowly", "slow", "lazily", "at low speed", "slightly"),
    0.6: ("gently", "gentle", "leisurely"),
    0.7: ("calmly",),
    1.0: ("steadily",),
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
        "opposite",
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
