"""`--help`: the options that matter on one screen, one section, or all."""

from __future__ import annotations

import argparse
import difflib
import functools
import itertools
import re
import shutil
import textwrap
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from texvent._require import CHECKOUT
from texvent.cli.option_types import REQUIRED, Option, declared_options
from texvent.errors import ConfigError
from texvent.options.values import SCALARS

HELP_FLAGS = ("-h", "--help")
MAIN, ALL = "main", "all"
WIDEST = 100
"""Columns; longer lines are hard to read."""
FLAG_COLUMNS = 28


def asked_help(arguments: Sequence[str], sections: Iterable[str]) -> str | None:
    """Section that `--help` asks for: "main", "all" or a title; None without `--help`.

    A section may be misspelt. A path or a sentence behind `--help` belongs to the command, and so
    does all behind `--`.

    Raises:
        ConfigError: a word that is no section, of a command that has several.

    Example:
        >>> asked_help(["a.mp4", "--help", "simulator"], ["run", "simulate"])
        'simulate'
        >>> asked_help(["--help", "a.mp4"], ["run", "simulate"])
        'main'
    """
    words = [*itertools.takewhile(lambda word: word != "--", arguments)]
    for word, following in itertools.zip_longest(words, words[1:], fillvalue=""):
        flag, _, value = word.partition("=")
        if flag in HELP_FLAGS:
            names, word = (ALL, *sections), value or following
            near = difflib.get_close_matches(word, names, 1, cutoff=0.7)
            if not near and (value or (len(names) > 2 and re.fullmatch("[a-z_]+", word))):
                raise ConfigError(f"help has no section {word!r}; allowed: {', '.join(names)}")
            return near[0] if near else MAIN
    return None


def help_page(
    asked: str,
    groups: Mapping[str, Any],
    prog: str,
    description: str,
    presets: Mapping[str, Sequence[str]],
) -> str:
    """Help as text, as wide as the terminal, at most 100 columns.

    Args:
        asked: as `asked_help` returns it.
        groups: section → config instance with the defaults to show. The class attribute
            `main_options` of the first names the options that "main" shows; without it, all.
        prog: how the command is called.
        description: paragraphs; indented ones are kept as they are.
        presets: simulator → names of its presets; rows below all options and those of a run.
    """
    width = min(shutil.get_terminal_size().columns, WIDEST)
    sections = {title: list(declared_options(config)) for title, config in groups.items()}
    every = [option for options in sections.values() for option in options]
    operands = [option for option in every if option.is_operand]
    main = getattr(next(iter(groups.values()), None), "main_options", ())
    usage = [prog, *(["[OPTIONS]"] if every else []), *(one.flags[0] for one in operands)]
    page = argparse.ArgumentParser(
        usage=" ".join(usage),
        description=_filled(description, width),
        add_help=False,
        formatter_class=functools.partial(
            argparse.RawDescriptionHelpFormatter, max_help_position=FLAG_COLUMNS, width=width
        ),
    )
    if asked == MAIN and main:
        named = {option.name: option for option in every}
        chosen = page.add_argument_group()
        for option in [*operands, *(named[name] for name in main if name in named)]:
            _add(chosen, option, is_brief=True)
        *others, last = sections
        names = f"{', '.join(others)} or {last}" if others else last
        more = f"All options: {prog} --help all. One section: --help {names}."
        page.epilog = textwrap.fill(more, width)
        return _with_place_of_pages(page.format_help())
    for title, options in sections.items():
        if asked in (MAIN, ALL, title):
            purpose = (type(groups[title]).__doc__ or "").strip().partition("\n")[0]
            heading = (title, textwrap.fill(purpose, width - 2)) if len(sections) > 1 else ()
            section = page.add_argument_group(*heading)
            for option in options:
                _add(section, option)
    if asked in (ALL, "run"):
        rows = [f"presets of {name}: {', '.join(own)}" for name, own in presets.items()]
        page.epilog = "\n".join(textwrap.fill(row, width, subsequent_indent="    ") for row in rows)
    return _with_place_of_pages(page.format_help())


def _with_place_of_pages(text: str) -> str:
    """Help that names pages, and where an installation from a wheel finds them."""
    if "docs/" not in text or (CHECKOUT / "docs").is_dir():
        return text
    return f"{text}\nThe pages of docs/ are in texvent's repository and source distribution.\n"


def _add(section: Any, option: Option, *, is_brief: bool = False) -> None:
    """A row of help; if brief, only the first sentence of its text."""
    text = (option.brief if is_brief else option.text) + _default(option)
    flags, more = option.flags, dict[str, Any]()
    if option.hint is bool:
        more["action"] = "store_true"
        flags = (*flags, f"--no-{option.flags[-1][2:]}") if option.default is True else flags
    elif not option.is_operand:
        listed = "NAME" if is_brief else f"{{{','.join(option.choices)}}}"
        more["metavar"] = listed if option.choices else SCALARS[option.hint].placeholder
        more["nargs"] = "+" if option.is_list else None
    section.add_argument(*flags, help=text.replace("%", "%%"), **more)


def _default(option: Option) -> str:
    """The default as help says it; nothing where it would say nothing."""
    default = option.default
    if default is REQUIRED:
        return "" if option.is_operand else " (required)"
    if default is None or default is False or default == ():
        return ""
    values = default if isinstance(default, tuple) else (default,)
    return f" (default: {' '.join(map(str, values))})"


def _filled(description: str, width: int) -> str:
    """Paragraphs filled to the width, indented ones as they are."""
    paragraphs = description.strip().split("\n\n")
    return "\n\n".join(
        text if text.startswith(" ") else textwrap.fill(" ".join(text.split()), width)
        for text in paragraphs
    )
