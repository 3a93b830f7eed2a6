"""A brief run of the tests leaves no row of a table out, and of long tests takes a part."""

from itertools import product
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.conftest import choose_rows


def brief_run_of(tables: list[int], *, is_long: bool = False) -> dict[str, tuple[str, ...]]:
    """Of tests over tables of so many rows: name and rows of each that a brief run has."""
    ids = [tuple(map(str, one)) for one in product(*map(range, tables))]
    rows = {f"a.py::test_it[{'-'.join(one)}]": one for one in ids}
    chosen = choose_rows([item(name, row, is_long=is_long) for name, row in rows.items()])
    return {name: row for name, row in rows.items() if name in chosen}


def item(name: str, rows: tuple[str, ...] | None, *, is_long: bool = False) -> Any:
    call = {} if rows is None else {"callspec": SimpleNamespace(_idlist=rows)}
    return SimpleNamespace(nodeid=name, get_closest_marker=lambda _: is_long or None, **call)


@given(tables=st.lists(st.integers(1, 6), min_size=1, max_size=3))
def test_each_row_of_each_table_has_its_turn_and_few_have_more(tables):
    chosen = brief_run_of(tables)
    for place, count in enumerate(tables):
        assert {row[place] for row in chosen.values()} == {*map(str, range(count))}
    assert max(tables) <= len(chosen) <= sum(tables)


@pytest.mark.parametrize(("rows", "kept"), [(1, 0), (3, 1), (17, 3)])
def test_an_eighth_of_the_rows_of_a_long_test_has_its_turn(rows, kept):
    assert len(brief_run_of([rows], is_long=True)) == kept


def test_a_test_without_tables_is_kept_unless_it_is_long():
    items = [item("a.py::test_one", None), item("a.py::test_other", None, is_long=True)]
    assert choose_rows(items) == {"a.py::test_one"}
