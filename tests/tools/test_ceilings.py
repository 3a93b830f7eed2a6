"""Rooms are measured, and refused above their ceilings."""

from pathlib import Path

import pytest
from tools.ceilings import Size, faults, measure, raised, table


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    (tmp_path / "room" / "data").mkdir(parents=True)
    (tmp_path / "room" / "a.py").write_text("x = 1\n\ny = 2\n")
    (tmp_path / "room" / "data" / "words.toml").write_text("a = 1\nb = 2\n")
    (tmp_path / "room" / "notes.md").write_text("not counted\n")
    return tmp_path


def ceilings(python: int = 3, data: int = 2, modules: int = 1) -> dict[str, dict[str, object]]:
    return {"room": {"paths": ["room"], "python": python, "data": data, "modules": modules}}


def test_lines_and_modules_are_counted(tree: Path) -> None:
    assert measure(["room"], tree) == Size(3, 2, 1)
    assert measure(["room/a.py"], tree) == Size(3, 0, 1)
    assert "3 / 3" in table(ceilings(), tree)


def test_a_room_above_its_ceiling_is_named(tree: Path) -> None:
    assert faults(ceilings(data=1), tree) == ["room: 2 (data); the ceiling is 1"]


def test_new_ceilings_are_two_per_cent_above_the_sizes(tree: Path) -> None:
    (tree / "room" / "b.py").write_text("x = 1\n" * 997)
    text = '# Rooms.\n["room"]\npaths = ["room"]\npython = 7\nmodules = 1\n'
    new = '# Rooms.\n["room"]\npaths = ["room"]\npython = 1021\nmodules = 3\n'
    assert raised(text, tree) == new
