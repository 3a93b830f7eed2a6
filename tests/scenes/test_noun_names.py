"""No noun of the data is named in Python: what staging needs to know of nouns are their traits."""

import ast
from pathlib import Path

import texvent_scenes
from texvent_scenes.models.nouns import NOUNS

ROOT = Path(texvent_scenes.__file__).parent
OTHER_MEANINGS = {
    *("sink", "slide", "swing", "crane", "truck"),  # motions of bodies and of the camera
    # shapes and words of part lines
    *("ball", "bar", "box", "chain", "cone", "disc", "plank", "wheel", "anchor", "palm"),
    *("glass", "leaf", "marble", "orange"),  # materials and colours
    *("checkerboard", "lamp", "mountain"),  # kinds of pictures, light and backdrops
    *("table", "clock"),  # a trait, the clock of a rig
    *("shirt", "hat", "shorts", "trousers", "dress"),  # parts of every outfit
    "square",  # a waveform
    *("person", "hand"),  # whose bodies are code
}
LEFT_OUT = ("words.py", "raycast")
"""Irregular plurals, and the renderer, which knows no nouns."""


def constants(file: Path) -> set[str]:
    """Texts of a module that are no docstrings."""
    nodes = list(ast.walk(ast.parse(file.read_text(encoding="utf-8"))))
    docs = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
    return {
        node.value
        for node in nodes
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs
    }


def test_no_noun_is_named_in_python() -> None:
    named = {
        str(file.relative_to(ROOT)): names
        for file in ROOT.rglob("*.py")
        if not any(one in file.parts for one in LEFT_OUT)
        if (names := (constants(file) & NOUNS.keys()) - OTHER_MEANINGS)
    }
    assert named == {}
