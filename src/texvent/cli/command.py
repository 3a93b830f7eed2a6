"""Words of a command line → resolved settings, for the commands that run a simulation."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from texvent._registry import SIMULATORS
from texvent.cli.options import parse_options, peek_options
from texvent.cli.outputs import OutputOptions
from texvent.cli.wording import name_flags
from texvent.config import RunConfig
from texvent.errors import ConfigError
from texvent.options.fields import option_names
from texvent.settings.presets import preset_help
from texvent.settings.resolution import DECIDING, Command, Settings, apply_options, base_settings


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
    output: Any = None,
) -> tuple[Settings, Any, Any]:
    """Settings, the command's own options and the output options from a command line.

    The deciding options are read first, so that `--help` lists the flags of the simulator and
    generator that were named, with the values of the preset and the config file as defaults.

    Args:
        command: "generate" or "simulate".
        arguments: words after the command.
        subject: the command's own config, such as its prompt.
        description: first lines of its help.
        prog: how it is called, where that is not "texvent" and the command.
        output: the output options, where they are not `OutputOptions`.

    Raises:
        ConfigError: an unknown flag or name, or a value that does not fit.
        SystemExit: `--help` was asked for and shown.
    """
    deciding: dict[str, Any] = peek_options(arguments, (*DECIDING, "config"))
    if command == "simulate":
        deciding.pop("generator")
    name_flags((subject, RunConfig()))
    defaults = base_settings(command, **deciding)
    output = output or OutputOptions()
    groups = {"input": subject, "output": output, **defaults.groups()}
    if "contrast_threshold" not in option_names(type(defaults.simulate)):
        groups["threshold"] = OneThreshold()
    _refuse_options_of_others(arguments, groups, defaults)
    values = parse_options(
        arguments,
        groups,
        prog=prog or f"texvent {command}",
        description=description,
        names=dict if prog else lambda: {"preset": preset_help()},
    )
    own, output = _take(subject, values), _take(output, values)
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


def _refuse_options_of_others(
    arguments: Sequence[str], groups: Mapping[str, Any], settings: Settings
) -> None:
    """Refuse a flag that other simulators have, naming those and the like ones of the chosen one.

    Raises:
        ConfigError: there is such a flag.
    """
    known = {name for group in groups.values() for name in option_names(type(group))}
    for word in arguments:
        name = word.partition("=")[0].removeprefix("--").removeprefix("no-").replace("-", "_")
        if not word.startswith("--") or name in known:
            continue
        owners = [one for one in SIMULATORS.builtin if name in _options_of_simulator(one)]
        if owners:
            chosen = settings.run.simulator
            own, words = _options_of_simulator(chosen), {*name.split("_")}
            like = [one.replace("_", "-") for one in own if words & {*one.split("_")}]
            near = f"near: --{', --'.join(like[:3])}; " if like else ""
            raise ConfigError(
                f"{chosen} has no --{name.replace('_', '-')} ({', '.join(owners[:4])} "
                f"{'have' if len(owners) > 1 else 'has'} it); {near}"
                f"all of {chosen}: --simulator {chosen} --help simulate"
            )


def _options_of_simulator(name: str) -> tuple[str, ...]:
    presets = SIMULATORS.load(name).presets
    return option_names(type(next(iter(presets.values()))))


def _take(config: Any, values: dict[str, Any]) -> Any:
    """A copy of `config` with its values, which are removed from `values`."""
    names = [field.name for field in dataclasses.fields(config)]
    return dataclasses.replace(config, **{name: values.pop(name) for name in names})
