"""Colours by which one of several is told apart: the others have none of them by chance."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.colours import name_colour, rgb_of
from texvent_scenes.description import SceneDescription
from texvent_scenes.models.materials import colour_share, share_of
from texvent_scenes.models.protocol import Noun, Pose
from texvent_scenes.rendered_scene import Colour

_REST = Pose(0.0, 0.0, 0.0, "stand")
_TRIES, _LITTLE, _MUCH = 24, 0.04, 0.2
"""Bodies that are tried; shares of a surface below which a colour is not noticed, and from which on
it is the body's own."""


def list_telling(description: SceneDescription, index: int) -> list[Colour]:
    """Colours that are said of others of an object's noun, and of what those wear.

    An object of which a colour is said itself has no other one.
    """
    objects, noun = description.objects, description.objects[index].noun
    others = {n for n, one in enumerate(objects) if n != index and one.noun == noun}
    worn = {n for one in description.relations if one.kind == "wear" and one.subject in others
            for n in one.targets}  # fmt: skip
    said = (rgb_of(objects[n].colour) for n in sorted(others | worn))
    is_free = objects[index].colour is None
    return [one for one in said if one is not None and is_free]


def unlike(noun: Noun, seed: int, told: Sequence[Colour]) -> int:
    """The seed, or one near it, whose body has the least of some colours."""
    best, least = seed, _share(noun, seed, told)
    for one in range(seed + 1, seed + _TRIES):
        if least <= _LITTLE:
            break
        if (own := _share(noun, one, told)) < least:
            best, least = one, own
    return best


def note_alike(noun: Noun, seeds: Sequence[int], told: Sequence[Colour]) -> list[str]:
    """A note on copies that have such a colour all the same, as uniforms and swans have."""
    if not any(_share(noun, one, told) >= _MUCH for one in seeds):
        return []
    return [
        f"the {noun.name} of which a colour is said is not told apart by it: others have it too"
    ]


def _share(noun: Noun, seed: int, told: Sequence[Colour]) -> float:
    """The greatest share of a body's surface that one of some colours has, by name or about."""
    if not told:
        return 0.0
    parts = noun.build(colour=None, scale=1.0, seed=seed).parts(_REST)
    names = {name_colour(one) for one in told}
    named = share_of(parts, lambda part: name_colour(part.colour) in names and part.mesh is None)
    return max(named, *(colour_share(parts, one) for one in told))
