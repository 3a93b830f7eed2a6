"""Every option of the commands that work for hours reaches the work, and progress is told."""

import dataclasses
import re
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args, get_origin, get_type_hints

import pytest

from texvent.cli.app import main
from texvent_lab.commands.bench import detection, digits, fidelity, objects, real

from ..bench.objects.stand_in import write_specifications

CARS = """
name = "cars"
truth = ["boxes"]
splits = { train = 0.34, val = 0.33, test = 0.33 }
options = { duration = 0.1, sensor = "64x48", samples = 1, interpolate = "none" }
sources = [{ prompts = ["a red car drives left", "a red bus drives left", "a red van stops"] }]
variants = { paper = {}, esim = { simulator = "esim" } }
"""


class ReachedError(Exception):
    """The work was called."""


class Long(NamedTuple):
    """A command that works for long."""

    words: str
    work: str
    """Function that does the work, below texvent_lab."""
    options: type
    tries: dict[str, str]
    """Other values where the type does not say one."""
    others: tuple[str, ...] = ("write_frames",)
    """Options of other work, or of what is made of the result."""
    more: tuple[str, ...] = ()
    """Functions beside it that need what is not here; their arguments count too."""


LONG = {
    "detection": Long(
        "bench detection s.toml --work w", "bench.detection.run.run_detection",
        detection.DetectionOptions,
        {"arms": "paper", "specification": "t.toml"}, more=("commands.bench.detection.require",),
    ),
    "digits": Long(
        "bench digits --mnist m --nmnist n --work w", "commands.bench.digits.run_digits",
        digits.DigitsOptions,
        {"arms": "esim", "ways": "frames"},
    ),
    "objects": Long(
        "bench objects c --frames f --turntables t --work w", "bench.objects.run.run_objects",
        objects.ObjectsOptions, {"arms": "esim", "events": "a=c", "configs": "d"},
    ),
    "fidelity": Long(
        "bench fidelity", "commands.bench.fidelity.run_fidelity", fidelity.FidelityOptions,
        {"simulators": "esim", "interpolations": "blend", "scenes": "mixed"},
        ("events", "write_frames"),
    ),
    "real": Long(
        "bench real a", "commands.bench.real.run_real", real.RealOptions,
        {"simulators": "esim", "interpolations": "blend", "sources": "b"},
        ("events", "write_frames", "network", "weights", "config", "baseline", "match_rate"),
        ("commands.bench.real.open_scene",),
    ),
}  # fmt: skip


OF_TORCH = ("detection", "objects")


def write_inputs(folder: Path) -> None:
    """Specifications that plans are read from."""
    for name in "cd":
        write_specifications(folder / name)
    for name in "st":
        (folder / f"{name}.toml").write_text(CARS.replace("0.1", "0.2") if name == "t" else CARS)


def facts(value: Any) -> Any:
    """Plain values of the arguments of a call."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {one.name: facts(getattr(value, one.name)) for one in dataclasses.fields(value)}
    if isinstance(value, dict):
        return {str(name): facts(one) for name, one in value.items()}
    if isinstance(value, list | tuple):
        return [facts(one) for one in value]
    return re.sub(r" at 0x\w+", "", repr(value))


def other_words(one: dataclasses.Field[Any], kind: Any, long: Long) -> tuple[str, str]:
    """The command line, and one that gives an option another value."""
    kinds, name = [kind, *get_args(kind)], one.name
    if name in long.tries:
        value = long.tries[name]
    elif get_origin(kind) is Literal:
        value = next(other for other in get_args(kind) if other != one.default)
    elif bool in kinds:
        value = ""
    elif int in kinds:
        value = (one.default or 0) + 7
    elif float in kinds:
        value = (one.default or 0.0) + 1.5
    else:
        assert Path in kinds, f"{name} needs a value to try"
        value = "other"
    if name in getattr(long.options, "positional", ()):
        group, command, _, *rest = long.words.split(" ", 3)
        return long.words, " ".join([group, command, str(value), *rest])
    flag = f"--{name.replace('_', '-')}"
    return long.words, f"{long.words} {flag}={value}" if value != "" else f"{long.words} {flag}"


@pytest.mark.parametrize(
    "name", [pytest.param(one, marks=pytest.mark.torch if one in OF_TORCH else ()) for one in LONG]
)
def test_every_option_of_a_long_command_reaches_its_work(name, tmp_path, monkeypatch, capsys):
    if name in OF_TORCH:
        pytest.importorskip("torch")
        write_inputs(tmp_path)
    long, calls = LONG[name], list[Any]()
    monkeypatch.chdir(tmp_path)

    def note(*given: Any, **named: Any) -> None:
        told = named.pop("progress", None)
        calls.append(facts([given, named]))
        if told is not None:
            told("a step is done")
            raise ReachedError

    for function in (long.work, *long.more):
        monkeypatch.setattr(f"texvent_lab.{function}", note)

    def reached(words: str) -> Any:
        calls.clear()
        with pytest.raises(ReachedError):
            main(words.split())
        assert ("a step is done" in capsys.readouterr().err) is ("--quiet" not in words)
        return list(calls)

    usual = reached(long.words)
    assert reached(f"{long.words} --quiet -o new.json") == usual
    kinds = get_type_hints(long.options)
    for one in dataclasses.fields(long.options):
        if one.name not in long.others:
            before, after = other_words(one, kinds[one.name], long)
            assert reached(after) != reached(before), one.name
