"""Worn check: clothes that a body has on, of which the picture shows next to nothing.

Pictures of who wears them in two colours differ where the clothes are seen.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from texvent_scenes.checks.views.pictures import SmallPictures
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.activities import PERSON_NOUNS
from texvent_scenes.models.nouns import NOUNS
from texvent_scenes.models.people.outfit import CLOTHES
from texvent_scenes.models.people.person import dress
from texvent_scenes.rendered_scene import Colour
from texvent_scenes.staging.actors import Actor, size_of
from texvent_scenes.staging.compose import ComposedScene

_DYES: tuple[Colour, Colour] = ((1.0, 0.0, 1.0), (0.0, 1.0, 0.0))
_SHIRT = "shirts"
"""Part of a body that shirts, jackets and dresses cover."""
_LEVELS, _LEAST_SHARE = 12.0, 0.0016
"""Difference of a pixel between both colours, of 255, and share of the image from which on clothes
are seen: the mean over the clip, so that who comes nearer is judged by all that is seen."""


def find_unworn(
    scene: ComposedScene, description: SceneDescription, times: Sequence[float]
) -> Iterator[int]:
    """Indices of clothes that are out of view, hidden or tiny."""
    for one in description.relations:
        clothes = [n for n in one.targets if description.objects[n].noun in CLOTHES]
        has_body = one.subject in {actor.object_index for actor in scene.actors}
        for index in clothes if one.kind == "wear" else ():
            if not has_body:  # a rider, part of a bicycle, has on a shirt of that colour only
                row = CLOTHES[description.objects[index].noun]
                if row["painted"] != [_SHIRT] or "dress" in row or "garments" in row:
                    yield index
                continue
            pictures = [
                SmallPictures(
                    _dyed(scene, one.subject, description.objects[index].noun, dye), times
                )
                for dye in _DYES
            ]
            shares = [
                np.mean(np.abs(first - second).max(axis=-1) >= _LEVELS)
                for first, second in ([each.at(time_s) for each in pictures] for time_s in times)
            ]
            if np.mean(shares) < _LEAST_SHARE:
                yield index


def _dyed(scene: ComposedScene, subject: int, clothes: str, dye: Colour) -> ComposedScene:
    """The scene in which those who wear clothes have them on in a colour."""

    def worn(one: Actor) -> Actor:
        if one.object_index != subject or one.noun.name not in PERSON_NOUNS:
            return one
        usual = NOUNS[one.noun.name]
        scale = size_of(one.model) / size_of(usual.build(colour=None, scale=1.0, seed=0))
        noun = dress(usual, [(clothes, dye, "", None)])
        return replace(one, model=noun.build(colour=None, scale=scale, seed=0))

    return replace(scene, actors=tuple(map(worn, scene.actors)))
