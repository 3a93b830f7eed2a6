"""Street and site furniture: traffic cone, street lamp, traffic light, signs, barrier, flag."""

from __future__ import annotations

import math
from itertools import pairwise

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    CONCRETE,
    DARK,
    ORANGE,
    RED,
    STEEL,
    WHITE,
    YELLOW,
    Material,
    shade,
    striped,
)
from texvent.scenes.models.protocol import ModelPart, Pose, fixed_noun, working_noun
from texvent.scenes.models.shapes import ball, box, peak, plank, post, rod, spike
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour

_CYCLE_S = 4.0
"""A traffic light's whole cycle, s: short, so that clips of a few seconds show it change."""


def build_traffic_cone(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a traffic cone, 0.75 m; `colour` replaces its orange."""
    body = colour if colour is not None else ORANGE
    rigid = [
        box(Material(body), (0.0, 0.0, 0.02), (0.44, 0.44, 0.04)),
        peak(striped(body, WHITE, 1.25), (0.0, 0.0, 0.41), (0.36, 0.36, 0.74)),
    ]
    return ArticulatedModel(rigid, scale=scale)


def build_street_lamp(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a street lamp, 5 m; `colour` is its light."""
    light = colour if colour is not None else (1.0, 0.82, 0.52)
    rigid = [
        post(STEEL, (0.0, 0.0, 2.4), (0.16, 0.16, 4.8)),
        post(DARK, (0.0, 0.0, 0.3), (0.30, 0.30, 0.6)),
        rod(STEEL, (0.0, 0.0, 4.7), (0.9, 0.0, 5.0), 0.06),
        box(DARK, (1.1, 0.0, 5.02), (0.70, 0.34, 0.12)),
        ball(Material(light, emission=4.0), (1.1, 0.0, 4.94), (0.60, 0.28, 0.16)),
    ]
    return ArticulatedModel(rigid, scale=scale)


def build_traffic_light(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a traffic light, 3.4 m, facing +x, that turns green, amber, red; `colour` is its box."""
    case = Material(colour if colour is not None else (0.025, 0.03, 0.028))
    rigid = [
        post(STEEL, (0.0, 0.0, 1.3), (0.14, 0.14, 2.6)),
        box(case, (0.0, 0.0, 2.85), (0.26, 0.42, 1.15)),
        box(Material((0.5, 0.5, 0.48)), (-0.12, 0.0, 2.85), (0.03, 0.60, 1.32)),
    ]
    start = fraction(seed, "cycle")

    def articulate(pose: Pose) -> list[ModelPart]:
        phase = (pose.time_s / _CYCLE_S + start) % 1.0
        lights = (
            (3.20, (0.90, 0.02, 0.01), _lit(phase, 0.50, 1.0)),
            (2.85, (0.90, 0.42, 0.01), _lit(phase, 0.38, 0.50)),
            (2.50, (0.02, 0.80, 0.20), _lit(phase, 0.0, 0.38)),
        )
        parts = []
        for z, hue, level in lights:
            lamp = Material(shade(hue, 0.12 + 0.88 * level), emission=4.0 * level)
            parts.append(ball(lamp, (0.13, 0.0, z), (0.12, 0.28, 0.28)))
            parts.append(box(case, (0.21, 0.0, z + 0.16), (0.20, 0.30, 0.03)))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def _lit(phase: float, start: float, stop: float) -> float:
    """1 inside [start, stop) of a cycle with ramps of 1 % (40 ms, a filament's glow)."""
    ramp = 0.01
    inside = min(phase - start, stop - phase)
    if start == 0.0 and phase > 1.0 - ramp:
        inside = phase - 1.0
    return min(1.0, max(0.0, 0.5 + inside / ramp))


def build_barrier(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a striped road barrier, 2 m wide, with a blinking lamp; `colour` is its stripes."""
    stripes = striped(colour if colour is not None else RED, WHITE, 3.0)
    tall, thick = (0.0, 0.0, 0.22), (0.05, 0.0, 0.0)
    rigid = [
        plank(stripes, (0.0, -1.0, z), (0.0, 1.0, z), chord=tall, thickness=thick)
        for z in (0.9, 0.5)
    ]
    for y in (0.75, -0.75):
        rigid += [rod(DARK, (x, y, 0.03), (0.0, y, 1.05), 0.03) for x in (0.3, -0.3)]
    start = fraction(seed, "blink")

    def articulate(pose: Pose) -> list[ModelPart]:
        level = 0.5 + 0.5 * math.sin(2.0 * math.pi * (1.0 * pose.time_s + start))
        lamp = Material((0.9, 0.45, 0.02), emission=4.0 * level)
        return [ball(lamp, (0.0, 0.75, 1.17), (0.10, 0.20, 0.20))]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def build_fence(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a picket fence along y, 4 m; `colour` is its paint."""
    material = Material(colour if colour is not None else WHITE)
    parts = [box(material, (0.0, 0.0, z), (0.05, 4.0, 0.09)) for z in (0.30, 0.75)]
    for index in range(14):
        y = -1.95 + 0.30 * index
        parts.append(box(material, (0.03, y, 0.47), (0.03, 0.12, 0.94)))
        parts.append(spike(material, (0.03, y, 0.94), (0.03, y, 1.06), 0.06))
    return ArticulatedModel(parts, scale=scale)


def build_flag(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a flag that waves along -x from a pole of 4 m; `colour` is its cloth."""
    hue = paint(colour, seed, "cloth", (RED, (0.04, 0.14, 0.45)))
    cloth, band = Material(hue), Material(WHITE)
    rigid = [
        post(STEEL, (0.0, 0.0, 2.0), (0.07, 0.07, 4.0)),
        ball(Material(YELLOW), (0.0, 0.0, 4.03), (0.14, 0.14, 0.14)),
    ]
    start = 2.0 * math.pi * fraction(seed, "wave")
    pieces, long = 8, 1.6

    def articulate(pose: Pose) -> list[ModelPart]:
        parts: list[ModelPart] = []
        ends = []
        for index in range(pieces + 1):
            share = index / pieces
            wave = 0.34 * share**0.7 * math.sin(5.0 * pose.time_s + start - 6.0 * share)
            lift = 0.10 * share * math.sin(5.0 * pose.time_s + start + 1.0 - 4.0 * share)
            ends.append((-long * share, wave, 3.35 - 0.10 * share + lift))
        for a, b in pairwise(ends):
            for material, tall, thin in ((cloth, 1.0, 0.03), (band, 0.30, 0.04)):
                across, thick = (0.0, 0.0, tall), (0.0, thin, 0.0)
                parts.append(plank(material, a, b, chord=across, thickness=thick))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def build_bridge(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a bridge along x with pillars and arches of cable, 40 m; `colour` is its steel."""
    steel = Material(colour if colour is not None else (0.42, 0.07, 0.04))
    parts = [box(CONCRETE, (0.0, 0.0, 5.0), (40.0, 7.0, 0.8))]
    for x in (10.0, -10.0):
        for y in (3.4, -3.4):
            parts.append(box(steel, (x, y, 8.0), (1.0, 0.8, 16.0)))
            for reach in (4.5, 9.5):
                for side in (1.0, -1.0):
                    parts.append(rod(steel, (x, y, 15.6), (x + side * reach, y, 5.2), 0.12))
        parts.append(box(steel, (x, 0.0, 14.5), (0.8, 7.0, 0.9)))
    parts += [box(steel, (0.0, y, 5.9), (40.0, 0.14, 0.14)) for y in (3.4, -3.4)]
    return ArticulatedModel(parts, scale=scale)


NOUNS = (
    fixed_noun("traffic cone", build_traffic_cone, ("road cone", "safety cone", "traffic pylon")),
    fixed_noun(
        "street lamp", build_street_lamp,
        ("streetlight", "street light", "lamp post", "lamppost", "streetlamp"),
    ),
    fixed_noun("barrier", build_barrier, ("road block", "roadblock", "barricade")),
    fixed_noun("fence", build_fence, ("picket fence",)),
    working_noun("flag", build_flag, ("flagpole",)),
    fixed_noun("bridge", build_bridge, ("overpass",)),
    working_noun("traffic light", build_traffic_light, ("stoplight", "stop light")),
)  # fmt: skip
