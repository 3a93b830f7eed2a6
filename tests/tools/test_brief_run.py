"""A brief run of the tests leaves no row of a short table out, and of long ones takes a part."""

from itertools import product
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests import examples
from tests.conftest import choose_rows


def brief_run(*tables: int, is_long: bool = False, file: str = "a.py") -> list[tuple[str, ...]]:
    """Of a test over tables of so many rows: the rows that a brief run has."""
    found = {}
    for rows in product(*(map(str, range(count)) for count in tables)):
        call = {"callspec": SimpleNamespace(_idlist=rows)} if rows else {}
        name = f"{file}::test_it[{'-'.join(rows)}]"
        mark = {"get_closest_marker": lambda _: is_long or None}
        found[name] = rows, SimpleNamespace(nodeid=name, **mark, **call)
    chosen = choose_rows([item for _, item in found.values()])
    return [rows for name, (rows, _) in found.items() if name in chosen]


@given(tables=st.lists(st.integers(1, 6), max_size=3).filter(lambda rows: sum(rows) < 12))
def test_each_row_of_each_table_has_its_turn_and_few_have_more(tables):
    chosen = brief_run(*tables)
    for place, count in enumerate(tables):
        assert {rows[place] for rows in chosen} == {*map(str, range(count))}
    assert max(tables, default=1) <= len(chosen) <= max(sum(tables), 1)
    staged = brief_run(*tables, file="tests/scenes/staging/test_a.py")
    assert max(tables, default=1) <= 4 * len(staged) <= max(sum(tables), 1) + 3


@pytest.mark.parametrize(("rows", "kept"), [(11, 11), (12, 6), (25, 13)])
def test_of_a_long_table_every_second_row_has_its_turn(rows, kept):
    assert len(brief_run(rows)) == kept


@pytest.mark.parametrize(("tables", "kept"), [([], 0), ([1], 0), ([3], 1), ([17], 2), ([4, 4], 2)])
def test_an_eighth_of_the_rows_of_a_long_test_has_its_turn(tables, kept):
    assert len(brief_run(*tables, is_long=True)) == kept


@pytest.mark.parametrize("rows", [0, 1, 7, 192, 193, 5000])
def test_one_test_of_a_whole_table_tries_a_quarter_of_it_and_48_rows_at_most(monkeypatch, rows):
    for share, most in ((1.0, rows), (12 / 50, min(-(-rows // 4), 48))):
        monkeypatch.setattr(examples, "share", lambda share=share: share)
        assert 0.8 * most <= len(range(rows)[:: examples.one_of(rows)]) <= most
