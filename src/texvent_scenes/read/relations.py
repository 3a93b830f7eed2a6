"""Relations of things to each other: those that a scene can have, and that are meant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from texvent_scenes.models.activities import ACTIVITIES, AIMED, ON_TOP, PERSON_NOUNS
from texvent_scenes.models.anchors import has_rim, takes_in
from texvent_scenes.models.people.outfit import can_be_worn, list_props
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import SceneDraft
from texvent_scenes.read.parsing.lexicon import word_set
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.spec.data import ACTED, PLACING, SENT, SPACED, WAYS

OWN_BALL = frozenset({"bounce", "dribble", "juggle"})
"""Activities with a ball that stays by who does them: it meets no wall."""
ALONG = ("along", "down", "up")
"""Prepositions of ways that lead on."""
_DROPPED = frozenset({"move", "fall", "throw", "roll", "bounce", "sink", "fly", "jump"})
"""Motions by which small things come into what is open above."""
_ON_FOOT = frozenset({"climb", "walk", "run", "move"})
"""Motions of who climbs, as they are said."""
_RUNNING = frozenset({"slide", "roll", "drive", "move"})
"""Motions into a body that has no opening: they meet."""
_ROUND = frozenset({"on", "past", "at", "in", "through", "into"})
"""Relations to a ring that those who go have along it."""
SMALL = nouns_with("in hand or on something")
_BED = nouns_with("seat") | word_set("things", "tables")
_WORKED_AT = nouns_with("worked at")
GROUNDS = nouns_with("way") | nouns_with("put down on")
_HANDED = {"into": "in", "in": "in", "on": "on", "to": "on", "above": "on"}


def relate_one(draft: SceneDraft, kind: str, index: int, targets: Indices) -> bool:
    """Relate a thing to others as far as scenes can; whether it is so."""
    thing, noun = draft.things[index], draft.things[targets[0]]["noun"]
    if _is_refused(draft, kind, index, targets):
        return False
    settled = _relate_with(draft, index, targets) if kind == "with" else None
    if settled is not None:
        return settled
    targets = [ridden_by(draft, one, kind) for one in targets]  # "behind the rider"
    used = _use(thing, noun) if kind in ("in", "into", "from", "on", "off") else ""
    kind = used or _choose_relation(draft, kind, index, targets[0])
    sat_at = [one["to"] for one in thing["relations"] if kind == "with" and one["kind"] == "at"]
    if sat_at and draft.nouns[noun].speed_m_s == 0.0:  # "at a table with a laptop"
        return all([draft.relate(one, "on", sat_at[0]) for one in targets])
    tops = [one["to"] for one in thing["relations"] if one["kind"] == "on"
            and draft.things[one["to"][0]]["noun"] in word_set("things", "tables")]  # fmt: skip
    small = [one for one in targets if draft.things[one]["noun"] in SMALL
             and not draft.things[one]["relations"]]  # fmt: skip
    is_still = all(one["kind"] == "stand" for one in thing["motions"])
    for one in small if tops and kind in SPACED and is_still else ():
        draft.relate(one, "on", tops[0])  # "a cup on a table beside a book"
    ends = [draft.things[one] for one in targets]
    if kind == "between" and [one["count"] for one in ends] == [1]:
        ends[0]["count"] = 2  # "between shelves", of which one has several
    return bool(kind) and draft.relate(ridden_by(draft, index, kind), kind, targets)


def _relate_with(draft: SceneDraft, index: int, targets: Indices) -> bool | None:
    """Relate a thing to what it has on, in or about it; None where they are beside each other."""
    thing, noun = draft.things[index], draft.things[targets[0]]["noun"]
    if len(parts := _part_worn(draft, targets)) > 1:
        return all([relate_one(draft, "with", index, each) for each in parts])
    if thing["noun"] in trait_values("circled on"):
        kinds = [_choose_relation(draft, "on", one, index) for one in targets]
        return all([draft.relate(one, kind, [index])
                    for one, kind in zip(targets, kinds, strict=True)])  # fmt: skip
    if thing.get("is_lost") and thing["noun"] in PERSON_NOUNS and noun in SMALL:
        return all([draft.relate(index, "hold", [one]) for one in targets])  # "with a wrench"
    if borne := _bear(draft, index, targets):
        return all([draft.relate(one, borne, [index]) for one in targets])
    if noun in nouns_with("towering"):
        return True  # it stands in the distance
    is_still = not any(_goes_by_itself(draft, one) for one in (index, *targets))
    return False if is_still else None  # "a vase with roses", "a disc with a dot"


def bear_on(draft: SceneDraft, verb: Token, index: int, objects: Indices) -> None:
    """Put things on what carries them: "a robot carrying a box", "a belt carrying bolts"."""
    for one in objects:
        draft.things[one]["motions"] = []
    placed = [relate_one(draft, "on", one, [index]) for one in objects]
    draft.mark(verb, "shown" if placed and all(placed) else "lost")
    draft.claim(verb, "relation", "on", objects, [index])


def lead_on(draft: SceneDraft, verb: Token, index: int, objects: Indices) -> None:
    """Have those who are led come after: "a dog leads a man"."""
    going = [one for one in objects if draft.can_go(one)]
    for one in going:
        draft.things[one]["motions"] = draft.things[one]["motions"] or [{"kind": "move"}]
    placed = [draft.relate(one, "follow", [index]) for one in going]
    draft.mark(verb, "shown" if placed and all(placed) else "lost")


def hand_over(
    draft: SceneDraft, token: Token, kind: str, subjects: Indices, targets: Indices
) -> str:
    """Fate of where a machine takes or leaves things: "picks a box off a belt"; "" = it does not.

    The thing is there at first, or at the end; the staged scene tells.
    """
    if _leave_there(draft, kind, subjects, targets):
        return "shown"
    machines = trait_values("gripper").keys()
    acts = [one for n in range(len(draft.things)) for one in draft.things[n]["relations"]
            if draft.things[n]["noun"] in machines and one["kind"] in ACTED
            and (n in subjects or {*one["to"]} & {*subjects})]  # fmt: skip
    if not acts:
        return _put_by_hand(draft, token, kind, subjects, targets)
    things = [n for one in acts for n in one["to"]]
    is_taken = kind in ("from", "off", "out of") or (acts[-1:] and acts[-1]["kind"] == "lift")
    place = "on" if is_taken else _HANDED.get("on" if token.text == "onto" else kind, "")
    if not (things and place) or kind == "with" or not {*targets}.isdisjoint(things):
        return ""
    is_so = all([draft.relate(one, place, targets) for one in things])
    left = ("relation", "into") if place == "in" else ("arrive", place)
    draft.claim(token, *(("off", "") if is_taken else left), things, targets)
    return "shown" if is_so else "lost"


def _leave_there(draft: SceneDraft, kind: str, subjects: Indices, targets: Indices) -> bool:
    """Whether a place is of what people go away from: "leaves a bag on a bench"."""
    left = draft.targets(subjects, ("from", "out of"))
    is_so = kind in PLACING and bool(left) and all(map(draft.is_put, left))
    is_so &= draft.names(subjects) <= PERSON_NOUNS and {*targets}.isdisjoint(left)
    is_so = is_so and all([relate_one(draft, kind, one, targets) for one in left])
    if is_so and kind in ("on", "in"):  # they go from what bears it
        for row in (one for n in subjects for one in draft.things[n]["relations"]):
            row["to"] = tuple(targets) if {*row["to"]} <= {*left} else row["to"]
        draft.claims = {
            at: [replace(one, targets=tuple(targets)) if {*one.targets} == {*left} else one
                 for one in said]
            for at, said in draft.claims.items()
        }  # fmt: skip
    return is_so


def _put_by_hand(
    draft: SceneDraft, token: Token, kind: str, subjects: Indices, targets: Indices
) -> str:
    """Fate of where people put things: "puts a cup on a table"; "" = they put nothing there.

    Without a bench of its own the act has the thing all along, and does not put it there.
    """
    noun, verb = draft.things[targets[0]]["noun"], draft.last.verb
    acts = [one for n in subjects for one in draft.things[n]["relations"]
            if one["kind"] == "set down" and draft.things[n]["noun"] in PERSON_NOUNS]  # fmt: skip
    place = "on" if token.text == "onto" else {"into": "in"}.get(kind, kind)
    is_put = bool(acts) and place in ("in", "on") and verb is not None
    if not is_put or not {*targets}.isdisjoint(acts[0]["to"]) or noun in GROUNDS:
        return ""
    if place == "on" and all(_use(draft.things[n], noun) for n in subjects):
        for n in subjects:
            draft.relate(n, "beside", targets)
        return "shown"
    things = acts[0]["to"]
    for n in subjects:
        rows = draft.things[n]["relations"]
        draft.things[n]["relations"] = [one for one in rows if one not in acts]
        draft.things[n]["is_lost"] = True
    if verb is not None:
        draft.mark(verb, "lost")
        draft.claims.pop(verb.at, None)
    placed = [relate_one(draft, place, one, targets) for one in things]
    return "shown" if all(placed) else "lost"


def ridden_by(draft: SceneDraft, index: int, kind: str) -> int:
    """Vehicle that goes where its rider goes: "rides a bicycle past a tree"."""
    ridden = draft.targets([index], ["ride"])
    ways = {*WAYS, "through", "follow", "overtake", "behind"} | word_set("things", "passed")
    return ridden[0] if ridden and kind in ways else index


def _part_worn(draft: SceneDraft, targets: Indices) -> list[list[int]]:
    """Things that can be worn, and others: "with glasses and a boy"."""
    worn = {one for one in targets if can_be_worn(draft.things[one]["noun"])}
    parts = [one for one in targets if one in worn], [one for one in targets if one not in worn]
    return [*filter(None, parts)]


def _bear(draft: SceneDraft, index: int, targets: Indices) -> str:
    """Relation of what is with something to it: "a horse with a rider", "a tray with glasses"."""
    bearer, first = draft.things[index]["noun"], draft.things[targets[0]]["noun"]
    if bearer in nouns_with("see-through"):
        return "in"
    if all(map(draft.walks, targets)):
        is_ridden = bearer in word_set("things", "mounts") and first in PERSON_NOUNS
        if trait_value("seats", bearer) is not None and first in PERSON_NOUNS:
            return "in"  # "a boat with two men"
        leads_on = nouns_with("seat") | nouns_with("way") | trait_values("slope").keys()
        return "ride" if is_ridden else "on" if bearer in leads_on else ""
    if draft.can_go(targets[0]):
        return ""
    is_put = bearer in word_set("things", "laden") and first not in nouns_with("seat")
    return "on" if is_put else "in" if bearer in word_set("things", "vessels") else ""


def _is_refused(draft: SceneDraft, kind: str, index: int, targets: Indices) -> bool:
    """Whether an act has another tool, or its place takes no body: "waters flowers with a hose"."""
    noun = draft.things[targets[0]]["noun"]
    if kind == "with":
        return _has_other_tool(draft.things[index], noun)
    return kind == "on" and _takes_no_body(draft, index, noun, targets)


def _takes_no_body(draft: SceneDraft, index: int, noun: str, targets: Indices) -> bool:
    """Whether nothing is put on a thing: slopes of a peak; who works at it stands by it then."""
    thing = draft.things[index]
    is_worked_at = noun in _WORKED_AT and _works(thing) and not _use(thing, noun)
    is_worked_at |= noun in _BED and _has_bench(thing) and not _use(thing, noun)
    if is_worked_at:
        draft.relate(index, "beside", targets)
    return is_worked_at or noun in word_set("things", "peaks")


def _has_other_tool(thing: Mapping[str, Any], noun: str) -> bool:
    """Whether an act has another tool in the right hand than the one that is said."""
    props = [prop for one in thing["motions"] for prop in list_props(one["kind"])]
    is_tool = noun in SMALL | nouns_with("held as a tool") | nouns_with(
        "used like a tool"
    ) and not can_be_worn(noun)
    has_tool = any(prop.anchor == "right hand" for prop in props)
    return is_tool and has_tool and not any(noun in (prop.name, *prop.nouns) for prop in props)


def _has_bench(thing: Mapping[str, Any]) -> bool:
    """Whether an act comes with a bench of its own, which stands on no bed."""
    acts = [one["kind"] for one in thing["motions"]]
    acts = [one for one in acts if one in ACTIVITIES and ACTIVITIES[one].is_at_bench]
    return any(prop.is_below for one in acts for prop in list_props(one))


def _works(thing: Mapping[str, Any]) -> bool:
    """Whether a person does something with the hands there."""
    does = {one["kind"] for one in thing["motions"]} & ACTIVITIES.keys()
    stays = {"stand", "sit", "lie", "jump", "dance", "walk", "run", "crawl", "climb", "sit down",
             "stand up", "kneel", "crouch"}  # fmt: skip
    return thing["noun"] in PERSON_NOUNS and bool(does - stays)


def _use(thing: Mapping[str, Any], noun: str) -> str:
    """Relation to what is used in an act: "pours milk into a cup"; "" = it is not."""
    acts = [one["kind"] for one in thing["motions"]]
    acts += [ON_TOP[one["kind"]] for one in thing["relations"] if one["kind"] in ON_TOP]
    props = [prop for one in acts for prop in list_props(one)]
    used = [one.is_below for one in props if noun in one.nouns]
    return "beside" if any(used) else "hold" if used else ""


def _choose_relation(draft: SceneDraft, kind: str, index: int, other: int) -> str:
    """The relation that is meant, which depends on what stands in it; "" = none."""
    thing, noun = draft.things[index], draft.things[other]["noun"]
    is_among = draft.things[other]["count"] > 1 and _are_going(draft, index, other)
    kind = "between" if kind == "in" and is_among else kind  # "in a traffic jam", "in a crowd"
    kind = _see_inside(kind, draft.nouns[thing["noun"]], noun)
    if kind in WAYS:
        return _choose_way(draft, kind, index, other)
    ends = [one.get("end_pace") for one in thing["motions"]][-1:]
    if kind == "front" and ends == [0.0]:
        return "to"  # "stops in front of a dog", which is in its way
    does = [one["kind"] for one in thing["motions"]]
    is_low = does in (["fall"], ["jump"]) and draft.has_top(other)
    if kind == "from" and (does == ["rise"] or is_low):
        return "off"
    if noun in trait_values("belt speed") and kind in ("past", "down"):
        return kind if draft.can_go(index) else "on"
    if can_be_worn(noun) and kind in ("in", "with"):
        return "wear" if thing["noun"] in PERSON_NOUNS | nouns_with("person on a vehicle") else ""
    if noun in trait_values("circled on") and kind in _ROUND and draft.can_go(index):
        thing["motions"] = thing["motions"] or [{"kind": "orbit"}]
        return "around"
    acts = {one["kind"] for one in thing["relations"]}
    if near := _choose_near(kind, noun, {*does}, acts):
        return near
    if kind == "above" and draft.keeps_to_ground(index):  # no "kicks a ball over a fence"
        return "on" if noun in nouns_with("way") else ""
    if kind == "behind" and draft.goes_like(index, other):  # who brakes keeps no pace
        return "" if "end_pace" in thing["motions"][0] else "follow"
    return kind


def _goes_by_itself(draft: SceneDraft, index: int) -> bool:
    """Whether it goes otherwise than by rolling, as a ball does."""
    return draft.can_go(index) and draft.noun(index).motion != "roll"


def _are_going(draft: SceneDraft, *indices: int) -> bool:
    """Whether all go by themselves."""
    return all(map(draft.can_go, indices))


def _choose_way(draft: SceneDraft, kind: str, index: int, other: int) -> str:
    """The way that is meant, as far as its target has one; "" = none."""
    thing, noun = draft.things[index], draft.things[other]["noun"]
    does, is_led = {one["kind"] for one in thing["motions"]}, bool(draft.things[other]["motions"])
    if kind in ("into", "out of"):
        is_open = noun in trait_values("opening") or noun in nouns_with("closed")
        is_open |= kind == "into" and bool(does) and does <= _DROPPED and has_rim(noun)
        if any(one["kind"] in SENT for one in thing["relations"]):
            return "towards" if kind == "into" and takes_in(noun) else ""
        is_met = bool(does & _RUNNING) and draft.nouns[noun].habitat == "fixed"
        is_met &= trait_value("container", noun) is None
        other_kind = "from" if kind == "out of" else "collide" if is_met else ""
        return kind if is_open else other_kind
    if kind in ("up", "down"):
        if noun in trait_values("slope"):
            return "on" if kind == "down" and does != {"bounce"} else kind
        can_climb = noun in trait_values("climbed") and bool(does) and does <= _ON_FOOT
        if can_climb and draft.walks(index):
            thing["motions"][-1]["kind"] = "climb"  # "goes up a tree"
        return kind if can_climb else ""
    if kind == "off":
        return kind if does & {"jump", "fall", "roll", "slide"} else ""
    acts = {one["kind"] for one in thing["relations"]} & (ACTED - {"push", "pull"})
    return "towards" if is_led or acts or not draft.goes(index) else kind


def _choose_near(kind: str, noun: str, does: set[str], acts: set[str]) -> str:
    """The relation that "at" means, and "on" of work at a table; "" = none other."""
    is_table = noun in word_set("things", "tables")
    if kind != "at":  # "pours water into a glass on a table"
        return "at" if kind == "on" and is_table and does & word_set("things", "at_tables") else ""
    if acts & {*SENT} or does & AIMED:
        return "towards"
    return "" if is_table else "beside"


def _see_inside(kind: str, who: Noun, noun: str) -> str:
    """A relation as that to what is in it, or above its bearer.

    As in "fish swim around a bowl", "a ball through a hoop", "people under umbrellas".
    """
    if kind == "under" and noun in word_set("things", "borne_above"):
        return "hold" if who.name in PERSON_NOUNS else kind
    if kind == "around" and who.habitat == "water" and noun in nouns_with("see-through"):
        return "in"
    return "into" if kind == "through" and noun in trait_values("rim") else kind


def claim_pavement(
    draft: SceneDraft, token: Token, heads: Sequence[Token], subjects: Indices
) -> None:
    """Leave it to the staged scene whether who is on a pavement keeps to it."""
    on_foot = [one for one in subjects if draft.keeps_to_ground(one)]
    for head in heads if token.text in ("on", *ALONG) else ():
        if head.text in word_set("things", "pavements"):
            draft.claim(head, "pavement", "", on_foot)


def lead_bounces(draft: SceneDraft, token: Token, subjects: Indices) -> None:
    """Have what bounces go on as it does so, as "across a table"; who bounces a ball stays."""
    is_way = token.text in ("across", "over", *ALONG)
    for one in subjects if is_way and draft.does(subjects) <= OWN_BALL else ():
        draft.claim(token, "way", "", [one] if draft.does([one]) else [])
        for motion in draft.things[one]["motions"] if token.text != "over" else ():
            motion |= {} if draft.walks(one) else {"direction": motion.get("direction", "across")}
