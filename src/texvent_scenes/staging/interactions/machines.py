"""Machines in a scene: what they handle, from where and to where, by its relations."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.errors import ConfigError
from texvent_scenes.description import IndexedRelation, SceneDescription, label_of
from texvent_scenes.models.anchors import gripper_of, grips
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.shapes import point
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.spec.scene import SceneObject
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.interactions.gripping import Left, Manner, grip
from texvent_scenes.staging.interactions.reaching import OutOfReachError

__all__ = ["fit_hand", "grips", "perform_grip"]

_SLACK, _LEAST_SIZE = 0.5, 0.2
"""Least width of a thing, as a share of the widest that a machine has; least size of a machine."""
_PLACED_M = 0.02
"""Most way from a stated place."""
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
    machines = copies.get(act.subject, [])
    if not (machines and things):
        return
    who = machines[0]
    said = description.objects[act.subject]
    below = _list_near(act, description.relations, copies)
    is_stacked = any(one.kind == "stack" and one.subject in act.targets
                     for one in description.claims)  # fmt: skip
    is_left = act.kind in ("move over", "set down", "drop")
    over = next((kind for kind in _OVER if kind in below), "") if is_left else ""
    left: Left = "in" if over != "on" else "pile" if is_stacked else "on"
    goal = below.get(over)
    support = next((below[kind] for kind in _UNDER if kind in below and below[kind] != goal), None)

    def perform(*, is_fixed: bool = False) -> dict[int, Actor]:
        machine, handled, put = grip(
            act.kind, cast[who], [cast[n] for n in things], duration_s,
            support=None if support is None else cast[support],
            goal=None if goal is None else cast[goal],
            manner=Manner(said.heading_deg is None, is_fixed, left, _begin_s(said)),
        )  # fmt: skip
        found = {who: machine, **dict(zip(things, handled, strict=True))}
        return found if goal is None or put is None else {**found, goal: put}

    acting = perform()
    free = [who] if support is None else [*things, support]
    about = dict.fromkeys((who, *things, *(one for one in (support, goal) if one is not None)))
    stated = [n for n in about if _is_stated(description, cast[n])]
    offs = _list_moves(cast, acting, stated)
    is_borne = any(one.kind == "on" and one.subject == act.subject for one in description.relations)
    if len({tuple(np.round(one, 3)) for one in offs}) == 1 and not (who in stated and is_borne):
        cast.update({n: _shifted(cast[n], offs[0]) for n in free})  # it comes to what is stated
        acting = perform()
    elif np.abs(offs).max(initial=0.0) > _PLACED_M:
        try:
            acting = perform(is_fixed=True)
        except OutOfReachError as reach:
            raise ConfigError(
                _tell_reach(description, cast, (who, things[0]), stated, reach, act.kind)
            ) from None
    cast.update(acting)


def _is_stated(description: SceneDescription, one: Actor) -> bool:
    said = description.objects[one.object_index]
    return said.position_m is not None and said.count == 1


def _list_moves(
    cast: Mapping[int, Actor], acting: Mapping[int, Actor], stated: Sequence[int]
) -> list[Float64Array]:
    """[2] ways back from where an act puts bodies to where they are stated, m."""
    places = [[one[n].track.at(0.0).position[:2] for one in (cast, {**cast, **acting})]
              for n in stated]  # fmt: skip
    return [np.subtract(before, after) for before, after in places]


def _tell_reach(
    description: SceneDescription, cast: Mapping[int, Actor], pair: tuple[int, int],
    stated: Sequence[int], reach: OutOfReachError, kind: str,
) -> str:  # fmt: skip
    """Why a machine does not get to a thing, and what would do."""
    machine, thing = (cast[n] for n in pair)
    name, other = (label_of(description, one.object_index) for one in (machine, thing))
    own, *others = [f"objects[{cast[n].object_index}].position_m" for n in stated]
    here = np.array(machine.track.at(0.0).position[:2])
    there = np.array(thing.middle(0.0)[:2])
    first = description.objects[cast[stated[0]].object_index].position_m or (0.0, 0.0)
    what = f"{own} is [{first[0]:g}, {first[1]:g}], but "
    if not math.isfinite(reach.near_m):
        return (f"{what}the hand of the {name} does not get as high as the {other} is; leave "
                "position_m out, or what it is on")  # fmt: skip
    what += (f"the {other} is then {float(np.linalg.norm(there - here)):.2f} m from the {name}, "
             f"whose act ({kind}) needs it {reach.near_m:.2f} to {reach.far_m:.2f} m away; "
             )  # fmt: skip
    if not others:
        return f"{what}leave position_m out"
    way = np.array([math.cos(reach.way_rad), math.sin(reach.way_rad)])
    x, y = np.round(there - 0.5 * (reach.near_m + reach.far_m) * way, 3) + 0.0
    return (f"{what}give [{x:g}, {y:g}], or leave it out, or what is stated of the others: "
            f"{' and '.join(others)}")  # fmt: skip


def _begin_s(machine: SceneObject) -> float | None:
    """When its motions have it begin its act, s; None: they say no time."""
    works = (one.start_s for one in machine.motions if one.kind != "stand")
    return next((one for one in works if one is not None), None)


def _shifted(one: Actor, off: Float64Array) -> Actor:
    """A body at another place, m from where it was."""
    start = point(np.add(one.track.start, [*off, 0.0]))
    return replace(one, track=replace(one.track, start=start))


def _list_near(
    act: IndexedRelation, relations: Sequence[IndexedRelation], copies: Mapping[int, Sequence[int]]
) -> dict[str, int]:
    """Kind of relation of the machine or the thing to another body → the first of these."""
    about = {act.subject, *act.targets}
    near = [(one.kind, n) for one in relations if one.subject in about and one is not act
            for each in one.targets if each not in about for n in copies.get(each, ())]  # fmt: skip
    return {kind: n for kind, n in reversed(near)}
