"""Wrong changes that are drawn: they differ, they compile, and a seed repeats them."""

from pathlib import Path

import pytest
from tools.mutate import NOTICED, SURVIVED, judge_drawn, judge_together, wilson_interval
from tools.wrong_changes import changes_of, draw, is_wrong, near_tests

EXAMPLES = {
    "a = b + c": "a = b - c",
    "a = b <= c": "a = b < c",
    "a = b is not c": "a = b is c",
    "a = é and c": "a = é or c",
    "a -= b": "a += b",
    "a = not b": "a = (b)",
    "a = 0.25": "a = 0.5",
    "a = False": "a = True",
    "a = f(b, c, d)": "a = f(b, d, c)",
    "a = f(b, c=d)": "a = f(b)",
    "a = f(axis=1, c=d)": "a = f( c=d)",
    "a = np.floor(b)": "a = np.ceil(b)",
    "a = size.width": "a = size.height",
    "self.a = b": "pass",
    "for a in b:\n    continue": "for a in b:\n    pass",
    "if b: c()": "if (not (b)): c()",
    "a = [b for b in c if b.d]": "a = [b for b in c if (not (b.d))]",
    "a = b[:count]": "a = b[:count + 1]",
    "a = b[i]": "a = b[i + 1]",
    "def a() -> bool:\n    return b": "def a() -> bool:\n    return not (b)",
    "def a():\n    return b, c": "def a():\n    return b, c",
    "def a() -> T:\n    return b, c": "def a() -> T:\n    return (c, b)",
    "def a(b=0): ...": "def a(b=1): ...",
}


@pytest.mark.parametrize("text", EXAMPLES)
def test_changes_are_those_by_hand_and_every_one_that_is_drawn_compiles(text: str) -> None:
    changes = [one for one in changes_of("a.py", text) if is_wrong(one, text)]
    made = [one.applied(text) for one in changes] or [text]
    assert EXAMPLES[text] in made
    assert all(text.splitlines()[one.line - 1] not in one.applied(text) for one in changes)


@pytest.mark.parametrize(
    "text",
    [
        '"""Words."""',
        "raise ValueError(1 + 2)",
        "a = InputError(f'{a + 1}')",
        "def a(b: Literal[1]) -> Literal[2]: ...",
        "@b(c=1)\ndef a(): ...",
        "def a(): return np.hypot(b, c)",
        "a = zip(b, b, strict=True)",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    a = 1",
    ],
)
def test_words_and_annotations_are_left_alone(text: str) -> None:
    assert changes_of("a.py", text) == []


BRIEF = """
from hypothesis import settings
settings.register_profile("brief")
def pytest_addoption(parser): parser.addoption("--brief", action="store_true")
"""
TABLE = """
from pathlib import Path
def test_it(): assert Path("lab/src/texvent_lab/run.py").read_text() == "C = 1\\n"
"""


@pytest.fixture
def tree(tmp_path: Path) -> Path:
    files = {
        "src/texvent/__init__.py": "",
        "src/texvent/big/__init__.py": "from texvent.big.part import seen\n",
        "src/texvent/big/part.py": "def seen(): return 2\n" + "UNSEEN = 3\n" * 20,
        "src/texvent/user.py": "from texvent.big import seen\n",
        "src/texvent/small/part.py": "A = 1\n",
        "src/texvent_scenes/read/part.py": "B = 1\n",
        "tests/conftest.py": BRIEF,
        "tests/big/test_other.py": "",
        "tests/big/test_part.py": "def test_that_fails_always(): assert False\n",
        "tests/test_direct.py": "import texvent.big.part\n",
        "tests/small/test_small.py": "",
        "tests/scenes/read/test_read.py": "",
        "lab/src/texvent_lab/run.py": "C = 1\n",
        "lab/tests/test_run.py": "def test_it(): pass\n",
        "tests/bounds/test_bounds.py": TABLE,
        "tests/test_user.py": "from texvent.user import seen\ndef test_it(): assert seen() == 2\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    return tmp_path


def test_a_seed_repeats_its_draw_and_rooms_have_their_share(tree: Path) -> None:
    drawn = draw(22, 5, tree)
    assert drawn == draw(22, 5, tree) != draw(22, 6, tree)
    assert len(set(drawn)) == 22
    assert sum(one.file == "small/part.py" for one in drawn) == 1
    assert {one.file for one in draw(3, 5, tree, ["small"])} == {"small/part.py"}
    assert {one.file for one in draw(2, 5, tree, ["texvent_lab"])} == {"texvent_lab/run.py"}
    assert {one.line for one in draw(9, 5, tree, lines={"big/part.py": {1}})} == {1}


def test_tests_are_those_of_the_file_of_its_folder_and_of_who_imports_it(tree: Path) -> None:
    names = ("big/test_part", "test_direct", "test_user", "big/test_other")
    near = [f"tests/{name}.py" for name in names]
    assert near_tests("big/part.py", tree) == near
    assert near_tests("texvent_scenes/read/part.py", tree) == ["tests/scenes/read/test_read.py"]
    assert near_tests("texvent_lab/run.py", tree) == ["lab/tests/test_run.py"]


def test_tests_of_who_imports_it_farther_off_or_by_a_name_in_a_text_follow(tree: Path) -> None:
    files = {
        "src/texvent/deep/gpu/part.py": "A = 1\n",
        "src/texvent/deep/engine.py": 'import_module(f"texvent.deep.{name}.part")\n',
        "src/texvent/registry.py": 'PARTS = {"deep": "texvent.deep.engine:Engine"}\n',
        "tests/test_registry.py": "import texvent.registry\n",
    }
    for name, text in files.items():
        (tree / name).parent.mkdir(parents=True, exist_ok=True)
        (tree / name).write_text(text)
    assert "tests/test_registry.py" in near_tests("deep/gpu/part.py", tree)


def test_tests_that_share_rare_words_are_near_in_other_packages_too(tree: Path) -> None:
    names = [*(f"read/test_{n}.py" for n in range(20)), "staging/test_zebra.py"]
    (tree / "tests/scenes/staging").mkdir()
    for name in names:
        (tree / "tests/scenes" / name).write_text("")
    (tree / "src/texvent_scenes/read/part.py").write_text("ZEBRA = 1\n")
    (tree / "tests/scenes" / names[-1]).write_text("zebra = 1\n")
    assert f"tests/scenes/{names[-1]}" in near_tests("texvent_scenes/read/part.py", tree)


@pytest.mark.long
def test_a_test_that_fails_without_the_change_judges_nothing(tree: Path) -> None:
    changes = changes_of("big/part.py", (tree / "src/texvent/big/part.py").read_text())
    change, survivor = (next(one for one in changes if one.line == line) for line in (1, 9))
    failing: set[str] = set()
    by = "tests/test_user.py::test_it"
    assert judge_drawn(tree, change, failing) == (NOTICED, by)
    assert failing == {"tests/big/test_part.py::test_that_fails_always"}
    assert judge_drawn(tree, survivor, failing)[0] == SURVIVED
    far, *_ = changes_of("texvent_lab/run.py", "C = 1\n")
    assert judge_drawn(tree, far, failing) == (NOTICED, "tests/bounds/test_bounds.py::test_it")


@pytest.mark.long
def test_changes_that_are_made_together_are_noticed_one_by_one(tree: Path) -> None:
    changes = changes_of("big/part.py", (tree / "src/texvent/big/part.py").read_text())
    first, survivor = (next(one for one in changes if one.line == line) for line in (1, 9))
    other, *_ = changes_of("small/part.py", "A = 1\n")
    judged = judge_together(tree, [survivor, other, first], failing := set())
    found = {one: verdict for one, *verdict in judged}
    assert found[first] == [NOTICED, "tests/test_user.py::test_it"]
    assert {found[one][0] for one in (survivor, other)} == {SURVIVED}
    assert failing == {"tests/big/test_part.py::test_that_fails_always"}


def test_the_interval_is_that_of_the_formula_by_hand() -> None:
    # 8 of 10: (8 + 1.92) / (10 + 3.84) = 0.717 and 1.96 / 13.84 * sqrt(1.6 + 0.96) = 0.227.
    assert wilson_interval(8, 10) == pytest.approx((0.490, 0.943), abs=1e-3)
    assert wilson_interval(0, 0) == (0, 1)
