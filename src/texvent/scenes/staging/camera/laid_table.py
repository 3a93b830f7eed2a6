"""Still lifes: things on a table, which the camera sees from near and obliquely from above."""

from __future__ import annotations

from collections.abc import Mapping

from texvent.scenes.description import SceneDescription
from texvent.scenes.models.people.activities import PERSON_NOUNS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.traits import nouns_with

ELEVATION_RAD = 0.5
"""Of a camera that looks at things on a table: plates are seen from above,
bottles from the side."""
FILL = 0.7
"""Share of the image that they fill, before the table top."""
_TOPS = nouns_with("table")
_LIES = frozenset({"on", "in"})


def list_laid(description: SceneDescription, nouns: Mapping[int, Noun]) -> frozenset[int]:
    """Objects on tables, where the prompt names nothing else but the tables.

    Empty where a person is at the table, or something moves: then the camera is about that.

    Args:
        description: what the prompt says.
        nouns: of its objects that are staged, by their index.
    """
    objects = description.objects
    tops = {n for n, one in enumerate(objects) if one.noun in _TOPS}
    laid: set[int] = set()
    for _ in objects:  # a cake on a plate on a table
        laid |= {
            one.subject
            for one in description.relations
            if one.kind in _LIES and set(one.targets) <= tops | laid and one.subject in nouns
        }
    is_said = description.shot.framing is not None or description.shot.view is not None
    rest = set(nouns) - laid - tops
    lives = any(nouns[n].habitat != "fixed" for n in laid)
    moves = any(one.motion is not None and one.motion.is_moving for one in objects)
    return frozenset() if is_said or rest or lives or moves else frozenset(laid)


def is_on_table(description: SceneDescription, index: int) -> bool:
    """Whether an object is on a table: a snail, a cat."""
    return description.shot.view is None and any(
        one.kind == "on"
        and one.subject == index
        and description.objects[one.targets[0]].noun in _TOPS
        and description.objects[index].noun not in PERSON_NOUNS
        for one in description.relations
    )
