"""Docstrings begin with the noun of a textbook, never with an interrogative or a genitive."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
OPENING = re.compile(r"\s*(What|Who|Whose|How|Where|Which|Of)\b")


def test_docstrings_begin_with_a_noun() -> None:
    found = [
        f"{file.relative_to(ROOT)}:{node.lineno}: {text.strip()[:50]}"
        for file in (*ROOT.glob("src/**/*.py"), *ROOT.glob("lab/src/**/*.py"))
        for node in ast.walk(ast.parse(file.read_text()))
        if isinstance(node, ast.Expr) and isinstance(text := getattr(node.value, "value", 0), str)
        if OPENING.match(text)
    ]
    assert found == []
