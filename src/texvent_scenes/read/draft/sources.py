"""Sources of effects: what in the scene they come from where the sentence leaves it open."""

from __future__ import annotations

from texvent_scenes.models.tables import trait_value
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.lexicon import word_table


def find_sources(draft: SceneDraft) -> None:
    """Let effects come from what has them: a fireplace its fire, a surfer the spray behind him.

    What always has an effect of that kind has it once.
    """
    table = word_table("comes_from")
    for effect in draft.effects:
        row = table.get(effect["kind"])
        if effect["source"] is not None or row is None:
            continue
        own = draft.find(row.get("nouns", ()))
        others = [one["source"] for one in draft.effects if one["kind"] in row.get("effects", ())]
        movers = [n for n in range(len(draft.things)) if draft.does([n]) & {*row.get("acts", ())}]
        at = next((n for n in (*own, *others, *movers) if n is not None), None)
        effect["source"] = at
        if at is not None and at not in own and at not in others:
            effect["kind"] = row.get("thrown", effect["kind"])
    draft.effects = [one for one in draft.effects if not _is_inherent(draft, one)]


def _is_inherent(draft: SceneDraft, effect: dict[str, object]) -> bool:
    """Whether its source always has an effect."""
    source = effect["source"]
    if not isinstance(source, int):
        return False
    thing = draft.things[source]
    kind: str | None = trait_value("own effect", thing["noun"])
    return bool(thing.get("is_lit", True)) and kind == effect["kind"]
