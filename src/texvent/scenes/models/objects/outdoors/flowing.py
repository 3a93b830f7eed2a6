"""What water flows from outdoors: a waterfall over rocks, a lawn sprinkler."""

from __future__ import annotations

from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import Material, stone
from texvent.scenes.models.objects.figures import placed, thing
from texvent.scenes.models.objects.palette import IRON
from texvent.scenes.models.protocol import ModelPart, Noun
from texvent.scenes.models.shapes import ball, box, post, rod
from texvent.scenes.models.variation import fraction, paint
from texvent.scenes.scene import Colour

_TALL, _WIDE = 6.0, 2.6
"""Height and width of the fall, m."""
_STONE: Colour = (0.30, 0.28, 0.25)
_SHEET = Material((0.52, 0.66, 0.74))


def _cliff(skin: Material, seed: int) -> list[ModelPart]:
    """Rocks behind and on both sides of the water, and the pool below."""
    rocks = [box(skin, (-1.1, 0.0, 0.5 * _TALL), (1.6, 7.0, _TALL))]
    for number in range(22):
        draw = partial(fraction, seed + number)
        side = 1.0 if number % 2 else -1.0
        y = side * (0.5 * _WIDE + 0.4 + 1.6 * draw("y"))
        z = _TALL * (0.03 + 0.97 * (number / 21.0))
        size = 0.9 + 0.9 * draw("size")
        z = max(z, 0.44 * size)
        rocks.append(ball(skin, (-0.5 + 0.5 * draw("x"), y, z), (size, 1.2 * size, 0.9 * size)))
    pool = Material((0.05, 0.16, 0.19))
    rocks.append(box(_SHEET, (-0.16, 0.0, 0.5 * _TALL), (0.1, _WIDE, _TALL)))
    return [*rocks, post(pool, (1.2, 0.0, 0.03), (4.4, 6.4, 0.06))]


def _build_waterfall(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """A cliff with a sheet of water and a pool, 6 m high; `colour` is the rock."""
    skin = stone(paint(colour, seed, "paint", (_STONE,)))
    return ArticulatedModel(_cliff(skin, seed), scale=scale)


NOUNS = (
    Noun("waterfall", _build_waterfall, "fixed", 0.0, "stand", ("cascade", "water fall"),
         place="forest"),
    *placed("grass", (
        thing("sprinkler", (IRON.colour,), lambda p: [
            post(p, (0.0, 0.0, 0.01), (0.20, 0.20, 0.02)),
            rod(p, (0.0, 0.0, 0.0), (0.0, 0.0, 0.22), 0.02),
            ball(Material((0.10, 0.30, 0.12)), (0.0, 0.0, 0.23), (0.10, 0.07, 0.06))],
            ("lawn sprinkler", "garden sprinkler", "irrigation sprinkler")),
    )),
)  # fmt: skip
"""Nouns of what water flows from."""
