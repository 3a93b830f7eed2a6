"""Parts of one body that a sentence names as things on it: "three candles burn on a cake"."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

from texvent_scenes.description import Claim
from texvent_scenes.models.protocol import PartChoice
from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import SceneDraft

_OF_LAMPS = ("is_lit", "blink_hz", "switch_s")
"""Fields of parts that shine, which are those of the whole."""


def take_parts(draft: SceneDraft) -> None:
    """Merge things on a body into its own parts of that kind: candles on a cake."""
    index = 0
    while index < len(draft.things):
        whole, choice = _find_whole(draft, index)
        if choice is None:
            index += 1
            continue
        thing = draft.things[index]
        draft.things[whole] |= {name: thing[name] for name in _OF_LAMPS if name in thing}
        if not thing.get("is_open"):
            draft.set_part(whole, choice.name, count=min(thing["count"], choice.most))
            _tell_more(draft, thing["count"], choice.most)
        if "colour" in thing and choice.is_coloured:
            draft.set_part(whole, choice.name, colour=thing["colour"])
        _merge(draft, index, whole)


def _find_whole(draft: SceneDraft, index: int) -> tuple[int, PartChoice | None]:
    """The one body on which an object is, and which of its own parts it is."""
    said = draft.things[index]["relations"]
    to: Indices = said[0]["to"] if len(said) == 1 and said[0]["kind"] == "on" else ()
    if len(to) != 1 or draft.things[to[0]]["count"] != 1:
        return index, None
    choice = draft.noun(to[0]).find_choice(draft.things[index]["noun"])
    return to[0], choice if choice is not None and choice.most else None


def _tell_more(draft: SceneDraft, said: int, most: int) -> None:
    """Report the number that is drawn where more are said."""
    for token in draft.tokens if said > most else ():
        if ("count", said) in [one.value for one in token.all("field")]:
            draft.mark(token, str(most))


def _merge(draft: SceneDraft, index: int, whole: int) -> None:
    """Take an object out; all that refers to it refers to another one."""
    del draft.things[index]

    def new(one: int) -> int:
        one = whole if one == index else one
        return one - (one > index)

    for thing in draft.things:
        for relation in thing["relations"]:
            relation["to"] = tuple(map(new, relation["to"]))
    refers: tuple[tuple[dict[str, Any], str], ...] = (
        *((one, "source") for one in draft.effects), (draft.parts["camera"], "target"),
    )  # fmt: skip
    for table, name in refers:
        if table.get(name) is not None:
            table[name] = new(table[name])
    draft.claims = {
        at: [one for one in (_renumbered(one, new) for one in claims)
             if one.subject not in one.targets]
        for at, claims in draft.claims.items()
    }  # fmt: skip
    draft.before_sky = [*map(new, draft.before_sky)]


def _renumbered(claim: Claim, new: Callable[[int], int]) -> Claim:
    subject = None if claim.subject is None else new(claim.subject)
    return replace(claim, subject=subject, targets=tuple(map(new, claim.targets)))
