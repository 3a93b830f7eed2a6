"""Whose things are: "her basket" is seen as hers only where she holds, wears or rides it."""

from __future__ import annotations

from collections.abc import Iterable

from texvent.scenes.language.meaning.capabilities import is_living
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.referents.referent import Referent
from texvent.scenes.language.meaning.referents.resolver import OUR, OWNERS


def lose_owners(draft: Draft, named: Iterable[Referent]) -> None:
    """Report "her" before a thing that nothing ties to anyone.

    Args:
        draft: the scene, read to its end.
        named: what the noun groups of the prompt mean.
    """
    tied = {index for one in draft.relations for index in (one.subject, *one.targets)
            if one.kind in _TIES and _ties(draft, one.subject, one.targets)}  # fmt: skip
    for one in named:
        owner = one.group.determiner
        if owner is None or owner.text not in (*OWNERS, *OUR) or not one.is_things:
            continue
        if all(not is_living(draft.noun(index)) and index not in tied for index in one.things):
            owner.is_used, owner.is_lost = False, True


_TIES = frozenset(
    {"hold", "carry", "wear", "ride", "push", "pull", "with", "work on", "kick", "hit", "throw",
     "catch", "in", "on"}
)  # fmt: skip
"""Relations that show whose a thing is."""


def _ties(draft: Draft, subject: int, targets: Iterable[int]) -> bool:
    return any(is_living(draft.noun(index)) for index in (subject, *targets))
