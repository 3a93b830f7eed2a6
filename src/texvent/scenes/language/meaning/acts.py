"""Clauses about objects: what each subject does, to what, and where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import SPIN_RATE_HZ, Effect, ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.activities import find_activity
from texvent.scenes.language.meaning.capabilities import can_do, is_hand, is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents import Referent
from texvent.scenes.language.vocabulary.motion import Verb
from texvent.scenes.language.vocabulary.scene import DEFAULT_BLINK_HZ
from texvent.scenes.language.words.english import VerbForm
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.effects import EFFECTS
from texvent.scenes.models.lamps import LAMPS

STAND = ObjectMotion("stand")
_ACTED_BY_ANYTHING = frozenset({"push", "pull", "hit", "carry"})
"""What a vehicle or a machine does to another object."""
_ACTED_BY_LIVING = frozenset({"hold", "carry", "push", "pull", "kick", "hit", "throw", "catch"})
_TAKES_ANY_OBJECT = frozenset({"walk", "run", "swim", "dance", "jump", "move", "drive", "climb"})
"""Motions that are the subject's own, whatever their object: "runs a race"."""
_RIDEABLE = frozenset({"drive", "sail"})


class ActReader:
    """Gives the objects of a clause their motions, acts and effects."""

    def __init__(self, draft: Draft) -> None:
        self._draft = draft
        self.is_activity = False
        """Whether the last verb named an activity together with its object: "plays the guitar"."""

    def read(self, clause: Clause, subjects: list[int], objects: Sequence[Referent]) -> list[int]:
        """Read the clause's verb.

        Args:
            clause: the clause.
            subjects: objects that do it.
            objects: what it is done to.

        Returns:
            The objects that its directions and speeds are about; empty if the verb is not shown.
        """
        word = clause.verb_word
        self.is_activity = False
        targets = [index for one in objects if one.is_things for index in one.things]
        if clause.negation is not None:
            return self._stand(clause, subjects)
        movers = self._read_activity(clause, subjects, objects)
        if movers:
            return movers
        if self._read_effect(clause, subjects):
            return subjects
        verb = word.meaning.value
        if word.role is Role.FLICKER:
            return self._blink(word, subjects)
        if self._switch(clause, subjects):
            return subjects
        if not isinstance(verb, Verb):
            return self._do_alike(clause, word, subjects, targets)
        if targets:
            return self._do_to(clause, verb, subjects, targets)
        acts_on_unshown = any(one.kind in ("unknown", "part") for one in objects)
        if not verb.kind or (acts_on_unshown and verb.kind not in _TAKES_ANY_OBJECT):
            return []
        return self._give(clause, verb, subjects)

    def _do_alike(
        self, clause: Clause, word: Word, subjects: list[int], targets: list[int]
    ) -> list[int]:
        """Show a verb by a motion near to it, and say so."""
        moved: list[int] = []
        for index in subjects:
            noun = self._draft.noun(index)
            kinds = [
                one.value[0]
                for one in (word.meaning, *word.others)
                if one.role is Role.SIMILAR and one.value[1] == is_person(noun)
            ]
            is_able = bool(kinds) and can_do(noun, kinds[0])
            if is_able and self._add_motion(index, ObjectMotion(kinds[0]), clause):
                word.shown_as = kinds[0]
                moved.append(index)
        if moved and targets:
            self._draft.relate("beside", moved, targets)
        word.is_used = bool(moved)
        return moved

    def undergo(self, clause: Clause, subjects: list[int], agents: list[int]) -> list[int]:
        """A passive: the subjects undergo the verb."""
        word = clause.verb_word
        verb = word.meaning.value
        if self._read_effect(clause, subjects):
            return subjects
        if not isinstance(verb, Verb):
            return []
        if agents:
            return self._do_to(clause, verb, agents, subjects)
        kind = verb.object_kind or (verb.kind if not verb.act else "")
        return self._give(clause, replace(verb, kind=kind), subjects) if kind else []

    def _stand(self, clause: Clause, subjects: list[int]) -> list[int]:
        """As in "does not move": only for verbs of motion."""
        word, negation = clause.verb_word, clause.negation
        if (
            negation is None
            or not isinstance(word.meaning.value, Verb)
            or not word.meaning.value.kind
        ):
            return []
        word.is_used = negation.is_used = True
        for index in subjects:
            self._add_motion(index, STAND, clause)
        return subjects

    def _read_activity(
        self, clause: Clause, subjects: list[int], objects: Sequence[Referent]
    ) -> list[int]:
        people = [i for i in subjects if is_person(self._draft.noun(i))]
        hands = [i for i in subjects if is_hand(self._draft.noun(i))]
        if not people and not hands:
            return []
        found = find_activity(clause, is_hand=bool(hands))
        if found is None:
            return []
        name, words, is_exact = found
        if not is_exact and self._is_act(clause, objects):
            return []
        self.is_activity = is_exact
        for word in words:
            word.is_used = True
        for index in hands or people:
            self._add_motion(index, ObjectMotion(name), clause)
        return hands or people

    def _is_act(self, clause: Clause, objects: Sequence[Referent]) -> bool:
        """Whether the verb acts on an object of the scene, or moves in a plain way."""
        if not isinstance(clause.verb_word.meaning.value, Verb):
            return False
        return any(one.is_things for one in objects)

    def _read_effect(self, clause: Clause, subjects: list[int]) -> bool:
        """As in "a balloon bursts", "a chimney smokes"."""
        kind = EFFECT_BY_VERB.get(clause.verb_word.lemma)
        by_people = any(is_person(self._draft.noun(index)) for index in subjects)
        if kind is None or not subjects or by_people or clause.objects:
            return False
        clause.verb_word.is_used = True
        for index in subjects:
            self._draft.effects.append(Effect(kind, source=index))
        return True

    def _switch(self, clause: Clause, subjects: list[int]) -> bool:
        """As in "a traffic light turns from red to green", which it does by itself."""
        names = {self._draft.objects[index].noun for index in subjects}
        if names != {"traffic light"} or clause.verb_word.lemma not in _SWITCHES:
            return False
        clause.verb_word.is_used = True
        groups = [group for phrase in clause.phrases for group in phrase.groups]
        for group in (*groups, *clause.complements, *clause.objects):
            mark_used(word for word in group.words if word.text in _SIGNALS)
        return True

    def _blink(self, word: Word, subjects: list[int]) -> list[int]:
        lamps = [index for index in subjects if self._draft.objects[index].noun in LAMPS]
        for index in lamps:
            self._draft.objects[index].blink_hz = DEFAULT_BLINK_HZ
            word.is_used = True
        return lamps

    def _do_to(
        self, clause: Clause, verb: Verb, subjects: list[int], targets: list[int]
    ) -> list[int]:
        word = clause.verb_word
        act = self._choose_act(verb, subjects, targets)
        if act is not None:
            word.is_used = self._draft.relate(act, subjects, targets)
            if act == "ride":
                return self._ride(clause, verb, subjects, targets)
            if act in ("push", "pull"):
                for index in subjects:
                    self._add_motion(index, ObjectMotion("move", pace=verb.pace), clause)
            return subjects
        if verb.relation is not None and verb.kind:
            movers = self._give(clause, verb, subjects)
            if movers:
                self._draft.relate(verb.relation, movers, targets)
            return movers
        if verb.object_kind is not None:
            return self._give(clause, replace(verb, kind=verb.object_kind), targets)
        if verb.kind:
            movers = self._give(clause, verb, subjects)
            if movers:
                self._draft.relate("with", movers, targets)
                self._give(clause, verb, [i for i in targets if is_living(self._draft.noun(i))])
            return movers
        return []

    def _choose_act(self, verb: Verb, subjects: list[int], targets: list[int]) -> str | None:
        """The act, if these subjects can do it to these objects."""
        act = verb.act
        if act is None or not subjects:
            return None
        doer, target = self._draft.noun(subjects[0]), self._draft.noun(targets[0])
        if act == "ride":
            is_mount = target.motion in _RIDEABLE or is_living(target) or target.name in BOARDS
            return "ride" if is_living(doer) and is_mount else None
        if act == "wear":
            return "wear" if is_living(doer) and target.name in WEARABLE else None
        if is_living(doer) or is_hand(doer):
            return act if act in _ACTED_BY_LIVING else None
        return act if act in _ACTED_BY_ANYTHING else None

    def _ride(
        self, clause: Clause, verb: Verb, subjects: list[int], targets: list[int]
    ) -> list[int]:
        kind = "fly" if self._draft.noun(targets[0]).motion == "fly" else "move"
        motion = ObjectMotion(kind, verb.direction, verb.pace)
        for index in targets:
            self._add_motion(index, motion, clause)
        for index in subjects:
            if not self._draft.objects[index].motions:
                self._draft.objects[index].motions.append(ObjectMotion("sit"))
        return targets

    def _give(self, clause: Clause, verb: Verb, things: list[int]) -> list[int]:
        """Give a motion to the objects that can do it; the others are left as they are."""
        word = clause.verb_word
        things = [self._mount(index) for index in things]
        if verb.kind == "wave" and any(self._draft.noun(i).is_working for i in things):
            verb = replace(verb, kind="work")
        able = [index for index in things if can_do(self._draft.noun(index), verb.kind)]
        if not able:
            return []
        motion = ObjectMotion(verb.kind, verb.direction, verb.pace, end_pace=verb.end_pace)
        added = [
            index
            for index in able
            if self._add_motion(index, self._fall_over(index, motion, clause), clause)
        ]
        word.is_used = bool(added)
        return added

    def _fall_over(self, index: int, motion: ObjectMotion, clause: Clause) -> ObjectMotion:
        """As in "a person falls": over, unless it is said from where."""
        noun = self._draft.noun(index)
        is_from = any(phrase.preposition.text in _FROM_ABOVE for phrase in clause.phrases)
        stands = is_living(noun) and noun.habitat == "ground"
        if motion.kind == "fall" and stands and not is_from:
            return replace(motion, kind="topple")
        return motion

    def _mount(self, index: int) -> int:
        """What the object rides, which moves in its place: "a man on a horse gallops"."""
        for relation in self._draft.relations:
            if relation.kind == "ride" and relation.subject == index:
                return relation.targets[0]
        return index

    def _add_motion(self, index: int, motion: ObjectMotion, clause: Clause) -> bool:
        """Add a motion after those that the object has; False if it comes at the same time."""
        item = self._draft.objects[index]
        motions, order = item.motions, clause.order
        if order == "same" and item.sentence < clause.sentence:
            order = "after"
        item.sentence = clause.sentence
        motion = self._name_kind(index, motion)
        if not motions:
            motions.append(motion)
        elif order == "after":
            motions.append(_carry_on(motions[-1], motion))
        elif order == "before":
            motions.insert(max(len(motions) - 1, 0), motion)
        elif motions[-1].kind in ("sit", "stand", "lie") and motion.kind != motions[-1].kind:
            return False
        else:
            return motions[-1].kind == motion.kind
        return True

    def _name_kind(self, index: int, motion: ObjectMotion) -> ObjectMotion:
        if motion.kind != "move":
            return motion
        usual = self._draft.noun(index).motion
        return replace(motion, kind=usual if usual != "stand" else "slide")

    def set_rate(self, things: list[int], rate_hz: float) -> bool:
        """Turns per second of what spins, or flashes per second of what blinks."""
        is_used = False
        for index in things:
            item = self._draft.objects[index]
            if item.blink_hz is not None:
                item.blink_hz, is_used = rate_hz, True
            elif item.motions and item.motions[-1].kind == "spin":
                item.motions[-1] = replace(item.motions[-1], pace=rate_hz / SPIN_RATE_HZ)
                is_used = True
        return is_used


def _carry_on(before: ObjectMotion, motion: ObjectMotion) -> ObjectMotion:
    """What moves on keeps its direction."""
    keeps = motion.direction is None and before.is_moving and motion.kind == before.kind
    return replace(motion, direction=before.direction) if keeps else motion


EFFECT_BY_VERB: dict[str, str] = {
    verb: kind for kind, words in EFFECTS.items() for verb in words.verbs if " " not in verb
}
"""Verb of one word → the effect it means."""
_FROM_ABOVE = ("from", "off", "out of", "into", "through", "down")
_SWITCHES = ("turn", "change", "switch", "go")
_SIGNALS = ("red", "yellow", "amber", "green")
BOARDS = frozenset(
    {"skateboard", "surfboard", "snowboard", "scooter", "skis", "wave", "sled", "carousel horse"}
)
"""What is ridden besides vehicles and animals."""
WEARABLE = frozenset(
    {"hat", "cap", "helmet", "backpack", "glasses", "scarf", "tie", "vest", "jacket", "dress",
     "shirt", "skirt", "mask", "crown", "sunglasses", "coat", "glove", "boots", "shoe"}
)  # fmt: skip
"""What is worn."""


def is_plain_past(word: Word) -> bool:
    """Whether a past form stands for the present: "a man walked"; not for "a hoop held by"."""
    verb = word.meaning.value
    if word.meaning.form is not VerbForm.PAST or not isinstance(verb, Verb):
        return False
    return bool(verb.kind) and verb.act is None and verb.object_kind is None
