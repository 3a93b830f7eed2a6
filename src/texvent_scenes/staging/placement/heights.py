"""Heights of objects above the ground: in flight, afloat, hovering and at rest."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from texvent_scenes.description import SceneDescription
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.staging.actors import is_centred, lowest_point
from texvent_scenes.staging.placement.object_groups import ObjectGroup, rests
from texvent_scenes.staging.surroundings.environment import lies_ashore
from texvent_scenes.staging.tracks.phases import hovering_m

_HOVERS, _STANDING = ("hover", "float"), ("ground", "fixed")
_LEVEL, _LEVEL_SHARE = ("beside", "at", "with", "left of", "right of"), 0.75
"""Motions, habitats and relations of what is in the air next to a thing, at so much of its
height."""


class Heights:
    """Heights of groups above the ground of a scene."""

    def __init__(
        self,
        description: SceneDescription,
        nouns: Mapping[str, Noun],
        level_m: Mapping[str, float],
        build: Callable[[int], ObjectGroup],
    ) -> None:
        self._description = description
        self._nouns = nouns
        self._level_m = level_m
        """Height of the origin of what lives in the air and in the water, in own sizes."""
        self._build = build

    def of(self, group: ObjectGroup) -> float:
        """Height of the group's origin, m."""
        kind, name, habitat = group.plan.motion.kind, group.noun.name, group.noun.habitat
        levels, air = self._level_m, self._level_m.get("air", 0.0)
        beside_m = self._beside(group)
        if group.plan.start_m is not None:
            return group.origin_m
        if group.scene_object.height_m is not None:
            return group.scene_object.height_m - lowest_point(group.models[0])
        if beside_m is not None:
            return beside_m
        if lies_ashore(group.noun, kind):
            return -lowest_point(group.models[0])
        is_resting = rests(group.noun, kind) and name not in levels
        lifts = kind in ("rise", "sink", "fall") and air > 0.0
        if (is_resting or lifts) and is_centred(group.noun) and habitat == "air":
            return -lowest_point(group.models[0])
        if kind == "float" and "afloat" in levels:
            return levels["afloat"] * group.models[0].height - lowest_point(group.models[0])
        if name in levels and not (kind == "fly" and group.noun.motion == "fly"):
            return levels[name] * group.models[0].height
        is_hung = name in nouns_with("hangs from a ceiling")
        if kind in _HOVERS and habitat in _STANDING and air > 0.0 and not is_hung:
            foot_m = max(-lowest_point(group.models[0]), 0.0)
            return foot_m + hovering_m(group.models[0], group.plan.motion)
        level = levels.get(habitat, 0.0) or (air if kind == "fly" else 0.0)
        if level == 0.0:
            return 0.0
        clear = levels.get("clear", 0.0) if habitat == "air" or kind == "fly" else 0.0
        return level * max(group.size_m, 1.0) + clear

    def _beside(self, group: ObjectGroup) -> float | None:
        """Height of what hovers beside a thing that stands there, by its upper part, m."""
        if group.noun.habitat != "air" or group.plan.motion.kind not in _HOVERS:
            return None
        for one in self._description.relations:
            other = one.targets[0]
            habitat = self._nouns[self._description.objects[other].noun].habitat
            if one.subject == group.index and one.kind in _LEVEL and habitat in _STANDING:
                top_m = self._build(other).models[0].height
                return max(_LEVEL_SHARE * top_m, -1.5 * lowest_point(group.models[0]))
        return None
