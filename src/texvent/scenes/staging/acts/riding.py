"""Who rides what, and where seat, hands and feet are then."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.people.posture import BOARD_STANCE
from texvent.scenes.models.people.props import PROPS
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.support_surface import find_support, top_heights
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import Performed
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.trajectories.trajectory import Riding, Trajectory, Vector


@dataclass(frozen=True)
class Mount:
    """How something is ridden."""

    style: str
    """"straddle", "board" (standing sideways), "ski", "stand" (hands on a bar), "sit" or
    "built-in" (its model brings a rider)."""


_BOARDS = ("skateboard", "surfboard", "snowboard")
MOUNTS: Mapping[str, Mount] = MappingProxyType(
    {
        **{noun: Mount("straddle") for noun in (
            "horse", "donkey", "camel", "elephant", "zebra", "cow", "giraffe", "pig", "sheep",
            "goat", "ostrich", "dog", "lion", "tiger", "bear", "polar bear", "deer", "wolf",
            "dolphin", "whale", "shark", "turtle", "dinosaur", "rhino", "hippo", "kangaroo",
            "eagle", "crocodile")},
        **{noun: Mount("board") for noun in _BOARDS},
        **{noun: Mount("built-in") for noun in ("bicycle", "motorcycle")},
        "scooter": Mount("stand"),
        "ski": Mount("ski"),
    }
)  # fmt: skip
"""Noun → how it is ridden; anything else is sat on."""


@dataclass(frozen=True)
class Seats:
    """Where people sit in one kind of vehicle."""

    places: tuple[Vector, ...]
    """Seats in the model's coordinates at its usual size, m; the first is for who steers."""
    side_m: float = 0.0
    """How far aside the feet are of who sits astride; 0 = on a bench."""
    drop_m: float = 0.0
    """Height of those feet above the seat."""


SEATS_OF: Mapping[str, Seats] = MappingProxyType(
    {
        "bicycle": Seats(((-0.24, 0.0, 0.92), (-0.66, 0.0, 0.80)), 0.24, -0.44),
        "motorcycle": Seats(
            ((-0.30, 0.0, 0.80), (-0.66, 0.0, 0.86), (-1.0, 0.0, 0.88)), 0.26, -0.46
        ),
        "tractor": Seats(((-0.80, 0.0, 1.66),)),
        "excavator": Seats(((0.35, 0.62, 2.02),)),
        "forklift": Seats(((-0.35, 0.0, 1.12),)),
        "golf cart": Seats(((-0.30, 0.26, 0.76), (-0.05, -0.26, 0.76))),
        "stroller": Seats(((-0.08, 0.0, 0.52),)),
        "wheelchair": Seats(((-0.05, 0.0, 0.52),)),
        "shopping cart": Seats(((0.05, 0.0, 0.46),)),
        "snowmobile": Seats(((-0.35, 0.0, 0.72), (-0.82, 0.0, 0.72)), 0.30, -0.40),
        "boat": Seats(((-1.35, 0.40, 0.66), (-1.35, -0.40, 0.66), (-2.1, 0.40, 0.66),
                       (-2.1, -0.40, 0.66))),
        "sailboat": Seats(((-1.6, 0.0, 0.67), (-0.9, 0.35, 0.67), (-0.9, -0.35, 0.67),
                           (-2.2, 0.0, 0.67))),
        "airplane": Seats(((11.0, 0.4, -0.2), (11.0, -0.4, -0.2))),
        "helicopter": Seats(((1.2, 0.4, -0.4), (1.2, -0.4, -0.4))),
        **{noun: Seats(((0.35, 0.38, 0.40), (0.35, -0.38, 0.40), (-0.5, 0.38, 0.40),
                        (-0.5, -0.38, 0.40))) for noun in ("car", "taxi", "police car")},
        "open car": Seats(((0.15, 0.38, 0.72), (0.15, -0.38, 0.72), (-0.72, 0.38, 0.72),
                           (-0.72, -0.38, 0.72))),
        **{noun: Seats(((0.6, 0.42, 0.70), (0.6, -0.42, 0.70), (-0.3, 0.42, 0.70),
                        (-0.3, -0.42, 0.70))) for noun in ("suv", "van")},
        "pickup": Seats(((0.35, 0.42, 0.60), (0.35, -0.42, 0.60))),
        "truck": Seats(((2.6, 0.45, 1.5), (2.6, -0.45, 1.5))),
        "fire engine": Seats(((2.6, 0.5, 1.4), (2.6, -0.5, 1.4))),
        "bus": Seats(tuple((4.4 - 0.9 * row, side, 1.3) for row in range(10)
                           for side in (0.6, -0.6))),
        "train": Seats(tuple((12.0 - 0.9 * row, side, 1.8) for row in range(12)
                             for side in (0.7, -0.7))),
    }
)  # fmt: skip
"""Noun → seats in or on it; riders of closed vehicles are not seen."""
LOADS: Mapping[str, Vector] = MappingProxyType(
    {
        "forklift": (1.05, 0.0, 0.27), "pickup": (-1.75, 0.0, 1.0), "golf cart": (-0.95, 0.0, 0.58),
        "snowmobile": (-1.15, 0.0, 0.72), "boat": (1.5, 0.0, 0.72), "canoe": (-1.3, 0.0, 0.36),
        "stroller": (0.0, 0.0, 0.42), "shopping cart": (0.05, 0.0, 0.52),
    }
)  # fmt: skip
"""Noun → where it carries things, m in the model's coordinates at its usual size."""
CLOSED = frozenset({"car", "suv", "taxi", "police car", "van", "bus", "truck", "train", "pickup",
                    "fire engine", "airplane", "helicopter"})  # fmt: skip
"""Vehicles that hide who is in them."""
PADDLED = frozenset({"canoe", "kayak", "rowing boat"})
"""Narrow boats in which one sits low and paddles."""
_BACK_SHARE = 0.42
"""Share of an animal's length on which people sit."""
_ASTRIDE_M, _BOARD_M = 0.42, 0.70
"""Room for who sits astride, or stands sideways on a board, m."""
_APART_M, _LEAST_APART_M, _LAP_M, _SEAT_M = 0.85, 0.40, 0.5, 0.62
"""From seat to seat, usually and at least, room for the last one's lap, a seat's width, m."""
_ASIDE = 0.8
"""How far the second of two abreast sits ahead, so that both are seen, in half widths."""
_LOW_SEAT_M = 0.30
"""Height of the surface over the origin of who sits low, m."""


def count_seats(ridden: Actor) -> int:
    """How many people it carries, the one who comes with its model among them."""
    name, model = ridden.noun.name, ridden.model
    if name in SEATS_OF:
        return len(SEATS_OF[name].places)
    style = MOUNTS.get(name, Mount("sit")).style
    if style in ("stand", "ski"):
        return 1
    if style == "board":
        return max(1, int(model.length / _BOARD_M))
    if style == "straddle":
        return max(1, int(_BACK_SHARE * model.length / _ASTRIDE_M))
    long, columns = _room(ridden)
    return columns * (1 + int(max(long - _LAP_M, 0.0) / _LEAST_APART_M))


def mount(rider: Actor, ridden: Actor, number: int = 0, crew: int = 1) -> Actor:
    """The rider, on what it rides.

    Args:
        rider: who rides.
        ridden: what it rides.
        number: of its seat, from 0; the first one is for who steers.
        crew: how many are on it.

    Returns:
        The rider in its seat; where it was if there is none left.
    """
    if number >= count_seats(ridden):
        return rider
    style = MOUNTS.get(ridden.noun.name, Mount("sit")).style
    size = size_of(rider.model)
    path: Trajectory
    if not is_person(rider):
        height = find_support(ridden.model).height
        lift = 0.5 * rider.model.height if rider.is_centred else 0.0
        path = Riding(ridden.trajectory, (0.0, 0.0, height + lift))
        return replace(rider, trajectory=path, is_mover=ridden.is_mover, lead_m=0.0)
    if ridden.noun.name in SEATS_OF:
        return _sit_in_cab(rider, ridden, number)
    if style == "board":
        along = (0.5 * (crew - 1) - number) * _BOARD_M
        top = find_support(ridden.model).height - BOARD_STANCE * size
        path = Riding(ridden.trajectory, (along, 0.0, top), "skate")
        return replace(rider, trajectory=path, is_mover=ridden.is_mover, props=())
    if style == "ski":
        path = Riding(ridden.trajectory, (0.0, 0.0, 0.0), "ski")
        return replace(rider, trajectory=path, is_mover=ridden.is_mover, props=())
    if style == "stand":
        path = Riding(ridden.trajectory, (-0.08, 0.0, 0.1 * ridden.model.height), "stand")
        bar = 0.9 * ridden.model.height
        grips = tuple(
            (f"{name} hand", (0.42 * ridden.model.length, side * 0.2, bar))
            for name, side in (("left", 1.0), ("right", -1.0))
        )
        gripped = Performed(path, None, grips)
        return replace(rider, trajectory=gripped, is_mover=ridden.is_mover, props=())
    if ridden.noun.name in PADDLED:
        return _paddle(rider, ridden, number, crew)
    if style == "straddle":
        seat, grips = _straddle(ridden, size, number, crew)
    else:
        seat, grips = _sit(ridden, size, number, crew)
    path = Riding(ridden.trajectory, seat, "sit")
    return replace(
        rider, trajectory=Performed(path, "sit", grips), is_mover=ridden.is_mover, lead_m=0.0
    )


def _sit_in_cab(rider: Actor, ridden: Actor, number: int) -> Actor:
    """In a seat of the table: on the saddle behind the rider, or in the cab."""
    seats, size, scale = SEATS_OF[ridden.noun.name], size_of(rider.model), size_of(ridden.model)
    x, y, z = (scale * value for value in seats.places[number])
    low = z - 0.42 * size if seats.side_m == 0.0 else z - 0.10 * size
    grips = _astride(seats.side_m, seats.drop_m, size) if seats.side_m else ()
    path = Performed(Riding(ridden.trajectory, (x, y, low), "sit"), "sit", grips)
    return replace(rider, trajectory=path, is_mover=ridden.is_mover, lead_m=0.0, props=())


def _paddle(rider: Actor, ridden: Actor, number: int, crew: int) -> Actor:
    """Low in a narrow boat, with a paddle where the boat moves."""
    x, y = _row_of_seats(ridden, crew)[number]
    seat = (x, y, find_support(ridden.model).height - _LOW_SEAT_M * size_of(rider.model))
    activity = "row oars" if ridden.noun.name == "rowing boat" else "row"
    path = Riding(ridden.trajectory, seat, activity)
    props = PROPS.get(activity, ()) if ridden.is_mover else ()
    return replace(rider, trajectory=path, is_mover=ridden.is_mover, lead_m=0.0, props=props)


def _straddle(
    ridden: Actor, size: float, number: int, crew: int
) -> tuple[Vector, tuple[tuple[str, Vector], ...]]:
    """On the back, a leg on each side, hands ahead; the next one sits behind."""
    model = ridden.model
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    along = (0.5 * (min(crew, count_seats(ridden)) - 1) - number) * _ASTRIDE_M
    back = float(top_heights(parts, np.array([along]), np.array([0.0]))[0])
    if not np.isfinite(back):
        back = 0.5 * model.height
    half = _half_width(ridden, back)
    side = min(half + 0.07 * size, 0.45 * size)
    drop = -0.66 * size if half < 0.45 * size else -0.35 * size
    return (along, 0.0, back), _astride(side, drop, size)


def _astride(side: float, drop: float, size: float) -> tuple[tuple[str, Vector], ...]:
    """Hips, feet and hands of who has a leg on each side."""
    return (
        ("hips", (0.0, 0.0, 0.10 * size)),
        ("left foot", (0.14 * size, side, drop)),
        ("right foot", (0.14 * size, -side, drop)),
        ("left hand", (0.40 * size, 0.10 * size, 0.30 * size)),
        ("right hand", (0.40 * size, -0.10 * size, 0.30 * size)),
    )


def _half_width(ridden: Actor, back: float) -> float:
    """Half the width of the trunk below the seat, m."""
    parts = ridden.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    across = np.linspace(0.0, 0.5 * ridden.model.width, 24)
    tops = top_heights(parts, np.zeros_like(across), across)
    inside = across[tops > 0.6 * back]
    return float(inside.max()) if inside.size else 0.2


def _sit(
    ridden: Actor, size: float, number: int, crew: int
) -> tuple[Vector, tuple[tuple[str, Vector], ...]]:
    """On its level surface, in a row or in two."""
    x, y = _row_of_seats(ridden, crew)[number]
    return (x, y, find_support(ridden.model).height - 0.42 * size), ()


def _row_of_seats(ridden: Actor, crew: int) -> list[tuple[float, float]]:
    """Places x, y of those who sit behind each other, or two abreast where it is wide."""
    middle_x, middle_y = find_support(ridden.model).middle
    if crew <= 1:
        return [(middle_x, middle_y)]
    long, columns = _room(ridden)
    rows = math.ceil(crew / columns)
    step = min(_APART_M, (long - _LAP_M) / max(rows - 1, 1))
    side = 0.0 if columns == 1 else 0.5 * _SEAT_M
    return [
        (
            middle_x + (0.5 * (rows - 1) - seat // columns) * step + _ASIDE * side * (seat % 2),
            middle_y + side * (1.0 - 2.0 * (seat % 2)),
        )
        for seat in range(crew)
    ]


def _room(ridden: Actor) -> tuple[float, int]:
    """Length of the surface people sit on, m, and how many sit abreast."""
    support, model = find_support(ridden.model), ridden.model
    long = max(support.high[0] - support.low[0], 0.6 * model.length)
    wide = max(support.high[1] - support.low[1], 0.6 * model.width)
    return long, 2 if wide > 2.0 * _SEAT_M else 1
