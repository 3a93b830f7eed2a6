"""Scenes of clauses: which objects there are, what they do and where, and words that are lost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from texvent.errors import InputError, few
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.traits import trait_value
from texvent.scenes.read.camera import add_move, aims_at, find_move, split_move
from texvent.scenes.read.clauses import Clause, Group, Phrase, read_clauses
from texvent.scenes.read.draft import SceneDraft, Thing
from texvent.scenes.read.lexicon import Sense, VerbSense, lexicon_of, word_set
from texvent.scenes.read.tokens import Token, split_prompt
from texvent.scenes.report import Substitution
from texvent.scenes.spec.scene import Scene

MAX_COUNT = 24
"""Most copies of one object."""
PLURAL_COUNT, SURROUND_COUNT = 3, 14
"""Copies that a bare plural means, and means all around something."""
_RANGES = {"speed": (0.0, 1000.0), "rate": (0.001, 100_000.0)}
"""Least and most of a quantity, m/s and Hz; others are not understood."""
BLINK_HZ = 2.0
"""Frequency of a lamp of which only is said that it blinks."""
MOST_NAMED = 12
"""Words that an error names."""
_BACKDROPS = ("mountain", "forest", "city")
_POSITIONS = frozenset({"behind", "front", "beside", "left of", "right of", "between", "around",
                        "towards", "away from", "surround", "among", "past", "under"})  # fmt: skip
"""Relations to a thing, where a word is both thing and place: "behind a mountain"."""
_OF_PEOPLE = frozenset({"hold", "wear", "ride", "kick", "hit", "throw", "catch"})
"""Relations that need hands, or legs."""
_SENDING = frozenset({"kick", "hit", "throw"})
_ROUTES = frozenset({"above", "past", "through", "under", "around", "between", "in", "on"})
"""Relations that then would be about the wrong object."""
_ACTS = frozenset({"kick", "throw", "catch", "push", "pull", "walk"})
"""Activities that are a relation where something is done to a thing: "kicks a ball"."""
_DOERS = ("person", "hand", "animal", "mover", "source", "lamp", "plain")
"""Kinds of subjects of verbs; what only they can do goes before what anything can."""


@dataclass(frozen=True, kw_only=True)
class Reading:
    """The scene that a sentence describes, and what became of its words."""

    scene: Scene
    shown: tuple[str, ...]
    """Words that the scene shows."""
    substituted: tuple[Substitution, ...]
    """Words that are shown as something else."""
    not_understood: tuple[str, ...]
    """Words without effect on the scene."""


def read(prompt: str, nouns: Mapping[str, Noun] | None = None) -> Reading:
    """The scene that a sentence describes; what it leaves open stays open.

    Args:
        prompt: any text.
        nouns: the objects that can be shown; None: the embedded ones.

    Raises:
        InputError: the prompt is empty, or nothing in it is understood.
    """
    if not prompt.strip():
        raise InputError(
            "the prompt is empty; describe a scene, such as 'a red car drives left past two trees'"
        )
    reading, is_empty = read_text(prompt, nouns)
    if is_empty:
        raise InputError(
            f"nothing in the prompt was understood: {few(reading.not_understood, MOST_NAMED)}; "
            "docs/prompts.md lists the words of the embedded generator, texvent generators lists "
            "models that take any text"
        )
    return reading


def read_text(prompt: str, nouns: Mapping[str, Noun] | None = None) -> tuple[Reading, bool]:
    """What `read` returns, for any text, and whether nothing in it is understood."""
    from texvent.scenes.models.nouns import NOUNS

    tokens = split_prompt(prompt, lexicon_of(nouns))
    draft = SceneDraft(tokens)
    reader = _Reader(draft, nouns or NOUNS)
    for clause in read_clauses(tokens):
        reader.apply(clause)
    draft.limit_bodies()
    shown, substituted, lost = draft.report()
    scene = draft.build(prompt)
    reading = Reading(scene=scene, shown=shown, substituted=substituted, not_understood=lost)
    return reading, draft.is_empty


def _is_route(phrase: Phrase) -> bool:
    """Whether a preposition says the way of what is sent off: "kicks a ball over a wall"."""
    return phrase.preposition.all("relation")[0].value in _ROUTES


class _Reader:
    """Applies clauses to a draft."""

    def __init__(self, draft: SceneDraft, nouns: Mapping[str, Noun]) -> None:
        self._draft = draft
        self._nouns = nouns
        self._subjects: list[int] = []
        """Objects that the last clause was about."""
        self._nearest: list[int] = []
        """Objects of the last noun group."""
        self._was_camera = self._was_lost = False
        self._phase = 0

    def apply(self, clause: Clause) -> None:
        """Add what a clause says."""
        self._phase += clause.is_next and bool(self._draft.moves)
        for group in clause.absent:
            self._deny(group)
        goes_on = not clause.subjects and not clause.is_nearest
        is_camera = clause.is_camera or (self._was_camera and goes_on and clause.is_joined)
        is_ego = not is_camera and self._is_ego(clause)
        self._was_camera = is_camera
        if is_camera or is_ego:
            self._apply_to_camera(clause, is_ego=is_ego)
        else:
            self._apply_to_things(clause, goes_on=goes_on)

    def _apply_to_things(self, clause: Clause, *, goes_on: bool) -> None:
        subjects, is_lost = self._nearest, False
        if goes_on:
            subjects, is_lost = self._subjects, self._was_lost and clause.is_joined
        elif not clause.is_nearest:
            subjects = [index for group in clause.subjects for index in self._name(group)]
            is_lost = not subjects and any(group.head is None for group in clause.subjects)
        for phrase in clause.before:
            self._relate(phrase, subjects, subjects, is_lost=is_lost)
        if clause.before and self._goes_nearest(clause):
            subjects = self._nearest
        objects = [index for group in clause.objects for index in self._name(group)]
        moved = subjects
        if clause.verb is not None:
            found = None if is_lost else self._act(clause, subjects, objects)
            is_lost, moved = found is None, found or subjects
            if is_lost:
                self._lose_verb(clause.verb, subjects)
        acts = {relation["kind"] for index in subjects for relation in self._relations(index)}
        is_sent = clause.verb is not None and bool(objects) and bool(acts & _SENDING)
        for one in clause.after:
            if isinstance(one, Phrase):
                is_route = is_sent and one.preposition.has("relation") and _is_route(one)
                self._relate(one, subjects, moved, is_lost=is_lost or is_route)
            else:
                self._say(one, moved, is_lost=is_lost)
        self._subjects, self._was_lost = list(subjects), is_lost

    def _relations(self, index: int) -> list[dict[str, Any]]:
        return self._draft.things[index].relations

    def _lose_verb(self, verb: Token, subjects: Sequence[int]) -> None:
        """What the subjects do is not known, and is not made up."""
        self._draft.lose(verb)
        for index in subjects:
            self._draft.things[index].usual = "stand"

    # Noun groups

    def _goes_nearest(self, clause: Clause) -> bool:
        """Whether the last group before the verb does it: "a boat with dolphins jumping"."""
        is_ing = clause.verb is not None and bool(clause.verb.verbs("ing"))
        nouns = [self._nouns[self._draft.things[one].noun] for one in self._nearest]
        return is_ing and bool(nouns) and all(noun.habitat != "fixed" for noun in nouns)

    def _name(self, group: Group, relation: str = "") -> list[int]:
        """Add what a group names; the indices of its objects, at most one."""
        head = group.head
        self._draft.lose(*group.unknown)
        is_drawn = any(
            one.text.removesuffix("s") in word_set("things", "likenesses")
            for one in (*group.unknown, *((head,) if head else ()))
        )
        if head is not None and self._is_place(head, relation):
            self._set_place(group, relation)
        elif head is not None and head.has("noun", "pose"):
            return self._name_thing(group, head, is_drawn=is_drawn)
        else:
            self._name_other(group)
        if group.of is not None:
            self._lose_group(group.of) if is_drawn else self._name(group.of)
        return []

    def _is_place(self, head: Token, relation: str) -> bool:
        is_thing = head.has("noun", "pose") or head.text in word_set("things", "liquids")
        return head.has("place") and (
            not is_thing or (bool(relation) and relation not in _POSITIONS)
        )

    def _name_thing(self, group: Group, head: Token, *, is_drawn: bool) -> list[int]:
        draft, noun = self._draft, head.first("noun")
        known = [n for n, one in enumerate(draft.things) if noun and one.noun == noun.value.noun]
        if known and group.is_definite and not group.modifiers and not group.unknown:
            draft.show(head)  # "the car", where there is one
            self._nearest = known[-1:]
            return known[-1:]
        if noun is not None:
            thing = Thing(noun.value.noun, noun.value.usual)
            if noun.value.is_kind:
                draft.substitute(head, thing.noun)
        else:
            who, activity = head.all("pose")[0].value
            thing = Thing("hand" if who == "hand" else "person", motions=[{"kind": activity}])
        draft.things.append(thing)
        draft.show(head)
        index = len(draft.things) - 1
        if group.is_plural:
            thing.values["count"] = PLURAL_COUNT
        for token in group.modifiers:
            self._modify(token, index)
        if thing.values.get("count") == 1:
            del thing.values["count"]
        self._name_content(group.of, index, is_drawn=is_drawn)
        self._nearest = [index]
        return [index]

    def _name_content(self, group: Group | None, vessel: int, *, is_drawn: bool) -> None:
        """As "a bowl of apples"; what a picture shows is not there."""
        if group is None or (group.head and group.head.text in word_set("things", "liquids")):
            return
        if is_drawn:
            self._lose_group(group)
            return
        inside = self._name(group)
        if inside and self._draft.things[vessel].noun in word_set("things", "vessels"):
            self._draft.relate(inside[0], "in", [vessel])

    def _name_other(self, group: Group) -> None:
        """A group without a thing: an effect, light, weather, or nothing that is known."""
        head, draft = group.head, self._draft
        for token in group.modifiers:
            if not self._set_scene(token):
                draft.lose(token)
        if head is None or self._set_scene(head):
            return
        effect = head.first("effect")
        if effect is None:
            draft.lose(head)
        else:
            draft.add_effect(effect.value, None)
            draft.show(head)

    def _lose_group(self, group: Group) -> None:
        head = (group.head,) if group.head else ()
        self._draft.lose(*group.modifiers, *group.unknown, *head)

    def _deny(self, group: Group) -> None:
        noun = None if group.head is None else group.head.first("noun")
        if noun is None or group.head is None:
            self._lose_group(group)
            return
        self._draft.absent.append(noun.value.noun)
        self._draft.show(group.head)
        self._draft.lose(*group.modifiers, *group.unknown)

    # What is said of a thing

    def _modify(self, token: Token, index: int) -> None:
        """Apply a word before a noun."""
        thing, draft = self._draft.things[index], self._draft
        is_shown = True
        if token.picture is not None:
            thing.values["picture"] = token.picture
        elif token.number is not None:
            thing.values["count"] = max(1, min(round(token.number), MAX_COUNT))
        elif said := token.first("field"):
            field, value = said.value
            is_shown = field != "colour" or "colour" not in thing.values
            if is_shown:
                thing.values[field] = int(value) if field == "count" else value
        elif said := token.first("effect adjective"):
            draft.add_effect(said.value, index)
        elif said := token.first("adverb"):
            self._say_of(said.value, index)
        elif token.verbs("ing", "ed"):
            is_shown = self._apply_act(token, token.verbs("ing", "ed"), [index], []) is not None
        else:
            is_shown = self._set_scene(token)
        (draft.show if is_shown else draft.lose)(token)

    def _say(self, token: Token, subjects: Sequence[int], *, is_lost: bool) -> None:
        """Apply an adverb, or a word of the scene that stands alone."""
        draft = self._draft
        if self._set_scene(token, subjects):
            return
        adverb, effect = token.first("adverb"), token.first("effect adjective")
        quantity, light = token.quantity, draft.parts["light"]
        if quantity is not None:
            least, most = _RANGES[quantity[0]]
            is_lost = is_lost or not least <= quantity[1] <= most
        if token.picture is not None and draft.things:
            draft.things[-1].values["picture"] = token.picture
        elif quantity and quantity[0] == "rate" and "flicker_hz" in light and not (
            subjects or is_lost
        ):
            light["flicker_hz"] = quantity[1]
        elif is_lost or not subjects or not (adverb or effect or quantity):
            draft.lose(token)
            return
        elif effect:
            draft.add_effect(effect.value, subjects[0])
        for index in subjects:
            if adverb:
                self._say_of(adverb.value, index)
            elif quantity:
                self._measure(quantity, index)
        draft.show(token)

    def _say_of(self, said: tuple[str, Any], index: int) -> None:
        field, value = said
        thing = self._draft.things[index]
        if field == "placement":
            thing.values[field] = value
            return
        motion = self._last_motion(thing)
        motion[field] = round(motion.get("pace", 1.0) * value, 6) if field == "pace" else value

    def _measure(self, quantity: tuple[str, float], index: int) -> None:
        kind, value = quantity
        thing = self._draft.things[index]
        if kind == "rate" and "blink_hz" in thing.values:
            thing.values["blink_hz"] = value
        else:
            self._last_motion(thing)["speed_m_s" if kind == "speed" else "rate_hz"] = value

    def _last_motion(self, thing: Thing) -> dict[str, Any]:
        if not thing.motions:
            thing.motions.append({"kind": "move"})
        return thing.motions[-1]

    # Verbs

    def _act(
        self, clause: Clause, subjects: Sequence[int], objects: Sequence[int]
    ) -> list[int] | None:
        """Apply a verb with its objects; who moves, or None where it is not known."""
        verb = clause.verb
        if verb is None or not subjects:
            return self._act_of_effect(clause)
        others = [one for one in self._nearest if one not in subjects] if clause.is_back else []
        heads = [group.head for group in clause.objects]
        is_unknown = clause.is_back or any(
            one is None or one.text in word_set("things", "liquids") for one in heads
        )
        return self._apply_act(
            verb, verb.all("verb"), subjects, [*objects, *others], has_object=is_unknown
        )

    def _act_of_effect(self, clause: Clause) -> list[int] | None:
        """As in "smoke rises from a chimney"."""
        heads = [group.head for group in clause.subjects if group.head is not None]
        kinds = {one.value.kind for one in clause.verb.all("verb")} if clause.verb else set()
        if clause.verb is None or not any(one.has("effect") for one in heads):
            return None
        if not kinds & word_set("effects", "motions"):
            return None
        self._draft.show(clause.verb)
        return []

    def _apply_act(
        self, verb: Token, senses: Iterable[Sense], subjects: Sequence[int],
        objects: Sequence[int], *, has_object: bool = False,
    ) -> list[int] | None:  # fmt: skip
        """Apply the first sense that the subjects can do; who moves, or None: there is none."""
        draft, has_object = self._draft, has_object or bool(objects)
        able = [one.value for one in senses if self._fits(one.value, subjects, has_object)]
        act = min(able, key=lambda one: _DOERS.index(one.who), default=None)
        if act is None or (has_object and not objects and act.who in ("mover", "plain")):
            return None  # what it is done to is not known
        if act.kind in word_set("things", "pair_acts") and objects:
            if any(draft.things[one].noun not in PERSON_NOUNS for one in objects):
                return None
            subjects = [*subjects, *objects]
        draft.show(verb)
        if act.is_near:
            draft.substitute(verb, act.kind)
        if act.who == "source":
            if act.kind != "fire" or not self._is_flame(subjects[0]):
                draft.add_effect(act.kind, subjects[0])
        elif act.who == "lamp":
            self._blink(subjects)
        elif act.kind:
            for index in subjects:
                self._move(index, act)
        return self._apply_to_objects(act, subjects, objects)

    def _fits(self, verb: VerbSense, subjects: Sequence[int], has_object: bool) -> bool:
        names = {self._draft.things[one].noun for one in subjects}
        is_acting = names <= PERSON_NOUNS | HAND_NOUNS
        if verb.who == "person":
            return names <= PERSON_NOUNS and not (has_object and verb.kind in _ACTS)
        if verb.who == "hand":
            return names <= HAND_NOUNS
        if verb.who == "animal":
            return all(verb.kind in self._nouns[one].acts for one in names)
        if verb.who == "mover":
            return has_object and is_acting
        if verb.who in ("source", "lamp"):
            return not has_object and not is_acting
        if verb.who != "plain" or has_object != bool(verb.relation):
            meets = verb.relation == "collide" and self._are_several(subjects)
            is_alone = meets or (bool(verb.kind) and not verb.object)
            return verb.who == "plain" and not has_object and is_alone
        return is_acting or verb.relation not in _OF_PEOPLE

    def _are_several(self, subjects: Sequence[int]) -> bool:
        counts = [self._draft.things[one].values.get("count", 1) for one in subjects]
        return sum(counts) > 1

    def _blink(self, subjects: Sequence[int]) -> None:
        for index in subjects:
            if not self._is_flame(index):
                self._draft.things[index].values["blink_hz"] = BLINK_HZ

    def _is_flame(self, index: int) -> bool:
        """Whether it burns and flickers by itself."""
        lamps = trait_value("lamps", self._draft.things[index].noun) or ()
        return any((trait_value("lamp kind", one) or {}).get("wave") == "flame" for one in lamps)

    def _move(self, index: int, act: VerbSense) -> None:
        """Add a motion, or fill in one of which only the pace is said, or a posture."""
        motions = self._draft.things[index].motions
        said = {"kind": act.kind, "direction": act.direction, "end_pace": act.end_pace}
        motion = {name: value for name, value in said.items() if value is not None}
        pace = act.pace
        if motions and set(motions[-1]) <= {"kind", "pace"} and motions[-1]["kind"] == "move":
            pace *= motions.pop().get("pace", 1.0)
        elif motions and motions[-1]["kind"] in ("stand", "sit") and act.who == "person":
            motions.pop()
        motion |= {"pace": pace} if pace != 1.0 else {}
        if motion not in motions[-1:]:
            motions.append(motion)

    def _apply_to_objects(
        self, act: VerbSense, subjects: Sequence[int], objects: Sequence[int]
    ) -> list[int]:
        """Relate subjects to objects; who the adverbs are about."""
        draft = self._draft
        names = {draft.things[one].noun for one in subjects}
        for index in objects if act.object is not None else ():
            self._move(index, VerbSense(kind=act.object or ""))
        is_meal = act.who == "person" and act.kind in ("eat", "drink")
        if act.relation == "collide" and not objects:
            draft.relate(subjects[0], "collide", subjects[1:] or subjects[:1])
        elif act.relation == "carry" and not names <= PERSON_NOUNS | HAND_NOUNS:
            for index in objects:
                draft.relate(index, "on", subjects)
        elif objects and (act.relation is not None or is_meal):
            for index in subjects:
                draft.relate(index, act.relation or "hold", objects)
        return list(objects if act.object is not None and objects else subjects)

    # Prepositions

    def _relate(
        self, phrase: Phrase, subjects: Sequence[int], moved: Sequence[int], *, is_lost: bool
    ) -> None:
        """Apply a preposition with its groups; `moved` are those that the verb moves."""
        draft, token = self._draft, phrase.preposition
        sense = token.first("relation")
        kind, way = (sense.value, sense.form) if sense is not None else ("", "")
        if not phrase.groups:
            others = [one for one in self._nearest if one not in subjects]
            for index in others if kind else ():
                draft.relate(index, kind, subjects, way)
            draft.show(token)
            return
        place, targets = draft.parts["place"].get("name"), []
        for group in phrase.groups:
            head = group.head
            if head is not None and head.has("effect") and not head.has("noun", "place", "scene"):
                draft.add_effect(head.all("effect")[0].value, subjects[0] if subjects else None)
                draft.show(head)
                draft.lose(*group.modifiers, *group.unknown)
            else:
                targets += self._name(group, kind or token.text)
        if not targets:
            is_there = draft.parts["place"].get("name") != place
            self._go_to_place(token, way, subjects, moved) if is_there and not is_lost else None
        elif kind == "from" and draft.effects and not subjects:
            draft.effects[-1]["source"] = targets[0]
        elif kind and subjects and not is_lost:
            placed = [self._relate_one(token, index, targets) for index in subjects]
            (draft.show if any(placed) else draft.lose)(token)
        elif subjects and kind in _POSITIONS:
            draft.lose(token)

    def _go_to_place(
        self, token: Token, way: str, subjects: Sequence[int], moved: Sequence[int]
    ) -> None:
        """As "across a field"; "a dog on a road", which is no vehicle, stands on it."""
        draft = self._draft
        for index in moved if way == "across" else ():
            for motion in draft.things[index].motions[-1:]:
                motion.setdefault("direction", "across")
        for index in subjects if token.text == "on" else ():
            thing = draft.things[index]
            if draft.parts["place"]["name"] == "road" and self._nouns[thing.noun].motion != "drive":
                thing.values.setdefault("placement", "lane")

    def _relate_one(self, token: Token, index: int, targets: Sequence[int]) -> bool:
        draft, sense = self._draft, token.all("relation")[0]
        kind, way = sense.value, sense.form
        thing, target = draft.things[index], draft.things[targets[0]]
        if target.noun in word_set("things", "worn") and kind in ("in", "with"):
            if thing.noun in PERSON_NOUNS:
                kind, way = "wear", ""
            elif kind == "in":
                return False
        elif kind == "at" and target.noun not in word_set("things", "tables"):
            kind, way = "beside", "at"
        elif kind == "surround":
            for values in (draft.things[one].values for one in targets):
                if values.get("count") == PLURAL_COUNT:
                    values["count"] = SURROUND_COUNT
        return draft.relate(index, kind, targets, way)

    # The scene

    def _set_scene(self, token: Token, subjects: Sequence[int] = ()) -> bool:
        """Apply a word of light, weather, place or camera, wherever it stands."""
        draft = self._draft
        for sense in token.senses:
            if sense.kind == "shot":
                add_move(draft, split_move(sense.value), self._phase)
            elif sense.kind == "scene":
                part, fields = sense.value
                draft.parts[part].update(fields)
            elif sense.kind == "field" and sense.value[0] == "is_lit" and subjects:
                for index in subjects:
                    draft.things[index].values["is_lit"] = sense.value[1]
            else:
                continue
            draft.show(token)
            return True
        return False

    def _set_place(self, group: Group, relation: str) -> None:
        """As "on a snowy road", "a red sky"."""
        head, draft, place = group.head, self._draft, self._draft.parts["place"]
        if head is None:
            return
        name = head.all("place")[0].value
        for token in group.modifiers:
            colours = [one.value[1] for one in token.all("field") if one.value[0] == "colour"]
            if token.text == "dark":
                draft.parts["light"].setdefault("kind", "night")
            elif colours:
                place["sky" if name == "sky" else "colour"] = colours[0]
            elif token.has("place"):
                self._add_backdrop(token, token.all("place")[0].value)
            elif not self._set_scene(token):
                draft.lose(token)
            draft.show(token)
        self._set_scene(head)
        is_said = bool(group.modifiers) and relation not in ("in", "on", "through")
        if (name == "sky" and is_said) or place.setdefault("name", name) == name:
            draft.show(head)
        else:
            self._add_backdrop(head, name)

    def _add_backdrop(self, token: Token, name: str) -> None:
        """A second place is seen behind the first one, if it can be."""
        place = self._draft.parts["place"]
        if name not in _BACKDROPS:
            self._draft.lose(token)
            return
        place["backdrops"] = tuple(dict.fromkeys((*place.get("backdrops", ()), name)))
        self._draft.show(token)

    # The camera

    def _is_ego(self, clause: Clause) -> bool:
        """Whether a camera goes that is not named: "driving through a city"."""
        heads = [group.head for group in clause.subjects]
        is_place = all(one is not None and self._is_place(one, "") for one in heads)
        verbs = clause.verb.verbs("ing") if clause.verb is not None else ()
        travels = any(one.value == VerbSense("camera", "travel") for one in verbs)
        return travels and is_place and not self._draft.things and not clause.is_nearest

    def _apply_to_camera(self, clause: Clause, *, is_ego: bool) -> None:
        draft, camera = self._draft, self._draft.parts["camera"]
        move = find_move(draft, clause, is_ego=is_ego)
        for group in clause.subjects:
            self._name(group, "in")
        targets = [] if is_ego else [one for group in clause.objects for one in self._name(group)]
        for group in clause.objects if is_ego else ():
            self._lose_group(group)
        targets += self._subjects if clause.is_back else ()
        for one in (*clause.before, *clause.after):
            if isinstance(one, Phrase):
                targets += self._aim(one, targets)
            elif not (one.has("adverb") and move) and not self._set_scene(one):
                draft.lose(one)
        senses = clause.verb.all("verb") if clause.verb is not None else ()
        looks = any(one.value.relation == "look at" for one in senses)
        if move is not None:
            add_move(draft, move, self._phase)
        elif clause.verb is not None:
            (draft.show if looks and targets else draft.lose)(clause.verb)
        if targets and (move or looks):
            camera.setdefault("target", targets[0])

    def _aim(self, phrase: Phrase, targets: Sequence[int]) -> list[int]:
        """Add what a phrase of a camera's clause names; the objects that it looks at."""
        sense = phrase.preposition.first("relation")
        kind, place = sense.value if sense else "", dict(self._draft.parts["place"])
        if targets:  # as "orbits a car in front of a house"
            self._relate(phrase, targets, targets, is_lost=False)
            return []
        if not phrase.groups:
            return list(self._subjects)
        found = [one for group in phrase.groups for one in self._name(group, kind or "with")]
        if not found and self._draft.parts["place"] != place:
            self._go_to_place(phrase.preposition, "", self._nearest, [])
        self._draft.show(phrase.preposition)
        return found if aims_at(kind) else []
