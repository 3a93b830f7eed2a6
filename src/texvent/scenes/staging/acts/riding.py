"""Who rides what, and where seat, hands and feet are then."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np

from texvent.scenes.models.people.sports import BOARD_STANCE
from texvent.scenes.models.protocol import Pose
from texvent.scenes.models.support_surface import find_support, top_heights
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.acts.attached import Performed
from texvent.scenes.staging.acts.holding import is_person, size_of
from texvent.scenes.staging.trajectories.trajectory import Riding, Vector


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


def mount(rider: Actor, ridden: Actor) -> Actor:
    """The rider, on what it rides."""
    style = MOUNTS.get(ridden.noun.name, Mount("sit")).style
    size = size_of(rider.model)
    if not is_person(rider):
        height = find_support(ridden.model).height
        lift = 0.5 * rider.model.height if rider.is_centred else 0.0
        path = Riding(ridden.trajectory, (0.0, 0.0, _above_origin(ridden, height) + lift))
        return replace(rider, trajectory=path, is_mover=ridden.is_mover, lead_m=0.0)
    if style == "board":
        top = find_support(ridden.model).height - BOARD_STANCE * size
        path = Riding(ridden.trajectory, (0.0, 0.0, _above_origin(ridden, top)), "skate")
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
    seat, grips = (_straddle if style == "straddle" else _sit)(ridden, size)
    path = Riding(ridden.trajectory, (seat[0], seat[1], _above_origin(ridden, seat[2])), "sit")
    return replace(
        rider, trajectory=Performed(path, "sit", grips), is_mover=ridden.is_mover, lead_m=0.0
    )


def _above_origin(ridden: Actor, height: float) -> float:
    """A height in the model's coordinates, which are centred for what flies or swims."""
    return height


def _straddle(ridden: Actor, size: float) -> tuple[Vector, tuple[tuple[str, Vector], ...]]:
    """On the back, a leg on each side, hands ahead."""
    model = ridden.model
    parts = model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    back = float(top_heights(parts, np.array([0.0]), np.array([0.0]))[0])
    if not np.isfinite(back):
        back = 0.5 * model.height
    half = _half_width(ridden, back)
    hips = 0.10 * size
    side = min(half + 0.07 * size, 0.45 * size)
    drop = -0.66 * size if half < 0.45 * size else -0.35 * size
    grips = (
        ("hips", (0.0, 0.0, hips)),
        ("left foot", (0.14 * size, side, drop)),
        ("right foot", (0.14 * size, -side, drop)),
        ("left hand", (0.40 * size, 0.10 * size, 0.30 * size)),
        ("right hand", (0.40 * size, -0.10 * size, 0.30 * size)),
    )
    return (0.0, 0.0, back), grips


def _half_width(ridden: Actor, back: float) -> float:
    """Half the width of the trunk below the seat, m."""
    parts = ridden.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
    across = np.linspace(0.0, 0.5 * ridden.model.width, 24)
    tops = top_heights(parts, np.zeros_like(across), across)
    inside = across[tops > 0.6 * back]
    return float(inside.max()) if inside.size else 0.2


def _sit(ridden: Actor, size: float) -> tuple[Vector, tuple[tuple[str, Vector], ...]]:
    support = find_support(ridden.model)
    x, y = support.middle
    return (x, y, support.height - 0.42 * size), ()
