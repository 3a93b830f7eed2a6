"""Furniture that an activity brings is the one that the prompt names: "types at a white desk"."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from texvent.scenes.description import SceneDescription, SceneObject
from texvent.scenes.models.material_override import in_material
from texvent.scenes.models.materials import STEEL, WOOD, Material
from texvent.scenes.models.people.props import Prop
from texvent.scenes.models.protocol import ModelPart, Pose
from texvent.scenes.staging.acts.cast import Cast

_TABLES = frozenset({"table", "desk", "workbench", "kitchen counter", "counter"})
_MADE_OF: dict[str, Material] = {**dict.fromkeys(_TABLES, WOOD), "laptop": STEEL, "keyboard": STEEL}
"""Noun → what that part of a prop is made of."""
_AT = frozenset({"beside", "at"})


@dataclass
class _Shapes:
    """Parts of a prop as a model."""

    kept: Sequence[ModelPart]
    length: float = 1.0
    width: float = 1.0
    height: float = 1.0

    def parts(self, pose: Pose) -> Sequence[ModelPart]:
        """The same parts in every pose."""
        del pose
        return self.kept


def name_all_props(description: SceneDescription, cast: Cast, count: int) -> None:
    """`name_props` for the first so many actors."""
    for number in range(count):
        if cast.props(number):
            actor = cast.get(number)
            props = name_props(description, actor.object_index, actor.props)
            cast.put(number, replace(actor, props=tuple(props)))


def name_props(
    description: SceneDescription, index: int, props: Sequence[Prop]
) -> list[Prop]:  # fmt: skip
    """The props of a person, who works at the table that the prompt puts there.

    Args:
        description: the scene.
        index: the person among its objects.
        props: what the person's activities need.

    Returns:
        The props, in the colour and material of what they stand for.
    """
    worked = {
        target
        for one in description.relations
        if one.subject == index and one.kind == "work on"
        for target in one.targets
    }
    at = {
        target
        for one in description.relations
        if one.subject in worked | {index} and one.kind in _AT
        for target in one.targets
    }
    tables = [description.objects[n].noun for n in sorted(at)]
    tables = [noun for noun in tables if noun in _TABLES]
    found = []
    for prop in props:
        if prop.furniture == "table" and tables:
            prop = replace(prop, furniture="", nouns=(*prop.nouns, tables[0]))
        for one in description.objects:
            if prop.anchor == "ground" and one.noun in prop.nouns:
                prop = _paint(prop, one)
        found.append(prop)
    return found


def _paint(prop: Prop, one: SceneObject) -> Prop:
    """A prop of which a part has the colour and material of a thing that is named."""
    base = _MADE_OF.get(one.noun)
    colour = one.colour.rgb if one.colour is not None else None
    if base is None or (colour is None and one.material is None):
        return prop

    def draw(time_s: float) -> Sequence[ModelPart]:
        parts = prop.draw(time_s)
        own = [part for part in parts if part.colour == base.colour]
        if one.material is None and colour is not None:
            painted = [replace(part, colour=colour, second_colour=colour) for part in own]
        else:
            model = in_material(_Shapes(own), one.material, colour)
            painted = list(model.parts(Pose(0.0, 0.0, 0.0, "stand")))
        return [part for part in parts if part.colour != base.colour] + painted

    return replace(prop, draw=draw)
