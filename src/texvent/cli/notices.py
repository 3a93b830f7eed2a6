"""Warnings and notes as one line each on stderr."""

from __future__ import annotations

import contextlib
import os
import re
import sys
import warnings
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from texvent.errors import visible, visible_lines, warnings_to

if TYPE_CHECKING:
    from rich.console import Console

_BOLD_YELLOW, _PLAIN = "\x1b[1;33m", "\x1b[0m"
_UNFOLDED = 10_000
"""Columns where no terminal folds lines: wider than any row."""


def _each_once(listener: Callable[[str], None]) -> Callable[[str], None]:
    """The listener without what it has heard: a file that is read twice warns twice."""
    heard: set[str] = set()

    def hear(text: str) -> None:
        if text not in heard:
            heard.add(text)
            listener(text)

    return hear


@contextlib.contextmanager
def one_line_warnings() -> Iterator[None]:
    """Show a `TexventWarning` as `warning  ...`."""
    with warnings.catch_warnings(), warnings_to(_each_once(say_warning)):
        yield


def with_flags(message: str) -> str:
    """A message of the Python API as the command line says it: options by their flags.

    Example:
        >>> with_flags("options: sensor is 'x'; give simulator='esim' and a white_level")
        "--sensor is 'x'; give --simulator esim and a --white-level"
    """
    if message.startswith("config file"):
        return message
    from texvent.options.keywords import GenerateOptions, SimulateOptions  # brings NumPy

    names = "|".join({**SimulateOptions.__annotations__, **GenerateOptions.__annotations__})
    for pattern in (
        rf"\b(?P<name>{names})='?(?P<value>[\w.-]+)'?",
        rf"^(?:options: )?(?P<name>{names})(?= is | needs | makes )",
        rf"(?<![\w./-])(?P<name>(?=[a-z]+_)(?:{names}))(?![\w./-])",
    ):
        message = re.sub(pattern, _flag, message)
    return message


def _flag(match: re.Match[str]) -> str:
    name, value = match["name"].replace("_", "-"), match.groupdict().get("value")
    if value in ("True", "False"):
        return f"--{name}" if value == "True" else f"--no-{name}"
    return f"--{name}{f' {value}' if value else ''}"


def say(line: str) -> None:
    """Write a line to stderr, its columns as they are."""
    sys.stderr.write(visible(" ".join(line.splitlines())) + "\n")


def write_out(text: str) -> None:
    """Write a result to stdout: lines, each with its end."""
    sys.stdout.write(visible_lines(text))


@contextlib.contextmanager
def result_console() -> Iterator[Console]:
    """A console for tables on stdout.

    In a terminal rows are folded to its width. Elsewhere, unless COLUMNS asks for a width, each row
    is one line without spaces at its end, so that grep and other programs can read it.
    """
    from rich.console import Console  # most commands print no table

    console = Console(highlight=False)
    if console.is_terminal or "COLUMNS" in os.environ:
        yield console
        return
    console = Console(highlight=False, width=_UNFOLDED)
    with console.capture() as captured:
        yield console
    sys.stdout.write("\n".join(line.rstrip() for line in captured.get().split("\n")))


def say_warning(message: str) -> None:
    """Write a warning to stderr; coloured in a terminal."""
    text = visible(" ".join(with_flags(message).split()))
    has_colours = sys.stderr.isatty() and not os.environ.get("NO_COLOR")
    first, last = (_BOLD_YELLOW, _PLAIN) if has_colours else ("", "")
    sys.stderr.write(f"{first}warning  {text}{last}\n")
