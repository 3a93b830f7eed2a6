"""Checks of the parts of bodies: their colours, materials, lamps and joints."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

import numpy as np

from texvent_scenes.colours import SURFACES, find_colour
from texvent_scenes.description import Claim
from texvent_scenes.models import materials
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.rendered_scene import Texture
from texvent_scenes.staging.actors import Actor, PlacedModel

Place: TypeAlias = Callable[[Actor, float], PlacedModel]
"""A body at an instant, s, with its lamps as bright as they are then."""
_REST = Pose(0.0, 0.0, 0.0, "stand")
_LEAST_ROUND, _ONE_WAY = 0.15, 0.9
"""Least rotation of a part that goes round, rad; least share of its rotation that is one way."""
_STILL, _DARK, _MOST = 1e-3, 0.5, 0.5
"""Way of a part that does not move, in sizes of its body; share of its greatest light below which a
lamp is off; share of a surface that makes its look."""


def has_colour(own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place) -> bool:
    """Whether each has a part of a colour."""
    rgb = find_colour(str(claim.value), SURFACES)
    return all(materials.has_colour(one.own_parts(_REST), rgb) for one in own)


def is_of_material(
    own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place
) -> bool:
    """Whether most of each has the texture of a material."""
    texture = materials.MATERIALS[str(claim.value)].texture
    return texture is not Texture.PLAIN and all(
        is_made_of(one.own_parts(_REST), texture) for one in own
    )


def is_made_of(parts: Sequence[ModelPart], *textures: Texture) -> bool:
    """Whether most of the surface of a body has one of the textures."""
    return materials.share_of(parts, lambda one: one.texture in textures) >= _MOST


def is_moving_inside(
    own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place
) -> bool:
    """Whether parts of each move in its body: the hands of a clock."""
    for one in own:
        at = [one.own_parts(one.pose(time_s)) for time_s in times]
        places = np.array([[part.to_body for part in each] for each in at])
        if np.ptp(places, axis=0).max() <= _STILL * one.size_m:
            return False
    return True


def goes_round(own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place) -> bool:
    """Whether a part of each rotates on and on, and does not only sway: the drum of a machine."""
    for one in own:
        at = [one.own_parts(one.pose(time_s)) for time_s in times]
        axes = np.array([[part.to_body[:, :3] for part in each] for each in at])
        axes /= np.maximum(np.linalg.norm(axes, axis=-2, keepdims=True), 1e-12)
        steps = axes[1:] @ np.swapaxes(axes[:-1], -1, -2)
        skew = steps - np.swapaxes(steps, -1, -2)  # 2 sin(angle) × axis
        turns = np.stack([skew[..., 2, 1], skew[..., 0, 2], skew[..., 1, 0]], axis=-1)
        net = 0.5 * np.linalg.norm(turns.sum(axis=0), axis=-1)
        whole = 0.5 * np.linalg.norm(turns, axis=-1).sum(axis=0)
        if not ((net >= _LEAST_ROUND) & (net >= _ONE_WAY * whole)).any():
            return False
    return True


def _list_lamps(actor: Actor, times: Sequence[float], place: Place) -> Iterator[list[ModelPart]]:
    """Each part that shines, at the instants."""
    for each in zip(*(place(actor, time_s).parts for time_s in times), strict=True):
        if max(part.emission for part in each) > 0.0:
            yield list(each)


def is_blinking(own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place) -> bool:
    """Whether a lamp of each is on and off."""
    return all(
        any(
            min(part.emission for part in lamp) <= _DARK * max(part.emission for part in lamp)
            for lamp in _list_lamps(one, times, place)
        )
        for one in own
    )


def is_lit_in(own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place) -> bool:
    """Whether a lamp of each shines in a colour."""
    rgb = find_colour(str(claim.value), SURFACES)
    return all(
        any(materials.has_colour(lamp[:1], rgb) for lamp in _list_lamps(one, times, place))
        for one in own
    )
