"""Words for what objects do, which way, how fast, and where they are to one another."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Verb:
    """A verb and the motion it stands for."""

    base: str
    kind: str
    """A `ObjectMotion.kind`, or "move" = the usual motion of whatever does it."""
    pace: float = 1.0
    direction: str | None = None
    relation: str | None = None
    """Relation to the noun that follows, as in "passes two trees"."""
    irregular: tuple[str, ...] = ()
    """Irregular past forms; usable before a noun ("a parked car")."""


_REGULAR_VERBS: dict[str, dict[float, tuple[str, ...]]] = {
    "move": {
        1.0: ("move", "head", "proceed", "advance", "journey", "enter"), 1.7: ("race",),
        1.6: ("rush",), 1.8: ("zip",), 1.5: ("hurry",), 1.3: ("accelerate",),
    },
    "drive": {0.8: ("cruise",)},
    "run": {1.4: ("dash", "sprint"), 0.8: ("jog",), 1.3: ("gallop", "charge"), 0.7: ("trot",)},
    "walk": {
        1.0: ("walk", "slither"), 0.7: ("stroll", "wander", "prowl"), 1.2: ("march",),
        0.8: ("step",), 0.9: ("hike",), 0.4: ("crawl",),
    },
    "fly": {1.0: ("soar",), 0.8: ("glide",), 0.7: ("flutter",), 0.4: ("drift",)},
    "hover": {1.0: ("hover", "float")},
    "sail": {1.0: ("sail",), 0.7: ("row",)},
    "spin": {0.7: ("rotate",), 0.5: ("turn",), 1.2: ("twirl",), 1.5: ("whirl",)},
    "roll": {1.0: ("roll", "tumble")},
    "slide": {1.0: ("skate",), 1.5: ("ski",)},
    "bounce": {1.0: ("bounce", "dribble")},
    "fall": {1.0: ("drop", "plummet")},
    "rise": {1.0: ("ascend", "lift off"), 0.6: ("climb", "lift"), 1.5: ("launch",)},
    "sink": {1.0: ("descend",), 0.8: ("land",)},
    "swing": {1.0: ("oscillate",), 0.6: ("dangle",)},
    "sway": {1.0: ("sway", "rock"), 1.5: ("wobble",), 4.0: ("tremble",)},
    "dance": {1.0: ("dance",)},
    "jump": {1.0: ("jump",), 0.7: ("hop",), 0.8: ("skip",)},
    "throw": {1.0: ("kick", "hit"), 0.8: ("toss",)},
    "work": {1.0: ("wave", "flap", "work", "operate")},
    "stand": {1.0: ("park", "wait", "rest", "stop", "stay", "pause", "pose", "graze")},
}  # fmt: skip
"""Motion → pace → verbs of which there is nothing else to say."""

VERBS: tuple[Verb, ...] = (
    Verb("go", "move", irregular=("went", "gone")),
    Verb("travel", "move", irregular=("travelling", "travelled")),
    Verb("come", "move", direction="towards", irregular=("came",)),
    Verb("approach", "move", direction="towards", relation="towards"),
    Verb("leave", "move", direction="away"),
    Verb("depart", "move", direction="away"),
    Verb("retreat", "move", direction="away"),
    Verb("pass", "move", relation="past"),
    Verb("cross", "move", direction="across", relation="on"),
    Verb("traverse", "move", direction="across", relation="on"),
    Verb("drive", "drive", irregular=("drove", "driven")),
    Verb("ride", "drive", irregular=("rode", "ridden")),
    Verb("speed", "move", 1.7, irregular=("sped",)),
    Verb("zoom past", "move", 1.8, relation="past"),
    Verb("creep", "move", 0.4, irregular=("crept",)),
    Verb("stride", "walk", 1.2, irregular=("strode",)),
    Verb("run", "run", irregular=("ran",)),
    Verb("flee", "run", 1.3, irregular=("fled", "fleeing")),
    Verb("chase", "run", 1.2, relation="follow"),
    Verb("follow", "move", relation="follow"),
    Verb("pursue", "run", 1.2, relation="follow"),
    Verb("fly", "fly", irregular=("flew", "flown")),
    Verb("swoop", "fly", 1.4, direction="down"),
    Verb("swim", "swim", irregular=("swam", "swum")),
    Verb("dive", "swim", 1.2, direction="down", irregular=("dove",)),
    Verb("spin", "spin", irregular=("spun",)),
    Verb("slide", "slide", irregular=("slid",)),
    Verb("fall", "fall", irregular=("fell", "fallen")),
    Verb("rise", "rise", irregular=("rose", "risen")),
    Verb("take off", "rise", irregular=("takes off", "taking off", "took off")),
    Verb("sink", "sink", 0.7, irregular=("sank",)),
    Verb("orbit", "orbit", relation="around"),
    Verb("circle", "orbit", relation="around"),
    Verb("revolve", "orbit", relation="around"),
    Verb("swing", "swing", irregular=("swung",)),
    Verb("shake", "sway", 3.0, irregular=("shook",)),
    Verb("leap", "jump", 1.2, irregular=("leapt",)),
    Verb("throw", "throw", irregular=("threw", "thrown")),
    Verb("dig", "work", irregular=("dug",)),
    Verb("blow", "work", irregular=("blew", "blown")),
    Verb("stand", "stand", irregular=("stood",)),
    Verb("sit", "sit", irregular=("sat", "seated")),
    Verb("sleep", "sit", irregular=("slept", "asleep")),
    Verb("lie", "stand", irregular=("lay", "lying")),
    Verb("hang", "stand", irregular=("hung",)),
    *(
        Verb(base, kind, pace)
        for kind, by_pace in _REGULAR_VERBS.items()
        for pace, verbs in by_pace.items()
        for base in verbs
    ),
)

STILL_WORDS = ("still", "motionless", "stationary", "unmoving")

DIRECTIONS: dict[str, tuple[str, ...]] = {
    "left": (
        "left", "leftward", "leftwards", "to the left", "to left", "towards the left",
        "from right to left", "from the right to the left", "right to left",
    ),
    "right": (
        "right", "rightward", "rightwards", "to the right", "to right", "towards the right",
        "from left to right", "from the left to the right", "left to right",
    ),
    "towards": (
        "towards the camera", "toward the camera", "towards us", "toward us", "towards the viewer",
        "toward the viewer", "to the camera", "at the camera", "closer",
    ),
    "away": (
        "away", "away from the camera", "away from us", "away from the viewer", "into the distance",
        "off into the distance",
    ),
    "forward": ("forward", "forwards", "ahead", "straight ahead"),
    "backward": ("backward", "backwards"),
    "up": ("up", "upward", "upwards", "skyward"),
    "down": ("down", "downward", "downwards", "to the ground"),
    "across": (
        "across", "across the frame", "across the screen", "across the picture", "past the camera",
        "by the camera", "past the viewer", "sideways",
    ),
    "circle": ("in circles", "in a circle", "around in circles"),
    "to and fro": ("back and forth", "to and fro", "side to side", "from side to side"),
    "up and down": ("up and down",),
}  # fmt: skip

SIDES: dict[str, tuple[str, ...]] = {
    "left": ("on the left", "on the left side", "at the left"),
    "right": ("on the right", "on the right side", "at the right"),
    "centre": ("in the middle", "in the center", "in the centre"),
    "far": ("in the distance", "in the background", "far away", "distant"),
    "near": ("in the foreground",),
}  # fmt: skip

PACES: dict[float, tuple[str, ...]] = {
    0.3: ("very slowly",),
    0.5: ("slowly", "slow", "lazily", "at low speed", "slightly"),
    0.6: ("gently", "gentle", "leisurely"),
    0.7: ("calmly",),
    1.0: ("steadily",),
    1.6: ("quickly", "quick", "swiftly"),
    1.7: ("fast",),
    1.9: ("faster",),
    1.8: ("rapidly", "rapid"),
    2.2: ("very fast", "at top speed"),
    2.0: ("at high speed", "at full speed", "wildly"),
}  # fmt: skip

SPEED_UNITS: dict[float, tuple[str, ...]] = {
    1 / 3.6: ("km / h", "kmh", "kph", "kilometers per hour", "kilometres per hour", "km per hour"),
    0.44704: ("mph", "miles per hour"),
    1.0: ("m / s", "mps", "meters per second", "metres per second"),
    0.514444: ("knots",),
}  # fmt: skip
"""m/s → units."""

RELATIONS: dict[str, tuple[str, ...]] = {
    "beside": (
        "next to", "beside", "alongside", "near", "close to", "by", "across from", "at", "against",
        "opposite",
    ),
    "behind": ("behind", "in back of"),
    "front": ("in front of",),
    "on": ("on", "on top of", "atop", "onto", "in", "inside"),
    "above": ("above", "over"),
    "under": ("under", "underneath", "below", "beneath"),
    "between": ("between",),
    "among": ("among", "amongst", "amid", "through"),
    "left of": ("left of", "to the left of", "on the left of"),
    "right of": ("right of", "to the right of", "on the right of"),
    "past": ("past", "along"),
    "around": ("around",),
    "surround": ("surrounded by", "lined with", "lined by"),
    "towards": ("towards", "toward", "to", "into"),
    "with": ("with",),
    "from": ("from",),
}  # fmt: skip
