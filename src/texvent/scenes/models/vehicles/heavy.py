"""Large vehicles: lorry, bus, train, tractor, fire engine."""

from __future__ import annotations

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    CHROME,
    DARK,
    GLASS,
    HEADLIGHT,
    RED,
    STEEL,
    TAILLIGHT,
    WHITE,
    YELLOW,
    Material,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun
from texvent.scenes.models.shapes import ball, box, post, rod
from texvent.scenes.models.variation import paint
from texvent.scenes.models.vehicles.wheels import Wheel, wheeled_model
from texvent.scenes.scene import Colour


def build_truck(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a lorry, 8 m, with a separate cab and a box body; `colour` is the cab."""
    cab = Material(paint(colour, seed, "cab", (RED, (0.04, 0.14, 0.42))))
    cargo = Material((0.66, 0.66, 0.63))
    rib = Material((0.50, 0.50, 0.48))
    rigid = [
        box(DARK, (-0.2, 0.0, 0.82), (7.6, 1.0, 0.28)),
        box(cargo, (-1.25, 0.0, 2.20), (5.5, 2.4, 2.5)),
        *(box(rib, (-3.4 + 1.07 * i, 0.0, 2.20), (0.10, 2.44, 2.52)) for i in range(5)),
        box(cab, (2.75, 0.0, 1.40), (1.90, 2.3, 1.30)),
        box(cab, (2.60, 0.0, 2.40), (1.60, 2.2, 0.9)),
        box(GLASS, (3.32, 0.0, 2.35), (0.50, 2.0, 0.70), lean=-0.35),
        box(GLASS, (2.80, 0.0, 2.35), (0.85, 2.26, 0.62)),
        box(DARK, (3.70, 0.0, 1.20), (0.06, 1.5, 0.55)),
        box(CHROME, (3.72, 0.0, 0.72), (0.20, 2.3, 0.26)),
        *_pair(HEADLIGHT, 3.72, 0.90, 1.05, 0.30),
        *_pair(TAILLIGHT, -4.00, 1.00, 0.90, 0.24),
    ]
    return wheeled_model(rigid, _axles((2.55, -1.9, -3.1), 1.08, 0.50), scale)


def build_fire_engine(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a fire engine, 8 m, with a ladder on the roof and a flashing lamp."""
    body = Material(colour if colour is not None else (0.60, 0.03, 0.02))
    white = Material(WHITE)
    rigid = [
        box(body, (-1.2, 0.0, 1.70), (5.4, 2.4, 2.1)),
        box(body, (2.65, 0.0, 1.65), (2.3, 2.4, 2.0)),
        box(GLASS, (2.85, 0.0, 2.15), (1.96, 2.44, 0.72)),
        box(body, (2.55, 0.0, 2.15), (0.16, 2.46, 0.74)),
        box(white, (0.0, 0.0, 1.05), (7.65, 2.43, 0.22)),
        *(box(STEEL, (-3.2 + 1.35 * i, 0.0, 1.85), (1.1, 2.43, 1.1)) for i in range(4)),
        rod(CHROME, (-4.2, 0.35, 3.05), (3.2, 0.35, 3.05), 0.06),
        rod(CHROME, (-4.2, -0.35, 3.05), (3.2, -0.35, 3.05), 0.06),
        *(box(CHROME, (-3.9 + 0.95 * i, 0.0, 3.05), (0.10, 0.7, 0.08)) for i in range(8)),
        box(DARK, (-0.5, 0.0, 2.88), (0.4, 0.9, 0.26)),
        box(CHROME, (3.84, 0.0, 0.75), (0.18, 2.4, 0.30)),
        *_pair(HEADLIGHT, 3.82, 0.90, 1.05, 0.28),
        *_pair(TAILLIGHT, -3.92, 1.00, 0.95, 0.24),
        box(Material((0.02, 0.08, 0.9), emission=1.5), (2.9, 0.0, 2.76), (0.34, 1.8, 0.20)),
    ]
    return wheeled_model(rigid, _axles((2.4, -2.2), 1.10, 0.50), scale)


def build_bus(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a city bus, 11 m, with a row of windows and two doors; `colour` is its body."""
    body = Material(paint(colour, seed, "body", (RED, YELLOW, (0.05, 0.22, 0.45))))
    white = Material(WHITE)
    rigid = [
        box(body, (0.0, 0.0, 1.05), (11.0, 2.5, 1.40)),
        box(GLASS, (0.05, 0.0, 2.20), (10.9, 2.46, 0.95)),
        box(body, (0.0, 0.0, 2.85), (11.0, 2.5, 0.45)),
        *(box(body, (-5.2 + 1.5 * i, 0.0, 2.20), (0.22, 2.50, 0.95)) for i in range(7)),
        box(white, (-0.2, 0.0, 1.62), (10.6, 2.53, 0.12)),
        box(GLASS, (4.55, -1.0, 1.55), (0.95, 0.56, 2.1)),
        box(GLASS, (-0.1, -1.0, 1.55), (1.05, 0.56, 2.1)),
        box(GLASS, (5.35, 0.0, 2.05), (0.34, 2.3, 1.3)),
        box(Material((0.9, 0.5, 0.05), emission=1.0), (5.50, 0.0, 2.88), (0.06, 1.5, 0.26)),
        box(DARK, (-1.0, 0.0, 3.12), (3.0, 1.8, 0.22)),
        *_pair(HEADLIGHT, 5.48, 0.95, 0.75, 0.30),
        *_pair(TAILLIGHT, -5.48, 1.05, 0.95, 0.26),
    ]
    return wheeled_model(rigid, _axles((3.1, -3.2), 1.16, 0.48), scale)


def build_train(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a train of an engine and two coaches, 27 m, on its own rails; `colour` is its body."""
    hue = paint(colour, seed, "body", ((0.05, 0.20, 0.42), (0.45, 0.05, 0.04), (0.05, 0.26, 0.14)))
    body, band, roof = Material(hue), Material((0.72, 0.70, 0.62)), Material(shade(hue, 0.4))
    rigid: list[ModelPart] = []
    for index, x in enumerate((9.0, 0.0, -9.0)):
        rigid += [
            box(body, (x, 0.0, 1.85), (8.4, 2.8, 2.0)),
            box(roof, (x, 0.0, 3.55), (8.2, 2.5, 0.34)),
            box(GLASS, (x, 0.0, 2.95), (7.9, 2.7, 0.85)),
            box(band, (x, 0.0, 1.90), (8.42, 2.84, 0.22)),
            *(box(body, (x - 3.9 + 2.6 * i, 0.0, 2.95), (0.55, 2.8, 0.88)) for i in range(4)),
            box(DARK, (x, 0.0, 0.70), (7.4, 1.9, 0.45)),
        ]
        if index < 2:
            rigid.append(box(DARK, (x - 4.5, 0.0, 2.1), (1.0, 1.6, 2.2)))
    rigid += [
        ball(body, (12.9, 0.0, 1.75), (3.4, 2.76, 2.3)),
        ball(GLASS, (12.7, 0.0, 2.75), (2.6, 2.5, 1.3)),
        *_pair(HEADLIGHT, 14.3, 0.75, 1.45, 0.34),
        box(STEEL, (0.0, 0.75, 0.06), (29.0, 0.14, 0.12)),
        box(STEEL, (0.0, -0.75, 0.06), (29.0, 0.14, 0.12)),
    ]
    axles = (11.4, 6.6, 2.4, -2.4, -6.6, -11.4)
    wheels = [Wheel((x, 0.0, 0.57), 0.45, 1.86) for x in axles]
    return wheeled_model(rigid, wheels, scale)


def build_tractor(*, colour: Colour | None, scale: float, seed: int) -> ArticulatedModel:
    """Make a farm tractor, 3.6 m, with large rear wheels; `colour` is its body."""
    body = Material(paint(colour, seed, "body", ((0.05, 0.28, 0.05), RED)))
    rigid = [
        box(body, (0.85, 0.0, 1.20), (1.9, 0.85, 0.70)),
        box(DARK, (1.82, 0.0, 1.20), (0.06, 0.70, 0.60)),
        box(DARK, (0.5, 0.0, 0.75), (2.2, 0.5, 0.35)),
        box(body, (-0.75, 0.0, 2.68), (1.40, 1.40, 0.16)),
        *(
            post(body, (x, y, 2.05), (0.09, 0.09, 1.15))
            for x in (-0.20, -1.30)
            for y in (0.58, -0.58)
        ),
        box(DARK, (-1.18, 0.0, 1.85), (0.10, 0.50, 0.60)),
        box(DARK, (-0.90, 0.0, 1.60), (0.50, 0.50, 0.12)),
        rod(DARK, (-0.15, 0.0, 1.50), (-0.32, 0.0, 1.86), 0.03),
        rod(DARK, (-0.32, 0.2, 1.88), (-0.32, -0.2, 1.88), 0.03),
        box(body, (-0.75, 0.0, 1.30), (1.25, 1.10, 0.50)),
        *(box(body, (-0.85, y, 1.68), (1.30, 0.44, 0.14)) for y in (0.82, -0.82)),
        post(DARK, (1.15, 0.25, 1.95), (0.12, 0.12, 0.95)),
        *_pair(HEADLIGHT, 1.84, 0.28, 1.42, 0.18),
    ]
    wheels = [
        *(Wheel((-0.85, y, 0.82), 0.82, 0.46) for y in (0.82, -0.82)),
        *(Wheel((1.25, y, 0.46), 0.46, 0.30) for y in (0.70, -0.70)),
    ]
    return wheeled_model(rigid, wheels, scale)


def _pair(material: Material, x: float, y: float, z: float, size: float) -> list[ModelPart]:
    """Two lamps."""
    return [ball(material, (x, side * y, z), (0.4 * size, size, size)) for side in (1.0, -1.0)]


def _axles(places: tuple[float, ...], side: float, radius: float) -> list[Wheel]:
    return [Wheel((x, y, radius), radius, 0.34) for x in places for y in (side, -side)]


NOUNS = (
    Noun(
        "truck", build_truck, "ground", 8.0, "drive",
        ("lorry", "delivery truck", "cargo truck"),
    ),
    Noun("bus", build_bus, "ground", 8.0, "drive"),
    Noun("train", build_train, "ground", 14.0, "drive"),
    Noun("tractor", build_tractor, "ground", 4.0, "drive", ("farm tractor",)),
    Noun("fire engine", build_fire_engine, "ground", 12.0, "drive", ("fire truck", "firetruck")),
)  # fmt: skip
