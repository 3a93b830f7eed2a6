"""What a prompt asks for and the staged scene does not show."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import AMID, SceneDescription
from texvent.scenes.evidence import Unmet
from texvent.scenes.staging.claims.acts import Stage, list_acts_not_shown
from texvent.scenes.staging.claims.relations import list_not_shown
from texvent.scenes.staging.claims.shots import list_moves_not_shown
from texvent.scenes.staging.surroundings.scenery.scatter import SceneryItem


def list_missing(
    said: SceneDescription,
    description: SceneDescription,
    surrounding: Sequence[tuple[int, SceneryItem]],
    stage: Stage,
) -> list[Unmet]:
    """Objects, scenery, acts and camera moves that the scene does not show.

    `said` is what the prompt says; `description` may have objects beside, such as a table.
    """
    return [
        *list_not_shown(said, stage.actors, stage.duration_s),
        *_list_missing_scenery(description, surrounding),
        *list_acts_not_shown(stage),
        *list_moves_not_shown(description.shot, stage.camera, stage.duration_s),
    ]


def _list_missing_scenery(
    description: SceneDescription, found: Sequence[tuple[int, SceneryItem]]
) -> list[Unmet]:
    """What should stand around and found no place."""
    shown = {item.noun for _, item in found}
    return [
        Unmet(
            f"{relation.kind} {description.objects[target].noun}",
            relation=(relation.subject, relation.targets),
        )
        for relation in description.relations
        if relation.kind in AMID
        for target in relation.targets
        if description.objects[target].noun not in shown
    ]
