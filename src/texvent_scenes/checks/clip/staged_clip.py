"""Staged clip: bodies and parts of a staged scene at the instants of its clip."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from texvent.camera import project
from texvent.sensor import SensorSize
from texvent_scenes.checks.clip.body_boxes import BodyBoxes, body_of
from texvent_scenes.checks.clip.relations import find_violations
from texvent_scenes.description import Claim, IndexedRelation, SceneDescription
from texvent_scenes.models.tables import trait_value
from texvent_scenes.raycast.ground_truth import visible_instances
from texvent_scenes.rendered_scene import Float64Array
from texvent_scenes.staging.actors import Actor
from texvent_scenes.staging.compose import ComposedScene

_COARSE = SensorSize(40, 30)
"""Size of a coarse image."""
_INSTANTS, _PER_S, _MOST = 9, 24.0, 1000
"""Instants at which bodies are compared; per second and at most, those that count repetitions."""


def is_inside(actor: Actor, place: Float64Array, time_s: float) -> bool:
    """Whether a place, [3] m, is in the box of a body, seen from above, at an instant."""
    to_world = actor.track.at(time_s).to_world()
    x, y, _ = (place - to_world[:, 3]) @ to_world[:, :3]
    return abs(float(x)) <= 0.5 * actor.model.length and abs(float(y)) <= 0.5 * actor.model.width


@dataclass(frozen=True)
class StagedClip:
    """A staged scene over its clip, at the instants at which it is compared with its words."""

    scene: ComposedScene
    description: SceneDescription
    size: SensorSize
    duration_s: float

    @cached_property
    def times(self) -> list[float]:
        """Instants, s."""
        return [float(one) for one in np.linspace(0.0, self.duration_s, _INSTANTS)]

    @cached_property
    def boxes(self) -> list[list[BodyBoxes]]:
        """Boxes of the copies of each object."""
        cameras = [self.scene.camera(one) for one in self.times]
        return [[body_of(one, cameras, self.times) for one in self.list_actors(index)]
                for index in range(len(self.description.objects))]  # fmt: skip

    def list_actors(self, index: int) -> list[Actor]:
        """Copies of an object; a rider who is drawn with a vehicle is that."""
        if own := [one for one in self.scene.actors if one.object_index == index]:
            return own
        ridden = {one.targets[0] for one in self.description.relations
                  if one.subject == index and one.kind in ("ride", "on")}  # fmt: skip
        nouns = {n: self.description.objects[n].noun for n in ridden}
        built_in = {n for n, noun in nouns.items() if trait_value("ridden", noun) == "built-in"}
        return [one for one in self.scene.actors if one.object_index in built_in]

    @cached_property
    def fine_times(self) -> list[float]:
        """Instants at which repetitions are counted, s."""
        count = min(max(int(self.duration_s * _PER_S), 2), _MOST) + 1
        return [float(one) for one in np.linspace(0.0, self.duration_s, count)]

    def own(self, claim: Claim) -> list[Actor]:
        """Copies of the object of which something is claimed."""
        return [] if claim.subject is None else self.list_actors(claim.subject)

    def own_boxes(self, claim: Claim) -> list[BodyBoxes]:
        """Boxes of those copies."""
        return [] if claim.subject is None else self.boxes[claim.subject]

    def has_in_image(self, actor: Actor, time_s: float) -> bool:
        """Whether a part of a body is neither left nor right of the image."""
        x = project(self.scene.camera(time_s), self.size, actor.corners(time_s))[:, 0]
        return bool(((x >= 0.0) & (x <= self.size.width)).any())

    def share_of(self, instances: Collection[int], time_s: float) -> float:
        """Share of the image that shows some bodies at an instant."""
        x, y = np.meshgrid(np.arange(_COARSE.width) + 0.5, np.arange(_COARSE.height) + 0.5)
        points = np.stack([x, y], axis=-1).reshape(-1, 2)
        _, seen = visible_instances(self.scene, time_s, _COARSE, points)
        return float(np.isin(seen, [*instances]).mean())

    def places(self, actor: Actor) -> Float64Array:
        """[t, n, 3] Places of its parts, beside its own place on the ground, m."""
        at = [actor.place(one) for one in self.fine_times]
        places = np.array([[part.to_body[:, 3] for part in one.parts] for one in at])
        world = [one.to_world for one in at]
        moved = np.array([each @ one[:, :3].T + one[:, 3]
                          for each, one in zip(places, world, strict=True)])  # fmt: skip
        moved -= np.array([[one.to_world[0, 3], one.to_world[1, 3], 0.0] for one in at])[:, None]
        return moved

    def departure(self, actor: Actor) -> Float64Array:
        """[t] Departure of its parts from where they are at first, the greatest of all, m."""
        moved = self.places(actor)
        return np.asarray(np.linalg.norm(moved - moved[0], axis=2).max(axis=1))

    def relates(self, claim: Claim, kind: str, when: slice = slice(None)) -> bool:
        """Whether a relation between the objects of a claim holds at some of the instants."""
        about = [] if claim.subject is None else [claim.subject, *claim.targets]
        copies = [[one.cut(when) for one in self.boxes[index]] for index in about]
        return bool(about) and self.holds(kind, about, copies)

    def holds(self, kind: str, about: Sequence[int], copies: Sequence[Sequence[BodyBoxes]]) -> bool:
        """Whether the first bodies are so to the others, which are copies of these objects."""
        objects = tuple(self.description.objects[index] for index in about)
        relation = IndexedRelation(kind, 0, tuple(range(1, len(copies))))
        apart = replace(self.description, objects=objects, relations=(relation,))
        return not any(one.kind == "relation" for one in find_violations(apart, copies))
