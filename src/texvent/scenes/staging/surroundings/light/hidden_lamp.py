"""The lamp out of sight that lights dark scenes where no other lamp does."""

from __future__ import annotations

import numpy as np

from texvent.scenes.description import Illumination
from texvent.scenes.scene import LAMP_COLUMNS, Float64Array
from texvent.scenes.staging.camera.framing import Framing
from texvent.scenes.staging.surroundings.light.said_light import tint_of, towards_light

_WARM = (1.0, 0.72, 0.40)
_OFFSET = np.array([-0.25, -0.25, 0.55])
"""From what the camera looks at, in distances of the camera."""


def hidden_lamp(
    framing: Framing, strength: float, light: Illumination, looking: Float64Array
) -> Float64Array:
    """[15] light from a lamp out of sight, bright enough for the ground below it.

    Args:
        framing: what the camera looks at.
        strength: of artificial light, 0..1.
        light: what the prompt says of it; warm where it says no colour.
        looking: [3] unit vector that the camera looks along.
    """
    reach, row = framing.distance_m, np.zeros(LAMP_COLUMNS)
    offset = _OFFSET
    if light.direction is not None or light.is_low:
        far = float(np.linalg.norm(_OFFSET))
        offset = far * towards_light(_OFFSET / far, looking, light)
    row[:3] = np.asarray(framing.target) + reach * offset
    height = max(float(row[2]), 0.7)
    row[3:6] = 1.1 * strength * height**2 * np.array(tint_of(light) or _WARM)
    row[6], row[10], row[11], row[12] = 5.0 * height, -2.0, -2.0, 0.3
    return row
