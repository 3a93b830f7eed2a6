"""Parts that turn: solids of revolution about an axle belong to the body that turns on it."""

import functools
import itertools

import numpy as np
from tests.scenes.every_row import for_every

from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.rendered_scene import Shape

RESTS = {
    "gear": "its shaft is fixed to its stand",
    "disco ball": "its cord hangs from the ceiling",
    "fidget spinner": "fingers hold its cap",
    "lighthouse": "its lamp shines out of a lantern that rests",
}
"""Nouns with a solid that what turns about it passes by, and why it rests."""
STEP_S = 1e-3


def parts_of(name: str) -> list[list[ModelPart]]:
    model = NOUNS[name].build(colour=None, scale=1.0, seed=3)
    return [list(model.parts(Pose(0.3 + STEP_S * k, 0.0, 0.0, "work"))) for k in range(3)]


def axle(*places: np.ndarray):
    """Direction and a point of the line that a part turns about steadily; None: it does not."""
    if np.array_equal(places[0][:, :3], places[1][:, :3]):
        return None  # as most parts of all nouns
    turns = [b[:, :3] @ np.linalg.inv(a[:, :3]) for a, b in itertools.pairwise(places)]
    rest = np.eye(3) - turns[0]
    if np.abs(rest).max() < 1e-9 or not np.allclose(*turns, atol=1e-7):
        return None
    if not np.allclose(turns[0] @ turns[0].T, np.eye(3), atol=1e-6):
        return None
    direction = np.linalg.svd(rest)[2][-1]
    shift = places[1][:, 3] - turns[0] @ places[0][:, 3]
    return direction, np.linalg.lstsq(rest, shift, rcond=None)[0]


def ends(part: ModelPart, direction: np.ndarray) -> np.ndarray:
    """Least and greatest place of a part along a direction."""
    half = part.to_body[:, :3].T @ direction
    reach = {Shape.BOX: np.abs(half).sum(), Shape.ELLIPSOID: np.linalg.norm(half)}
    reach_m = reach.get(part.shape, np.hypot(*half[:2]) + abs(half[2]))
    return part.to_body[:, 3] @ direction + reach_m * np.array([-1.0, 1.0])


def is_round(part: ModelPart, direction: np.ndarray, on_axle: np.ndarray) -> bool:
    """Whether a part is a solid of revolution about a line."""
    if part.shape in (Shape.BOX, Shape.MESH):
        return False
    axes = part.to_body[:, :3] if part.shape is Shape.ELLIPSOID else part.to_body[:, :2]
    off = np.cross(part.to_body[:, 3] - on_axle, direction)
    round_about = axes @ axes.T
    across = np.eye(3) - np.outer(direction, direction)
    size2 = np.trace(across @ round_about) / 2.0
    is_even = np.allclose(across @ round_about @ across, size2 * across, atol=1e-3 * size2)
    leans = np.linalg.norm(across @ round_about @ direction) > 1e-3 * size2
    return bool(np.linalg.norm(off) < 1e-3 * np.sqrt(size2) and is_even and not leans)


def hides(part: ModelPart, other: ModelPart) -> bool:
    """Whether the corners of another part are inside a round one, as blades are in a jar."""
    corners = np.array(np.meshgrid(*[(-1.0, 1.0)] * 3)).reshape(3, 8)
    placed = other.to_body[:, :3] @ corners + other.to_body[:, 3:]
    x, y, z = np.linalg.solve(part.to_body[:, :3], placed - part.to_body[:, 3:])
    return bool((np.hypot(x, y) < 1.0).all() and (np.abs(z) < 1.3).all())


@functools.cache
def turning() -> list[str]:
    """Nouns with a part that turns."""
    return [
        name for name in sorted(NOUNS)
        if any(axle(*(each.to_body for each in one)) for one in zip(*parts_of(name), strict=True))
    ]  # fmt: skip


def test_nouns_that_turn():
    assert {"spinning disc", "fan", "drone", "ferris wheel", "gyroscope"} <= set(turning())
    assert set(RESTS) <= set(turning())


@for_every(turning)
def test_what_turns_on_a_round_part_takes_it_along(name):
    """The truth of a disc's plain surface is the flow of its rotation, as that of its marks is."""
    moments = list(zip(*parts_of(name), strict=True))
    axles = [axle(*(each.to_body for each in one)) for one in moments]
    passed = []
    for (part, later, _), own in zip(moments, axles, strict=True):
        if own is not None or not np.array_equal(part.to_body, later.to_body):
            continue
        for (other, *_), found in zip(moments, axles, strict=True):
            if found is None or not is_round(part, *found) or hides(part, other):
                continue
            low, high = ends(other, found[0])
            if low <= ends(part, found[0]).mean() <= high:
                passed.append(part)
                break
    assert bool(passed) == (name in RESTS)
