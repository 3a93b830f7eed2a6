"""Adverbs and prepositional phrases of a clause: where, which way, how fast, when."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from texvent.scenes.description import TOGETHER, ObjectMotion, Picture
from texvent.scenes.language.belts import BELT
from texvent.scenes.language.grammar.syntax import NounGroup, PrepPhrase
from texvent.scenes.language.meaning.acts.devices import light_up
from texvent.scenes.language.meaning.acts.hosts import PLACED
from texvent.scenes.language.meaning.adjectives import read_attributes, show_picture
from texvent.scenes.language.meaning.capabilities import is_hand, is_living, is_person
from texvent.scenes.language.meaning.circumstances.company import stand_together
from texvent.scenes.language.meaning.circumstances.courses import (
    goes_so,
    name_course,
    part_ways,
    place_among,
)
from texvent.scenes.language.meaning.circumstances.effects import add_effect
from texvent.scenes.language.meaning.circumstances.fillings import read_of
from texvent.scenes.language.meaning.circumstances.parts import PartReader
from texvent.scenes.language.meaning.circumstances.place_ways import (
    BESIDE,
    go_by_camera,
    go_to,
    is_outside,
    is_somewhere,
    put_on_road,
)
from texvent.scenes.language.meaning.circumstances.put import list_put
from texvent.scenes.language.meaning.circumstances.quantities import QuantityReader
from texvent.scenes.language.meaning.circumstances.relations import RelationReader
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.parts_shown import list_parts_shown
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import OWNERS, Referents
from texvent.scenes.language.meaning.scope import OF_SCENE, Scope
from texvent.scenes.language.meaning.surroundings_reader import SurroundingsReader
from texvent.scenes.language.vocabulary.acts import WEARABLE
from texvent.scenes.language.vocabulary.motion import WEAK_PREPOSITIONS, WINDS
from texvent.scenes.language.vocabulary.objects import CHANGES, LIKENESSES, LIQUIDS
from texvent.scenes.language.vocabulary.scene import LIGHT_PREPOSITIONS, PLACE_PREPOSITIONS, SPELT
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word, link, mark_used
from texvent.scenes.models.effects import EFFECTS

_OF_THINGS = (Role.DIRECTION, Role.PACE, Role.SIDE, Role.STILL)
"""Roles of adverbs that say something of the clause's objects."""
_MOTION_BY_PREPOSITION = {"across": "across", "up": "up", "down": "down"}


class CircumstanceReader:
    """Reads what a clause says besides subject, verb and object."""

    def __init__(
        self, draft: Draft, referents: Referents, surroundings: SurroundingsReader
    ) -> None:
        self._draft = draft
        self._referents = referents
        self._surroundings = surroundings
        self.quantities = QuantityReader(draft, surroundings)
        self._relations = RelationReader(draft, referents)
        self.parts = PartReader(draft, referents)

    def read_adverbs(self, adverbs: Sequence[Word], scope: Scope) -> None:
        """Directions, paces, sides and times."""
        for word in adverbs:
            role = word.role
            if word.is_used:
                continue
            if role is Role.DIRECTION:
                self._read_direction(word, scope)
            elif role is Role.PACE:
                self._read_pace(word, scope)
            elif role is Role.SIDE:
                self._read_side(word, scope)
            elif role is Role.STILL:
                self._read_still(word, scope)
            elif role is Role.FUNCTION and word.meaning.value not in WEAK_PREPOSITIONS:
                word.is_used = True
            elif role in (Role.LIGHT, Role.CLOUDS, Role.PLACE, Role.WEATHER):
                self._surroundings.read(word, is_negated=False)
            if word.is_used and role in _OF_THINGS:
                self._draft.link_motion([word], scope.movers or scope.subjects)

    def _read_direction(self, word: Word, scope: Scope) -> None:
        direction = str(word.meaning.value).strip()
        if direction == "opposite":
            word.is_used = part_ways(self._draft, scope)
            return
        for index in scope.movers:
            motions = self._draft.objects[index].motions
            if not motions or motions[-1].kind in ("stand", "sit", "lie"):
                if direction == "circle":
                    self._draft.objects[index].side, word.is_used = "ring", True
                continue
            if direction != "across" or motions[-1].direction is None:
                motions[-1] = replace(motions[-1], direction=direction)
            word.is_used = True
        if not scope.movers and not scope.has_verb and not scope.is_lost:
            for index in scope.subjects:
                noun = self._draft.noun(index)
                if goes_so(noun.motion, direction) or noun.name == BELT:
                    self._draft.objects[index].motions = [ObjectMotion("move", direction)]
                    word.is_used = True

    def _read_pace(self, word: Word, scope: Scope) -> None:
        for index in scope.movers:
            motions = self._draft.objects[index].motions
            if motions and motions[-1].is_moving:
                pace = motions[-1].pace * word.meaning.value
                motions[-1] = replace(motions[-1], pace=pace)
                word.is_used = True

    def _read_side(self, word: Word, scope: Scope) -> None:
        if word.meaning.value == TOGETHER and stand_together(self._draft, word, scope.subjects):
            return
        for index in scope.subjects:
            self._draft.objects[index].side = word.meaning.value
            word.is_used = True

    def _read_still(self, word: Word, scope: Scope) -> None:
        for index in scope.subjects:
            motions = self._draft.objects[index].motions
            if not motions:
                motions.append(ObjectMotion("stand"))
            word.is_used = word.is_used or not motions[-1].is_moving or (
                motions[-1].kind in ("sit", "lie")
            )  # fmt: skip

    def read_phrases(self, phrases: Sequence[PrepPhrase], scope: Scope) -> None:
        """All prepositional phrases of a clause or a noun group."""
        for phrase in phrases:
            self.read_phrase(phrase, scope)

    def read_phrase(self, phrase: PrepPhrase, scope: Scope) -> None:
        """One prepositional phrase, and what hangs on its nouns."""
        name = phrase.preposition.text
        if self._is_likeness(phrase, scope):
            return
        if phrase.negation is not None:
            for group in phrase.groups:
                group.negation = phrase.negation
        near = self._referents.recall(phrase.near)
        self._referents.near = near.things if near is not None and near.is_things else []
        found = [self._referents.resolve(group, name, scope.subjects) for group in phrase.groups]
        self._referents.near = []
        things = [index for one in found if one.is_things for index in one.things]
        if things:
            self._relations.read(phrase, things, scope)
            self.place_among(phrase.preposition, things)
        for one in found:
            if not one.is_things:
                self._read_other(phrase, one, scope)
            if one.kind == "part" and scope.subjects and not phrase.preposition.is_used:
                # As in "sits on the roof of a car": where on it is not shown.
                phrase.preposition.is_lost = True
            put = list_put(self._draft, phrase, found, scope) if one is found[-1] else ()
            self.read_group_phrases(one, scope, put)

    def place_among(self, word: Word, things: Sequence[int]) -> None:
        """What a preposition claims besides relations: "lined with trees", "inside the clouds"."""
        place_among(self._draft, word, things)

    def _is_likeness(self, phrase: PrepPhrase, scope: Scope) -> bool:
        """As in "shaped like a dragon", "curls into a ball": nothing of the sort is there."""
        name = phrase.preposition.text
        is_change = name == "into" and not scope.is_verb_shown and scope.verb in CHANGES
        heads = [group.head for group in phrase.groups if group.head is not None]
        is_thing = all(head.read_as(Role.PLACE) is None for head in heads)
        return name == "like" or (is_change and is_thing)

    def read_group_phrases(
        self, referent: Referent, scope: Scope, listed: Sequence[int] = ()
    ) -> None:
        """What hangs on a noun: "a table near a window".

        Args:
            referent: the noun.
            scope: what the clause is about.
            listed: all objects of a list that ends with the noun: "a cup and a bottle on a table".
        """
        group = referent.group
        if group.owner is not None:
            self._read_owner(group.owner, referent)
        self.read_adverbs(group.sides, Scope(referent.things, []))
        if referent.is_things:
            inner = Scope(list(listed or referent.things), [], has_verb=False)
        elif referent.kind in ("unknown", "part"):
            inner = Scope([], [], is_lost=True)  # "with his arm around a woman"
        else:
            inner = scope
        for phrase in group.phrases:
            if phrase.preposition.text == "of":
                self._read_of(phrase, referent, scope)
            elif referent.kind == "part" and phrase.preposition.text in PLACED:
                self.read_phrase(phrase, scope)  # "a car with black wheels next to a house"
            else:
                self.read_phrase(phrase, inner)

    def _read_owner(self, owner: NounGroup, owned: Referent) -> None:
        """As in "a tourist's backpack"; "its mother's tail" shows no mother."""
        if not owned.is_things:
            return
        item = self._draft.noun(owned.things[0])
        if is_hand(item):
            mark_used(owner.words)
            return
        if is_living(item):
            return
        head = owner.head
        if item.name not in WEARABLE and head is not None and not self._is_known(owner, head):
            return
        found = self._referents.resolve(owner)
        if not found.is_things:
            return
        if item.name in WEARABLE:
            self._draft.relate("wear", found.things, owned.things)
        else:
            self._draft.relate("with", owned.things, found.things)

    def _is_known(self, owner: NounGroup, head: Word) -> bool:
        """Whether the owner is there: "the farmer's barn", "the red team's goal" show no people."""
        noun = head.read_as(Role.NOUN)
        if noun is None:
            return True
        is_there = self._draft.find(str(noun.value), None) is not None
        return is_there and not read_attributes(owner.modifiers).is_new

    def _read_of(self, phrase: PrepPhrase, whole: Referent, scope: Scope) -> None:
        """As in "A bowl of soup", "a set of buckets", "the side of the road".

        What "the window of a train" belongs to is not in it, and its place is not shown.
        """
        head = whole.group.head
        is_likeness = head is not None and head.lemma in LIKENESSES
        names_picture = any(
            group.head is not None and group.head.role is Role.PICTURE for group in phrase.groups
        )
        if is_likeness and not names_picture:
            phrase.preposition.is_lost = True
            return
        phrase.preposition.is_used = True
        for group in phrase.groups:
            if whole.is_things and group.head is not None and group.head.lemma in LIQUIDS:
                attributes = read_attributes(group.modifiers)
                self._referents.add_effect(attributes, whole.things)
                return
        found = [self._referents.resolve(group, "of") for group in phrase.groups]
        for one in found:
            if one.is_things and whole.is_things:
                read_of(self._draft, phrase.preposition, whole, one)
            elif one.kind == "picture":
                self.show_on(one, whole.things)
            elif not one.is_things:
                self._read_other(phrase, one, scope)
            self.read_group_phrases(one, scope)
        parts = [index for one in found if one.is_things for index in one.things]
        if whole.kind == "part" and list_parts_shown(self._draft, parts, str(whole.value)):
            self.parts.use(whole, parts)

    def _read_other(self, phrase: PrepPhrase, one: Referent, scope: Scope) -> None:
        """What is no object of the scene."""
        word = phrase.preposition
        if self.parts.read(phrase, one, scope):
            return
        if one.kind == "absent":
            word.is_used = True
        elif one.kind == "unit":
            word.is_used = self.quantities.read(one, scope, preposition=word.text)
        elif one.kind == "picture":
            word.is_used = self.show_on(one, scope.subjects)
        elif one.kind == "effect":
            near = self._referents.recall(phrase.near)
            word.is_used = self.add_effect(one, scope, near.things if near is not None else ())
        elif one.kind == "part":
            self.parts.read_part(word, one, scope)
        elif one.kind == "unknown":
            self._read_wind(word, one, scope)
            self._read_worn_colour(phrase, one, scope)
        elif one.kind in ("camera", "function"):
            self._read_camera_or_style(word, one, scope)
        elif one.kind != "things":
            self._read_surroundings(word, one, scope, is_negated=phrase.negation is not None)

    def _read_camera_or_style(self, word: Word, one: Referent, scope: Scope) -> None:
        if one.kind == "camera":
            go_by_camera(self._draft, word, one, scope)
        else:
            self.read_style(one)
            word.is_used = True

    def _read_surroundings(
        self, word: Word, one: Referent, scope: Scope, *, is_negated: bool
    ) -> None:
        if one.kind == "glow" and word.text == "with" and scope.subjects:
            word.is_used = light_up(self._draft, one, scope.subjects)
            return
        names = PLACE_PREPOSITIONS if one.kind == "place" else LIGHT_PREPOSITIONS
        if word.text not in names and one.kind in ("place", "light"):
            return
        if one.kind == "place" and scope.subjects and word.text in BESIDE:
            self._surroundings.stand_before(str(one.value))
        is_read = self._surroundings.read_referent(one, is_negated=is_negated)
        is_covered = word.text.startswith("covered") and one.kind != "weather"
        is_unread = word.text == "facing" or (is_covered and bool(scope.subjects))
        is_unread |= is_somewhere(one) and is_read and not go_to(self._draft, word, one, scope)
        is_unread |= bool(scope.subjects) and is_outside(word, one)
        word.is_used, word.is_lost = is_read and not is_unread, is_unread
        name_course(self._draft, word, one, scope)
        put_on_road(self._draft, word, one, scope)
        direction = _MOTION_BY_PREPOSITION.get(word.text)
        for index in scope.movers if is_read and direction == "across" else ():
            motions = self._draft.objects[index].motions
            if motions and motions[-1].direction is None and motions[-1].is_moving:
                motions[-1] = replace(motions[-1], direction="across")

    def _read_wind(self, word: Word, one: Referent, scope: Scope) -> None:
        """As in "a flag waves in the wind": shown where what is said moves so."""
        is_wind = one.group.head is not None and one.group.head.text in WINDS
        for index in scope.subjects if is_wind else ():
            item, noun = self._draft.objects[index], self._draft.noun(index)
            kinds = {motion.kind for motion in item.motions}
            is_blown = noun.name == "kite" and kinds <= {"fly", "hover", "float"}
            if kinds & {"work", "sway"} or (noun.is_working and not kinds) or is_blown:
                mark_used([word, *one.group.words[-1:]])

    def _read_worn_colour(self, phrase: PrepPhrase, one: Referent, scope: Scope) -> None:
        """As in "A defender in white": the colour of the clothes."""
        word = phrase.preposition
        if word.text != "in" or one.group.head is not None or not one.attributes.colours:
            return
        near = self._referents.recall(phrase.near)
        for index in near.things if near is not None and near.is_things else scope.subjects:
            if is_person(self._draft.noun(index)):
                one.attributes.colour(self._draft.objects[index])
                link(one.group.modifiers, [index])
                word.is_used = True

    def read_style(self, one: Referent) -> None:
        """As in "In slow motion"."""
        pace = one.attributes.pace
        if one.group.head is not None and one.group.head.text == "motion" and pace is not None:
            self._draft.tempo, pace[1].is_used = 0.3, True

    def show_on(self, one: Referent, things: Sequence[int]) -> bool:
        """Put a picture on the first of the objects that has a face for it."""
        picture = one.value
        if not isinstance(picture, Picture):
            return False
        for index in things:
            if show_picture(self._draft.objects[index], picture):
                mark_used(
                    word
                    for word in one.group.words
                    if word is one.group.head or word.pos is not Pos.NOUN or word.text in SPELT
                )
                return True
        return False

    def add_effect(self, one: Referent, scope: Scope, near: Sequence[int] = ()) -> bool:
        """Smoke, sparks ... that the clause's subjects have; "storm" brings rain."""
        if EFFECTS[str(one.value)].is_around and "storm" in one.group.text:
            self._surroundings.read_weather("rain")
        return add_effect(self._draft, one, scope, near)

    def flash_own(self, one: Referent, word: Word) -> bool:
        """As in "a fire truck leaves with its lights flashing"."""
        determiner = one.group.determiner
        is_owned = determiner is not None and determiner.text in OWNERS
        if one.kind != "glow" or not is_owned or not self._draft.subjects:
            return False
        one.attributes.flicker = word
        return light_up(self._draft, one, self._draft.subjects)

    def read_extra(self, one: Referent) -> None:
        """What else is named: a place, or what hangs on an object."""
        if one.kind in OF_SCENE:
            self._surroundings.read_referent(one, is_negated=False)
        self.read_group_phrases(one, Scope(one.things, []))

    def person(self) -> int | None:
        """A person whom the prompt only implies: "juggling three oranges"."""
        for index in range(len(self._draft.objects)):
            if is_person(self._draft.noun(index)):
                return index
        return None
