"""Text of files and arguments, as a terminal may be given it."""

from __future__ import annotations

import re

HIDDEN = re.compile(r"[\x00-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")
"""Control characters, which begin a terminal's commands; line ends; marks that turn text around."""


def visible(text: str) -> str:
    r"""The text with what a terminal would obey written out; ordinary Unicode stays.

    Example:
        >>> visible("zwölf 🦩"), visible("a\x1b[31m\nb")
        ('zwölf 🦩', 'a\\u001b[31m\\u000ab')
    """
    return HIDDEN.sub(lambda match: f"\\u{ord(match[0]):04x}", text)


def visible_lines(text: str) -> str:
    """`visible` of every line; the line ends stay."""
    return "\n".join(map(visible, text.split("\n")))
