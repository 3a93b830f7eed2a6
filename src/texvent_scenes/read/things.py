"""Things of a sentence: noun groups named, and what is said of them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import cache
from typing import Any

from texvent_scenes.colours import SURFACES
from texvent_scenes.description import SEEN
from texvent_scenes.models.activities import (
    ANIMAL_ACTIVITIES,
    DONE_SEATED,
    HAND_NOUNS,
    PERSON_NOUNS,
    TIMED,
)
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.materials import has_colour
from texvent_scenes.models.people.outfit import list_props
from texvent_scenes.models.protocol import Noun, Pose
from texvent_scenes.models.tables import nouns_with, read_table, trait_value, trait_values
from texvent_scenes.read.again import find_whole_of, is_again, list_kinds
from texvent_scenes.read.draft import BLINK_HZ, PLURAL_COUNT, SceneDraft, add_motion, names_place
from texvent_scenes.read.groups import Group, Phrase, is_trajectory, ordinals
from texvent_scenes.read.lexicon import (
    NounSense,
    Sense,
    VerbSense,
    deeds,
    owned_parts,
    states,
    word_set,
)
from texvent_scenes.read.outcomes import EGO, can_arrive, claim_act, meet
from texvent_scenes.read.prepositions import bear_on, lead_on, relate_one, ridden_by, set_before
from texvent_scenes.read.tokens import NO_TOKEN, Token
from texvent_scenes.spec.data import SENT, WAYS
from texvent_scenes.spec.scene import MAX_BODIES
from texvent_scenes.words import list_verb_forms

_IN_WIND = frozenset({"sway", "fly", "float", "hover", "sail"})
"""Motions in which the wind shows."""
_KICKED = nouns_with("kicked or thrown")
_SWITCHED = ("on", "off")


class ThingReader:
    """Adds things to a draft, and says of them what adjectives, adverbs and verbs say."""

    def __init__(self, draft: SceneDraft, nouns: Mapping[str, Noun]) -> None:
        self._draft = draft
        self._nouns = nouns
        self._nearest: list[int] = []
        """Objects of the last noun group."""
        self._is_then = False
        """Whether it happens after what was said before: "then"."""
        self._goes_on = False
        """Whether it happens while all that was said of its subjects before."""
        self._is_lost = False
        """Whether the last clause was about several things that are not known."""

    # Noun groups

    def _pick(self, group: Group, known: int) -> list[int]:
        """Some of several things, or the others: "two dogs, a brown one and a white one".

        What is named again is one of the first `known` things: "four teenagers play, one player".
        """
        draft, whole = self._draft, find_whole_of(self._draft, group, known)
        for each in group.of.groups if group.of is not None and group.picks else ():
            whole += self._name(each)  # "two of the dogs"
        if whole and group.head is not None and group.noun is not None:
            noun = draft.things[whole[0]]["noun"]
            draft.mark(group.head, "shown" if group.noun.noun == noun else noun)
        elif not group.picks or (self._is_lost and not whole):
            return []  # "three wugs hang, one falls"
        several = draft.find_several(whole)
        like = several or draft.find_several(least=1) * (group.picks == "another")
        is_new = bool(like) and (not several or draft.count_like(like[0]) < group.ordinal)
        picked = draft.add_like(like[0]) if is_new else draft.pick(group.picks, group.count, whole)
        which = word_set("things", "members") | ({*ordinals()} if not is_new else set())
        for token in (*group.modifiers, *group.unknown) if picked else ():
            self._say(token, picked)
            draft.show(*([token] if token.text == group.picks and token.text not in which else []))
        return picked

    def _name(self, group: Group, relation: str = "", owners: Sequence[int] = ()) -> list[int]:
        """Add what a group names; the indices of its objects, at most one."""
        head = group.head
        found: list[int] = []
        if head is not None and relation in word_set("things", "by_effects"):
            head = _see_as_thing(head)
            group = replace(group, head=head)
        if head is not None and (formed := _list_formed(group, head)):
            self._draft.mark(head, "lost")
            return [index for one in formed for index in self._name(one, relation, owners)]
        if head is not None and names_place(head, relation) and not is_trajectory(group):
            self._draft.set_place(group, head, relation)
        elif head is not None and (whole := self._find_whole(group)):
            self._draft.mark(head, "lost")
            found = self._name(whole, relation, owners)
            return found if relation else []  # what a part does, the whole does not
        elif head is not None and head.has("noun", "pose"):
            found = self._pose_again(group, head)
            if not (found or head.at in self._draft.fates):
                found = self._name_thing(group, head)
        else:
            self._name_others(group, relation, owners)
        phrase = group.of or Phrase(head or NO_TOKEN, ())
        for content in phrase.groups:
            self._fill(found, content, phrase.preposition)
        return found

    def _name_others(self, group: Group, relation: str, owners: Sequence[int]) -> None:
        """Add an effect, light or weather, or nothing that is known."""
        head = group.head
        for token in group.unknown if relation not in ("", "with") else ():
            if names_place(token, relation):  # "in a city centre"
                self._draft.set_place(Group(token), token, relation)
        self._light_own(group)
        for token in (*group.modifiers, *([head] if head else [])):
            effect = token.first("effect")
            is_mark = relation == "with" and any(map(self._draft.walks, owners))
            marks = word_set("things", "marks") if is_mark else ()
            if not self._draft.set_scene(token) and effect and effect.value not in marks:
                self._draft.add_effect(token, effect.value, owners)

    def _find_whole(self, group: Group) -> Group | None:
        """The thing of which a group names a part that is not drawn alone: "the bell of a church".

        A person or an animal has things, and what is in a vessel is no whole.
        """
        whole = group.of.groups[0] if group.of is not None and group.of.groups else None
        part = group.noun.noun if group.noun else ""
        if whole is None or whole.noun is None or not whole.article or group.article != "the":
            return None
        apart = word_set("things", "vessels") | word_set("things", "depictions")
        is_apart = (
            part in apart
            or any(
                one in self._nouns and self._nouns[one].speed_m_s for one in (part, whole.noun.noun)
            )
            or whole.noun.noun in PERSON_NOUNS
        )
        return None if is_apart else whole

    def _light_own(self, group: Group) -> None:
        """Switch the lamps of the last thing that has some: "its headlights are on"."""
        lamps = [n for n, one in enumerate(self._draft.things) if one["noun"] in LAMPS][-1:]
        is_owned = lamps and group.article in word_set("things", "owners")
        for token in group.unknown if is_owned else ():
            if ("is_lit",) in [one.value[:1] for one in token.all("field")]:
                self._say(token, lamps)

    def _fill(self, vessels: Sequence[int], content: Group, token: Token) -> None:
        """Add a place, or what is in a vessel or place: "of apples"; else its part is not known."""
        head, nouns = content.head, [self._draft.things[one]["noun"] for one in vessels]
        kinds = (("in", "vessels"), ("on", "laden"), ("on", "loaded"))
        bearing = next((kind for kind, one in kinds if word_set("things", one) & {*nouns}), "")
        if head is not None and names_place(head, ""):
            self._name(content, "in")
        elif head and not head.is_liquid and bearing:
            for index in self._name(content):
                self._draft.relate(index, bearing, vessels)
                self._draft.show(token)
            self._nearest = list(vessels)
        elif token.has("containing") and not vessels:
            for index in self._name(content):
                self._draft.things[index]["count"] = 2 * PLURAL_COUNT
                self._draft.show(token)

    def _name_thing(self, group: Group, head: Token) -> list[int]:
        draft, noun = self._draft, group.noun
        is_owned = group.article in word_set("things", "owners")
        known = [n for n, one in enumerate(draft.things) if noun and one["noun"] == noun.noun]
        known = known or (list_kinds(draft, head) if group.article == "the" else [])
        is_owned |= any(one["noun"] in PERSON_NOUNS for one in draft.things)
        owners = owned_parts().get(head.text, {}).keys() & {one["noun"] for one in draft.things}
        if owners and group.article in word_set("things", "owners") | {"the", ""}:
            draft.show(head)
            return []  # "a cyclist falls off his bike", "a car stops and the door opens"
        is_part = noun and ((is_owned and noun.noun in HAND_NOUNS) or group.article == "its")
        if len(draft.things) == MAX_BODIES or (is_part and not known):
            return []  # "his hands", "with its propellers": parts of a body
        members = noun.members if noun is not None else ()
        if members:
            return self._name_members(group, head, members)
        draft.show(head)
        is_plain = not group.modifiers and not group.unknown
        is_same = bool(known) and group.is_plural == (draft.things[known[-1]]["count"] > 1)
        if is_same and is_plain and is_again(draft, group, head, known[-1]):
            self._nearest = known[-1:]  # "the car", where there is one
            return known[-1:]
        if noun is not None:
            thing: dict[str, Any] = {"noun": noun.noun, "motions": []}
            thing |= {"word": head.text}
            thing |= {"deed": deed} if (deed := deeds().get(head.text)) else {}
            if noun.is_kind:
                draft.mark(head, noun.noun)
        else:
            who, activity = head.all("pose")[0].value
            thing = {"noun": who, "motions": [{"kind": activity}]}
        many = trait_value("bodies of a plural", thing["noun"]) or PLURAL_COUNT
        count = many if group.is_plural else 1
        is_open = group.is_plural and not any(
            each.value[0] == "count" for one in group.modifiers for each in one.all("field")
        )
        own = {"is_open": True} if is_open else {}
        draft.things.append({**thing, **own, "count": count, "relations": []})
        index = len(draft.things) - 1
        draft.show_inherent(group.unknown, draft.things[index]["noun"])
        self._say_modifiers(group, index)
        for token in group.unknown if not self._draft.can_go(index) else ():
            if names_place(token, "") and not token.has("noun"):  # "a kitchen table"
                self._draft.set_place(Group(token), token, "")
        draft.name_kind((*group.unknown, *group.modifiers), head, draft.things[index]["noun"])
        if any(one.text in word_set("things", "stacks") for one in group.modifiers):
            draft.stack(index)
        self._nearest = [index]
        return [index]

    def _pose_again(self, group: Group, head: Token) -> list[int]:
        """Let who is there do what is named: "during a slow pirouette"."""
        if head.has("noun"):
            return []
        who, activity = head.all("pose")[0].value
        able = PERSON_NOUNS if who == "person" else {who}
        same = [n for n, one in enumerate(self._draft.things) if one["noun"] in able
                and (self._is_then or who == "person" or not one["motions"])][-1:]  # fmt: skip
        if who in HAND_NOUNS and {one["noun"] for one in self._draft.things} & PERSON_NOUNS:
            self._draft.mark(head, "shown" if same else "lost")  # "holds it with two fingers"
            return same
        for index in same:
            self._draft.show(head)
            if activity not in [one["kind"] for one in self._draft.things[index]["motions"]]:
                add_motion(self._draft.things[index], VerbSense(who, activity))
            self._draft.claim(head, "activity", activity, [index])
            self._say_modifiers(group, index)
        return same if self._is_then else []

    def _name_members(
        self, group: Group, head: Token, members: Sequence[tuple[str, int]]
    ) -> list[int]:
        """Add those who are a couple, a family or a crowd; a "family of ducks" is not known."""
        draft = self._draft
        if group.of is not None or len(draft.things) + len(members) > MAX_BODIES:
            return []
        draft.show(head)
        self._nearest = [len(draft.things) + one for one in range(len(members))]
        for noun, count in members:
            draft.things.append({"noun": noun, "motions": [], "count": count, "relations": []})
        for index in self._nearest:
            self._say_modifiers(group, index)
        return self._nearest

    def _say_modifiers(self, group: Group, index: int) -> None:
        """Apply adjectives; "a black and white football" has both colours by itself."""
        draft, own, noun = self._draft, list[Token](), self._draft.things[index]["noun"]
        fields = ((one, one.first("field")) for one in group.modifiers)
        colours = {one: said.value[1] for one, said in fields
                   if said is not None and said.value[0] == "colour"}  # fmt: skip
        bodies = (self._nouns[noun].build(colour=None, scale=1.0, seed=seed) for seed in range(3))
        parts = [one.parts(Pose(0.0, 0.0, 0.0, "stand")) for one in bodies if len(colours) > 1]
        if parts and all(
            has_colour(each, SURFACES[one]) for each in parts for one in colours.values()
        ):
            own = [*colours]
        for token in group.modifiers:
            if token in own:
                draft.claim(token, "colour", colours[token], [index])
                continue
            if token.text in word_set("things", "rows"):
                draft.claim(token, "row", "along", [index])
            if token.text in word_set("things", "heaps"):
                draft.claim(token, "stack", "", [index])
            is_side = token.text in ("left", "right")  # "the left ball"
            draft.show(*([token] if token.has("hollow", "partitive") or is_side else []))
            draft.things[index] |= {"placement": token.text} if is_side else {}
            self._say(token, [] if is_side else [index])

    # What is said of things

    def _say(self, token: Token, subjects: Sequence[int]) -> None:
        """Apply an adjective, an adverb, a participle, or a word of the scene."""
        draft, light = self._draft, self._draft.parts["light"]
        said = token.first("field", "picture", "adverb")
        field, value = said.value if said is not None else ("", "")
        subjects = draft.find_unsaid(field, subjects, self._nearest)
        things = [draft.things[index] for index in subjects]
        if field == "distance_m" or self._say_at_once(token, field, value, subjects):
            return
        if field == "rate_hz" and "flicker_hz" in light and not things:
            light["flicker_hz"] = value
        elif field == "picture" and draft.things:
            (things or draft.things)[-1]["picture"] = vars(value)
        elif self._is_open(field, things):
            is_told = field in ("colour", *word_set("things", "claimed"))
            return draft.claim(token, field, value, subjects if is_told else [])
        elif value == "opposite":
            if not draft.part_ways(subjects):
                return
        elif said is not None and things:
            for index in subjects:
                draft.say_field(token, said, index)
            is_aside = token.text in word_set("things", "aside")
            draft.claim(token, "aside", "", subjects if is_aside else [])
            draft.claim(token, "reverse", "", subjects if value == "backward" else [])
            is_lamp = field == "rate_hz" and all("blink_hz" in one for one in things)
            draft.claim(token, "shine" if is_lamp else SEEN, "", subjects)
        else:
            if not self._draft.set_scene(token, things) and things and token.verbs("ing", "ed"):
                self._act(token, subjects, [], has_object=False)
            return
        draft.show(token)

    def _say_at_once(self, token: Token, field: str, value: Any, subjects: Sequence[int]) -> bool:
        """Apply a state of what opens, or the speed of a view; a dark tunnel is not painted."""
        draft, state = self._draft, states().get(token.text)
        if field == "colour" and token.text in word_set("things", "shades"):
            lit = nouns_with("passage") | nouns_with("has a door") | LAMPS.keys()
            return any(draft.things[n]["noun"] in lit and not draft.can_go(n) for n in subjects)
        acts = [self._nouns[draft.things[index]["noun"]].acts for index in subjects]
        if acts and state and (not field or all(state in one for one in acts)):
            self._set_state(token, subjects)
            return True
        if field == "set" and (subjects or self._nearest):
            return set_before(draft, token, value, subjects or self._nearest)
        if field == "in_turn" and not subjects and draft.effects:
            draft.show(*([token] if draft.effects[-1]["kind"] == "drip" else []))
            return True  # drops fall one by one
        for one in subjects if field == "in_mouth" else ():
            draft.take_in_mouth(one)
        if field == "wind":
            is_blown = [self._blow(index) for index in subjects] or [bool(draft.effects)]
            draft.show(*([token] if all(is_blown) else []))
            return True
        nouns = {draft.things[one]["noun"] for one in subjects}
        is_still = nouns <= nouns_with("fits who goes through")  # "a tunnel exit, 60 km/h"
        is_way = is_still and draft.set_journey(field, value)
        draft.show(*([token] if is_way else []))
        return is_way

    def _blow(self, index: int) -> bool:
        """Let things sway in the wind; whether the wind shows in their motion."""
        thing, noun = self._draft.things[index], self._nouns[self._draft.things[index]["noun"]]
        if noun.is_working or {one["kind"] for one in thing["motions"]} & _IN_WIND:
            return True
        if noun.habitat == "fixed" or noun.motion == "stand":
            thing["motions"] = [{"kind": "sway"}]
        return bool(thing["motions"]) and thing["motions"][-1]["kind"] == "sway"

    def _set_state(self, token: Token, subjects: Sequence[int]) -> None:
        """Apply an adjective of what opens and closes: "an open door"."""
        draft, state = self._draft, states()[token.text]
        able = [n for n in subjects if state in self._nouns[draft.things[n]["noun"]].acts]
        for index in able:
            add_motion(draft.things[index], VerbSense(kind=state))
        draft.claim(token, "activity", state, able)
        draft.show(*([token] if able == [*subjects] else []))

    def _is_open(self, field: str, things: Sequence[Mapping[str, Any]]) -> bool:
        """Whether a field of things cannot be set: a second colour, a height at rest."""
        motions = [one for thing in things for one in thing["motions"]]
        if field == "angle_deg":
            return True  # a camera turns by it
        if field == "rate_hz":
            works = any(self._nouns[one["noun"]].is_working for one in things)
            is_lamp = any("blink_hz" in one or one["noun"] in LAMPS for one in things)
            return not (motions or works or is_lamp)
        if field == "height_m":  # it is no way either: "seen from 3 m"
            return not any(
                one["kind"] in ("fall", "bounce", "hover", "fly", "float") for one in motions
            )
        is_set = field in word_set("things", "once") and any(field in one for one in things)
        return is_set or field in word_set("things", "claimed")

    # Verbs

    def _act(
        self, verb: Token, subjects: Sequence[int], objects: Sequence[int], *, has_object: bool
    ) -> list[int] | None:
        """Apply the first sense that the subjects can do; who moves, or None: there is none."""
        draft, has_object = self._draft, has_object or bool(objects)
        act = self._choose_act(verb, subjects, objects, has_object=has_object)
        if act is None or (has_object and not objects and act.who in ("plain", "body")):
            return None  # what it is done to is not known
        draft.show(verb)
        for index in objects if act.relation == "hit" else ():
            self._choose_ball(subjects, index)
        if act.brings not in ("", EGO) and not objects:
            draft.things.append({"noun": act.brings, "motions": [], "count": 1, "relations": []})
            objects = [len(draft.things) - 1]
        if act.end_pace == 0.0 and act.kind == "stand" and can_arrive(self._draft, subjects):
            act = replace(act, kind="move", is_near=False)  # it goes until it stops
        is_change = act.kind == "stand" or verb.text.endswith(" down")  # is drawn after another
        if act.is_near and not (is_change and draft.things[subjects[0]]["motions"]):
            draft.mark(verb, act.kind or act.relation or "")
        for index in subjects:
            self._do(act, verb, index)
            claim_act(self._draft, act, verb, index, objects)
        for index in objects:
            add_motion(draft.things[index], VerbSense(kind=act.object))
            self._switch(act.object, index)
            draft.claim(verb, "activity", act.object, [index] if act.object in TIMED else [])
        if not objects:
            meet(self._draft, act, verb, subjects)
        for index in subjects if act.relation is not None else ():
            self._relate_act(act.relation or "", verb, index, objects)
        return list(objects if act.object and objects else subjects)

    def _relate_act(self, kind: str, verb: Token, index: int, objects: Sequence[int]) -> None:
        """Relate who acts to what the act is about, on a way that the staged scene holds."""
        draft, who = self._draft, ridden_by(self._draft, index, kind)
        about = {draft.things[one]["noun"] for one in objects}
        if kind == "follow" and about & nouns_with("runs on"):
            kind = "past"  # "follows a pipe"
        if kind == "lead":
            return lead_on(draft, verb, index, objects)
        if kind == "load":
            return bear_on(draft, verb, index, objects)
        is_left = kind == "out of" and bool(objects) and relate_one(draft, kind, who, objects)
        if (is_left or draft.relate(who, kind, objects)) and kind in WAYS:
            way = draft.things[who]["relations"][-1]["kind"]  # from a stop, along a platform
            draft.claim(verb, "relation", way, [who], objects)

    def _switch(self, state: str, index: int) -> None:
        """Switch the lamp of what an act lights or puts out."""
        if state in _SWITCHED:
            self._draft.things[index]["motions"].pop()
            self._draft.switch(state, index)

    def _choose_act(
        self, verb: Token, subjects: Sequence[int], objects: Sequence[int], *, has_object: bool
    ) -> VerbSense | None:
        """The first sense of a verb that the subjects can do."""
        draft, acts = self._draft, [one.value for one in verb.all("verb") if subjects]
        if verb.text in _list_performing():
            done = {draft.things[one].get("deed", "") for one in subjects} - {""}
            acts[:0] = [VerbSense("person", one) for one in done]
        tools = [one for one in acts if one.who == "person" and _list_tools(one.kind)]
        if act := self._act_as_person(tools, subjects, objects, has_object=has_object):
            return act
        act = next((one for one in acts if draft.fits(one, subjects, objects, has_object)), None)
        act = act or self._act_as_person(acts, subjects, objects, has_object=has_object)
        is_sent = act is None and not has_object and self._are_sent(verb, subjects)
        return VerbSense(kind="throw") if is_sent else act

    def _are_sent(self, verb: Token, subjects: Sequence[int]) -> bool:
        """Whether balls are struck by who is not said: "a shuttlecock smashed at the camera"."""
        is_struck = any(one.value.relation in SENT for one in verb.verbs("ed"))
        nouns = {self._draft.things[one]["noun"] for one in subjects}
        return is_struck and bool(nouns) and nouns <= trait_values("struck with").keys() | _KICKED

    def _choose_ball(self, subjects: Sequence[int], index: int) -> None:
        """Take the ball of who is named by a sport: "a golfer hits a ball"."""
        thing = self._draft.things[index]
        for deed in (self._draft.things[one].get("deed") for one in subjects):
            if deed and thing["noun"] == "ball":
                thing["noun"] = trait_value("ball of", deed) or thing["noun"]
                self._draft.things[subjects[0]]["motions"] = [{"kind": deed}]

    def _act_as_person(
        self, acts: Sequence[VerbSense], subjects: Sequence[int], objects: Sequence[int], *,
        has_object: bool,
    ) -> VerbSense | None:  # fmt: skip
        """An act of people that hands or their tools do: "hands typing", "a pen writing"."""
        things = [self._draft.things[one] for one in subjects]
        acts = [one for one in acts if one.who == "person"]
        if not all(one["noun"] in HAND_NOUNS for one in things):
            acts = [act for act in acts if {one["noun"] for one in things} <= _list_tools(act.kind)]
        if not (things and acts):
            return None
        said = [(one["noun"], one["count"]) for one in things]
        for one in things:
            one |= {"noun": "person", "count": 1}
        for act in acts:
            if self._draft.fits(act, subjects, objects, has_object):
                return act
        for one, (noun, count) in zip(things, said, strict=True):
            one |= {"noun": noun, "count": count}
        return None

    def _do(self, act: VerbSense, verb: Token, index: int) -> None:
        """Let an object do it; a flame burns and flickers by itself."""
        thing = self._draft.things[index]
        if act.kind == "move" and self._goes_on and ridden_by(self._draft, index, "past") != index:
            return  # it is ridden on: "rides a bicycle, passing a car"
        if thing["noun"] in nouns_with("flows") and act.kind in word_set("effects", "motions"):
            return  # its water does so
        if act.who not in ("source", "lamp"):
            before = [one["kind"] for one in thing["motions"]]
            add_motion(thing, act, goes_on=self._goes_on)
            if (row := ANIMAL_ACTIVITIES.get(act.kind)) and row.effect:
                self._draft.add_effect(verb, row.effect, [index])
            is_seated = before[-1:] in (["sit"], ["lie"]) and act.kind in {*DONE_SEATED, "type"}
            is_later = self._goes_on and verb.verbs("ing") and len(thing["motions"]) > len(before)
            is_end = act.kind == "break"  # of a fall: "falls, shattering"
            if is_later and before and not (is_seated or is_end):
                self._draft.mark(verb, f"then {act.kind}")  # "walks, waving": not at once
        elif act.who == "lamp" and act.kind in _SWITCHED:
            self._draft.switch(act.kind, index)
        elif thing["noun"] not in word_set("things", "flames"):
            if act.who == "lamp":
                thing["blink_hz"] = BLINK_HZ
            else:
                self._draft.add_effect(verb, act.kind, [index])


def _list_tools(activity: str) -> set[str]:
    """Nouns that a person has in hand in an act."""
    props = (one for one in list_props(activity) if one.anchor.endswith("hand"))
    return {noun for prop in props for noun in prop.nouns}


def _list_formed(group: Group, head: Token) -> Sequence[Group]:
    """Groups of what has the shape that a head names, which is no thing: "a pyramid of cans"."""
    parts = group.of.groups if group.of is not None else ()
    is_shape = any(one.value.noun in nouns_with("formed of others") for one in head.all("noun"))
    said = [one.head for one in parts if one.head and not (one.article or one.head.has("field"))]
    is_shape &= len(said) == len(parts) and all(one.has("noun", "effect") for one in said)
    return parts if is_shape else ()


@cache
def _list_performing() -> frozenset[str]:
    """Forms of verbs for an act that a person does anyway: "plays", of a violinist."""
    verbs = word_set("things", "performing")
    return frozenset(form for verb in verbs for form, _ in list_verb_forms(verb))


def _see_as_thing(head: Token) -> Token:
    """A word as the thing that has the effect which it names: "around a fire"."""
    effects = {one.value for one in head.all("effect")} if not head.has("noun") else set()
    table = read_table("words", "read")["seen_as"]
    senses = [Sense("noun", NounSense(table[one])) for one in effects if one in table]
    return replace(head, senses=tuple(senses)) if senses else head
