"""Which words a noun or a verb goes with: where one of them is lost, it may mean something else."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from texvent.scenes.language.grammar.syntax import Clause, NounGroup
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos, VerbForm
from texvent.scenes.language.words.word import Word

_PARTICLES = frozenset(
    {"out", "off", "up", "down", "away", "over", "back", "through", "apart", "along", "past",
     "across", "into", "onto", "out of", "off of", "around", "towards", "toward"}
)  # fmt: skip
"""Words after a verb that can make another one of it: "hangs out", "runs over"."""
_AT_REST = frozenset({"stand", "sit", "lie"})
"""Motions of verbs that mean the same with whatever is around: "stands on a grate"."""

_WHO = frozenset({"woman", "man", "boy", "girl", "male", "female", "child", "adult", "lady", "baby",
                  "kid", "teenager", "mother", "father", "parent"})  # fmt: skip
"""Nouns before a noun that say who that is: "a woman tennis player"."""


def link_companions(clauses: Sequence[Clause]) -> None:
    """Note at nouns and verbs of these clauses which words they go with; the words change.

    * A verb goes with what it is done to: "runs his thumb". The noun is the same with any verb.
    * A verb goes with the particle after it: "hangs out", and so do its pace and its way. What
      rests does so whatever it rests on.
    * A noun goes with the nouns and gerunds before it in its group: "passenger seat". Participles
      and adverbs ("a tiled wall") say how it looks, not what it is.
    * Those nouns go with it: "a piano contest".
    """
    for clause in clauses:
        phrases = [one for phrase in clause.phrases for one in phrase.groups]
        if clause.verb is not None:
            _link_verb(clause, clause.verb)
        for group in _all_groups([*clause.subjects, *clause.objects, *phrases]):
            _add(group, filter(_names_another, group.modifiers))
            _link_to_head(group)
        for group in _all_groups(clause.complements):
            _add(group, filter(_names_another, group.modifiers))
            _link_to_head(group)


def _link_verb(clause: Clause, verb: Word) -> None:
    objects = [word for group in clause.objects for word in group.words if word.pos is Pos.NOUN]
    particles = [word for word in clause.adverbs if word.text in _PARTICLES]
    particles += [one.preposition for one in clause.phrases if one.preposition.text in _PARTICLES]
    value = verb.meaning.value
    is_at_rest = isinstance(value, Verb) and value.kind in _AT_REST and value.base != "hang"
    own = objects if is_at_rest else [*objects, *particles]
    for word in (verb, *clause.adverbs):
        word.companions = (*word.companions, *(one for one in own if one is not word))


def _names_another(word: Word) -> bool:
    """Whether a word before a noun can make it another thing: "store display", "parking meter"."""
    if word.pos is Pos.NOUN:
        return not word.is_name and word.lemma not in _WHO
    return word.pos is Pos.VERB and word.meaning.form is VerbForm.ING


def _add(group: NounGroup, words: Iterable[Word]) -> None:
    if group.head is not None:
        group.head.companions = (*group.head.companions, *words)


def _link_to_head(group: NounGroup) -> None:
    """What is before a noun says what it is like: "piano" of "a piano contest" may be none."""
    head = group.head
    for word in group.modifiers if head is not None else ():
        if head is not None and word.pos is Pos.NOUN:
            word.companions = (*word.companions, head)


def _all_groups(groups: Iterable[NounGroup]) -> Iterator[NounGroup]:
    """Groups with their owners and those of the phrases that belong to them."""
    for group in groups:
        yield group
        if group.owner is not None:
            yield from _all_groups([group.owner])
        for phrase in group.phrases:
            yield from _all_groups(phrase.groups)
