"""Shapes that glossy surfaces mirror: the large ones, and those that shine, each in one colour.

A mirrored image is soft, since paint and panes are never quite even: it needs neither texture nor
shadow. A shape is mirrored where it is near; beyond, only sky and ground are.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent_scenes.raycast.records import MIRRORED_RECORD
from texvent_scenes.rendered_scene import (
    FIRST_SURFACE,
    Environment,
    Float64Array,
    Primitives,
    Shape,
)

MOST = 14
"""Shapes of scenery that are mirrored at most, and as many of bodies."""
LEAST_M = 0.12
"""Half-thickness of the smallest shape that is mirrored, metres."""
REACH = 8.0
"""Distance at which a shape is no longer mirrored, as a multiple of its radius."""
_SHINING = 4.0
"""Shapes that shine count as larger by as much."""
_SUNLIT = 0.4
"""Share of the sun's light on a mirrored shape: it has no shade of its own."""


def list_mirrored(
    primitives: Primitives, inverse: Float64Array, environment: Environment
) -> NDArray[Any]:
    """[k] `MIRRORED_RECORD`, the same shapes at every instant.

    Args:
        primitives: all shapes.
        inverse: [n, 3, 4] world → unit shape.
        environment: the surroundings.
    """
    half = np.linalg.norm(primitives.to_world[:, :, :3], axis=1)
    thickness = np.round(
        np.sort(half, axis=1)[:, 1] * (1.0 + _SHINING * (primitives.emission > 0)), 2
    )
    numbers = []
    for is_body in (False, True):
        own = np.flatnonzero((thickness >= LEAST_M) & ((primitives.instance > 0) == is_body))
        numbers.append(np.sort(own[np.argsort(-thickness[own], kind="stable")[:MOST]]))
    chosen = np.concatenate(numbers)
    records = np.zeros(len(chosen), MIRRORED_RECORD)
    records["inverse"], records["middle"] = inverse[chosen], primitives.to_world[chosen, :, 3]
    records["instance"] = primitives.instance[chosen]
    shape = primitives.shape[chosen]
    records["is_round"] = np.isin(shape, (Shape.ELLIPSOID, Shape.CONE, Shape.MESH))
    largest = np.where(
        records["is_round"], half[chosen].max(axis=1), np.linalg.norm(half[chosen], axis=1)
    )
    records["radius"] = largest
    colour = primitives.colour[chosen].astype(np.float64)
    is_pattern = (primitives.texture[chosen] < FIRST_SURFACE) & (primitives.texture[chosen] > 0)
    second = np.where(is_pattern[:, None], primitives.second_colour[chosen], colour)
    lit = (
        environment.ambient
        + _SUNLIT * max(environment.sun_direction[2], 0.0) * environment.sun_colour
    )
    records["light"] = 0.5 * (colour + second) * lit + colour * primitives.emission[chosen, None]
    return records
