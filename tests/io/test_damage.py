"""HDF5 and npz notice a wrong byte; a cut file is refused or gives its beginning.

Examples are the same in every run: what a file format's library does with damage is its own.
"""

import importlib.util
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io.files import load, save
from texvent.sensor import SensorSize

from .format_cases import ALL_CASES
from .test_corpus import CORPUS, expected

SIZE = SensorSize(16, 16)


def _events() -> EventStream:
    step = np.arange(400)
    return EventStream(step % 16, step // 25, step * 50, step % 2, SIZE, {"seed": 5})


@pytest.fixture(scope="module", params=[".h5", ".npz"])
def sound(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("damage") / f"sound{request.param}"
    return save(path, _events())


def _load_or_refuse(path: Path) -> EventStream | None:
    try:
        return load(path)
    except InputError as error:
        # Nearly always FileFormatError; an archive whose directory lost the size asks for it.
        message = str(error)
    assert "\n" not in message
    return None


def test_another_start_time_than_the_one_written_is_refused(tmp_path: Path) -> None:
    path = save(tmp_path / "events.h5", _events())
    with h5py.File(path, "r+") as file:
        file["t_offset"][()] = 2**56
    with pytest.raises(FileFormatError, match="t_offset is 72057594037927936, written as 0"):
        load(path)


@pytest.mark.filterwarnings("ignore:.* times, which have no unit")  # without its metadata
@examples(120, derandomize=True)
@given(share=st.floats(0.0, 1.0, exclude_max=True), flip=st.integers(1, 255))
def test_a_flipped_byte_is_refused_or_harmless(sound: Path, share: float, flip: int) -> None:
    content = bytearray(sound.read_bytes())
    content[int(share * len(content))] ^= flip
    path = sound.with_name(f"flipped{sound.suffix}")
    path.write_bytes(content)
    back = _load_or_refuse(path)
    assert back is None or back.equals(_events())


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
