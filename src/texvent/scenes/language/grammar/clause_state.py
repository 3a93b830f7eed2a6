"""Where the reader of clauses is, and the clauses it has read."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.grammar.syntax import Clause, NounGroup, PrepPhrase
from texvent.scenes.language.words.word import Word


class ClauseState:
    """The clause being read, those before it and those left open."""

    def __init__(self, words: Sequence[Word]) -> None:
        self._words = words
        self._at = 0
        self._clauses: list[Clause] = []
        self._clause = Clause()
        self._outer: list[Clause] = []
        """Clauses that were left open by a relative or a participle."""
        self._last: NounGroup | None = None
        """The noun group read last."""
        self._is_joined: str = ""
        """As in "and" or "," if that came directly before."""
        self._phrase: PrepPhrase | None = None
        """The prepositional phrase that "and" may extend."""
        self._anchor: NounGroup | None = None
        """The noun group that prepositions other than "of" belong to."""
        self._negation: Word | None = None
        self._next_order = "same"
        self._sentence = 0
        """Number of clauses before the sentence."""

    def _close(self) -> None:
        self._clauses.append(self._clause)
        self._clause = Clause(order=self._next_order, sentence=self._clause.sentence)
        self._next_order = "same"
        self._phrase = None

    def _take_negation(self) -> Word | None:
        negation, self._negation = self._negation, None
        return negation

    def _continue_with_same_subjects(self, order: str) -> None:
        subjects = list(self._clause.subjects)
        self._close()
        self._clause.subjects, self._clause.order = subjects, order

    def _pop_outer(self) -> Clause | None:
        """The clause that a finite verb after a relative or participle belongs to."""
        while self._outer:
            outer = self._outer.pop()
            if outer.subjects and (outer.verb is None or outer.is_participle):
                return outer
        return None

    def _find_finite(self) -> Clause | None:
        """The clause that "and" after a participle clause goes on with."""
        outer = self._pop_outer()
        if outer is not None:
            return outer
        for clause in reversed(self._clauses[self._sentence :]):
            if clause.verb is not None and not clause.is_participle and not clause.is_relative:
                return clause
        return None

    def _skip(self, word: Word) -> None:
        word.is_used = True
        self._at += 1
