"""Docstrings begin with the noun of a textbook, never with an interrogative or a genitive."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
OPENING = re.compile(r"\s*(What|Who|Whose|How|Where|Which|Of)\b")
NOT_YET = (
    "scenes",
    "batch",
    "truth",
    "settings",
    "capture",
    "dataset/loading",
    "cli/simulation/batch",
)
"""Rooms and modules of `src/texvent` with older docstrings."""


def test_docstrings_begin_with_a_noun() -> None:
    older = tuple(f"src/texvent/{room}" for room in NOT_YET)
    found = [
        f"{path}:{node.lineno}: {text.strip()[:50]}"
        for file in (*ROOT.glob("src/**/*.py"), *ROOT.glob("lab/src/**/*.py"))
        if not (path := file.relative_to(ROOT).as_posix()).startswith(older)
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.Expr) and isinstance(text := getattr(node.value, "value", 0), str)
        if OPENING.match(text)
    ]
    assert found == []
