"""Copies of a thing: some of them parted from the others."""

from __future__ import annotations

from copy import deepcopy
from typing import Any

from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import SceneDraft, set_field

OPPOSITE = "opposite"
"""Direction of copies of which a half goes to either side."""
PLURAL_COUNT = 3
"""Copies that a bare plural means."""
_TURNS, _TURN_S = 5, 0.25
"""Copies of what does something one after another, and time between them, s."""


def part_ways(draft: SceneDraft, parted: Indices) -> bool:
    """Lead objects, or halves of one's copies, in opposite directions; False: it is one."""
    is_one = sum(draft.things[index]["count"] for index in parted) < 2
    sides = ("right", "left") if parted[1:] else (OPPOSITE,)
    for number, index in enumerate(() if is_one else parted):
        set_field(draft.things[index], "adverb", "direction", sides[number % len(sides)])
    return not is_one


def part_off(draft: SceneDraft, own: int, count: int) -> dict[str, Any]:
    """Make some of an object's copies an object of their own, the last one."""
    first, other = draft.things[own], len(draft.things)
    part = {**deepcopy(first), "count": count}
    first["count"] -= count
    for one in draft.things:  # "and collide": with each other
        for relation in one["relations"]:
            new = (other,) if one is first else (own, other)
            relation["to"] = tuple(
                index for to in relation["to"] for index in (new if to == own else (to,))
            )
    draft.things += [part] if count else []
    return part


def stack(draft: SceneDraft, own: int) -> None:
    """Put each copy of an object on top of another one."""
    parts = [part_off(draft, own, 1) for _ in range(draft.things[own]["count"] - 1)]
    below = [own, *range(len(draft.things) - len(parts), len(draft.things))]
    for part, index in zip(parts, below, strict=False):
        part["relations"] = [{"kind": "on", "to": (index,)}]


_SWITCH_S = 0.4
"""Time from one lamp to the next, s."""


def take_turns(draft: SceneDraft, own: int) -> None:
    """Let copies of an object begin one after the other; what topples stands in a row."""
    thing = draft.things[own]
    if thing["count"] == PLURAL_COUNT and not any(one.has("field") for one in draft.tokens):
        thing["count"] = _TURNS
    height = draft.nouns[thing["noun"]].build(colour=None, scale=1.0, seed=0).height
    is_row = thing["motions"][-1]["kind"] in ("topple", "fall")
    parts = [thing, *(part_off(draft, own, 1) for _ in range(thing["count"] - 1))]
    for number, part in enumerate(parts):
        part["motions"][-1]["start_s"] = round(_TURN_S * (number + 1), 6)
        part |= {"heading_deg": 0.0} if is_row else {}
        row = {"kind": "right of", "to": (own,), "distance_m": round(1.05 * number * height, 6)}
        part["relations"] += [row] if is_row and number else []


def switch_in_turn(draft: SceneDraft, own: int) -> bool:
    """Switch copies of a lamp one after the other; False: it is none that is switched."""
    thing = draft.things[own]
    if "switch_s" not in thing or thing["count"] < 2:
        return False
    parts = [thing, *(part_off(draft, own, 1) for _ in range(thing["count"] - 1))]
    for number, part in enumerate(parts):
        part["switch_s"] = round(_SWITCH_S * (number + 1), 6)
    return True


def halve(draft: SceneDraft, own: int) -> None:
    """Lead halves of an object's copies to the right and to the left."""
    thing = draft.things[own]
    for half, side in ((part_off(draft, own, thing["count"] // 2), "left"), (thing, "right")):
        for motion in half["motions"]:
            motion |= {"direction": side} if motion.get("direction") == OPPOSITE else {}


def pick(draft: SceneDraft, word: str, count: int, among: Indices = ()) -> list[int]:
    """Part some from the last object of more copies, of those that go; or what was left."""
    many = find_several(draft, among)
    if word in ("other", "others") or not many:
        return draft.left
    draft.left, (own,) = many, many
    if any(one.get("direction") == OPPOSITE for one in draft.things[own]["motions"]):
        halve(draft, own)
        own = len(draft.things) - 1
    if draft.things[own]["count"] > count:
        part_off(draft, own, count)
    return [len(draft.things) - 1] if count in (1, draft.things[-1]["count"]) else []


def find_several(draft: SceneDraft, among: Indices = (), least: int = 2) -> list[int]:
    """The last object of so many copies, of those that go by themselves if there is one."""
    said = among or range(len(draft.things))
    many = [n for n in said if draft.things[n]["count"] >= least]
    able = [one for one in many if draft.can_go(one) and not draft.is_swung(one)]
    return (able or many)[-1:]


def count_like(draft: SceneDraft, own: int) -> int:
    """Number of bodies of an object's noun."""
    noun = draft.things[own]["noun"]
    return sum(one["count"] for one in draft.things if one["noun"] == noun)


def add_like(draft: SceneDraft, own: int) -> list[int]:
    """Add one more of a kind, which does nothing yet: "two goats fight, a third eats"."""
    deed = {key: value for key, value in draft.things[own].items() if key == "deed"}
    return [draft.add(draft.things[own]["noun"], **deed)]
