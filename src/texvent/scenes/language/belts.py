"""A conveyor belt runs the way that what lies on it is said to go."""

from __future__ import annotations

from dataclasses import replace

from texvent.scenes.description import SceneDescription

BELT = "conveyor belt"
_WAYS = ("left", "right")


def run_belts(description: SceneDescription) -> SceneDescription:
    """As in "boxes move from right to left on a conveyor belt": it carries them to the left."""
    objects = list(description.objects)
    for relation in description.relations:
        rider, target = objects[relation.subject], relation.targets[0]
        belt = objects[target]
        if relation.kind != "on" or belt.noun != BELT or rider.motion is None:
            continue
        if belt.motion is not None and rider.motion.direction in _WAYS:
            motion = replace(belt.motion, direction=rider.motion.direction, pace=rider.motion.pace)
            objects[target] = replace(belt, motion=motion)
    return replace(description, objects=tuple(objects))
