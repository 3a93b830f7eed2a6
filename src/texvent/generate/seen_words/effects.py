"""Whether smoke, splashes, sparks and dust are seen, and where the prompt says."""

from __future__ import annotations

import numpy as np

from texvent.generate.seen_words.light import changed_points
from texvent.generate.seen_words.picture import Picture
from texvent.scenes.description import SceneDescription
from texvent.scenes.models.effects import EFFECTS

LEAST_EFFECT = 0.004
"""Share of the picture that an effect changes visibly."""
LEAST_BESIDE = 0.2
"""Share of it that lies at the thing that it comes from."""
FILLED = 0.4
"""Share of the picture from which on smoke or steam fills it."""
FILLING = frozenset({"smoke", "steam", "mist", "dust", "fog"})
"""Effects that are said to fill a room, or the frame."""
FLAMES = frozenset({("smoke", "rocket")})
"""Effect and its thing, of which only the flame before it is told."""


def judge_effects(picture: Picture, description: SceneDescription) -> dict[str, str]:
    """Kinds of effects that are not seen → why."""
    found: dict[str, str] = {}
    for kind, source in dict.fromkeys(picture.scene.particles.kinds):
        if kind in ("rain", "snow"):
            continue
        fault = _judge(picture, description, kind, source)
        if fault is not None:
            found[kind] = fault
    return found


def _judge(
    picture: Picture, description: SceneDescription, kind: str, source: int | None
) -> str | None:
    if source is not None and (kind, description.objects[source].noun) in FLAMES:
        return "no more than a flame"
    seen = changed_points(picture, kind, source)
    is_gone = EFFECTS[kind].ends_source
    if max(float(np.mean(where)) for where in seen.values()) < LEAST_EFFECT:
        return "hardly to be seen"
    if source is None:
        return None
    owners = [one for one, index in picture.scene.object_of.items() if index == source]
    if not any(
        _is_beside(picture, number, where, owners, is_gone=is_gone)
        for number, where in seen.items()
    ):
        return f"not at the {description.objects[source].noun}"
    return None


def judge_filling(picture: Picture, kind: str) -> str | None:
    """Why smoke or steam does not fill the picture, or None."""
    sources = {one for name, one in picture.scene.particles.kinds if name == kind}
    shares = [np.mean(where) for one in sources
              for where in changed_points(picture, kind, one).values()]  # fmt: skip
    return None if max(shares, default=0.0) >= FILLED else "fills little of the picture"


def _is_beside(
    picture: Picture, number: int, where: np.ndarray, owners: list[int], *, is_gone: bool
) -> bool:
    """Whether the effect is within a box around its thing, half as wide again on every side.

    What has burst is where it was when it was last seen.
    """
    own = np.isin(picture.views[number].instance, owners)
    while is_gone and number > 0 and not own.any():
        number -= 1
        own = np.isin(picture.views[number].instance, owners)
    if not own.any() or not where.any():
        return False
    low, high = picture.points[own].min(axis=0), picture.points[own].max(axis=0)
    reach = 0.5 * (high - low).max() + 0.02 * picture.size.width
    at = picture.points[where]
    inside = np.all((at >= low - reach) & (at <= high + reach), axis=1)
    return float(np.mean(inside)) >= LEAST_BESIDE
