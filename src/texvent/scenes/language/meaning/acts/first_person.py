"""Who says "I" and does more than look and go is a person of the scene, not the camera."""

from __future__ import annotations

from texvent.scenes.language.grammar.syntax import Clause
from texvent.scenes.language.meaning.acts.activities import find_activity
from texvent.scenes.language.vocabulary.film import TRAVEL_MEANS
from texvent.scenes.language.vocabulary.verbs import Verb
from texvent.scenes.language.words.english import Pos
from texvent.scenes.language.words.lexicon import Meaning, Role

_SPEAKERS = {"i": None, "we": 2}
"""Pronoun → how many people, None for one."""
_OF_VIEWERS = frozenset({"see", "look", "watch", "stand", "sit", "turn", "stop", "enter", "leave"})
"""Verbs of who films all the same: "we enter a cave"."""
_OF_BODIES = frozenset({"dance", "jump", "lie", "wave"})
"""Motions that no camera makes."""


def show_speaker(clause: Clause, *, is_first_person: bool) -> None:
    """As in "I play the guitar": a person does.

    Args:
        clause: the clause; its subject becomes a noun.
        is_first_person: whether the prompt asks for the view of who does it.
    """
    word = clause.verb
    if word is None or is_first_person or word.lemma in _OF_VIEWERS or word.lemma in TRAVEL_MEANS:
        return
    value = word.meaning.value
    is_done = isinstance(value, Verb) and (bool(clause.objects) or value.kind in _OF_BODIES)
    is_act = is_done or find_activity(clause, is_hand=False) is not None
    for group in clause.subjects if is_act else ():
        head = group.head
        if head is not None and head.text in _SPEAKERS:
            count = _SPEAKERS[head.text]
            head.meaning = Meaning(
                Role.NOUN, Pos.NOUN, "person", is_plural=count is not None, is_substitute=True,
                count=count,
            )  # fmt: skip
