"""Checks of streets and grounds: how many are there, who keeps to the pavement, what gets on."""

from __future__ import annotations

import numpy as np

from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.description import Claim
from texvent_scenes.rendered_scene import Ground
from texvent_scenes.staging.surroundings.road_line import RoadLine

_MANY = 4
"""Fewest bodies in the image of a place that is busy."""
_KERB_M = 0.4
"""Most from the kerb, on the road, of the middle of who is beside it, m."""


def are_many(staged: StagedClip, claim: Claim) -> bool:
    """Whether enough bodies of a noun are in the image for a place to be busy."""
    objects = staged.description.objects
    own = [n for n, one in enumerate(objects) if one.noun == claim.value]
    bodies = [one for n in own for one in staged.list_actors(n)]
    seen = [one for one in bodies if any(staged.has_in_image(one, at) for at in staged.times)]
    return len(seen) >= _MANY


def is_on_pavement(staged: StagedClip, claim: Claim) -> bool:
    """Whether the place has a pavement, and who is on it is never on the road."""
    scene = staged.scene
    base = scene.animated_environment.base
    x, y = map(float, base.road_offset)
    road = RoadLine(base.road_angle, (x, y), tuple(map(tuple, base.road_crossings)))
    places = [one.middle[:, :2] for one in staged.own_boxes(claim)]
    is_clear = [bool((road.distance(one) >= scene.place.road_m - _KERB_M).all()) for one in places]
    return scene.place.ground is Ground.CITY and all(is_clear)


def gets_on(staged: StagedClip, claim: Claim) -> bool:
    """Whether it goes more than its size over what it bounces on, not only up and down."""
    pairs = zip(staged.own(claim), staged.own_boxes(claim), strict=True)
    ways = [(one, body.middle[-1, :2] - body.middle[0, :2]) for one, body in pairs]
    return all(float(np.linalg.norm(way)) > one.size_m for one, way in ways)
