"""Cars: sedan, taxi, police car, SUV, van and pickup from one table of proportions."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from texvent.scenes.models.articulated_model import ArticulatedModel
from texvent.scenes.models.materials import (
    BLACK,
    CAR_COLOURS,
    DARK,
    GLASS,
    GREY,
    HEADLIGHT,
    STEEL,
    TAILLIGHT,
    WHITE,
    YELLOW,
    Material,
    checked,
    shade,
)
from texvent.scenes.models.protocol import ModelPart, Noun, Pose
from texvent.scenes.models.shapes import ball, box, rod
from texvent.scenes.models.variation import paint
from texvent.scenes.models.vehicles.wheels import Wheel, car_wheels
from texvent.scenes.scene import Colour


@dataclass(frozen=True)
class CarShape:
    """Proportions of a car in its side view; x forward from the middle, m."""

    length: float
    width: float
    height: float
    belt: float
    """Height of the lower edge of the windows."""
    hood: float
    """Height of the bonnet."""
    cabin: tuple[float, float, float, float]
    """x of the windscreen's foot and top, of the rear window's top and foot."""
    wheel_radius: float = 0.34
    axle: float = 1.35
    """Distance of the axles from the middle."""
    clearance: float = 0.24
    extra: str = ""
    """What it carries: "rack", "taxi", "police", "bed"; "open": it has no roof."""
    colours: tuple[Colour, ...] = CAR_COLOURS


SEDAN = CarShape(4.4, 1.75, 1.45, 0.90, 0.80, (1.05, 0.35, -0.85, -1.60))
OPEN_CAR = CarShape(4.4, 1.75, 1.15, 0.90, 0.76, (1.05, 0.85, -0.95, -1.15), extra="open")
TAXI = CarShape(
    4.5, 1.78, 1.50, 0.90, 0.82, (1.05, 0.35, -0.95, -1.65), extra="taxi", colours=(YELLOW,)
)
POLICE = CarShape(
    4.5, 1.78, 1.48, 0.90, 0.82, (1.05, 0.35, -0.95, -1.65), extra="police", colours=(WHITE,)
)
SUV = CarShape(
    4.6, 1.92, 1.80, 1.12, 1.08, (0.95, 0.50, -1.95, -2.22), 0.41, 1.40, 0.34, extra="rack"
)
VAN = CarShape(
    4.9, 1.95, 2.15, 1.25, 1.10, (1.95, 1.25, -2.30, -2.40), 0.36, 1.55, 0.26,
    colours=(WHITE, (0.55, 0.56, 0.58), (0.05, 0.16, 0.42)),
)  # fmt: skip
PICKUP = CarShape(
    5.3, 1.95, 1.80, 1.12, 1.05, (1.25, 0.70, -0.50, -0.65), 0.41, 1.65, 0.36, extra="bed"
)


def build_car(
    shape: CarShape, *, colour: Colour | None, scale: float, seed: int
) -> ArticulatedModel:
    """Make a car; `colour` is its paint."""
    body = Material(paint(colour, seed, "paint", shape.colours))
    rigid = [*_body(shape, body), *_cabin(shape, body), *_lights(shape), *_carried(shape, body)]
    side = 0.5 * shape.width - 0.10
    wheels = [
        Wheel((x, y, shape.wheel_radius), shape.wheel_radius, 0.24)
        for x in (shape.axle, -shape.axle)
        for y in (side, -side)
    ]

    def articulate(pose: Pose) -> list[ModelPart]:
        return [*car_wheels(wheels, pose.distance_m), *_beacons(shape, pose.time_s)]

    return ArticulatedModel(rigid, scale=scale, articulate=articulate)


def _body(shape: CarShape, body: Material) -> list[ModelPart]:
    middle_z = 0.5 * (shape.hood + shape.clearance)
    trim = Material(shade(GREY, 0.35))
    parts = [
        box(body, (0.0, 0.0, middle_z), (shape.length - 0.16, shape.width, 0.62 * shape.hood)),
        box(
            body,
            (0.0, 0.0, 0.5 * (shape.hood + shape.clearance + 0.1)),
            (shape.length - 0.30, shape.width - 0.06, shape.hood - shape.clearance - 0.1),
        ),
        box(trim, (0.0, 0.0, shape.clearance + 0.10), (shape.length, shape.width - 0.08, 0.20)),
    ]
    arch = shape.wheel_radius * 1.10
    for x in (shape.axle, -shape.axle):
        reach = 0.5 * shape.width + 0.006
        z = shape.wheel_radius * 1.14
        parts.append(rod(DARK, (x, -reach, z), (x, reach, z), arch))
    return parts


def _cabin(shape: CarShape, body: Material) -> list[ModelPart]:
    """Two slanted glass boxes make a trapezium; a roof and pillars of body colour frame it."""
    foot_front, top_front, top_rear, foot_rear = shape.cabin
    low, high = shape.hood - 0.02, shape.height - 0.06
    rise, middle = high - low, 0.5 * (low + high)
    width = shape.width - 0.22
    if shape.extra == "open":
        return _open_cabin(shape, body)
    depth = max(top_front - top_rear, 0.52 * (foot_front - foot_rear))
    front_lean = (top_front - foot_front) / rise
    rear_lean = (top_rear - foot_rear) / rise
    front_x = 0.5 * (foot_front + top_front)
    rear_x = 0.5 * (foot_rear + top_rear)
    wide = width + 0.03
    belt = 0.5 * (low + shape.belt)
    post_x = 0.5 * (top_front + top_rear) + 0.05
    return [
        box(GLASS, (front_x - 0.5 * depth, 0.0, middle), (depth, width, rise), lean=front_lean),
        box(GLASS, (rear_x + 0.5 * depth, 0.0, middle), (depth, width, rise), lean=rear_lean),
        box(
            body,
            (0.5 * (top_front + top_rear), 0.0, high + 0.02),
            (top_front - top_rear + 0.10, width + 0.04, 0.10),
        ),
        box(body, (front_x - 0.08, 0.0, middle), (0.10, wide, rise), lean=front_lean),
        box(body, (rear_x + 0.14, 0.0, middle), (0.24, wide, rise), lean=rear_lean),
        box(body, (post_x, 0.0, middle), (0.10, wide, rise)),
        box(
            body,
            (0.5 * (foot_front + foot_rear), 0.0, belt),
            (foot_front - foot_rear - 0.10, wide + 0.02, max(shape.belt - low, 0.02)),
        ),
    ]


def _open_cabin(shape: CarShape, body: Material) -> list[ModelPart]:
    """A windscreen in its frame, and the backs of two rows of seats."""
    foot, top, *_ = shape.cabin
    low, high, wide = shape.hood - 0.02, shape.height, shape.width - 0.3
    middle = 0.5 * (low + high)
    lean = (top - foot) / (high - low)
    frame = [
        box(body, (0.5 * (foot + top), y, middle), (0.05, 0.06, high - low), lean=lean)
        for y in (0.5 * wide, -0.5 * wide)
    ]
    backs = [
        box(DARK, (x, y, low + 0.12), (0.14, 0.5, 0.34))
        for x in (-0.02, -0.9)
        for y in (0.38, -0.38)
    ]
    return [*frame, box(body, (top, 0.0, high), (0.06, wide, 0.05)), *backs]


def _lights(shape: CarShape) -> list[ModelPart]:
    front, side, z = 0.5 * shape.length - 0.09, 0.5 * shape.width - 0.28, shape.hood - 0.16
    parts = [ball(HEADLIGHT, (front, y, z), (0.14, 0.34, 0.18)) for y in (side, -side)]
    parts += [box(TAILLIGHT, (-front, y, z), (0.06, 0.34, 0.16)) for y in (side, -side)]
    parts.append(box(DARK, (front, 0.0, z - 0.04), (0.05, shape.width - 1.0, 0.18)))
    parts.append(box(Material(WHITE), (-front - 0.01, 0.0, z - 0.16), (0.04, 0.5, 0.12)))
    return parts


def _carried(shape: CarShape, body: Material) -> list[ModelPart]:
    if shape.extra == "rack":
        return _roof_rack(shape)
    if shape.extra == "taxi":
        sign = Material(WHITE, emission=0.5)
        band = checked(BLACK, WHITE, 12.0)
        return [
            box(sign, (-0.25, 0.0, shape.height + 0.10), (0.22, 0.62, 0.16)),
            box(band, (0.0, 0.0, 0.62), (3.2, shape.width + 0.02, 0.12)),
        ]
    if shape.extra == "police":
        stripe = Material((0.02, 0.06, 0.35))
        return [box(stripe, (0.0, 0.0, 0.62), (4.1, shape.width + 0.02, 0.20))]
    if shape.extra == "bed":
        rear, side = -0.5 * shape.length + 0.10, 0.5 * shape.width - 0.06
        front = shape.cabin[3] - 0.05
        middle, length, wall_z = 0.5 * (rear + front), front - rear, shape.hood + 0.12
        return [
            box(body, (middle, side, wall_z), (length, 0.10, 0.28)),
            box(body, (middle, -side, wall_z), (length, 0.10, 0.28)),
            box(body, (rear, 0.0, wall_z), (0.10, shape.width, 0.28)),
            box(DARK, (middle, 0.0, shape.hood), (length, shape.width - 0.2, 0.04)),
        ]
    return []


def _roof_rack(shape: CarShape) -> list[ModelPart]:
    """Rails, bars and luggage, as in the paper's example of an SUV with a roof rack."""
    top, side = shape.height + 0.12, 0.5 * shape.width - 0.24
    front, rear = shape.cabin[1] - 0.20, shape.cabin[2] + 0.25
    rails = [rod(STEEL, (rear, y, top), (front, y, top), 0.035) for y in (side, -side)]
    bars = [
        rod(STEEL, (x, -side, top - 0.01), (x, side, top - 0.01), 0.030)
        for x in (front - 0.15, 0.5 * (front + rear), rear + 0.15)
    ]
    posts = [
        box(DARK, (x, y, top - 0.08), (0.10, 0.06, 0.16))
        for x in (front - 0.1, rear + 0.1)
        for y in (side, -side)
    ]
    spare = rod(
        DARK, (-0.5 * shape.length, 0.0, 0.95), (-0.5 * shape.length - 0.2, 0.0, 0.95), 0.36
    )
    return [*rails, *bars, *posts, spare]


def _beacons(shape: CarShape, time_s: float) -> list[ModelPart]:
    """A police car's two lamps, lit in turn with a smooth rise and fall."""
    if shape.extra != "police":
        return []
    z = shape.height + 0.08
    beat = 0.5 + 0.5 * _triangle(2.0 * time_s)
    left = Material((0.02, 0.08, 0.9), emission=3.0 * beat)
    right = Material((0.8, 0.02, 0.02), emission=3.0 * (1.0 - beat))
    return [
        box(left, (-0.2, 0.32, z), (0.25, 0.56, 0.14)),
        box(right, (-0.2, -0.32, z), (0.25, 0.56, 0.14)),
    ]


def _triangle(phase: float) -> float:
    """A wave of period 1 between -1 and 1."""
    return 4.0 * abs((phase % 1.0) - 0.5) - 1.0


NOUNS = (
    Noun(
        "car", partial(build_car, SEDAN), "ground", 10.0, "drive",
        ("automobile", "sedan", "auto"),
    ),
    Noun(
        "open car", partial(build_car, OPEN_CAR), "ground", 10.0, "drive",
        ("convertible", "cabriolet", "roadster"),
    ),
    Noun(
        "suv", partial(build_car, SUV), "ground", 9.0, "drive",
        ("off-roader", "four-wheel drive", "sport utility vehicle"),
    ),
    Noun("taxi", partial(build_car, TAXI), "ground", 9.0, "drive", ("cab", "taxicab")),
    Noun(
        "police car", partial(build_car, POLICE), "ground", 14.0, "drive",
        ("patrol car", "squad car", "cop car"),
    ),
    Noun("van", partial(build_car, VAN), "ground", 9.0, "drive", ("minivan",)),
    Noun(
        "pickup", partial(build_car, PICKUP), "ground", 9.0, "drive",
        ("pickup truck", "pick-up", "pick-up truck"),
    ),
)  # fmt: skip
