"""The tables of lemminflect, of which only the words asked for are read.

lemminflect parses all 120,000 lines of its two tables when it is first asked, which takes longer
than everything else that the reader does. Here a line is parsed when its word is looked up.
"""

from __future__ import annotations

import gzip
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

Entry = dict[str, tuple[str, ...]]


@cache
def open_dictionary() -> ModuleType:
    """lemminflect, with tables that are read word by word."""
    import lemminflect  # brings its tables, which help texts do not need
    from lemminflect.codecs.InflectionLUCodec import InflectionLUCodec
    from lemminflect.codecs.LemmaLUCodec import LemmaLUCodec
    from lemminflect.core.Inflections import Inflections
    from lemminflect.core.Lemmatizer import Lemmatizer
    from lemminflect.core.LexicalUtils import categoryToUPos

    def lemmas_in(line: str) -> Entry:
        _, category, forms = LemmaLUCodec.fromString(line)
        return {categoryToUPos(category): forms}

    def inflections_in(line: str) -> Entry:
        entry: Entry = InflectionLUCodec.fromString(line)[2]
        return entry

    # Both are singletons that look here before they read their files.
    lemmas, inflections = Lemmatizer(), Inflections()
    lemmas.lemma_dict = WordTable(Path(lemmas.lemma_lu_fn), lemmas_in)
    fixed = InflectionLUCodec.updateForAuxMod({})
    inflections.infl_dict = WordTable(Path(inflections.infl_lu_fn), inflections_in, fixed)
    module: ModuleType = lemminflect
    return module


class WordTable:
    """What a table says of a word; each of its lines begins with one."""

    def __init__(
        self, path: Path, parse: Callable[[str], Entry], fixed: dict[str, Entry] | None = None
    ) -> None:
        """Read the lines of a table.

        Args:
            path: of a gzip file.
            parse: what one line says.
            fixed: words whose lines do not count, and what holds for them instead.
        """
        text = gzip.decompress(path.read_bytes()).decode()
        lines = text.splitlines()
        words = [line[: line.find(",")] for line in lines]
        # The tables come sorted; else lines of a word stay in their order.
        order = sorted(range(len(words)), key=words.__getitem__)
        self._lines, self._words = [lines[k] for k in order], [words[k] for k in order]
        self._parse, self._fixed = parse, fixed or {}

    def get(self, word: str, default: Any = None) -> Any:
        """What the table says of a word, or `default`."""
        if word in self._fixed:
            return self._fixed[word]
        first, last = bisect_left(self._words, word), bisect_right(self._words, word)
        return _joined(map(self._parse, self._lines[first:last])) if first < last else default


def _joined(entries: Iterable[Entry]) -> Entry:
    joined: Entry = {}
    for entry in entries:
        joined.update(entry)
    return joined
