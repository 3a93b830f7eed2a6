"""A table of what is refused: its words, and what lies just beside it and is accepted."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from texvent.errors import TexventError

Call = Callable[[Any], Any]
Refusal = tuple[Call, type[TexventError], str, Call]
"""What is wrong, its error, words of it, and what is right; both are given the same."""


def check_refusal(row: Refusal, given: Any, folder: Path | None = None) -> None:
    """One line of that very error, which leaves no file in a folder; its neighbour is accepted."""
    wrong, error, words, right = row
    before = sorted(folder.rglob("*")) if folder else []
    with pytest.raises(error) as caught:
        wrong(given)
    said = str(caught.value)
    assert (type(caught.value), "\n" in said) == (error, False)
    assert words in said
    assert folder is None or sorted(folder.rglob("*")) == before
    right(given)
