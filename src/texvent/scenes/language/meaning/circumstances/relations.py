"""Prepositions between objects: where one is, or goes, with respect to others."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.description import Relation
from texvent.scenes.language.grammar.syntax import PrepPhrase
from texvent.scenes.language.meaning.acts.doers import talk_on_phone
from texvent.scenes.language.meaning.acts.looking import address, face
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.circumstances.company import gather, is_company, keep_company
from texvent.scenes.language.meaning.circumstances.courses import FOLLOWED, be_followed
from texvent.scenes.language.meaning.circumstances.fillings import FULL, fill
from texvent.scenes.language.meaning.circumstances.nearest import has_nearest, put_down
from texvent.scenes.language.meaning.circumstances.place_ways import lifts_off
from texvent.scenes.language.meaning.circumstances.put import (
    FOOD,
    OFF_GROUND,
    TABLES,
    is_put,
    is_small,
    is_topped,
    take_out,
    top,
)
from texvent.scenes.language.meaning.circumstances.slopes import go_on_slope
from texvent.scenes.language.meaning.circumstances.walked import WALKED, list_goers
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.resolver import Referents
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.unridden import HAS_RIDER
from texvent.scenes.language.vocabulary.acts import BOARDS, WEARABLE
from texvent.scenes.language.vocabulary.motion import APART, PREPOSITION_WAYS, WEAK_PREPOSITIONS
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word
from texvent.scenes.models.objects.receptacles import CARRIERS, LIFTED_LADEN, VESSELS
from texvent.scenes.models.people.activities import ACTIVITIES, DONE_SEATED, SEATS
from texvent.scenes.models.people.props import PROPS
from texvent.scenes.models.people.work.verbs import HANDWORK

_HELD = frozenset({"umbrella", "kite", "balloon", "flag", "surfboard", "racket", "ski"})
_TAKEN_BY = {
    "dog": ("branch", "bone", "frisbee", "ball", "tennis ball", "newspaper", "shoe"),
    "cat": ("mouse", "fish"),
    "bird": ("branch", "fish", "worm"),
}
"""Animal → what it has in its mouth when it is "with" it."""


class RelationReader:
    """Relates the subjects of a clause to the objects that its prepositions name."""

    def __init__(self, draft: Draft, referents: Referents) -> None:
        self._draft = draft
        self._referents = referents
        self._loosely_held: list[Relation] = []

    def read(self, phrase: PrepPhrase, things: list[int], scope: Scope) -> None:
        """Relate the clause's subjects to the things; report what cannot be honoured."""
        word = phrase.preposition
        near = self._referents.recall(phrase.near)
        if phrase.has_pronoun and near is not None and near.kind == "unknown":
            scope = Scope([], [], is_lost=True)  # "a table with equipment on it"
        else:
            scope = self._narrow(phrase, things, scope)
        if not scope.subjects:
            word.is_used = not scope.is_lost
            word.is_lost = scope.is_lost
            return
        if phrase.denial is not None:
            self._deny(phrase, things, scope)
            return
        before = len(self._draft.relations)
        kind = self._at_bench(self._relation_kind(word, things), things, scope)
        kind = "at" if self._is_at_table(word, things, scope) else kind
        is_used = address(self._draft, word.text, scope, things)
        is_used = is_used or self._read_sense(phrase, kind, things, scope)
        word.is_used, word.is_lost = is_used, not is_used
        word.relations = tuple(self._draft.relations[before:])

    def _read_sense(
        self, phrase: PrepPhrase, kind: str | None, things: list[int], scope: Scope
    ) -> bool:
        """A preposition in one of its senses; `kind` is the relation that it usually means."""
        word = phrase.preposition
        if word.text in FOLLOWED:
            return be_followed(self._draft, things, scope)
        if word.text in FULL:
            near = self._referents.recall(phrase.near)
            return fill(self._draft, word, near, things, scope)
        if scope.has_verb and not scope.is_verb_shown:
            return self._rest(word, kind, things, scope)
        if is_topped(word):
            return top(self._draft, things, scope.subjects)
        if word.text == "with":
            return self._read_with(things, scope)
        if self._ride_along(word, things, scope) or self._is_in_use(scope, things):
            return True
        if word.text in ("up", "down", "facing"):
            return self._turn_or_climb(word, things, scope)
        goers = list_goers(self._draft, word, things, scope)
        if goers:
            return self._relate("on", goers, things, WALKED[word.text])
        return kind is not None and self._read_kind(kind, word, things, scope)

    def _deny(self, phrase: PrepPhrase, things: list[int], scope: Scope) -> None:
        """As in "is not on the table": beside it; what is "not behind" it may be anywhere."""
        word, denial = phrase.preposition, phrase.denial
        is_read = word.text in _DENIED and self._draft.relate(
            "beside", scope.subjects, things, APART
        )
        word.is_used, word.is_lost = is_read, not is_read
        if denial is not None:
            denial.is_used = denial.is_used or is_read

    def _read_kind(self, kind: str, word: Word, things: list[int], scope: Scope) -> bool:
        """A relation of the clause's subjects, or of what is acted on."""
        if self._is_in_food(kind, things, scope) or self._hang_on(kind, word, things, scope):
            return False
        is_laid = self._draft.noun(things[0]).name in TABLES | LIFTED_LADEN
        if kind in ("on", "in") and not scope.has_verb and is_laid:
            put_down(self._draft, scope.subjects, things, self._loosely_held)
        if kind == "on" and talk_on_phone(self._draft, scope.subjects, things):
            return True
        if kind == "above" and self._is_on_ground(scope.movers or scope.subjects):
            # As in "play badminton over a net": they stand at it, which "over" does not say.
            self._relate("beside", scope.subjects, things)
            return False
        if is_company(self._draft, kind, scope.subjects, things):
            return gather(self._draft, scope.subjects, things)
        if kind == "from" and self._stays(scope):
            name = self._draft.noun(things[0]).name
            place = "in" if name == "window" else "on" if name in _PERCHES else "beside"
            return self._relate(place, scope.subjects, things, "at" if place == "beside" else "")
        if kind == "from" and lifts_off(self._draft, scope.movers, things[0]):
            return self._relate("on", scope.movers, things, "off")
        if self._is_journey_of_none(kind, scope) or (word.text == "off" and self._bounce(scope)):
            return False
        subjects = scope.movers if kind in _PATHS and scope.movers else scope.subjects
        if word.text in _MOVES_OBJECT and kind in ("on", "in") and scope.acted_on:
            # As in "drops a box into a bin", "takes a book off a shelf".
            subjects = list(scope.acted_on)
        return self._relate(kind, subjects, things, PREPOSITION_WAYS.get(word.text, ""))

    def _is_in_food(self, kind: str, things: list[int], scope: Scope) -> bool:
        """As in "a dog in the fruit"."""
        is_food = kind == "in" and self._draft.noun(things[0]).name in FOOD
        return is_food and any(is_living(self._draft.noun(index)) for index in scope.subjects)

    def _hang_on(self, kind: str, word: Word, things: list[int], scope: Scope) -> bool:
        """As in "a clock on top of a tower": it is on its front, as usual; the words are lost."""
        names = {self._draft.noun(index).name for index in scope.subjects}
        is_clock = word.text in _AT_TOP and names == {"clock"}
        is_crown = is_clock and self._draft.length_m(things[0]) > _TALL_M
        return is_crown and self._relate(kind, scope.subjects, things)

    def _bounce(self, scope: Scope) -> bool:
        """As in "bounces off a wall", which is no way down from it."""
        motions = [self._draft.objects[index].motions[-1:] for index in scope.movers]
        return any(one and one[0].kind == "bounce" for one in motions)

    def _at_bench(self, kind: str | None, things: list[int], scope: Scope) -> str | None:
        """As in "kneads dough on a table", of which the dough is not shown: hands at the table."""
        motions = [self._draft.objects[index].motions[-1:] for index in scope.movers]
        works = bool(motions) and all(one and one[0].kind in HANDWORK for one in motions)
        is_seat = self._draft.noun(things[0]).name in SEATS if things else True
        if kind != "on" or not works or is_seat:
            return kind
        is_busy = any(
            one.kind == "work on" and one.subject in scope.movers for one in self._draft.relations
        )
        return kind if is_busy else "work on"

    def _is_at_table(self, word: Word, things: list[int], scope: Scope) -> bool:
        """As in "students at their desks": they sit there, unless the prompt has them stand."""
        if word.text not in ("at", "around") or self._draft.noun(things[0]).name not in TABLES:
            return False
        if not all(is_person(self._draft.noun(index)) for index in scope.subjects):
            return False
        motions = [self._draft.objects[index].motions for index in scope.subjects]
        return all(one[-1].kind in DONE_SEATED | {"sit", "sit down"} for one in motions if one)

    def _narrow(self, phrase: PrepPhrase, things: list[int], scope: Scope) -> Scope:
        """As in "zebras with a giraffe behind them": the giraffe is behind them.

        As in "crawls towards a bear on a rug": the bear is on it.
        """
        near = self._referents.recall(phrase.near)
        if near is None or not things:
            return scope
        if phrase.has_pronoun and near.is_things and set(near.things) != set(things):
            # As in "pushes a stroller with a baby in it": the baby is.
            moved = scope.subjects if set(near.things) <= set(scope.subjects) else near.things
            if phrase.preposition.text in _BESIDES:
                take_out(self._draft, moved)
            return Scope(moved, [], has_verb=False)
        is_worn = phrase.preposition.text == "in" and self._draft.noun(things[0]).name in WEARABLE
        if is_worn and near.is_things and all(is_person(self._draft.noun(n)) for n in near.things):
            # As in "camels led by a man in a robe".
            return Scope(near.things, [], has_verb=False)
        is_acted_on = near.is_things and set(near.things) <= set(scope.acted_on)
        is_goal = near.is_things and any(
            one.kind in _GOALS and one.subject in scope.subjects
            and set(near.things) <= set(one.targets)
            for one in self._draft.relations
        )  # fmt: skip
        if (is_acted_on or is_goal) and phrase.preposition.text in _RESTING - {"with"}:
            return Scope(near.things, [], has_verb=False)
        names = {self._draft.noun(index).name for index in near.things} if near.is_things else set()
        if is_acted_on and phrase.preposition.text == "with" and names & (CARRIERS | VESSELS):
            # As in "carries a tray with two cups".
            return Scope(near.things, [], has_verb=False)
        if names and is_put(self._draft, phrase, near.things, things, scope):
            take_out(self._draft, near.things)
            put_down(self._draft, near.things, things, self._loosely_held)
            return Scope(near.things, [], has_verb=False)
        own = near.things if near.is_things and not set(near.things) & {*scope.subjects} else []
        if own and self._is_nearer(phrase.preposition.text, own, things, scope):
            return Scope(own, [], has_verb=False)
        is_of_subjects = set(things) == set(scope.subjects) and set(near.things) != set(things)
        if not (is_of_subjects and near.is_things):
            return scope
        return Scope(near.things, [], has_verb=False)

    def _is_nearer(
        self, word: str, near: Sequence[int], things: Sequence[int], scope: Scope
    ) -> bool:
        """As in "looks through a book on a table", of which the looking is not shown."""
        if word == "with":
            return has_nearest(self._draft, near, things, scope)
        is_lost = scope.has_verb and not scope.is_verb_shown
        return is_lost and word in _RESTING - {"at", "by"}

    def _turn_or_climb(self, word: Word, things: list[int], scope: Scope) -> bool:
        if word.text == "facing":
            return face(self._draft, scope.subjects, things)
        return go_on_slope(self._draft, word, things, scope)

    def _rest(self, word: Word, kind: str | None, things: list[int], scope: Scope) -> bool:
        """What does something that is not shown is where it is, if it acts on nothing.

        As in "tightens a pipe with a wrench": the wrench is held all the same.
        """
        if word.text == "with" and scope.has_object and self._is_tool(scope, things):
            return self._draft.relate("hold", scope.subjects, things)
        if kind is None or word.text not in _RESTING or scope.has_object:
            return False
        if kind == "on" and self._draft.noun(things[0]).name in _LEANT_ON:
            # As in "leans on a fence": they stand at it, not on its top.
            kind = "beside"
        return self._relate(kind, scope.subjects, things, "at" if word.text == "at" else "")

    def _is_tool(self, scope: Scope, things: Sequence[int]) -> bool:
        noun = self._draft.noun(things[0])
        is_done_by_people = all(is_person(self._draft.noun(index)) for index in scope.subjects)
        return is_done_by_people and noun.motion == "stand" and is_small(self._draft, things[0])

    def _is_on_ground(self, subjects: Sequence[int]) -> bool:
        """Whether they are people or animals whose motion leaves them on the ground."""
        return all(
            is_living(self._draft.noun(index))
            and self._draft.noun(index).habitat == "ground"
            and not any(one.kind in OFF_GROUND for one in self._draft.objects[index].motions)
            for index in subjects
        )

    def _is_in_use(self, scope: Scope, things: Sequence[int]) -> bool:
        """As in "talks on her phone": the activity shows where it is."""
        motions = [one for index in scope.movers for one in self._draft.objects[index].motions[-1:]]
        props = [prop for one in motions for prop in PROPS.get(one.kind, ())]
        return any(self._draft.noun(things[0]).name in prop.nouns for prop in props)

    def _stays(self, scope: Scope) -> bool:
        """As in "waves from a window": who does it stays there."""
        motions = [self._draft.objects[index].motions for index in scope.movers]
        last = [one[-1].kind if one else "" for one in motions]
        still = {kind for kind, one in ACTIVITIES.items() if not one.travels} - OFF_GROUND
        return bool(motions) and still.issuperset(last)

    def _is_journey_of_none(self, kind: str, scope: Scope) -> bool:
        return kind in _JOURNEYS and scope.has_verb and not scope.movers

    def _relate(
        self, kind: str, subjects: Sequence[int], things: Sequence[int], way: str = ""
    ) -> bool:
        """Sitting "on" a bicycle is riding it."""
        mount = self._draft.noun(things[0])
        is_rider = bool(subjects) and is_person(self._draft.noun(subjects[0]))
        is_mount = mount.name in HAS_RIDER or mount.name in BOARDS or (
            is_living(mount) and not is_person(mount)
        )  # fmt: skip
        if kind == "on" and is_rider and is_mount:
            kind = "ride"
        return self._draft.relate(kind, subjects, things, way)

    def _relation_kind(self, word: Word, things: list[int]) -> str | None:
        if word.text == "in" and self._draft.noun(things[0]).name in WEARABLE:
            return "wear"
        if word.role is Role.RELATION:
            is_tied = word.text == "on" and self._draft.noun(things[0]).name == "rope"
            return None if is_tied else str(word.meaning.value)  # "a dog on a leash"
        return WEAK_PREPOSITIONS.get(word.text)

    def _read_with(self, things: list[int], scope: Scope) -> bool:
        doer, item = self._draft.noun(scope.subjects[0]), self._draft.noun(things[0])
        if is_person(item) and self._is_carrier(scope.subjects[0], things[0]):
            # As in "a motorcycle with a passenger", "a boat with three fishermen".
            said = self._draft.objects[things[0]].said or ""
            is_second = doer.name in HAS_RIDER and said not in _STEERING
            kind = "ride along" if is_second else "ride"
            return self._draft.relate(kind, things, scope.subjects)
        if item.name in WEARABLE and is_living(doer):
            return self._draft.relate("wear", scope.subjects, things)
        is_taken = item.name in _TAKEN_BY.get(doer.name, ())
        if is_taken or (is_person(doer) and item.name == "branch"):
            # As in "a boy with a stick", "a dog with a bone".
            return self._draft.relate("hold", scope.subjects, things)
        is_held = item.name in _HELD or (
            item.motion == "stand" and is_small(self._draft, things[0])
        )
        motions = [self._draft.objects[i].motions[-1:] for i in scope.movers]
        works = any(one[0].kind in HANDWORK for one in motions if one)
        is_held |= works and item.motion == "stand" and item.habitat == "fixed"
        goes = any(one[0].kind in ("walk", "run") for one in motions if one)
        is_held |= goes and item.motion == "roll" and is_small(self._draft, things[0])
        if is_person(doer) and is_held:
            table = self._find_table(scope.subjects)
            if table:
                return self._draft.relate("on", things, table)
            before = len(self._draft.relations)
            is_related = self._draft.relate("hold", scope.subjects, things)
            self._loosely_held += self._draft.relations[before:]
            return is_related
        if item.name in CARRIERS and doer.name not in CARRIERS:
            return self._draft.relate("on", scope.subjects, things)
        seats = [index for index in things if self._draft.noun(index).name in SEATS]
        if doer.name in TABLES and seats:
            rest = [index for index in things if index not in seats]
            is_rest = not rest or self._read_with(rest, scope)
            count = sum(self._draft.objects[index].count for index in seats)
            kind = "around" if count > 1 else "beside"
            return self._draft.relate(kind, seats, scope.subjects) and is_rest
        if doer.name in CARRIERS and is_small(self._draft, things[0]):
            return self._draft.relate("on", things, scope.subjects)
        if doer.name in VESSELS and (is_small(self._draft, things[0]) or doer.name == "stroller"):
            return self._draft.relate("in", things, scope.subjects)
        keep_company(self._draft, scope.subjects, things)
        return self._draft.relate("with", scope.subjects, things)

    def _find_table(self, subjects: Sequence[int]) -> Sequence[int]:
        """As in "a man at a table with a laptop": the table at which they are, if any."""
        at = (one for one in self._draft.relations if one.kind == "at" and one.subject in subjects)
        return next((one.targets for one in at), ())

    def _is_carrier(self, index: int, rider: int) -> bool:
        """Whether people "with" it are on it or in it: a vehicle, or a mount with its rider."""
        noun, said = self._draft.noun(index), self._draft.objects[rider].said or ""
        if is_living(noun):
            return not is_person(noun) and said in _STEERING
        return noun.motion in ("drive", "sail", "fly") or noun.name in BOARDS

    def _ride_along(self, word: Word, things: list[int], scope: Scope) -> bool:
        """As in "a man rides a motorcycle with a woman behind him": she sits on it too."""
        mounts = [one.targets for one in self._draft.relations
                  if one.kind == "ride" and one.subject in things]  # fmt: skip
        is_person_behind = all(is_person(self._draft.noun(index)) for index in scope.subjects)
        if word.text not in _ABOARD or not mounts or not is_person_behind or scope.has_verb:
            return False
        self._draft.relations[:] = [
            one for one in self._draft.relations
            if not (one.kind == "with" and set(one.targets) == set(scope.subjects))
        ]  # fmt: skip
        return self._draft.relate("ride along", scope.subjects, mounts[-1])


_STEERING = frozenset(
    {"rider", "driver", "pilot", "jockey", "biker", "motorcyclist", "cyclist", "captain", "cowboy"}
)
"""Words for who steers what they are on."""
_BESIDES = ("beside", "next to", "near", "by", "behind", "in front of", "under", "around")
_ABOARD = ("behind", "in front of", "beside", "next to")
_PERCHES = SEATS | {"branch", "shelf", "fence", "wall", "rock", "pier", "bridge"}
"""On what one is who watches or waves "from" it."""
_DENIED = ("on", "in", "inside", "on top of", "into", "onto")
_AT_TOP, _TALL_M = ("on top of", "atop", "upon"), 4.0
_LEANT_ON = frozenset({"fence", "wall", "gate", "door", "railing", "car", "tree", "lamp post"})
_GOALS = ("towards", "past")
_JOURNEYS = frozenset({"towards", "through", "past", "from"})
_MOVES_OBJECT = ("into", "onto", "from", "off", "out of")
"""Prepositions that say where what is acted on goes to or comes from."""
_PATHS = frozenset({"past", "through", "towards", "from", "around", "follow", "above"})
_RESTING = frozenset(
    {"on", "under", "beside", "next to", "behind", "in front of", "between", "near", "at", "by",
     "above", "in", "inside", "among", "beneath", "below", "with", "on top of",
     "from behind"}
)  # fmt: skip
"""Prepositions that say where something is, whatever it does there."""
