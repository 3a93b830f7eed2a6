"""Clauses about objects: what each subject does, to what, and where."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import Effect, ObjectMotion
from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.activities import base_form, find_activity, note_near
from texvent.scenes.language.meaning.acts.devices import (
    blink,
    give_effect,
    lift_load,
    open_up,
    switch,
    switch_lamps,
)
from texvent.scenes.language.meaning.acts.fitting import (
    MANOEUVRES,
    PAW,
    SEEN_AS_SAID,
    UNSEATED,
    WHEELED,
    choose_act,
    fall_over,
    fit_kind,
    fit_moving,
    fit_verb,
    hang_up,
    has_phrase,
    is_played,
    note_untouched,
    throw_up_earth,
)
from texvent.scenes.language.meaning.acts.hand_work import (
    is_by_hand,
    is_of_own_part,
    lacks_thing,
    work_by_hand,
    work_on,
)
from texvent.scenes.language.meaning.acts.looking import look_at
from texvent.scenes.language.meaning.acts.mounting import ride, ride_unnamed
from texvent.scenes.language.meaning.acts.partners import (
    PAIRED,
    collide,
    give_to,
    join_partners,
    tug,
)
from texvent.scenes.language.meaning.acts.sequence import (
    STOPS,
    add_motion,
    find_mount,
    is_part_of_doer,
    set_off,
    stand,
)
from texvent.scenes.language.meaning.adjectives import line_up
from texvent.scenes.language.meaning.capabilities import can_do, is_hand, is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.vocabulary.acts import OF_ONESELF
from texvent.scenes.language.vocabulary.motion import LED
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, mark_used
from texvent.scenes.models.animals.acts import ANIMAL_ACTS, MOUTH_ACTS, shown_as
from texvent.scenes.models.people.work.verbs import HANDWORK

_ON_LEGS = ("walk", "run", "jump", "swim", "paddle")
"""Usual motions of animals that are not thrown through the air."""
_OF_PARTS = ("work", "sway", "wave")
"""Motions that an animal shows when it does them with a part of itself."""
_SINGLE = frozenset({"kick", "hit", "throw", "catch"})
"""Acts of which each subject does one."""
_TAKES_ANY_OBJECT = frozenset({"walk", "run", "swim", "dance", "jump", "move", "drive", "climb"})
"""Motions that are the subject's own, whatever their object: "runs a race"."""


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
        self.is_activity = False
        targets = [index for one in objects if one.is_things for index in one.things]
        verb = clause.verb_word.meaning.value
        if isinstance(verb, Verb) and verb.act == "collide":
            return collide(self._draft, clause, subjects, targets)
        if clause.negation is not None:
            return stand(self._draft, clause, subjects)
        if give_to(self._draft, clause, subjects, objects):
            return subjects
        movers = self._read_activity(clause, subjects, objects)
        if movers:
            rest = [n for n in subjects if n not in movers]
            return movers + self._join_in(clause, rest, objects, targets)
        if give_effect(self._draft, clause, subjects):
            return subjects
        if clause.verb_word.role is Role.FLICKER:
            return blink(self._draft, clause.verb_word, subjects)
        for does in (lift_load, look_at, hang_up):
            if does(self._draft, clause, subjects, targets):
                return subjects
        if switch(self._draft, clause, subjects):
            return subjects
        return self._read_verb(clause, subjects, objects, targets)

    def _join_in(
        self, clause: Clause, rest: list[int], objects: Sequence[Referent], targets: list[int]
    ) -> list[int]:
        """As in "a man and a dog run": the dog too; what cannot do it is named."""
        joined = self._read_verb(clause, rest, objects, targets) if rest else []
        clause.verb_word.is_used = True
        for noun in (self._draft.noun(n) for n in rest if n not in joined):
            if is_living(noun):
                self._draft.note(f"the {noun.name} does not do it ({clause.verb_word.text})")
        return joined

    def _read_verb(
        self,
        clause: Clause,
        subjects: list[int],
        objects: Sequence[Referent],
        targets: list[int],
    ) -> list[int]:
        """A verb that is no activity, effect or signal."""
        word = clause.verb_word
        verb = word.meaning.value
        is_alive = all(is_living(self._draft.noun(n)) for n in subjects)
        outer = [one for one in objects if not (is_alive and is_part_of_doer(one))]
        if not isinstance(verb, Verb):
            is_done_to = any(one.kind in ("things", "unknown", "part") for one in outer)
            return self._do_alike(clause, word, subjects, targets, is_done_to=is_done_to)
        if targets and is_by_hand(self._draft, verb, subjects, targets):
            return work_by_hand(self._draft, clause, subjects, targets)
        if targets:
            pair = (self._draft.noun(subjects[0]), self._draft.noun(targets[0]))
            moving = fit_moving(verb, pair, self._draft.length_m(targets[0]), word)
            return self._do_to(clause, moving, subjects, targets) if moving else []
        acts_on_unshown = any(
            one.kind in ("unknown", "part") and one.group.text.split()[-1:] != ["times"]
            for one in (outer if verb.kind in _OF_PARTS else objects)
        )
        is_own = verb.kind in _TAKES_ANY_OBJECT or verb.base in STOPS
        if not verb.kind or (acts_on_unshown and not is_own):
            return []
        if ridden := ride_unnamed(self._draft, clause, subjects):
            return ridden
        moved = self._give(clause, verb, subjects)
        if moved and verb.relation == "overtake":
            word.shown_as = "drive fast past nothing"
        return moved

    def _do_alike(
        self,
        clause: Clause,
        word: Word,
        subjects: list[int],
        targets: list[int],
        *,
        is_done_to: bool,
    ) -> list[int]:
        """Show a verb by a motion near to it, and say so.

        What is no person only moves: "dumps its load" is no motion of its own.
        """
        moved: list[int] = []
        for index in subjects:
            noun = self._draft.noun(index)
            kinds = [
                one.value[0]
                for one in (word.meaning, *word.others)
                if one.role is Role.SIMILAR and one.value[1] == is_person(noun)
            ]
            base = base_form(word.lemma)
            is_toying = base == "play" and has_phrase(clause, "with") and PAW in noun.acts
            kinds = [PAW] if is_toying else kinds
            if is_done_to and not is_person(noun) and not set(kinds) & ANIMAL_ACTS.keys():
                continue
            if is_done_to and kinds[:1] and kinds[0] in OF_ONESELF:
                continue
            is_able = (
                bool(kinds) and can_do(noun, kinds[0]) and is_played(kinds[0], clause, self._draft)
            )
            if is_able and add_motion(self._draft, index, ObjectMotion(kinds[0]), clause):
                is_act = kinds[0] in ANIMAL_ACTS
                word.shown_as = shown_as(kinds[0], base) if is_act else kinds[0]
                word.shown_as = None if is_toying else word.shown_as
                moved.append(index)
        if moved and targets:
            done = {self._draft.objects[index].motions[-1].kind for index in moved}
            is_at = done & (HANDWORK.keys() | MOUTH_ACTS | {"climb"})
            self._draft.relate("work on" if is_at else "beside", moved, targets)
        word.is_used = bool(moved)
        return moved

    def undergo(self, clause: Clause, subjects: list[int], agents: list[int]) -> list[int]:
        """A passive: the subjects undergo the verb."""
        word = clause.verb_word
        verb = word.meaning.value
        if give_effect(self._draft, clause, subjects):
            return subjects
        if switch_lamps(self._draft, clause, subjects) or open_up(self._draft, clause, subjects):
            return []
        if not isinstance(verb, Verb):
            return []
        if agents:
            return self._do_to(clause, verb, agents, subjects)
        kind = verb.object_kind or (verb.kind if not verb.act else "")
        if verb.act == "throw":
            return self._fly_off(clause, verb, subjects)
        return self._give(clause, replace(verb, kind=kind), subjects) if kind else []

    def _fly_off(self, clause: Clause, verb: Verb, subjects: list[int]) -> list[int]:
        """As in "a ball is thrown": it flies, whoever threw it."""
        nouns = [self._draft.noun(index) for index in subjects]
        if any(is_person(noun) or noun.motion in _ON_LEGS for noun in nouns):
            return []
        kind = "fly" if all(noun.motion == "fly" for noun in nouns) else "throw"
        return self._give(clause, replace(verb, kind=kind), subjects)

    def _read_activity(
        self, clause: Clause, subjects: list[int], objects: Sequence[Referent]
    ) -> list[int]:
        people = [i for i in subjects if is_person(self._draft.noun(i))]
        hands = [i for i in subjects if is_hand(self._draft.noun(i))]
        if not people and not hands:
            return subjects if subjects and tug(self._draft, clause, subjects) else []
        found = find_activity(clause, is_hand=bool(hands))
        if found is None:
            return []
        name, words, is_exact = found
        if not is_exact and not self._is_done_alone(name, clause, objects):
            return []
        added = [add_motion(self._draft, i, ObjectMotion(name), clause) for i in hands or people]
        if not any(added):
            return []
        if name in PAIRED:
            join_partners(self._draft, name, people, objects)
        self.is_activity = is_exact
        mark_used(words)
        note_near(name, words)
        self._draft.link_motion(words, hands or people)
        if name == "blow bubbles":
            self._draft.effects += [Effect("bubbles", index) for index in people]
        if name == "tie shoes":
            shoes = [index for one in objects if one.is_things for index in one.things]
            self._draft.relate("wear", people, shoes[:1])
        if name in HANDWORK and not is_exact:
            work_on(self._draft, words[0], people, objects)
        return hands or people

    def _is_done_alone(self, name: str, clause: Clause, objects: Sequence[Referent]) -> bool:
        """Whether an activity that the verb alone names is what the clause says."""
        if lacks_thing(name, objects) or not is_played(name, clause, self._draft):
            return False
        is_verb = isinstance(clause.verb_word.meaning.value, Verb)
        is_act = is_verb and any(one.is_things for one in objects)
        return not (is_act or is_of_own_part(name, objects))

    def _do_to(
        self, clause: Clause, verb: Verb, subjects: list[int], targets: list[int]
    ) -> list[int]:
        doer, target = self._draft.noun(subjects[0]), self._draft.noun(targets[0])
        act = choose_act(verb, doer, target, self._draft.length_m(targets[0]))
        if act == "collide":
            return collide(self._draft, clause, subjects, targets)
        if act is not None:
            return self._act(clause, verb, act, subjects, targets)
        if verb.relation is not None and verb.kind:
            if set(targets) <= set(subjects):
                return self._do_to_each_other(clause, verb, subjects)
            way = None if verb.relation == "towards" else verb.direction  # not to the camera
            movers = self._give(clause, replace(verb, direction=way), subjects)
            if movers:
                self._draft.relate(verb.relation, movers, targets, verb.way)
            return movers
        if verb.object_kind is not None:
            note_untouched(self._draft, clause, subjects, targets)
            return self._give(clause, replace(verb, kind=verb.object_kind), targets)
        if verb.kind and verb.kind not in OF_ONESELF - {"jump", "walk", "run"}:
            movers = self._give(clause, verb, subjects)
            climbs = any(self._draft.objects[n].motions[-1].kind == "climb" for n in movers)
            if movers and (verb.kind == "rise" or climbs):
                # As in "climbs a ladder": it moves beside it.
                kind = self._draft.objects[movers[0]].motions[-1].kind
                is_at = kind == "climb" and is_living(doer)
                clause.verb_word.shown_as = None if is_at else f"{kind} beside it"
                self._draft.relate("work on" if is_at else "beside", movers, targets)
            elif movers:
                is_led = verb.base == "walk" and is_person(doer) and is_living(target)
                self._draft.relate("with", movers, targets, LED if is_led else "")
                self._give(clause, verb, [i for i in targets if is_living(self._draft.noun(i))])
            return movers
        return []

    def _do_to_each_other(self, clause: Clause, verb: Verb, subjects: list[int]) -> list[int]:
        """As in "two trains pass each other": the two come from opposite sides.

        One of those that "chase each other" runs ahead.
        """
        pair = subjects if len(subjects) > 1 else self._draft.split(subjects[0])
        movers = self._give(clause, verb, pair)
        if len(movers) < len(pair) or len(pair) < 2:
            clause.verb_word.is_used = False
            return movers
        if verb.relation == "past":
            for place, index in enumerate(pair):
                motions = self._draft.objects[index].motions
                motions[-1] = replace(motions[-1], direction=("right", "left")[place % 2])
        self._draft.relate(str(verb.relation), pair[1:], pair[:1])
        return movers

    def _act(
        self, clause: Clause, verb: Verb, act: str, subjects: list[int], targets: list[int]
    ) -> list[int]:
        is_second = act in _SINGLE and any(
            one.kind in _SINGLE and one.subject in subjects for one in self._draft.relations
        )
        if is_second:
            return []
        if act == "pull" and self._pull_in_place(clause, subjects, targets):
            return subjects
        clause.verb_word.is_used = self._draft.relate(act, subjects, targets)
        if act == "ride":
            return ride(self._draft, clause, verb, subjects, targets)
        goes = {phrase.preposition.text for phrase in clause.phrases} & _GOING
        if act in ("push", "pull") or (act == "carry" and (goes or verb.base in _COMING)):
            way = "towards" if verb.base == "bring" and not goes else None
            for index in subjects:
                add_motion(self._draft, index, ObjectMotion("move", way, verb.pace), clause)
        return subjects

    def _pull_in_place(self, clause: Clause, subjects: list[int], targets: list[int]) -> bool:
        """As in "pulls a rope": who does it stays and leans back."""
        people = all(is_person(self._draft.noun(index)) for index in subjects)
        if not people or any(self._draft.noun(index).name not in _LINES for index in targets):
            return False
        for index in subjects:
            add_motion(self._draft, index, ObjectMotion("pull"), clause)
        clause.verb_word.is_used = True
        return True

    def _give(self, clause: Clause, verb: Verb, things: list[int]) -> list[int]:
        """Give a motion to the objects that can do it; the others are left as they are."""
        word = clause.verb_word
        things = [find_mount(self._draft, index) for index in things]
        for index in things:
            line_up(self._draft.objects[index], verb.kind)
        nouns = [self._draft.noun(index) for index in things]
        verb = fit_kind(verb, nouns)
        added = []
        for index in things:
            noun = self._draft.noun(index)
            fitting = fit_verb(verb, noun, clause)
            if fitting is None or not can_do(noun, fitting.kind):
                continue
            set_off(self._draft, index, verb, clause)
            motion = ObjectMotion(
                fitting.kind, verb.direction, fitting.pace, end_pace=verb.end_pace
            )
            if add_motion(self._draft, index, fall_over(noun, motion, clause), clause):
                added.append(index)
                is_same = verb.relation == "follow" or fitting.kind in MANOEUVRES
                is_same |= verb.base in SEEN_AS_SAID
                is_same |= verb.kind == "drive" and noun.name in WHEELED
                is_same |= verb.base == "sit" and noun.name not in UNSEATED - _SITTING
                throw_up_earth(self._draft, fitting.kind, verb, index)
                if fitting is not verb and not is_same:
                    word.shown_as = noun.motion if fitting.kind == "move" else fitting.kind
        word.is_used = word.is_used or bool(added)
        return added


_SITTING = frozenset({"teddy bear"})
"""Toys whose models sit."""
_GOING = frozenset({"to", "towards", "toward", "across", "along", "through", "past", "into"})
"""Prepositions of who goes somewhere with what it carries."""
_COMING = frozenset({"move", "bring"})
_LINES = frozenset({"rope", "chain", "hose"})
"""What is pulled at, not along."""
