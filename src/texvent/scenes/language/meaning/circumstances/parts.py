"""Parts of things and bodies: "black wheels"; places at which things are: "on her head"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from texvent.scenes.description import Relation
from texvent.scenes.language.grammar.syntax import PrepPhrase
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.parts_shown import list_parts_shown
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import OWNERS, Referents
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.vocabulary.scene import PART_COLOURS
from texvent.scenes.language.words.word import Word, link, mark_used

_PLACES: Mapping[tuple[str, str], str] = MappingProxyType(
    {
        ("on", "head"): "on head", ("on", "shoulder"): "on shoulder", ("on", "back"): "on back",
        ("on", "lap"): "on lap", ("in", "lap"): "on lap", ("over", "shoulder"): "on shoulder",
        **{(word, part): "hold" for word, part in (
            ("in", "hand"), ("in", "mouth"), ("in", "beak"), ("in", "arm"), ("in", "paw"),
            ("in", "fist"))},
    }
)  # fmt: skip
"""Preposition and part of a body → kind of the relation of who has the thing there."""
_ON_PARTS = frozenset({"on", "over", "under", "above", "behind", "in front of", "around"})
"""Prepositions that say where something is: "a board on his head" is carried in the hands."""
_LIMBS = ("hand", "arm")
_HAVING = frozenset({"hold", "carry", "with", "wear"})
_OF_ANIMALS = ("mouth", "beak", "paw")
_OF_ANIMAL = frozenset({"on back", "on head"})


class PartReader:
    """Reads parts of what is there, and where on a body something is."""

    def __init__(self, draft: Draft, referents: Referents) -> None:
        self._draft = draft
        self._referents = referents

    def read(self, phrase: PrepPhrase, one: Referent, scope: Scope) -> bool:
        """Relate a thing to the body whose part the phrase names; False if it names none."""
        head = one.group.head
        kind = _PLACES.get((phrase.preposition.text, head.lemma)) if head is not None else None
        if head is None or kind is None or not (scope.acted_on or scope.subjects):
            return False
        near = self._referents.recall(phrase.near)
        items = list(scope.acted_on or scope.subjects)
        if near is not None and near.is_things and self._find(near.things) is not None:
            items = near.things  # "sits on a sofa with a cat on her lap"
        relation = self._find(items)
        owner = relation.subject if relation is not None else self._owner(one, items)
        if owner is None or not self._fits(kind, head.lemma, owner):
            return False
        kept = relation is not None and relation.kind == "wear"
        if relation is not None and not kept:
            self._draft.relations.remove(relation)
        if not is_person(self._draft.noun(owner)) and kind in _OF_ANIMAL:
            self._draft.relate("on", items, [owner])
        elif not kept:
            self._draft.relate(kind, [owner], items)
        made = tuple(self._draft.relations[-1:])
        # What is held is in the right hand, or in both.
        mark_used([phrase.preposition, *(w for w in one.group.words if w.text != "left")])
        link(one.group.words, [owner])
        for word in (phrase.preposition, head):
            word.relations = made
            word.is_lost = False
        return True

    def _find(self, items: list[int]) -> Relation | None:
        """How a person has the things, as the prompt has said."""
        for relation in reversed(self._draft.relations):
            if relation.kind in _HAVING and set(relation.targets) == set(items):
                return relation
        return None

    def _owner(self, one: Referent, items: list[int]) -> int | None:
        """Whose part it is: "a man's shoulder", "her lap" of the only person."""
        if one.group.owner is not None:
            found = self._referents.resolve(one.group.owner)
            return found.things[0] if found.is_things and found.things else None
        determiner = one.group.determiner
        if determiner is None or determiner.text not in OWNERS:
            return None
        bodies = [
            index
            for index in range(len(self._draft.objects))
            if index not in items and is_living(self._draft.noun(index))
        ]
        return bodies[0] if len(bodies) == 1 else None

    def _fits(self, kind: str, part: str, owner: int) -> bool:
        noun = self._draft.noun(owner)
        if is_person(noun):
            return True
        return is_living(noun) and (part in _OF_ANIMALS or kind in _OF_ANIMAL)

    def find_whose(self, one: Referent) -> list[int]:
        """As in "water sprays from its paws": the dog that was spoken of."""
        determiner = one.group.determiner
        is_owned = determiner is not None and determiner.text in OWNERS
        return list(self._draft.subjects) if is_owned and one.kind in ("part", "unknown") else []

    def read_own(self, one: Referent, things: Sequence[int]) -> None:
        """As in "wiggles its tail", not "walk hand in hand": shown where the model has one."""
        if one.value in _LIMBS and one.group.determiner is None and one.group.owner is None:
            return
        if list_parts_shown(self._draft, things, str(one.value)):
            self.use(one, things)

    def read_part(self, word: Word, one: Referent, scope: Scope) -> None:
        """As in "a car with black wheels": shown where the model has them."""
        determiner = one.group.determiner
        is_owned = determiner is not None and determiner.text in OWNERS
        things = self._draft.subjects if is_owned and not scope.subjects else scope.subjects
        wearers = [
            one.subject
            for one in self._draft.relations
            if one.kind == "wear" and set(one.targets) & set(things)
        ]
        if is_owned and wearers and word.text == "on":
            # As in "a hat on his head".
            word.is_used = list_parts_shown(self._draft, wearers, str(one.value))
            self.use(one, wearers if word.is_used else [])
        elif list_parts_shown(self._draft, things, str(one.value)):
            is_place = word.text in _ON_PARTS or (word.text == "in" and one.value in _LIMBS)
            is_place = is_place and not word.is_used
            word.is_used, word.is_lost = not is_place, is_place
            if not is_place:
                self.use(one, things)

    def use(self, one: Referent, things: Sequence[int]) -> None:
        """The part is shown; its colour too, if it is the usual one."""
        link(one.group.words, things)
        if one.group.head is not None:
            one.group.head.is_used = True
        for colour, words in one.attributes.colours:
            names = {
                PART_COLOURS.get((self._draft.objects[i].noun, str(one.value))) for i in things
            }
            if names == {colour.name} or (names == {"black"} and colour.name == "white"):
                mark_used(words)
