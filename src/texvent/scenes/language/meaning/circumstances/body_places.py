"""Places on a body at which things are: "on her head", "in its mouth", "on a man's shoulder"."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from texvent.scenes.description import Relation
from texvent.scenes.language.grammar.syntax import PrepPhrase
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents import OWNERS, Referent, Referents
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.language.words.word import link, mark_used

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
_HAVING = frozenset({"hold", "carry", "with", "wear"})
_OF_ANIMALS = ("mouth", "beak", "paw")
_OF_ANIMAL = frozenset({"on back", "on head"})


class BodyPlaceReader:
    """Says where somebody has what the prompt gives them."""

    def __init__(self, draft: Draft, referents: Referents) -> None:
        self._draft = draft
        self._referents = referents

    def read(self, phrase: PrepPhrase, one: Referent, scope: Scope) -> bool:
        """Relate a thing to the body whose part the phrase names; False if it names none."""
        head = one.group.head
        kind = _PLACES.get((phrase.preposition.text, head.lemma)) if head is not None else None
        if head is None or kind is None or not (scope.acted_on or scope.subjects):
            return False
        items = list(scope.acted_on or scope.subjects)
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
        mark_used([phrase.preposition, *one.group.words])
        link(one.group.words, [owner])
        for word in (phrase.preposition, head):
            word.relations = made
            word.is_lost = False
        return True

    def _find(self, items: list[int]) -> Relation | None:
        """How somebody has the things, as the prompt has said."""
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
