"""What animals are said to do in several words, put right before the clauses are read.

As in "bends down to drink from a river", "takes a peaceful walk", "runs to join a herd of its
kind": one act, that its model shows.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.animals.bodies import (
    build_nest,
    drop_role,
    give_to_wearers,
    go_to_herd,
    lie,
    look_up,
    mean_parents,
    rear_up,
    sit_on_swing,
    spray,
    take_act,
)
from texvent.scenes.language.meaning.animals.mouths import (
    bend_down,
    chew,
    clean,
    drink_water,
    eat_leaves,
    stick_out,
    use_own_parts,
)
from texvent.scenes.language.meaning.animals.words import find_animal
from texvent.scenes.models.protocol import Noun


def read_animal_acts(clauses: Sequence[Clause], nouns: Mapping[str, Noun]) -> None:
    """Give verbs of animals the acts that their models have.

    Args:
        clauses: of the prompt; they change.
        nouns: the objects that can be shown, by name.
    """
    give_to_wearers(clauses)
    mean_parents(clauses, nouns)
    for at, clause in enumerate(clauses):
        if clause.verb is None or clause.negation is not None or clause.is_passive:
            continue
        if take_act(clause) or sit_on_swing(clause):
            continue
        animals = [find_animal(group, nouns) for group in clause.subjects]
        if not animals or any(one is None for one in animals):
            continue
        following = clauses[at + 1] if at + 1 < len(clauses) else None
        if go_to_herd(clause, str(animals[0])):
            continue
        _read_one(clause, following)
        use_own_parts(clause)


def _read_one(clause: Clause, following: Clause | None) -> None:
    """The first of the acts that the clause says."""
    for read in (bend_down, spray, stick_out, chew, drop_role):
        if read(clause, following):
            return
    for takes in (build_nest, eat_leaves, lie, clean, look_up, rear_up, drink_water):
        if takes(clause):
            return
