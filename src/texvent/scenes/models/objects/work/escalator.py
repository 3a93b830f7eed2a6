"""An escalator, whose steps move up between their balustrades."""

from __future__ import annotations

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import Material
from texvent.scenes.models.objects.palette import INK, YELLOW_PAINT
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import box, plank
from texvent.scenes.models.variation import paint
from texvent.scenes.scene import Colour

_STEPS, _DEEP, _RISE = 12, 0.34, 0.20
"""Steps in sight, and how deep and high one is, m."""
_STEPS_HZ = 1.6
"""Steps that pass a point each second."""
_WIDE = 1.1
_STEEL: tuple[Colour, ...] = ((0.42, 0.43, 0.45),)


def _steps(pose: Pose) -> list[ModelPart]:
    """Steps with a yellow edge; each takes the place of the next and begins again."""
    moved = (_STEPS_HZ * pose.time_s) % 1.0
    parts = []
    for number in range(_STEPS):
        share = number + moved
        x = 0.5 * _STEPS * _DEEP - share * _DEEP
        tall = max(share * _RISE, 0.02)
        tread = Material((0.20, 0.20, 0.21))
        parts.append(box(tread, (x, 0.0, 0.5 * tall), (_DEEP, _WIDE, tall)))
        edge = (x + 0.5 * _DEEP - 0.02, 0.0, tall)
        parts.append(box(YELLOW_PAINT, edge, (0.05, _WIDE, 0.02)))
    return parts


def _build_escalator(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """An escalator that runs up, 2.4 m high; `colour` is its balustrade."""
    skin = Material(paint(colour, seed, "paint", _STEEL))
    half, tall = 0.5 * _STEPS * _DEEP, _STEPS * _RISE
    rails = []
    for y in (0.62, -0.62):
        rails.append(
            plank(skin, (half + 0.2, y, 0.38), (-half, y, tall + 0.38),
                  chord=(0.0, 0.0, 0.75), thickness=(0.0, 0.06, 0.0))
        )  # fmt: skip
        rails.append(
            plank(INK, (half + 0.2, y, 0.80), (-half, y, tall + 0.80),
                  chord=(0.0, 0.0, 0.09), thickness=(0.0, 0.10, 0.0))
        )  # fmt: skip
    rails.append(box(skin, (half + 0.3, 0.0, 0.01), (0.6, 1.3, 0.02)))
    return ArticulatedModel(rails, scale=scale, articulate=_steps)


NOUNS = (
    Noun(
        "escalator", _build_escalator, "fixed", 0.0, "stand", ("moving staircase", "moving stairs"),
        ("moving stairs",), place="warehouse", is_working=True,
    ),
)  # fmt: skip
"""The escalator."""
