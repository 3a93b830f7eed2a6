"""Simple solids: sphere, cube, cylinder, cone; and a wheel that rolls."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLUE,
    GREEN,
    RED,
    WHITE,
    YELLOW,
    Material,
    brick,
    checked,
    cloth,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose, fixed_noun
from texvent.scenes.models.shapes import (
    Point,
    ball,
    box,
    compose,
    moved,
    peak,
    post,
    shift,
    turn_y,
)
from texvent.scenes.models.variation import paint
from texvent.scenes.models.vehicles.wheels import Wheel, car_wheels
from texvent.scenes.scene import Colour

_HUES: tuple[Colour, ...] = (RED, BLUE, GREEN, YELLOW)


def build_sphere(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a checked sphere, 1 m, that rolls."""
    skin = _checks(colour, seed)

    def articulate(pose: Pose) -> list[ModelPart]:
        one = [ball(skin, (0.0, 0.0, 0.0), (1.0, 1.0, 1.0))]
        return moved(one, compose(shift(z=0.5), turn_y(pose.distance_m / 0.5)))

    return ArticulatedModel([], scale=scale, articulate=articulate)


def build_upright(
    draw: Callable[[Material, Point, Point], ModelPart],
    size: Point,
    *,
    colour: Colour | None,
    scale: float,
    seed: int,
) -> ArticulatedModel:
    """Make a checked solid that stands on the ground: full extents `size`, m."""
    middle = (0.0, 0.0, 0.5 * size[2])
    return ArticulatedModel([draw(_checks(colour, seed), middle, size)], scale=scale)


def build_pyramid(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a stepped pyramid, 14 m high, of sandstone; `colour` is its stone."""
    blocks = brick(colour if colour is not None else (0.55, 0.43, 0.25), scale=0.25)
    steps, tall = 10, 1.4
    parts = []
    for index in range(steps):
        wide = 22.0 * (steps - index) / steps
        parts.append(box(blocks, (0.0, 0.0, (index + 0.5) * tall), (wide, wide, tall)))
    return ArticulatedModel(parts, scale=scale)


def build_crate(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a cardboard box closed with tape, 0.5 m; `colour` is its card."""
    card = cloth(colour if colour is not None else (0.38, 0.23, 0.11))
    tape, ink = Material((0.60, 0.48, 0.30)), Material((0.12, 0.07, 0.04))
    parts = [
        box(card, (0.0, 0.0, 0.20), (0.50, 0.60, 0.40)),
        box(tape, (0.0, 0.0, 0.20), (0.08, 0.61, 0.41)),
        box(ink, (0.0, 0.0, 0.20), (0.505, 0.20, 0.10)),
    ]
    return ArticulatedModel(parts, scale=scale)


def build_wheel(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a lone car wheel, 0.7 m, that rolls; `colour` is a stripe across its rim."""
    stripe = Material(colour if colour is not None else WHITE)
    wheel = Wheel((0.0, 0.0, 0.35), 0.35, 0.22)

    def articulate(pose: Pose) -> list[ModelPart]:
        mark = [box(stripe, (0.0, 0.0, 0.16), (0.07, 0.25, 0.10))]
        turned = moved(mark, compose(shift(z=0.35), turn_y(pose.distance_m / 0.35)))
        return [*car_wheels([wheel], pose.distance_m), *turned]

    return ArticulatedModel([], scale=scale, articulate=articulate)


def _checks(colour: Colour | None, seed: int) -> Material:
    hue = paint(colour, seed, "colour", _HUES)
    return checked(hue, shade(hue, 0.45), 2.0)


NOUNS = (
    Noun("sphere", build_sphere, "ground", 1.5, "roll", ("orb",)),
    fixed_noun("cube", partial(build_upright, box, (0.8, 0.8, 0.8)), ()),
    fixed_noun(
        "cylinder",
        partial(build_upright, post, (0.7, 0.7, 1.0)),
    ),
    fixed_noun("cone", partial(build_upright, peak, (0.9, 0.9, 1.0))),
    fixed_noun("pyramid", build_pyramid),
    fixed_noun("box", build_crate, ("package", "parcel", "cardboard box", "carton")),
    Noun("wheel", build_wheel, "ground", 2.5, "roll", ("car wheel", "tyre", "tire")),
)
