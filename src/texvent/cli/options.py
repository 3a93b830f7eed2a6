"""Command lines: flags made from config dataclasses, parsed by argparse; errors are one line."""

from __future__ import annotations

import argparse
import dataclasses
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from texvent._registry import nearest
from texvent.cli.help import asked_help, first_sentence, help_page
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED, Option, declared_options, flag_of
from texvent.config import warn_of_idle
from texvent.errors import ConfigError, shown
from texvent.io.atomic import protect_inputs
from texvent.options.values import SCALARS, option_names

LONGEST_HELP = 120
"""Characters of an option's help that an error repeats."""
Explain = Callable[[str], str | None]
Presets = Callable[[], Mapping[str, Sequence[str]]]


def parse_given(
    arguments: Sequence[str],
    groups: Mapping[str, Any],
    *,
    prog: str,
    description: str,
    presets: Presets = dict,
    explain: Explain = lambda flag: None,
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
        page = help_page(asked, groups, prog=prog, description=description, presets=presets())
        write_out(page)
        raise SystemExit(0)
    options = [one for config in groups.values() for one in declared_options(config)]
    parser = _parser()
    for option in options:
        if not option.is_operand:
            _add_option(parser, option)
    given, rest, operands = _parse(parser, arguments, prog)
    unknown = next((word for word in rest if _is_flag(word)), None)
    if unknown is not None:
        flag = unknown.partition("=")[0]
        known = [one for option in options if not option.is_operand for one in option.flags]
        raise ConfigError(explain(flag) or _unknown_flag(flag, known, prog))
    given.update(_read_operands([*rest, *operands], options, prog))
    for option in options:
        if option.default is REQUIRED and option.name not in given:
            text = option.text[:200].rstrip(".")
            raise ConfigError(f"{prog} needs {option.flags[-1]} ({text})")
    defaults = {option.name: option.default for option in options}
    _refuse_dashes(given, prog)
    protect_inputs(_inputs({**defaults, **given}, groups.values()))
    return given


def parse_configs(
    arguments: Sequence[str], groups: Mapping[str, Any], *, prog: str, description: str
) -> tuple[Any, ...]:
    """The config instances of `groups`, in order, with the values of a command line.

    Arguments and errors are those of `parse_given`; a config may refuse a value.
    """
    given = parse_given(arguments, groups, prog=prog, description=description)
    configs = tuple(with_given(config, given) for config in groups.values())
    warn_of_idle(configs, given)
    return configs


def with_given(config: Any, given: Mapping[str, Any]) -> Any:
    """A copy of a config with those of its options that were given."""
    own = {name: given[name] for name in option_names(type(config)) if name in given}
    return dataclasses.replace(config, **own)


def take_options(
    arguments: Sequence[str], names: Sequence[str], prog: str
) -> tuple[dict[str, str], list[str]]:
    """The texts of a few options that decide which others there are, and all other words."""
    parser = _parser()
    for name in names:
        parser.add_argument(flag_of(name), dest=name)
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


def _refuse_dashes(given: Mapping[str, Any], prog: str) -> None:
    """Refuse `-` as the name of a file: only a video can come from standard input.

    Raises:
        ConfigError: a path is `-`.
    """
    for name, value in given.items():
        for one in value if isinstance(value, tuple | list) else (value,):
            if isinstance(one, Path) and str(one) == "-":
                raise ConfigError(
                    f"{prog}: {name} is -; standard input and output are not read or written as "
                    "files; give the name of a file"
                )


def _with_hyphens(word: str) -> str:
    """`--white_level=1` as `--white-level=1`: options are spelt with `_` in files and Python."""
    flag, equals, value = word.partition("=")
    return f"{flag.replace('_', '-')}{equals}{value}" if flag.startswith("--") else word


def _is_flag(word: str) -> bool:
    return word.startswith("-") and len(word) > 1 and " " not in word and not word[1].isdigit()


def _add_option(parser: argparse.ArgumentParser, option: Option) -> None:
    more: dict[str, Any] = {"type": _reader(option)}
    if option.hint is bool:
        more = {"action": argparse.BooleanOptionalAction}
    elif option.is_list:
        more.update(action="extend", nargs="+")
    parser.add_argument(*option.flags, dest=option.name, **more)


def _reader(option: Option) -> Callable[[str], Any]:
    """Converter of a word to a value of an option."""
    purpose = first_sentence(option.text).rstrip(".")
    more = f" ({purpose})" if 0 < len(purpose) <= LONGEST_HELP else ""

    def read(word: str) -> Any:
        # As a text "none" may be a name: --interpolate none.
        is_none = option.is_optional and option.hint is not str and word.lower() == "none"
        if is_none and word not in option.choices:
            return None
        if option.choices:
            if word in map(str, option.choices):
                return next(one for one in option.choices if str(one) == word)
            allowed = ", ".join(map(str, option.choices))
            raise argparse.ArgumentTypeError(f"{shown(word)} is not allowed; allowed: {allowed}")
        kind = SCALARS[option.hint]
        try:
            return kind.read(word)
        except (ValueError, ArithmeticError):
            message = f"{shown(word)} is not {kind.words}{more}"
            raise argparse.ArgumentTypeError(message) from None

    return read


def _unknown_flag(flag: str, known: Sequence[str], prog: str) -> str:
    names = {one.lstrip("-"): one for one in known}
    close = nearest(flag.lstrip("-"), tuple(names))
    hint = f"; did you mean {names[close]}?" if close else ""
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
            text = option.text[:200].rstrip(".")
            raise ConfigError(f"{option.flags[0]} must not be empty ({text})")
        try:
            values = tuple(map(_reader(option), own))
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
