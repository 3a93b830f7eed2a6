"""Words compared by their stems: "drives", "driving" and "drive" are one."""

from __future__ import annotations

import re
from collections.abc import Iterable

from texvent.scenes.language.words.english import list_readings

_DERIVED = ("i", "ic", "er")
"""Endings of stems: "dusty", "metallic", "dancer"."""

_IRREGULAR = {
    "people": "person", "men": "man", "women": "woman", "children": "child", "mice": "mouse",
    "geese": "goose", "feet": "foot", "leaves": "leaf", "wolves": "wolf", "knives": "knife",
    "ran": "run", "flew": "fly", "fell": "fall", "rose": "rise", "held": "hold", "sat": "sit",
    "stood": "stand", "swam": "swim", "rode": "ride", "threw": "throw", "caught": "catch",
    "drove": "drive", "spun": "spin", "swung": "swing", "wore": "wear", "worn": "wear",
}  # fmt: skip
_EMPTY = frozenset({
    "a", "an", "the", "of", "to", "and", "or", "at", "with", "from", "its", "his", "her", "their",
    "it", "them", "is", "are", "be", "being", "very", "in", "on", "by", "then", "while", "as",
    "into", "onto", "my", "our", "ours",
})  # fmt: skip


def stem(word: str) -> str:
    """A word without its inflection, only good for comparing.

    Example:
        >>> [stem(word) for word in ("drives", "driving", "drive", "stopped", "stop", "flies")]
        ['driv', 'driv', 'driv', 'stop', 'stop', 'fli']
        >>> stem("fly"), stem("buses"), stem("bus"), stem("grass")
        ('fli', 'bus', 'bus', 'gras')
    """
    word = word.lower()
    word = _IRREGULAR.get(word, word)
    for suffix in ("ing", "ed", "es", "s"):
        if word.endswith(suffix) and len(word) - len(suffix) >= 3:
            word = word[: -len(suffix)]
            break
    if word.endswith("e") and len(word) > 3:
        word = word[:-1]
    if len(word) > 3 and word[-1] == word[-2]:
        word = word[:-1]
    return f"{word[:-1]}i" if word.endswith("y") and len(word) > 2 else word


def stems(texts: Iterable[str]) -> set[str]:
    """Stems of all words that carry meaning."""
    return {stem(word) for text in texts for word in words_of(text) if word not in _EMPTY}


def words_of(text: str) -> list[str]:
    """Its words, in lower case."""
    return re.findall(r"[^\W_]+", text.lower())


def said_stems(prompt: str) -> set[str]:
    """Stems of the words of a prompt in every reading: "leaves" is a leaf and to leave."""
    words = words_of(prompt)
    return stems(words) | stems(one.lemma for word in words for one in list_readings(word))


def share(words: Iterable[str], others: Iterable[str]) -> bool:
    """Whether two lists of stems have a word in common; "dust" and "dusti" (dusty) are one.

    Example:
        >>> share(["dust"], ["dusti"]), share(["light"], ["lightn"])
        (True, False)
    """
    others = tuple(others)
    return any(one == other or _is_stem_of(one, other) for one in words for other in others)


def _is_stem_of(one: str, other: str) -> bool:
    short, long = sorted((one, other), key=len)
    return len(short) > 2 and long.removeprefix(short) in _DERIVED


def head(phrase: str) -> str:
    """Stem of the last word of a noun phrase: the thing that it names."""
    words = words_of(phrase)
    return stem(words[-1]) if words else ""
