"""The ledger of a folder against a dictionary: what is noted, complete, damaged and dropped."""

import tempfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import FileFormatError
from texvent.run.ledger import FILES, Ledger, describe_differences

KEYS = st.sampled_from("abc")
STEPS = st.one_of(
    st.tuples(st.just("add"), KEYS, st.integers(1, 3)),
    st.tuples(st.just("change"), KEYS, st.integers(0, 2), st.sampled_from([None, "other"])),
    st.tuples(st.sampled_from(["begin", "forget"]), KEYS),
    st.tuples(st.sampled_from(["open", "cut_off"])),
)


class Folder:
    """A folder with a ledger, and what the ledger should say."""

    def __init__(self, path: Path) -> None:
        self.path, self.rows, self.changed, self.written = path, dict[str, int](), set[Path](), 0
        self.open()

    def open(self) -> None:
        self.ledger = Ledger(self.path / "ledger", remedy="name another")

    def files(self, key: str, count: int) -> list[Path]:
        return [self.path / f"{key}{number}" for number in range(count)]

    def add(self, key: str, count: int) -> None:
        files = self.files(key, count)
        for file in files:
            self.written += 1
            file.write_text("x" * self.written)
        self.ledger.add(key, files, note=count)
        self.rows[key], self.changed = count, self.changed - {*files}

    def begin(self, key: str) -> None:
        self.ledger.begin([key])
        self.rows[key] = 0

    def forget(self, key: str) -> None:
        if self.rows.pop(key, None) is not None:
            self.ledger.forget([key])
            self.ledger.write()

    def cut_off(self) -> None:
        """A line as a power failure leaves it, and what a run does first."""
        with (self.path / "ledger").open("a") as file:
            file.write('{"key": "a", "no')
        self.open()
        self.ledger.write()

    def change(self, key: str, number: int, text: str | None) -> None:
        place = self.path / f"{key}{number}"
        if place.exists():
            place.unlink() if text is None else place.write_text(text)
            self.changed.add(place)

    def check(self) -> None:
        assert set(self.ledger) == set(self.rows)
        for key, count in self.rows.items():
            is_whole = not self.changed & {*self.files(key, count)}
            row = self.ledger.row(key)
            assert self.ledger.is_complete(key) is (count > 0 and is_whole)
            assert (row.get("note", 0), len(row.get(FILES, ()))) == (count, count)


@given(st.lists(STEPS, max_size=12))
def test_results_are_complete_while_all_of_their_files_are_as_they_were(steps):
    with tempfile.TemporaryDirectory() as name:
        folder = Folder(Path(name))
        for action, *given in steps:
            getattr(folder, action)(*given)
            folder.check()


@given(
    st.dictionaries(st.sampled_from("abcdef"), st.integers(0, 2)),
    st.dictionaries(st.sampled_from("abcdef"), st.integers(0, 2)),
)
def test_at_most_three_differences_are_named_and_the_others_counted(old, new):
    told = describe_differences({"run": old}, {"run": new}, name_of=lambda name: f"--{name}")
    found = [name for name in dict.fromkeys((*old, *new)) if old.get(name) != new.get(name)]
    words = [
        f"--{name} was {old.get(name, 'not set')}, is {new.get(name, 'not set')}" for name in found
    ]
    more = f" and {len(found) - 3} more" if len(found) > 3 else ""
    assert told == "; ".join(words[:3]) + more


@pytest.mark.parametrize("damage", ["{", "[]", '{"no": 1}', '{"key": 1, "files": {"../a": {}}}'])
def test_only_the_last_line_may_be_damaged(tmp_path, damage):
    path, rows = tmp_path / "ledger", ('{"key": "a"}', '{"key": "b"}')
    path.write_text("\n".join((*rows, damage, "")))
    assert {*Ledger(path, remedy="name another")} == {"a", "b"}
    path.write_text("\n".join((rows[0], damage, rows[1], "")))
    with pytest.raises(FileFormatError, match=r"ledger line 2 is damaged; name another$"):
        Ledger(path, remedy="name another")
