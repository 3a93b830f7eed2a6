"""The stream from a vessel that a person pours from, while it is tipped."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from texvent.scenes.scene import Colour
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.particles.jets import WATER, Jet, JetStyle
from texvent.scenes.staging.particles.motion import GRAVITY, Lives, Source

_STREAM = JetStyle(70, 1.0, 0.1, 0.03, 0.05, (WATER,), stretch=2.5, aim=(0.0, 0.0, -1.0), area=0.01)


def pour_into(vessel: Actor, colour: Colour | None, rng: np.random.Generator) -> Jet:
    """A stream from above into a vessel."""
    tall = vessel.model.height
    low = -0.5 * tall if vessel.is_centred else 0.0
    size = 0.35 * max(tall, vessel.model.width)
    life_s = math.sqrt(2.0 * (_ABOVE - 0.1) * tall / GRAVITY)
    style = replace(_STREAM, count=110, colours=(colour or WATER,))
    source = Source(size, np.array([0.0, 0.0, low + _ABOVE * tall]), vessel)
    return Jet(source, style, Lives.of(style.count, life_s, rng))


_ABOVE = 2.0
"""Height from which something pours into a vessel, as a multiple of the vessel's."""
