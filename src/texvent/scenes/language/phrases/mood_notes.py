"""A note of the words of mood in a prompt: they are read, and change nothing."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.scenes.language.phrases.moods import MANNERS, MOODS
from texvent.scenes.language.words.lexicon import Role
from texvent.scenes.language.words.word import Word


def note_moods(words: Sequence[Word]) -> list[str]:
    """A note that names the words of mood and manner, if there are any; they count as read."""
    said: dict[str, None] = {}
    for word in words:
        if word.role is Role.FUNCTION and word.text in MOODS | MANNERS:
            word.is_used = True
            said[word.text] = None
    return [f"words of mood change nothing here: {', '.join(said)}"] if said else []
