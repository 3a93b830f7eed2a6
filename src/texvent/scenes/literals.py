"""Pictures in a prompt: "photo.png", "9x6 checkerboard", "says STOP", "the digit 7"."""

from __future__ import annotations

import re
from collections.abc import Iterator

from texvent.scenes.spec.scene import Picture

_ENDINGS = "png|jpe?g|bmp|tiff?|webp|pgm|ppm|mp4|m4v|mov|avi|mkv|webm|gif|mpg"
_QUOTE = "[\"“‘']([^\"”’']{1,200})[\"”’']"
_QUOTED = 3
"""Number of the group between quotation marks."""
_LONGEST_PATH = 250
"""Characters of a path; a longer run of letters is no path."""
_SAYS = r"says?|saying|reads?|reading|text|words?|labell?ed|title|spelling|displaying|message"
_LITERAL = re.compile(
    rf"(?<![\w~./\\-])(?P<file>[\w~./\\-]{{1,{_LONGEST_PATH}}}\.(?i:{_ENDINGS}))\b"
    r"|(?<![\w.])(?P<checks>\d{1,3}\s?[x×]\s?\d{1,3})(?=[\s-]+\w*(?:board|squares|pattern|grid))"
    rf"|(?<=\b)(?i:(?:{_SAYS})\s*:?\s+){_QUOTE}"
    rf"|(?<=\b)(?i:(?:says?|saying|reads?|reading|the\s(?:word|text|letters))\s+)([A-Z0-9]{{2,}}(?:\s[A-Z0-9!]+)*)\b"
    r"|(?<=\b)(?i:(?:digits?|numbers?)\s+)(\d{1,12})\b"
    r"|(?<=\b)(?i:letters?\s+)([A-Za-z])\b"
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
        elif match["checks"] is not None:
            yield (*match.span("checks"), Picture(kind="checkerboard", value=match["checks"]))
        else:
            number = next(n for n in range(3, 7) if match[n] is not None)
            begin, end = match.span(number)
            quote = number == _QUOTED
            if number <= _QUOTED + 1:  # with the word that says so: "says STOP"
                begin = match.start() + quote
            yield begin - quote, end + quote, Picture(kind="text", value=match[number])
