"""Machines in a scene: what they handle, from where and to where, by its relations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.description import IndexedRelation, SceneDescription
from texvent_scenes.models.anchors import gripper_of, grips
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.shapes import point
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.interactions.gripping import Left, grip

__all__ = ["fit_hand", "grips", "perform_grip"]

_SLACK, _LEAST_SIZE = 0.5, 0.2
"""Least width of a thing, as a share of the widest that a machine has; least size of a machine."""
_UNDER, _OVER = ("on", "from", "off", "in", "at"), ("on", "in", "into", "to", "above")
"""Relations to what a thing is taken from, and to what it is left on."""


def fit_hand(
    machine: SceneObject, thing: SceneObject, nouns: Mapping[str, Noun], *, is_free: bool
) -> tuple[SceneObject, SceneObject]:
    """A machine and what fits into its hand, at rest; a machine on a table if that is small."""
    width_m = nouns[thing.noun].build(colour=None, scale=thing.size, seed=0).width
    size = machine.size * size_of(nouns[machine.noun].build(colour=None, scale=1.0, seed=0))
    row = gripper_of(machine.noun)
    widest_m, share = size * row.width, 1.0
    if is_free and not row.is_below:
        share = max(min(width_m / (_SLACK * widest_m), 1.0), _LEAST_SIZE)
    small = min(1.0, widest_m / width_m)
    return (replace(machine, size=share * machine.size),
            replace(thing, motions=(), size=small * thing.size))  # fmt: skip


def perform_grip(
    cast: dict[int, Actor], act: IndexedRelation, description: SceneDescription, duration_s: float
) -> None:
    """An act of a machine's hand on all copies of what it handles."""
    copies = {index: [n for n, one in cast.items() if one.object_index == index]
              for index in {one.object_index for one in cast.values()}}  # fmt: skip
    things = [n for one in act.targets for n in copies.get(one, ())]
    who = copies.get(act.subject, [])[:1]
    if not (who and things):
        return
    said = description.objects[act.subject]
    below = _list_near(act, description.relations, copies)
    is_stacked = any(one.kind == "stack" and one.subject in act.targets
                     for one in description.claims)  # fmt: skip
    is_left = act.kind in ("move over", "set down", "drop")
    over = next((kind for kind in _OVER if kind in below), "") if is_left else ""
    left: Left = "in" if over != "on" else "pile" if is_stacked else "on"
    goal = below.get(over)
    support = next((below[kind] for kind in _UNDER if kind in below and below[kind] != goal), None)

    def perform() -> tuple[Actor, list[Actor], Actor | None]:
        return grip(
            act.kind, cast[who[0]], [cast[n] for n in things], duration_s,
            support=None if support is None else cast[support],
            goal=None if goal is None else cast[goal],
            is_turned=said.heading_deg is None, left=left, begin_s=_begin_s(said),
        )  # fmt: skip

    machine, handled, put = perform()
    moved = [*things, *([] if support is None else [support])]
    stated = [n for n in (*who, *moved)
              if description.objects[cast[n].object_index].position_m is not None]  # fmt: skip
    is_borne = any(one.kind == "on" and one.subject == act.subject for one in description.relations)
    if stated == who and not is_borne:  # what it handles comes to it
        off = np.subtract(cast[who[0]].track.at(0.0).position, machine.track.at(0.0).position)
        cast.update({n: _shifted(cast[n], off) for n in moved})
        machine, handled, put = perform()
    cast.update({who[0]: machine, **dict(zip(things, handled, strict=True))})
    if goal is not None and put is not None:
        cast[goal] = put


def _begin_s(machine: SceneObject) -> float | None:
    """When its motions have it begin its act, s; None: they say no time."""
    works = (one.start_s for one in machine.motions if one.kind != "stand")
    return next((one for one in works if one is not None), None)


def _shifted(one: Actor, off: Float64Array) -> Actor:
    """A body at another place, m from where it was."""
    start = point(np.add(one.track.start, off))
    return replace(one, track=replace(one.track, start=start))


def _list_near(
    act: IndexedRelation, relations: Sequence[IndexedRelation], copies: Mapping[int, Sequence[int]]
) -> dict[str, int]:
    """Kind of relation of the machine or the thing to another body → the first of these."""
    about = {act.subject, *act.targets}
    near = [(one.kind, n) for one in relations if one.subject in about and one is not act
            for each in one.targets if each not in about for n in copies.get(each, ())]  # fmt: skip
    return {kind: n for kind, n in reversed(near)}
