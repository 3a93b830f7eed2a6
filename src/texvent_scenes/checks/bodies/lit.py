"""Lit-lamp check: lamps of a name or a colour that shine, and that the image shows."""

from __future__ import annotations

import numpy as np

from texvent.camera import project
from texvent_scenes.checks.bodies.parts import is_lit_in
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.colours import SURFACES, find_colour
from texvent_scenes.description import Claim
from texvent_scenes.models.materials import has_colour
from texvent_scenes.raycast.ground_truth import visible_instances
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.surroundings.lamps import LitActor

_DEEP_M = 0.4
"""Depth up to which a lamp may be inside of what is seen before it, m: of its own glass."""


def shows_lit_colour(staged: StagedClip, claim: Claim) -> bool:
    """Whether a lamp of each body shines in a colour and is in the image at some instant."""
    own, lamps = staged.own(claim), staged.scene.lamps
    if not is_lit_in(own, claim, staged.fine_times, lamps.place):
        return False
    rgb = find_colour(str(claim.value), SURFACES)
    return all(any(is_any_seen(staged, _list_places(staged, one, rgb, at), at)
                   for at in staged.times) for one in own)  # fmt: skip


def shows_lamp(staged: StagedClip, claim: Claim) -> bool:
    """Whether a lamp of a name, such as "headlight", is on and in the image at some instant.

    One of several copies is enough: of traffic that comes and goes, some cars show theirs.
    """
    own = {one.instance for one in staged.own(claim)}
    lit = [one for one in staged.scene.lamps.lit if one.actor.instance in own]
    return any(is_any_seen(staged, _list_lit(one, str(claim.value), at), at)
               for one in lit for at in staged.times)  # fmt: skip


def _list_lit(one: LitActor, name: str, time_s: float) -> Float64Array:
    """[n, 3] Places of the lamps of a name that are on at an instant, m."""
    placed = one.actor.place(time_s)
    middles = [placed.parts[index].to_body[:, 3] for index, _, lamp in one.lamps
               if lamp.name == name and one.level(lamp, time_s) > 0.0]  # fmt: skip
    to_world = placed.to_world
    return np.asarray(np.reshape(middles, (-1, 3)) @ to_world[:, :3].T + to_world[:, 3])


def _list_places(
    staged: StagedClip, one: Actor, rgb: tuple[float, float, float], time_s: float
) -> Float64Array:
    """[n, 3] Places of the lamps of a colour, m, also of those that are off just then."""
    placed = [staged.scene.lamps.place(one, at) for at in (time_s, *staged.fine_times)]
    shines = [n for n, parts in enumerate(zip(*(each.parts for each in placed), strict=True))
              if max(part.emission for part in parts) > 0.0
              and any(has_colour([part], rgb) for part in parts)]  # fmt: skip
    to_world = placed[0].to_world
    middles = np.array([placed[0].parts[n].to_body[:, 3] for n in shines]).reshape(-1, 3)
    return np.asarray(middles @ to_world[:, :3].T + to_world[:, 3])


def is_any_seen(staged: StagedClip, places: Float64Array, time_s: float) -> bool:
    """Whether nothing stands before one of some places, [n, 3] m, in the image."""
    if not len(places):
        return False
    size = staged.size
    points = project(staged.scene.camera(time_s), size, places)
    inside = (points > 0.0).all(axis=1) & (points[:, :2] < [size.width, size.height]).all(axis=1)
    if not inside.any():
        return False
    depth, _ = visible_instances(staged.scene, time_s, size, points[inside, :2])
    return bool((depth >= points[inside, 2] - _DEEP_M).any())
