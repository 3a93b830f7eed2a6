"""Outcomes of tests: values of their variables, what they call, and the files that they leave.

    KEEP=1 pytest --brief tests/io      # writes those of some tests anew
    KEEP=again pytest --brief tests/io  # leaves out what differs from the run before

A test says what must hold; the table says what else its run made, to the last event, so that
a change is seen which no assertion names. An outcome that differs between two runs is none.
Tests of drawn examples have none, nor have those whose outcomes another table holds.
"""

from __future__ import annotations

import gzip
import inspect
import json
import os
import platform
import sys
from collections.abc import Iterator
from functools import cache
from importlib.metadata import version
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

import pytest

from .marks import UNKNOWN, is_same, joined, mark, marks_of_files

TABLE = Path(__file__).with_name("outcomes.json.gz")
VARIABLE, AGAIN = "KEEP", "again"
NO_VALUE = ("capsys", "monkeypatch", "request", "self", "spawn", "tmp_path", "tmp_path_factory")
"""Arguments of tests that are tools."""
PROGRAM = tuple(f"{Path(__file__).parents[2] / folder}{os.sep}" for folder in ("src", "lab/src"))
MOST_CALLS = 40
"""Calls of a function by a test whose results are kept."""
HAVE_TABLES = (
    *("tests/bounds", "tests/contract", "tests/fuzz", "tests/kept"),
    "tests/runtime/test_array_pool.py",
    *(f"tests/scenes/{one}" for one in ("checks", "golden", "read", "staging", "test_")),
)
"""Tests whose outcomes other tables hold (of staged prompts `tests/scenes/golden`), or that count
who holds a value."""
LIBRARIES = ("numpy", "numba", "opencv-python-headless", "av", "h5py")
ENVIRONMENT = "environment"
"""Row of the table, beside the tests."""
HINT = f"what this test made is not what it made before; if that is meant: {VARIABLE}=1 pytest"
Outcome = dict[str, str]


def environment() -> Outcome:
    """What decides the last digit and the words of libraries: rows hold where it is the same."""
    python = ".".join(platform.python_version_tuple()[:2])
    here = {"python": python, "machine": f"{platform.system()} {platform.machine()}"}
    return here | {name: version(name) for name in LIBRARIES}


def read_table() -> dict[str, Outcome]:
    """Test → name of a variable, of a function and "()", or "/" and a file → mark."""
    return json.loads(gzip.decompress(TABLE.read_bytes())) if TABLE.exists() else {}


def write_table(outcomes: dict[str, Outcome]) -> None:
    """Write the table, the same bytes for the same outcomes."""
    text = json.dumps(dict(sorted(outcomes.items())), separators=(",", ":"))
    TABLE.write_bytes(gzip.compress(text.encode(), mtime=0))


def is_kept(item: pytest.Function) -> bool:
    """Whether a test has an outcome of its own, not of drawn examples or under a debugger."""
    is_drawn, has_table = hasattr(item.obj, "hypothesis"), item.nodeid.startswith(HAVE_TABLES)
    return not is_drawn and not has_table and sys.gettrace() is None


def differences(found: Outcome, kept: Outcome) -> list[str]:
    """Names of what is not as it was; a variable that is gone counts as one of another name."""
    return [
        name
        for name, before in kept.items()
        if before != UNKNOWN
        and (not is_same(found[name], before) if name in found else name.startswith("/"))
    ]


def agreed(found: Outcome, kept: Outcome) -> Outcome:
    """What to keep of a test: of what two runs made, what both made alike."""
    gone = dict.fromkeys(kept.keys() - found.keys(), UNKNOWN)
    return gone | {
        name: one if name in kept and is_same(one, kept[name]) else UNKNOWN
        for name, one in found.items()
    }


@cache
def is_of_program(file: str) -> bool:
    """Whether a source file is one of the packages."""
    return file.startswith(PROGRAM)


class Watch:
    """What a test makes: the variables that it ends with, what the functions of the program that it
    calls return, and the files that it leaves.

    Args:
        code: of the test.
        folder: of its files.
    """

    def __init__(self, code: CodeType, folder: Path | None) -> None:
        self._code, self._folder = code, folder
        self._values: dict[str, Any] = {}
        self._returned: dict[str, list[str]] = {}

    def enter(self, frame: FrameType, _event: str, _value: Any) -> Any:
        """Watch a call if it is the test's, or one of the program by it, unless other tests may
        have made it before."""
        called = frame.f_code
        if called is self._code:
            frame.f_trace_lines = False
            return self._leave_test
        if not is_of_program(called.co_filename) or frame.f_back is None:
            return None
        caller = frame.f_back.f_code.co_qualname
        is_cached = hasattr(frame.f_globals.get(called.co_name), "cache_info")
        if is_cached or not caller.startswith(self._code.co_qualname):
            return None
        frame.f_trace_lines = False
        return self._leave_function

    def _leave_test(self, frame: FrameType, event: str, _: Any) -> Any:
        if event == "return":
            self._values |= frame.f_locals
        return self._leave_test

    def _leave_function(self, frame: FrameType, event: str, value: Any) -> Any:
        if event == "return":
            returned = self._returned.setdefault(frame.f_code.co_qualname, [])
            if len(returned) < MOST_CALLS:
                returned.append(mark(value, str(self._folder)))
        return self._leave_function

    def outcome(self) -> Outcome:
        """The marks of all, by their names."""
        found = {f"{name}()": joined(marks) for name, marks in self._returned.items()}
        for name, value in self._values.items():
            if name not in NO_VALUE and not name.startswith("@"):
                found[name] = mark(value, str(self._folder))
        if self._folder is not None:
            files = marks_of_files(self._folder)
            found |= {f"/{name}": one for name, one in files.items()}
        return found


class KeptOutcomes:
    """Plug-in of pytest that compares outcomes of tests with those of the table."""

    def __init__(self) -> None:
        table = read_table()
        is_here = table.pop(ENVIRONMENT, None) == environment()
        self.kept = table if is_here else {}
        self.found: dict[str, Outcome] = {}

    @pytest.hookimpl(wrapper=True)
    def pytest_pyfunc_call(self, pyfuncitem: pytest.Function) -> Iterator[None]:
        """Run a test; fail if its outcome is another."""
        if not is_kept(pyfuncitem) or not (
            VARIABLE in os.environ or pyfuncitem.nodeid in self.kept
        ):
            return (yield)
        watch = Watch(inspect.unwrap(pyfuncitem.obj).__code__, pyfuncitem.funcargs.get("tmp_path"))
        sys.settrace(watch.enter)
        try:
            result = yield
        finally:
            sys.settrace(None)
        self.judge(pyfuncitem.nodeid, watch.outcome())
        return result

    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        """Turn the order of tests round in the second run: none may depend on those before it."""
        if os.environ.get(VARIABLE) == AGAIN:
            items.reverse()

    def judge(self, name: str, found: Outcome) -> None:
        """Compare an outcome with the table's, or take it for it."""
        if VARIABLE in os.environ:
            self.found[name] = found
        elif wrong := differences(found, self.kept.get(name, {})):
            pytest.fail(f"{', '.join(wrong)}: {HINT} {name}", pytrace=False)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Write the outcomes found, or hand them to the process that runs this one."""
        if hasattr(session.config, "workeroutput"):
            session.config.workeroutput["kept"] = self.found
        elif self.found:
            table = read_table() | {ENVIRONMENT: environment()}
            for name, found in self.found.items():
                kept = table.get(name, found)
                if os.environ[VARIABLE] == AGAIN:
                    table[name] = agreed(found, kept)
                else:
                    odd = {key: one for key, one in kept.items() if one == UNKNOWN}
                    table[name] = found | odd
            write_table(table)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: Any) -> None:
        """Take the outcomes that a worker of pytest-xdist found."""
        self.found |= getattr(node, "workeroutput", {}).get("kept", {})


def pytest_configure(config: pytest.Config) -> None:
    """Compare outcomes, once for all folders of tests."""
    if not config.pluginmanager.has_plugin("kept outcomes"):
        config.pluginmanager.register(KeptOutcomes(), "kept outcomes")
