"""Which words a noun goes with: where one of them is lost, the noun may mean something else."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.words.word import Word


def link_companions(clauses: Sequence[Clause]) -> None:
    """Note at every noun of these clauses which words it goes with; the words change.

    * What a verb is done to goes with the verb: "swats at a fly".
    * A noun goes with the words before it in its group: "passenger seat".
    """
    for clause in clauses:
        done_to = list(clause.objects)
        for phrase in clause.phrases:
            done_to.extend(phrase.groups)
        verb = [clause.verb] if clause.verb is not None else []
        for group in done_to:
            _add(group, verb)
        for group in _all_groups([*clause.subjects, *done_to, *clause.complements]):
            _add(group, group.modifiers)


def _add(group: NounGroup, words: Sequence[Word]) -> None:
    if group.head is not None:
        group.head.companions = (*group.head.companions, *words)


def _all_groups(groups: Iterable[NounGroup]) -> Iterator[NounGroup]:
    """Groups with their owners and those of the phrases that belong to them."""
    for group in groups:
        yield group
        if group.owner is not None:
            yield from _all_groups([group.owner])
        for phrase in group.phrases:
            yield from _all_groups(phrase.groups)
