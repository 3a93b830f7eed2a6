"""What a word for a person says that the person does: a swimmer swims."""

from __future__ import annotations

from functools import lru_cache

from texvent.scenes.language.vocabulary.motion import VERBS
from texvent.scenes.language.words.english import Pos, list_readings
from texvent.scenes.models.people.activities import ACTIVITIES

_ENDINGS = ("er", "or")


@lru_cache(maxsize=512)
def find_doing(said: str) -> str | None:
    """The motion or activity of a person of that name; None if the name says none.

    Example:
        >>> find_doing("swimmer"), find_doing("surfer"), find_doing("waiter"), find_doing("worker")
        ('swim', 'surf', None, None)
    """
    if not said.endswith(_ENDINGS):
        return None
    stem = said[:-2]
    for base in (stem, f"{stem}e", stem[:-1] if stem[-1:] == stem[-2:-1] else stem):
        if all(one.pos is not Pos.VERB or one.lemma != base for one in list_readings(base)):
            continue
        if base in ACTIVITIES:
            return base
        for name, activity in ACTIVITIES.items():
            if base in activity.words:
                return name
        for verb in VERBS:
            if verb.base == base and verb.kind in ("walk", "run", "dance", "jump"):
                return verb.kind
    return None
