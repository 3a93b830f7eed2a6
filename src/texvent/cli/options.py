"""Command lines: flags made from config dataclasses, parsed by argparse; errors are one line."""

from __future__ import annotations

import argparse
import dataclasses
import difflib
import typing
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

from texvent.cli.help import ALL, asked_help, first_sentence, render_help
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED, SCALARS, without_none
from texvent.errors import ConfigError, shown
from texvent.io.atomic import protect_inputs
from texvent.options.fields import option_help, option_names

LONGEST_HELP = 120
"""Characters of an option's help that an error repeats."""
EXPECTED = {
    "INT": "a whole number",
    "FLOAT": "a number",
    "TEXT": "text",
    "PATH": "a path",
    "RATE": "a rate such as 24, 29.97 or 30000/1001",
}
Explain = Callable[[str], str | None]
Names = Callable[[], Mapping[str, Mapping[str, Sequence[str]]]]


def parse_given(
    arguments: Sequence[str],
    groups: Mapping[str, Any],
    *,
    prog: str,
    description: str,
    names: Names = dict,
    explain: Explain = lambda flag: None,
) -> dict[str, Any]:
    """Options that a command line gives, name → value.

    Args:
        arguments: words after the command's name.
        groups: title → config instance whose values are the defaults that `--help` shows. Class
            attributes name its fields: those in `positional` are given without a flag, those in
            `repeated` several times, those in `short_flags` also have a short one, those in
            `outputs` are written ("out" if there is no such attribute), and those in `input_texts`
            are texts that may be the path of an input, as a `Path` always is. `main_options` of the
            first group names the options that `--help` alone shows.
        prog: how the command is called.
        description: first lines of its help; indented ones are kept as they are.
        names: rows below options in help, as `render_help` takes them.
        explain: what is wrong with an unknown flag, where a command knows more of it.

    Raises:
        ConfigError: an unknown flag, a value of the wrong type, or a missing one.
        SystemExit: `--help` was asked for and shown.
    """
    asked = asked_help(arguments, groups)
    if asked is not None:
        page = render_help(asked, groups, prog=prog, description=description, names=names())
        write_out(page)
        raise SystemExit(0)
    parser = _parser()
    for config in groups.values():
        _add_options(parser, config)
    given, rest, operands = _parse(parser, arguments, prog)
    unknown = [word for word in rest if _is_flag(word)]
    if unknown:
        raise ConfigError(_unknown_flag(unknown[0], parser, explain, prog))
    given.update(_read_operands([*rest, *operands], groups.values(), prog))
    _refuse_missing(given, groups.values(), prog)
    protect_inputs(_inputs({**_defaults(groups), **given}, groups.values()))
    return given


def parse_options(
    arguments: Sequence[str], groups: Mapping[str, Any], *, prog: str, description: str
) -> dict[str, Any]:
    """All options, name → value: those given, else the defaults; as `parse_given`."""
    given = parse_given(arguments, groups, prog=prog, description=description)
    return {**_defaults(groups), **given}


def parse_configs(
    arguments: Sequence[str], groups: Mapping[str, Any], *, prog: str, description: str
) -> tuple[Any, ...]:
    """The config instances of `groups`, in order, with the values of a command line.

    Arguments and errors are those of `parse_given`; a config may refuse a value.
    """
    given = parse_given(arguments, groups, prog=prog, description=description)
    return tuple(with_given(config, given) for config in groups.values())


def _defaults(groups: Mapping[str, Any]) -> dict[str, Any]:
    return {name: getattr(one, name) for one in groups.values() for name in option_names(type(one))}


def with_given(config: Any, given: Mapping[str, Any]) -> Any:
    """A copy of a config with those of its options that were given."""
    own = {name: given[name] for name in option_names(type(config)) if name in given}
    return dataclasses.replace(config, **own)


def refuse_arguments(arguments: Sequence[str], *, prog: str, description: str) -> None:
    """Parse the command line of a command that has no options.

    Raises:
        ConfigError: there are arguments.
        SystemExit: `--help` was asked for and shown.
    """
    if asked_help(arguments, ()) is not None:
        write_out(render_help(ALL, {}, prog=prog, description=description))
        raise SystemExit(0)
    if arguments:
        raise ConfigError(f"{prog} takes no arguments; got {shown(' '.join(arguments))}")


def take_options(
    arguments: Sequence[str], names: Sequence[str], prog: str
) -> tuple[dict[str, str], list[str]]:
    """The texts of a few options that decide which others there are, and all other words."""
    parser = _parser()
    for name in names:
        parser.add_argument(_flag(name), dest=name)
    taken, rest, operands = _parse(parser, arguments, prog)
    return taken, [*rest, "--", *operands] if operands else rest


def _parser() -> argparse.ArgumentParser:
    return argparse.ArgumentParser(
        add_help=False,
        allow_abbrev=False,
        exit_on_error=False,
        argument_default=argparse.SUPPRESS,
    )


def _parse(
    parser: argparse.ArgumentParser, arguments: Sequence[str], prog: str
) -> tuple[dict[str, Any], list[str], list[str]]:
    """Values of the parser's flags, the other words, and the words behind `--`."""
    words, operands = list(arguments), []
    if "--" in words:
        end = words.index("--")
        words, operands = words[:end], words[end + 1 :]
    words = [_with_hyphens(word) for word in words]
    try:
        found, rest = parser.parse_known_args(words)
    except argparse.ArgumentError as error:
        raise ConfigError(f"{error.argument_name}: {error.message} (see {prog} --help)") from None
    return vars(found), rest, operands


def _with_hyphens(word: str) -> str:
    """`--white_level=1` as `--white-level=1`: options are spelt with `_` in files and Python."""
    flag, equals, value = word.partition("=")
    return f"{flag.replace('_', '-')}{equals}{value}" if flag.startswith("--") else word


def _flag(name: str) -> str:
    return f"--{name.replace('_', '-')}"


def _is_flag(word: str) -> bool:
    return word.startswith("-") and len(word) > 1 and " " not in word and not word[1].isdigit()


def _add_options(parser: argparse.ArgumentParser, config: Any) -> None:
    hints, helps = typing.get_type_hints(type(config)), option_help(type(config))
    for name in option_names(type(config)):
        if name in getattr(config, "positional", ()):
            continue
        short = getattr(config, "short_flags", {}).get(name)
        flags = [short, _flag(name)] if short else [_flag(name)]
        hint = without_none(hints[name])
        if hint is bool:
            parser.add_argument(*flags, dest=name, action=argparse.BooleanOptionalAction)
            continue
        more: dict[str, Any] = {"type": _reader(hints[name], helps.get(name, ""))}
        if name in getattr(config, "repeated", ()):
            more["action"] = "append"
        elif typing.get_origin(hint) is tuple:
            more.update(action="extend", nargs="+")
        parser.add_argument(*flags, dest=name, **more)


def _reader(hint: Any, text: str) -> Callable[[str], Any]:
    """Converter of a word to a type, or to an item of a tuple."""
    is_optional = type(None) in typing.get_args(hint)
    hint = without_none(hint)
    if typing.get_origin(hint) is tuple:
        hint = typing.get_args(hint)[0]
    choices = typing.get_args(hint) if typing.get_origin(hint) is Literal else ()
    purpose = first_sentence(text).rstrip(".")
    more = f" ({purpose})" if 0 < len(purpose) <= LONGEST_HELP else ""

    def read(word: str) -> Any:
        # As a text "none" may be a name: --interpolate none.
        if is_optional and hint is not str and word.lower() == "none" and word not in choices:
            return None
        if choices:
            if word in map(str, choices):
                return next(one for one in choices if str(one) == word)
            allowed = ", ".join(map(str, choices))
            raise argparse.ArgumentTypeError(f"{shown(word)} is not allowed; allowed: {allowed}")
        kind, convert = SCALARS[hint]
        try:
            return convert(word)
        except (ValueError, ArithmeticError):
            message = f"{shown(word)} is not {EXPECTED[kind]}{more}"
            raise argparse.ArgumentTypeError(message) from None

    return read


def _unknown_flag(word: str, parser: argparse.ArgumentParser, explain: Explain, prog: str) -> str:
    flag = word.partition("=")[0]
    more = explain(flag)
    if more is not None:
        return more
    known = [one for action in parser._actions for one in action.option_strings]
    close = difflib.get_close_matches(flag, known, n=1)
    hint = f"; did you mean {close[0]}?" if close else ""
    return f"unknown option {shown(flag)}{hint} (see {prog} --help)"


def _read_operands(words: Sequence[str], groups: Iterable[Any], prog: str) -> dict[str, Any]:
    """Values of the options without a flag; a list takes all words but those that others need."""
    fields = [(config, name) for config in groups for name in getattr(config, "positional", ())]
    given: dict[str, Any] = {}
    left = list(words)
    for index, (config, name) in enumerate(fields):
        hint = typing.get_type_hints(type(config))[name]
        text = option_help(type(config)).get(name, "")
        is_list = typing.get_origin(without_none(hint)) is tuple
        count = max(len(left) - len(fields[index + 1 :]), 0) if is_list else min(len(left), 1)
        read, own = _reader(hint, text), left[:count]
        left = left[count:]
        if any(not word.strip() for word in own):
            raise ConfigError(f"{name.upper()} must not be empty ({text[:200].rstrip('.')})")
        try:
            values = tuple(map(read, own))
        except argparse.ArgumentTypeError as error:
            raise ConfigError(f"{name.upper()}: {error}") from None
        if values:
            given[name] = values if is_list else values[0]
    if left:
        raise ConfigError(
            f"unexpected {shown(' '.join(left))}; if it belongs to a text or a name, put all of it "
            f"in quotes (see {prog} --help)"
        )
    return given


def _refuse_missing(given: Mapping[str, Any], groups: Iterable[Any], prog: str) -> None:
    for config in groups:
        for name in option_names(type(config)):
            if getattr(config, name) is REQUIRED and name not in given:
                is_operand = name in getattr(config, "positional", ())
                text = option_help(type(config)).get(name, "")[:200].rstrip(".")
                flag = name.upper() if is_operand else _flag(name)
                raise ConfigError(f"{prog} needs {flag} ({text})")


def _inputs(values: Mapping[str, Any], groups: Iterable[Any]) -> Iterator[str | Path]:
    """Every value that names an input: paths, and texts that may be one.

    Other texts name none, though a file or folder may have the same name: `generate "car"`.
    """
    configs = tuple(groups)
    outputs = {name for one in configs for name in getattr(one, "outputs", ("out",))}
    inputs = {name for one in configs for name in getattr(one, "input_texts", ())}
    for name, value in values.items():
        for one in value if isinstance(value, tuple | list) else (value,):
            is_path = isinstance(one, Path) and name not in outputs
            if is_path or (isinstance(one, str) and name in inputs):
                yield one
