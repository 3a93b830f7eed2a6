"""Every example in a docstring is true."""

import builtins
import doctest
import importlib
from pathlib import Path

import pytest

SOURCE = Path(__file__).parents[2] / "src"
MODULES = [
    ".".join(path.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__")
    for path in sorted(SOURCE.rglob("*.py"))
    if ">>> " in path.read_text(encoding="utf-8")
]


@pytest.mark.parametrize("name", MODULES)
def test_examples_are_true(name):
    # Not pytest's own collection of doctests: it imports modules its own way and would put the
    # package texvent.generate in the place of the function texvent.generate.
    try:
        result = doctest.testmod(importlib.import_module(name))
    finally:
        vars(builtins).pop("_", None)  # the display hook's leftover, which gettext users trip over
    assert result.attempted > 0
    assert result.failed == 0
