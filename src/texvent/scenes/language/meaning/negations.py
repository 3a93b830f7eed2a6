"""What a negated verb says of the things that go with it."""

from __future__ import annotations

from texvent.scenes.language.grammar.syntax import Clause

_HAVING = frozenset({"wear", "hold", "carry", "have"})


def deny(clause: Clause) -> None:
    """As in "does not sit on the chair", which is there; "isn't wearing a hat": there is none."""
    if clause.negation is None or clause.verb is None:
        return
    for phrase in clause.phrases:
        phrase.denial = phrase.denial or clause.negation
    if clause.verb.lemma in _HAVING and clause.objects:
        clause.verb.is_used = clause.verb.is_absent = True
        for group in clause.objects:
            group.negation = clause.negation
