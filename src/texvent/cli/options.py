"""Flags from config dataclasses, parsed by tyro; wrong ones become one clear line."""

from __future__ import annotations

import contextlib
import dataclasses
import io
import itertools
import re
import typing
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import tyro

from texvent.cli.help import ALL, asked_help, render_help
from texvent.cli.notices import write_out
from texvent.cli.option_types import REQUIRED, SCALARS, without_none
from texvent.cli.wording import name_flags
from texvent.errors import ConfigError, shown
from texvent.io.atomic import protect_inputs
from texvent.options.fields import (
    option_help,
    option_names,
)

MOST_MESSAGE = 240
"""Characters of the parser's messages that are shown."""
LONGEST_HELP = 120
"""Characters of an option's help that an error repeats."""


def parse_options(
    arguments: Sequence[str],
    groups: Mapping[str, Any],
    *,
    prog: str,
    description: str,
    names: Callable[[], Mapping[str, Mapping[str, Sequence[str]]]] = dict,
) -> dict[str, Any]:
    """Values of all options after parsing a command line.

    Args:
        arguments: command-line words after the command's name.
        groups: title → config instance whose values are the defaults that `--help` shows. Class
            attributes name its fields: those in `positional` are given without a flag, those in
            `repeated` several times, those in `short_flags` also have a short one, those in
            `outputs` say what is written ("out" if there is no such attribute); those in
            `input_texts` are texts that may be the path of something read, as a `Path` always is.
            `main_options` of the first group names the options that `--help` alone shows, if there
            are too many for one screen.
        prog: how the command is called.
        description: first lines of its help; indented ones are kept as they are.
        names: gives what help lists below options, as `render_help` takes it.

    Returns:
        Option name → value, every option included.

    Raises:
        ConfigError: a flag that does not exist, or a value of the wrong type.
        SystemExit: `--help` was asked for and shown.
    """
    asked = asked_help(arguments, groups)
    if asked is not None:
        page = render_help(asked, groups, prog=prog, description=description, names=names())
        write_out(page)
        raise SystemExit(0)
    name_flags(groups.values())
    form = dataclasses.make_dataclass(
        "Form", [(title.replace(" ", "_"), _group(group)) for title, group in groups.items()]
    )
    words = list(arguments)
    lists = set(_list_flags(groups.values()))
    _refuse_second_lists(words, lists)
    helps = {name: text for one in groups.values() for name, text in option_help(type(one)).items()}
    parsed = _parse(form, words, prog, helps)
    values: dict[str, Any] = {}
    for part in dataclasses.fields(parsed):
        group = getattr(parsed, part.name)
        values.update({one.name: getattr(group, one.name) for one in dataclasses.fields(group)})
    _refuse_no_values(words, lists, values)
    if "" in map(str.strip, arguments):
        _refuse_empty(values, groups.values())
    protect_inputs(_inputs(values, groups.values()))
    return values


def _parse(form: type, words: Sequence[str], prog: str, helps: Mapping[str, str]) -> Any:
    """An instance of `form`; `helps` says what each option is.

    Raises:
        ConfigError: the parser's message, in one line.
    """
    complaint = io.StringIO()
    try:
        with _registry, contextlib.redirect_stderr(complaint):
            return tyro.cli(
                form, args=words, prog=prog, add_help=False, config=(tyro.conf.OmitArgPrefixes,)
            )
    except SystemExit as stop:
        if not stop.code:
            raise
        message = _plain_message(_first_message(complaint.getvalue()), helps)
        if len(message) > MOST_MESSAGE:
            # It echoes a value; what is allowed comes last.
            message = f"{message[: MOST_MESSAGE // 2]} ... {message[-MOST_MESSAGE // 2 :]}"
        raise ConfigError(f"{message} (see {prog} --help)") from None


def _inputs(values: Mapping[str, Any], groups: Iterable[Any]) -> Iterator[str | Path]:
    """Every value that names what is read: paths, and texts that may be one.

    Other texts name none, though a file or folder may have the same name: `generate "car"`.
    """
    configs = tuple(groups)
    outputs = {name for one in configs for name in getattr(one, "outputs", ("out",))}
    inputs = {name for one in configs for name in getattr(one, "input_texts", ())}
    for name, value in values.items():
        for one in value if isinstance(value, tuple) else (value,):
            is_path = isinstance(one, Path) and name not in outputs
            if is_path or (isinstance(one, str) and name in inputs):
                yield one


def _list_flags(groups: Iterable[Any]) -> Iterator[str]:
    """The flags that take several values at once."""
    for config in groups:
        apart = {*getattr(config, "repeated", ()), *getattr(config, "positional", ())}
        for name, hint in typing.get_type_hints(type(config)).items():
            if typing.get_origin(without_none(hint)) is tuple and name not in apart:
                yield f"--{name.replace('_', '-')}"


def _flag_of(word: str) -> str:
    return word.partition("=")[0].replace("_", "-")


def _refuse_second_lists(words: Sequence[str], lists: Collection[str]) -> None:
    """Refuse a list that is given twice, of which the parser would only take the last.

    Raises:
        ConfigError: see above.
    """
    flags = [_flag_of(word) for word in words]
    for flag in flags:
        if flag in lists and flags.count(flag) > 1:
            raise ConfigError(f"{flag} is given twice; write {flag} A B, all values after one flag")


def _refuse_no_values(
    words: Sequence[str], lists: Collection[str], values: Mapping[str, Any]
) -> None:
    """Refuse the flag of a list without a value, which would do nothing.

    Raises:
        ConfigError: see above.
    """
    for flag in map(_flag_of, words):
        name = flag[2:].replace("-", "_")
        if flag in lists and values[name] == ():
            raise ConfigError(f"{flag} needs at least one value")


def _refuse_empty(values: Mapping[str, Any], groups: Iterable[Any]) -> None:
    """Refuse an empty text for an operand: as a path it would be the current folder.

    Raises:
        ConfigError: see above; the message says what the operand is.
    """
    for group in groups:
        for name in getattr(group, "positional", ()):
            given = values[name] if isinstance(values[name], tuple) else (values[name],)
            if any(str(one).strip() == "" or one == Path() for one in given):
                what = option_help(type(group)).get(name, "")
                raise ConfigError(f"{name.upper()} must not be empty ({what[:200].rstrip('.')})")


def parse_configs(
    arguments: Sequence[str], groups: Mapping[str, Any], *, prog: str, description: str
) -> tuple[Any, ...]:
    """The config instances of `groups`, in order, with the values of a command line.

    Arguments and errors are those of `parse_options`; a config may refuse a value.
    """
    values = parse_options(arguments, groups, prog=prog, description=description)
    return tuple(
        dataclasses.replace(config, **{name: values[name] for name in option_names(type(config))})
        for config in groups.values()
    )


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


def peek_options(arguments: Sequence[str], names: Sequence[str]) -> dict[str, str | None]:
    """The values of a few flags that decide which other flags there are, without checking."""
    flags = {f"--{name.replace('_', '-')}": name for name in names}
    values: dict[str, str | None] = dict.fromkeys(names)
    for word, following in itertools.zip_longest(arguments, arguments[1:]):
        flag, has_value, value = word.partition("=")
        if flag not in flags:
            continue
        if has_value:
            values[flags[flag]] = value
        elif following is not None and not following.startswith("--"):
            # A value may begin with a hyphen ("-3x5"); the parser would take it, so it counts.
            values[flags[flag]] = following
    return values


def _group(config: Any) -> Any:
    """A copy of a config's class whose fields carry help text and the current values."""
    hints = typing.get_type_hints(type(config))
    helps = option_help(type(config))
    positional = getattr(config, "positional", ())
    annotate: Any = Annotated  # the notes are only known at run time, which mypy cannot follow
    required: list[Any] = []
    fields: list[Any] = []
    for field in dataclasses.fields(config):
        short = getattr(config, "short_flags", {}).get(field.name)
        is_positional = field.name in positional
        notes: list[Any] = [
            tyro.conf.arg(
                # A message about a missing option says what it is.
                help=helps.get(field.name, ""),
                aliases=[short] if short else None,
                # Messages tell one word from the other: IN OUT, not PATH PATH.
                metavar=field.name.upper() if is_positional else None,
            )
        ]
        if is_positional:
            notes.append(tyro.conf.Positional)
        if field.name in getattr(config, "repeated", ()):
            notes.append(tyro.conf.UseAppendAction)
        default = dataclasses.field(default=getattr(config, field.name))
        hint = annotate[(hints[field.name], *notes)]
        if default.default is REQUIRED:
            required.append((field.name, hint))
        else:
            fields.append((field.name, hint, default))
    group = dataclasses.make_dataclass(type(config).__name__, [*required, *fields], frozen=True)
    group.__doc__ = (type(config).__doc__ or "").strip()
    return group


_registry = tyro.constructors.ConstructorRegistry()


@_registry.primitive_rule
def _scalar_rule(
    info: tyro.constructors.PrimitiveTypeInfo,
) -> tyro.constructors.PrimitiveConstructorSpec[Any] | None:
    """`FLOAT` instead of `{None}|FLOAT`, exact rates, and messages that say what is expected."""
    hint = without_none(info.type)
    optional = type(None) in typing.get_args(info.type)
    if hint not in SCALARS:
        return None
    kind, convert = SCALARS[hint]

    def read(words: list[str]) -> Any:
        # As a text "none" may be a name: --interpolations none.
        if optional and hint is not str and words[0].lower() == "none":
            return None
        try:
            return convert(words[0])
        except (ValueError, ArithmeticError):
            raise ValueError(f"{shown(words[0])} is not {_EXPECTED[kind]}") from None

    return tyro.constructors.PrimitiveConstructorSpec(
        nargs=1,
        metavar=kind,
        instance_from_str=read,
        is_instance=lambda value: value is None or isinstance(value, (hint, int)),
        str_from_instance=lambda value: ["none" if value is None else str(value)],
    )


_EXPECTED = {
    "INT": "a whole number",
    "FLOAT": "a number",
    "TEXT": "text",
    "PATH": "a path",
    "RATE": "a rate such as 24, 29.97 or 30000/1001",
}


def _first_message(complaint: str) -> str:
    """The message in tyro's box as one line, with its suggestion if it makes one.

    The box is drawn with lines and a title in its frame or, where the output has no such
    characters, with hyphens and the title in a paragraph of its own.
    """
    paragraphs: list[list[str]] = [[]]
    for line in complaint.splitlines():
        text = line.strip("│ ")
        if text.startswith(("╭", "╰")) or not text.strip("─-"):
            paragraphs.append([])
        else:
            paragraphs[-1].append(text)
    filled = [" ".join(" ".join(lines).split()) for lines in paragraphs if lines]
    if "╭" not in complaint:
        filled = filled[1:]
    message = filled[0] if filled else "the options cannot be understood"
    if "nrecog" not in message:
        return message
    if message.endswith(":"):
        return f'{message} an empty text (""); leave it out'
    if not re.search(r": -", message):
        return f"{message}; if they belong to a text or a name, put all of it in quotes"
    close = re.search(r"--[\w-]+", filled[1]) if len(filled) > 1 else None
    is_helpful = close is not None and close[0] != "--help"
    return f"{message}; did you mean {close[0]}?" if close and is_helpful else message


def _plain_message(message: str, helps: Mapping[str, str]) -> str:
    """The parser's message as one that begins with the option and says what it is."""
    wrong = re.match(r"Error parsing (\S+): (.*) is not (.*)", message)
    if wrong:
        what = helps.get(wrong[1].lstrip("-").lower().replace("-", "_"), "").split(". ")[0]
        more = f" ({what.rstrip('.')})" if 0 < len(what) <= LONGEST_HELP else ""
        return f"{wrong[1]} is {wrong[2]}, not {wrong[3]}{more}"
    lacking = re.match(r"Missing value for argument '(\S+)'", message)
    if lacking:
        return f"{lacking[1]} needs a value"
    choice = re.match(
        r"invalid choice (.*) for argument '(\S+)'\. Expected one of \((.*)\)", message
    )
    if choice:
        allowed = choice[3].replace("'", "").rstrip(",")
        return f"{choice[2]} is {choice[1]}; allowed: {allowed}"
    absent = re.match(r"Missing from ([\w ]+): (.*?)\.? \(required\)", message)
    if not absent:
        return message
    flags = re.match(r"(-\S+ [A-Z]+(?:, -\S+ [A-Z]+)*) (.+)", absent[2])
    return f"{absent[1]} needs {f'{flags[1]} ({flags[2]})' if flags else absent[2]}"
