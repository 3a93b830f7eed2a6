"""Every public name has an example, and every example in a docstring is true."""

import builtins
import doctest
import importlib
import inspect
import warnings
from importlib.util import find_spec
from pathlib import Path

import pytest

import texvent

SOURCE = Path(__file__).parents[2] / "src"
MODULES = [
    ".".join(path.relative_to(SOURCE).with_suffix("").parts).removesuffix(".__init__")
    for path in sorted(SOURCE.rglob("*.py"))
    if ">>> " in path.read_text(encoding="utf-8")
]
USED_BY_METHODS = (texvent.EventStream, texvent.EventPackets, texvent.EventCamera)
"""Classes whose methods a user calls."""
FOR_PROGRAMS = {"unchecked", "reporting_to"}
"""Methods for other parts of texvent."""


def public_objects():
    """Name → function or class, of what users call."""
    named = {f"texvent.{name}": getattr(texvent, name) for name in texvent.__all__}
    for module in filter(inspect.ismodule, list(named.values())):
        if module is texvent.training and find_spec("torch") is None:
            continue
        named |= {f"{module.__name__}.{name}": getattr(module, name) for name in module.__all__}
    for kind in USED_BY_METHODS:
        for name, method in inspect.getmembers(kind, callable):
            if not name.startswith("_") and name not in FOR_PROGRAMS:
                named[f"texvent.{kind.__name__}.{name}"] = method
    return {name: one for name, one in named.items() if callable(one)}


def wants_torch(name):
    return name.endswith("to_torch") or name.startswith("texvent.training.")


PUBLIC = public_objects()
HOMES = {f"{one.__module__}.{one.__qualname__}" for one in PUBLIC.values()}


@pytest.fixture(autouse=True)
def new_session(tmp_path, monkeypatch):
    """A folder for what examples write, and nothing left of them afterwards."""
    monkeypatch.chdir(tmp_path)
    with warnings.catch_warnings():
        yield
    vars(builtins).pop("_", None)  # the display hook's leftover, which gettext users trip over


def run(example):
    runner = doctest.DocTestRunner()
    runner.run(example)
    assert runner.summarize(verbose=False).failed == 0


def marked(names):
    return [pytest.param(one, marks=[pytest.mark.torch] * wants_torch(one)) for one in names]


@pytest.mark.parametrize("name", marked(sorted(PUBLIC)))
def test_a_public_name_has_an_example_that_can_be_pasted(name):
    text = inspect.getdoc(PUBLIC[name]) or ""
    example = doctest.DocTestParser().get_doctest(text, {}, name, None, None)
    if wants_torch(name):
        pytest.importorskip("torch")
    assert example.examples, "the docstring has no example"
    run(example)


@pytest.mark.parametrize("name", marked(MODULES))
def test_other_examples_are_true(name):
    if wants_torch(name):
        pytest.importorskip("torch")
    found = doctest.DocTestFinder().find(importlib.import_module(name))
    for example in found:
        if example.name not in HOMES:
            run(example)
