"""Names of what people and hands can do, with the English phrases that mean them.

The rows of `data/activities.toml` and of `data/hand_gestures.toml`, and their motion.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any

from texvent.scenes.models.tables import frozen, read_table


@dataclass(frozen=True)
class Activity:
    """One activity; its name is an `ObjectMotion.kind`."""

    words: tuple[str, ...] = ()
    """Verb phrases in their base form."""
    near: tuple[str, ...] = ()
    """Phrases of what it shows only nearly, which is reported: "play football" of a kick."""
    named: tuple[str, ...] = ()
    """Phrases that name it and do not begin with a verb: "peace sign"."""
    travels: bool = False
    """Whether the body goes from place to place."""
    is_sideways: bool = False
    """Whether it is best seen from the side."""
    is_done_seated: bool = False
    """Whether it is done just as well sitting: the hips do not move."""
    moves_as: str = ""
    """Name of the activity whose motion it has; "" = its own."""
    contact_s: float | None = None
    """Of an act with one instant of contact, when that comes if the act is repeated, s."""
    reach_m: float = 0.0
    """From the right palm to where what it holds meets a ball, m."""
    pair_gap_m: float | None = None
    """Distance of two adults who do it before each other, m; None = each does it alone."""


def _read(name: str) -> Mapping[str, Activity]:
    known = {one.name for one in fields(Activity)}
    return MappingProxyType(
        {
            activity: Activity(**{key: frozen(value) for key, value in row.items() if key in known})
            for activity, row in read_table(name).items()
        }
    )


def motion_of(table: str, activity: str) -> dict[str, Any]:
    """What a row says of motion: the channels of a track."""
    known = {one.name for one in fields(Activity)} | {"props"}
    row = read_table(table).get(activity, {})
    return {key: value for key, value in row.items() if key not in known}


ACTIVITIES: Mapping[str, Activity] = _read("activities")
"""What a person can do: name → activity."""
HAND_GESTURES: Mapping[str, Activity] = _read("hand_gestures")
"""What a hand can do: name → gesture."""

TRAVELLING = frozenset(name for name, one in ACTIVITIES.items() if one.travels)
"""Names of the activities that go from place to place."""
DONE_SEATED = frozenset(name for name, one in ACTIVITIES.items() if one.is_done_seated)
"""What a person does just as well sitting: torso, head and arms move, the hips do not."""
SINGLE_ACTS = frozenset(name for name, one in ACTIVITIES.items() if one.contact_s is not None)
"""Acts with one instant of contact."""
PAIR_GAPS: Mapping[str, float] = MappingProxyType(
    {name: one.pair_gap_m for name, one in ACTIVITIES.items() if one.pair_gap_m is not None}
)
"""Activity → distance of two adults who do it before each other, m."""
TO_AND_FROM_SEATS = frozenset({"sit down", "stand up"})
"""Activities that begin or end on a seat, or on the ground where there is none."""
ON_GROUND: Mapping[str, str] = MappingProxyType(
    {"sit": "sit on ground", "sit down": "sit down on ground", "stand up": "stand up from ground"}
)
"""What they are called, and sitting, where there is no seat."""
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
HAND_NOUNS = frozenset(read_table("outfits")["hands"])
"""Nouns whose models take every posture of `HAND_GESTURES`."""
