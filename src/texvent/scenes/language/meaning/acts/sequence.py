"""What comes after, or goes with, what an object did before."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.referents import OWNERS, Referent
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.models.people.activities import ACTIVITIES, DONE_SEATED

_SEATED = ("type", "play piano", "play drums", "row")
"""Activities with a seat of their own."""


def comes_next(clause: Clause) -> bool:
    """As in "a bird perched on a fence flies off": a main clause goes on from what was said."""
    return clause.opener is None and not clause.is_participle and not clause.is_relative


def is_done_in(posture: str, kind: str) -> bool:
    """As in "a man standing on a hill waves", "sitting on a bench, reading"."""
    activity = ACTIVITIES.get(kind)
    if posture == "sit":
        return kind in DONE_SEATED or kind in _SEATED
    return posture == "stand" and activity is not None and not activity.travels


def is_part_of_doer(one: Referent) -> bool:
    """As in "wiggles its hind legs": a part of who does it."""
    determiner, head = one.group.determiner, one.group.head
    is_part = head is not None and head.read_as(Role.PART) is not None
    return is_part and determiner is not None and determiner.text in OWNERS


def carry_on(before: ObjectMotion, motion: ObjectMotion) -> ObjectMotion:
    """What moves on keeps its direction."""
    keeps = motion.direction is None and before.is_moving and motion.kind == before.kind
    return replace(motion, direction=before.direction) if keeps else motion
