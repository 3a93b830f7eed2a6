"""Plants: broad-leaved tree, pine, palm, bush, flower and cactus; foliage sways in the wind."""

from __future__ import annotations

import math

from texvent.scenes.models.articulated_model import STANDING_POSES, ArticulatedModel
from texvent.scenes.models.materials import (
    BARK,
    GREEN,
    RED,
    YELLOW,
    Material,
    foliage,
    mottled,
    needles,
    shade,
    striped,
)
from texvent.scenes.models.protocol import ModelPart, Pose, fixed_noun
from texvent.scenes.models.shapes import (
    ball,
    blade,
    limb,
    moved,
    peak,
    post,
    rod,
    spike,
    turn_x,
    turn_y,
)
from texvent.scenes.models.variation import between, fraction, paint
from texvent.scenes.scene import Colour

_LEAF: Colour = (0.075, 0.20, 0.035)
_NEEDLE: Colour = (0.025, 0.105, 0.045)


def build_tree(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a broad-leaved tree, about 7 m; `colour` is its foliage."""
    leaf = colour if colour is not None else shade(_LEAF, between(seed, "leaf", 0.8, 1.3))
    trunk_top = between(seed, "trunk", 2.6, 3.2)
    crown = [ball(foliage(leaf), (0.0, 0.0, trunk_top + 2.0), (3.6, 3.6, 3.4))]
    for step in range(5):
        angle = 2.0 * math.pi * (step + 0.6 * fraction(seed, f"angle {step}")) / 5.0
        out = between(seed, f"out {step}", 1.1, 1.5)
        size = between(seed, f"size {step}", 2.0, 2.7)
        z = trunk_top + between(seed, f"height {step}", 0.7, 2.2)
        tint = shade(leaf, between(seed, f"tint {step}", 0.75, 1.2))
        centre = (out * math.cos(angle), out * math.sin(angle), z)
        crown.append(ball(foliage(tint), centre, (size, size, 0.85 * size)))
    trunk = [
        post(BARK, (0.0, 0.0, 0.5 * trunk_top + 0.3), (0.44, 0.44, trunk_top + 0.6)),
        peak(BARK, (0.0, 0.0, 0.6), (0.8, 0.8, 1.2)),
        rod(BARK, (0.0, 0.0, trunk_top - 0.6), (0.9, 0.3, trunk_top + 0.8), 0.10),
        rod(BARK, (0.0, 0.0, trunk_top - 0.3), (-0.8, -0.4, trunk_top + 0.8), 0.10),
    ]
    return _swaying(trunk, crown, scale=scale, seed=seed, amount=0.012)


def build_pine(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a pine or fir, about 9 m: tiers of cones on a trunk; `colour` is its needles."""
    needle = colour if colour is not None else shade(_NEEDLE, between(seed, "needle", 0.8, 1.3))
    height = between(seed, "height", 8.0, 10.0)
    tiers = 5
    crown = []
    for step in range(tiers):
        share = step / tiers
        width = (3.6 - 2.7 * share) * between(seed, f"width {step}", 0.92, 1.08)
        low = 1.2 + (height - 2.4) * share
        tall = (height - 1.2) * (0.34 - 0.12 * share) if step < tiers - 1 else height - low
        tint = needles(shade(needle, 0.85 + 0.35 * share))
        crown.append(peak(tint, (0.0, 0.0, low + 0.5 * tall), (width, width, tall)))
    trunk = [post(BARK, (0.0, 0.0, 0.35 * height), (0.36, 0.36, 0.7 * height))]
    return _swaying(trunk, crown, scale=scale, seed=seed, amount=0.008)


def build_palm(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a palm, about 7 m: a ringed stem with drooping fronds; `colour` is its fronds."""
    leaf = foliage(colour if colour is not None else (0.09, 0.24, 0.04), scale=2.0)
    stem = striped((0.20, 0.14, 0.09), (0.12, 0.08, 0.05), 6.0)
    knee, top = (0.35, 0.0, 2.8), (0.15, 0.0, 5.6)
    trunk = [rod(stem, (0.0, 0.0, 0.0), knee, 0.20), rod(stem, knee, top, 0.16)]
    turn = 2.0 * math.pi * fraction(seed, "turn")
    crown = [ball(Material((0.12, 0.07, 0.03)), top, (0.5, 0.5, 0.5))]
    for step in range(8):
        angle = turn + 2.0 * math.pi * step / 8.0
        c, s = math.cos(angle), math.sin(angle)
        elbow = (top[0] + 1.1 * c, top[1] + 1.1 * s, top[2] + 0.55)
        tip = (top[0] + 2.4 * c, top[1] + 2.4 * s, top[2] - 0.5)
        across = (-0.6 * s, 0.6 * c, 0.0)
        crown.append(blade(leaf, top, elbow, chord=across, thickness=(0.0, 0.0, 0.12)))
        crown.append(blade(leaf, elbow, tip, chord=across, thickness=(0.04 * c, 0.04 * s, 0.08)))
    return _swaying(trunk, crown, scale=scale, seed=seed, amount=0.02)


def build_bush(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a bush, about 1.2 m; `colour` is its foliage."""
    leaf = colour if colour is not None else shade(_LEAF, between(seed, "leaf", 0.7, 1.2))
    crown = []
    for step in range(5):
        angle = 2.0 * math.pi * step / 5.0 + fraction(seed, f"angle {step}")
        size = between(seed, f"size {step}", 0.8, 1.1)
        tint = foliage(shade(leaf, between(seed, f"tint {step}", 0.8, 1.2)), scale=1.6)
        centre = (0.42 * math.cos(angle), 0.42 * math.sin(angle), 0.42 * size)
        crown.append(ball(tint, centre, (size, size, 0.84 * size)))
    crown.append(ball(foliage(leaf, scale=1.6), (0.0, 0.0, 0.68), (1.0, 1.0, 0.95)))
    return _swaying([], crown, scale=scale, seed=seed, amount=0.015)


def build_flower(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a flower, about 0.6 m, with a head large enough to see; `colour` is its petals."""
    petal_colour = paint(colour, seed, "petal", (RED, YELLOW))
    petal, stem = Material(petal_colour), foliage(GREEN, scale=8.0)
    crown = []
    for step in range(7):
        angle = 2.0 * math.pi * step / 7.0
        c, s = math.cos(angle), math.sin(angle)
        tip = (0.02 + 0.03 * c, 0.16 * s, 0.52 + 0.16 * c)
        crown.append(
            blade(
                petal,
                (0.03, 0.02 * s, 0.52 + 0.02 * c),
                tip,
                chord=(0.0, 0.11 * c, -0.11 * s),
                thickness=(0.03, 0.0, 0.0),
            )
        )
    heart = Material((0.35, 0.18, 0.02) if petal_colour is not YELLOW else (0.08, 0.04, 0.02))
    crown.append(ball(heart, (0.035, 0.0, 0.52), (0.06, 0.12, 0.12)))
    crown.append(rod(stem, (0.0, 0.0, 0.0), (0.01, 0.0, 0.52), 0.012))
    for side in (1.0, -1.0):
        tip = (0.0, 0.16 * side, 0.24)
        flat = (0.02, 0.0, 0.0)
        crown.append(
            blade(stem, (0.0, 0.0, 0.08), tip, chord=(0.0, -0.05 * side, 0.05), thickness=flat)
        )
    return _swaying([], crown, scale=scale, seed=seed, amount=0.05)


def build_cactus(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a ribbed cactus with two arms and spines, about 1.9 m."""
    hue = colour if colour is not None else (0.07, 0.24, 0.07)
    skin, dark, pale = mottled(hue, contrast=0.2, scale=6.0), Material(shade(hue, 0.5)), Material(
        (0.80, 0.76, 0.60))  # fmt: skip
    arm = between(seed, "arm", 0.75, 0.95)
    rigid = [
        rod(skin, (0.0, 0.0, 0.0), (0.0, 0.0, 1.66), 0.19),
        ball(skin, (0.0, 0.0, 1.66), (0.38, 0.38, 0.42)),
    ]
    for side, low, tall in ((1.0, arm, 0.62), (-1.0, arm + 0.15, 0.50)):
        elbow, tip = (0.0, side * 0.46, low), (0.0, side * 0.46, low + tall)
        rigid += [
            limb(skin, (0.0, side * 0.1, low), elbow, 0.105),
            rod(skin, elbow, tip, 0.11),
            ball(skin, elbow, (0.22, 0.22, 0.22)),
            ball(skin, tip, (0.22, 0.22, 0.26)),
        ]
    for k in range(10):
        c, s = math.cos(math.tau * k / 10), math.sin(math.tau * k / 10)
        rigid.append(rod(dark, (0.183 * c, 0.183 * s, 0.0), (0.183 * c, 0.183 * s, 1.68), 0.016))
        for z in (0.4, 0.8, 1.2, 1.6):
            up = z + 0.10 * (k % 3)
            rigid.append(
                spike(pale, (0.18 * c, 0.18 * s, up), (0.25 * c, 0.25 * s, up + 0.02), 0.011)
            )
    return ArticulatedModel(rigid, scale=scale)


def _swaying(
    trunk: list[ModelPart], crown: list[ModelPart], *, scale: float, seed: int, amount: float
) -> ArticulatedModel:
    """Foliage that leans to and fro by up to `amount` radians, out of step with its neighbours."""
    start = 2.0 * math.pi * fraction(seed, "sway")

    def articulate(pose: Pose) -> list[ModelPart]:
        forth = amount * math.sin(1.3 * pose.time_s + start)
        across = amount * math.sin(0.9 * pose.time_s + 2.0 * start)
        return moved(moved(crown, turn_y(forth)), turn_x(across))

    return ArticulatedModel(trunk, scale=scale, articulate=articulate, poses=STANDING_POSES)


NOUNS = (
    fixed_noun("tree", build_tree),
    fixed_noun(
        "pine", build_pine,
        ("pine tree",),
    ),
    fixed_noun("palm", build_palm, ("palm tree",)),
    fixed_noun("bush", build_bush, ("shrub",)),
    fixed_noun("flower", build_flower),
    fixed_noun("cactus", build_cactus, (), ("cacti",)),
)  # fmt: skip
