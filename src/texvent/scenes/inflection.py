"""Forms of English nouns and verbs."""

from __future__ import annotations

_VOWELS = "aeiou"
_IRREGULAR = {
    "person": "people", "child": "children", "fish": "fish", "sheep": "sheep", "leaf": "leaves",
    "wolf": "wolves", "shelf": "shelves", "bookshelf": "bookshelves", "knife": "knives",
    "mouse": "mice", "goose": "geese", "scissors": "scissors",
}  # fmt: skip


def pluralise(noun: str) -> str:
    """The plural a person would write.

    Example:
        >>> pluralise("person"), pluralise("tree")
        ('people', 'trees')
    """
    return _IRREGULAR.get(noun) or list_plurals(noun)[0]


def list_plurals(noun: str) -> tuple[str, ...]:
    """Regular plurals of a noun of one or more words.

    Example:
        >>> list_plurals("traffic cone"), list_plurals("bus"), list_plurals("butterfly")
        (('traffic cones',), ('buses', 'busses'), ('butterflies',))
    """
    if noun.endswith("s"):
        return (f"{noun}es", f"{noun}ses")
    if noun.endswith(("x", "z", "ch", "sh")):
        return (f"{noun}es",)
    if noun.endswith("y") and noun[-2:-1] not in _VOWELS:
        return (f"{noun[:-1]}ies",)
    if noun.endswith("f"):
        return (f"{noun}s", f"{noun[:-1]}ves")
    if noun.endswith("fe"):
        return (f"{noun}s", f"{noun[:-2]}ves")
    if noun.endswith("o"):
        return (f"{noun}s", f"{noun}es")
    if noun.endswith("man"):
        return (f"{noun[:-2]}en",)
    return (f"{noun}s",)


def list_finite_forms(verb: str) -> tuple[str, ...]:
    """Present forms of a verb.

    Example:
        >>> list_finite_forms("fly"), list_finite_forms("cross")
        (('fly', 'flies'), ('cross', 'crosses'))
    """
    if verb.endswith(("s", "x", "z", "ch", "sh", "o")):
        return (verb, f"{verb}es")
    if _ends_in_y(verb):
        return (verb, f"{verb[:-1]}ies")
    return (verb, f"{verb}s")


def _ends_in_y(verb: str) -> bool:
    return verb.endswith("y") and verb[-2:-1] not in _VOWELS
