"""ARCHITECTURE.md lists the layers that import-linter checks."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]


def checked_layers():
    contracts = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["importlinter"]
    layers = next(one["layers"] for one in contracts["contracts"] if one["type"] == "layers")
    return [layer.replace("texvent.", "") for layer in layers]


def documented_layers():
    text = (ROOT / "ARCHITECTURE.md").read_text().partition("## What may import what")[2]
    block = text.partition("```text\n")[2].partition("```")[0]
    return [re.split(r"\s{2,}", line)[0] for line in block.splitlines()]


def test_the_documented_layers_are_those_that_are_checked():
    assert documented_layers() == checked_layers()


def test_every_module_has_a_layer():
    top = {
        path.stem
        for path in (ROOT / "src" / "texvent").iterdir()
        if path.suffix == ".py" or (path / "__init__.py").exists()
    }
    layered = {name for layer in checked_layers() for name in layer.split(" | ")}
    assert top - layered == {"__init__", "__main__", "_version"}
    assert layered - top == {"texvent_lab", "texvent_scenes"}
