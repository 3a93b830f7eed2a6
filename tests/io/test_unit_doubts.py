"""Units of times and rows of arrays that are doubted, and those that are not."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from texvent.errors import FileFormatError, TexventWarning
from texvent.io.files import load, save
from texvent.sensor import SensorSize

from .column_files import write_columns
from .format_cases import random_events

SIZE = SensorSize(64, 48)
COUNT = 3000
STEADY = np.arange(COUNT) * 700


KINDS = ("npz", "npy", "h5", "parquet")
every_kind = pytest.mark.parametrize("kind", KINDS)


def written(folder: Path, kind: str, **others: NDArray[Any]) -> Path:
    """A file of the columns, some of them others."""
    at = np.arange(COUNT)
    columns = {"x": at % 64, "y": at % 48, "t": STEADY, "p": at % 2, **others}
    return write_columns(folder / f"e.{kind}", columns)


def changed(values: NDArray[Any], value: float, at: int = 1500) -> NDArray[Any]:
    values = values.copy()
    values[at] = value
    return values


@pytest.mark.parametrize("kind", [*KINDS, "csv"])
@pytest.mark.parametrize(
    "wrong",
    [
        {"t": changed(STEADY / 1e6, np.nan)},
        {"t": changed(STEADY.astype(float), np.inf)},
        {"t": changed(STEADY.astype("u8"), 2**64 - 1)},
        {"p": changed(np.arange(COUNT) % 2, 7)},
        {"x": changed(np.arange(COUNT) % 64 * 1.0, 0.5)},
    ],
)
def test_a_row_of_arrays_that_is_no_event_is_repaired(tmp_path, kind, wrong):
    path = written(tmp_path, kind, **wrong)
    with pytest.raises(FileFormatError):
        load(path, size=SIZE)
    with pytest.warns(TexventWarning, match=r"unreadable rows: 1\)"):
        found = load(path, size=SIZE, repair=True)
    assert found.t.tolist() == np.delete(STEADY, 1500).tolist()


@every_kind
@pytest.mark.parametrize(("at", "value"), [(-1, 10**13), (0, -(10**10))])
def test_one_wrong_time_says_nothing_of_the_unit(tmp_path, kind, at, value):
    path = written(tmp_path, kind, t=changed(STEADY, value, at))
    with pytest.warns(TexventWarning, match="a few of its times are"):
        load(path, size=SIZE)
    with pytest.warns(TexventWarning, match=r"stray times: 1\)"):
        assert len(load(path, size=SIZE, repair=True)) == COUNT - 1


@every_kind
@pytest.mark.parametrize("dtype", [int, float])
@pytest.mark.parametrize("start", [0, 3_000_000_000, 1_700_000_000_000_000])
def test_whole_us_are_read_after_a_pause_and_since_1970(tmp_path, kind, start, dtype):
    times = (start + STEADY + np.where(np.arange(COUNT) < 1500, 0, 3_600_000_000)).astype(dtype)
    assert load(written(tmp_path, kind, t=times), size=SIZE).t.tolist() == times.tolist()


@every_kind
def test_whole_ms_are_doubted_even_after_one_wrong_time(tmp_path, kind):
    path = written(tmp_path, kind, t=changed(STEADY // 1000 * 4, 10**13, -1))
    repaired = pytest.warns(TexventWarning, match="was repaired")
    with repaired, pytest.warns(TexventWarning, match="time-unit ms"):
        load(path, size=SIZE, repair=True)


@pytest.mark.parametrize("format", ["csv", "ecd", "e2vid", "npz", "hdf5", "n-imagenet"])
def test_files_of_texvent_and_of_known_layouts_are_not_doubted(tmp_path, format):
    names = {"csv": "e.csv", "ecd": "e.txt", "e2vid": "e.zip", "hdf5": "e.h5"}
    path = save(
        tmp_path / names.get(format, "e.npz"),
        random_events(COUNT, SIZE, span_us=20_000),
        format=format,
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(load(path)) == COUNT


def test_classes_beside_the_events_of_a_text_are_left_out(tmp_path):
    rows = (f"{at * 700},{at % 64},{at % 48},{at % 2},{at % 7}\n" for at in range(COUNT))
    (tmp_path / "e.csv").write_text("t,x,y,p,label\n" + "".join(rows))
    assert load(tmp_path / "e.csv", size=SIZE).label is None


@pytest.mark.parametrize("form", ["{:.6g}", "{:.2f}"])
def test_seconds_cut_to_some_digits_are_noticed(tmp_path, form):
    rows = (f"{form.format(1700 + at * 0.0007)} 1 1 {at % 2}\n" for at in range(COUNT))
    (tmp_path / "e.txt").write_text("".join(rows))
    with pytest.warns(TexventWarning, match="steps of 10,000 µs"):
        load(tmp_path / "e.txt", size=SIZE)
