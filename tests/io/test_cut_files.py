"""A cut file of every format is refused, or gives its beginning. Other damage: `tests/fuzz`."""

import importlib.util

import pytest

from texvent.errors import InputError
from texvent.io.files import load

from .format_cases import ALL_CASES
from .test_corpus import CORPUS, expected

FILES = [
    case
    for case in ALL_CASES
    if case.file != "folder" and (case.extra is None or importlib.util.find_spec(case.extra))
]
SEALED = (
    *("hdf5", "npz", "prophesee-hdf5", "e2vid", "n-imagenet", "dsec", "rosbag1", "mcap"),
    "parquet",
)
"""Formats whose end can be told; of the others, a cut file may be a shorter recording."""


def cuts(length: int) -> list[int]:
    """Every length below that of a small file; of a large one a hundred, and all at its end."""
    if length < 600:
        return list(range(length))
    return sorted({*range(0, length, length // 100), *range(length - 40, length)})


@pytest.mark.parametrize("case", FILES, ids=lambda case: case.name)
def test_a_file_cut_at_any_byte_is_refused_or_gives_its_beginning(tmp_path, case):
    whole = expected(case)
    for beside in (CORPUS / case.name).iterdir():
        (tmp_path / beside.name).write_bytes(beside.read_bytes())
    path = tmp_path / case.file
    content = path.read_bytes()
    for length in cuts(len(content)):
        path.write_bytes(content[:length])
        back, message = None, ""
        try:
            back = load(path, format=case.name)
        except InputError as error:
            message = str(error)
        assert "\n" not in message
        if back is not None:
            assert case.name not in SEALED
            assert back.equals(whole[: len(back)])
