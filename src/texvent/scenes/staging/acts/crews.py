"""Who works on which thing, with which tool, and on what the thing lies."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import Relation
from texvent.scenes.staging.acts.cast import Cast
from texvent.scenes.staging.acts.climbing import climb_at, climb_stairs, climb_up
from texvent.scenes.staging.acts.hand_work.enlarged import Enlarged
from texvent.scenes.staging.acts.hand_work.working import (
    SMALL_M,
    before_mouth,
    moved_with,
    shortened,
    work_at,
)
from texvent.scenes.staging.acts.holding import is_person
from texvent.scenes.staging.trajectories.trajectory import Stationary


def put_to_work(cast: Cast, relations: Sequence[Relation], every: Sequence[Relation]) -> None:
    """All who work on one thing share the room along it.

    Args:
        cast: the actors; workers, things and tools are replaced.
        relations: the acts of the prompt.
        every: all its relations, which say what things are on or in.
    """
    crews: dict[int, list[int]] = {}
    tools: dict[int, int] = {}
    for relation in relations:
        targets = cast.copies(relation.targets[0])
        if relation.kind == "work on" and targets:
            for turn, subject in enumerate(cast.copies(relation.subject)):
                crews.setdefault(targets[turn % len(targets)], []).append(subject)
        elif relation.kind == "hold" and targets:
            tools.update(dict.fromkeys(cast.copies(relation.subject), targets[0]))
    on = {r.subject: r.targets[0] for r in every if r.kind in ("on", "in")}
    for target, crew in crews.items():
        under = cast.copies(on.get(cast.get(target).object_index, -1))
        for place, subject in enumerate(crew):
            if not is_person(cast.get(subject)):
                if _climbs(cast, subject):
                    cast.put(subject, climb_up(cast.get(subject), cast.get(target)))
                    continue
                cast.put(target, before_mouth(cast.get(subject), cast.get(target)))
            elif _climbs(cast, subject):
                _set_climbing(cast, subject, target)
            else:
                used = tools.get(subject)
                _set_to_work(cast, (subject, target, used), under[:1], (place, len(crew)))
                copies = cast.copies(cast.get(target).object_index)
                _lay_beside(cast, subject, target, [one for one in copies if one not in crews])


_MOST_BESIDE = 4
"""Other copies that find room on the worker's table."""


def _lay_beside(cast: Cast, subject: int, target: int, idle: Sequence[int]) -> None:
    """More of the things that one works on, on the same table."""
    worker, thing = cast.get(subject), cast.get(target)
    if not any(prop.furniture == "table" for prop in worker.props):
        return
    state, heading = thing.trajectory.at(0.0), worker.trajectory.at(0.0).yaw
    step = 1.2 * min(thing.model.length, thing.model.width) + 0.03
    for number, one in enumerate(idle[:_MOST_BESIDE]):
        aside = step * (1 + number // 2) * (1.0 if number % 2 else -1.0)
        x, y, z = state.position
        home = (x - aside * math.sin(heading), y + aside * math.cos(heading), z)
        other = cast.get(one)
        larger = thing.model.height / max(other.model.height, 1e-6)
        path = Stationary(home, state.yaw)
        cast.put(one, replace(other, model=Enlarged(other.model, larger), trajectory=path))


def _climbs(cast: Cast, number: int) -> bool:
    return cast.get(number).trajectory.at(0.0).activity.startswith("climb")


def _set_climbing(cast: Cast, subject: int, target: int) -> None:
    if cast.get(target).noun.name != "stairs":
        cast.put(subject, climb_at(cast.get(subject), cast.get(target)))
        return
    climber, stairs = climb_stairs(cast.get(subject), cast.get(target))
    cast.put(subject, climber)
    cast.put(target, stairs)


def _set_to_work(
    cast: Cast, who: tuple[int, int, int | None], under: list[int], team: tuple[int, int]
) -> None:
    """A worker, a thing, a tool; what is in a pot is worked on in the pot."""
    subject, target, used = who
    tool = None
    if used is not None:
        tool = shortened(cast.get(used))
        cast.put(used, tool)
    support = cast.get(under[0]) if under else None
    if support is not None and support.size_m < SMALL_M:
        worker, pot = work_at(cast.get(subject), support, *team, tool)
        cast.put(under[0], pot)
        thing = moved_with(cast.get(target), support, pot)
    else:
        worker, thing = work_at(cast.get(subject), cast.get(target), *team, tool, support)
    cast.put(subject, worker)
    cast.put(target, thing)
