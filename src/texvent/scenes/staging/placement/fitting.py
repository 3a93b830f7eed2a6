"""Sizes: content and container fit each other, small things beside large ones are enlarged."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.models.nouns import FAMILIES
from texvent.scenes.models.people.activities import PERSON_NOUNS, SEATS
from texvent.scenes.models.people.props import PROPS
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.staging.placement.contents import is_stem
from texvent.scenes.staging.placement.faced import hang_clocks
from texvent.scenes.staging.still_life import enlarge_beside, is_still_life

_SWIMMING_ROOM = 0.55
"""The same of one that swims in it."""
_LONGEST_STEM = 2.0
"""How much taller than its vessel a stem may be."""
_WAYS = ("into", "out of")
_OPENING, _LARGEST_VESSEL_M = 0.75, 3.0
"""The same of what is seen to go in or come out; what is larger stays as it is, m."""
_HOOP = 1.4
"""Width of a hoop that one goes through, in heights of who does."""
_ROOM, _ON_SEAT = 0.8, 1.6
"""Share of a container's longer side that an animal in it may be long; of a seat's, on which it
sits upright."""


def fit_contents(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with animals that fit into the containers that they are in.

    Where an animal is too long, it becomes smaller and the container larger by the same factor.
    Things stay as they are: a spoon stands out of its glass.
    """
    objects = list(description.objects)
    for relation in description.relations:
        if relation.kind == "through" and objects[relation.targets[0]].noun == "hula hoop":
            hoop = objects[relation.targets[0]]
            wide = _HOOP * _height(objects[relation.subject], nouns) / _side(hoop, nouns)
            objects[relation.targets[0]] = replace(hoop, scale=hoop.scale * max(wide, 1.0))
        if relation.kind != "in" and relation.way not in _WAYS:
            continue
        inside, around = relation.subject, relation.targets[0]
        if relation.way in _WAYS and _side(objects[around], nouns) > _LARGEST_VESSEL_M:
            continue
        is_animal = nouns[objects[inside].noun].habitat != "fixed" or relation.way in _WAYS
        is_container = nouns[objects[around].noun].habitat == "fixed"
        if is_container and not is_animal:
            objects[inside] = _shorten(objects[inside], objects[around], nouns)
        if not (is_animal and is_container) or objects[inside].noun in PERSON_NOUNS:
            continue
        is_swimmer = nouns[objects[inside].noun].motion == "swim"
        room = _SWIMMING_ROOM if is_swimmer else _ROOM
        room = _ON_SEAT if objects[around].noun in SEATS else room
        room = _OPENING if relation.way in _WAYS else room
        ratio = room * _side(objects[around], nouns) / _side(objects[inside], nouns)
        if ratio < 1.0:
            factor = math.sqrt(ratio)
            objects[inside] = replace(objects[inside], scale=objects[inside].scale * factor)
            objects[around] = replace(objects[around], scale=objects[around].scale / factor)
    return replace(description, objects=tuple(objects))


def _shorten(inside: SceneObject, around: SceneObject, nouns: Mapping[str, Noun]) -> SceneObject:
    """Flowers in a glass are cut to fit it."""
    stem, vessel = (
        nouns[one.noun].build(colour=None, scale=one.scale, seed=0) for one in (inside, around)
    )
    if not is_stem(stem):
        return inside
    ratio = _LONGEST_STEM * vessel.height / stem.height
    return replace(inside, scale=inside.scale * min(ratio, 1.0))


_LARGER = 1.8
"""Most by which a small thing is enlarged; see docs/prompts.md."""
_LARGER_WORN = 1.3
"""The same of what is worn."""
_LARGER_BALL = 1.5
"""The same of balls and what else is thrown by hand."""
_LARGER_SMALL_BALL, _BALL_M = 2.0, 0.16
"""The same of balls, and the size up to which they are: a football is large enough as it is."""
_LARGER_BIRD = 1.5
"""The same of what flies."""
_SMALL_M, _SMALL_BIRD_M = 0.35, 1.2
"""Size up to which things, and what flies, are enlarged, m."""
_MUCH_SMALLER = 4.0


def enlarge_small(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with small things larger, beside something several times their size.

    A cup in a hand is hardly seen in a picture that holds who has it. What the prompt calls small
    keeps its size.
    """
    description = hang_clocks(description, nouns)
    objects = list(_lower_trees(description, nouns))
    worn = {i for one in description.relations if one.kind == "wear" for i in one.targets}
    tasted = _list_at_mouth(description)
    sizes = [extent(one, nouns) for one in objects]
    is_alone = is_still_life(description)
    for index, (one, size) in enumerate(zip(objects, sizes, strict=True)):
        noun = nouns[one.noun]
        is_bird = noun.habitat == "air" and noun.name not in _BY_HAND
        may_grow = is_alone or noun.habitat in ("fixed", "air") or noun.name in _BY_HAND
        if not may_grow or one.scale < 1.0:
            continue
        if not is_alone and max(sizes) < _MUCH_SMALLER * size:
            continue
        if is_alone and index not in worn:
            objects[index] = replace(one, scale=one.scale * enlarge_beside(size, max(sizes)))
            continue
        most = _LARGER_BALL if noun.name in _BY_HAND else _LARGER
        most = _LARGER_WORN if index in worn | tasted else _LARGER_BIRD if is_bird else most
        goal_m = _SMALL_BIRD_M if is_bird else _SMALL_M
        if noun.name in _BY_HAND and "ball" in noun.name:
            most, goal_m = _LARGER_SMALL_BALL, _BALL_M
        factor = min(max(goal_m / size, 1.0), most)
        objects[index] = replace(one, scale=one.scale * factor)
    return replace(description, objects=tuple(objects))


def _list_at_mouth(description: SceneDescription) -> set[int]:
    """Objects that go to somebody's mouth; larger they would hide the face."""
    objects = description.objects
    nouns = {
        noun for one in objects for motion in (one.motion, *one.then)
        if motion is not None and motion.kind in _AT_MOUTH
        for prop in PROPS.get(motion.kind, ()) for noun in prop.nouns
    }  # fmt: skip
    return {index for index, one in enumerate(objects) if one.noun in nouns}


_AT_MOUTH = frozenset({"drink", "eat", "eat watermelon", "phone", "sing"})


_LOWERED = {**dict.fromkeys(("tree", "pine", "palm", "ramp", "slide"), 0.4), "house": 0.75}
"""What is drawn lower for something small at it, and to which multiple of its size at least."""


def _lower_trees(
    description: SceneDescription, nouns: Mapping[str, Noun]
) -> tuple[SceneObject, ...]:
    """As in "an apple falls from a tree": of a low tree more is seen with the apple."""
    objects = list(description.objects)
    for relation in description.relations:
        tree, other = relation.targets[0], relation.subject
        is_alone = len(objects) == _PAIR and objects[tree].scale == 1.0
        if is_alone and objects[tree].noun in _LOWERED and relation.kind in _AT_LOWERED:
            small, large = (extent(objects[one], nouns) for one in (other, tree))
            factor = max(_LOWERED_TO * small / large, _LOWERED[objects[tree].noun])
            objects[tree] = replace(objects[tree], scale=min(factor, 1.0))
    return tuple(objects)


_AT_LOWERED = frozenset(
    {"from", "on", "work on", "in", "behind", "front", "beside", "under", "above"}
)
_LOWERED_TO = 3.0
"""Most times larger that it then is."""
_PAIR = 2
_LARGER_AGAIN = 1.6
"""Factor by which things are larger still in a take."""


def enlarge_again(description: SceneDescription, some: Collection[int]) -> SceneDescription:
    """The description with some of its objects still larger."""
    objects = list(description.objects)
    for index in some:
        objects[index] = replace(objects[index], scale=objects[index].scale * _LARGER_AGAIN)
    return replace(description, objects=tuple(objects))


_BY_HAND = frozenset(noun.name for noun in FAMILIES["objects sport balls"]) | {
    "frisbee", "tennis ball", "snowball", "soap bubble", "paper plane", "dart", "feather",
    "toy car",
}  # fmt: skip


def extent(scene_object: SceneObject, nouns: Mapping[str, Noun]) -> float:
    """Its largest extent, m."""
    model: Model = nouns[scene_object.noun].build(colour=None, scale=scene_object.scale, seed=0)
    return max(model.length, model.width, model.height)


def _height(scene_object: SceneObject, nouns: Mapping[str, Noun]) -> float:
    model: Model = nouns[scene_object.noun].build(colour=None, scale=scene_object.scale, seed=0)
    return model.height


def _side(scene_object: SceneObject, nouns: Mapping[str, Noun]) -> float:
    """Its longer side over the ground, m."""
    model: Model = nouns[scene_object.noun].build(colour=None, scale=scene_object.scale, seed=0)
    return max(model.length, model.width)
