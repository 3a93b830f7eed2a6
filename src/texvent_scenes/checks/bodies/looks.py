"""Looks of bodies that their models have by themselves, and of what others wear or have in hand."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence

import numpy as np

from texvent_scenes.checks.bodies.parts import Place, is_made_of
from texvent_scenes.checks.clip.relations import Violation
from texvent_scenes.colours import SURFACES, find_colour
from texvent_scenes.description import Claim, SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.materials import MATERIALS, has_colour, share_of
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.models.shapes import bounds
from texvent_scenes.rendered_scene import Shape, Texture
from texvent_scenes.staging.actors import Actor

_REST = Pose(0.0, 0.0, 0.0, "stand")
_HUES = ("red", "orange", "yellow", "green", "blue", "purple", "pink")
_COLOURFUL = 2
"""Hues of what is colourful."""
_HIP_M, _SLENDER, _HIGH_M = 1.0, 1.8, 1.9
"""Height of what is low, m; height of what is tall, in its widths, or m."""
_EVEN, _EGG, _LONG, _FLAT, _MOST, _TINGE = 0.8, 0.65, 2.5, 0.3, 0.5, 0.02
"""Ratio of two extents that are about equal; of those of a ball or an egg; of the longest to the
middle one of what is long; of the height to the others of what is flat; shares of a surface that
make its look, and its colour: a bicycle is red by its frame."""


def has_look(own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place) -> bool:
    """Whether each, or all copies together, look so."""
    if claim.value == "colourful":
        return _count_hues([part for one in own for part in one.own_parts(_REST)]) >= _COLOURFUL
    look = _LOOKS.get(str(claim.value))
    return look is not None and bool(own) and all(map(look, own))


def find_unlike(
    description: SceneDescription, actors: Sequence[Actor], missing: Container[int]
) -> Iterator[Violation]:
    """Colours, materials and numbers that objects do not have as they are drawn.

    What has no body is part of another one's, as a coat is, or comes with an act.
    """
    bodied = {one.object_index for one in actors}
    ridden = {n for one in description.relations if one.kind == "ride"
              and one.subject not in bodied for n in one.targets}  # fmt: skip
    for index, thing in enumerate(description.objects):
        if index in missing:
            continue
        bodies = [one.own_parts(_REST) for one in actors if one.object_index == index]
        props = [prop for one in actors for prop in one.props if thing.noun in prop.nouns]
        parts = [part for prop in props for part in prop.draw(0.0)]
        parts = parts or [
            part for one in actors
            if one.noun.name in PERSON_NOUNS or one.object_index in ridden
            for part in one.own_parts(_REST)
        ]  # fmt: skip
        other = next((prop.nouns[0] for prop in props if prop.nouns[0] != thing.noun), "")
        if other and not bodies:
            yield Violation("noun", thing.noun, f"the {thing.noun}: a {other} is drawn")
        drawn = bodies or [[part] for part in parts]
        is_so = all if bodies else any
        for colour in filter(None, (thing.colour, thing.second_colour)):
            rgb = find_colour(colour, SURFACES)
            if not is_so(has_colour(each, rgb, _TINGE) for each in drawn):
                yield Violation("colour", colour, "")
        kind = MATERIALS[thing.material].texture if thing.material else None
        if kind is not None and not is_so(is_made_of(each, kind) for each in drawn):
            yield Violation("material", str(thing.material), "")
        counts = [prop.count for prop in props] if not bodies else []
        if counts and thing.count not in (sum(counts), *counts):
            yield Violation("count", thing.count, "")


def _count_hues(parts: Sequence[ModelPart]) -> int:
    """Number of hues that enough of the surfaces have."""
    return sum(has_colour(parts, find_colour(hue, SURFACES)) for hue in _HUES)


def _sides(actor: Actor) -> tuple[float, float, float]:
    """Extents from the least to the greatest, m."""
    model = actor.model
    least, middle, greatest = sorted((model.length, model.width, model.height))
    return least, middle, greatest


def _is_round(actor: Actor) -> bool:
    """Whether two extents are about equal, and most of it is curved."""
    least, middle, greatest = _sides(actor)
    is_even = least >= _EVEN * middle or middle >= _EVEN * greatest
    curved = share_of(actor.own_parts(_REST), lambda part: part.shape is not Shape.BOX)
    return is_even and curved >= _MOST


def is_ball(actor: Actor) -> bool:
    """Whether one ellipsoid of about equal extents makes up its shape."""
    parts = [one for one in actor.own_parts(_REST) if one.shape is Shape.ELLIPSOID]
    return any(np.ptp(bounds([one]), axis=0).min() >= _EGG * _sides(actor)[2] for one in parts)


def _is_long(actor: Actor) -> bool:
    _, middle, greatest = _sides(actor)
    return greatest >= _LONG * middle


def _is_flat(actor: Actor) -> bool:
    model = actor.model
    return model.height <= _FLAT * min(model.length, model.width)


def _is_tall(actor: Actor) -> bool:
    """Whether it is higher than wide, or than a person."""
    model = actor.model
    return model.height >= min(_SLENDER * max(model.length, model.width), _HIGH_M)


def _is_low(actor: Actor) -> bool:
    """Whether it is lower than a person's hip, and than it is long."""
    model = actor.model
    return model.height <= min(_HIP_M, max(model.length, model.width))


def _made_of(*textures: Texture) -> Callable[[Actor], bool]:
    return lambda actor: is_made_of(actor.own_parts(_REST), *textures)


_LOOKS: Mapping[str, Callable[[Actor], bool]] = {
    "round": _is_round,
    "long": _is_long,
    "flat": _is_flat,
    "low": _is_low,
    "tall": _is_tall,
    "narrow": _is_long,
    "furry": _made_of(Texture.FUR, Texture.FEATHERS),
    "shiny": _made_of(Texture.METAL, Texture.LACQUER, Texture.PANE, Texture.MIRROR),
    "glowing": lambda actor: any(part.emission > 0.0 for part in actor.own_parts(_REST)),
}
"""Look → whether a body has it."""
