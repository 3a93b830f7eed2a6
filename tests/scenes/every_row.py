"""One test of all rows of a large table: a thousand tests of a millisecond each cost minutes."""

from collections.abc import Callable, Iterable
from functools import wraps
from typing import TypeVar
from zlib import crc32

from tests.examples import one_of

Row = TypeVar("Row")


def for_every(
    rows: Iterable[Row] | Callable[[], Iterable[Row]], *, is_quick: bool = False
) -> Callable[[Callable[[Row], None]], Callable[[], None]]:
    """Make one test of a check of one row; it names the rows that fail, and says why.

    A brief run checks one row of every few, another one each time: at a fixed step it would meet
    one row alone of each short table that is multiplied with others. Rows that take long to find
    are a function, which the test calls and not each collection; quick ones are all checked.
    """
    given = rows if callable(rows) else list(rows)

    def decorate(check: Callable[[Row], None]) -> Callable[[], None]:
        @wraps(check)
        def test() -> None:
            failures = {}
            every = list(given() if callable(given) else given)
            step = 1 if is_quick else one_of(len(every))
            for start in range(0, len(every), step):
                few = every[start : start + step]
                row = few[crc32(f"{check.__name__} {start}".encode()) % len(few)]
                try:
                    check(row)
                except AssertionError as error:
                    failures[getattr(row, "name", row)] = str(error)
            assert not failures, failures

        del test.__wrapped__  # pytest would look for fixtures called as the arguments of `check`
        return test

    return decorate
