"""Words as they are written: forms of English nouns and verbs, and pictures that a prompt names.

Pictures are "photo.png", "9x6 checkerboard", "says STOP", "the digit 7".
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator

from texvent_scenes.spec.scene import Picture

_VOWELS = "aeiou"
_IRREGULAR = {
    "person": "people", "child": "children", "leaf": "leaves", "wolf": "wolves", "calf": "calves",
    "shelf": "shelves", "bookshelf": "bookshelves", "knife": "knives", "mouse": "mice",
    "potato": "potatoes", "tomato": "tomatoes", "mosquito": "mosquitoes", "volcano": "volcanoes",
    "hero": "heroes",
    "goose": "geese", "ox": "oxen", "scissors": "scissors", "wife": "wives",
    "midwife": "midwives",
}  # fmt: skip
_UNCHANGED = ("fish", "sheep", "deer", "moose", "bison", "squid", "salmon", "tuna", "trout", "cod")
"""Ends of nouns whose plural is the same word."""

_SINGULAR = ("ss", "us", "is", "as", "lens")
"""Ends of singular nouns in s; others in s are plurals: "stairs", "headphones"."""


@functools.cache
def list_plurals(noun: str) -> tuple[str, ...]:
    """Plurals of a noun of one or more words, the usual one first.

    Example:
        >>> list_plurals("traffic cone"), list_plurals("bus"), list_plurals("snow goose")
        (('traffic cones',), ('buses', 'busses'), ('snow geese', 'snow gooses'))
        >>> list_plurals("stairs")
        ('stairs',)
    """
    first, last = noun[: noun.rfind(" ") + 1], noun.split()[-1]
    is_plural = last.endswith("s") and not last.endswith(_SINGULAR)
    if is_plural and last not in _IRREGULAR:
        return (noun,)
    usual = noun if last.endswith(_UNCHANGED) else None
    usual = f"{first}{_IRREGULAR[last]}" if last in _IRREGULAR else usual
    regular = _list_regular_plurals(noun)
    return regular if usual is None else (usual, *(one for one in regular if one != usual))


def _list_regular_plurals(noun: str) -> tuple[str, ...]:
    if noun.endswith("s"):
        return (f"{noun}es", f"{noun}ses")
    if noun.endswith(("x", "z", "ch", "sh")):
        return (f"{noun}es",)
    if noun.endswith("y") and noun[-2:-1] not in _VOWELS:
        return (f"{noun[:-1]}ies",)
    if noun.endswith("f"):
        return (f"{noun}s", f"{noun[:-1]}ves")
    if noun.endswith("o"):
        return (f"{noun}s", f"{noun}es")
    if noun.endswith("man"):
        return (f"{noun[:-2]}en",)
    return (f"{noun}s",)


def _third_person(verb: str) -> str:
    """As "flies", "crosses"."""
    if verb.endswith(("s", "x", "z", "ch", "sh", "o")):
        return f"{verb}es"
    return f"{verb[:-1]}ies" if _ends_in_y(verb) else f"{verb}s"


def _ends_in_y(verb: str) -> bool:
    return verb.endswith("y") and verb[-2:-1] not in _VOWELS


def list_verb_forms(verb: str, irregular: str = "") -> list[tuple[str, str]]:
    """Forms of a verb, each with its name.

    Args:
        verb: its base form.
        irregular: its form in -ing and those of the past, if they are not regular.

    Example:
        >>> list_verb_forms("carry")
        [('carry', 'base'), ('carries', 's'), ('carrying', 'ing'), ('carried', 'ed')]
        >>> list_verb_forms("stop")[2:]
        [('stopping', 'ing'), ('stopped', 'ed')]
    """
    stem = verb[:-1] if verb.endswith("e") and not verb.endswith("ee") else verb
    if re.fullmatch(r"[^aeiou]+[aeiou][^aeiouwxy]", verb):  # "stop", "stopping"
        stem += verb[-1]
    past = f"{verb[:-1]}ied" if _ends_in_y(verb) else f"{stem}ed"
    present, *pasts = irregular.split() or (f"{stem}ing", past)
    forms = [(verb, "base"), (_third_person(verb), "s"), (present, "ing")]
    if re.search(r"[^aeiou][aeiou]l$", verb):  # British: "travelling"
        forms.append((f"{verb}ling", "ing"))
        pasts.append(f"{verb}led")
    return [*forms, *((one, "ed") for one in pasts)]


_ENDINGS = "png|jpe?g|bmp|tiff?|webp|pgm|ppm|mp4|m4v|mov|avi|mkv|webm|gif|mpg"
_QUOTE = "[\"“‘']([^\"”’']{1,200})[\"”’']"
_QUOTED = 4
"""Number of the group between quotation marks."""
_LONGEST_PATH = 250
"""Characters of a path; a longer run of letters is no path."""
_SAYS = r"says?|saying|reads?|reading|text|words?|labell?ed|title|spelling|displaying|message"
_LITERAL = re.compile(
    rf"(?<![\w~./\\-])(?P<file>[\w~./\\-]{{1,{_LONGEST_PATH}}}\.(?i:{_ENDINGS}))\b"
    r"|(?<=board\s)(?P<checks_after>\d{1,3}\s?[x×]\s?\d{1,3})\b"
    r"|(?<![\w.])(?P<checks>\d{1,3}\s?[x×]\s?\d{1,3})(?=[\s-]+(?:[a-z]+[\s-]+)?\w*(?:board|squares|pattern|grid))"
    rf"|(?<=\b)(?i:(?:{_SAYS})\s*:?\s+){_QUOTE}"
    rf"|(?<=\b)(?i:(?:says?|saying|reads?|reading|the\s(?:word|text|letters))\s+)([A-Z0-9]{{2,}}(?:\s[A-Z0-9!]+)*)\b"
    r"|(?<=\b)(?i:(?:digits?|numbers?)\s+)(\d{1,12})\b"
    r"|(?<=\b)(?i:letters?\s+)([A-Za-z])\b"
    r"|(?<=\b)(?i:(?:april\s?tag|aruco|fiducial)(?:\s(?:tag|marker))?\s+)"
    r"(?P<said_tag>(?i:with\s+)?(?i:(?:the\s+)?id\s+)?(?P<tag>\d{1,3}))\b"
)


def find_literals(prompt: str) -> Iterator[tuple[int, int, Picture]]:
    """Pictures that a prompt names: where each begins and ends in the prompt, and what it is.

    Example:
        >>> [picture.value for _, _, picture in find_literals("a sign that reads STOP")]
        ['STOP']
    """
    for match in _LITERAL.finditer(prompt):
        if match["file"] is not None:
            yield (*match.span("file"), Picture(kind="file", value=match["file"]))
        elif said := match["checks"] or match["checks_after"]:
            yield (*match.span(), Picture(kind="checkerboard", value=said))
        elif match["tag"] is not None:
            yield (*match.span("said_tag"), Picture(kind="tag", value=match["tag"]))
        else:
            number = next(n for n in range(4, 8) if match[n] is not None)
            begin, end = match.span(number)
            quote = number == _QUOTED
            if number <= _QUOTED + 1:  # with the word that says so: "says STOP"
                begin = match.start() + quote
            yield begin - quote, end + quote, Picture(kind="text", value=match[number])
