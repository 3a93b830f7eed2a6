"""What people wear and have with them, and the rope of what swings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from texvent.scenes.colours import rgb_of
from texvent.scenes.description import STANDING, SceneDescription
from texvent.scenes.models.materials import Material
from texvent.scenes.models.nouns import NOUNS
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.people.outfit import CLOTHES
from texvent.scenes.models.people.person import dress
from texvent.scenes.models.people.posture import SEAT
from texvent.scenes.models.people.props import HOLDS, Prop, list_props
from texvent.scenes.models.protocol import Model, ModelPart, Noun, Pose
from texvent.scenes.models.shapes import moved, post
from texvent.scenes.models.support_surface import find_support
from texvent.scenes.models.traits import nouns_with, trait_value
from texvent.scenes.staging.placement.object_groups import ObjectGroup
from texvent.scenes.staging.trajectories.action_trajectories import Swing
from texvent.scenes.staging.trajectories.trajectory import Trajectory

_SEAT_BACK_M = 0.03
"""How far behind the hips the middle of a chair is."""


def dressed(description: SceneDescription, index: int, nouns: Mapping[str, Noun]) -> Noun:
    """The noun of an object: a person in what it wears."""
    objects = description.objects
    noun = nouns[objects[index].noun]
    worn = [
        (objects[target].noun, rgb_of(objects[target].colour))
        for one in description.relations
        if one.kind == "wear" and one.subject == index
        for target in one.targets
        if objects[target].noun in CLOTHES
    ]
    return dress(noun, worn) if worn and noun.name in PERSON_NOUNS else noun


def choose_copy(noun: Noun, number: int, nouns: Mapping[str, Noun]) -> Noun:
    """Who the copy with that number, from 0, is: of people every second one is another."""
    other = trait_value("every second one", noun.name)
    if number % 2 == 0 or other is None or noun != nouns[noun.name]:
        return noun
    return replace(noun, build=nouns[other].build)


def choose_props(description: SceneDescription, group: ObjectGroup) -> tuple[Prop, ...]:
    """What a person's activities need, or else it has with it, and the scene does not show."""
    if group.noun.name not in PERSON_NOUNS:
        return ()
    shown = {scene_object.noun for scene_object in description.objects}
    said = (group.scene_object.motion or STANDING, *group.scene_object.then)
    kinds = dict.fromkeys(motion.kind for motion in said)
    size = float(getattr(group.models[0], "scale", 1.0))
    props = [prop for kind in kinds for prop in list_props(kind, size)]
    props = props or list(HOLDS.get(group.noun.name, ()))
    if group.on_chairs and not shown & nouns_with("seat at a table"):
        props.append(_draw_chair(size))
    return tuple(
        prop
        for prop in props
        if prop.anchor == "ground" or prop.is_own or not shown.intersection(prop.nouns)
    )


def _draw_chair(scale: float) -> Prop:
    """The chair under who sits at a table; `scale` is the body's, relative to an adult."""
    (name,) = nouns_with("seat at a table")
    usual_m = find_support(NOUNS[name].build(colour=None, scale=1.0, seed=0), near_m=SEAT).height
    model = NOUNS[name].build(colour=None, scale=max(scale, 1.0) * SEAT / usual_m, seed=0)
    low = SEAT * (1.0 - min(scale, 1.0))
    axes = np.column_stack([np.eye(3), np.array([-_SEAT_BACK_M * scale, 0.0, -low])])
    placed = moved(model.parts(Pose(0.0, 0.0, 0.0, "stand")), axes)
    return Prop("ground", lambda _: placed)


def hang_rope(trajectory: Trajectory, model: Model) -> tuple[ModelPart, ...]:
    """The rope of what swings, m in body coordinates."""
    if not isinstance(trajectory, Swing):
        return ()
    low, high = 0.9 * model.height, trajectory.length_m
    thick = 2.0 * (0.012 + 0.004 * model.height)
    size = (thick, thick, high - low)
    return (post(Material((0.25, 0.2, 0.14)), (0.0, 0.0, 0.5 * (high + low)), size),)
