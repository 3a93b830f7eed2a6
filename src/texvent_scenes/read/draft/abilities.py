"""Abilities: whether the objects of a draft can do what a verb says of them."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, TypeAlias

from texvent_scenes.models.activities import (
    ACTIVITIES,
    HAND_NOUNS,
    PERSON_NOUNS,
    TIMED,
    is_mutual,
    nouns_upon,
)
from texvent_scenes.models.anchors import grips
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.people.outfit import can_be_worn, list_props
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, trait_value, trait_values
from texvent_scenes.read.parsing.lexicon import VerbSense, word_set, word_table
from texvent_scenes.read.parsing.tokens import Token
from texvent_scenes.spec.data import ACTED, HANDLED, SENT

MEANS = ("drive", "cycle", "walk", "run", "fly", "sail", "swim")
Indices: TypeAlias = Sequence[int]
"""Numbers of objects of a draft."""
_THROWN_M = 2.0
"""Greatest extent of what is thrown, caught or kicked, m."""
_SWITCHED_S = 1.0
"""Time at which a lamp is switched of which no time is said."""
_CARRYING = nouns_with("carries people") | nouns_with("seat") | nouns_with("ridden in place")
_ALONG = ("push", "pull", "knock over")
"""Relations of what goes by itself."""


def is_of_people(act: VerbSense) -> bool:
    """Whether only people do an act."""
    is_timed = act.object in TIMED and act.relation == "at"
    return act.who == "person" or is_timed or act.relation in word_set("things", "of_people")


def balls_of(activity: str) -> set[str]:
    """Nouns of the ball that comes with an act: of a basketball player's, no racket's."""
    balls = {"ball", *word_table("general")["ball"]}
    return {noun for prop in list_props(activity) for noun in prop.nouns} & balls


class Abilities:
    """Objects of which verbs are said, and what they can do."""

    nouns: Mapping[str, Noun]
    things: list[dict[str, Any]]

    def noun(self, index: int) -> Noun:
        """The noun of an object."""
        return self.nouns[self.things[index]["noun"]]

    def names(self, indices: Iterable[int]) -> set[str]:
        """Nouns of objects."""
        return {self.things[index]["noun"] for index in indices}

    def does(self, indices: Iterable[int]) -> set[str]:
        """Motions of objects."""
        return {one["kind"] for index in indices for one in self.things[index]["motions"]}

    def acts(self, indices: Iterable[int]) -> set[str]:
        """Relations of objects, such as what they do to others."""
        return {one["kind"] for index in indices for one in self.things[index]["relations"]}

    def targets(self, indices: Iterable[int], kinds: Collection[str]) -> list[int]:
        """Objects to which some have relations of these kinds."""
        return [target for index in indices for one in self.things[index]["relations"]
                if one["kind"] in kinds for target in one["to"]]  # fmt: skip

    def find(self, names: Collection[str]) -> list[int]:
        """Objects of some nouns."""
        return [index for index, one in enumerate(self.things) if one["noun"] in names]

    def add(self, name: str, count: int = 1, **fields: Any) -> int:
        """Add an object; its index."""
        own = {"noun": name, "motions": [], "relations": [], "count": count, **fields}
        self.things.append(own)
        return len(self.things) - 1

    def can_go(self, index: int) -> bool:
        """Whether an object can go from place to place by itself."""
        return self.noun(index).speed_m_s > 0.0

    def goes(self, index: int) -> bool:
        """Whether an object is said to go somewhere, by itself or as what it rides."""
        return bool(self.does([index]) & {*MEANS, "move", "roll", "slide", "crawl"})

    def handles(self, index: int) -> bool:
        """Whether an object is a machine whose hand takes or leaves something."""
        is_machine = self.things[index]["noun"] in trait_values("gripper")
        return is_machine and bool(self.acts([index]) & HANDLED)

    def is_lamp(self, index: int) -> bool:
        """Whether an object shines, as it is said to do."""
        thing = self.things[index]
        return thing["noun"] in LAMPS and bool({"blink_hz", "switch_s"} & thing.keys())

    def rides(self, index: int) -> bool:
        """Whether an object is on what is ridden: "two men on motorcycles"."""
        ridden = self.names(self.targets([index], ["ride", "on"]))
        return bool(ridden & trait_values("ridden").keys())

    def is_swung(self, index: int) -> bool:
        """Whether an object is on a swing."""
        return bool(self.names(self.targets([index], ["on"])) & nouns_with("swings"))

    def list_lit(self, index: int) -> list[int]:
        """An object and those with lamps on or below it: candles of a cake go out with its own."""
        near = {n for number, one in enumerate(self.things) for row in one["relations"]
                for n in (number, *row["to"])
                if row["kind"] == "on" and index in (number, *row["to"])}  # fmt: skip
        return [index, *sorted(n for n in near - {index} if self.things[n]["noun"] in LAMPS)]

    def switch(self, state: str, index: int) -> None:
        """Switch lamps on or off."""
        for number in self.list_lit(index):
            self.things[number] |= {"is_lit": state == "on", "switch_s": _SWITCHED_S}

    def spins(self, index: int) -> bool:
        """Whether an object turns in its place."""
        return [one["kind"] for one in self.things[index]["motions"]] == ["spin"]

    def walks(self, index: int) -> bool:
        """Whether an object is a person or an animal on feet."""
        return self.noun(index).motion == "walk"

    def may_carry(self, index: int) -> bool:
        """Whether people ride an object: what goes or can be sat on, no big wheel."""
        noun = self.noun(index)
        is_ridden = trait_value("ridden", noun.name) or trait_value("seats", noun.name)
        goes = noun.habitat != "fixed" and noun.motion != "roll"  # no ball is driven
        return bool(is_ridden) or goes or noun.name in _CARRYING

    def rises(self, index: int) -> bool:
        """Whether an object that is let go rises, as a balloon does, or flies away."""
        noun = self.noun(index)
        return noun.habitat == "air" and noun.name not in nouns_with("sinks in air")

    def is_light(self, index: int) -> bool:
        """Whether an object is small enough to be thrown, as no wall is."""
        model = self.noun(index).build(colour=None, scale=1.0, seed=0)
        return max(model.length, model.width, model.height) <= _THROWN_M

    def is_put(self, index: int) -> bool:
        """Whether an object is one that people put somewhere, or leave."""
        return not self.walks(index) and self.is_light(index)

    def fits(self, verb: VerbSense, subjects: Indices, objects: Indices, has_object: bool) -> bool:
        """Whether the subjects can do it, with an object or without one."""
        things = [self.things[one] for one in subjects]
        names = {one["noun"] for one in things}
        is_acting = names <= PERSON_NOUNS | HAND_NOUNS
        is_machine = bool(names) and names <= trait_values("gripper").keys()
        if has_object and is_machine and verb.who in ("plain", "machine"):
            return bool(objects) and all(grips(one, verb.relation or "") for one in names)
        if (is_able := self._is_able(verb, subjects, objects, has_object)) is not None:
            return is_able
        if verb.kind == "move" and any(map(self.is_swung, subjects)):
            return False  # it goes with its seat: "a girl on a swing going high"
        goes_on = verb.kind == "stand" and verb.is_near  # "a fan stops"
        if goes_on and any(self.nouns[one].is_working for one in names):
            return False
        if has_object:
            swings = nouns_with("swings")
            needs_hands = verb.relation in word_set("things", "of_people")
            is_rider = names <= nouns_with("person on a vehicle") and verb.relation == "wear"
            needs_hands &= not is_rider
            needs_body = verb.relation in word_set("things", "of_bodies")  # no hand bends down
            is_acting &= not needs_body or names <= PERSON_NOUNS
            is_hung = names <= nouns_with("carries below")
            has_mouths = is_hung or self._has_mouths(subjects, objects)
            needs_hands &= verb.relation != "hold" or not has_mouths
            is_moved = verb.object != "work" or self.names(objects) <= swings
            is_moved &= verb.object not in TIMED or all(
                verb.object in self.noun(n).acts for n in objects
            )
            is_moved &= verb.relation not in _ALONG or all(map(self.can_go, subjects))
            is_moved &= verb.relation != "knock over" or not any(map(self.walks, objects))
            is_moved &= verb.relation != "catch" or all(map(self.walks, subjects))
            is_moved &= verb.relation not in ("catch", *SENT) or all(map(self.is_light, objects))
            is_moved &= verb.relation != "drop" or not any(map(self.rises, objects))
            is_moved &= verb.relation != "wear" or all(
                can_be_worn(self.things[n]["noun"]) for n in objects
            )
            is_moved &= verb.relation not in ACTED or not self._are_moved(subjects, objects)
            is_moved &= verb.relation != "ride" or all(map(self.may_carry, objects))
            is_moved &= not needs_body or not self.names(objects) & word_set("things", "tables")
            is_moved &= verb.relation != "move over"
            is_moved &= verb.relation != "beside" or not is_acting  # no hand only stands by
            return bool(verb.relation) and (is_acting or not needs_hands) and is_moved
        meets = verb.relation == "collide" and sum(one["count"] for one in things) > 1
        meets |= bool(verb.brings) and names <= PERSON_NOUNS
        needs_object = verb.object or verb.relation in word_set("things", "doing")
        return meets or not verb.relation or (bool(verb.kind) and not needs_object)

    def names_tool(self, subjects: Indices, words: Sequence[Token]) -> bool:
        """Whether words name what is drawn with an act: "chops wood with an axe"."""
        kinds = self.does(subjects)
        is_hit = "hit" in self.acts(subjects)
        kinds |= {name for name, one in ACTIVITIES.items() if one.reach_m and is_hit}
        tools = {part for kind in kinds for prop in list_props(kind)
                 for part in (prop.name, prop.name.rpartition(" ")[2])}  # fmt: skip
        return bool(words) and all(one.text in tools and not one.has("noun") for one in words)

    def _has_mouths(self, subjects: Indices, objects: Indices) -> bool:
        """Whether animals have small things in their mouths."""
        small = nouns_with("in hand or on something") | nouns_with("in a mouth")
        names = self.names(subjects)
        is_animal = not names & (PERSON_NOUNS | HAND_NOUNS) and all(map(self.walks, subjects))
        return is_animal and self.names(objects) <= small

    def _acts_on(self, verb: VerbSense, names: set[str], objects: Indices) -> bool:
        """Whether nouns can do an act, and it can be done to these objects."""
        is_able = names <= PERSON_NOUNS
        if verb.who == "animal":
            is_able = all(verb.kind in self.nouns[one].acts for one in names)
        upon = nouns_upon(verb.kind)
        return is_able and bool(objects) and self.names(objects) <= upon

    def _is_able(
        self, verb: VerbSense, subjects: Indices, objects: Indices, has_object: bool
    ) -> bool | None:
        """Whether those whom a verb needs can do it; None: anything may."""
        things = [self.things[one] for one in subjects]
        names = {one["noun"] for one in things}
        is_acting = names <= PERSON_NOUNS | HAND_NOUNS
        acts = word_set("things", "acts") if has_object else ()
        is_unfit = verb.kind in word_set("things", "not_of_people") and not has_object
        is_ground = names <= nouns_with("of ground")
        is_way = bool(names & nouns_with("fits who goes through"))  # no tunnel exits
        is_unfit |= verb.kind == "break" and not names <= trait_values("pieces").keys()
        is_unfit |= is_ground and verb.kind in word_set("things", "in_place")  # "rolling hills"
        match verb.who:
            case "person" if verb.relation != "act on":
                used = {noun for prop in list_props(verb.kind) for noun in prop.nouns}
                is_used = all(self.things[one]["noun"] in used for one in objects)
                is_used |= verb.relation is not None
                is_used &= not is_mutual(verb.kind) or sum(one["count"] for one in things) == 2
                return names <= PERSON_NOUNS and verb.kind not in acts and is_used
            case "person" | "animal" if verb.relation == "act on":
                return self._acts_on(verb, names, objects)
            case "animal":
                return all(verb.kind in self.nouns[one].acts for one in names)
            case "walker" | "machine" | "bearer" | "belt":
                is_load = verb.who in ("bearer", "belt")
                is_said = has_object and bool(objects) if is_load else not has_object
                is_said &= verb.who != "walker" or not any(map(self.rides, subjects))
                return is_said and self._suits(verb.who, names)
            case "body" if any(self.nouns[one].motion not in ("roll", "drive") for one in names):
                return False  # no dart, which would go along the ground
            case "source" | "lamp":
                if verb.who == "lamp" and not self._can_shine(verb.kind, names):
                    return False
                return not has_object and not is_acting
            case "camera":
                return False
            case noun if noun in self.nouns:
                is_who = names <= {"hand": HAND_NOUNS}.get(noun, {noun})
                return is_who and (not has_object or bool(verb.relation and objects))
        walks = all(map(self.walks, subjects))
        is_unfit |= is_way and verb.kind == "move"
        is_unfit &= is_ground or is_way or verb.kind == "break" or bool(names & PERSON_NOUNS)
        has_wings = all("glide" in self.noun(one).acts for one in subjects)
        is_unfit |= walks and not has_wings and verb.kind in word_set("things", "not_of_walkers")
        is_unfit |= verb.kind == "roll" and names <= nouns_with("rooted")
        return False if is_unfit else None

    def _suits(self, who: str, names: set[str]) -> bool:
        """Whether nouns are on feet, machines, belts, or wheels without hands, as a verb asks."""
        if who == "belt":
            return names <= trait_values("belt speed").keys()
        kinds = [self.nouns[one] for one in names]
        if who == "bearer":
            goes = all(one.motion in ("roll", "drive") for one in kinds)
            return goes and names.isdisjoint(trait_values("gripper"))
        return all(one.motion == "walk" if who == "walker" else one.is_working for one in kinds)

    def _can_shine(self, kind: str, names: set[str]) -> bool:
        """Whether nouns have lamps that can be switched, or are patterns that can blink."""
        if kind in ("on", "off"):
            return names <= LAMPS.keys()
        lit = nouns_with("own effect") | nouns_with("flat pattern") | word_set("things", "flames")
        return names <= LAMPS.keys() | lit

    def _are_moved(self, subjects: Indices, objects: Indices) -> bool:
        """Whether subjects move objects already: what they do then is not shown."""
        return not {*objects}.isdisjoint(self.targets(subjects, ACTED))

    def has_top(self, index: int) -> bool:
        """Whether an object stays, so that others may rise, jump or fall from on top of it."""
        noun = self.things[index]["noun"]
        is_low = trait_value("climbed", noun) is None and noun not in nouns_with("towering")
        return self.nouns[noun].habitat in ("fixed", "ground") and is_low

    def place_by(self, index: int) -> str:
        """Relation of those who are where an object is: "a sofa where a girl reads"."""
        noun = self.things[index]["noun"]
        if noun in word_set("things", "tables"):
            return "at"
        return "on" if noun in nouns_with("seat") | nouns_with("way") else "beside"

    def is_many(self, indices: Indices) -> bool:
        """Whether objects are several bodies: "them"."""
        return sum(int(self.things[index]["count"]) for index in indices) > 1

    def goes_like(self, index: int, other: int) -> bool:
        """Whether an object goes, and another may go the same way: "drives behind a truck"."""
        goes, motions = {*MEANS, "move"}, self.things[index]["motions"]
        is_going = bool(motions) and motions[0]["kind"] in goes
        same = self.noun(index).motion == self.noun(other).motion
        is_led = self.does([other]) <= goes and not self.things[other].get("is_lost")
        return is_going and same and self.can_go(other) and is_led

    def keeps_to_ground(self, index: int) -> bool:
        """Whether an object goes on the ground, and does nothing in the air or in water now."""
        does = {*self.does([index]), self.things[index].get("deed")}
        free = does & word_set("things", "off_ground")
        return self.noun(index).motion in ("walk", "drive") and not free
