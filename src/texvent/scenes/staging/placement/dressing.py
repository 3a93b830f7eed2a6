"""What people wear and have with them in a scene: by their role, and as the prompt says."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from texvent.scenes.description import STANDING, SceneDescription
from texvent.scenes.models.animals.four_legged.clothing import TRUNK_CLOTHES, clothe
from texvent.scenes.models.materials import Material
from texvent.scenes.models.people.activities import ACTIVITIES, PERSON_NOUNS
from texvent.scenes.models.people.outfit import CLOTHES
from texvent.scenes.models.people.person import dress
from texvent.scenes.models.people.props import HOLDS, Prop, list_props
from texvent.scenes.models.protocol import Model, ModelPart, Noun
from texvent.scenes.models.shapes import post
from texvent.scenes.staging.placement.object_groups import ObjectGroup
from texvent.scenes.staging.placement.tables.at_table import draw_chair
from texvent.scenes.staging.trajectories.action_trajectories import Swing
from texvent.scenes.staging.trajectories.trajectory import Trajectory

_BOTH_HANDS = ("right hand", "left hand", "hands")
_WITH_RIDER = frozenset({"bicycle", "motorcycle"})
_BUSY: dict[str, tuple[str, ...]] = {
    **dict.fromkeys(("hold", "carry", "push", "throw", "catch", "hit"), _BOTH_HANDS),
    "pull": ("right hand",),
    "ride": (*_BOTH_HANDS, "ground", "torso"),
}
"""Act → places of the body that it needs."""


def dressed(description: SceneDescription, index: int, nouns: Mapping[str, Noun]) -> Noun:
    """The noun of an object, a person, a rider or an animal in what it is said to wear."""
    objects = description.objects
    noun = nouns[objects[index].noun]
    is_animal = noun.name not in PERSON_NOUNS | _WITH_RIDER
    worn = [
        (objects[target].noun, colour.rgb if colour is not None else None)
        for one in description.relations
        if one.kind == "wear" and one.subject == index
        for target in one.targets
        for colour in (objects[target].colour,)
        if objects[target].noun in (TRUNK_CLOTHES if is_animal else CLOTHES)
    ]
    if is_animal and worn:
        return clothe(noun, worn)
    return dress(noun, worn) if worn else noun


def choose_copy(noun: Noun, number: int, nouns: Mapping[str, Noun]) -> Noun:
    """Who the copy with that number, from 0, is: of people every second one is a woman."""
    other = _OTHERS.get(noun.name)
    if number % 2 == 0 or other is None or noun != nouns[noun.name]:
        return noun
    return replace(noun, build=nouns[other].build)


_OTHERS = {"person": "woman", "elderly person": "elderly woman"}
"""People of any kind → what every second one of several is."""


def choose_props(
    description: SceneDescription, group: ObjectGroup
) -> tuple[Prop, ...]:
    """What a person's activities need and the prompt does not show as an object.

    Who climbs works where they are: no table stands before them.
    """
    if group.noun.name not in PERSON_NOUNS:
        return ()
    shown = {scene_object.noun for scene_object in description.objects}
    said = (group.scene_object.motion or STANDING, *group.scene_object.then)
    kinds = dict.fromkeys(motion.kind for motion in said)
    size = float(getattr(group.models[0], "scale", 1.0))
    props = [prop for kind in kinds for prop in list_props(kind, size)]
    if "climb" in kinds:
        props = [prop for prop in props if prop.anchor != "ground"]
    props += usual_holds(description, group, props)
    if group.is_on_chairs and "chair" not in shown:
        props.append(draw_chair(size))
    return tuple(
        prop
        for prop in props
        if prop.anchor == "ground" or prop.is_own or not shown.intersection(prop.nouns)
    )


def usual_holds(
    description: SceneDescription, group: ObjectGroup, props: Sequence[Prop]
) -> list[Prop]:
    """What a role has with it, where hands and feet are free for it.

    Args:
        description: the scene, whose acts keep hands busy.
        group: copies of a person.
        props: what its activities need.
    """
    own = [one for one in description.relations if one.subject == group.index]
    busy = {place for one in own for place in _BUSY.get(one.kind, ())}
    busy |= {prop.anchor for prop in props}
    if group.carrier is not None:
        busy.add("ground")
    if busy & {"left hand", "right hand"}:
        busy.add("hands")
    if "hands" in busy:
        busy |= {"left hand", "right hand"}
    used = {noun for prop in props for noun in prop.nouns}
    return [
        prop
        for prop in HOLDS.get(group.noun.name, ())
        if prop.anchor not in busy and not used.intersection(prop.nouns)
    ]


_WAIST_SHARE = 0.38
"""Share of a person's height below which the image may end."""


def find_waist(group: ObjectGroup, model: Model) -> float:
    """Where the image may end of who does something at the own head, m; 0 = it shows all."""
    said = (group.scene_object.motion or STANDING, *group.scene_object.then)
    is_close = group.noun.name in PERSON_NOUNS and all(
        one.kind in ACTIVITIES and ACTIVITIES[one.kind].is_close for one in said
    )
    return _WAIST_SHARE * model.height if is_close else 0.0


def hang_rope(trajectory: Trajectory, model: Model) -> tuple[ModelPart, ...]:
    """The rope of what swings, m in body coordinates."""
    if not isinstance(trajectory, Swing):
        return ()
    low, high = 0.9 * model.height, trajectory.length_m
    thick = 2.0 * (0.012 + 0.004 * model.height)
    size = (thick, thick, high - low)
    return (post(Material((0.25, 0.2, 0.14)), (0.0, 0.0, 0.5 * (high + low)), size),)
