"""Acts of things: the sense of a verb that they can do, and what they do by it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from texvent_scenes.models.activities import (
    ACTIVITIES,
    ANIMAL_ACTIVITIES,
    DONE_SEATED,
    HAND_NOUNS,
    ON_FOOT,
    PERSON_NOUNS,
    TIMED,
    is_mutual,
)
from texvent_scenes.models.anchors import takes_in
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.models.tables import nouns_with, trait_values
from texvent_scenes.read.draft.abilities import Indices
from texvent_scenes.read.draft.scene_draft import BLINK_HZ, SceneDraft, add_motion
from texvent_scenes.read.parsing.lexicon import VerbSense, list_forms, word_set, word_table
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.read.relations import bear_on, lead_on, relate_one, ridden_by
from texvent_scenes.spec.data import SENT, WAYS
from texvent_scenes.words import list_plurals

_KICKED = nouns_with("kicked or thrown")
_SWITCHED = ("on", "off")
_CARRYING = nouns_with("carries people")
EGO = "ego"
"""Needs of an act that is done to the vehicle of the camera."""
_SLOWER = 0.45
"""Speed of a camera that is overtaken, as a share of what overtakes it."""
_SLOW, _FAST = 0.05, 1.8
"""Paces of a machine that begins to turn: the first and the last."""
_ROAD_M_S = 9.0
"""Speed from which on what overtakes a camera needs none that is slower than usual, m/s."""


def perform(
    draft: SceneDraft, verb: Token, subjects: Indices, objects: Indices, has_object: bool
) -> list[int] | None:
    """Apply the first sense that the subjects can do; who moves, or None: there is none."""
    has_object = has_object or bool(objects)
    act = _choose_act(draft, verb, subjects, objects, has_object)
    if act is None or (has_object and not objects and act.who in ("plain", "body")):
        return None  # what it is done to is not known
    draft.show(verb)
    act = _stand_on(draft, act, verb, objects)
    act = _go_until(draft, act, subjects)
    if act.aims:
        if act.is_near:
            draft.mark(verb, act.relation or "")  # "dunks": it is thrown from afar
        return _send(draft, act, verb, subjects, objects)
    if act.brings not in ("", EGO) and not objects:
        objects = [draft.add(act.brings)]
    is_change = act.kind == "stand" or verb.text.endswith(" down")  # is drawn after another
    if act.is_near and not (is_change and draft.things[subjects[0]]["motions"]):
        draft.mark(verb, act.kind or act.relation or "")
    for index in subjects:
        own = _as_named(draft, act, verb, index)
        _do(draft, own, verb, index)
        claim_act(draft, own, verb, index, objects)
    for index in objects:
        add_motion(draft.things[index], VerbSense(kind=act.object))
        _switch(draft, act.object, index)
        draft.claim(verb, "activity", act.object, [index] if act.object in TIMED else [])
    if not objects:
        meet(draft, act, verb, subjects)
    for index in subjects if act.relation is not None else ():
        _relate_act(draft, act.relation or "", verb, index, objects)
    return list(objects if act.object and objects else subjects)


def _go_until(draft: SceneDraft, act: VerbSense, subjects: Indices) -> VerbSense:
    """The sense of what goes until it stops, where it can arrive."""
    if act.end_pace == 0.0 and act.kind == "stand" and can_arrive(draft, subjects):
        return replace(act, kind="move", is_near=False)
    return act


def _send(
    draft: SceneDraft, act: VerbSense, verb: Token, subjects: Indices, objects: Indices
) -> list[int]:
    """Let a ball be sent to where it counts: "takes a penalty", "shoots and scores"."""
    for index in subjects:
        sent = draft.targets([index], [*SENT]) or list(objects)
        if not draft.targets([index], [*SENT]):
            sent = sent or draft.find(_KICKED)[:1] or [draft.add(act.brings)]
            draft.relate(index, act.relation or "", sent)
        ball = draft.things[sent[0]]["noun"]
        goals = [n for n in draft.targets([index], ["towards", "into"])
                 if takes_in(draft.things[n]["noun"])]  # fmt: skip
        if not goals:
            noun = word_table("scored_in").get(ball, act.aims)
            goals = draft.find([noun])[:1] or [draft.add(noun)]
            draft.relate(index, "towards", goals)
        is_scored = verb.text.split()[0] in word_set("things", "scoring")
        draft.claim(verb, "taken in", "", sent if is_scored else [], goals)
    return list(subjects)


def _as_named(draft: SceneDraft, act: VerbSense, verb: Token, index: int) -> VerbSense:
    """An act as one of several does it who are named by theirs: "a drummer and a pianist play"."""
    deed = draft.things[index].get("deed", "") if verb.text in _list_performing() else ""
    return replace(act, kind=deed) if deed else act


def _stand_on(draft: SceneDraft, act: VerbSense, verb: Token, objects: Indices) -> VerbSense:
    """An act of who rides what carries people in its place, as standing on it: an escalator."""
    if act.relation != "ride" or not objects or not draft.names(objects) <= _CARRYING:
        return act
    draft.mark(verb, "stand")
    return VerbSense(relation="on")


def _relate_act(draft: SceneDraft, kind: str, verb: Token, index: int, objects: Indices) -> None:
    """Relate who acts to what the act is about, on a way that the staged scene holds."""
    who = ridden_by(draft, index, kind)
    about = draft.names(objects)
    if kind == "follow" and about & nouns_with("runs on"):
        kind = "past"  # "follows a pipe"
    is_shot = verb.text.split()[0] in word_set("things", "shooting")
    if kind == "throw" and is_shot and about and about <= word_set("things", "by_foot"):
        kind = "kick"
    if kind == "lead":
        return lead_on(draft, verb, index, objects)
    if kind == "load":
        return bear_on(draft, verb, index, objects)
    if kind == "in" and draft.does([who]) == {"jump"}:  # and stays there
        draft.things[who]["motions"].append({"kind": "stand"})
        draft.claim(verb, "arrive", "in", [who], objects)
    is_left = kind == "out of" and bool(objects) and relate_one(draft, kind, who, objects)
    if (is_left or draft.relate(who, kind, objects)) and kind in WAYS:
        way = draft.things[who]["relations"][-1]["kind"]  # from a stop, along a platform
        draft.claim(verb, "relation", way, [who], objects)


def _switch(draft: SceneDraft, state: str, index: int) -> None:
    """Switch the lamp of what an act lights or puts out."""
    if state in _SWITCHED:
        draft.things[index]["motions"].pop()
        draft.switch(state, index)


def _choose_act(
    draft: SceneDraft, verb: Token, subjects: Indices, objects: Indices, has_object: bool
) -> VerbSense | None:
    """The first sense of a verb that the subjects can do."""
    acts = [one.value for one in verb.all("verb") if subjects]
    done = {draft.things[one].get("deed", "") for one in subjects} - {""}
    words = {draft.things[one].get("word", "") for one in subjects}
    if verb.text in _list_performing() and not done and words & _musicians():
        return None  # of an instrument without its player: no game
    done |= _list_played(draft, subjects) if verb.text in _list_performing() else set()
    if verb.text in _list_performing():
        acts[:0] = [VerbSense("person", one) for one in done]
    acts.sort(key=lambda one: {one.who} != draft.names(subjects))  # a football player dribbles
    acts.sort(key=lambda one: one.kind not in done)  # "swings at a ball": a golfer, a batter
    tools = [one for one in acts if one.who == "person" and _list_tools(one.kind)]
    if act := _act_as_person(draft, tools, subjects, objects, has_object):
        return act  # "a broom sweeping": it does not go
    act = next((one for one in acts if draft.fits(one, subjects, objects, has_object)), None)
    act = act or _act_as_person(draft, acts, subjects, objects, has_object)
    if act and act.kind == "rise" and draft.names(subjects) <= nouns_with("towering"):
        act = replace(act, kind="stand")  # "mountains rise in the distance"
    is_sent = act is None and not has_object and _are_sent(draft, verb, subjects)
    return VerbSense(kind="throw") if is_sent else act


def _are_sent(draft: SceneDraft, verb: Token, subjects: Indices) -> bool:
    """Whether balls are struck by who is not said: "a shuttlecock smashed at the camera"."""
    is_struck = any(one.value.relation in SENT for one in verb.verbs("ed"))
    nouns = draft.names(subjects)
    return is_struck and bool(nouns) and nouns <= trait_values("struck with").keys() | _KICKED


def _act_as_person(
    draft: SceneDraft, acts: Sequence[VerbSense], subjects: Indices,
    objects: Indices, has_object: bool,
) -> VerbSense | None:  # fmt: skip
    """An act of people that hands or their tools do: "hands typing", "a pen writing"."""
    things = [draft.things[one] for one in subjects]
    of_hands = word_set("things", "of_bodies")
    acts = [one for one in acts if one.who == "person" or one.relation in of_hands]
    if not all(one["noun"] in HAND_NOUNS for one in things):
        acts = [act for act in acts if {one["noun"] for one in things} <= _list_tools(act.kind)]
    if not (things and acts):
        return None
    said = [(one["noun"], one["count"]) for one in things]
    for one in things:
        one |= {"noun": "person", "count": 1}
    for act in acts:
        if draft.fits(act, subjects, objects, has_object):
            _tell_hands(draft, act, {noun for noun, _ in said})
            return act
    for one, (noun, count) in zip(things, said, strict=True):
        one |= {"noun": noun, "count": count}
    return None


def _tell_hands(draft: SceneDraft, act: VerbSense, nouns: set[str]) -> None:
    """Report hands as whose whole body is drawn, and fingers, which are not made out.

    Of hands at work a close view tells enough.
    """
    for token in (one for one in draft.tokens if one.nouns & HAND_NOUNS):
        is_named = any(one in token.text for one in HAND_NOUNS)
        if act.relation in word_set("things", "of_bodies"):
            draft.mark(token, "person")  # all of whom bends down
        elif nouns <= HAND_NOUNS and not is_named:
            draft.mark(token, "hand")  # "fingers typing"
    if nouns <= HAND_NOUNS and act.kind in ACTIVITIES and act.relation not in SENT:
        draft.parts["camera"].setdefault("framing", "close")  # no more is said of whose


def _do(draft: SceneDraft, act: VerbSense, verb: Token, index: int) -> None:
    """Let an object do it; a flame burns and flickers by itself."""
    thing = draft.things[index]
    if act.kind == "move" and draft.last.goes_on and ridden_by(draft, index, "past") != index:
        return  # it is ridden on: "rides a bicycle, passing a car"
    if thing["noun"] in nouns_with("flows") and act.kind in word_set("effects", "motions"):
        return  # its water does so
    if act.who not in ("source", "lamp"):
        before = [one["kind"] for one in thing["motions"]]
        if before[-1:] and before[-1].startswith("show ") and act.kind.startswith("turn "):
            thing["motions"].pop()  # "a red light turns green", as it does anyway
            state = before.pop()
            draft.claims = {at: [one for one in said if one.value != state]
                            for at, said in draft.claims.items()}  # fmt: skip
        add_motion(thing, act, goes_on=draft.last.goes_on)
        if (row := ANIMAL_ACTIVITIES.get(act.kind)) and row.effect:
            draft.add_effect(verb, row.effect, [index])
        is_seated = before[-1:] in (["sit"], ["lie"]) and act.kind in {*DONE_SEATED, "type"}
        is_begun = find_aspect(draft, verb) is not None  # "waits and starts driving"
        is_later = draft.last.goes_on and verb.verbs("ing") and len(thing["motions"]) > len(before)
        is_end = act.kind == "break"  # of a fall: "falls, shattering"
        is_after = is_later and before and not (is_seated or is_end or is_begun)
        if is_after and not (draft.walks(index) and _join(thing["motions"])):
            draft.mark(verb, f"then {act.kind}")  # "walks, waving": not at once
    elif act.who == "lamp" and act.kind in _SWITCHED:
        draft.switch(act.kind, index)
    elif thing["noun"] not in word_set("things", "flames"):
        if act.who == "lamp":
            thing["blink_hz"] = BLINK_HZ
        else:
            draft.add_effect(verb, act.kind, [index])


def find_aspect(draft: SceneDraft, verb: Token) -> Token | None:
    """The word before a verb that says that it begins: "starts to spin", "begins moving"."""
    before = draft.beside(verb, -1)
    before = draft.beside(verb, -2) if before.text == "to" else before
    return before if before.text in word_set("things", "inceptive") else None


def begin(draft: SceneDraft, verb: Token, subjects: Indices) -> None:
    """Let who begins to do something rest before; machines gain speed."""
    aspect = find_aspect(draft, verb)
    if aspect is None or not subjects:
        return
    for index in subjects:
        motions = draft.things[index]["motions"]
        is_machine = draft.noun(index).is_working and not draft.can_go(index)
        is_machine &= len(motions) == 1 and motions[0]["kind"] in ("spin", "work", "turn", "move")
        if is_machine:
            motions[0] |= {"kind": "work", "pace": _SLOW, "end_pace": _FAST}
        elif len(motions) == 1 and motions[0]["kind"] != "stand":
            motions.insert(0, {"kind": "stand"})
    draft.mark(aspect, "shown" if all(draft.things[n]["motions"] for n in subjects) else "lost")
    draft.claim(aspect, "begin", "", subjects)


def _join(motions: list[dict[str, Any]]) -> bool:
    """Let an act of the arms be done on the way: "walks, waving", "talks on a phone, walking"."""
    way = [one for one in motions if one["kind"] in ON_FOOT and "end_pace" not in one]
    acts = [one for one in motions if one["kind"] in DONE_SEATED]
    if not len(motions) == 2 * len(way) == 2 * len(acts) == 2:
        return False
    motions[:] = [*way, {**acts[0], "start_s": 0.0}]
    return True


def _list_tools(activity: str) -> set[str]:
    """Nouns that a person has in hand in an act."""
    props = (one for one in list_props(activity) if one.anchor.endswith("hand"))
    return {noun for prop in props for noun in prop.nouns}


def _list_played(draft: SceneDraft, subjects: Indices) -> set[str]:
    """Acts on instruments at which subjects are, or that they have: "sits at a piano and plays"."""
    near = draft.names(draft.targets(subjects, ("at", "on", "beside", "hold", "with")))
    plays = (one for one in ACTIVITIES if one.startswith("play "))
    return {one for one in plays if any(near & {*prop.nouns} for prop in list_props(one))}


@cache
def _musicians() -> frozenset[str]:
    """Words of musicians who are not drawn playing: "cellists"."""
    said = word_set("things", "musicians")
    return frozenset(form for one in said for form in (one, *list_plurals(one)))


@cache
def _list_performing() -> frozenset[str]:
    """Forms of verbs for an act that a person does anyway: "plays", of a violinist."""
    verbs = word_set("things", "performing")
    return frozenset(form for verb in verbs for form, _ in list_forms(verb))


def claim_act(draft: SceneDraft, act: VerbSense, verb: Token, index: int, objects: Indices) -> None:
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
    if act.who in ("person", "hand", "animal", *PERSON_NOUNS) or act.kind == "lie":
        is_body = act.who != "plain" or draft.walks(index)
        draft.claim(verb, "activity" if is_body else "lie", act.kind, [index])
    elif verb.text in word_set("things", "hung"):
        draft.claim(verb, "ground", False, [index])
    elif act.kind in ("walk", "run", "fly", "hover"):
        draft.claim(verb, "ground", act.kind in ("walk", "run"), [index])


def _claim_outcome(
    draft: SceneDraft, act: VerbSense, verb: Token, index: int, objects: Indices
) -> None:
    """Leave it to the staged scene whether an act has its outcome."""
    outcomes = word_table("outcomes")
    if outcome := outcomes.get(act.who, {}).get(act.kind):
        draft.claim(verb, outcome, "", [index])
    draft.claim(verb, "run", act.pace, [index] if act.kind == "run" else [])
    if act.kind == "work" and verb.text.split()[-1] in word_set("things", "rounds"):
        draft.claim(verb, "rounds", "", [index])
    is_machine = draft.things[index]["noun"] in trait_values("gripper")
    if verb.text.split()[0] in word_set("things", "stacking"):
        draft.claim(verb, "stack", "end", objects[:1])
    if act.relation and is_machine:
        draft.claim(verb, "grip", act.relation, [index], objects)
    elif outcome := outcomes["relation"].get(act.relation):
        draft.claim(verb, outcome, "", [index], objects)


def can_arrive(draft: SceneDraft, subjects: Indices) -> bool:
    """Whether what stops goes by itself, and nothing is said of how it moves before."""
    things = draft.things
    said = [things[n]["motions"] for n in subjects]
    is_open = all(not one or [{*each} for each in one] == [{"kind"}] for one in said)
    is_open &= all(each["kind"] == "move" for one in said for each in one)  # "passes and stops"
    return is_open and all(map(draft.can_go, subjects))


def meet(draft: SceneDraft, act: VerbSense, verb: Token, subjects: Indices) -> None:
    """Let several do it to each other: "collide", "shake hands"."""
    who, *others = subjects
    if act.relation == "collide":
        draft.relate(who, "collide", others or [who])
    elif is_mutual(act.kind):
        draft.relate(who, "act on", others or [who])
        draft.claim(verb, "act on", "", [who], others or [who])


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
