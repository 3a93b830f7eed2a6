"""Looks of bodies that their models have by themselves, and of what others wear or have in hand."""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator, Mapping, Sequence

import numpy as np

from texvent_scenes.checks.parts import Place
from texvent_scenes.checks.relations import Violation
from texvent_scenes.colours import SURFACES, find_colour
from texvent_scenes.description import Claim, SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.materials import MATERIALS, has_colour
from texvent_scenes.models.protocol import ModelPart, Pose
from texvent_scenes.rendered_scene import Shape, Texture
from texvent_scenes.staging.actors import Actor

_REST = Pose(0.0, 0.0, 0.0, "stand")
_HUES = ("red", "orange", "yellow", "green", "blue", "purple", "pink")
_COLOURFUL = 2
"""Hues of what is colourful."""
_EVEN, _LONG, _FLAT, _MOST = 0.8, 2.5, 0.3, 0.5
"""Ratio of two extents that are about equal; of the longest to the middle one of what is long; of
the height to the others of what is flat; share of a surface that makes its look."""


def has_look(own: Sequence[Actor], claim: Claim, times: Sequence[float], place: Place) -> bool:
    """Whether each, or all copies together, look so."""
    if claim.value == "colourful":
        return _count_hues([part for one in own for part in one.own_parts(_REST)]) >= _COLOURFUL
    look = _LOOKS.get(str(claim.value))
    return look is not None and bool(own) and all(map(look, own))


def find_unlike(
    description: SceneDescription, actors: Sequence[Actor], missing: Container[int]
) -> Iterator[Violation]:
    """Colours and materials that what is part of another body, as a coat is, does not have."""
    bodied = {one.object_index for one in actors}
    for index, thing in enumerate(description.objects):
        if index in bodied or index in missing:
            continue
        own = [part for one in actors for prop in one.props if thing.noun in prop.nouns
               for part in prop.draw(0.0)]  # fmt: skip
        parts = own or [part for one in actors if one.noun.name in PERSON_NOUNS
                        for part in one.own_parts(_REST)]  # fmt: skip
        rgb = find_colour(thing.colour, SURFACES) if thing.colour else None
        if rgb is not None and not any(has_colour([part], rgb) for part in parts):
            yield Violation("colour", str(thing.colour), "")
        named = MATERIALS.get(thing.material or "")
        if named is not None and named.texture not in {part.texture for part in parts}:
            yield Violation("material", str(thing.material), "")


def _count_hues(parts: Sequence[ModelPart]) -> int:
    """Number of hues that enough of the surfaces have."""
    return sum(has_colour(parts, find_colour(hue, SURFACES)) for hue in _HUES)


def _share(actor: Actor, is_counted: Callable[[ModelPart], bool]) -> float:
    """Share of the surface whose parts count."""
    counted = whole = 0.0
    for part in actor.own_parts(_REST):
        sides = np.sort(np.linalg.norm(part.to_body[:, :3], axis=0))
        whole += sides[1] * sides[2]
        counted += sides[1] * sides[2] * is_counted(part)
    return counted / max(whole, 1e-12)


def _sides(actor: Actor) -> tuple[float, float, float]:
    """Extents from the least to the greatest, m."""
    model = actor.model
    least, middle, greatest = sorted((model.length, model.width, model.height))
    return least, middle, greatest


def _is_round(actor: Actor) -> bool:
    """Whether two extents are about equal, and most of it is curved."""
    least, middle, greatest = _sides(actor)
    is_even = least >= _EVEN * middle or middle >= _EVEN * greatest
    return is_even and _share(actor, lambda part: part.shape is not Shape.BOX) >= _MOST


def _is_long(actor: Actor) -> bool:
    _, middle, greatest = _sides(actor)
    return greatest >= _LONG * middle


def _is_flat(actor: Actor) -> bool:
    model = actor.model
    return model.height <= _FLAT * min(model.length, model.width)


def _made_of(*textures: Texture) -> Callable[[Actor], bool]:
    return lambda actor: _share(actor, lambda part: part.texture in textures) >= _MOST


_LOOKS: Mapping[str, Callable[[Actor], bool]] = {
    "round": _is_round,
    "long": _is_long,
    "flat": _is_flat,
    "furry": _made_of(Texture.FUR, Texture.FEATHERS),
    "shiny": _made_of(Texture.METAL, Texture.LACQUER, Texture.PANE, Texture.MIRROR),
    "glowing": lambda actor: any(part.emission > 0.0 for part in actor.own_parts(_REST)),
}
"""Look → whether a body has it."""
