"""Tables in Markdown."""

from __future__ import annotations

import re
from abc import ABC, abstractmethod
from collections.abc import Collection, Iterable, Sequence


class MarkdownReport(ABC):
    """A report that notebooks show as its tables."""

    @abstractmethod
    def markdown(self) -> str:
        """All tables."""

    def _repr_mimebundle_(
        self, include: Collection[str] | None = None, exclude: Collection[str] | None = None
    ) -> dict[str, str]:
        """What a notebook shows: the tables."""
        return {"text/plain": repr(self), "text/markdown": self.markdown()}


def markdown_table(titles: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table, one line per row of cells, each of one line and without HTML tags."""
    lines = [titles, ["---"] * len(titles), *rows]
    return "".join(f"| {' | '.join(map(_cell, cells))} |\n" for cells in lines)


def without_tags(text: str) -> str:
    """Markdown in which no HTML tag begins; emphasis and links stay.

    Names of recordings and entries come from files that others may have written.

    Example:
        >>> without_tags("a <b>, p < 0.05")
        'a &lt;b>, p < 0.05'
    """
    return re.sub(r"<(?=[A-Za-z/!?])", "&lt;", text)


def _cell(text: str) -> str:
    one_line = " ".join(text.splitlines())
    return re.sub(r"(?<!\\)\|", r"\|", without_tags(one_line))
