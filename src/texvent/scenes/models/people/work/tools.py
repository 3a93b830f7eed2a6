"""Tools that the right hand works with, drawn along what the hand points to."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from texvent.scenes.models.materials import BLUE, CHROME, DARK, STEEL, WHITE, WOOD, YELLOW, Material
from texvent.scenes.models.protocol import ModelPart
from texvent.scenes.models.shapes import ball, box, post, rod, spike


@dataclass(frozen=True)
class Tool:
    """A tool in the axes of the hand, z towards its tip."""

    parts: tuple[ModelPart, ...]
    reach_m: float
    """From the palm to its tip, m."""


def _handle(low: float, high: float, radius: float = 0.014) -> ModelPart:
    return rod(WOOD, (0.0, 0.0, low), (0.0, 0.0, high), radius)


_BROWN = Material((0.6, 0.35, 0.1))
_SKY = Material((0.15, 0.4, 0.75))
# fmt: off
TOOLS: Mapping[str, Tool] = MappingProxyType(
    {
        "knife": Tool(
            (
                rod(DARK, (0.0, 0.0, -0.05), (0.0, 0.0, 0.08), 0.016),
                box(CHROME, (0.0, 0.0, 0.19), (0.050, 0.010, 0.22)),
            ),
            0.26,
        ),
        "scissors": Tool(
            (
                box(STEEL, (0.0, 0.012, 0.14), (0.03, 0.01, 0.20)),
                box(STEEL, (0.0, -0.012, 0.14), (0.03, 0.01, 0.20)),
                ball(Material(BLUE), (0.0, 0.0, 0.02), (0.05, 0.08, 0.06)),
            ),
            0.22,
        ),
        "saw": Tool(
            (
                box(WOOD, (0.0, 0.0, 0.0), (0.10, 0.04, 0.12)),
                box(STEEL, (0.0, 0.0, 0.30), (0.10, 0.012, 0.50)),
            ),
            0.34,
        ),
        "hammer": Tool(
            (_handle(-0.06, 0.24, 0.016), box(STEEL, (0.03, 0.0, 0.25), (0.17, 0.06, 0.06))), 0.27
        ),
        "axe": Tool(
            (_handle(-0.12, 0.60, 0.018), box(STEEL, (0.07, 0.0, 0.58), (0.19, 0.04, 0.14))), 0.62
        ),
        "stick": Tool((_handle(-0.10, 0.66, 0.020),), 0.66),
        "cloth": Tool(
            (box(Material((0.75, 0.75, 0.8)), (0.0, 0.0, 0.04), (0.16, 0.14, 0.05)),), 0.05
        ),
        "sponge": Tool((box(Material(YELLOW), (0.0, 0.0, 0.05), (0.14, 0.11, 0.07)),), 0.07),
        "block": Tool((box(WOOD, (0.0, 0.0, 0.04), (0.12, 0.08, 0.06)),), 0.06),
        "iron": Tool(
            (
                box(_SKY, (0.0, 0.0, 0.08), (0.26, 0.13, 0.08)),
                rod(DARK, (-0.08, 0.0, 0.0), (0.08, 0.0, 0.0), 0.02),
            ),
            0.11,
        ),
        "rolling pin": Tool((rod(WOOD, (0.0, -0.26, 0.05), (0.0, 0.14, 0.05), 0.04),), 0.08),
        "brush": Tool(
            (_handle(-0.08, 0.10, 0.02), box(DARK, (0.03, 0.0, 0.12), (0.07, 0.08, 0.16))), 0.18
        ),
        "paintbrush": Tool(
            (_handle(-0.06, 0.18), box(Material(BLUE), (0.0, 0.0, 0.24), (0.04, 0.12, 0.12))), 0.29
        ),
        "trowel": Tool(
            (_handle(-0.06, 0.08, 0.018), box(STEEL, (0.0, 0.0, 0.17), (0.015, 0.09, 0.18))), 0.25
        ),
        "pen": Tool((rod(Material(BLUE), (0.0, 0.0, -0.06), (0.0, 0.0, 0.10), 0.010),), 0.10),
        "needle": Tool((rod(STEEL, (0.0, 0.0, -0.05), (0.0, 0.0, 0.20), 0.008),), 0.10),
        "needles": Tool(
            (
                rod(STEEL, (0.0, 0.0, -0.10), (0.0, 0.0, 0.34), 0.011),
                rod(STEEL, (0.16, 0.02, 0.30), (-0.14, -0.02, 0.04), 0.011),
                ball(Material((0.80, 0.15, 0.20)), (0.0, 0.0, -0.11), (0.035, 0.035, 0.035)),
            ),
            0.16,
        ),
        "wrench": Tool(
            (
                rod(STEEL, (0.0, 0.0, -0.06), (0.0, 0.0, 0.22), 0.016),
                box(STEEL, (0.0, 0.0, 0.25), (0.08, 0.03, 0.07)),
            ),
            0.26,
        ),
        "corkscrew": Tool(
            (
                rod(WOOD, (0.0, -0.07, 0.0), (0.0, 0.07, 0.0), 0.016),
                rod(STEEL, (0.0, 0.0, 0.0), (0.0, 0.0, 0.10), 0.007),
                rod(Material((0.62, 0.42, 0.22)), (0.0, 0.0, 0.09), (0.0, 0.0, 0.14), 0.016),
            ),
            0.12,
        ),
        "key": Tool(
            (
                ball(Material(YELLOW), (0.0, 0.0, 0.02), (0.02, 0.07, 0.06)),
                rod(Material(YELLOW), (0.0, 0.0, 0.04), (0.0, 0.0, 0.15), 0.009),
                box(Material(YELLOW), (0.0, 0.02, 0.13), (0.01, 0.03, 0.03)),
            ),
            0.15,
        ),
        "drill": Tool(
            (
                box(Material(YELLOW), (0.02, 0.0, 0.06), (0.08, 0.07, 0.20)),
                rod(DARK, (-0.02, 0.0, 0.0), (-0.14, 0.0, 0.0), 0.03),
                rod(STEEL, (0.02, 0.0, 0.14), (0.02, 0.0, 0.30), 0.012),
            ),
            0.30,
        ),
        "torch": Tool(
            (
                rod(DARK, (0.0, 0.0, -0.10), (0.0, 0.0, 0.18), 0.02),
                ball(Material((0.8, 0.9, 1.0), emission=3.0), (0.0, 0.0, 0.21), (0.05, 0.05, 0.05)),
            ),
            0.22,
        ),
        "magnifier": Tool(
            (_handle(-0.06, 0.08), rod(_SKY, (-0.008, 0.0, 0.15), (0.008, 0.0, 0.15), 0.07)), 0.20
        ),
        "pipette": Tool(
            (
                rod(Material(WHITE), (0.0, 0.0, -0.10), (0.0, 0.0, 0.10), 0.016),
                spike(_SKY, (0.0, 0.0, 0.10), (0.0, 0.0, 0.24), 0.012),
            ),
            0.24,
        ),
        "spoon": Tool(
            (_handle(-0.08, 0.24, 0.012), ball(WOOD, (0.0, 0.0, 0.27), (0.06, 0.04, 0.08))), 0.28
        ),
        "shaker": Tool((post(Material(WHITE), (0.0, 0.0, 0.05), (0.06, 0.06, 0.12)),), 0.12),
        "jug": Tool((post(_SKY, (0.06, 0.0, 0.04), (0.13, 0.13, 0.22)),), 0.16),
        "food": Tool((ball(_BROWN, (0.02, 0.0, 0.06), (0.09, 0.09, 0.09)),), 0.08),
        "can": Tool(
            (
                post(_SKY, (0.10, 0.0, 0.02), (0.18, 0.18, 0.22)),
                rod(_SKY, (0.18, 0.0, 0.0), (0.34, 0.0, 0.16), 0.02),
            ),
            0.16,
        ),
    }
)
"""Name → tool."""
