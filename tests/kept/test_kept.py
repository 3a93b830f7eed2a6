"""Outcomes of tests are kept: what differs fails a test that asserts nothing of it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.kept.marks import UNKNOWN, WITHIN, is_same, joined, mark
from tests.kept.plugin import ENVIRONMENT, VARIABLE, agreed, differences, read_table

PROGRAM = "def double(x): return 2 * x\n"
TEST = """import random
from part import double
def test_it(tmp_path):
    left = tmp_path / "left.txt"
    left.write_text(str([double(x) for x in (1, 2)]))
    chance = random.random()
    later = double(3) * 0.5
"""
ROOT = Path(__file__).parents[2]


@dataclass
class Pair:
    one: object
    other: object


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text() | st.binary() | st.floats(-1e9, 1e9),
    lambda inner: (
        st.lists(inner) | st.tuples(inner) | st.dictionaries(st.text(), inner)
        | st.builds(Pair, inner, inner)
    ),
)  # fmt: skip


@given(VALUES, VALUES)
def test_a_mark_is_that_of_its_value(one, other):
    assert is_same(mark(one, "-"), mark(one, "-"))
    assert not is_same(mark([one, other], "-"), mark([one, other, other], "-"))
    assert not is_same(mark({1: one}, "-"), mark({2: one}, "-"))


@pytest.mark.parametrize("dtype", [np.uint8, np.int64, np.float32, np.float64, bool, object])
def test_a_mark_tells_one_element_of_an_array_from_another(dtype):
    values = np.zeros((3, 4), dtype)
    marks = [mark(values, ""), mark(values.T, "")]
    for at in np.ndindex(values.shape):
        changed = values.copy()
        changed[at] = 1
        marks.append(mark(changed, ""))
    assert not any(is_same(one, other) for i, one in enumerate(marks) for other in marks[:i])


def test_floats_may_differ_in_their_last_digits_and_folders_by_their_names():
    value = {"a": np.linspace(1, 2, 9), "b": 3.0}
    near = {"a": value["a"] * (1 + WITHIN / 30), "b": 3.0}
    far = {"a": value["a"] * (1 + WITHIN * 30), "b": 3.0}
    assert is_same(mark(near, ""), mark(value, ""))
    assert not is_same(mark(far, ""), mark(value, ""))
    assert is_same(joined([mark(near, ""), "x"]), joined([mark(value, ""), "x"]))
    assert not is_same(joined([mark(far, ""), "x"]), joined([mark(value, ""), "x"]))
    assert mark(Path("/here/a"), "/here") == mark(Path("/there/a"), "/there")
    nested = [1] * 10
    for _ in range(9):
        nested = [nested] * 10
    assert mark(nested, "") == UNKNOWN
    assert mark([np.nan, 1.0], "") != mark([1.0, np.nan], "") != mark([np.inf, 1.0], "")


def test_a_file_that_is_gone_is_a_difference_and_a_name_that_is_gone_is_none():
    kept = {"name": "a", "/file": "b", "chance": UNKNOWN}
    assert differences({"chance": "c"}, kept) == ["/file"]
    assert differences({"name": "c", "/file": "b", "new": "d"}, kept) == ["name"]
    assert agreed({"name": "a", "new": "d"}, kept) == {
        "name": "a", "/file": UNKNOWN, "chance": UNKNOWN, "new": UNKNOWN,
    }  # fmt: skip
    assert agreed(kept, kept) == kept


def test_the_table_is_of_tests_that_are_there():
    files = {name.partition("::")[0] for name in read_table() if name != ENVIRONMENT}
    assert not [one for one in files if not (ROOT / one).exists()]


@pytest.mark.long
def test_a_test_fails_when_what_it_made_is_not_what_it_made_before(tmp_path):
    for name, text in {
        "src/part.py": PROGRAM,
        "tests/test_it.py": TEST,
        "tests/conftest.py": "from tests.kept.plugin import pytest_configure\n",
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text)
    shutil.copytree(Path(__file__).parent, tmp_path / "tests" / "kept",
                    ignore=shutil.ignore_patterns("test_*", "*.gz", "__pycache__"))  # fmt: skip

    def run(keep=None):
        paths = os.pathsep.join((str(tmp_path), str(tmp_path / "src")))
        environment = {**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1"}
        environment = {key: one for key, one in environment.items() if key != VARIABLE}
        words = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "tests"]
        environment |= {VARIABLE: keep} if keep else {}
        done = subprocess.run(
            words, cwd=tmp_path, env=environment, capture_output=True, text=True, check=False
        )
        return done.returncode, done.stdout

    assert [run(keep)[0] for keep in ("1", "again", None)] == [0, 0, 0]
    (tmp_path / "src" / "part.py").write_text(PROGRAM.replace("2", "3"))
    code, said = run()
    assert code == 1
    assert "double(), later, /left.txt: what this test made" in said
    (tmp_path / "src" / "part.py").write_text(PROGRAM)
    assert run()[0] == 0
