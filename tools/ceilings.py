"""Sizes of rooms against their ceilings, as a table; `make lint` runs it.

`ceilings.toml` has a table for each room: its paths, and the most lines of Python, lines of data
and modules that it may have; what it does not name has no ceiling.

Example:
    .venv/bin/python -m tools.ceilings
    .venv/bin/python -m tools.ceilings set       # at a release: 2 % above the sizes of today
"""

from __future__ import annotations

import re
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

ROOT = Path(__file__).parent.parent
TABLE = "tools/ceilings.toml"
DATA = (".toml", ".json", ".csv", ".txt")
"""Endings of files that people edit as data."""
SLACK = 0.02
"""Share of a room's size that its ceilings are above it at a release."""
Ceilings = Mapping[str, Mapping[str, Any]]


class Size(NamedTuple):
    """Size of a room."""

    python: int
    """Lines of Python."""
    data: int
    """Lines of data."""
    modules: int
    """Files of Python."""


def measure(paths: list[str], root: Path = ROOT) -> Size:
    """Size of the files below some paths.

    Raises:
        ValueError: a path is not there.
    """
    python = data = modules = 0
    for path in (root / one for one in paths):
        if not path.exists():
            raise ValueError(f"{TABLE} names {path.relative_to(root)}, which is not there")
        for file in sorted(path.rglob("*")) if path.is_dir() else [path]:
            if file.suffix == ".py":
                modules += 1
                python += _lines(file)
            elif file.suffix in DATA:
                data += _lines(file)
    return Size(python, data, modules)


def faults(ceilings: Ceilings, root: Path = ROOT) -> list[str]:
    """Rooms above their ceilings."""
    found = []
    for room, limits in ceilings.items():
        size = measure(limits["paths"], root)
        for name, now in size._asdict().items():
            most = limits.get(name, now)
            if now > most:
                found.append(f"{room}: {now:,} ({name}); the ceiling is {most:,}")
    return found


def table(ceilings: Ceilings, root: Path = ROOT) -> str:
    """Sizes beside their ceilings, a line for each room."""
    lines = [f"{'room':30}{'lines of Python':>20}{'lines of data':>18}{'modules':>14}"]
    for room, limits in ceilings.items():
        size = measure(limits["paths"], root)._asdict()
        cells = {
            name: f"{now:,} / {limits[name]:,}" if name in limits else f"{now:,}"
            for name, now in size.items()
        }
        lines.append(f"{room:30}{cells['python']:>20}{cells['data']:>18}{cells['modules']:>14}")
    return "\n".join(lines)


def raised(text: str, root: Path = ROOT) -> str:
    """The file of ceilings with each number at `SLACK` above the size of today."""
    lines, sizes = [], dict[str, int]()
    for line in text.splitlines(keepends=True):
        if line.startswith("paths"):
            sizes = measure(tomllib.loads(line)["paths"], root)._asdict()
        name = line.partition(" ")[0]
        if name in sizes:
            line = re.sub(r"\d+", str(int(sizes[name] * (1 + SLACK)) + 1), line)
        lines.append(line)
    return "".join(lines)


def main() -> int:
    """Print the table and its faults, with `set` after new ceilings; returns the exit code."""
    if sys.argv[1:] == ["set"]:
        text = raised((ROOT / TABLE).read_text(encoding="utf-8"))
        (ROOT / TABLE).write_text(text, encoding="utf-8")
    ceilings = tomllib.loads((ROOT / TABLE).read_text(encoding="utf-8"))
    found = faults(ceilings)
    sys.stdout.write("".join(f"{line}\n" for line in [table(ceilings), *found]))
    return 1 if found else 0


def _lines(file: Path) -> int:
    return len(file.read_text(encoding="utf-8").splitlines())


if __name__ == "__main__":
    sys.exit(main())
