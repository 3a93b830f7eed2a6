"""Street and site furniture: traffic cone, street lamp, traffic light, signs, barrier, flag."""

from __future__ import annotations

from texvent.generate.procedural.model import Colour, Noun, Part, Pose
from texvent.generate.procedural.models.figure import Figure
from texvent.generate.procedural.models.paint import (
    DARK,
    ORANGE,
    STEEL,
    WHITE,
    Paint,
    shade,
)
from texvent.generate.procedural.models.shaping import (
    ball,
    box,
    peak,
    post,
    rod,
)
from texvent.generate.procedural.models.variation import fraction

_CYCLE_S = 4.0
"""A traffic light's whole cycle, s: short, so that clips of a few seconds show it change."""


def build_traffic_cone(*, colour: Colour | None, scale: float, seed: int) -> Figure:
    """Make a traffic cone, 0.75 m; `colour` replaces its orange."""
    body = colour if colour is not None else ORANGE
    orange = Paint(body)
    band = Paint(WHITE)
    rigid = [
        box(orange, (0.0, 0.0, 0.02), (0.44, 0.44, 0.04)),
        peak(orange, (0.0, 0.0, 0.41), (0.34, 0.34, 0.74)),
        _ring(band, 0.22, 0.36),
        _ring(band, 0.46, 0.56),
    ]
    return Figure(rigid, scale=scale)


def _ring(paint: Paint, low: float, high: float) -> Part:
    """A band around the traffic cone, as a slightly larger cylinder of the mean radius."""
    radius = 0.17 * (0.78 - 0.5 * (low + high)) / 0.74 + 0.012
    return post(paint, (0.0, 0.0, 0.5 * (low + high)), (2.0 * radius, 2.0 * radius, high - low))


def build_street_lamp(*, colour: Colour | None, scale: float, seed: int) -> Figure:
    """Make a street lamp, 5 m; `colour` is its light."""
    light = colour if colour is not None else (1.0, 0.82, 0.52)
    rigid = [
        post(STEEL, (0.0, 0.0, 2.4), (0.16, 0.16, 4.8)),
        post(DARK, (0.0, 0.0, 0.3), (0.30, 0.30, 0.6)),
        rod(STEEL, (0.0, 0.0, 4.7), (0.9, 0.0, 5.0), 0.06),
        box(DARK, (1.1, 0.0, 5.02), (0.70, 0.34, 0.12)),
        ball(Paint(light, emission=4.0), (1.1, 0.0, 4.94), (0.60, 0.28, 0.16)),
    ]
    return Figure(rigid, scale=scale)


def build_traffic_light(*, colour: Colour | None, scale: float, seed: int) -> Figure:
    """Make a traffic light, 3.4 m, facing +x, that turns green, amber, red; `colour` is its box."""
    case = Paint(colour if colour is not None else (0.025, 0.03, 0.028))
    rigid = [
        post(STEEL, (0.0, 0.0, 1.3), (0.14, 0.14, 2.6)),
        box(case, (0.0, 0.0, 2.85), (0.26, 0.42, 1.15)),
        box(Paint((0.5, 0.5, 0.48)), (-0.12, 0.0, 2.85), (0.03, 0.60, 1.32)),
    ]
    start = fraction(seed, "cycle")

    def articulate(pose: Pose) -> list[Part]:
        phase = (pose.time_s / _CYCLE_S + start) % 1.0
        lights = (
            (3.20, (0.90, 0.02, 0.01), _lit(phase, 0.50, 1.0)),
            (2.85, (0.90, 0.42, 0.01), _lit(phase, 0.38, 0.50)),
            (2.50, (0.02, 0.80, 0.20), _lit(phase, 0.0, 0.38)),
        )
        parts = []
        for z, hue, level in lights:
            lamp = Paint(shade(hue, 0.12 + 0.88 * level), emission=4.0 * level)
            parts.append(ball(lamp, (0.13, 0.0, z), (0.12, 0.28, 0.28)))
            parts.append(box(case, (0.21, 0.0, z + 0.16), (0.20, 0.30, 0.03)))
        return parts

    return Figure(rigid, scale=scale, articulate=articulate)


def _lit(phase: float, start: float, stop: float) -> float:
    """1 inside [start, stop) of a cycle with ramps of 1 % (40 ms, a filament's glow)."""
    ramp = 0.01
    inside = min(phase - start, stop - phase)
    if start == 0.0 and phase > 1.0 - ramp:
        inside = phase - 1.0
    return min(1.0, max(0.0, 0.5 + inside / ramp))


NOUNS = (
    Noun(
        "traffic cone", build_traffic_cone, "fixed", 0.0, "stand",
        ("road cone", "safety cone", "pylon"),
    ),
    Noun(
        "street lamp", build_street_lamp, "fixed", 0.0, "stand",
        ("streetlight", "street light", "lamp post", "lamppost", "streetlamp"),
    ),
    Noun("traffic light", build_traffic_light, "fixed", 0.0, "stand", ("stoplight", "stop light")),
)  # fmt: skip
