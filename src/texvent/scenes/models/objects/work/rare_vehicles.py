"""Vehicles that are met less often: tank, submarine, cable car, snowmobile, golf cart; cannon."""

from __future__ import annotations

from texvent.scenes.models.materials import HEADLIGHT, Material, mottled
from texvent.scenes.models.objects.figures import (
    disc,
    placed,
    ring,
    thing,
    toned,
)
from texvent.scenes.models.objects.palette import (
    BLUE_PAINT,
    INK,
    IRON,
    PALE,
    RED_PAINT,
    SILVER,
    STEELY,
    WOOD_BROWN,
    YELLOW_PAINT,
)
from texvent.scenes.models.shapes import ball, box, limb, plank, post, rod
from texvent.scenes.models.vehicles.wheels import Wheel

_PANE = Material((0.05, 0.07, 0.09))

_LAND = placed("dirt road", (
    thing("tank", ((0.09, 0.11, 0.045), (0.30, 0.24, 0.13)), lambda p: [
        box(mottled(p.colour, contrast=0.35), (0.0, 0.0, 1.05), (5.6, 2.2, 0.7)),
        plank(p, (2.7, 0.0, 0.7), (3.3, 0.0, 1.2), chord=(0.0, 2.2, 0.0),
            thickness=(0.5, 0.0, 0.3)),
        post(mottled(p.colour, contrast=0.35), (-0.3, 0.0, 1.75), (2.6, 2.3, 0.75)),
        rod(p, (0.8, 0.0, 1.8), (4.6, 0.0, 1.95), 0.13),
        rod(toned(p, 0.7), (4.4, 0.0, 1.94), (4.7, 0.0, 1.96), 0.18),
        post(toned(p, 0.8), (-0.7, 0.45, 2.2), (0.7, 0.7, 0.2)),
        rod(INK, (-1.2, -0.6, 2.1), (-1.4, -0.6, 3.4), 0.02),
        *(box(INK, (0.0, 1.35 * s, z), (5.4, 0.55, 0.10)) for s in (1.0, -1.0)
            for z in (0.06, 1.0)),
        *(rod(INK, (2.7 * t, 1.08 * s, 0.53), (2.7 * t, 1.62 * s, 0.53), 0.53)
            for s in (1.0, -1.0) for t in (1.0, -1.0)),
        *(box(p, (0.0, 1.35 * s, 1.12), (6.2, 0.6, 0.08)) for s in (1.0, -1.0))],
        ("battle tank", "army tank", "panzer"),
        wheels=tuple(Wheel((x, 1.35 * s, 0.42), 0.36, 0.58) for x in (-1.8, -0.6, 0.6, 1.8)
            for s in (1.0, -1.0)),
        goes=("ground", "drive", 5.0)),
    thing("cannon", (IRON.colour,), lambda p: [
        rod(p, (-0.7, 0.0, 0.75), (1.2, 0.0, 1.05), 0.16),
        rod(p, (1.1, 0.0, 1.03), (1.3, 0.0, 1.07), 0.21),
        rod(INK, (1.3, 0.0, 1.066), (1.31, 0.0, 1.068), 0.12),
        ball(p, (-0.78, 0.0, 0.74), (0.22, 0.22, 0.22)),
        *(rod(toned(p, 0.6), (x, 0.0, 0.86 + 0.16 * x), (x + 0.08, 0.0, 0.873 + 0.16 * x), 0.19)
            for x in (-0.5, 0.3)),
        plank(Material(WOOD_BROWN), (0.2, 0.0, 0.68), (-1.6, 0.0, 0.10), chord=(0.0, 0.34, 0.0),
            thickness=(0.06, 0.0, 0.18))],
        ("artillery piece", "field gun"),
        wheels=tuple(Wheel((0.1, 0.45 * s, 0.55), 0.55, 0.09) for s in (1.0, -1.0)),
        goes=("ground", "roll", 0.8)),
    thing("snowmobile", (RED_PAINT.colour, BLUE_PAINT.colour), lambda p: [
        box(INK, (-0.5, 0.0, 0.22), (1.7, 0.42, 0.36)),
        limb(p, (0.2, 0.0, 0.55), (1.15, 0.0, 0.42), 0.26),
        box(INK, (-0.5, 0.0, 0.62), (1.2, 0.38, 0.22)),
        plank(_PANE, (0.45, 0.0, 0.75), (0.2, 0.0, 1.15), chord=(0.0, 0.55, 0.0),
            thickness=(0.03, 0.0, 0.0)),
        rod(INK, (0.25, -0.38, 0.98), (0.25, 0.38, 0.98), 0.025),
        *(box(p, (1.0, 0.45 * s, 0.05), (0.9, 0.14, 0.05)) for s in (1.0, -1.0)),
        *(plank(p, (1.42, 0.45 * s, 0.05), (1.62, 0.45 * s, 0.18), chord=(0.0, 0.14, 0.0),
            thickness=(0.04, 0.0, 0.0)) for s in (1.0, -1.0)),
        *(rod(SILVER, (0.95, 0.45 * s, 0.06), (0.8, 0.2 * s, 0.45), 0.025) for s in (1.0, -1.0)),
        ball(HEADLIGHT, (1.36, 0.0, 0.48), (0.08, 0.30, 0.12))], ("ski-doo",),
        goes=("ground", "slide", 6.0)),
    thing("golf cart", (PALE.colour, (0.05, 0.25, 0.12)), lambda p: [
        box(p, (0.0, 0.0, 0.42), (2.1, 1.1, 0.28)),
        plank(p, (0.95, 0.0, 0.4), (0.75, 0.0, 0.85), chord=(0.0, 1.05, 0.0),
            thickness=(0.3, 0.0, 0.0)),
            box(Material((0.30, 0.18, 0.09)), (-0.25, 0.0, 0.68), (0.55, 1.0, 0.16)),
            box(Material((0.30, 0.18, 0.09)), (-0.55, 0.0, 0.98), (0.12, 1.0, 0.5)),
        *(rod(SILVER, (x, 0.48 * s, 0.55), (0.85 * x, 0.48 * s, 1.85), 0.025)
            for x in (0.8, -0.85) for s in (1.0, -1.0)),
            box(p, (-0.03, 0.0, 1.88), (1.75, 1.1, 0.07)),
            *ring(INK, (0.42, 0.25, 0.98), (0.16, 0.16), 0.015, axis="x", pieces=10),
            *(ball(HEADLIGHT, (1.06, 0.35 * s, 0.55), (0.05, 0.16, 0.12)) for s in (1.0, -1.0))],
        ("golfcart", "golf buggy"),
        wheels=tuple(Wheel((0.72 * t, 0.48 * s, 0.24), 0.24, 0.18) for t in (1.0, -1.0)
            for s in (1.0, -1.0)), goes=("ground", "drive", 4.0)),
    thing("cable car", (RED_PAINT.colour, YELLOW_PAINT.colour), lambda p: [
        box(p, (0.0, 0.0, -0.6), (2.4, 1.6, 0.9)), box(_PANE, (0.0, 0.0, 0.25), (2.36, 1.56, 0.9)),
        box(p, (0.0, 0.0, 0.78), (2.5, 1.7, 0.18)),
        *(box(p, (x, 0.0, 0.25), (0.10, 1.62, 0.9)) for x in (-1.15, -0.4, 0.4, 1.15)),
        rod(INK, (0.0, 0.0, 0.85), (0.0, 0.0, 2.2), 0.07),
        rod(IRON, (-5.0, 0.0, 2.22), (5.0, 0.0, 2.22), 0.025),
        box(IRON, (0.0, 0.0, 2.2), (0.9, 0.2, 0.16))],
        ("ropeway", "ski lift gondola", "aerial tramway"), goes=("air", "fly", 2.5)),
))  # fmt: skip

_WATER = placed("underwater", (
    thing("submarine", (STEELY, YELLOW_PAINT.colour), lambda p: [
        limb(p, (-3.2, 0.0, 0.0), (3.2, 0.0, 0.0), 0.9), box(p, (0.5, 0.0, 1.1), (1.6, 0.55, 1.1)),
        rod(INK, (0.7, 0.0, 1.6), (0.7, 0.0, 2.4), 0.05),
        rod(INK, (0.7, 0.0, 2.4), (0.95, 0.0, 2.4), 0.05),
        *(box(toned(p, 0.7), (-3.2, 0.0, 0.0), (0.7, w, h)) for w, h in ((2.0, 0.08), (0.08, 2.0))),
        *(ball(_PANE, (x, 0.86 * s, 0.15), (0.34, 0.12, 0.34)) for x in (1.8, 0.6, -0.6)
            for s in (1.0, -1.0)), box(toned(p, 0.7), (2.0, 0.0, 0.0), (0.5, 2.2, 0.08)),
            disc(IRON, (0.0, 0.0), 0.45, 0.08, -3.75)], ("sub", "u-boat"),
            goes=("water", "swim", 2.0)),
))  # fmt: skip

NOUNS = (*_LAND, *_WATER)
"""Nouns of these vehicles."""
