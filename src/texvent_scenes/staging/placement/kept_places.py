"""Stated places and headings that placed or acting bodies do not have: a file is refused then."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np

from texvent.errors import ConfigError
from texvent_scenes.description import SceneDescription, label_of
from texvent_scenes.spec.data import HANDLED
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.interactions.perform import ACTS
from texvent_scenes.staging.placement.apart import list_beside
from texvent_scenes.staging.placement.object_groups import ObjectGroup

_PLACED_M, _AT_HAND_M, _TURNED_DEG = 0.02, 0.1, 1.0
"""Most way from a stated place; most height of a thing over it at which a hand has it; most turn
from a stated heading."""
_SEATED = 0.3
"""Most distance of a rider's place from that of what is ridden, in its sizes."""


def refuse_beside(description: SceneDescription, groups: Mapping[int, ObjectGroup]) -> None:
    """Refuse a position beside what bears the thing.

    Raises:
        ConfigError: there is one.
    """
    for n, why in list_beside(description, groups):
        raise ConfigError(f"{_said_place(description, n)}, {why}; give another one")


def refuse_moved(
    description: SceneDescription, placed: Sequence[Actor], acting: Sequence[Actor]
) -> None:
    """Refuse a position or a heading that an act does not leave to its bodies.

    Args:
        description: the scene.
        placed: bodies before their acts.
        acting: bodies in these.

    Raises:
        ConfigError: there is one.
    """
    before, after = ({one.object_index: one for one in reversed(actors)}
                     for actors in (placed, acting))  # fmt: skip
    _refuse_ridden(description, after)
    acts = [one for one in description.relations if one.kind in ACTS]
    partners = {n: other for one in acts for n, other in (
        (one.targets[0], one.subject), (one.subject, one.targets[0]))}  # fmt: skip
    kinds = {n: one.kind for one in acts for n in (one.targets[0], one.subject)}
    lifted = {one.targets[0] for one in acts if one.kind in HANDLED and one.kind == "lift"}
    riders = {one.subject for one in acts if one.kind == "ride"}
    for n, one in after.items():
        said, home = description.objects[n], one.track.at(0.0)
        is_carried = one.track.anchor is not None and n not in partners
        if n not in before or n in riders or is_carried:
            continue
        first = before[n].track.at(0.0)
        off = np.subtract(home.position, first.position)
        if said.position_m is not None and float(np.linalg.norm(off[:2])) > _PLACED_M:
            needed = _tell_needed(description, kinds.get(n), partners.get(n), home.position[:2])
            raise ConfigError(f"{_said_place(description, n)}, but {needed}")
        if said.position_m is not None and n in lifted and abs(off[2]) > _AT_HAND_M:
            way = "higher" if off[2] > 0.0 else "lower"
            raise ConfigError(
                f"{_said_place(description, n)}, but its act (lift) has it {abs(off[2]):.2f} m "
                f"{way} at first; leave position_m out, or what it is on"
            )
        if said.height_m is not None and n in partners and abs(off[2]) > _PLACED_M:
            raise ConfigError(
                f"objects[{n}].height_m is {said.height_m:g}, but its act ({kinds[n]}) has it "
                f"{abs(off[2]):.2f} m {'higher' if off[2] > 0.0 else 'lower'}; leave height_m out"
            )
        turn = math.degrees(math.remainder(home.yaw - first.yaw, math.tau))
        if said.heading_deg is not None and n in partners and abs(turn) > _TURNED_DEG:
            raise ConfigError(
                f"objects[{n}].heading_deg is {said.heading_deg:g}, but its act ({kinds[n]}) turns "
                f"it to {math.degrees(home.yaw) % 360.0:.4g}; give that, or leave heading_deg out"
            )


def _said_place(description: SceneDescription, n: int) -> str:
    x, y = description.objects[n].position_m or (0.0, 0.0)
    return f"objects[{n}].position_m is [{x:g}, {y:g}]"


def _tell_needed(
    description: SceneDescription, kind: str | None, partner: int | None, place: Sequence[float]
) -> str:  # fmt: skip
    """The position that an act needs, and what to do."""
    x, y = (round(float(value), 3) + 0.0 for value in place)
    act = "an act of another" if kind is None else f"its act ({kind})"
    needed = f"{act} needs it at [{x:g}, {y:g}]"
    if partner is None or description.objects[partner].position_m is None:
        return f"{needed}; leave position_m out, or what it is on"
    return f"{needed}; give that, or leave out one of both, it or objects[{partner}].position_m"


def _refuse_ridden(description: SceneDescription, bodies: Mapping[int, Actor]) -> None:
    """Refuse a place of a rider that is not that of what is ridden."""
    for n, ridden in _list_rides(description):
        here, there = (description.objects[each].position_m for each in (n, ridden))
        if here is None or there is None or ridden not in bodies:
            continue
        body = bodies[ridden].model
        if math.dist(here, there) > _SEATED * max(body.length, body.width):
            raise ConfigError(
                f"{_said_place(description, n)}, but it rides the {label_of(description, ridden)}, "
                f"which is at [{there[0]:g}, {there[1]:g}]; leave one of them out"
            )


def _list_rides(description: SceneDescription) -> Iterator[tuple[int, int]]:
    return ((one.subject, one.targets[0]) for one in description.relations if one.kind == "ride")
