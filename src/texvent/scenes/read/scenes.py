"""Scenes of clauses: which objects there are, what they do and where, and words that are lost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from texvent.errors import InputError, few
from texvent.scenes.colours import SHADES
from texvent.scenes.models.people.activities import HAND_NOUNS, PERSON_NOUNS
from texvent.scenes.models.protocol import Noun
from texvent.scenes.models.traits import trait_value
from texvent.scenes.read.camera import add_move, aims_at, apply_shot, read_move
from texvent.scenes.read.clauses import Clause, Group, Phrase, read_clauses
from texvent.scenes.read.draft import SceneDraft, Thing
from texvent.scenes.read.lexicon import (
    PLURAL_COUNT,
    Sense,
    VerbSense,
    lexicon_of,
    word_set,
)
from texvent.scenes.read.tokens import Token, split_prompt
from texvent.scenes.report import Substitution
from texvent.scenes.spec.scene import Scene

MAX_COUNT = 24
"""Most copies of one object."""
MOST_NAMED = 12
"""Words that an error names."""
SURROUND_COUNT = 14
"""Copies that a bare plural means all around something."""
BLINK_HZ = 2.0
"""Frequency of a lamp of which only is said that it blinks."""
_BACKDROPS = ("mountain", "forest", "city")
_POSITIONS = frozenset({"behind", "front", "beside", "left of", "right of", "between", "around",
                        "towards", "away from", "surround", "among", "past", "under"})  # fmt: skip
"""Relations to a thing, where a word is both thing and place: "behind a mountain"."""
_POSTURES = ("stand", "sit")
"""Motions that another activity of the same person takes the place of."""


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
    shown, substituted, lost = draft.report()
    reading = Reading(
        scene=draft.build(prompt), shown=shown, substituted=substituted, not_understood=lost
    )
    return reading, draft.is_empty


class _Reader:
    """Applies clauses to a draft."""

    def __init__(self, draft: SceneDraft, nouns: Mapping[str, Noun]) -> None:
        self._draft = draft
        self._nouns = nouns
        self._subjects: list[int] = []
        """Objects that the last clause was about."""
        self._nearest: list[int] = []
        """Objects of the last noun group."""
        self._was_camera = False
        self._was_lost = False
        self._phase = 0

    def apply(self, clause: Clause) -> None:
        """Add what a clause says."""
        self._phase += clause.is_next and bool(self._draft.moves)
        for group in clause.absent:
            self._deny(group)
        goes_on = not clause.subjects and not clause.is_nearest
        if clause.is_camera or (self._was_camera and goes_on and clause.is_joined):
            self._apply_to_camera(clause)
            self._was_camera = True
            return
        self._was_camera = False
        if self._is_ego(clause):
            self._apply_ego(clause)
            return
        self._apply_to_things(clause, goes_on=goes_on)

    # Things

    def _apply_to_things(self, clause: Clause, *, goes_on: bool) -> None:
        if goes_on:
            subjects, is_lost = self._subjects, self._was_lost and clause.is_joined
        elif clause.is_nearest:
            subjects, is_lost = self._nearest, False
        else:
            subjects, is_lost = self._name_subjects(clause)
        for phrase in clause.before:
            self._relate(phrase, subjects, subjects, is_lost=is_lost)
        if clause.before and self._goes_nearest(clause):
            subjects = self._nearest
        moved = subjects
        if clause.verb is not None:
            found = None if is_lost else self._act(clause, subjects)
            is_lost = found is None
            moved = found or subjects
            if is_lost:
                self._draft.lose(clause.verb)
                for index in subjects:  # what it does is not known, and not made up
                    self._draft.things[index].usual = "stand"
                for group in clause.objects:
                    self._name(group)
        else:
            for group in clause.objects:
                self._name(group)
        for one in clause.after:
            if isinstance(one, Phrase):
                self._relate(one, subjects, moved, is_lost=is_lost)
            else:
                self._say(one, moved, is_lost=is_lost)
        self._subjects, self._was_lost = list(subjects), is_lost

    def _name_subjects(self, clause: Clause) -> tuple[list[int], bool]:
        """Subjects of a clause, and whether none of them is known."""
        found: list[int] = []
        for group in clause.subjects:
            if not (found and self._pose(group, found[-1])):
                found.extend(self._name(group))
        is_lost = not found and any(group.head is None for group in clause.subjects)
        return found, is_lost

    def _pose(self, group: Group, index: int) -> bool:
        """As "a hand shows a thumbs up": what a body before it does."""
        pose = None if group.head is None else group.head.first("pose")
        if pose is None or group.head is None or group.head.has("noun"):
            return False
        who, activity = pose.value
        thing = self._draft.things[index]
        if thing.noun not in (HAND_NOUNS if who == "hand" else PERSON_NOUNS):
            return False
        thing.motions.append({"kind": activity})
        self._draft.show(group.head)
        return True

    def _goes_nearest(self, clause: Clause) -> bool:
        """Whether the last group before the verb does it: "a boat with dolphins jumping"."""
        if clause.verb is None or not clause.verb.verbs("ing") or not self._nearest:
            return False
        things = [self._draft.things[one] for one in self._nearest]
        return all(self._nouns[one.noun].habitat != "fixed" for one in things)

    def _name(self, group: Group, relation: str = "") -> list[int]:
        """Add what a group names; the indices of its objects, at most one."""
        draft = self._draft
        draft.lose(*group.unknown)
        head = group.head
        if head is not None and self._is_place(head, relation):
            self._set_place(group, relation)
            return []
        noun = None if head is None else head.first("noun")
        if head is None or (noun is None and not head.has("pose")):
            self._name_other(group)
            return []
        index = self._find_known(group, noun) if noun is not None else None
        if index is None:
            index = self._add_thing(group, head, noun)
        else:
            draft.show(head)
        if group.of is not None:
            self._name_content(group.of, index, head)
        self._nearest = [index]
        return [index]

    def _is_place(self, head: Token, relation: str) -> bool:
        if not head.has("place", "crossing"):
            return False
        if head.has("noun", "liquid"):
            return bool(relation) and relation not in _POSITIONS
        return True

    def _find_known(self, group: Group, noun: Sense) -> int | None:
        """As "the car", where there is one: nothing new is said of it."""
        same = [n for n, one in enumerate(self._draft.things) if one.noun == noun.value.noun]
        is_same = group.is_definite and not group.modifiers and not group.unknown
        return same[-1] if same and is_same else None

    def _add_thing(self, group: Group, head: Token, noun: Sense | None) -> int:
        draft = self._draft
        pose = head.first("pose")
        if noun is not None:
            thing = Thing(noun.value.noun, usual=noun.value.usual)
            is_same = any(one.value.is_plural for one in head.all("noun"))  # "fish"
            is_name = head.text.casefold() == noun.value.noun and not group.is_single
            if noun.value.is_plural or (is_same and is_name):
                thing.values["count"] = PLURAL_COUNT
            if noun.value.is_kind:
                draft.substitute(head, noun.value.noun)
        else:
            assert pose is not None
            who, activity = pose.value
            thing = Thing("hand" if who == "hand" else "person", motions=[{"kind": activity}])
        draft.show(head)
        draft.things.append(thing)
        index = len(draft.things) - 1
        for token in group.modifiers:
            self._modify(token, index)
        if thing.values.get("count") == 1:
            del thing.values["count"]
        return index

    def _name_content(self, group: Group, vessel: int, head: Token) -> None:
        """As "a bowl of apples"; what a picture shows is not there."""
        if head.text.casefold() in word_set("things", "likenesses"):
            self._lose_group(group)
            return
        if group.head is not None and group.head.has("liquid"):
            return  # "a bottle of water"
        inside = self._name(group)
        if inside and self._draft.things[vessel].noun in word_set("things", "vessels"):
            self._draft.relate(inside[0], "in", [vessel])

    def _name_other(self, group: Group) -> None:
        """A group without a thing: an effect, light, weather, or nothing that is known."""
        head = group.head
        if group.of is not None:
            words = {one.text.casefold() for one in group.unknown}
            if words & word_set("things", "likenesses"):
                self._lose_group(group.of)
            else:
                self._name(group.of)
        for token in group.modifiers:
            if not self._set_scene(token, []):
                self._draft.lose(token)
        if head is None or head.has("liquid"):
            return
        if not self._set_scene(head, []):
            effect = head.first("effect")
            if effect is None:
                self._draft.lose(head)
                return
            self._draft.effects.append({"kind": effect.value, "source": None})
            self._draft.show(head)

    def _lose_group(self, group: Group) -> None:
        self._draft.lose(*group.modifiers, *group.unknown)
        if group.head is not None:
            self._draft.lose(group.head)

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
        if token.picture is not None:
            thing.values["picture"] = token.picture
        elif token.number is not None:
            thing.values["count"] = max(1, min(round(token.number), MAX_COUNT))
        elif token.has("counts"):
            thing.values["count"] = int(token.all("counts")[0].value)
        elif token.has("colour", "shade") and self._paint(token, thing):
            pass
        elif sense := token.first("sizes", "materials"):
            is_size = sense.kind == "sizes"
            name = "size" if is_size else "material"
            thing.values[name] = float(sense.value) if is_size else sense.value
        elif token.has("lamps"):
            thing.values["is_lit"] = token.all("lamps")[0].value == "true"
        elif token.has("effect adjective"):
            kind = token.all("effect adjective")[0].value
            draft.effects.append({"kind": kind, "source": index})
        elif token.has("paces"):
            self._pace(index, float(token.all("paces")[0].value))
        elif token.verbs("ing", "ed"):
            if self._choose_act(token.verbs("ing", "ed"), [index], False) is None:
                draft.lose(token)
                return
            self._apply_act(token, token.verbs("ing", "ed"), [index], [])
        elif not self._set_scene(token, [index]):
            draft.lose(token)
            return
        draft.show(token)

    def _paint(self, token: Token, thing: Thing) -> bool:
        """Add a colour, or a shade of the colour after it; False: it has one already."""
        said = thing.values.get("colour", "")
        shade = token.first("shade")
        if shade is not None and not said:
            thing.values["colour"] = shade.value
            return True
        colour = token.first("colour")
        if colour is None or (said and said not in SHADES):
            return False
        thing.values["colour"] = f"{said} {colour.value}".strip()
        return True

    def _pace(self, index: int, pace: float) -> None:
        motions = self._draft.things[index].motions
        if not motions:
            motions.append({"kind": "move"})
        motions[-1]["pace"] = round(motions[-1].get("pace", 1.0) * pace, 6)

    def _say(self, token: Token, subjects: Sequence[int], *, is_lost: bool) -> None:
        """Apply an adverb, or a word of the scene that stands alone."""
        sense = token.first("directions", "paces", "placements")
        draft = self._draft
        if apply_shot(draft, token, self._phase) or self._set_scene(token, subjects):
            return
        is_rate = token.quantity is not None and token.quantity[0] == "rate"
        if is_rate and not subjects and "flicker_hz" in draft.light:
            assert token.quantity is not None
            draft.light["flicker_hz"] = token.quantity[1]
            draft.show(token)
            return
        if token.picture is not None and draft.things:
            draft.things[-1].values["picture"] = token.picture
            draft.show(token)
            return
        if is_lost or not subjects or (sense is None and token.quantity is None):
            draft.lose(token)
            return
        for index in subjects:
            self._say_of(token, sense, index)
        draft.show(token)

    def _say_of(self, token: Token, sense: Sense | None, index: int) -> None:
        thing = self._draft.things[index]
        if sense is not None and sense.kind == "placements":
            thing.values["placement"] = sense.value
            return
        if sense is not None and sense.kind == "paces":
            self._pace(index, float(sense.value))
            return
        if (
            token.quantity is not None
            and token.quantity[0] == "rate"
            and "blink_hz" in thing.values
        ):
            thing.values["blink_hz"] = token.quantity[1]
            return
        if not thing.motions:
            thing.motions.append({"kind": "move"})
        if token.quantity is not None:
            name = "speed_m_s" if token.quantity[0] == "speed" else "rate_hz"
            thing.motions[-1][name] = token.quantity[1]
        elif sense is not None:
            thing.motions[-1]["direction"] = sense.value

    # Verbs

    def _act(self, clause: Clause, subjects: Sequence[int]) -> list[int] | None:
        """Apply a verb with its objects; who moves, or None where it is not known."""
        verb = clause.verb
        assert verb is not None
        senses = verb.all("verb")
        if not subjects:
            return self._act_of_effect(clause)
        has_object = bool(clause.objects) or clause.is_back
        if self._choose_act(senses, subjects, has_object) is None:
            return None
        objects: list[int] = []
        for group in clause.objects:
            objects.extend(self._name_object(group, subjects))
        if clause.is_back:
            objects.extend(one for one in self._nearest if one not in subjects)
        return self._apply_act(verb, senses, subjects, objects)

    def _name_object(self, group: Group, subjects: Sequence[int]) -> list[int]:
        """Add an object of a verb; a part of the body is at hand."""
        words = [one.text.casefold() for one in group.unknown]
        is_own = group.is_definite and words and words[-1] in word_set("parts", "own")
        head = group.head
        if is_own or (head is not None and head.text.casefold() in word_set("parts", "own")):
            self._lose_group(group)
            return []
        del subjects
        return self._name(group)

    def _act_of_effect(self, clause: Clause) -> list[int] | None:
        """As in "smoke rises from a chimney", "water drips from a tap"."""
        verb, draft = clause.verb, self._draft
        assert verb is not None
        heads = [group.head for group in clause.subjects if group.head is not None]
        if any(one.has("liquid") for one in heads):
            kinds = [one.value.kind for one in verb.all("verb") if one.value.who == "liquid"]
            if not kinds:
                return None
            draft.effects.append({"kind": kinds[0], "source": None})
            draft.show(verb, *heads)
            return []
        natural = word_set("effects", "motions")
        is_natural = any(one.value.kind in natural or one.value.who == "liquid"
                         for one in verb.all("verb"))  # fmt: skip
        if any(one.has("effect") for one in heads) and is_natural:
            draft.show(verb)
            return []
        return None

    def _choose_act(
        self, senses: Iterable[Sense], subjects: Sequence[int], has_object: bool
    ) -> VerbSense | None:
        """The first sense that the subjects can do."""
        found: list[VerbSense] = [one.value for one in senses]
        for who in ("person", "hand", "animal", "mover", "source", "lamp", "plain"):
            for one in found:
                if one.who == who and self._fits(one, subjects, has_object):
                    return one
        return None

    def _fits(self, verb: VerbSense, subjects: Sequence[int], has_object: bool) -> bool:
        names = {self._draft.things[one].noun for one in subjects}
        is_acting = names <= PERSON_NOUNS | HAND_NOUNS
        if verb.who == "person":
            return names <= PERSON_NOUNS and not (has_object and verb.kind in _GIVEN_UP)
        if verb.who == "hand":
            return names <= HAND_NOUNS
        if verb.who == "animal":
            return all(verb.kind in self._nouns[one].acts for one in names)
        if verb.who == "mover":
            return has_object and is_acting
        if verb.who in ("source", "lamp"):
            return not has_object and not is_acting
        if verb.relation is None or not has_object:
            intransitive = verb.relation in (None, "collide") or bool(verb.kind)
            return not has_object and intransitive and verb.object is None
        return is_acting or verb.relation not in _OF_PEOPLE or verb.relation == "carry"

    def _apply_act(
        self, verb: Token, senses: Iterable[Sense], subjects: Sequence[int], objects: Sequence[int]
    ) -> list[int] | None:
        draft = self._draft
        act = self._choose_act(senses, subjects, bool(objects))
        if act is None:  # its object is a place, or not known
            is_placed = bool(draft.place.get("name")) and not objects
            act = next((one.value for one in senses if one.value.relation in ("on", "past")), None)
            if act is None or not is_placed:
                return None
        draft.show(verb)
        if act.is_near:
            draft.substitute(verb, act.kind)
        if act.who == "source":
            draft.effects.extend({"kind": act.kind, "source": one} for one in subjects[:1])
        elif act.who == "lamp":
            for index in subjects:
                if not self._is_flame(index):
                    draft.things[index].values["blink_hz"] = BLINK_HZ
        elif act.kind:
            for index in subjects:
                self._move(index, act)
        return self._apply_to_objects(act, subjects, objects)

    def _is_flame(self, index: int) -> bool:
        """Whether it flickers by itself."""
        lamps = trait_value("lamps", self._draft.things[index].noun) or ()
        return any((trait_value("lamp kind", one) or {}).get("wave") == "flame" for one in lamps)

    def _move(self, index: int, act: VerbSense) -> None:
        motion: dict[str, object] = {"kind": act.kind}
        if act.pace != 1.0:
            motion["pace"] = act.pace
        if act.direction is not None:
            motion["direction"] = act.direction
        if act.end_pace is not None:
            motion["end_pace"] = act.end_pace
        motions = self._draft.things[index].motions
        last = motions[-1] if motions else {}
        if last == {"kind": "move"} or list(last) == ["kind", "pace"] and last["kind"] == "move":
            motion["pace"] = float(motion.get("pace", 1.0)) * last.get("pace", 1.0)  # type: ignore[arg-type]
            if motion["pace"] == 1.0:
                del motion["pace"]
            motions.pop()
        elif last.get("kind") in _POSTURES and act.who == "person":
            motions.pop()
        motions.append(motion)

    def _apply_to_objects(
        self, act: VerbSense, subjects: Sequence[int], objects: Sequence[int]
    ) -> list[int]:
        """Relate subjects to objects; who the adverbs are about."""
        draft = self._draft
        names = {draft.things[one].noun for one in subjects}
        for index in objects if act.object is not None else ():
            self._move(index, VerbSense("plain", act.object or ""))
        if act.relation == "collide" and not objects:
            targets = subjects[1:] or subjects[:1]
            draft.relate(subjects[0], act.relation, targets)
        elif act.relation == "carry" and not names <= PERSON_NOUNS | HAND_NOUNS:
            for index in objects:
                draft.relate(index, "on", subjects)
        elif act.relation is not None and objects:
            for index in subjects:
                draft.relate(index, act.relation, objects)
        elif act.who == "person" and act.kind in ("eat", "drink") and objects:
            for index in subjects:
                draft.relate(index, "hold", objects)
        is_moved = act.object is not None and bool(objects)
        return list(objects) if is_moved else list(subjects)

    # Prepositions

    def _relate(
        self, phrase: Phrase, subjects: Sequence[int], moved: Sequence[int], *, is_lost: bool
    ) -> None:
        """Apply a preposition with its groups."""
        draft, token = self._draft, phrase.preposition
        sense = token.first("relations")
        kind, way = (sense.value, sense.form) if sense is not None else ("", "")
        if phrase.is_back:
            targets = [one for one in subjects if one not in self._nearest] or list(subjects)
            nearest = [one for one in self._nearest if one not in targets]
            if kind and targets and nearest:
                for index in nearest:
                    draft.relate(index, kind, targets, way)
                draft.show(token)
            return
        is_placed = bool(draft.place)
        targets = []
        for group in phrase.groups:
            if self._is_effect(group):
                self._add_effects(group, subjects)
            else:
                targets.extend(self._name(group, kind or token.text.casefold()))
        is_set = bool(draft.place) and not is_placed
        if not targets:
            if way == "across" and not is_lost and is_set:
                self._go_across(moved)
            elif token.text.casefold() == "on" and is_set:
                self._stand_on_road(subjects)
            elif kind in _POSITIONS and any(group.head is None for group in phrase.groups):
                draft.lose(token)
            return
        if kind == "from" and draft.effects and not subjects:
            draft.effects[-1]["source"] = targets[0]
            return
        if not kind or not subjects or is_lost:
            if kind in _POSITIONS and subjects:
                draft.lose(token)
            return
        draft.show(token)
        for index in subjects:
            self._relate_one(index, kind, way, targets)

    def _stand_on_road(self, subjects: Sequence[int]) -> None:
        """As "a dog on a road": what is no vehicle is on the road, too, not beside it."""
        if self._draft.place.get("name") == "road":
            for index in subjects:
                thing = self._draft.things[index]
                if self._nouns[thing.noun].motion != "drive":
                    thing.values.setdefault("placement", "lane")

    def _go_across(self, subjects: Sequence[int]) -> None:
        for index in subjects:
            for motion in self._draft.things[index].motions[-1:]:
                motion.setdefault("direction", "across")

    def _relate_one(self, index: int, kind: str, way: str, targets: Sequence[int]) -> None:
        draft = self._draft
        thing, target = draft.things[index], draft.things[targets[0]]
        is_worn = target.noun in word_set("things", "worn") and thing.noun in PERSON_NOUNS
        if is_worn and kind in ("in", "with"):
            kind, way = "wear", ""
        elif kind == "at" and target.noun not in word_set("things", "tables"):
            kind, way = "beside", "at"
        elif kind == "surround":
            for each in targets:
                values = draft.things[each].values
                if values.get("count") == PLURAL_COUNT:
                    values["count"] = SURROUND_COUNT
        draft.relate(index, kind, targets, way)

    def _is_effect(self, group: Group) -> bool:
        return (
            group.head is not None
            and group.head.has("effect")
            and not group.head.has("noun", "place", "weather")
        )

    def _add_effects(self, group: Group, subjects: Sequence[int]) -> None:
        assert group.head is not None
        kind = group.head.all("effect")[0].value
        source = subjects[0] if subjects else None
        self._draft.effects.append({"kind": kind, "source": source})
        self._draft.show(group.head)
        self._draft.lose(*group.modifiers, *group.unknown)

    # The scene

    def _set_scene(self, token: Token, subjects: Sequence[int]) -> bool:
        """Apply a word of light, weather or place, wherever it stands."""
        draft = self._draft
        sense = token.first("lights", "weather", "place fields", "light fields", "place_phrases",
                            "crossing", "lamps", "effect adjective")  # fmt: skip
        if sense is None:
            return False
        if sense.kind == "lights":
            draft.light["kind"] = sense.value
        elif sense.kind == "weather":
            draft.place["weather"] = sense.value
        elif sense.kind == "place_phrases":
            draft.place.setdefault("name", sense.value)
        elif sense.kind == "light fields":
            draft.light.update(sense.value)
        elif sense.kind == "place fields":
            draft.place.update(sense.value)
        elif sense.kind == "crossing":
            draft.place["road"] = "crossing"
        elif not subjects:
            return False
        elif sense.kind == "lamps":
            for index in subjects:
                draft.things[index].values["is_lit"] = sense.value == "true"
        else:
            draft.effects.append({"kind": sense.value, "source": subjects[0]})
        draft.show(token)
        return True

    def _set_place(self, group: Group, relation: str) -> None:
        """As "on a snowy road", "a red sky"."""
        head, draft = group.head, self._draft
        assert head is not None
        place = head.first("place")
        name = place.value if place is not None else "city"
        for token in group.modifiers:
            colour = token.first("colour")
            if token.has("shade") and token.text.casefold() == "dark":
                draft.light.setdefault("kind", "night")
                draft.show(token)
            elif colour is not None:
                draft.place["sky" if name == "sky" else "colour"] = colour.value
                draft.show(token)
            elif token.has("place"):
                self._add_backdrop(token, token.all("place")[0].value)
            elif not self._set_scene(token, []):
                draft.lose(token)
        is_said = any(one.has("colour", "place fields") for one in group.modifiers)
        if name == "sky" and is_said and relation not in ("in", "on", "through"):
            draft.show(head)
            return
        if head.has("crossing"):
            draft.place["road"] = "crossing"
        said = draft.place.setdefault("name", name)
        if said == name:
            draft.show(head)
        else:
            self._add_backdrop(head, name)
        if group.of is not None:
            self._name(group.of)

    def _add_backdrop(self, token: Token, place: str) -> None:
        """A second place is seen behind the first one, if it can be."""
        backdrops = self._draft.place.get("backdrops", ())
        if place not in _BACKDROPS:
            self._draft.lose(token)
            return
        self._draft.place["backdrops"] = tuple(dict.fromkeys((*backdrops, place)))
        self._draft.show(token)

    # The camera

    def _apply_to_camera(self, clause: Clause) -> None:
        move = read_move(self._draft, clause)
        draft = self._draft
        targets: list[int] = []
        for group in clause.objects:
            targets.extend(self._name(group))
        if clause.is_back:
            targets.extend(self._subjects)
        for one in clause.after:
            if isinstance(one, Phrase):
                targets.extend(self._aim(one, targets))
            elif one.has("directions", "paces") and move is not None:
                pass
            elif not apply_shot(draft, one, self._phase) and not self._set_scene(one, []):
                draft.lose(one)
        looks = clause.verb is not None and any(
            one.value.relation == "look at" for one in clause.verb.all("verb")
        )
        if move is not None:
            add_move(draft, move, self._phase)
        elif clause.verb is not None and not looks:
            draft.lose(clause.verb)
            return
        if targets and (move is not None or looks):
            draft.camera.setdefault("target", targets[0])
            if looks and clause.verb is not None:
                draft.show(clause.verb)

    def _aim(self, phrase: Phrase, targets: Sequence[int]) -> list[int]:
        """Add what a phrase of a camera's clause names; the objects that it looks at."""
        sense = phrase.preposition.first("relations")
        kind = sense.value if sense is not None else ""
        if targets:  # as "orbits a car in front of a house"
            self._relate(phrase, targets, targets, is_lost=False)
            return []
        if phrase.is_back:
            return list(self._subjects)
        is_placed = bool(self._draft.place)
        found = [one for group in phrase.groups for one in self._name(group, kind or "with")]
        if not found and kind == "on" and not is_placed:
            self._stand_on_road(self._nearest)
        self._draft.show(phrase.preposition)
        return found if aims_at(kind) else []

    def _is_ego(self, clause: Clause) -> bool:
        """Whether a camera goes that is not named: "driving through a city"."""
        is_place = all(
            group.head is not None and group.head.has("place") and not group.head.has("noun")
            for group in clause.subjects
        )
        verb = clause.verb
        is_first = not self._draft.things and not clause.is_nearest
        travels = verb is not None and any(
            one.value.who == "camera" and one.value.kind == "travel" for one in verb.verbs("ing")
        )
        return is_first and is_place and travels

    def _apply_ego(self, clause: Clause) -> None:
        for group in clause.subjects:
            self._name(group, "in")
        move = read_move(self._draft, clause, is_ego=True)
        if move is not None:
            add_move(self._draft, move, self._phase)
        for group in clause.objects:
            self._lose_group(group)
        for one in (*clause.before, *clause.after):
            if isinstance(one, Phrase):
                self._aim(one, [])
            elif not one.has("directions", "paces"):
                self._say(one, [], is_lost=True)


_OF_PEOPLE = frozenset({"hold", "carry", "wear", "ride", "kick", "hit", "throw", "catch"})
"""Relations that need hands, or legs."""
_GIVEN_UP = frozenset({"kick", "throw", "catch", "push", "pull", "walk"})
"""Activities that are an act where something is done to a thing: "kicks a ball"."""
