"""Command lines: flags made from config dataclasses, parsed by argparse; errors are one line."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent._registry import nearest
from texvent.cli.help import asked_help, help_page
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED, Option, declared_options, flag_of
from texvent.config import warn_of_idle
from texvent.errors import ConfigError, shown
from texvent.io.atomic import protect_inputs
from texvent.options.values import option_names


def parse_given(
    arguments: Sequence[str],
    groups: Mapping[str, Any],
    *,
    prog: str,
    description: str,
    presets: Callable[[], Mapping[str, Sequence[str]]] = dict,
    explain: Callable[[str], str | None] = lambda flag: None,
) -> dict[str, Any]:
    """Options that a command line gives, name → value.

    Args:
        arguments: words after the command's name.
        groups: title → config instance whose values are the defaults that `--help` shows. Class
            attributes name its fields: those in `positional` are given without a flag, those in
            `short_flags` also have a short one or other names, those in `outputs` are written
            ("out" if there is no such attribute), and those in `input_texts` are texts that may be
            the path of an input, as a `Path` always is. `main_options` of the first group names the
            options that `--help` alone shows.
        prog: how the command is called.
        description: first lines of its help.
        presets: rows of help, as `help_page` takes them.
        explain: what is wrong with an unknown flag, where a command knows more of it.

    Raises:
        ConfigError: an unknown flag, a value of the wrong type, or a missing one.
        SystemExit: `--help` was asked for and shown.
    """
    asked = asked_help(arguments, groups)
    if asked is not None:
        write_out(help_page(asked, groups, prog, description, presets()))
        raise SystemExit(0)
    options = list(declared_options(*groups.values()))
    given, rest, operands = _read_flags(arguments, options, prog)
    unknown = next((word for word in rest if _is_flag(word)), None)
    if unknown is not None:
        flag = unknown.partition("=")[0]
        raise ConfigError(explain(flag) or _unknown_flag(flag, options, prog))
    given.update(_read_operands([*rest, *operands], options, prog))
    for option in options:
        if option.default is REQUIRED and option.name not in given:
            raise ConfigError(f"{prog} needs {option.flags[-1]} ({option.purpose})")
    for name, one in _each(given):
        if isinstance(one, Path) and str(one) == "-":
            raise ConfigError(
                f"{prog}: {name} is -; standard input and output are not read or written as "
                "files; give the name of a file"
            )
    protect_inputs(_inputs({option.name: option.default for option in options} | given, groups))
    return given


def parse_configs(
    arguments: Sequence[str], groups: Mapping[str, Any], *, prog: str, description: str
) -> tuple[Any, ...]:
    """The config instances of `groups`, in order, with the values of a command line.

    Arguments and errors are those of `parse_given`; a config may refuse a value.
    """
    given = parse_given(arguments, groups, prog=prog, description=description)
    return with_given(groups.values(), given)


def with_given(configs: Iterable[Any], given: Mapping[str, Any]) -> tuple[Any, ...]:
    """Copies of configs with those of their options that were given.

    Warns:
        TexventWarning: another option switches one of them off.
    """
    filled = []
    for config in configs:
        own = {name: given[name] for name in option_names(type(config)) if name in given}
        filled.append(dataclasses.replace(config, **own))
    warn_of_idle(filled, given)
    return tuple(filled)


def take_options(
    arguments: Sequence[str], names: Iterable[str], prog: str
) -> tuple[dict[str, str], list[str]]:
    """The texts of a few options that decide which others there are, and all other words."""
    options = [Option(name, (flag_of(name),)) for name in names]
    taken, rest, operands = _read_flags(arguments, options, prog)
    return taken, [*rest, "--", *operands] if operands else rest


def _read_flags(
    arguments: Sequence[str], options: Iterable[Option], prog: str
) -> tuple[dict[str, Any], list[str], list[str]]:
    """Values of options with flags, the other words, and the words behind `--`."""
    parser = argparse.ArgumentParser(
        add_help=False,
        allow_abbrev=False,
        exit_on_error=False,
        argument_default=argparse.SUPPRESS,
    )
    for option in options:
        more: dict[str, Any] = {"type": option.read}
        if option.hint is bool:
            more = {"action": argparse.BooleanOptionalAction}
        elif option.is_list:
            more |= {"action": "extend", "nargs": "+"}
        if not option.is_operand:
            parser.add_argument(*option.flags, dest=option.name, **more)
    words, operands = list(arguments), []
    if "--" in words:
        end = words.index("--")
        words, operands = words[:end], words[end + 1 :]
    try:
        found, rest = parser.parse_known_args(map(_with_hyphens, words))
    except argparse.ArgumentError as error:
        raise ConfigError(f"{error.argument_name}: {error.message} (see {prog} --help)") from None
    return vars(found), rest, operands


def _with_hyphens(word: str) -> str:
    """`--white_level=1` as `--white-level=1`: options are spelt with `_` in files and Python."""
    flag, equals, value = word.partition("=")
    return f"{flag.replace('_', '-')}{equals}{value}" if flag.startswith("--") else word


def _is_flag(word: str) -> bool:
    return word.startswith("-") and len(word) > 1 and " " not in word and not word[1].isdigit()


def _unknown_flag(flag: str, options: Iterable[Option], prog: str) -> str:
    known = {flag.lstrip("-"): flag for one in options if not one.is_operand for flag in one.flags}
    close = nearest(flag.lstrip("-"), tuple(known))
    hint = f"; did you mean {known[close]}?" if close else ""
    return f"unknown option {shown(flag)}{hint} (see {prog} --help)"


def _read_operands(words: Sequence[str], options: Iterable[Option], prog: str) -> dict[str, Any]:
    """Values of the options without a flag; a list takes all words but those that others need."""
    operands = [option for option in options if option.is_operand]
    given: dict[str, Any] = {}
    left = list(words)
    for index, option in enumerate(operands):
        count = max(len(left) - len(operands[index + 1 :]), 0) if option.is_list else 1
        own, left = left[:count], left[count:]
        if any(not word.strip() for word in own):
            raise ConfigError(f"{option.flags[0]} must not be empty ({option.purpose})")
        try:
            values = tuple(map(option.read, own))
        except argparse.ArgumentTypeError as error:
            raise ConfigError(f"{option.flags[0]}: {error}") from None
        if values:
            given[option.name] = values if option.is_list else values[0]
    if left:
        raise ConfigError(
            f"unexpected {shown(' '.join(left))}; if it belongs to a text or a name, put all of it "
            f"in quotes (see {prog} --help)"
        )
    return given


def _each(values: Mapping[str, Any]) -> Iterator[tuple[str, Any]]:
    """Every value by its name, those of lists one by one."""
    for name, value in values.items():
        for one in value if isinstance(value, tuple | list) else (value,):
            yield name, one


def _inputs(values: Mapping[str, Any], groups: Mapping[str, Any]) -> Iterator[str | Path]:
    """Every value that names an input: paths, and texts that may be one.

    Other texts name none, though a file or folder may have the same name: `generate "car"`.
    """
    outputs = {name for one in groups.values() for name in getattr(one, "outputs", ("out",))}
    inputs = {name for one in groups.values() for name in getattr(one, "input_texts", ())}
    for name, one in _each(values):
        is_path = isinstance(one, Path) and name not in outputs
        if is_path or (isinstance(one, str) and name in inputs):
            yield one
