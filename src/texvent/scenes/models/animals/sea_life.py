"""Swimmers: bodies of segments that undulate sideways (fish) or up and down (whales)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    Material,
    checked,
    leather,
    scales,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import (
    Affine,
    Point,
    ball,
    blade,
    compose,
    fin,
    limb,
    moved,
    post,
    shift,
    turn_x,
    turn_y,
    turn_z,
    upright_fin,
)
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class Swimmer:
    """Proportions of a fish or whale in units of its length, and its colours."""

    length: float
    """Nose to tail fin, m."""
    depth: float
    """Greatest height of the body."""
    breadth: float
    """Greatest width of the body."""
    beat_hz: float
    swing: float
    """Sideways (or up-and-down) reach of the tail."""
    dorsal: tuple[float, float, float]
    """x of the back fin's root, its height, its chord."""
    pectoral: float
    """Length of the side fins."""
    tail: tuple[float, float]
    """Reach of the upper and the lower (left and right) tail lobe."""
    backs: tuple[Colour, ...]
    belly: Colour
    is_whale: bool = False
    """Tail fin lies flat and beats up and down."""
    snout: float = 0.0
    """Length of a beak, as dolphins have."""


FISH = Swimmer(
    0.45, 0.36, 0.15, 2.0, 0.07, (0.02, 0.13, 0.34), 0.13, (0.17, 0.17),
    ((0.80, 0.28, 0.02), (0.75, 0.50, 0.03), (0.10, 0.25, 0.55)), (0.75, 0.55, 0.30),
)  # fmt: skip
SHARK = Swimmer(
    3.4, 0.19, 0.17, 0.9, 0.08, (0.06, 0.15, 0.15), 0.22, (0.19, 0.10),
    ((0.05, 0.065, 0.08),), (0.62, 0.64, 0.64),
)  # fmt: skip
DOLPHIN = Swimmer(
    2.3, 0.20, 0.18, 1.2, 0.07, (-0.02, 0.11, 0.14), 0.15, (0.13, 0.13),
    ((0.20, 0.25, 0.31),), (0.55, 0.58, 0.60), is_whale=True, snout=0.09,
)  # fmt: skip
WHALE = Swimmer(
    12.0, 0.28, 0.27, 0.25, 0.05, (-0.22, 0.03, 0.08), 0.19, (0.16, 0.16),
    ((0.07, 0.10, 0.14),), (0.45, 0.48, 0.50), is_whale=True,
)  # fmt: skip

# Middle of each body segment, its length and its thickness, from nose to tail root.
_SEGMENTS = ((0.26, 0.46, 0.86), (0.06, 0.50, 1.0), (-0.15, 0.40, 0.74), (-0.30, 0.28, 0.42))


def build_swimmer(
    kind: Swimmer, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a fish or whale; `colour` is its back."""
    back = paint(colour, seed, "back", kind.backs)
    belly = kind.belly if colour is None else shade(colour, 1.6)
    start = fraction(seed, "beat")

    def articulate(pose: Pose) -> list[ModelPart]:
        rests = pose.activity in ("stand", "sit")
        turn = 2.0 * math.pi * (kind.beat_hz * pose.time_s + start)
        return _body(kind, scales(back), scales(belly), turn, 0.3 if rests else 1.0)

    return ArticulatedModel([], scale=scale * kind.length, articulate=articulate, is_centred=True)


def _body(
    kind: Swimmer, back: Material, belly: Material, turn: float, amount: float
) -> list[ModelPart]:
    """All parts of a swimmer of length 1, a wave running from head to tail."""
    parts: list[ModelPart] = []
    for index, (x, long, thick) in enumerate(_SEGMENTS):
        tall, wide = thick * kind.depth, thick * kind.breadth
        group = [ball(back, (x, 0.0, 0.0), (long, wide, tall))]
        if index < 3:
            low = (x + 0.01, 0.0, -0.10 * tall)
            group.append(ball(belly, low, (0.90 * long, 0.94 * wide, 0.86 * tall)))
        if index == 0:
            group += _face(kind, back)
        if index == 1:
            group += _fins(kind, back)
        if index == 3:
            group += _tail(kind, back)
        parts += moved(group, _wave(kind, x, turn, amount))
    return parts


def _wave(kind: Swimmer, x: float, turn: float, amount: float) -> Affine:
    """Displacement and slant of the body at x: small at the head, `swing` at the tail."""
    reach = amount * kind.swing * (0.12 + 0.88 * ((0.45 - x) / 0.95) ** 2)
    phase = turn + 3.6 * x
    offset, slope = reach * math.sin(phase), 3.6 * reach * math.cos(phase)
    if kind.is_whale:
        return compose(shift(z=offset), turn_y(-math.atan(slope), (x, 0.0, 0.0)))
    return compose(shift(y=offset), turn_z(math.atan(slope), (x, 0.0, 0.0)))


def _face(kind: Swimmer, back: Material) -> list[ModelPart]:
    """Eyes, and a beak or a mouth."""
    eye_y = 0.36 * kind.breadth
    eye_x, eye_z = 0.37, 0.06 * kind.depth
    size = 0.030 if kind.depth < 0.3 else 0.055
    parts = [
        ball(Material(BLACK), (eye_x, side * eye_y, eye_z), (size, 0.5 * size, size))
        for side in (1.0, -1.0)
    ]
    if kind.snout:
        start, end = (0.40, 0.0, -0.015), (0.44 + kind.snout, 0.0, -0.03)
        parts.append(limb(back, start, end, 0.028))
    else:
        mouth = (0.40, 0.0, -0.22 * kind.depth)
        parts.append(ball(Material(shade(BLACK, 1.5)), mouth, (0.11, 0.46 * kind.breadth, 0.012)))
    return parts


def _fins(kind: Swimmer, back: Material) -> list[ModelPart]:
    """Back fin and side fins."""
    x, tall, chord = kind.dorsal
    top = 0.42 * kind.depth
    tip = (x - 0.55 * chord, 0.0, top + tall)
    parts = [upright_fin(back, (x, 0.0, top - 0.02), tip, chord, 0.024)]
    for side in (1.0, -1.0):
        root: Point = (0.17, side * 0.36 * kind.breadth, -0.20 * kind.depth)
        end: Point = (
            0.17 - 0.6 * kind.pectoral,
            root[1] + side * 0.85 * kind.pectoral,
            root[2] - 0.35 * kind.pectoral,
        )
        flat = (0.0, 0.0, 0.022)
        parts.append(fin(back, root, end, chord=(0.12, 0.0, 0.0), thickness=flat))
    return parts


def _tail(kind: Swimmer, back: Material) -> list[ModelPart]:
    """Two lobes: upright in fish, flat in whales."""
    upper, lower = kind.tail
    root, chord, thin = (-0.39, 0.0, 0.0), (0.11, 0.0, 0.0), 0.022
    parts = []
    for reach, sign in ((upper, 1.0), (lower, -1.0)):
        back_x = -0.39 - 0.62 * reach
        if kind.is_whale:
            tip, flat = (back_x, sign * reach, 0.0), (0.0, 0.0, thin)
        else:
            tip, flat = (back_x, 0.0, sign * reach), (0.0, thin, 0.0)
        parts.append(fin(back, root, tip, chord=chord, thickness=flat))
    return parts


def build_turtle(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a sea turtle, about 1 m; `colour` is its shell."""
    shell = checked(
        colour if colour is not None else (0.16, 0.13, 0.04),
        shade(colour, 0.5) if colour is not None else (0.07, 0.08, 0.03),
        2.2,
    )
    skin = leather((0.16, 0.22, 0.09))
    rigid = [
        ball(shell, (0.0, 0.0, 0.04), (0.86, 0.68, 0.34)),
        ball(Material((0.45, 0.40, 0.22)), (0.0, 0.0, -0.03), (0.80, 0.62, 0.20)),
        limb(skin, (0.36, 0.0, 0.02), (0.52, 0.0, 0.05), 0.065),
        ball(skin, (0.57, 0.0, 0.06), (0.20, 0.15, 0.14)),
        ball(Material(BLACK), (0.61, 0.0, 0.085), (0.03, 0.155, 0.03)),
    ]
    start = 2.0 * math.pi * fraction(seed, "stroke")

    def articulate(pose: Pose) -> list[ModelPart]:
        stroke = 0.6 * math.sin(2.0 * math.pi * 0.6 * pose.time_s + start)
        parts: list[ModelPart] = []
        for side in (1.0, -1.0):
            root: Point = (0.26, side * 0.24, 0.0)
            tip: Point = (0.10, side * 0.74, 0.0)
            flat = (0.0, 0.0, 0.04)
            front = [blade(skin, root, tip, chord=(0.22, 0.06 * side, 0.0), thickness=flat)]
            parts += moved(front, turn_x(side * stroke, root))
            heel: Point = (-0.30, side * 0.20, 0.0)
            toe: Point = (-0.52, side * 0.36, 0.0)
            rear = [blade(skin, heel, toe, chord=(0.10, 0.14 * side, 0.0), thickness=flat)]
            parts += moved(rear, turn_x(-0.4 * side * stroke, heel))
        return parts

    return ArticulatedModel(rigid, scale=scale, articulate=articulate, is_centred=True)


def build_jellyfish(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a jellyfish, about 0.9 m tall, that pulses; `colour` is its bell."""
    bell = Material(colour if colour is not None else (0.62, 0.34, 0.55), emission=0.15)
    inner = Material(shade(bell.colour, 1.4), emission=0.15)
    start = fraction(seed, "pulse")

    def articulate(pose: Pose) -> list[ModelPart]:
        turn = 2.0 * math.pi * (0.7 * pose.time_s + start)
        squeeze = 0.10 * math.sin(turn)
        wide, tall = 0.60 * (1.0 - squeeze), 0.40 * (1.0 + squeeze)
        parts = [
            ball(bell, (0.0, 0.0, 0.22), (wide, wide, tall)),
            post(inner, (0.0, 0.0, 0.16), (0.94 * wide, 0.94 * wide, 0.10)),
            ball(inner, (0.0, 0.0, 0.06), (0.45 * wide, 0.45 * wide, 0.3)),
        ]
        for index in range(7):
            parts += _tentacle(inner, 2.0 * math.pi * index / 7.0, 0.40 * wide, turn)
        return parts

    return ArticulatedModel([], scale=scale, articulate=articulate, is_centred=True)


def _tentacle(material: Material, angle: float, out: float, turn: float) -> list[ModelPart]:
    """A chain of two limbs that trails the pulse."""
    c, s = math.cos(angle), math.sin(angle)
    sway = 0.06 * math.sin(turn - 1.2 + angle)
    curl = 0.10 * math.sin(turn - 2.2 + angle)
    top = (out * c, out * s, 0.14)
    knee = (top[0] + sway, top[1] + 0.5 * sway, -0.12)
    tip = (knee[0] + curl, knee[1] + 0.5 * curl, -0.42)
    return [limb(material, top, knee, 0.022), limb(material, knee, tip, 0.016)]


NOUNS = (
    Noun(
        "fish", partial(build_swimmer, FISH), "water", 0.6, "swim",
        (),
        ("fish",),
    ),
    Noun("shark", partial(build_swimmer, SHARK), "water", 1.6, "swim"),
    Noun("dolphin", partial(build_swimmer, DOLPHIN), "water", 2.2, "swim"),
    Noun("whale", partial(build_swimmer, WHALE), "water", 2.5, "swim"),
    Noun("turtle", build_turtle, "water", 0.6, "swim", ("sea turtle",)),
    Noun("jellyfish", build_jellyfish, "water", 0.15, "swim", (), ("jellyfish",)),
)  # fmt: skip
