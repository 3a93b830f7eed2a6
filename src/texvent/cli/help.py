"""`--help`: the options that matter on one screen, one section, or all."""

from __future__ import annotations

import dataclasses
import difflib
import itertools
import re
import shutil
import textwrap
import typing
from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from texvent.cli.option_types import REQUIRED, metavar
from texvent.errors import ConfigError
from texvent.options.fields import option_help

HELP_FLAGS = ("-h", "--help")
MAIN, ALL = "main", "all"
WIDEST = 100
"""Columns; longer lines are hard to read."""
FLAG_COLUMNS = 30


def asked_help(arguments: Sequence[str], sections: Iterable[str]) -> str | None:
    """Section that `--help` asks for: "main", "all" or a title; None without `--help`.

    A section may be misspelt. A path or a sentence behind `--help` belongs to the command.

    Raises:
        ConfigError: a word that is no section, of a command that has several.

    Example:
        >>> asked_help(["a.mp4", "--help", "simulator"], ["run", "simulate"])
        'simulate'
        >>> asked_help(["--help", "a.mp4"], ["run", "simulate"])
        'main'
    """
    for word, following in itertools.zip_longest(arguments, arguments[1:], fillvalue=""):
        flag, _, value = word.partition("=")
        if flag in HELP_FLAGS:
            names, word = (ALL, *sections), value or following
            near = difflib.get_close_matches(word, names, 1, cutoff=0.7)
            if not near and (value or (len(names) > 2 and re.fullmatch("[a-z_]+", word))):
                raise ConfigError(f"help has no section {word!r}; allowed: {', '.join(names)}")
            return near[0] if near else MAIN
    return None


def render_help(
    asked: str,
    groups: Mapping[str, Any],
    *,
    prog: str,
    description: str,
    names: Mapping[str, Mapping[str, Sequence[str]]] = MappingProxyType({}),
    width: int | None = None,
) -> str:
    """Help as text.

    Args:
        asked: as `asked_help` returns it.
        groups: section → config instance with the defaults to show. The class attribute
            `main_options` of the first names the options that "main" shows; without it, all.
        prog: how the command is called.
        description: paragraphs; indented ones are kept as they are.
        names: option → what it may be, by what decides that: rows below the option.
        width: columns; default: those of the terminal, at most 100.
    """
    width = width or min(shutil.get_terminal_size().columns, WIDEST)
    sections = {title: _options(config) for title, config in groups.items()}
    every = [option for options in sections.values() for option in options]
    operands = [option for option in every if option.is_positional]
    main = getattr(next(iter(groups.values()), None), "main_options", ())
    usage = ["usage:", prog, *(["[OPTIONS]"] if every else []), *(one.flags for one in operands)]
    lines = [" ".join(usage), ""]
    lines += [*_filled(description, width), ""]
    if asked == MAIN and main:
        named = {option.name: option for option in every}
        shown = [*operands, *(named[name] for name in main if name in named)]
        for option in shown:
            lines += option.lines(width, is_brief=True)
            lines += _rows(names.get(option.name, {}), width)
        lines += ["", *_more(prog, sections, width)]
        return "\n".join([*lines, ""])
    for title, options in sections.items():
        if asked in (MAIN, ALL, title):
            purpose = (type(groups[title]).__doc__ or "").strip().partition("\n")[0]
            lines += textwrap.wrap(f"{title}: {purpose}", width)
            for option in options:
                lines += option.lines(width)
                lines += _rows(names.get(option.name, {}), width)
            lines.append("")
    return "\n".join(lines)


@dataclasses.dataclass(frozen=True)
class _Option:
    """An option as help shows it."""

    name: str
    flags: str
    """Such as "-o, --out PATH", or what an operand is called."""
    text: str
    default: Any
    is_positional: bool

    def lines(self, width: int, *, is_brief: bool = False) -> list[str]:
        """Flags on the left, text on the right; if brief, its first sentence on two lines."""
        room, default = max(width - FLAG_COLUMNS, 20), self._default()
        flags, text = f"  {self.flags}", self.text
        if is_brief:
            flags = re.sub(r"\{.*\}", "NAME", flags)
            default = "" if self.default is None else default
            text = first_sentence(text)
        right = textwrap.wrap(text + default, room, break_on_hyphens=False) or [""]
        while is_brief and len(right) > 2:
            text = f"{text.removesuffix(' ...').rpartition(' ')[0]} ..."
            right = textwrap.wrap(text + default, room, break_on_hyphens=False)
        if len(flags) >= FLAG_COLUMNS:
            right = ["", *right]
        rows = itertools.zip_longest([flags], right, fillvalue="")
        return [f"{left:<{FLAG_COLUMNS}}{one}".rstrip() for left, one in rows]

    def _default(self) -> str:
        if self.default is REQUIRED:
            return "" if self.is_positional else " (required)"
        if self.default is False or self.default == ():
            return ""
        values = self.default if isinstance(self.default, tuple) else (self.default,)
        shown = " ".join("none" if one is None else str(one) for one in values)
        return f" (default: {shown})"


def _options(config: Any) -> list[_Option]:
    """The options of a config instance, its values being the defaults."""
    hints, texts = typing.get_type_hints(type(config)), option_help(type(config))
    short_flags = getattr(config, "short_flags", {})
    options = []
    for field in dataclasses.fields(config):
        name, default = field.name, getattr(config, field.name)
        is_positional = name in getattr(config, "positional", ())
        flag = f"--{name.replace('_', '-')}"
        spellings = [short_flags[name], flag] if name in short_flags else [flag]
        if default is True:
            spellings.append(f"--no-{flag[2:]}")
        value = metavar(hints[name])
        if name in getattr(config, "repeated", ()):
            value = value.removeprefix("[").removesuffix(" ...]")
        flags = f"{', '.join(spellings)} {value}".rstrip()
        flags = name.upper() if is_positional else flags
        options.append(_Option(name, flags, texts.get(name, ""), default, is_positional))
    return options


def _rows(names: Mapping[str, Sequence[str]], width: int) -> Iterator[str]:
    """A row for each owner of names."""
    column = 6 + max(map(len, names), default=0)
    for owner, own in names.items():
        yield from textwrap.wrap(
            ", ".join(own),
            width,
            initial_indent=f"    {owner}".ljust(column),
            subsequent_indent=" " * column,
            break_on_hyphens=False,
        )


def first_sentence(text: str) -> str:
    """The text up to the first full stop before a capital.

    Example:
        >>> first_sentence("Balance α (Eq. 1), in levels. Dark pixels fire less.")
        'Balance α (Eq. 1), in levels.'
    """
    return re.split(r"(?<=[.!?])\s+(?=[A-Z])", text, maxsplit=1)[0]


def _filled(description: str, width: int) -> list[str]:
    """Paragraphs filled to the width, indented ones as they are."""
    lines: list[str] = []
    for paragraph in description.strip().split("\n\n"):
        is_verbatim = paragraph.startswith(" ")
        filled = textwrap.wrap(" ".join(paragraph.split()), width, break_on_hyphens=False)
        lines += ["", *(paragraph.splitlines() if is_verbatim else filled)]
    return lines[1:]


def _more(prog: str, sections: Iterable[str], width: int) -> list[str]:
    *others, last = sections
    names = f"{', '.join(others)} or {last}" if others else last
    return textwrap.wrap(f"All options: {prog} --help all. One section: --help {names}.", width)
