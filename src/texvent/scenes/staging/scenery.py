"""What stands around: trees along a road, houses in a city, pines on a mountain.

Scenery never stands between the camera and the things of the prompt, on the road, or in
another's place; nouns that the prompt excludes are left out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from texvent.scenes.model import Colour, Model, Noun, Pose
from texvent.scenes.primitives import Camera, Float64Array
from texvent.scenes.staging.actors import Actor
from texvent.scenes.staging.assemble import Placed
from texvent.scenes.staging.motion import State


@dataclass(frozen=True)
class Planting:
    """So many of one noun, in a band of distances from the camera."""

    noun: str
    count: int
    near: float
    """Nearest distance, in camera distances behind what the camera looks at."""
    far: float
    scale: tuple[float, float] = (0.8, 1.2)
    colours: tuple[Colour | None, ...] = (None,)
    fits_view: bool = False
    """Whether its size follows the camera distance, so that it neither towers nor vanishes."""
    is_metres: bool = False
    """Whether `near` and `far` are metres from the camera instead."""


@dataclass(frozen=True)
class View:
    """What scenery must keep clear of."""

    cameras: Sequence[Camera]
    """The camera at some instants."""
    points: Sequence[Float64Array]
    """[n, 3] what it must see at those instants, m."""
    distance_m: float
    road_half_width: float | None
    """Half width of the strip to keep free, m; None = no road."""
    road_angle: float
    road_offset: tuple[float, float]
    room_m: float = math.inf


_PINK: Colour = (0.75, 0.25, 0.30)
_CORAL: tuple[Colour, ...] = (_PINK, (0.80, 0.40, 0.12), (0.55, 0.20, 0.50), (0.75, 0.65, 0.20))
_DRY: Colour = (0.25, 0.22, 0.06)

_MOUNTAINS = Planting("mountain", 7, 190.0, 330.0, (0.9, 1.5), is_metres=True)

PLANTINGS: dict[str, tuple[Planting, ...]] = {
    "road": (
        Planting("house", 1, 1.6, 2.6, (1.0, 1.2)),
        Planting("tree", 5, 0.5, 3.5, (0.8, 1.3)),
        Planting("bush", 6, 0.25, 2.0, (0.6, 1.1)),
    ),
    "dirt road": (Planting("bush", 7, 0.2, 2.0, (0.5, 1.1)), Planting("tree", 4, 0.7, 3.0),
                  Planting("rock", 5, 0.2, 2.0, (0.4, 1.0))),
    "city": (
        Planting("street lamp", 4, 0.2, 1.5, (1.0, 1.0)),
        Planting("building", 7, 0.9, 3.5, (0.45, 0.9)),
        Planting("tree", 3, 0.3, 1.0, (0.6, 0.8)),
    ),
    "grass": (
        Planting("bush", 5, 0.6, 3.0, (0.6, 1.2)),
        Planting("tree", 5, 1.0, 4.0),
        Planting("flower", 8, 0.1, 0.8, (0.8, 1.3)),
    ),
    "savanna": (
        Planting("tree", 5, 1.2, 4.5, (0.9, 1.3)),
        Planting("bush", 9, 0.4, 3.0, (0.4, 0.9), (_DRY,)),
    ),
    "forest": (
        Planting("pine", 12, 0.25, 3.0, (0.8, 1.4)),
        Planting("tree", 8, 0.35, 2.5, (0.9, 1.4)),
        Planting("bush", 5, 0.2, 1.0, (0.5, 1.0)),
    ),
    "underwater": (
        Planting("rock", 6, 0.2, 1.4, (0.5, 1.5), fits_view=True),
        Planting("bush", 8, 0.15, 1.2, (0.3, 0.8), _CORAL, fits_view=True),
    ),
    "sand": (Planting("palm", 3, 0.7, 2.5), Planting("rock", 4, 0.3, 2.0, (0.4, 1.0))),
    "snow": (Planting("pine", 8, 0.7, 3.5, (0.7, 1.2)),),
    "mountain": (
        _MOUNTAINS,
        Planting("pine", 10, 0.6, 3.5, (0.7, 1.2)),
        Planting("rock", 5, 0.2, 1.5, (0.4, 1.2)),
    ),
    "construction site": (
        Planting("barrier", 3, 0.25, 0.8, (1.0, 1.0)),
        Planting("building frame", 1, 0.9, 1.4, (1.0, 1.0)),
        Planting("box", 4, 0.3, 1.0, (0.8, 1.4)),
    ),
}  # fmt: skip
"""Place → what stands around there."""

BACKDROPS: dict[str, tuple[Planting, ...]] = {
    "mountain": (_MOUNTAINS,
                 Planting("pine", 6, 0.8, 3.0, (0.8, 1.2))),
    "forest": PLANTINGS["forest"],
    "city": PLANTINGS["city"],
}  # fmt: skip

_USUAL_DISTANCE_M = 16.0
ATTEMPTS = 40
"""Places tried for each piece before it is left out."""


@dataclass(frozen=True)
class Piece:
    """One piece of scenery; it stands still."""

    noun: str
    model: Model
    position: tuple[float, float]
    yaw: float

    @property
    def radius_m(self) -> float:
        """Of the ground it stands on."""
        return 0.5 * max(self.model.length, self.model.width)

    def place(self, instance: int) -> Placed:
        """Its parts in the world."""
        state = State((*self.position, 0.0), self.yaw, activity="stand")
        parts = self.model.parts(Pose(0.0, 0.0, 0.0, "stand"))
        return Placed(parts, state.to_world(), instance)


def plant(
    plantings: Sequence[Planting],
    view: View,
    actors: Sequence[Actor],
    nouns: Mapping[str, Noun],
    *,
    rng: np.random.Generator,
    taken: Sequence[Piece] = (),
) -> list[Piece]:
    """Scatter scenery where the camera sees it and it is in nobody's way.

    Args:
        plantings: what, how many and how far.
        view: the camera over the clip, and what it must see.
        actors: the things of the prompt.
        nouns: table of models; a noun that is missing is left out.
        rng: decides places, sizes and turns.
        taken: scenery that stands already.

    Returns:
        The pieces that found a place; fewer than asked for where it is crowded.
    """
    pieces = list(taken)
    bodies = _list_bodies(actors)
    for planting in plantings:
        noun = nouns.get(planting.noun)
        if noun is None:
            continue
        for number in range(planting.count):
            colour = planting.colours[number % len(planting.colours)]
            model = noun.build(
                colour=colour,
                scale=float(rng.uniform(*planting.scale)) * _fit_scale(planting, view),
                seed=int(rng.integers(2**31)),
            )
            piece = _find_place(planting, model, view, bodies, pieces, rng)
            if piece is not None:
                pieces.append(piece)
    return pieces[len(taken) :]


def _fit_scale(planting: Planting, view: View) -> float:
    if not planting.fits_view:
        return 1.0
    return min(max(view.distance_m / _USUAL_DISTANCE_M, 0.15), 1.5)


def _list_bodies(actors: Sequence[Actor]) -> Float64Array:
    """[n, 3]: x, y and radius of the actors at some instants, m."""
    rows = []
    for actor in actors:
        radius = 0.5 * max(actor.model.length, actor.model.width)
        for time_s in np.linspace(0.0, 2.0, 5):
            x, y, _ = actor.middle(float(time_s))
            rows.append((x, y, radius))
    return np.array(rows, dtype=np.float64).reshape(-1, 3)


def _find_place(
    planting: Planting,
    model: Model,
    view: View,
    bodies: Float64Array,
    pieces: Sequence[Piece],
    rng: np.random.Generator,
) -> Piece | None:
    for _ in range(ATTEMPTS):
        camera = view.cameras[int(rng.integers(len(view.cameras)))]
        share = float(rng.uniform(-0.62, 0.62))
        reach = _draw_reach(planting, camera, view, rng)
        forward = camera.rotation[2, :2]
        forward = forward / max(float(np.hypot(*forward)), 1e-9)
        right = np.array([forward[1], -forward[0]])
        spot = camera.position[:2] + reach * (forward + share / camera.focal * right)
        piece = Piece(
            planting.noun, model, (float(spot[0]), float(spot[1])), _face(planting, view, rng)
        )
        if _is_free(piece, view, bodies, pieces):
            return piece
    return None


def _draw_reach(planting: Planting, camera: Camera, view: View, rng: np.random.Generator) -> float:
    """Metres over the ground from the camera, no further than the top of the picture shows."""
    if planting.is_metres:
        return float(rng.uniform(planting.near, planting.far))
    pitch = -float(camera.rotation[2, 2])
    flat = view.distance_m * math.cos(math.asin(min(max(pitch, -1.0), 1.0)))
    near, far = planting.near, planting.far
    top = math.asin(min(max(pitch, -1.0), 1.0)) - math.atan(0.33 / camera.focal)
    if top > 0.02:
        seen = float(camera.position[2]) / math.tan(top) / max(flat, 1e-6) - 1.0
        if far > seen:
            near, far = min(near, 0.1 - 0.8 * seen), seen
    return flat * (1.0 + float(rng.uniform(near, far)))


def _face(planting: Planting, view: View, rng: np.random.Generator) -> float:
    """Street furniture and houses stand square to the road; the rest as it grows."""
    if planting.noun in ("building", "house", "barrier", "street lamp", "building frame"):
        return view.road_angle - 0.5 * math.pi
    return float(rng.uniform(0.0, 2.0 * math.pi))


def _is_free(piece: Piece, view: View, bodies: Float64Array, pieces: Sequence[Piece]) -> bool:
    spot, radius = np.array(piece.position), piece.radius_m
    if view.road_half_width is not None:
        offset = spot - np.array(view.road_offset)
        across = offset[1] * math.cos(view.road_angle) - offset[0] * math.sin(view.road_angle)
        if abs(across) < view.road_half_width + radius + 0.4:
            return False
    if np.max(np.abs(spot)) + radius > view.room_m:
        return False
    if len(bodies) and np.any(np.hypot(*(bodies[:, :2] - spot).T) < bodies[:, 2] + radius + 0.4):
        return False
    for other in pieces:
        if np.hypot(*(spot - other.position)) < 0.8 * (radius + other.radius_m):
            return False
    return not _hides(spot, radius, view)


def _hides(spot: Float64Array, radius: float, view: View) -> bool:
    """Whether a round thing there stands before something the camera must see."""
    for camera, points in zip(view.cameras, view.points, strict=True):
        start = camera.position[:2]
        if np.hypot(*(spot - start)) < radius + 1.0:
            return True
        if len(points) == 0:
            continue
        rays = points[:, :2] - start
        lengths = np.maximum(np.hypot(rays[:, 0], rays[:, 1]), 1e-9)
        along = np.clip((rays @ (spot - start)) / lengths**2, 0.0, 1.0)
        nearest = start + along[:, None] * rays
        if np.any(np.hypot(*(nearest - spot).T) < radius + 0.15):
            return True
    return False
