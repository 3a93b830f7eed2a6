"""Garments as they hang alone: their outline as a tailor cuts it, a few centimetres thick."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from texvent.scenes.models.materials import Material, shade
from texvent.scenes.models.objects.figures import FlatPoint
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, limb, post, rod

_DEEP = 0.13
_BUTTON = Material((0.75, 0.72, 0.62))


def _panel(
    skin: Material, outline: Sequence[FlatPoint], y: float = 0.0, steps: int = 9
) -> list[ModelPart]:
    """Elliptic slices whose half width follows (z, half width) points, bottom first, m."""
    heights, widths = [z for z, _ in outline], [wide for _, wide in outline]
    edges = np.linspace(heights[0], heights[-1], steps + 1)
    middles = 0.5 * (edges[:-1] + edges[1:])
    tall = 1.02 * float(edges[1] - edges[0])
    return [
        post(skin, (0.0, y, float(z)), (min(_DEEP, float(wide) * 1.6), 2.0 * float(wide), tall))
        for z, wide in zip(middles, np.interp(middles, heights, widths), strict=True)
    ]


def _sleeves(skin: Material, shoulder: float, long: float, wide: float = 0.055) -> list[ModelPart]:
    parts: list[ModelPart] = []
    for side in (1.0, -1.0):
        start, end = (0.0, 0.17 * side, shoulder), (0.0, (0.20 + 0.24 * long) * side,
                                                     shoulder - long)  # fmt: skip
        parts += [
            rod(skin, start, end, 0.05, side_radius=wide),
            ball(skin, start, (0.10, 0.14, 0.14)),
            rod(_dark(skin), end, (end[0], end[1] + 0.006 * side, end[2] - 0.03), 0.05,
                side_radius=wide),
        ]  # fmt: skip
    return parts


def _dark(skin: Material) -> Material:
    return Material(shade(skin.colour, 0.55))


def draw_top(skin: Material, long: float, *, is_open: bool, has_hood: bool) -> list[ModelPart]:
    """A sweater, or with a front that opens a jacket or a coat; `long` in m from hem to neck."""
    hem = 0.24 if long > 0.9 else 0.21
    parts = [
        *_panel(skin, [(0.0, hem), (0.45 * long, 0.20), (long - 0.1, 0.23), (long, 0.09)]),
        *_sleeves(skin, long - 0.12, 0.52),
    ]
    front = 0.5 * _DEEP + 0.004
    if is_open:
        parts += [
            box(_dark(skin), (front, 0.0, 0.45 * long), (0.012, 0.018, 0.88 * long)),
            *(ball(_BUTTON, (front + 0.008, 0.03, z * long), (0.02, 0.03, 0.03))
              for z in (0.2, 0.4, 0.6)),
            *(limb(_dark(skin), (front, 0.02 * s, 0.72 * long), (0.05, 0.10 * s, long), 0.02,
                   side_radius=0.035) for s in (1.0, -1.0)),
        ]  # fmt: skip
    else:
        parts.append(rod(_dark(skin), (0.0, 0.0, 0.0), (0.0, 0.0, 0.05), 0.068, side_radius=hem))
    if has_hood:
        parts += [ball(skin, (-0.03, 0.0, long + 0.06), (0.20, 0.28, 0.26)),
                  ball(_dark(skin), (0.05, 0.0, long + 0.05), (0.08, 0.18, 0.18)),
                  *(limb(_BUTTON, (front, 0.03 * s, long - 0.04), (front + 0.01, 0.04 * s,
                    long - 0.20), 0.006) for s in (1.0, -1.0))]  # fmt: skip
    return parts


def draw_trousers(skin: Material, legs: float) -> list[ModelPart]:
    """Two legs, a seat and a waistband; `legs` in m."""
    parts = [
        part for y in (0.105, -0.105)
        for part in _panel(skin, [(0.0, 0.075), (legs, 0.10)], y, 6)
    ]  # fmt: skip
    return [
        *parts, *_panel(skin, [(legs - 0.02, 0.205), (legs + 0.22, 0.18)], 0.0, 4),
        rod(_dark(skin), (0.0, 0.0, legs + 0.21), (0.0, 0.0, legs + 0.25), 0.070,
            side_radius=0.185),
        box(_dark(skin), (0.068, 0.0, legs + 0.10), (0.006, 0.012, 0.20)),
        ball(_BUTTON, (0.075, 0.0, legs + 0.23), (0.012, 0.025, 0.025)),
    ]  # fmt: skip


def draw_suit(skin: Material, legs: float) -> list[ModelPart]:
    """Trousers and a top in one."""
    top = legs + 0.75
    return [
        *draw_trousers(skin, legs),
        *_panel(skin, [(legs + 0.1, 0.18), (top - 0.12, 0.23), (top, 0.08)]),
        *_sleeves(skin, top - 0.14, 0.52),
        box(_dark(skin), (0.068, 0.0, legs + 0.42), (0.008, 0.014, 0.5)),
    ]


def draw_skirt(skin: Material) -> list[ModelPart]:
    """A skirt that flares from its waistband."""
    return [
        *_panel(skin, [(0.0, 0.34), (0.42, 0.20), (0.55, 0.165)]),
        rod(_dark(skin), (0.0, 0.0, 0.53), (0.0, 0.0, 0.58), 0.070, side_radius=0.165),
        *(limb(_dark(skin), (0.06, 0.30 * s, 0.02), (0.066, 0.13 * s, 0.5), 0.006)
          for s in (1.0, 0.35, -0.35, -1.0)),
    ]  # fmt: skip


def draw_dress(skin: Material) -> list[ModelPart]:
    """A sleeveless dress: straps, a waist, a wide hem."""
    return [
        *_panel(skin, [(0.0, 0.36), (0.55, 0.18), (0.68, 0.13), (0.90, 0.17), (0.96, 0.15)], 0.0,
                14),
        *(limb(skin, (0.0, 0.11 * s, 0.93), (0.0, 0.09 * s, 1.12), 0.022) for s in (1.0, -1.0)),
        rod(_dark(skin), (0.0, 0.0, 0.66), (0.0, 0.0, 0.70), 0.070, side_radius=0.135),
    ]  # fmt: skip


def draw_robe(skin: Material) -> list[ModelPart]:
    """A long robe: wide sleeves, a sash, a front that crosses over."""
    return [
        *_panel(skin, [(0.0, 0.33), (0.85, 0.21), (1.25, 0.24), (1.36, 0.09)], 0.0, 12),
        *_sleeves(skin, 1.22, 0.46, 0.10),
        rod(_dark(skin), (0.0, 0.0, 0.82), (0.0, 0.0, 0.90), 0.072, side_radius=0.222),
        *(limb(_dark(skin), (0.068, 0.0, 0.90), (0.05, 0.11 * s, 1.36), 0.02) for s in (1.0, -1.0)),
        limb(_dark(skin), (0.075, 0.05, 0.84), (0.08, 0.07, 0.50), 0.02),
    ]  # fmt: skip


def draw_cape(skin: Material) -> list[ModelPart]:
    """A cape that falls in folds from a collar with a clasp."""
    folds = [
        limb(skin, (0.0, 0.11 * k, 0.0), (0.0, 0.045 * k, 1.1), 0.05, side_radius=0.075)
        for k in range(-3, 4)
    ]
    return [
        *folds, ball(skin, (0.0, 0.0, 1.10), (0.16, 0.40, 0.12)),
        rod(_dark(skin), (0.0, 0.0, 1.10), (0.0, 0.0, 1.18), 0.07, side_radius=0.12),
        ball(Material((0.62, 0.40, 0.05)), (0.085, 0.0, 1.12), (0.03, 0.06, 0.06)),
    ]  # fmt: skip
