"""Activities of people, hands and animals: their words, and what kind they are.

They are the rows of `data/activities.toml`, `hand_gestures.toml` and `animal_activities.toml`.
`postures.py` reads their motion.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from functools import cache
from types import MappingProxyType
from typing import Any

from texvent_scenes.models.tables import frozen, has_trait, nouns_with, read_table


@dataclass(frozen=True)
class Activity:
    """One activity; its name is an `Motion.kind`."""

    words: tuple[str, ...] = ()
    """Verb phrases in their base form."""
    near: tuple[str, ...] = ()
    """Phrases of what it shows only nearly, which is reported: "play football" of a kick."""
    verbs: tuple[str, ...] = ()
    """Verbs of an act on something, which is an object of the sentence."""
    upon: Mapping[str, Any] | None = None
    """Object of the act and its place: fields of `Upon`."""
    effect: str = ""
    """Effect that comes from who does it."""
    named: tuple[str, ...] = ()
    """Phrases that name it and do not begin with a verb: "peace sign"."""
    travels: bool = False
    """Whether the body goes from place to place."""
    is_sideways: bool = False
    """Whether it is best seen from the side."""
    is_done_seated: bool = False
    """Whether it is done just as well sitting: the hips do not move."""
    is_at_bench: bool = False
    """Whether arms and head do it at a bench: the legs may be out of the image."""
    moves_as: str = ""
    """Name of the activity whose motion it has; "" = its own."""
    contact_s: float | None = None
    """Time of the contact in an act that has one, if the act is repeated, s."""
    reach_m: float = 0.0
    """From the hand to where what it swings meets a ball, m; 0 = it swings nothing."""
    sends_rad: float = 0.0
    """Direction in which the ball goes then, to the left of the body."""
    repeats_hz: float = 0.0
    """Repetitions per second, of an act that is counted; 0 = it is not."""
    is_hop: bool = False
    """Whether it follows the time of a hop."""
    is_timed: bool = False
    """Whether it happens once, and follows the time since it began."""
    from_state: str = ""
    """Activity before it, of what switches from one state to another."""
    to_state: str = ""
    """Activity after it: at a stated time it begins at once."""


@dataclass(frozen=True)
class Upon:
    """Object of an act, and its place while it lasts."""

    nouns: tuple[str, ...]
    """Nouns, and traits of nouns."""
    at: str = "ground"
    """Place of the body that has it; "front" = it stands on the ground before the body, sideways.
    """
    place: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Bottom of its middle in the axes of that place, m; in "front" the gap before the body."""
    turn: float | None = None
    """Its heading against that of the body, rad; None = its longer side goes across."""
    motion: str = ""
    """Its motion."""


PEOPLE = "people"
"""Word of `Upon.nouns` for all nouns of people."""
USUAL = "usual"
"""Name of the row of a table with the channels that an activity does not say."""
OTHER = "other"
"""Name of the row of activities that a table does not have; without it they decide nothing."""
_APART = frozenset({"props", "gait", "steps"})
"""Keys of a row that are neither fields of `Activity` nor channels."""


def _read(name: str) -> Mapping[str, Activity]:
    known = {one.name for one in fields(Activity)}
    return MappingProxyType(
        {
            activity: Activity(**{key: frozen(value) for key, value in row.items() if key in known})
            for activity, row in read_table(name).items()
            if activity not in (USUAL, OTHER)
        }
    )


def motion_of(table: str, activity: str) -> dict[str, Any]:
    """Motion of a row, or of the one that it moves as: the channels of a track."""
    rows = read_table(table)
    row = rows.get(activity, rows.get(OTHER, {}))
    row = rows[row["moves_as"]] if "moves_as" in row else row
    known = {one.name for one in fields(Activity)} | _APART
    return {key: value for key, value in row.items() if key not in known}


def upon_of(activity: str) -> Upon | None:
    """Object of an activity of people or animals; None: it has none."""
    row = ACTIVITIES.get(activity) or ANIMAL_ACTIVITIES.get(activity)
    return Upon(**row.upon) if row is not None and row.upon else None


@cache
def nouns_upon(activity: str) -> frozenset[str]:
    """Nouns that an activity is done to."""
    upon = upon_of(activity)
    said = () if upon is None else upon.nouns
    found = (nouns_with(one) if has_trait(one) else {one} for one in said)
    return frozenset().union(*found) | (PERSON_NOUNS if PEOPLE in said else frozenset())


def is_mutual(activity: str) -> bool:
    """Whether two people do it to each other."""
    upon = upon_of(activity)
    return upon is not None and PEOPLE in upon.nouns


ACTIVITIES: Mapping[str, Activity] = _read("activities")
"""Activities of people: name → activity."""
HAND_GESTURES: Mapping[str, Activity] = _read("hand_gestures")
"""Gestures of hands: name → gesture."""
ANIMAL_ACTIVITIES: Mapping[str, Activity] = MappingProxyType(
    {name: one for name, one in _read("animal_activities").items() if one.words or one.verbs}
)
"""Activities of animals in place: name → activity."""
TIMED = frozenset(name for name, one in ANIMAL_ACTIVITIES.items() if one.is_timed)
"""Acts of parts that happen once: a door opens."""


@cache
def limbs_of(activity: str) -> frozenset[str]:
    """Channels of an act of animals without which it is not seen: paws, head, the trunk's roll."""
    row = motion_of("animal_activities", activity)
    return frozenset(one for one in {*row, *row.get("keys", ())} if one.startswith(_LIMBS))


_LIMBS = ("left_", "right_", "roll", "look", "doze", "clapping")
MOUTH_ACTIVITIES = frozenset(
    name for name in ANIMAL_ACTIVITIES
    if "down" in motion_of("animal_activities", name) and not limbs_of(name)
)  # fmt: skip
"""Those in which the mouth is at the ground, or at what is eaten."""

TRAVELLING = frozenset(
    name for name, one in {**ANIMAL_ACTIVITIES, **ACTIVITIES}.items() if one.travels
)
"""Names of the activities that go from place to place."""
DONE_SEATED = frozenset(name for name, one in ACTIVITIES.items() if one.is_done_seated)
"""Activities that people also do sitting: torso, head and arms move, the hips do not."""
OF_ARMS = DONE_SEATED | {name for name, one in ACTIVITIES.items() if one.is_at_bench}
"""Activities that are seen without the legs."""
SINGLE_ACTS = frozenset(name for name, one in ACTIVITIES.items() if one.contact_s is not None)
"""Acts with one instant of contact."""
TO_AND_FROM_SEATS = frozenset({"sit down", "stand up"})
"""Activities that begin or end on a seat, or on the ground where there is none."""
ON_GROUND: Mapping[str, str] = MappingProxyType(
    {"sit": "sit on ground", "sit down": "sit down on ground", "stand up": "stand up from ground"}
)
"""Names of these activities, and of sitting, where there is no seat."""
AIMED = frozenset({"point", "wave", "look", "feed", "talk", "shout"})
"""Activities that are turned to who or what they are for."""
ON_TOP: Mapping[str, str] = MappingProxyType({"lift": "lift off a top", "set down": "set on a top"})
"""Names of acts on a thing, as relations, where it is or comes to be on a bench."""
SAT = frozenset({"type", "play piano", "play drums"})
"""Activities of who sits on a seat that comes with them."""
ON_FOOT = frozenset({"walk", "run", "move"})
"""Motions of a person on the way, while whom the arms may do something else."""
SEATED = "sit and "
"""Begins the name of what is done sitting, as "sit and read"."""

DVS_GESTURES: Mapping[str, str] = MappingProxyType(
    {
        "hand clap": "clap",
        "right hand wave": "wave right",
        "left hand wave": "wave left",
        "right arm clockwise": "right arm clockwise",
        "right arm counter clockwise": "right arm counter-clockwise",
        "left arm clockwise": "left arm clockwise",
        "left arm counter clockwise": "left arm counter-clockwise",
        "arm roll": "arm roll",
        "air drums": "air drums",
        "air guitar": "air guitar",
        "other gestures": "other gesture",
    }
)
"""Class of DVS-Gesture (Amir et al., CVPR 2017) → activity."""

PERSON_NOUNS = frozenset(read_table("outfits")["people"])
"""Nouns whose models take every posture of `ACTIVITIES`."""
HAND_NOUNS = frozenset(read_table("people/hands"))
"""Nouns whose models take every posture of `HAND_GESTURES`."""
