"""Units of times and rows of arrays that are doubted, and those that are not."""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest
from numpy.typing import NDArray

from texvent.errors import FileFormatError, TexventWarning
from texvent.io.files import load, save
from texvent.sensor import SensorSize

from .format_cases import random_events

SIZE = SensorSize(64, 48)
COUNT = 3000
STEADY = np.arange(COUNT) * 700


def npz(path: Path, columns: dict[str, NDArray[Any]]) -> Path:
    np.savez(path / "e.npz", **columns)  # type: ignore[arg-type]  # of NumPy's stubs
    return path / "e.npz"


def npy(path: Path, columns: dict[str, NDArray[Any]]) -> Path:
    rows = np.empty(COUNT, [(name, one.dtype) for name, one in columns.items()])
    for name, one in columns.items():
        rows[name] = one
    np.save(path / "e.npy", rows)
    return path / "e.npy"


def hdf5(path: Path, columns: dict[str, NDArray[Any]]) -> Path:
    with h5py.File(path / "e.h5", "w") as file:
        for name, one in columns.items():
            file[f"events/{name}"] = one
    return path / "e.h5"


def parquet(path: Path, columns: dict[str, NDArray[Any]]) -> Path:
    arrow = pytest.importorskip("pyarrow")
    table = arrow.table({name: arrow.array(one) for name, one in columns.items()})
    pytest.importorskip("pyarrow.parquet").write_table(table, path / "e.parquet")
    return path / "e.parquet"


def csv(path: Path, columns: dict[str, NDArray[Any]]) -> Path:
    rows = zip(*(one.tolist() for one in columns.values()), strict=True)
    texts = ([f"{one:.16g}" if isinstance(one, float) else str(one) for one in row] for row in rows)
    lines = [",".join(columns), *map(",".join, texts)]
    (path / "e.csv").write_text("\n".join(lines))
    return path / "e.csv"


Write = Callable[[Path, dict[str, NDArray[Any]]], Path]
every_writer = pytest.mark.parametrize("write", [npz, npy, hdf5, parquet])


def columns(**others: NDArray[Any]) -> dict[str, NDArray[Any]]:
    at = np.arange(COUNT)
    return {"x": at % 64, "y": at % 48, "t": STEADY, "p": at % 2, **others}


def changed(values: NDArray[Any], value: float, at: int = 1500) -> NDArray[Any]:
    values = values.copy()
    values[at] = value
    return values


@pytest.mark.parametrize("write", [npz, npy, hdf5, parquet, csv])
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
def test_a_row_of_arrays_that_is_no_event_is_repaired(tmp_path, write, wrong):
    path = write(tmp_path, columns(**wrong))
    with pytest.raises(FileFormatError):
        load(path, size=SIZE)
    with pytest.warns(TexventWarning, match=r"unreadable rows: 1\)"):
        found = load(path, size=SIZE, repair=True)
    assert found.t.tolist() == np.delete(STEADY, 1500).tolist()


@every_writer
@pytest.mark.parametrize(("at", "value"), [(-1, 10**13), (0, -(10**10))])
def test_one_wrong_time_says_nothing_of_the_unit(tmp_path, write, at, value):
    path = write(tmp_path, columns(t=changed(STEADY, value, at)))
    with pytest.warns(TexventWarning, match="a few of its times are"):
        load(path, size=SIZE)
    with pytest.warns(TexventWarning, match=r"stray times: 1\)"):
        assert len(load(path, size=SIZE, repair=True)) == COUNT - 1


@every_writer
@pytest.mark.parametrize("kind", [int, float])
@pytest.mark.parametrize("start", [0, 3_000_000_000, 1_700_000_000_000_000])
def test_whole_us_are_read_after_a_pause_and_since_1970(tmp_path, write, start, kind):
    times = (start + STEADY + np.where(np.arange(COUNT) < 1500, 0, 3_600_000_000)).astype(kind)
    assert load(write(tmp_path, columns(t=times)), size=SIZE).t.tolist() == times.tolist()


@every_writer
def test_whole_ms_are_doubted_even_after_one_wrong_time(tmp_path, write):
    path = write(tmp_path, columns(t=changed(STEADY // 1000 * 4, 10**13, -1)))
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
