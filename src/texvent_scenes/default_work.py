"""Work of what stays in its place and moves in itself: a fan, a clock, a belt that runs."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent_scenes.description import STANDING, WAYS_DEG, SceneDescription
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value
from texvent_scenes.spec.scene import Direction, Motion, SceneObject

_BY_TURNS = frozenset({"work", "spin", "swing", "move", "stand"})
"""Motions of what works and rests at stated times."""
_SIDES = ("left", "right")
_ALONG = 0.6
"""Least cosine between the way of a belt and a direction that is said of it."""
AT_REST = Motion("stand", start_s=0.0)
"""Rest that is said of what works otherwise."""


def stands_still(one: SceneObject, noun: Noun) -> bool:
    """Whether rest, and nothing else, is said of what works."""
    kinds = [each.kind for each in one.motions]
    return kinds == ["stand"] and not one.motions[0].start_s and noun.is_working


def is_work(motion: Motion | None, noun: Noun) -> bool:
    """Whether a motion is that of the parts of a noun, which stays where it is."""
    if motion is None or motion.kind in ("stand", "swing", "spin", "turn", "work", "sway"):
        return True
    if motion.kind == "move" and motion.direction in _SIDES and _is_machine(noun):
        return True  # its belt runs, not the whole machine
    is_flat = noun.name in nouns_with("flat pattern")
    turns = trait_value("turns per second", noun.name) is not None
    swings = motion.direction == "to and fro" and not (turns or noun.speed_m_s)
    return motion.kind == "move" and (motion.direction is None or is_flat or swings)


def work_of(motion: Motion | None, noun: Noun) -> Motion:
    """The work that a motion stands for."""
    rests = motion is None or motion.kind == "stand"
    if rests and noun.name in nouns_with("works on demand"):
        return STANDING
    if motion is None:
        return Motion("work")
    kept = motion.direction in ("clockwise", "counter-clockwise", "left", "right")
    direction = motion.direction if kept else None
    pace, said, own_hz = motion.pace, {}, trait_value("turns per second", noun.name)
    belt_m_s = trait_value("belt speed", noun.name)
    if direction == "left" and belt_m_s is not None and noun.name in nouns_with("flat pattern"):
        direction = "clockwise"  # backwards: its belt runs to the right of who sees its front
    if motion.rate_hz is not None and own_hz is not None:
        pace, said = motion.rate_hz / own_hz, {"rate_hz": motion.rate_hz}
    elif motion.speed_m_s is not None and belt_m_s is not None:
        pace, said = motion.speed_m_s / belt_m_s, {"speed_m_s": motion.speed_m_s}
    elif motion.kind in ("spin", "turn", "swing") and motion.end_pace is None:  # not "spins up"
        # "rotates" is no slower than usual
        pace = max(pace, 1.0)
    return Motion("work", direction, pace, end_pace=motion.end_pace, **said)


def _is_machine(noun: Noun) -> bool:
    """Whether it has a belt on a frame that stays."""
    is_flat = noun.name in nouns_with("flat pattern")
    return trait_value("belt speed", noun.name) is not None and not is_flat


def stays_put(motion: Motion, noun: Noun) -> bool:
    """Whether a machine with a belt would go somewhere as a whole by its usual motion."""
    return _is_machine(noun) and not is_work(motion, noun)


def works_by_turns(motions: Sequence[Motion], noun: Noun) -> bool:
    """Whether something works and rests in turn: "stand" is rest then, as it is of a body."""
    if not noun.is_working or not motions or (len(motions) == 1 and not motions[0].start_s):
        return False
    are_fit = all(one.kind in _BY_TURNS and is_work(one, noun) for one in motions)
    return are_fit and any(one.kind != "stand" for one in motions)


def aligned(motions: Sequence[Motion], noun: Noun, heading_deg: float | None) -> tuple[Motion, ...]:
    """Motions of what works; a belt with a heading runs forwards or backwards, to the stated side.

    A leg without a direction runs as the first one does; a direction across the belt says nothing.
    """
    if heading_deg is None or not _is_machine(noun):
        return tuple(motions)
    works = [one.kind != "stand" and is_work(one, noun) for one in motions]
    senses = [_sense(one.direction, heading_deg) for one in motions]
    first = next((one for one, is_on in zip(senses, works, strict=True) if is_on), None)
    usual: Direction = first or "counter-clockwise"
    return tuple(
        replace(one, kind="work" if one.kind == "move" else one.kind, direction=sense or usual)
        if is_on
        else one
        for one, sense, is_on in zip(motions, senses, works, strict=True)
    )


def _sense(direction: Direction | None, heading_deg: float) -> Direction | None:
    """The sense of a belt with a heading that carries goods in a direction, if one does."""
    if direction in ("clockwise", "counter-clockwise"):
        return direction
    if direction not in WAYS_DEG:
        return None
    along = math.cos(math.radians(WAYS_DEG[direction] - heading_deg))
    if abs(along) < _ALONG:
        return None
    return "clockwise" if along < 0.0 else "counter-clockwise"


def list_work(motions: Sequence[Motion], noun: Noun) -> tuple[Motion, ...]:
    """Work and rest in turn; a belt lies as it runs first, and runs backwards to the other side."""
    done = [STANDING if one.kind == "stand" else work_of(one, noun) for one in motions]
    first = next(one.direction for one in done if one.kind == "work")
    if _is_machine(noun) and first in (None, *_SIDES):
        side: Direction = first or "right"
        done = [replace(one, direction=None if one.direction in (None, side) else "clockwise")
                for one in done]  # fmt: skip
        done[0] = replace(done[0], direction=side)
    return tuple(
        replace(one, start_s=said.start_s) for one, said in zip(done, motions, strict=True)
    )


def list_swung(description: SceneDescription) -> list[int]:
    """Swings of a sentence of which no motion is said, and on which others only sit."""
    riders: dict[int, set[str]] = {}
    for one in description.relations:
        for n in one.targets if one.kind in ("on", "ride") else ():
            does = {each.kind for each in description.objects[one.subject].motions}
            riders.setdefault(n, set()).update(does)
    swings = (n for n, does in riders.items() if does <= {"sit"})
    return [n for n in swings if description.is_sentence and description.objects[n].motion is None
            and description.objects[n].noun in nouns_with("swings")]  # fmt: skip
