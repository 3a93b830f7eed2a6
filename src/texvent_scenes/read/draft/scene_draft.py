"""Draft of a scene: objects, effects and moves of the camera so far, and the fate of each word."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, get_args

from texvent_scenes.description import Claim
from texvent_scenes.models.activities import ACTIVITIES, SAT
from texvent_scenes.models.effects import LAMPS
from texvent_scenes.models.protocol import Noun
from texvent_scenes.models.tables import nouns_with
from texvent_scenes.read.draft.abilities import MEANS, Abilities, Indices
from texvent_scenes.read.parsing.lexicon import VerbSense, word_set, word_table
from texvent_scenes.read.parsing.tokens import Token, token_at
from texvent_scenes.spec.data import PLACING
from texvent_scenes.spec.scene import MoveDirection

_QUICKENED = frozenset({"pan", "tilt", "roll", "orbit", "truck", "dolly", "pedestal",
                        "zoom", "travel"})  # fmt: skip
"""Moves of a camera that may get faster or slower."""
_STEPS = 3
"""Stretches of the clip in which they do, each at its own pace."""
_SAID_TWICE = ("travel", "handheld", "static")
"""Moves of which a verb says what a shot is: "handheld camera shaking"."""
_NEAR = 3
"""Words from an effect to what it comes from: "smoke is rising from a chimney"."""
_REST = {"kind", "start_s"}
"""Fields of the rest after an act that is counted."""
_DRIVEN = "travel forward drive"
"""Shot from a vehicle on a road."""
_UNTURNED = ("handheld", "static")
_TURNING = ("spin", "roll", "slide")
BLINK_HZ = 2.0
"""Frequency of a lamp of which only is said that it blinks."""


@dataclass
class Last:
    """Things that the sentence spoke of last, to which its next words refer."""

    nearest: list[int] = field(default_factory=list)
    """Objects of the last noun group."""
    before: list[int] = field(default_factory=list)
    """Those before the rest of the clause: "passes a bench and sits on it"."""
    where: list[int] = field(default_factory=list)
    """Objects of the last group before the clause: "under a bridge as a train crosses it"."""
    subjects: list[int] = field(default_factory=list)
    """Objects that the last clause was about."""
    earlier: list[int] = field(default_factory=list)
    """Objects that the clause before that one was about: "behind her"."""
    acted: list[int] = field(default_factory=list)
    """Objects of the last verb that had some: "picks up an apple from a bowl, puts it down"."""
    verb: Token | None = None
    """The last verb: "then right", "then a truck" say no other."""
    has_verb: bool = False
    """Whether the clause has a verb: "is repairing it with a wrench"."""
    is_then: bool = False
    """Whether it happens after what was said before: "then"."""
    goes_on: bool = False
    """Whether it happens while all that was said of its subjects before."""
    is_lost: bool = False
    """Whether the last clause was about several things that are not known."""
    was_camera: bool = False
    """Whether it was about the camera."""


@dataclass
class SceneDraft(Abilities):
    """Scene that is being read; clauses are applied one after the other."""

    tokens: Sequence[Token]
    nouns: Mapping[str, Noun]
    last: Last = field(default_factory=Last)
    things: list[dict[str, Any]] = field(default_factory=list)
    """Fields of objects, whose relations are to indices of others; "is_lost" if what it does is
    not known, "deed" if its word tells what it does, "word" as it was named."""
    moves: list[dict[str, Any]] = field(default_factory=list)
    phase: int = 0
    """Phase of moves of the camera: those said after "then" follow."""
    phases: int = 0
    """Times that "then" was said: effects begin in that phase, light and weather do not change."""
    effects: list[dict[str, Any]] = field(default_factory=list)
    is_over: bool = False
    """Whether the sky is named, and not that anything is in it."""
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
    quantities: dict[tuple[int, str], float] = field(default_factory=dict)
    """Index of an object and a quantity that is said of it → its value."""
    left: list[int] = field(default_factory=list)
    """Object from which one was parted last."""
    fates: dict[int, str] = field(default_factory=dict)
    """Number of a token → "lost", "shown", or the noun that it is shown as; "" = told with another
    one."""
    compounds: dict[int, str] = field(default_factory=dict)
    """Number of a token → the words that are told as one: the compound of which it is the head,
    or the phrase with which it is lost."""
    modifying: set[int] = field(default_factory=set)
    """Numbers of the tokens that say what a thing is like."""
    before_sky: list[int] = field(default_factory=list)
    """Objects behind which only the sky is seen: "against the sunset"."""
    homes: list[tuple[Token, Token, str]] = field(default_factory=list)
    """Places before names of those who go anywhere, as of "a street cat"; their nouns."""

    def beside(self, token: Token, step: int) -> Token:
        """The token so many after another one, or before it."""
        return token_at(self.tokens, token.at + step)

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
        targets: Indices = (),
    ) -> None:  # fmt: skip
        """Leave it to the staged scene whether a word is shown of all subjects."""
        said = [Claim(token.text, kind, value, one, tuple(targets)) for one in subjects]
        self.claims |= {token.at: [*self.claims.get(token.at, ()), *said]} if said else {}

    def relate(self, subject: int, kind: str, targets: Indices) -> bool:
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
        nearest = self.targets([subject], PLACING)
        return subject == other or any(self._stands_by(target, other) for target in nearest)

    def set_part(self, index: int, name: str, **said: Any) -> None:
        """Set the number or the colour of parts that an object has itself."""
        parts = self.things[index].setdefault("parts", [])
        own = next((one for one in parts if one["name"] == name), None)
        if own is None:
            parts.append(own := {"name": name})
        own |= said

    def counts_parts(self, indices: Indices, word: str) -> bool:
        """Whether objects may have any number of the parts that a word names."""
        own = [self.noun(one).find_choice(word) for one in indices]
        return any(one is not None and one.most for one in own)

    def count_part(self, index: int, word: str, counts: Collection[float], usual: int) -> int:
        """Give an object a number of parts, if it can have so many; how many it has then.

        `usual` is that of parts whose number is always the same.
        """
        own = self.noun(index).find_choice(word)
        if own is None or not own.most:
            return usual
        count = int(next(iter(counts), own.usual))
        if len(counts) > 1 or not 0 < count <= own.most:
            return own.usual
        if counts and count != own.usual:
            self.set_part(index, own.name, count=count)
        return count

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

    @property
    def is_driven(self) -> bool:
        """Whether a prompt says of its view that it is from a vehicle on a road."""
        shots = {sense.value for token in self.tokens for sense in token.all("shot")}
        return _DRIVEN in shots or any(one.get("means") == "drive" for one in self.moves)

    def set_journey(self, name: str, value: Any) -> bool:
        """Set a speed or a rate of the camera's last move that has one; False: none has."""
        moves = [one for one in self.moves if turn_by(one, name, value) != one]
        for one in moves[-1:]:
            one.update(turn_by(one, name, value))
        return bool(moves)

    def quicken(self, end_pace: float) -> bool:
        """Let the camera's moves go over to a pace by steps; False: they have steps already."""
        moves = [*self.moves]
        timed = {"phase", "start_s", "speed_m_s"}
        is_open = bool(moves) and {one["kind"] for one in moves} <= _QUICKENED
        is_open &= not any(one.keys() & timed for one in moves)
        for phase in range(_STEPS if is_open else 0):
            by = round(1.0 + (end_pace - 1.0) * phase / (_STEPS - 1), 3)
            said = [{**one, "pace": round(one.get("pace", 1.0) * by, 3)} for one in moves]
            self.moves += [{**one, "phase": phase} for one in said] if phase else []
        return is_open

    def take_in_mouth(self, index: int) -> None:
        """Let an animal hold what it is with: "a dog with a stick in its mouth"."""
        for relation in self.things[index]["relations"]:
            relation["kind"] = "hold" if relation["kind"] == "with" else relation["kind"]

    def may_come_from(self, token: Token) -> bool:
        """Whether a preposition says of what the last effect comes: no "burning house" before."""
        return self.effects[-1]["source"] is None or token.at - self._effect_at <= _NEAR

    def add_effect(self, token: Token, kind: str, owners: Indices = ()) -> None:
        """Add an effect, which comes from the first of the owners."""
        phase = {"phase": self.phases} if self.phases else {}
        self.effects.append({"kind": kind, "source": owners[0] if owners else None, **phase})
        self._effect_at = token.at
        self.show(token)

    def show_inherent(self, tokens: Sequence[Token], name: str) -> None:
        """Show modifiers of what is so anyway, "a round plate", and other names of a noun."""
        true_of = word_table("inherent")
        self.show(*(one for one in tokens if name in true_of.get(one.text, ())))
        for token in tokens:
            same = [one.value for one in token.all("noun") if one.value.noun == name]
            if same:
                self.mark(token, name if same[0].is_kind else "shown")

    def name_kind(self, words: Sequence[Token], head: Token, noun: str) -> None:
        """Report a compound that is shown as its head: "a face shield" as a shield."""
        before = self.beside(head, -1)
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
                further = self.beside(before, -1)
                if further in words and not (self.shows(further) or further.has("field", "verb")):
                    self.compounds[head.at] = f"{further.text} {self.compounds[head.at]}"
                    self.mark(further, "")  # "a chain-link fence"

    def merge_compound(self, before: Token, head: Token, noun: str) -> None:
        """Report two words as one, which is shown as a noun."""
        self.compounds[head.at] = f"{before.text} {head.text}"
        self.mark(before, "")
        self.mark(head, noun)

    def text_of(self, token: Token) -> str:
        """The words with which a token is told, or its own."""
        return self.compounds.get(token.at, token.text)

    def join(self, tokens: Sequence[Token]) -> None:
        """Tell tokens that are lost, with those between them, as one."""
        words = self.tokens[tokens[0].at : tokens[-1].at + 1] if tokens else ()
        text = " ".join(self.text_of(one) for one in words if self.fates.get(one.at) != "")
        self.compounds |= {one.at: text for one in tokens}


def split_move(phrase: str) -> dict[str, Any]:
    """A move of words.toml, such as "zoom in", as fields of `CameraMove`."""
    kind, _, direction = phrase.partition(" ")
    direction, _, means = direction.partition(" ") if kind == "travel" else (direction, "", "")
    is_turned = direction in (get_args(MoveDirection) if kind not in _UNTURNED else ("all axes",))
    said = {"kind": kind, "direction": direction if is_turned else "", "means": means}
    return {name: value for name, value in said.items() if value}


def turn_by(move: Mapping[str, Any], name: str, value: Any) -> dict[str, Any]:
    """A move of the camera with a speed, a rate or an angle, if it reads one."""
    turns = move["kind"] in ("pan", "tilt", "roll", "orbit")
    if name == "turns_hz" and turns:
        return {**move, "rate_deg_s": round(360.0 * float(value), 6)}
    if name == "angle_deg" and turns:
        return {**move, "rate_deg_s": float(value), "start_s": 0.0, "duration_s": 1.0}
    return {**move, name: value} if name == "speed_m_s" and move["kind"] == "travel" else {**move}


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
    if field == "pace" and _rests_when_done(motions):  # "claps four times quickly"
        motion["start_s"] = round(motion["start_s"] / value, 6)
        motion = motions[-2]
    motion[field] = round(motion.get("pace", 1.0) * value, 6) if field == "pace" else value


def _rests_when_done(motions: Sequence[Mapping[str, Any]]) -> bool:
    """Whether the last motion is the rest after an act that is counted."""
    if len(motions) != 2 or motions[0]["kind"] not in ACTIVITIES:
        return False
    return ACTIVITIES[motions[0]["kind"]].repeats_hz > 0.0 and motions[1].keys() == _REST


def add_motion(thing: dict[str, Any], act: VerbSense, *, goes_on: bool = False) -> None:
    """Add a motion; it takes the place of one of which only the pace is said.

    What goes on moves as before: "a truck driving at 20 m/s passes".
    """
    motions, pace = thing["motions"], act.pace
    last = motions[-1] if motions else {"kind": ""}
    if not act.kind:
        return
    if goes_on and act.kind == "move" and (last["kind"] in MEANS or "speed_m_s" in last):
        last |= {"direction": act.direction} if act.direction else {}
        return
    if goes_on and act.kind in MEANS and act.kind == last["kind"]:
        last.setdefault("pace", act.pace)  # "runs through a park, chasing butterflies"
        return
    if act.kind == "move" and act.end_pace == 0.0 and last["kind"] in _TURNING:
        last["end_pace"] = 0.0  # "a spinning coin comes to rest"
        return
    is_posture = act.kind not in (*MEANS, "move")
    if goes_on and is_posture and (last["kind"] == "stand" or last == {"kind": act.kind}):
        motions.pop()  # "stands reading"; "a roundabout with cars circling" on it
    if last == {"kind": "sit"} and act.kind in SAT:
        motions.pop()  # "sits at a piano and plays", on a stool that comes with it
    end_pace = None if act.kind == "stand" else act.end_pace
    said = {"kind": act.kind, "direction": act.direction, "end_pace": end_pace}
    motion = {name: value for name, value in said.items() if value is not None}
    if motions and set(motions[-1]) <= {"kind", "pace"} and motions[-1]["kind"] == "move":
        pace *= motions.pop().get("pace", 1.0)
    motions.append(motion | ({"pace": pace} if pace != 1.0 else {}))
