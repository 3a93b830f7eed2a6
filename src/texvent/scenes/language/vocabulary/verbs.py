"""Verbs of motion: what the subject does, and what it does to its object."""

from __future__ import annotations

from dataclasses import dataclass

from texvent.scenes.language.vocabulary.film import UPRIGHT_AXES


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
        2.4: ("race", "speed", "bolt", "charge"), 2.2: ("rush", "storm"),
        2.6: ("zip", "streak", "dart", "zoom", "whiz", "whizz", "whoosh", "hurtle", "barrel",
              "careen", "blast"),
        1.8: ("hurry", "roar", "thunder", "scurry", "scamper", "scuttle"),
        0.4: ("creep", "inch"), 0.6: ("trundle", "rumble", "lumber", "limp", "plod", "trudge",
                                      "shuffle", "amble", "saunter", "prowl"),
        0.7: ("drift", "scroll", "translate"), 0.8: ("coast", "cruise"), 1.4: ("skim",),
    },
    "run": {
        1.4: ("dash", "sprint"), 0.8: ("jog",), 1.3: ("gallop",), 0.7: ("trot", "prance"),
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
    "sway": {1.0: ("sway", "rock", "bob", "teeter"), 1.5: ("wobble", "lurch"),
             4.6: ("tremble", "vibrate", "quiver", "judder", "rattle"),
             3.0: ("shiver", "shudder", "jitter", "twitch", "jolt", "quake", "jerk")},
    "dance": {1.0: ("dance",)},
    "jump": {1.0: ("jump",), 0.7: ("hop",), 0.8: ("skip",), 1.2: ("leap",)},
    "work": {1.0: ("flap", "work", "tick", "operate", "beat", "pulse", "throb", "pulsate",
                   "print", "clack")},
    "stand": {
        1.0: ("park", "wait", "rest", "stay", "pause", "pose", "stand", "hang", "remain",
               "perch", "idle", "moor", "anchor", "dock"),
    },
    "sit": {1.0: ("sit",)},
    "lie": {1.0: ("lie", "doze", "sleep")},
    "sit down": {1.0: ("sit down",)},
    "lie down": {1.0: ("lie down",)},
    "stand up": {1.0: ("stand up", "get up")},
}  # fmt: skip
"""Motion → pace → verbs of which there is nothing else to say."""

_PASSING = {
    2.4: ("race", "speed", "rush", "tear", "zip", "zoom", "whiz", "whizz", "whoosh", "hurtle",
          "streak", "barrel", "blast", "shoot", "flash", "blur", "roar", "thunder", "whip"),
}  # fmt: skip
"""Pace → verbs that go with "past"; others do so before what is passed."""

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
    *(Verb(f"pull {way}", "move", 0.0, end_pace=1.0) for way in ("away", "off", "forward")),
    *(Verb(f"pull {way}", "move", 1.0, end_pace=0.0) for way in ("over", "up", "in", "into")),
    *(Verb(f"drive {way}", "move", direction="away") for way in ("off", "away")),
    *(
        Verb(f"{base} {way}", "move", 2.6, direction="away")
        for base in ("shoot", "dart", "zip", "zoom", "speed", "race", "blast")
        for way in ("off", "away")
    ),
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
    *(
        Verb(f"{base} past", "move", pace, relation="past")
        for pace, bases in _PASSING.items()
        for base in bases
    ),
    Verb("cross", "move", direction="across", relation="on"),
    Verb("traverse", "move", direction="across", relation="on"),
    *(
        Verb(base, "move", 0.5, end_pace=1.8)
        for base in (
            "accelerate",
            "speed up",
            "gain speed",
            "pick up speed",
            "gather speed",
        )
    ),
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
    *(Verb(f"come to a {end}", "stand") for end in ("stop", "halt", "standstill", "full stop")),
    Verb("come to rest", "stand"),
    Verb("turn", "turn", object_kind="spin"),
    Verb("swerve", "turn", 1.3),
    Verb("curve", "turn"),
    Verb("veer", "turn", 1.2),
    Verb("bank", "turn"),
    Verb("change direction", "turn"),
    Verb("turn around", "turn", direction="around"),
    Verb("make a u turn", "turn", direction="around"),
    Verb("thread", "move"),
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
    *(Verb(base, "flip", object_kind="flip") for base in ("flip", "flip over")),
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
    *(Verb(base, "sail", 0.7, act="ride") for base in ("kayak", "canoe")),
    *(Verb(base, "drive", act="ride") for base in ("motorcycle", "motorbike")),
    Verb("paddle", "sail", 0.7, act="ride"),
    Verb("spin", "spin", object_kind="spin"),
    Verb("yaw", "spin", 0.5),
    *(Verb(f"rotate {axis}", "spin", 0.7) for axis in UPRIGHT_AXES),
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
