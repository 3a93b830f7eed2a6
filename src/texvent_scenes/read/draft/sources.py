"""Sources of effects: what in the scene they come from where the sentence leaves it open."""

from __future__ import annotations

from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.tables import trait_value
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.lexicon import word_set, word_table


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
    draft.effects = [one for one in draft.effects
                     if not (_is_inherent(draft, one) or _is_of_lamp(draft, one))]  # fmt: skip


def _is_of_lamp(draft: SceneDraft, effect: dict[str, object]) -> bool:
    """Whether a fire is the flame of a lamp that the scene has: of a candle that burns.

    Such a flame is part of what burns; a fire beside it would be another one.
    """
    burning = [n for n, one in enumerate(draft.things) if one.get("is_lit", True)
               and any(lamp.wave == "flame" for lamp in LAMPS.get(one["noun"], ()))]  # fmt: skip
    said = [one for one in draft.tokens if "fire" in [each.value for each in one.all("effect")]]
    is_so = bool(said and burning) and effect["kind"] == "fire"
    is_so &= effect["source"] in (None, *burning)
    is_so &= {one.text for one in said} <= word_set("things", "own_flames")  # and no "fire"
    for token in said if is_so else ():
        draft.claim(token, "shine", "", burning)
    return is_so


def _is_inherent(draft: SceneDraft, effect: dict[str, object]) -> bool:
    """Whether its source always has an effect."""
    source = effect["source"]
    if not isinstance(source, int):
        return False
    thing = draft.things[source]
    kind: str | None = trait_value("own effect", thing["noun"])
    return bool(thing.get("is_lit", True)) and kind == effect["kind"]
