"""Draft of a scene: objects, effects and moves of the camera so far, and the fate of each word."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field
from typing import Any, get_args

from texvent_scenes.description import SEEN, Claim
from texvent_scenes.models.activities import (
    ACTIVITIES,
)
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.places import is_room
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with, read_table, trait_value
from texvent_scenes.read.abilities import MEANS, Abilities
from texvent_scenes.read.groups import Group
from texvent_scenes.read.lexicon import Sense, VerbSense, word_set
from texvent_scenes.read.tokens import NO_TOKEN, Token
from texvent_scenes.spec.data import PLACING
from texvent_scenes.spec.scene import MoveDirection

_SAID_TWICE = ("travel", "handheld", "static")
"""Moves of which a verb says what a shot is: "handheld camera shaking"."""
_UNTURNED, OPPOSITE = ("handheld", "static"), "opposite"
_TURNING = ("spin", "roll", "slide")
_REPEATED = {name: one.repeats_hz for name, one in ACTIVITIES.items()}
_NEAR = 3
"""Words from an effect to what it comes from: "smoke is rising from a chimney"."""
_QUANTITIES = ("rate_hz", "turns_hz", "blink_hz")
"""Fields of which each object has one."""
_ASIDE = ("left", "right", "across", "towards", "away")
"""Directions in which what hovers leaves its place."""
BLINK_HZ = 2.0
"""Frequency of a lamp of which only is said that it blinks."""
PLURAL_COUNT = 3
"""Copies that a bare plural means."""
_TURNS, _TURN_S = 5, 0.25
"""Copies of what does something one after another, and time between them, s."""
_GRAMMAR = ("articles", "pronouns", "conjunctions", "relatives", "style", "purpose", "camera")
"""Senses of words that a report does not list unless they are lost or shown."""


def is_grammar(token: Token) -> bool:
    """Whether a token says nothing by itself: "the", "is", "while", "footage"."""
    is_order = token.text in word_set("things", "order")
    return (token.has(*_GRAMMAR) and not is_order) or token.text in word_set("things", "grammar")


def split_move(phrase: str) -> dict[str, Any]:
    """A move of words.toml, such as "zoom in", as fields of `CameraMove`."""
    kind, _, direction = phrase.partition(" ")
    direction, _, means = direction.partition(" ") if kind == "travel" else (direction, "", "")
    is_turned = direction in (get_args(MoveDirection) if kind not in _UNTURNED else ("all axes",))
    return {
        "kind": kind,
        **({"direction": direction} if is_turned else {}),
        **({"means": means} if means else {}),
    }


def turn_by(move: Mapping[str, Any], name: str, value: Any) -> dict[str, Any]:
    """A move of the camera with a speed, a rate or an angle, if it reads one."""
    turns = move["kind"] in ("pan", "tilt", "roll", "orbit")
    if name == "turns_hz" and turns:
        return {**move, "rate_deg_s": round(360.0 * float(value), 6)}
    if name == "angle_deg" and turns:
        return {**move, "rate_deg_s": float(value), "start_s": 0.0, "duration_s": 1.0}
    return {**move, name: value} if name == "speed_m_s" and move["kind"] == "travel" else {**move}


def names_place(head: Token, relation: str) -> bool:
    """Whether a noun is a place: "in a park", and not "a park bench"."""
    place, is_thing = head.first("place"), head.has("noun", "pose")
    if place is None or (head.is_liquid and relation in ("", "with", "from", "off")):
        return False
    if relation in word_set("things", "outside"):  # "behind a library": where is that?
        return not is_thing and not is_room(place.value)
    return bool(relation) or not is_thing


def set_field(thing: dict[str, Any], kind: str, field: str, value: Any) -> None:
    """Set a field of an object, or an adverb of its last motion."""
    is_lamp = thing["noun"] in LAMPS and not thing["motions"]
    if field == "rate_hz" and ("blink_hz" in thing or is_lamp):
        field, kind = "blink_hz", "field"
    if kind == "field" or field in ("placement", "height_m"):
        thing[field] = int(value) if field == "count" else value
        return
    motions = thing["motions"]
    if field == "start_s" and "switch_s" in thing:
        thing["switch_s"] = value
        return
    if not motions or (field == "start_s" and [one["kind"] for one in motions] == ["stand"]):
        # "at 900 rpm"; "stops after 1 second": until then it goes
        motions.insert(0, {"kind": "spin" if field == "turns_hz" else "move"})
    if field == "start_s" and len(motions) == 1 and motions[0].get("end_pace") == 0.0:
        motions.insert(0, {"kind": motions[0]["kind"]})  # "brakes after 1 second"
    motion = motions[-1]
    field = "rate_hz" if field == "turns_hz" else field
    motion[field] = round(motion.get("pace", 1.0) * value, 6) if field == "pace" else value


def add_motion(thing: dict[str, Any], act: VerbSense, *, goes_on: bool = False) -> None:
    """Add a motion; it takes the place of one of which only the pace is said.

    What goes on moves as before: "a truck driving at 20 m/s passes".
    """
    motions, pace = thing["motions"], act.pace
    if not act.kind:
        return
    is_way = bool(motions) and (motions[-1]["kind"] in MEANS or "speed_m_s" in motions[-1])
    if goes_on and act.kind == "move" and is_way:
        motions[-1].update({"direction": act.direction} if act.direction else {})
        return
    if motions and act.kind == "move" and act.end_pace == 0.0 and motions[-1]["kind"] in _TURNING:
        motions[-1]["end_pace"] = 0.0  # "a spinning coin comes to rest"
        return
    is_posture = act.kind not in (*MEANS, "move")
    if goes_on and is_posture and motions and motions[-1]["kind"] == "stand":
        motions.pop()  # "stands reading"
    end_pace = None if act.kind == "stand" else act.end_pace
    said = {"kind": act.kind, "direction": act.direction, "end_pace": end_pace}
    motion = {name: value for name, value in said.items() if value is not None}
    if motions and set(motions[-1]) <= {"kind", "pace"} and motions[-1]["kind"] == "move":
        pace *= motions.pop().get("pace", 1.0)
    motions.append(motion | ({"pace": pace} if pace != 1.0 else {}))


@dataclass
class SceneDraft(Abilities):
    """Scene that is being read; clauses are applied one after the other."""

    tokens: Sequence[Token]
    nouns: Mapping[str, Noun]
    things: list[dict[str, Any]] = field(default_factory=list)
    """Fields of objects, whose relations are to indices of others; "is_lost" if what it does is
    not known, "deed" if its word tells what it does, "word" as it was named."""
    moves: list[dict[str, Any]] = field(default_factory=list)
    phase: int = 0
    """Phase of moves of the camera: those said after "then" follow."""
    phases: int = 0
    """Times that "then" was said: effects begin in that phase, light and weather do not change."""
    effects: list[dict[str, Any]] = field(default_factory=list)
    """Effects, each with the index of its source."""
    absent: list[str] = field(default_factory=list)
    parts: dict[str, dict[str, Any]] = field(
        default_factory=lambda: {"camera": {}, "light": {}, "place": {}}
    )
    """Fields of the camera, the light and the place."""
    claims: dict[int, list[Claim]] = field(default_factory=dict)
    """Number of a token → what is claimed of it."""
    _effect_at: int = 0
    """Number of the token of the last effect."""
    _said: dict[tuple[int, str], float] = field(default_factory=dict)
    """Index of an object and a quantity that is said of it → its value."""
    _left: list[int] = field(default_factory=list)
    """Object from which one was parted last."""
    fates: dict[int, str] = field(default_factory=dict)
    """Number of a token → "lost", "shown", or the noun that it is shown as; "" = told with another
    one."""
    compounds: dict[int, str] = field(default_factory=dict)
    """Number of a token → the compound of which it is the head, and which is shown as it."""
    homes: list[tuple[Token, Token, str]] = field(default_factory=list)
    """Places before names of those who go anywhere, as of "a street cat"; their nouns."""

    def show(self, *tokens: Token) -> None:
        """Count tokens as shown, unless they are lost or shown as something else."""
        for one in tokens:
            self.fates.setdefault(one.at, "shown")

    def mark(self, token: Token, fate: str) -> None:
        """Count a token as "lost", or as shown by a noun."""
        self.fates[token.at] = fate

    def shows(self, token: Token) -> bool:
        """Whether a token is shown, as itself or as something else."""
        return self.fates.get(token.at, "lost") != "lost"

    def claim(
        self, token: Token, kind: str, value: str | float, subjects: Sequence[int | None],
        targets: Sequence[int] = (),
    ) -> None:  # fmt: skip
        """Leave it to the staged scene whether a word is shown of all subjects."""
        if kind == "times":
            self.repeat(value, [one for one in subjects if one is not None])
        if kind == "in_air":
            kind, value = "ground", False
        goes = [*MEANS, "move", "orbit"]
        for motions in (self.things[one]["motions"] for one in subjects if one is not None):
            if kind == "circle" and motions and motions[-1]["kind"] in goes:
                motions[-1]["kind"] = "orbit"
        for motions in (self.things[one]["motions"] for one in subjects if one is not None):
            if kind == "stays" and motions and motions[-1]["kind"] == "turn":
                motions[-1]["kind"] = "spin"  # "turns on the spot"
        said = [Claim(token.text, kind, value, one, tuple(targets)) for one in subjects]
        self.claims |= {token.at: [*self.claims.get(token.at, ()), *said]} if said else {}

    def relate(self, subject: int, kind: str, targets: Sequence[int]) -> bool:
        """Add a relation of an object to others; False: it has none, or goes round in a circle."""
        is_one = self.things[subject]["count"] == 1
        if not targets or (subject in targets and is_one):
            return False
        if kind in PLACING and any(self._stands_by(target, subject) for target in targets):
            return False
        is_alongside = self.things[targets[0]]["noun"] in nouns_with("alongside")
        if is_alongside and kind in ("to", "at", "towards"):  # "arrives at a platform"
            for motion in self.things[subject]["motions"][-1:]:
                motion["end_pace"] = 0.0
            kind = "beside"
        ways = {"out of": "from", "through": "past"} if is_alongside else {}
        kind = ways.get(kind, kind)  # a train goes through a station along its platform
        is_seat = self.things[targets[0]]["noun"] in nouns_with("works on demand")
        kind = "on" if kind == "ride" and is_seat else kind  # "rides a swing"
        self.things[subject]["relations"].append({"kind": kind, "to": tuple(targets)})
        return True

    def _stands_by(self, subject: int, other: int) -> bool:
        """Whether where an object stands depends on where another one does."""
        relations = [one for one in self.things[subject]["relations"] if one["kind"] in PLACING]
        return subject == other or any(
            self._stands_by(target, other) for one in relations for target in one["to"]
        )

    def set_scene(self, token: Token, things: Sequence[Any] = ()) -> bool:
        """Apply a word of light, weather, place or camera; of things, "wet" is theirs alone."""
        if things and token.text in word_set("things", "own"):
            return False
        for sense in token.all("shot"):
            self.add_move({**split_move(sense.value), **self._pace_before(token)})
        said = [sense.value for sense in token.all("scene")]
        if self.phases and any(part in ("light", "place") for part, _, _ in said):
            return False  # "then it rains"
        if self._leaves_place(token):
            self.mark(token, "lost")
            return True
        for part, name, value in said:
            if name == "name" and value in ("sky", "indoor") and self.parts[part].get(name):
                continue  # "in a kitchen, indoors"
            if value != "day" or name not in self.parts[part]:  # "overcast daylight"
                self.parts[part][name] = value
        is_near = token.text.split()[0] in word_set("things", "nearest")
        self.claim(token, "macro", "", [None] if is_near else [])
        is_said = token.has("shot", "scene")
        self.show(*([token] if is_said else []))
        return is_said

    def _leaves_place(self, token: Token) -> bool:
        """Whether a phrase names another place than the one that is said: "dives under water"."""
        said = [sense.value[2] for sense in token.all("scene") if sense.value[1] == "name"]
        name = self.parts["place"].get("name", "")
        if not (said and name) or name in said or token.text == "underwater":
            return False
        return said != ["sky"] and not (is_room(said[0]) and is_room(name))

    def _pace_before(self, token: Token) -> dict[str, Any]:
        """The pace that the word before says, if of nothing else: "fast yaw rotation"."""
        before = self.tokens[token.at - 1] if token.at else NO_TOKEN
        name, value = (before.first("adverb") or Sense("", ("", ""))).value
        if name != "pace" or self.shows(before):
            return {}
        self.show(before)
        return {"pace": value}

    def add_move(self, move: dict[str, Any]) -> None:
        """Add a move of the camera; what flies is seen from the air."""
        phase = {"phase": self.phase} if self.phase else {}
        kind = move["kind"]
        same = [one for one in self.moves if one["kind"] == kind and kind in _SAID_TWICE]
        if same and same[-1].get("phase", 0) == self.phase:  # "a dashcam driving at 20 m/s"
            same[-1].update(move)
        else:
            self.moves.append({**move, **phase})
        if move.get("means") == "fly":
            self.parts["camera"].setdefault("view", "aerial")

    def set_journey(self, name: str, value: Any) -> bool:
        """Set a speed or a rate of the camera's last move that has one; False: none has."""
        moves = [one for one in self.moves if turn_by(one, name, value) != one]
        for one in moves[-1:]:
            one.update(turn_by(one, name, value))
        return bool(moves)

    def has_top(self, index: int) -> bool:
        """Whether an object stays, so that others may rise, jump or fall from on top of it."""
        noun = self.things[index]["noun"]
        is_low = trait_value("climbed", noun) is None and noun not in nouns_with("towering")
        return self.nouns[noun].habitat in ("fixed", "ground") and is_low

    def list_held(self, owners: Sequence[int]) -> Iterator[int]:
        """Objects that some hold or wear."""
        for relation in (one for owner in owners for one in self.things[owner]["relations"]):
            yield from relation["to"] if relation["kind"] in ("wear", "hold") else ()

    def place_by(self, index: int) -> str:
        """Relation of those who are where an object is: "a sofa where a girl reads"."""
        noun = self.things[index]["noun"]
        if noun in word_set("things", "tables"):
            return "at"
        return "on" if noun in nouns_with("seat") | nouns_with("way") else "beside"

    def is_many(self, indices: Sequence[int]) -> bool:
        """Whether objects are several bodies: "them"."""
        return sum(int(self.things[index]["count"]) for index in indices) > 1

    def goes_like(self, index: int, other: int) -> bool:
        """Whether an object goes, and another may go the same way: "drives behind a truck"."""
        mine, theirs = self.things[index], self.things[other]
        is_going = bool(mine["motions"]) and mine["motions"][0]["kind"] in (*MEANS, "move")
        same = self.nouns[mine["noun"]].motion == self.nouns[theirs["noun"]].motion
        is_led = all(one["kind"] in (*MEANS, "move") for one in theirs["motions"])
        is_led &= not theirs.get("is_lost")
        return is_going and same and self.can_go(other) and is_led

    def keeps_to_ground(self, index: int) -> bool:
        """Whether an object goes on the ground, and does nothing in the air or in water now."""
        thing = self.things[index]
        does = {*(one["kind"] for one in thing["motions"]), thing.get("deed")}
        free = does & word_set("things", "off_ground")
        return self.nouns[thing["noun"]].motion in ("walk", "drive") and not free

    def say_field(self, token: Token, said: Sense, index: int) -> None:
        """Set a field of an object; of a speed also the one that it reaches: "brakes to 2 m/s"."""
        motions, before = self.things[index]["motions"], self.tokens[token.at - 1].text
        (name, value), end = said.value, motions[-1].get("end_pace") if motions else None
        if name == "speed_m_s" and end is not None:
            is_end = before == "to" or (before != "from" and end > motions[-1].get("pace", 1.0))
            name = "end_m_s" if is_end else name
        if (
            name == "direction"
            and motions[-1:]
            and motions[-1]["kind"] == "hover"
            and value in _ASIDE
        ):
            motions[-1]["kind"] = "move"  # "a bubble floats past"
        set_field(self.things[index], said.kind, name, value)
        self._said[index, name] = value

    def find_unsaid(self, name: str, indices: Sequence[int], nearest: Sequence[int]) -> list[int]:
        """Objects of which a quantity is said now: no other than before of the same.

        Of "two LEDs at 5 Hz and 9 Hz" the second has it, of "a fan at 5 Hz by a fan at 9 Hz" the
        nearest one.
        """
        if name not in _QUANTITIES or not any((one, name) in self._said for one in indices):
            return [*indices]
        free = [one for one in nearest if one not in indices and (one, name) not in self._said]
        if free:
            return free
        own = indices[0]
        if len(indices) > 1 or self.things[own]["count"] != 2:
            return []
        self._part(own, 1)
        return [len(self.things) - 1]

    def repeat(self, times: Any, indices: Sequence[int]) -> None:
        """Let objects rest after so many repetitions of what is counted."""
        acts = [self.things[index]["motions"] for index in indices]
        rates = [_REPEATED.get(one[0]["kind"], 0.0) if len(one) == 1 else 0.0 for one in acts]
        for motions, rate_hz in zip(acts, rates, strict=True) if all(rates) else ():
            rate_hz *= motions[0].get("pace", 1.0)
            motions.append({"kind": "stand", "start_s": round(times / rate_hz, 6)})

    def part_ways(self, parted: Sequence[int]) -> bool:
        """Lead objects, or halves of one's copies, in opposite directions; False: it is one."""
        is_one = sum(self.things[index]["count"] for index in parted) < 2
        sides = ("right", "left") if parted[1:] else (OPPOSITE,)
        for number, index in enumerate(() if is_one else parted):
            set_field(self.things[index], "adverb", "direction", sides[number % len(sides)])
        return not is_one

    def _part(self, own: int, count: int) -> dict[str, Any]:
        """Make some of an object's copies an object of their own, the last one."""
        first, other = self.things[own], len(self.things)
        part = {**deepcopy(first), "count": count}
        first["count"] -= count
        for one in self.things:  # "and collide": with each other
            for relation in one["relations"]:
                new = (other,) if one is first else (own, other)
                relation["to"] = tuple(
                    index for to in relation["to"] for index in (new if to == own else (to,))
                )
        self.things += [part] if count else []
        return part

    def stack(self, own: int) -> None:
        """Put each copy of an object on top of another one."""
        parts = [self._part(own, 1) for _ in range(self.things[own]["count"] - 1)]
        below = [own, *range(len(self.things) - len(parts), len(self.things))]
        for part, index in zip(parts, below, strict=False):
            part["relations"] = [{"kind": "on", "to": (index,)}]

    def take_turns(self, own: int) -> None:
        """Let copies of an object begin one after the other; what topples stands in a row."""
        thing = self.things[own]
        if thing["count"] == PLURAL_COUNT and not any(one.has("field") for one in self.tokens):
            thing["count"] = _TURNS
        height = self.nouns[thing["noun"]].build(colour=None, scale=1.0, seed=0).height
        is_row = thing["motions"][-1]["kind"] in ("topple", "fall")
        parts = [thing, *(self._part(own, 1) for _ in range(thing["count"] - 1))]
        for number, part in enumerate(parts):
            part["motions"][-1]["start_s"] = round(_TURN_S * (number + 1), 6)
            part |= {"heading_deg": 0.0} if is_row else {}
            row = {"kind": "right of", "to": (own,), "distance_m": round(1.05 * number * height, 6)}
            part["relations"] += [row] if is_row and number else []

    def halve(self, own: int) -> None:
        """Lead halves of an object's copies to the right and to the left."""
        for thing, side in (
            (self._part(own, self.things[own]["count"] // 2), "left"), (self.things[own], "right")
        ):  # fmt: skip
            for motion in thing["motions"]:
                motion |= {"direction": side} if motion.get("direction") == OPPOSITE else {}

    def pick(self, word: str, count: int, among: Sequence[int] = ()) -> list[int]:
        """Part some from the last object of more copies, of those that go; or what was left."""
        many = self.find_several(among)
        if word in ("other", "others") or not many:
            return self._left
        self._left, (own,) = many, many
        if any(one.get("direction") == OPPOSITE for one in self.things[own]["motions"]):
            self.halve(own)
            own = len(self.things) - 1
        if self.things[own]["count"] > count:
            self._part(own, count)
        return [len(self.things) - 1] if count in (1, self.things[-1]["count"]) else []

    def find_several(self, among: Sequence[int] = (), least: int = 2) -> list[int]:
        """The last object of so many copies, of those that go by themselves if there is one."""
        said = among or range(len(self.things))
        many = [n for n in said if self.things[n]["count"] >= least]
        able = [one for one in many if self.can_go(one) and not self.is_swung(one)]
        return (able or many)[-1:]

    def count_like(self, own: int) -> int:
        """Number of bodies of an object's noun."""
        noun = self.things[own]["noun"]
        return sum(one["count"] for one in self.things if one["noun"] == noun)

    def add_like(self, own: int) -> list[int]:
        """Add one more of a kind, which does nothing yet: "two goats fight, a third eats"."""
        kept = {key: value for key, value in self.things[own].items() if key in ("noun", "deed")}
        self.things.append(kept | {"motions": [], "relations": [], "count": 1})
        return [len(self.things) - 1]

    def take_in_mouth(self, index: int) -> None:
        """Let an animal hold what it is with: "a dog with a stick in its mouth"."""
        for relation in self.things[index]["relations"]:
            relation["kind"] = "hold" if relation["kind"] == "with" else relation["kind"]

    def may_come_from(self, token: Token) -> bool:
        """Whether a preposition says of what the last effect comes: no "burning house" before."""
        return self.effects[-1]["source"] is None or token.at - self._effect_at <= _NEAR

    def add_effect(self, token: Token, kind: str, owners: Sequence[int] = ()) -> None:
        """Add an effect, which comes from the first of the owners."""
        phase = {"phase": self.phases} if self.phases else {}
        self.effects.append({"kind": kind, "source": owners[0] if owners else None, **phase})
        self._effect_at = token.at
        self.show(token)

    def show_inherent(self, tokens: Sequence[Token], name: str) -> None:
        """Show modifiers of what is so anyway, "a round plate", and other names of a noun."""
        true_of = read_table("words", "read")["inherent"]
        self.show(*(one for one in tokens if name in true_of.get(one.text, ())))
        for token in tokens:
            same = [one.value for one in token.all("noun") if one.value.noun == name]
            if same:
                self.mark(token, name if same[0].is_kind else "shown")

    def name_kind(self, words: Sequence[Token], head: Token, noun: str) -> None:
        """Report a compound that is shown as its head: "a face shield" as a shield."""
        before = self.tokens[head.at - 1] if head.at else NO_TOKEN
        is_noun = before.has("noun", "place") or not before.text.endswith(
            (*word_set("things", "adjective_ends"),)
        )
        is_noun &= before.is_unknown or before.has("noun", "place") or bool(before.verbs("base"))
        no_kinds = word_set("things", "adjectives") | word_set("things", "masses")  # "a glass pot"
        is_noun &= before.text.isalpha() and before.text not in no_kinds
        if is_noun and before in words and not self.shows(before):
            if before.has("place") and self.nouns[noun].speed_m_s:
                self.homes.append((before, head, noun))  # "a street cat"
            else:
                self.merge_compound(before, head, noun)

    def merge_compound(self, before: Token, head: Token, noun: str) -> None:
        """Report two words as one, which is shown as a noun."""
        self.compounds[head.at] = f"{before.text} {head.text}"
        self.mark(before, "")
        self.mark(head, noun)

    def _fill_place(self, token: Token, place: str) -> None:
        """Add those of whom a place is full: "a busy street"."""
        full = read_table("words", "read")["brings"]
        brought = full.get(f"{token.text} {place}") or full.get(token.text, {})
        for noun, count in brought.items():
            self.things.append({"noun": noun, "motions": [], "relations": [], "count": count})
            self.show(token)
            self.claim(token, SEEN, "", [len(self.things) - 1])

    def set_place(self, group: Group, head: Token, relation: str) -> None:
        """As "on a snowy road", "a red sky", "a mountain road"; a second place is far off."""
        place = self.parts["place"]
        name = head.all("place")[0].value
        is_it = name in ("sky", place.get("name", name))
        for token in group.modifiers:
            field, value = (token.first("field") or Sense("", ("", ""))).value
            if token.text == "dark":
                self.parts["light"].setdefault("kind", "night")
                if name == "plain":
                    place |= {"colour": "black", "sky": "black"}
            elif field == "colour" and is_it and not is_room(name):
                place["sky" if name == "sky" else "colour"] = value
            elif not (token.has("partitive") or self.set_scene(token)):
                continue
            self.show(token)
        if name == "plain":  # "a plain black background": alone, the word has several senses
            said = (one for one in self.tokens if one.text == name and one.at < head.at)
            self.show(*(one for one in said if head.at - one.at <= len(group.modifiers) + 1))
        self.show_inherent(group.unknown, name)
        for token in group.unknown:
            self._fill_place(token, name)
        self.set_scene(head)
        is_said = bool(group.modifiers) and relation not in ("in", "on", "through")
        if not is_it and name in word_set("things", "backdrops") and not is_room(place["name"]):
            place["backdrops"] = list(dict.fromkeys([*place.get("backdrops", ()), name]))
            self.show(head)
        elif (name == "sky" and is_said) or place.setdefault("name", name) == name or (
            head.is_liquid and place["name"] in word_set("things", "waters")
        ):  # fmt: skip
            self.mark(head, name if head.text in word_set("things", "stand_ins") else "shown")
