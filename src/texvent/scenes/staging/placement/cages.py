"""Animals in a cage: on its floor or in its air, and never out of it."""

from __future__ import annotations

from texvent.scenes.staging.actors import is_centred
from texvent.scenes.staging.placement.object_groups import ObjectGroup
from texvent.scenes.staging.trajectories.phases import PATH_KINDS

CAGES = frozenset({"cage"})
"""Nouns that one looks into, closed all around."""
_FLOOR, _CEILING = 0.10, 0.80
"""Heights of the floor and of where the roof begins, as shares of a cage's height."""
_INSIDE = 0.7
"""Width of the inside of a cage, as a share of the outside."""
_AIR = 0.45
"""Height at which one flies, as a share of the cage's height."""


def keep_in_cage(group: ObjectGroup, cage: ObjectGroup) -> float:
    """Limit what an animal does to the room in a cage.

    Args:
        group: the animals; who goes somewhere goes round in it, who jumps does not reach the roof.
        cage: where they are.

    Returns:
        Height of their origin over the cage's foot, m.
    """
    box, body = cage.models[0], group.models[0]
    kind = group.plan.motion.kind
    inside = _INSIDE * min(box.length, box.width)
    floor = _FLOOR * box.height
    lift = 0.5 * body.height if is_centred(group.noun) else 0.0
    if kind in PATH_KINDS | {"hover", "orbit"}:
        group.pool_m = max(0.5 * (inside - body.length), 0.1 * inside)
        group.offsets = [(0.0, 0.0, 0.0) for _ in group.offsets]
    is_up = kind in ("fly", "hover")
    return _AIR * box.height + lift - 0.5 * body.height if is_up else floor + lift
