"""Words of a command line → resolved settings, for the commands that run a simulation."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from texvent.cli.options import parse_options, peek_options
from texvent.cli.outputs import OutputOptions
from texvent.options.fields import option_names
from texvent.run.settings import DECIDING, Command, Settings, apply_options, base_settings


@dataclass(frozen=True, kw_only=True)
class OneThreshold:
    """For a simulator that names its thresholds otherwise."""

    contrast_threshold: float | None = None
    """Sets the thresholds of ON and OFF together; their ratio stays as it is."""


def resolve_command(
    command: Command,
    arguments: Sequence[str],
    subject: Any,
    *,
    description: str,
    prog: str | None = None,
) -> tuple[Settings, Any, OutputOptions]:
    """Settings, the command's own options and the output options from a command line.

    The deciding options are read first, so that `--help` lists the flags of the simulator and
    generator that were named, with the values of the preset and the config file as defaults.

    Args:
        command: "generate" or "simulate".
        arguments: words after the command.
        subject: the command's own config, such as its prompt.
        description: first lines of its help.
        prog: how it is called, where that is not "texvent" and the command.

    Raises:
        ConfigError: an unknown flag or name, or a value that does not fit.
        SystemExit: `--help` was asked for and shown.
    """
    deciding = peek_options(arguments, (*DECIDING, "config"))
    if command == "simulate":
        deciding.pop("generator")
    defaults = base_settings(command, **deciding)
    groups = {"input": subject, "output": OutputOptions(), **defaults.groups()}
    if "contrast_threshold" not in option_names(type(defaults.simulate)):
        groups["threshold"] = OneThreshold()
    values = parse_options(
        arguments, groups, prog=prog or f"texvent {command}", description=description
    )
    own, output = _take(subject, values), _take(OutputOptions(), values)
    shown = {
        name: getattr(group, name)
        for title, group in groups.items()
        if title not in ("input", "output")
        for name in option_names(type(group))
    }
    given = {name: value for name, value in values.items() if value != shown[name]}
    for name in DECIDING:  # they have had their effect; a sensor file is a size by now
        given.pop(name, None)
    return apply_options(defaults, given, where="options"), own, output


def _take(config: Any, values: dict[str, Any]) -> Any:
    """A copy of `config` with its values, which are removed from `values`."""
    names = [field.name for field in dataclasses.fields(config)]
    return dataclasses.replace(config, **{name: values.pop(name) for name in names})
