"""Nouns that name what a thing does: "takeoff", "lane change", "u-turn".

After a thing such a noun is its verb, as in "drone takeoff"; after "does" or "makes" too. Alone it
tells of the thing that usually does it.
"""

from __future__ import annotations

from typing import NamedTuple


class NamedAct(NamedTuple):
    """One verb, by the nouns that name what it does."""

    verb: str
    """Base of a verb of `motion.VERBS`."""
    doer: str
    """The thing that does it where none is named; "" = none is shown."""
    nouns: tuple[str, ...]
    direction: str | None = None
    """As `ObjectMotion.direction`."""


NAMED_BY_NOUN: tuple[NamedAct, ...] = (
    NamedAct("take off", "airplane", ("takeoff", "liftoff")),
    NamedAct("land", "airplane", ("touchdown",)),
    NamedAct("launch", "rocket", ("blastoff",)),
    NamedAct("change lanes", "car", (
        "lane change", "lane changing", "lane switch", "lane shift", "lane merge", "changing lanes",
        "change of lane", "change of lanes", "lane change maneuver", "lane change manoeuvre",
    )),
    NamedAct("turn", "car", ("u turn", "uturn"), "around"),
    NamedAct("turn", "car", ("left turn", "left hand turn"), "left"),
    NamedAct("turn", "car", ("right turn", "right hand turn"), "right"),
    NamedAct("brake", "car", (
        "emergency braking", "emergency brake", "emergency stop", "hard braking", "hard brake",
        "sudden braking", "sudden stop", "braking",
    )),
    NamedAct("park", "car", ("parking", "parking maneuver", "parking manoeuvre")),
    NamedAct("reverse", "car", ("reversing",)),
    NamedAct("drift", "car", ("drifting",)),
    NamedAct("overtake", "car", (
        "overtaking", "overtaking maneuver", "overtaking manoeuvre",
    )),
    NamedAct("crash", "car", (
        "crash", "collision", "rear end collision", "rear end crash", "head on collision",
        "head on crash", "car accident", "traffic accident", "road accident", "fender bender",
        "pile up",
    )),
    NamedAct("pick and place", "robot arm", (
        "pick and place", "pick and place task", "pick and place operation", "bin picking",
        "pick place",
    )),
    NamedAct("wheelie", "motorcycle", ("wheelie",)),
    NamedAct("flip", "", ("barrel roll",)),
    NamedAct("fly", "", ("flight", "flyby", "flyover")),
    NamedAct("arrive", "", ("arrival",)),
    NamedAct("depart", "", ("departure",)),
)  # fmt: skip
"""Verb → nouns that name it."""
DONE = frozenset({"do", "make", "perform", "execute", "attempt", "complete", "take", "carry out"})
"""Verbs that say only that what their object names is done: "makes a U-turn"."""
NAMED = frozenset(noun for act in NAMED_BY_NOUN for noun in act.nouns)
"""All of these nouns."""
SAME_AS_VERB = frozenset(
    {"turn", "spin", "roll", "flip", "jump", "hop", "leap", "bounce", "swing", "twirl", "dive",
     "zigzag", "wobble", "slide", "skid"}
)  # fmt: skip
"""Nouns of what is done that are written as their verbs: "does a spin"."""
