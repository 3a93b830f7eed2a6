"""Outcomes of verbs in a draft: what the staged scene must hold of an act."""

from __future__ import annotations

from collections.abc import Sequence

from texvent_scenes.models.activities import is_mutual
from texvent_scenes.models.tables import trait_values
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.lexicon import VerbSense, word_set, word_table
from texvent_scenes.read.parsing.tokens import Token

EGO = "ego"
"""Needs of an act that is done to the vehicle of the camera."""
_SLOWER = 0.45
"""Speed of a camera that is overtaken, as a share of what overtakes it."""
_ROAD_M_S = 9.0
"""Speed from which on what overtakes a camera needs none that is slower than usual, m/s."""


def _overtake_ego(draft: SceneDraft, verb: Token, index: int) -> None:
    """Let a camera go along, so much slower than who comes past it: "a truck overtakes us"."""
    thing = draft.things[index]
    own = draft.nouns[thing["noun"]].speed_m_s or _ROAD_M_S
    if not any(one["kind"] == "travel" for one in draft.moves):
        draft.add_move({"kind": "travel", "direction": "forward", "means": "drive"})
    if own < _ROAD_M_S:
        thing["motions"][-1].pop("pace", None)
        for move in draft.moves:
            move.setdefault("speed_m_s", round(_SLOWER * own, 2))
    thing.setdefault("placement", "left")
    draft.claim(verb, "overtaken", "", [index])


def meet(draft: SceneDraft, act: VerbSense, verb: Token, subjects: Sequence[int]) -> None:
    """Let several do it to each other: "collide", "shake hands"."""
    who, *others = subjects
    if act.relation == "collide":
        draft.relate(who, "collide", others or [who])
    elif is_mutual(act.kind):
        draft.relate(who, "act on", others or [who])
        draft.claim(verb, "act on", "", [who], others or [who])


def _claim_outcome(
    draft: SceneDraft, act: VerbSense, verb: Token, index: int, objects: Sequence[int]
) -> None:
    """Leave it to the staged scene whether an act has its outcome."""
    outcomes = word_table("outcomes")
    if outcome := outcomes.get(act.who, {}).get(act.kind):
        draft.claim(verb, outcome, "", [index])
    is_machine = draft.things[index]["noun"] in trait_values("gripper")
    if act.relation and is_machine:
        draft.claim(verb, "grip", act.relation, [index], objects)
    elif outcome := outcomes["relation"].get(act.relation):
        draft.claim(verb, outcome, "", [index], objects)


def claim_act(
    draft: SceneDraft, act: VerbSense, verb: Token, index: int, objects: Sequence[int]
) -> None:
    """Leave it to the staged scene whether an object does it."""
    _claim_outcome(draft, act, verb, index, objects)
    if act.brings == EGO:
        _overtake_ego(draft, verb, index)
    if act.kind == "swim":
        draft.claim(verb, "descend", "", [index] if act.direction == "down" else [])
    elif verb.text in word_set("things", "landing"):
        draft.claim(verb, "land", "", [index])
    elif act.kind == "spin" and act.end_pace is not None:
        draft.claim(verb, "pace", "", [index])
    elif act.end_pace == 0.0 and act.kind == "move" and not draft.spins(index):
        draft.claim(verb, "stop", "", [index])
    if act.who == "lamp" and draft.things[index]["noun"] not in word_set("things", "flames"):
        draft.claim(verb, "shine", "", [index])
    if act.who in ("person", "hand", "animal") or act.kind == "lie":
        is_body = act.who != "plain" or draft.walks(index)
        draft.claim(verb, "activity" if is_body else "lie", act.kind, [index])
    elif verb.text in word_set("things", "hung"):
        draft.claim(verb, "ground", False, [index])
    elif act.kind in ("walk", "run", "fly", "hover"):
        draft.claim(verb, "ground", act.kind in ("walk", "run"), [index])


def can_arrive(draft: SceneDraft, subjects: Sequence[int]) -> bool:
    """Whether what stops goes by itself, and nothing is said of how it moves before."""
    things = draft.things
    said = [things[n]["motions"] for n in subjects]
    is_open = all(not one or [{*each} for each in one] == [{"kind"}] for one in said)
    is_open &= all(each["kind"] == "move" for one in said for each in one)  # "passes and stops"
    return is_open and all(map(draft.can_go, subjects))
