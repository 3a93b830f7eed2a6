"""Who has what: the one named right before "with"; and who puts down what lies elsewhere."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from texvent.scenes.description import Relation
from texvent.scenes.language.meaning.capabilities import is_living, is_person
from texvent.scenes.language.meaning.draft import Draft
from texvent.scenes.language.meaning.scope import Scope
from texvent.scenes.models.objects.receptacles import LIFTED_LADEN


def has_nearest(draft: Draft, near: Sequence[int], things: Sequence[int], scope: Scope) -> bool:
    """As in "two boys around a boy with a bat": he has it, not they.

    Args:
        draft: the objects.
        near: who is named right before "with".
        things: what follows it.
        scope: what the clause is about.
    """
    are_people = bool(near) and all(is_person(draft.noun(index)) for index in near)
    is_alive = any(is_living(draft.noun(index)) for index in things)
    is_goal = any(
        one.subject in scope.subjects and set(near) <= set(one.targets) for one in draft.relations
    )
    return are_people and is_goal and not is_alive


def put_down(
    draft: Draft, near: Collection[int], things: Sequence[int], loosely: Collection[Relation]
) -> None:
    """As in "a man with a laptop on a table", who does not hold it; what is on a plate, is held so.

    Args:
        draft: the objects.
        near: what is on or in the things.
        things: what it is on or in.
        loosely: relations of who is said to be "with" something, not to hold it.
    """
    is_dish = draft.noun(things[0]).name in LIFTED_LADEN
    for number, relation in reversed([*enumerate(draft.relations)]):
        if relation not in loosely or not set(relation.targets) <= set(near):
            continue
        del draft.relations[number]
        if is_dish:
            draft.relate("hold", [relation.subject], things)
