"""Birds told by their colours, a peacock with its fan, and young birds."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial

from texvent.scenes.models.animals.flying_birds import BIRD_ACTS, SMALL, Plumage, build_flier
from texvent.scenes.models.animals.walking_birds import CHICKEN, FLAMINGO, Strider, build_strider
from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import Material
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import ball, blade, limb
from texvent.scenes.scene import Colour

_BLUE: Colour = (0.02, 0.10, 0.50)
_BLACK: Colour = (0.015, 0.015, 0.018)
_PEACOCK = replace(
    CHICKEN, hip=0.34, body=(0.60, 0.30, 0.32), neck=0.42, neck_radius=0.05, head=0.09,
    plumage=_BLUE, wing=(0.10, 0.22, 0.20), skin=_BLUE, comb=False,
)  # fmt: skip
_CHICK = replace(
    CHICKEN, hip=0.05, body=(0.11, 0.09, 0.09), neck=0.02, neck_radius=0.025, head=0.055,
    beak=0.018, gait=replace(CHICKEN.gait, stride=0.10, lift=0.015), plumage=(0.80, 0.58, 0.08),
    wing=(0.75, 0.52, 0.06), skin=(0.80, 0.58, 0.08), comb=False,
)  # fmt: skip
_HERON = replace(FLAMINGO, plumage=(0.40, 0.43, 0.46), wing=(0.24, 0.27, 0.31),
                 skin=(0.72, 0.72, 0.70), legs=(0.20, 0.18, 0.10), beak=0.2,
                 beak_colour=(0.65, 0.45, 0.05))  # fmt: skip
_STORK = replace(FLAMINGO, plumage=(0.80, 0.79, 0.76), wing=_BLACK, skin=(0.80, 0.79, 0.76),
                 legs=(0.60, 0.08, 0.03), beak=0.24, beak_colour=(0.62, 0.08, 0.03))  # fmt: skip


def build_peacock(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a peacock with its fan spread; `colour` is its body."""
    bird = build_strider(_PEACOCK, colour=colour, scale=1.0, seed=seed)
    green, eye = Material((0.03, 0.30, 0.12)), Material((0.02, 0.12, 0.50))
    gold = Material((0.60, 0.42, 0.06))
    fan: list[ModelPart] = []
    for k in range(13):
        a = -1.35 + 0.225 * k
        base = (-0.22, 0.05 * math.sin(a), 0.38)
        y, z = 1.05 * math.sin(a), 0.38 + 1.05 * math.cos(a)
        fan.append(blade(green, base, (-0.36, y, z), chord=(0.0, 0.20 * math.cos(a),
            -0.20 * math.sin(a)),
                         thickness=(0.02, 0.0, 0.0)))  # fmt: skip
        spot = (-0.31, 0.90 * math.sin(a), 0.38 + 0.90 * math.cos(a))
        fan.append(ball(gold, spot, (0.05, 0.14, 0.14)))
        fan.append(ball(eye, (spot[0] + 0.02, spot[1], spot[2]), (0.05, 0.08, 0.08)))
    rigid = [limb(Material(_BLUE), (0.36, 0.0, 0.86), (0.36, 0.0, 0.96), 0.015), *fan]

    def articulate(pose: Pose) -> list[ModelPart]:
        return list(bird.parts(pose))

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def _bird(body: Colour, wing: Colour, head: Colour, beak: Colour, length: float = 0.32) -> Plumage:
    return replace(SMALL, length=length, bodies=(body,), wing=wing, head=head, beak=beak)


_FLIERS: tuple[tuple[str, Plumage, float, tuple[str, ...]], ...] = (
    ("kingfisher", _bird((0.75, 0.26, 0.03), (0.02, 0.30, 0.62), (0.02, 0.26, 0.58), _BLACK),
        7.0, ()),
    ("robin", _bird((0.65, 0.18, 0.03), (0.16, 0.11, 0.07), (0.20, 0.13, 0.08), _BLACK), 5.0,
        ("redbreast",)),
    ("crow", _bird(_BLACK, _BLACK, _BLACK, _BLACK, 0.5), 6.0, ("raven",)),
    ("pigeon", _bird((0.30, 0.32, 0.36), (0.40, 0.42, 0.46), (0.15, 0.17, 0.22), (0.2, 0.2, 0.2),
        0.36), 6.0, ()),
    ("dove", _bird((0.82, 0.82, 0.80), (0.82, 0.82, 0.80), (0.82, 0.82, 0.80), (0.55, 0.3, 0.2),
        0.36), 5.0, ("white dove",)),
    ("cardinal", _bird((0.60, 0.02, 0.02), (0.45, 0.03, 0.03), (0.60, 0.02, 0.02), (0.75, 0.35,
        0.03)), 5.0, ("red cardinal",)),
    ("canary", _bird((0.80, 0.62, 0.04), (0.70, 0.52, 0.03), (0.80, 0.62, 0.04), (0.7, 0.4, 0.1),
        0.25), 5.0, ()),
    ("hummingbird", replace(_bird((0.03, 0.36, 0.16), (0.10, 0.22, 0.18), (0.55, 0.03, 0.12),
        _BLACK, 0.12),
                            flap_hz=24.0, span=1.5), 3.0, ("colibri",)),
    ("bluebird", _bird((0.06, 0.22, 0.62), (0.04, 0.14, 0.46), (0.06, 0.22, 0.62), _BLACK, 0.28),
        5.0, ()),
)  # fmt: skip
_STRIDERS: tuple[tuple[str, Strider, float, tuple[str, ...]], ...] = (
    ("chick", _CHICK, 0.25, ("baby chicken",)),
    ("heron", _HERON, 0.5, ()),
    ("stork", _STORK, 0.5, ()),
)
NOUNS = (
    *(Noun(name, partial(build_flier, plumage), "air", speed, "fly", same, acts=BIRD_ACTS)
      for name, plumage, speed, same in _FLIERS),
    *(Noun(name, partial(build_strider, kind), "ground", speed, "walk", same)
      for name, kind, speed, same in _STRIDERS),
    Noun("peacock", build_peacock, "ground", 0.4, "walk", ("peafowl",)),
)  # fmt: skip
