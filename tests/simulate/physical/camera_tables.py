"""Writes the tables of `docs/simulators/cameras.md` from the constants of the cameras.

    python -m tests.simulate.physical.camera_tables

Run it after a constant or a default of the model changed; a test says when it is due.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from pathlib import Path

from texvent.simulate.physical.cameras import CAMERAS, Constant, camera_table

PAGE = Path(__file__).parents[3] / "docs" / "simulators" / "cameras.md"


def tables() -> dict[str, str]:
    """Name → table in Markdown, without the comments around it."""
    return {"constants": _constants(), "sources": _sources()}


def _table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    lines = [list(head), *map(list, rows)]
    lines.insert(1, ["---"] * len(lines[0]))
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def _constants() -> str:
    columns = [camera_table(name) for name in CAMERAS]
    rows = ([f"`{same[0].option}`", *map(_cell, same)] for same in zip(*columns, strict=True))
    return _table(["option", *(f"`{name}`" for name in CAMERAS)], rows)


def _cell(constant: Constant) -> str:
    value = constant.value if isinstance(constant.value, str) else f"{constant.value:.6g}"
    value = "curve" if constant.option == "noise_curve" else value
    return f"{value}*" if constant.basis == "unmeasured" else value


def _sources() -> str:
    rows = (
        [f"`{name}`", f"`{one.option}`", one.basis, one.reference]
        for name, camera in CAMERAS.items()
        for one in camera.constants
    )
    return _table(["preset", "option", "basis", "source"], rows)


def main() -> None:
    """Replace the tables of the page, each between two comments with its name."""
    page = PAGE.read_text(encoding="utf-8")
    for name, table in tables().items():
        marks = f"<!-- {name} -->", f"<!-- end of {name} -->"
        pattern = rf"{marks[0]}\n.*?{marks[1]}"
        page, count = re.subn(
            pattern, lambda _, t=table, m=marks: f"{m[0]}\n{t}\n{m[1]}", page, flags=re.DOTALL
        )
        if count != 1:
            raise SystemExit(f"{PAGE} must have {marks[0]} and {marks[1]} once")
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
