"""What pronouns mean: subjects before them, or what was named last."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.grammar.syntax import NounGroup
from texvent.scenes.language.meaning.capabilities import is_living, is_person, is_upright
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.words.english import Pos
from texvent.scenes.models.protocol import Noun

_NEVER = {
    **dict.fromkeys(("him", "he", "his"), ("woman", "girl")),
    **dict.fromkeys(("her", "she", "hers"), ("man",)),
}
"""Pronoun → people whom it does not mean."""
_PERSONAL = ("er", "or", "ist", "man", "woman", "ian", "eur", "ess", "eer", "boy", "girl", "dj")
"""Endings of nouns that name people, as a rule."""
OF_ONE_PERSON = ("he", "she", "him", "her")


class Antecedents:
    """What was named before a pronoun."""

    def __init__(self, draft: Draft) -> None:
        self._draft = draft
        self._named: list[int] = []
        """Objects in the order in which they were named."""
        self.doers: list[int] = []
        """Subjects of the clause, whom no pronoun after the verb means."""
        self.acted_on: list[int] = []
        """What the verb before acts on, which "it" after another verb means."""
        self.lost_object = self._next_is_lost = False
        """Whether what the last verb acts on is not shown: then "it" is not either."""
        self._last_subject: NounGroup | None = None
        self.place: Referent | None = None
        """The place that the clause is about: "a kitchen with a sink in it"."""
        self.near: list[int] = []
        """What a pronoun of a phrase hangs on: "a baby in it" is not in itself."""
        self.lost_person = False
        """Whether the last subject was a person who is not known, as it seems: "a kayaker"."""

    def note_subjects(self, subjects: Sequence[Referent]) -> None:
        """Keep in mind whom "he" may mean."""
        named = [one.group for one in subjects if one.group.head and one.group.head.pos is Pos.NOUN]
        if named and named[0] is not self._last_subject:
            self._last_subject, self._next_is_lost = named[0], False
        self.lost_object = self._next_is_lost
        is_place = bool(subjects) and subjects[0].kind == "place"
        self.place = subjects[0] if is_place else None
        for one in subjects:
            head = one.group.head
            if one.is_things and any(is_living(self._draft.noun(i)) for i in one.things):
                self.lost_person = False
            elif one.kind == "unknown" and head is not None and head.pos is Pos.NOUN:
                self.lost_person = head.lemma.endswith(_PERSONAL) or self.lost_person

    def note_objects(self, objects: Sequence[Referent]) -> None:
        """Keep in mind what "it" after another verb may mean."""
        self.acted_on = [index for one in objects if one.is_things for index in one.things]
        named = [one for one in objects if one.group.head and one.group.head.pos is Pos.NOUN]
        if named:
            self._next_is_lost = all(
                one.kind in ("unknown", "part") and not one.group.phrases for one in named
            )

    def look_back(self, pronoun: str) -> list[int]:
        """What a pronoun means: the subject before, or else what was named last, if it fits."""
        # Within the first clause it is the first thing: "a house with a tree behind it".
        first = self._draft.subjects or self._named[:1]
        others = [self.acted_on] if self.acted_on and self.doers else []
        named = [[one] for one in reversed(self._named)]
        candidates = [first, *others, *named] if first else []
        if self.lost_object and self.doers and pronoun in ("it", "them"):
            return []
        if pronoun.endswith(("self", "selves")):
            return list(self._draft.subjects)
        not_meant = self.near or self.doers
        for things in candidates:
            if things != not_meant and self._fits(pronoun, things):
                return list(things)
        if first and pronoun in (*OF_ONE_PERSON, "it"):
            is_alive = is_living(self._draft.noun(first[0]))
            is_meant = is_alive if pronoun != "it" else _is_it(self._draft.noun(first[0]))
            return list(first) if is_meant and not self.lost_person else []
        return list(first)

    def _fits(self, pronoun: str, things: Sequence[int]) -> bool:
        is_plural = len(things) > 1 or self._draft.objects[things[0]].count > 1
        if pronoun in OF_ONE_PERSON:
            noun = self._draft.noun(things[0])
            if self.lost_person and not is_person(noun):
                return False
            is_other = noun.name in _NEVER.get(pronoun, ())
            return not is_plural and is_living(noun) and not is_other
        if pronoun == "it":
            return not is_plural and _is_it(self._draft.noun(things[0]))
        return is_plural


def _is_it(noun: Noun) -> bool:
    """Whether "it" may mean it: no person, but an animal in a person's shape."""
    return not is_person(noun) or is_upright(noun)
