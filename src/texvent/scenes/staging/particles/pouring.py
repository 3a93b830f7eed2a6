"""The stream from a vessel that a person pours from, while it is tipped."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

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
_COLOURS: dict[str, Colour] = {
    "milk": (0.9, 0.88, 0.82), "cream": (0.9, 0.86, 0.75), "coffee": (0.14, 0.06, 0.03),
    "tea": (0.35, 0.14, 0.04), "wine": (0.30, 0.01, 0.04), "juice": (0.9, 0.42, 0.05),
    "oil": (0.75, 0.55, 0.08), "honey": (0.75, 0.38, 0.04), "beer": (0.75, 0.42, 0.06),
    "sauce": (0.45, 0.06, 0.02), "chocolate": (0.18, 0.07, 0.03), "syrup": (0.4, 0.15, 0.03),
    "batter": (0.85, 0.72, 0.45), "whiskey": (0.55, 0.25, 0.05),
}  # fmt: skip
"""Word of the prompt → colour of what is poured; the first one counts."""
_STREAM = JetStyle(70, 1.0, 0.1, 0.03, 0.05, (WATER,), stretch=2.5, aim=(0.0, 0.0, -1.0), area=0.01)


def make_streams(actors: Sequence[Actor], prompt: str, rng: np.random.Generator) -> list[Jet]:
    """A stream for each of those who pour.

    Args:
        actors: all of them.
        prompt: names what is poured.
        rng: for the drops.
    """
    said = [word.strip(".,;:!?") for word in prompt.casefold().split()]
    colour = next((_COLOURS[word] for word in said if word in _COLOURS), WATER)
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
