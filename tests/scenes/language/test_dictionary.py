"""Tables read word by word say what lemminflect says that reads them whole."""

from __future__ import annotations

import gzip
from pathlib import Path

import pytest
from lemminflect.codecs.InflectionLUCodec import InflectionLUCodec
from lemminflect.codecs.LemmaLUCodec import LemmaLUCodec
from lemminflect.core.Inflections import Inflections
from lemminflect.core.Lemmatizer import Lemmatizer

from texvent.scenes.language.words.dictionary import WordTable, open_dictionary


@pytest.mark.parametrize("which", ["lemmas", "inflections"])
def test_every_word_of_the_tables_says_the_same(which):
    open_dictionary()
    if which == "lemmas":
        table = Lemmatizer().lemma_dict
        whole = LemmaLUCodec.load(Lemmatizer().lemma_lu_fn)
    else:
        table = Inflections().infl_dict
        whole = InflectionLUCodec.load(Inflections().infl_lu_fn)
    assert isinstance(table, WordTable)
    assert len(whole) > 30_000
    # Order counts: the reader takes the first reading that fits.
    assert all(list(table.get(word).items()) == list(said.items()) for word, said in whole.items())
    assert table.get("qwrtz", {}) == {}


def test_lines_of_a_word_apart_are_joined_in_their_order(tmp_path: Path):
    path = tmp_path / "table.gz"
    path.write_bytes(gzip.compress(b"b,1\na,2\nb,3\n"))
    table = WordTable(path, lambda line: {line[2:]: (line,)}, {"c": {"fixed": ("c",)}})
    assert list(table.get("b")) == ["1", "3"]
    assert table.get("c") == {"fixed": ("c",)}
    assert table.get("") is None
