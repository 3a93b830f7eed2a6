"""Wrong changes are made in a copy, judged by its tests, and taken back."""

from pathlib import Path

from tools.mutate import NOTICED, ROOT, SURVIVED, Mutation, judge, path_of_test, read_table


def test_a_change_is_judged_and_taken_back(tmp_path: Path) -> None:
    files = {
        "src/texvent/__init__.py": "",
        "src/texvent/part.py": "SEEN = 2\nUNSEEN = 3\n",
        "tests/test_part.py": "from texvent.part import SEEN\ndef test_it(): assert SEEN == 2\n",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    for old, verdict in (("SEEN = 2\n", NOTICED), ("UNSEEN = 3\n", SURVIVED)):
        assert judge(tmp_path, Mutation("", "part.py", old, "\n", ("test_part.py",))) == verdict
    assert {name: (tmp_path / name).read_text() for name in files} == files


def test_every_change_of_the_table_can_be_made() -> None:
    tests = {test.partition("::")[0] for one in read_table() for test in one.tests}
    assert all((ROOT / path_of_test(test)).exists() for test in tests)
