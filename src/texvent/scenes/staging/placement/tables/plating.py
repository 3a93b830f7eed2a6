"""Food on a plate, in a bowl or a pan: each helping as large as the dish has room for."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from texvent.scenes.description import Relation, SceneDescription, SceneObject
from texvent.scenes.models.nouns import FAMILIES
from texvent.scenes.models.objects.receptacles import SERVED_IN_VIEW
from texvent.scenes.models.protocol import Model, Noun
from texvent.scenes.models.wrapped.served import ServedModel
from texvent.scenes.scene import Float64Array
from texvent.scenes.staging.placement.contents import is_served
from texvent.scenes.staging.placement.object_groups import ObjectGroup, half_extents_over_clip
from texvent.scenes.staging.placement.tables.tabletop import TABLES

HELPINGS = frozenset(
    noun.name
    for family in ("food", "dishes", "helpings")
    for noun in FAMILIES[f"objects kitchen {family}"]
) | {"bacon", "french fries", "roast chicken", "shrimp", "chocolate bar", "candle"}
"""Nouns of food, and what stands on cakes."""
_ROOM = {1: 1.45, 2: 1.02, 3: 0.94, 4: 0.84, 5: 0.70, 6: 0.66}
"""Things on a dish → how long one is, in radii of the dish."""
_LEAST_ROOM = 0.52
_WIDER = {1: 1.0, 2: 1.2, 3: 1.25, 4: 1.3}
"""The same → how much wider the dish is than usual."""
_WIDEST = 1.45
_CANDLE = 0.4
"""Height of a candle on a cake, in radii of the cake."""
_SMALLEST, _LARGEST = 0.3, 2.2
"""Bounds of the factor by which food is drawn smaller or larger."""
_MOST_CANDLES = 6
_CROWD = 6
_LOOSE = frozenset({"with", "beside"})
"""Relations that leave open where a thing is."""
_SET = HELPINGS | {noun.name for noun in FAMILIES["objects kitchen tableware"]}
"""Nouns of what tables are laid with."""
_SUNK = 0.2
"""Share of the height of what lies in a bowl that is below its rim."""


def dish_up(description: SceneDescription, nouns: Mapping[str, Noun]) -> SceneDescription:
    """The description with dishes wide enough for what is on them, and food that fits them.

    Candles that a prompt names beside one cake stand on it.
    """
    description = _lay_table(_fill_dish(_light_cake(description)))
    objects = list(description.objects)
    for index, dish in enumerate(description.objects):
        on = _list_on(description, index)
        count = sum(objects[i].count for i in on)
        if dish.noun not in SERVED_IN_VIEW or dish.count != 1 or not count:
            continue
        wider = 1.0 if dish.noun == "cake" else _WIDER.get(count, _WIDEST)
        objects[index] = replace(dish, scale=dish.scale * wider)
        body = _model(objects[index], nouns)
        radius = 0.5 * min(body.length, body.width)
        for i in on:
            own = _model(objects[i], nouns)
            if is_served(objects[i].noun, description, i):
                own = ServedModel(own, objects[i].noun)
            extent = max(own.length, own.width, 0.7 * own.height)
            goal = radius * _ROOM.get(count, _LEAST_ROOM)
            if objects[i].noun == "candle":
                extent, goal = own.height, radius * _CANDLE
            factor = min(max(goal / extent, _SMALLEST), _LARGEST)
            objects[i] = replace(objects[i], scale=objects[i].scale * factor)
    return replace(description, objects=tuple(objects))


def _light_cake(description: SceneDescription) -> SceneDescription:
    """With candles on the cake, where the prompt has one cake and says nothing else of them."""
    objects = list(description.objects)
    cakes = [i for i, one in enumerate(objects) if one.noun == "cake" and one.count == 1]
    candles = [i for i, one in enumerate(objects) if one.noun == "candle"]
    bound = _list_bound(description) | {i for i in candles if not _rests(objects[i])}
    if len(cakes) != 1 or len(candles) != 1 or candles[0] in bound:
        return description
    candle = objects[candles[0]]
    objects[candles[0]] = replace(candle, count=min(candle.count, _MOST_CANDLES))
    description = replace(description, objects=tuple(objects))
    return _put_on(description, candles, cakes[0])


def _list_bound(description: SceneDescription) -> set[int]:
    """Indices of what a relation gives a place, other than that it is with or beside something."""
    return {
        i for one in description.relations if one.kind not in _LOOSE or one.way
        for i in (one.subject, *one.targets)
    }  # fmt: skip


def _put_on(description: SceneDescription, things: Sequence[int], target: int) -> SceneDescription:
    """The description with things on another one instead of beside it."""
    kept = [
        one for one in description.relations
        if one.kind not in _LOOSE or not {one.subject, *one.targets} & {*things}
    ]  # fmt: skip
    on = [Relation("on", index, (target,)) for index in things]
    return replace(description, relations=(*kept, *on))


def _fill_dish(description: SceneDescription) -> SceneDescription:
    """With all food on the one dish that has some of it, where nothing else is said of the rest."""
    objects = description.objects
    dishes = [
        i
        for i, one in enumerate(objects)
        if one.noun in SERVED_IN_VIEW and _list_on(description, i)
    ]
    if len(dishes) != 1 or objects[dishes[0]].noun == "cake":
        return description
    loose = _list_loose(description, HELPINGS - SERVED_IN_VIEW)
    return _put_on(description, loose, dishes[0]) if loose else description


def _lay_table(description: SceneDescription) -> SceneDescription:
    """With small things of the table on the one table that has some, where nothing else is said."""
    objects = description.objects
    tables = [i for i, one in enumerate(objects) if one.noun in TABLES and one.count == 1]
    laid = {i for one in description.relations if one.kind == "on" for i in one.targets}
    if len(tables) != 1 or tables[0] not in laid:
        return description
    loose = _list_loose(description, _SET)
    return _put_on(description, loose, tables[0]) if loose else description


def _list_loose(description: SceneDescription, nouns: Collection[str]) -> list[int]:
    """Indices of such things of which nothing is said that gives them a place."""
    bound = _list_bound(description)
    return [
        i for i, one in enumerate(description.objects)
        if one.noun in nouns and i not in bound and _rests(one)
    ]  # fmt: skip


def _list_on(description: SceneDescription, dish: int) -> list[int]:
    """Indices of the food that is on or in it."""
    return [
        one.subject
        for one in description.relations
        if one.kind in ("on", "in") and one.targets == (dish,) and not one.way
        and description.objects[one.subject].noun in HELPINGS
    ]  # fmt: skip


def is_dished(group: ObjectGroup, target: ObjectGroup) -> bool:
    """Whether a group is food on a single dish."""
    is_dish = target.noun.name in SERVED_IN_VIEW and len(target.models) == 1
    return is_dish and group.noun.name in HELPINGS and not target.plan.motion.is_moving


def lay_on_dish(
    group: ObjectGroup, target: ObjectGroup, top_m: float, neighbours: int
) -> Float64Array:
    """Spread the copies over a dish beside what is on it already.

    Args:
        group: the food; its offsets change.
        target: the dish.
        top_m: height of the dish's surface over its foot, m.
        neighbours: how many things are on it.

    Returns:
        [3] the middle of the group, m.
    """
    own, before = len(group.models), target.laden
    target.laden += own
    count = max(neighbours, target.laden)
    radius = 0.5 * min(target.models[0].length, target.models[0].width)
    group.offsets = [_spot(number, count, radius) for number in range(before, before + own)]
    group.half = half_extents_over_clip(group.models, group.offsets, group.plan)
    sunk = _SUNK * group.models[0].height if target.noun.name == "bowl" else 0.0
    return np.asarray(target.centre + np.array([0.0, 0.0, top_m - sunk]))


def _spot(number: int, count: int, radius: float) -> tuple[float, float, float]:
    """Place of one of several on a disc, m; the first is nearest to the viewer."""
    if count == 1:
        return (0.0, 0.0, 0.0)
    if count <= _CROWD:
        far = (0.5 if count <= 4 else 0.6) * radius
        angle = 2.0 * math.pi * (number + 0.15) / count
    else:
        far = 0.68 * radius * math.sqrt((number + 0.5) / count)
        angle = math.pi * (3.0 - math.sqrt(5.0)) * number
    return (far * math.sin(angle), -far * math.cos(angle), 0.0)


def _rests(one: SceneObject) -> bool:
    """Whether nothing is said of what it does and where it is."""
    is_still = one.motion is None or one.motion.kind in ("stand", "lie", "sit")
    return is_still and not one.then and one.side is None


def _model(one: SceneObject, nouns: Mapping[str, Noun]) -> Model:
    return nouns[one.noun].build(colour=None, scale=one.scale, seed=0)
