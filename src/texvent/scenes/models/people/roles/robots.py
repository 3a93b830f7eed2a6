"""Robots with a person's shape: they do what people do."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.models.people.outfit import ADULT
from texvent.scenes.models.people.roles.rows import role
from texvent.scenes.models.protocol import Noun

ROBOTS: tuple[Noun, ...] = (
    replace(
        role(
            "robot",
            replace(
                ADULT,
                shells=((0.80, 0.80, 0.78), (0.55, 0.56, 0.58)),
                hat="robot",
                garments=(("robot joints", None),),
                bulk=0.9,
            ),
            "humanoid robot",
            "android",
            "humanoid",
        ),
        speed_m_s=0.8,
        place="indoor",
    ),
)
