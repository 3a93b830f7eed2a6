"""Writes `src/texvent/options/keywords.py` from the option dataclasses.

    python -m tests.contract.option_keywords

Run it after an option was added, renamed or given another type; a test says when it is due.
"""

from __future__ import annotations

import dataclasses
import subprocess
import sys
import types
import typing
from collections.abc import Iterable
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal

from texvent._registry import GENERATORS, INTERPOLATORS, SIMULATORS
from texvent.config import CaptureConfig, InterpolateConfig, RunConfig
from texvent.generate.video_config import DiffusersConfig

FILE = Path(__file__).parents[2] / "src" / "texvent" / "options" / "keywords.py"
HEAD = '''"""Options of the Python API, for editors and type checkers.

Written by `python -m tests.contract.option_keywords` from the option dataclasses, which say what
each option means; so does `--help all`. None means "not given".
"""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path
from typing import Any, Literal, TypeAlias, TypedDict

from numpy.typing import NDArray

from texvent.sensor import Sensor

Rate: TypeAlias = int | float | str | Fraction
"""24, 29.97 or "30000/1001"."""
SensorName: TypeAlias = str | Path | Sensor | tuple[int, int]
"""A name such as "davis346", (width, height), or a file that `texvent calibrate` wrote."""
Field: TypeAlias = str | Path | NDArray[Any] | Sequence[NDArray[Any]]
"""Files, or an array [N, H, W] or [N, H, W, 2], or N arrays."""
'''
FIELDS = ("motion", "motion_back", "depth", "instances")
"""Options that Python takes as arrays too."""
SCALARS = {bool: "bool", int: "int", float: "float", str: "str", Path: "str | Path"}


def classes() -> dict[str, tuple[str, str, list[type]]]:
    """Name of a TypedDict → its base classes, docstring and the dataclasses that it stands for."""
    simulators = [SIMULATORS.load(name).config_type for name in SIMULATORS.builtin]
    generators = [GENERATORS.load(name).config_type for name in GENERATORS.builtin]
    interpolators = [INTERPOLATORS.load(name) for name in INTERPOLATORS.builtin]
    own = [part.config_type for part in interpolators if hasattr(part, "config_type")]
    return {
        "RunOptions": ("TypedDict", "Options of every run.", [RunConfig]),
        "InterpolateOptions": (
            "TypedDict",
            "Options of the intermediate frames.",
            list(dict.fromkeys([InterpolateConfig, *own])),
        ),
        "SimulatorOptions": ("TypedDict", "Options of all pixel models.", simulators),
        "CaptureOptions": ("TypedDict", "Options of recorded frames.", [CaptureConfig]),
        "GeneratorOptions": (
            "TypedDict",
            "Options of all generators.",
            [*generators, DiffusersConfig],
        ),
        "SimulateOptions": (
            "RunOptions, CaptureOptions, InterpolateOptions, SimulatorOptions",
            "Options of `texvent.simulate`.",
            [],
        ),
        "GenerateOptions": (
            "RunOptions, GeneratorOptions, InterpolateOptions, SimulatorOptions",
            "Options of `texvent.generate`.",
            [],
        ),
    }


def text() -> str:
    """The file, before ruff formats it."""
    parts = [HEAD]
    for name, (bases, about, configs) in classes().items():
        lines = [f"class {name}({bases}, total=False):", f'    """{about}"""', ""]
        if name == "GeneratorOptions":
            lines.append("    generator: str | None")
        lines += [f"    {option}: {kind}" for option, kind in fields(configs).items()]
        parts.append("\n".join(lines).rstrip() + "\n")
    return "\n\n".join(parts)


def fields(configs: Iterable[type]) -> dict[str, str]:
    """Option → type; the union of the types where several configs have an option."""
    found: dict[str, list[str]] = {}
    for config in configs:
        hints = typing.get_type_hints(config)
        for field in dataclasses.fields(config):
            kinds = found.setdefault(field.name, [])
            kinds += [kind for kind in kinds_of(field.name, hints[field.name]) if kind not in kinds]
    return {name: " | ".join([*kinds, "None"]) for name, kinds in found.items()}


def kinds_of(name: str, hint: Any) -> list[str]:
    """The types of a field as text, without None."""
    if name == "sensor":
        return ["SensorName"]
    if name in FIELDS:
        return ["Field"]
    origin, arguments = typing.get_origin(hint), typing.get_args(hint)
    if origin is Literal:
        return [f"Literal[{', '.join(map(repr, arguments))}]"]
    if origin in (typing.Union, types.UnionType):
        return [kind for one in arguments if one is not type(None) for kind in kinds_of(name, one)]
    if origin is tuple:
        return [f"Sequence[{SCALARS[arguments[0]]}]"]
    if hint is Fraction:
        return ["Rate"]
    return [SCALARS[hint]]


def main() -> None:
    """Write the file."""
    FILE.write_text(text(), encoding="utf-8")
    subprocess.run([sys.executable, "-m", "ruff", "format", "-q", str(FILE)], check=True)


if __name__ == "__main__":
    main()
