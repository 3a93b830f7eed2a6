"""Plain shapes and patterns that stand upright and face the camera; and an eye seen close.

They are drawn as figures are: y to the right, z up, x towards the viewer.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import Material
from texvent.scenes.models.objects.figures import placed, thing
from texvent.scenes.models.objects.work import targets
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import ball, box, fin, limb, rod
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour, Texture

_BLACK: Colour = (0.008, 0.008, 0.009)
_WHITE: Colour = (0.9, 0.9, 0.9)
_THIN = 0.02
_BARS, _BAR_HZ = 5, 0.6
"""Bars of a grating, and how many pass a point each second."""
_SECTORS, _TURN_HZ = 6, 0.7
_GROW_HZ = 0.5
_FOOT = ((0.0, 0.0, 0.001), (0.002, 0.002, 0.002))
"""Place and size of a speck that makes what hovers stand on the ground."""
_BLINK_S, _CLOSED_S = 0.8, 0.36
"""Time from one blink to the next, and how long one takes."""


def _flat(colour: Colour) -> Material:
    return Material(colour, texture=Texture.PLAIN)


def _square(skin: Material) -> list[ModelPart]:
    return [box(_flat(skin.colour), (0.0, 0.0, 0.5), (_THIN, 1.0, 1.0))]


def _disc(skin: Material) -> list[ModelPart]:
    half = 0.5 * _THIN
    return [rod(_flat(skin.colour), (-half, 0.0, 0.5), (half, 0.0, 0.5), 0.5)]


def _triangle(skin: Material) -> list[ModelPart]:
    return [
        fin(_flat(skin.colour), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0), chord=(0.0, 1.1, 0.0),
            thickness=(_THIN, 0.0, 0.0))
    ]  # fmt: skip


def _stripe(skin: Material) -> list[ModelPart]:
    return [box(_flat(skin.colour), (0.0, 0.0, 0.5), (_THIN, 0.12, 1.0))]


def _grating(dark: Colour, pose: Pose) -> list[ModelPart]:
    """Dark bars that drift to the right over a bright plate; they come in and go at its sides."""
    wide, pitch = 1.8, 1.8 / _BARS
    parts = []
    for number in range(_BARS + 1):
        left = (number - 1 + (_BAR_HZ * pose.time_s) % 1.0) * pitch
        start, end = max(left, 0.0), min(left + 0.5 * pitch, wide)
        seen = max(end - start, 1e-4)
        middle = min(max(0.5 * (start + end), 5e-5), wide - 5e-5) - 0.5 * wide
        parts.append(box(_flat(dark), (0.012, middle, 0.6), (0.01, seen, 1.2)))
    return parts


def _build_grating(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Bars that drift over a white plate, 1.8 m wide; `colour` is that of the bars."""
    del seed
    plate = box(_flat(_WHITE), (0.0, 0.0, 0.6), (_THIN, 1.8, 1.2))
    dark = colour if colour is not None and min(colour) < 0.7 else _BLACK
    return ArticulatedModel([plate], scale=scale, articulate=partial(_grating, dark))


def _sectors(colour: Colour, pose: Pose) -> list[ModelPart]:
    """Bright sectors that turn on a black disc."""
    angle = 2.0 * math.pi * _TURN_HZ * pose.time_s
    half = math.pi / (2.0 * _SECTORS)
    parts = []
    for number in range(_SECTORS):
        middle = angle + 2.0 * math.pi * number / _SECTORS
        y, z = math.cos(middle), math.sin(middle)
        out = 0.49 * math.cos(half)
        wide = 2.0 * 0.49 * math.sin(half)
        parts.append(
            fin(_flat(colour), (0.006, out * y, 0.5 + out * z), (0.006, 0.0, 0.5),
                chord=(0.0, -wide * z, wide * y), thickness=(_THIN, 0.0, 0.0))
        )  # fmt: skip
    return parts


def _build_sectors(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A disc of black and bright sectors, 1 m, that turns; `colour` is that of the bright ones."""
    del seed
    turning = partial(_sectors, _WHITE if colour is None else colour)
    return ArticulatedModel(_disc(_flat(_BLACK)), scale=scale, articulate=turning)


def _grown(pose: Pose, least: float) -> float:
    """Size of what expands, from `least` to 1, again and again."""
    return least + (1.0 - least) * ((_GROW_HZ * pose.time_s) % 1.0)


def _ring_parts(skin: Material, pose: Pose) -> list[ModelPart]:
    """A ring of rods whose radius grows."""
    radius, count = 0.62 * _grown(pose, 0.12), 28
    points = [
        (0.0, radius * math.cos(turn), 0.65 + radius * math.sin(turn))
        for turn in (2.0 * math.pi * k / count for k in range(count + 1))
    ]
    return [limb(skin, start, end, 0.03) for start, end in itertools.pairwise(points)]


def _build_ring(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A ring that grows to 1.2 m, again and again; `colour` is its own."""
    skin = _flat(paint(colour, seed, "paint", (_BLACK,)))
    foot = box(skin, *_FOOT)
    return ArticulatedModel([foot], scale=scale, articulate=partial(_ring_parts, skin))


def _looming(skin: Material, pose: Pose) -> list[ModelPart]:
    """A disc that grows as what comes nearer does."""
    half = 0.5 * _THIN
    return [rod(skin, (-half, 0.0, 0.65), (half, 0.0, 0.65), 0.62 * _grown(pose, 0.1))]


def _build_looming(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A disc that grows to 1.2 m, again and again; `colour` is its own."""
    skin = _flat(paint(colour, seed, "paint", (_BLACK,)))
    foot = box(skin, *_FOOT)
    return ArticulatedModel([foot], scale=scale, articulate=partial(_looming, skin))


_SKIN: Colour = (0.62, 0.40, 0.30)
_IRISES: tuple[Colour, ...] = ((0.10, 0.22, 0.38), (0.14, 0.24, 0.10), (0.16, 0.08, 0.03))


def _lids(pose: Pose) -> list[ModelPart]:
    """Both lids and the lashes: open but for a short time."""
    share = (pose.time_s % _BLINK_S) / _CLOSED_S - 0.7
    closed = math.sin(math.pi * min(max(share, 0.0), 1.0))
    lid = Material((0.56, 0.35, 0.26))
    low = 0.52 - 0.33 * closed
    lashes = [
        limb(_flat(_BLACK), (0.27 - 0.9 * y * y, y, low - 0.4 * y * y + 0.01),
             (0.33 - 0.9 * y * y, 1.15 * y, low - 0.4 * y * y - 0.02 + 0.05 * (1 - closed)), 0.007)
        for y in (-0.26, -0.20, -0.13, -0.06, 0.0, 0.06, 0.13, 0.20, 0.26)
    ]  # fmt: skip
    return [
        ball(lid, (0.07, 0.0, 0.70 - 0.30 * closed), (0.42, 0.86, 0.42)),
        ball(lid, (0.05, 0.0, 0.12 + 0.04 * closed), (0.36, 0.84, 0.30)),
        *lashes,
    ]


def _eye(iris: Colour) -> Sequence[ModelPart]:
    """The ball of an eye, and the skin and brow around it."""
    skin = Material(_SKIN)
    return [
        box(skin, (-0.06, 0.0, 0.54), (0.12, 1.6, 1.1)),
        ball(_flat((0.86, 0.84, 0.82)), (0.03, 0.0, 0.38), (0.40, 0.74, 0.44)),
        ball(_flat(iris), (0.19, 0.0, 0.38), (0.10, 0.28, 0.28)),
        ball(_flat(_BLACK), (0.225, 0.0, 0.38), (0.05, 0.13, 0.13)),
        ball(_flat((1.0, 1.0, 1.0)), (0.25, -0.035, 0.42), (0.02, 0.04, 0.04)),
        *(limb(Material((0.05, 0.03, 0.02)), (0.02, y, 0.86 - 0.3 * y * y),
               (0.02, y + 0.16, 0.86 - 0.3 * (y + 0.16) ** 2), 0.05)
          for y in (-0.48, -0.34, -0.20, -0.06, 0.08, 0.22, 0.34)),
    ]  # fmt: skip


def _build_eye(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """An eye that blinks, with skin and brow around it, 1.6 m wide; `colour` is its iris."""
    iris = paint(colour, seed, "paint", _IRISES)
    return ArticulatedModel(_eye(iris), scale=scale, articulate=_lids)


def _pattern(
    name: str, build: object, same: tuple[str, ...] = (), plurals: tuple[str, ...] = ()
) -> Noun:
    """A pattern that moves by itself."""
    return Noun(
        name, build, "fixed", 0.0, "stand", same, plurals, place="plain", is_working=True,  # type: ignore[arg-type]
    )  # fmt: skip


_RINGS = tuple(
    f"{word}concentric {one}"
    for word in ("", "expanding ", "growing ")
    for one in ("rings", "circles")
)
NOUNS = (
    *placed("plain", (
        thing("square", (_BLACK,), _square),
        thing("disc", (_BLACK,), _disc, ("disk", "circle", "dot", "round disc", "circular disc")),
        thing("triangle", (_BLACK,), _triangle),
        thing("vertical bar", (_BLACK,), _stripe, ("vertical line",)),
    )),
    _pattern("grating", _build_grating, (
        "moving grating", "sine grating", "drifting grating", "stripe pattern", "striped pattern",
        "bar pattern", "black and white stripes", "vertical stripes", "black and white bars",
        "moving bars", "moving stripes"), (
        "black and white stripes", "vertical stripes", "black and white bars",
        "moving bars", "moving stripes")),
    _pattern("spinning disc", _build_sectors, (
        "spinning disk", "rotating disc", "rotating disk", "spinning wheel disc", "sector disc",
        "striped disc", "optical chopper")),
    _pattern("expanding ring", _build_ring, ("expanding circle", "growing ring", *_RINGS), _RINGS),
    _pattern("looming disc", _build_looming, ("expanding disc", "growing disc", "growing circle")),
    _pattern("eye", _build_eye, ("human eye",)),
)  # fmt: skip
"""Nouns of shapes and patterns."""
FACING = frozenset(noun.name for noun in (*NOUNS, *targets.NOUNS))
"""Names of nouns that turn their face straight to the camera."""
