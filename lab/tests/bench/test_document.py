"""Result documents: plain or compressed, by the name of the file."""

import gzip
import json
import math

import cv2
import h5py
import numba
import numpy as np
import pytest

from texvent.errors import FileFormatError
from texvent_lab.bench.document import DIGITS, describe_environment, read_document, write_document


def test_a_document_states_the_packages_that_made_it():
    packages = describe_environment()["packages"]
    modules = {"numpy": np, "numba": numba, "opencv-python-headless": cv2, "h5py": h5py}
    for name, module in modules.items():  # OpenCV's wheels have a fourth number
        assert packages[name].startswith(module.__version__)


DOCUMENT = {"schema": "any-1", "value": math.pi, "undefined": math.nan, "seeds": (7, 21)}


def test_a_plain_document_keeps_every_digit_and_has_null_for_nan(tmp_path):
    write_document(tmp_path / "r.json", DOCUMENT, overwrite=False)
    assert read_document(tmp_path / "r.json") == {
        "schema": "any-1",
        "value": math.pi,
        "undefined": None,
        "seeds": [7, 21],
    }
    assert (tmp_path / "r.json").read_text().startswith('{\n  "schema"')


def test_a_name_that_ends_in_gz_compresses_and_rounds_with_equal_bytes_each_time(tmp_path):
    for name in ("a.json.gz", "b.json.gz"):
        write_document(tmp_path / name, DOCUMENT, overwrite=False)
    content = (tmp_path / "a.json.gz").read_bytes()
    assert content == (tmp_path / "b.json.gz").read_bytes()
    assert json.loads(gzip.decompress(content))["value"] == round(math.pi, DIGITS - 1)
    assert read_document(tmp_path / "a.json.gz")["seeds"] == [7, 21]


@pytest.mark.parametrize(
    "content",
    [b"no gzip", gzip.compress(b'{"schema": 1}', mtime=0)[:-9], b""],
    ids=["no gzip", "cut short", "empty"],
)
def test_a_damaged_compressed_document_is_refused(tmp_path, content):
    (tmp_path / "r.json.gz").write_bytes(content)
    with pytest.raises(FileFormatError, match="no JSON document"):
        read_document(tmp_path / "r.json.gz")
