"""The stream from a vessel that a person pours from, while it is tipped."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.models.effects import LIQUID_COLOURS
from texvent.scenes.models.people.work.bench import in_body
from texvent.scenes.models.people.work.patterns import POURED_S
from texvent.scenes.scene import Colour
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.hand_work.working import WorkingAt
from texvent.scenes.staging.particles.jets import WATER, Jet, JetStyle
from texvent.scenes.staging.particles.motion import GRAVITY, Lives, Source

_HEIGHTS_M = {"pour": 0.22, "water": 0.40}
"""Pattern of hand work → from the vessel's lip to what is poured into, for an adult."""
_SIZE_M = 0.2
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


def make_streams(actors: Sequence[Actor], prompt: str, rng: np.random.Generator) -> list[Jet]:
    """A stream for each of those who pour.

    Args:
        actors: all of them.
        prompt: names what is poured.
        rng: for the drops.
    """
    said = [word.strip(".,;:!?") for word in prompt.casefold().split()]
    colour = next((LIQUID_COLOURS[word] for word in said if word in LIQUID_COLOURS), WATER)
    made = []
    for actor in actors:
        path = actor.trajectory
        if not isinstance(path, WorkingAt) or path.work.pattern not in _HEIGHTS_M:
            continue
        size, height_m = path.bench.size, _HEIGHTS_M[path.work.pattern]
        lift = in_body(path.bench, (0.0, 0.0, height_m))
        lip = np.add(path.bench.spot, lift)
        life_s = math.sqrt(2.0 * height_m * size / GRAVITY)
        style = replace(_STREAM, colours=(colour,))
        start_s, end_s = (time_s / path.tempo for time_s in POURED_S)
        lives = Lives.of(style.count, life_s, rng)
        made.append(Jet(Source(_SIZE_M * size, lip, actor), style, lives, start_s, end_s))
    return made
