"""Groups of objects: the copies of each with their looks, motions and formation."""

from __future__ import annotations

import math
from collections.abc import Mapping

from texvent_scenes.colours import rgb_of
from texvent_scenes.description import STANDING, SceneDescription, label_of
from texvent_scenes.models.materials import in_material
from texvent_scenes.models.protocol import Model, Noun
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.pictures import PicturedModel, can_show
from texvent_scenes.staging.actors import seeded
from texvent_scenes.staging.placement.apart import is_measured
from texvent_scenes.staging.placement.object_groups import (
    ObjectGroup,
    dressed,
    half_extents_over_clip,
    stagger,
)
from texvent_scenes.staging.placement.sizes import Sizes
from texvent_scenes.staging.placement.tags import list_pictures, note_tags
from texvent_scenes.staging.placement.told_apart import list_telling, note_alike, unlike
from texvent_scenes.staging.tracks.motion_plan import plan_motion


class GroupBuilder:
    """Builds the copies of objects, each object about (0, 0)."""

    def __init__(
        self,
        description: SceneDescription,
        nouns: Mapping[str, Noun],
        *,
        seed: int,
        duration_s: float,
        is_trip: bool,
    ) -> None:
        self._description = description
        self._nouns = nouns
        self._sizes = Sizes(description, nouns, is_trip=is_trip)
        self._seed = seed
        self._duration_s = duration_s
        self.notes: list[str] = []
        """Sizes that are not the usual ones, and why."""

    def build(self, index: int) -> ObjectGroup:
        """An object's copies in formation about (0, 0)."""
        scene_object = self._description.objects[index]
        noun = dressed(self._description, index, self._nouns)
        rng = seeded(self._seed, "thing", index, scene_object.noun)
        share, notes = self._sizes.share(index)
        size = scene_object.size * share
        self.notes.extend(notes)
        colour = rgb_of(scene_object.colour)
        seeds = [int(rng.integers(2**31)) for _ in range(scene_object.count)]
        seeds = seeds[:1] * len(seeds) if noun.name in nouns_with("alike") else seeds
        told = list_telling(self._description, index)
        seeds = [unlike(noun, seed, told) for seed in seeds]
        self.notes.extend(note_alike(noun, seeds, told))
        models: list[Model] = [
            in_material(
                noun.build(colour=colour, scale=size, seed=seed),
                scene_object.material,
                colour,
                rgb_of(scene_object.second_colour),
            )
            for seed in seeds
        ]
        if can_show(noun.name):
            shown = list_pictures(self._description.objects, index)
            self.notes.extend(note_tags(label_of(self._description, index), scene_object, shown))
            models = [PicturedModel(one, noun.name, picture) if picture is not None else one
                      for one, picture in zip(models, shown, strict=True)]  # fmt: skip
        motions, start_m = scene_object.motions or (STANDING,), scene_object.height_m
        rows = [one.value for one in self._description.claims
                if one.kind == "row" and one.subject == index]  # fmt: skip
        is_queue = "queue" in rows and noun.motion == "walk" and not motions[0].is_moving
        heading_deg = 0.0 if is_queue and not scene_object.heading_deg else scene_object.heading_deg
        plan = plan_motion(
            motions, noun, models[0], self._duration_s, rng, start_m, heading_deg
        )  # fmt: skip
        is_open = heading_deg is None and all(one.direction != "diagonal" for one in motions)
        if is_open and is_measured(self._description, index):  # square to the axes
            heading_deg = 90.0 * round(math.degrees(plan.yaw) / 90.0)
            plan = plan_motion(
                motions, noun, models[0], self._duration_s, rng, start_m, heading_deg
            )  # fmt: skip
        offsets = stagger(models, plan, noun, rng, is_row=bool(rows))
        half = half_extents_over_clip(models, offsets, plan)
        return ObjectGroup(index, scene_object, noun, models, plan, offsets, half)
