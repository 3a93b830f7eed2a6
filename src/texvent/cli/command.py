"""Words of a command line → resolved settings, for the commands that run a simulation."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from texvent._registry import SIMULATORS
from texvent.cli.options import parse_given, take_options, with_given
from texvent.cli.outputs import OutputOptions
from texvent.generation.subjects import Subject, scenes
from texvent.io.atomic import protect_inputs
from texvent.options.values import option_names
from texvent.run.prepare import open_subject
from texvent.settings.config_files import Command
from texvent.settings.presets import preset_help
from texvent.settings.resolution import DECIDING, Settings, read_basis


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
    find_motion: Callable[[Any], Path | None] = lambda own: None,
    check: Callable[[Settings], None] = lambda defaults: None,
) -> tuple[Settings, Any, Any]:
    """Settings, the command's own options and the output options from a command line.

    The deciding options are taken first: the simulator and the generator that they name have
    options of their own, and the preset and the config file are their defaults in `--help`.

    Args:
        command: "generate" or "simulate".
        arguments: words after the command.
        subject: the command's own config, such as its prompt.
        description: first lines of its help.
        prog: how it is called, where that is not "texvent" and the command.
        output: the output options, where they are not `OutputOptions`.
        find_motion: gives the motion vectors beside the frames that the command's own config
            names, where no option names any.
        check: refuses what the deciding options make of the settings.

    Raises:
        ConfigError: an unknown flag or name, or a value that does not fit.
        SystemExit: `--help` was asked for and shown.
    """
    called = prog or f"texvent {command}"
    names = [name for name in DECIDING if (command, name) != ("simulate", "generator")]
    deciding, rest = take_options(arguments, (*names, "config"), called)
    protect_inputs(text for name, text in deciding.items() if name not in ("simulator", "preset"))
    config = deciding.pop("config", None)
    basis = read_basis(command, deciding, config)
    defaults = basis.defaults
    check(defaults)
    groups = {"input": subject, "output": output or OutputOptions(), **defaults.groups()}
    if "contrast_threshold" not in option_names(type(defaults.simulate)):
        groups["threshold"] = OneThreshold()
    given = parse_given(
        rest,
        groups,
        prog=called,
        description=description,
        presets=dict if prog else preset_help,
        explain=lambda flag: _option_of_others(flag, defaults),
    )
    of_config = {} if config is None else {"config": Path(config)}
    own, output = with_given((subject, groups["output"]), {**deciding, **given, **of_config})
    of_own = {*option_names(type(own)), *option_names(type(output))}
    options = {name: value for name, value in given.items() if name not in of_own}
    return basis.resolve(options, motion_beside=find_motion(own)), own, output


def _option_of_others(flag: str, settings: Settings) -> str | None:
    """Message for a flag of other simulators, with the similar ones of the chosen one."""
    name = flag.removeprefix("--").removeprefix("no-").replace("-", "_")
    owners = [one for one in SIMULATORS.builtin if name in _options_of_simulator(one)]
    if not owners:
        return None
    chosen = settings.run.simulator
    own, words = _options_of_simulator(chosen), {*name.split("_")}
    like = [one.replace("_", "-") for one in own if words & {*one.split("_")}]
    near = f"near: --{', --'.join(like[:3])}; " if like else ""
    return (
        f"{chosen} has no {flag} ({', '.join(owners[:4])} "
        f"{'have' if len(owners) > 1 else 'has'} it); {near}"
        f"all of {chosen}: --simulator {chosen} --help simulate"
    )


def _options_of_simulator(name: str) -> tuple[str, ...]:
    presets = SIMULATORS.load(name).presets
    return option_names(type(next(iter(presets.values()))))


def read_subject(prompt: str, assets: Path | None = None) -> Subject:
    """The prompt, or the scene of a file, which no output may replace; see `open_subject`."""
    if scenes().is_scene_file(prompt):
        protect_inputs([prompt])
    return open_subject(prompt, assets)


def subject_name(prompt: str) -> str:
    """Base of file names: the words of a prompt, or the name of a scene file."""
    return Path(prompt).stem if scenes().is_scene_file(prompt) else prompt
