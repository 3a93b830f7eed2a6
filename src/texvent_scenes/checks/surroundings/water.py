"""Water check: what swims or sails is in water, and who walks after a swim is out of it."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.checks.clip.staged_clip import StagedClip
from texvent_scenes.description import Claim, SceneDescription, label_of
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.rendered_scene import Float64Array, Ground
from texvent_scenes.staging.compose import ComposedScene
from texvent_scenes.staging.surroundings.road_line import RoadLine
from texvent_scenes.staging.tracks.phases import schedule

_INSTANTS, _HALF, _LEAST_CLIP_S = 9, 0.5, 1.0
"""Instants of a phase at which it is looked; share of them that tells, since it may come ashore on
the way; length of a clip in which motions get so far that they are judged, s."""
_ALONG, _OVER, _FAR_M = 0.8, 0.2, 300.0
"""Cosine of the angle to a road or a shore up to which a way is along it; share of the clip in
which what flies over it is above it, or before it; distance of what is seen at the horizon, m."""
_ON_FOOT = frozenset({"walk", "run", "crawl"})
_AFLOAT = frozenset({"swim", "sail", "paddle", "row", "surf"})


def wet_share(scene: ComposedScene, ground_m: Float64Array) -> float:
    """Share of ground points [n, 2], m, that are in the water of a scene's place."""
    place = scene.place
    if not place.has_shore:
        return float(place.ground in (Ground.SEA, Ground.UNDERWATER))
    base = scene.animated_environment.base
    x, y = map(float, base.road_offset)
    half_m = float(base.road_half_width) if place.ground is not Ground.LAKE else 0.0
    across_m = RoadLine(base.road_angle, (x, y)).across(ground_m)
    return float(((across_m > -half_m) & (across_m < (half_m or math.inf))).mean())


def is_above_way(staged: StagedClip, claim: Claim) -> bool:
    """Whether bodies are above the road or the water of a place: at first of what leaves it.

    Over it they are so for a part of the clip, or before it as the camera sees them; along it they
    have its direction.
    """
    base, place = staged.scene.animated_environment.base, staged.scene.place
    x, y = map(float, base.road_offset)
    line, half_m = RoadLine(base.road_angle, (x, y)), float(base.road_half_width)
    for body in staged.own_boxes(claim):
        spots = body.middle[:, :2]
        if claim.value == "along":
            way = spots[-1] - spots[0]
            ahead = np.array([math.cos(line.angle), math.sin(line.angle)])
            if abs(float(way @ ahead)) < _ALONG * np.linalg.norm(way):
                return False
            continue
        is_over = claim.value in ("over", "above")
        spots = np.stack([spots, _behind(staged, body.middle)]) if is_over else spots[None, :1]
        if place.has_shore:
            is_so = np.array([[wet_share(staged.scene, one[None]) for one in each]
                              for each in spots])  # fmt: skip
        else:
            is_so = np.array([np.abs(line.across(each)) <= half_m for each in spots], dtype=float)
        if is_so.mean(axis=1).max() < _OVER:
            return False
    return True


def _behind(staged: StagedClip, middle: Float64Array) -> Float64Array:
    """[t, 2] Points of the ground that a camera sees behind the middle of a body [t, 3], m."""
    places = np.array([staged.scene.camera(one).position for one in staged.times])
    rays = middle - places
    with np.errstate(divide="ignore"):
        steps = np.where(rays[:, 2] < 0.0, -places[:, 2] / rays[:, 2], np.inf)
    steps = np.minimum(steps, _FAR_M / np.maximum(np.linalg.norm(rays, axis=1), 1e-6))
    return np.asarray((places + steps[:, None] * rays)[:, :2])


def find_wet_and_dry(
    scene: ComposedScene, description: SceneDescription, duration_s: float
) -> Iterator[Violation]:
    """Swims on land, ways on foot in water of who is said to do both, and bridges over no water.

    Args:
        scene: the staged scene.
        description: the scene before it was staged.
        duration_s: length of the clip, s.
    """
    placed = {one.subject for one in description.relations if one.kind in ("on", "in", "ride")}
    for index, said in enumerate(description.objects):
        kinds = {one.kind for one in said.motions}
        is_judged = kinds & _AFLOAT and duration_s >= _LEAST_CLIP_S and index not in placed
        own = [one for one in scene.actors if one.object_index == index and one.track.anchor is None
               and one.noun.habitat != "air"]  # fmt: skip
        for phase in schedule(said.motions, duration_s) if is_judged and own else ():
            at = np.linspace(phase.start_s, phase.end_s, _INSTANTS)
            wet = [wet_share(scene, np.array([one.middle(float(t))[:2] for t in at]))
                   for one in own]  # fmt: skip
            kind, name = phase.motion.kind, label_of(description, index)
            if kind in _AFLOAT and max(wet) < _HALF:
                yield Violation("motion", kind, f"the {name}'s {kind}: it is on land")
            elif kind in _ON_FOOT and min(wet) > _HALF:
                yield Violation("motion", kind, f"the {name}'s {kind}: it is in the water")
    bridges = [one for one in scene.actors if one.noun.name in nouns_with("has approaches")]
    for one in bridges if scene.place.has_shore else ():
        if wet_share(scene, one.middle(0.0)[None, :2]) == 0.0:
            yield Violation("noun", one.noun.name, f"the {one.name}: no water is under its middle")
