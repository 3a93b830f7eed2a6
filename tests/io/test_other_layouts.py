"""Arrays of other programs and data sets, found by their names: HDF5, npz, npy."""

from decimal import Decimal
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from texvent.errors import ConfigError, FileFormatError, InputError, TexventWarning
from texvent.events import EventStream
from texvent.io.files import load, open_events, save
from texvent.io.reading import SeveralRecordingsError, UnknownLayoutError
from texvent.io.tables import whole_numbers
from texvent.sensor import SensorSize

SIZE = SensorSize(9, 7)
X, Y, T, P = np.array([3, 4, 8]), np.array([5, 6, 0]), np.array([70, 80, 3_000_081]), [1, 0, 1]
EVENTS = EventStream.from_columns(X, Y, T, P, size=SIZE)
RECORDS = np.array(
    list(zip(T, X, Y, P, strict=True)), [("ts", "i8"), ("x", "u2"), ("y", "u2"), ("p", "?")]
)
FOUR = np.stack([X, Y, T / 1e6, np.array(P) * 2 - 1], axis=1)


def write_h5(path: Path, arrays: dict[str, Any], **attributes: Any) -> Path:
    with h5py.File(path, "w") as file:
        for name, values in arrays.items():
            file[name] = values
        for name, value in attributes.items():
            file.attrs[name] = value
    return path


@pytest.mark.parametrize(
    "arrays",
    [
        {"events/xs": X, "events/ys": Y, "events/ts": T / 1e6, "events/ps": np.array(P, bool)},
        {"x": X, "y": Y, "t": T, "p": P},
        {"davis/left/events": FOUR, "davis/left/image_raw": np.zeros((2, 7, 9))},
        {"events": FOUR[:, [2, 0, 1, 3]]},
        {"data/event_records": RECORDS},
        {"events/x": X, "events/y": Y, "events/t": T - 70, "events/p": P, "t_offset": 70},
        {"events/x": X, "events/y": Y, "events/timestamp_ns": T * 1000 + 999, "events/polarity": P},
        {"cd/x": X[:, None], "cd/y": Y[:, None], "cd/t [ms]": T / 1e3, "cd/p": P},
    ],
)
def test_hdf5_of_data_sets_and_tools_is_read(tmp_path, arrays):
    path = write_h5(tmp_path / "e.h5", arrays)
    assert load(path, size=SIZE).equals(EVENTS)
    first = open_events(path, size=SIZE).between(75, 100).collect()
    assert first.t.tolist() == [80]


def test_sizes_of_event_utils_and_m3ed_are_read(tmp_path):
    arrays = {"events/x": X, "events/y": Y, "events/t": T, "events/p": P}
    assert load(write_h5(tmp_path / "a.h5", arrays, sensor_resolution=[7, 9])).equals(EVENTS)
    arrays["events/calib/resolution"] = [9, 7]
    assert load(write_h5(tmp_path / "b.h5", arrays)).equals(EVENTS)


def test_one_of_several_groups_is_chosen(tmp_path):
    left = {
        f"prophesee/left/{name}": values for name, values in zip("xytp", (X, Y, T, P), strict=True)
    }
    right = {name.replace("left", "right"): values[:2] for name, values in left.items()}
    path = write_h5(tmp_path / "e.h5", left | right)
    with pytest.raises(
        SeveralRecordingsError, match="2 recordings: prophesee/left, prophesee/right"
    ):
        load(path, size=SIZE)
    for stream, count in (("prophesee/left", 3), ("right", 2), ("0", 3)):
        assert len(load(path, size=SIZE, stream=stream)) == count


def test_an_unknown_file_says_what_it_holds_and_takes_names(tmp_path):
    arrays = {"a/u": X, "a/v": Y, "a/when": T, "a/sign": P, "b": np.zeros(5)}
    path = write_h5(tmp_path / "e.h5", arrays)
    with pytest.raises(UnknownLayoutError, match=r"knows \(a/sign int64 \[3\], a/u int64 \[3\]"):
        load(path, size=SIZE)
    names = "t=a/when,x=a/u,y=a/v,p=a/sign"
    assert load(path, size=SIZE, columns=names).equals(EVENTS)
    assert load(path, size=SIZE, columns=names.replace("a/", ""), stream="a").equals(EVENTS)
    with pytest.raises(InputError, match="has no 'c' for column p"):
        load(path, size=SIZE, columns=names.replace("a/sign", "c"))


@pytest.mark.parametrize("name", ["e.npz", "e.npy"])
def test_arrays_of_numpy_are_read(tmp_path, name):
    path = tmp_path / name
    for array in (RECORDS, FOUR, FOUR[:, [2, 0, 1, 3]]):
        np.savez(path, anything=array) if name == "e.npz" else np.save(path, array)
        assert load(path, size=SIZE).equals(EVENTS)


def test_pairs_of_coordinates_are_read(tmp_path):
    path = tmp_path / "e.npz"
    np.savez(path, xy=np.stack([X, Y], axis=1), t=T / 1e6, p=P, meta=np.zeros(2))
    assert load(path, size=SIZE).equals(EVENTS)


def test_coordinates_in_steps_of_a_pixel_are_divided_with_a_warning(tmp_path):
    path = tmp_path / "e.npz"
    np.savez(path, x=X * 32 + 31, y=Y * 32, timestamp=T, polarity=P)
    with pytest.warns(TexventWarning, match="read as 1/32 of a pixel, as BS-ERGB"):
        assert load(path, size=SIZE).equals(EVENTS)
    np.savez(path, x=X * 40, y=Y, timestamp=T, polarity=P)
    with pytest.raises(FileFormatError, match="x runs from"):
        load(path, size=SIZE)


def test_a_stated_unit_is_believed_and_a_guessed_one_is_checked(tmp_path):
    t = np.arange(2000) * 1_000_000
    zeros = np.zeros(2000, int)
    path = tmp_path / "e.npz"
    np.savez(path, x=zeros, y=zeros, t=t, p=zeros)
    with pytest.raises(
        FileFormatError, match=r"1 per second; they are probably ns: give time_unit"
    ):
        load(path, size=SIZE)
    assert load(path, size=SIZE, time_unit="ns").t[-1] == 1_999_000
    np.savez(path, x=zeros, y=zeros, t=t, p=zeros, timestamp_scale_ms=1e-6)
    assert load(path, size=SIZE).t[-1] == 1_999_000


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"time_unit": "min"}, "time_unit is 'min'; allowed: s, ms, us, ns"),
        ({"columns": "t,x,y"}, "give t, x, y and p once each"),
        ({"columns": "t=a,x,y,p"}, "give t, x, y and p once each"),
        ({"columns": "t,x,y,p", "format": "evt3"}, "is evt3, which states its columns; leave"),
    ],
)
def test_wrong_options_are_one_line(tmp_path, options, message):
    path = tmp_path / "e.raw"
    path.write_bytes(b"% evt 3.0\n% geometry 9x7\n% end\n")
    with pytest.raises(ConfigError, match=message):
        load(path, **options)


def test_any_other_text_is_rows_of_events(tmp_path):
    text = tmp_path / "e.log"
    text.write_text("0.00007 3 5 1\n")
    assert len(load(text, size=SIZE)) == 1


@pytest.mark.parametrize(
    ("stored", "attributes"),
    [
        ({"t": T - 50}, {"t.add_offset": 50}),
        (
            {"x": np.uint8(X * 2), "p": np.array(P) * 4},
            {"x.scale_factor": 0.5, "p.scale_factor": 1 / 4},
        ),
        ({"p": 1 - np.array(P)}, {"p.scale_factor": -1, "p.add_offset": [1.0]}),
        ({"t": T * 1000}, {"t.scale_factor": 1e-9, "t.units": "seconds since 2020-01-01"}),
        ({"t": T * 1000 + 9}, {"t.units": b"ns since 1970-01-01"}),
        ({"y": np.uint16(6 - Y)}, {".origin": "lower left"}),
        ({"x": np.int8(8 - X), "y": 6 - Y}, {"events.origin": b"BOTTOM_RIGHT"}),
        ({"y": 12 - 2 * Y}, {"y.y_up": True, "y.scale_factor": 0.5}),
        ({"y": 6 - Y}, {"y.origin": "lower left", "events.origin": "upper right", ".y_up": False}),
        ({"x": 8 - X}, {"events.origin": "top right", ".origin": "bottom left"}),
        ({}, {"y.y_up": False, ".y_up": True}),
        ({}, {".origin": "Zürich", ".y_up": False, "t.scale_factor": 1}),
    ],
)
def test_attributes_that_scale_or_turn_columns_are_obeyed(tmp_path, stored, attributes):
    columns = {"x": X, "y": Y, "t": T, "p": P, **stored}
    arrays = {f"events/{name}": one for name, one in columns.items()}
    path = write_h5(tmp_path / "e.h5", arrays, width=9, height=7)
    with h5py.File(path, "r+") as file:
        for key, value in attributes.items():
            node, _, name = key.rpartition(".")
            file[f"events/{node}" if node in columns else node or "/"].attrs[name] = value
    assert load(path).equals(EVENTS)


def test_narrow_floats_are_read_without_a_word_of_numpy(tmp_path):
    path = write_h5(tmp_path / "e.h5", {"x": np.half(X), "y": np.half(Y), "t_ms": T, "p": P})
    assert load(path, size=SIZE).x.tolist() == X.tolist()
    path = write_h5(tmp_path / "f.h5", {"x": X, "y": Y, "t_us": np.half([1, 2, 900]), "p": P})
    assert load(path, size=SIZE).t.tolist() == [1, 2, 900]


@pytest.mark.parametrize("values", [[[1], [2]], [Decimal("1.5")], [None], [1.5]])
def test_columns_of_tables_that_are_no_whole_numbers_are_refused(values):
    column = np.empty(len(values), object)
    column[:] = values
    with pytest.raises(FileFormatError, match="not whole numbers"):
        whole_numbers(Path("e.parquet"), column)


@pytest.mark.parametrize("value", ["a", [1, 2], np.nan])
def test_attributes_that_cannot_be_obeyed_are_named(tmp_path, value):
    path = write_h5(tmp_path / "e.h5", {"x": X, "y": Y, "t": T, "p": P, "records": RECORDS})
    for name, said in (("t", "scale_factor of /t is"), ("records", "several columns")):
        with h5py.File(path, "r+") as file:
            file[name].attrs["scale_factor"] = value if name == "t" else 2
        with pytest.raises(FileFormatError, match=said):
            load(path, size=SIZE, stream="events" if name == "t" else name)


def test_plain_numpy_finds_the_columns(tmp_path: Path) -> None:
    events = EventStream.from_columns([1, 2], [3, 4], [5, 6], [1, 0], size=SensorSize(9, 8))
    with np.load(save(tmp_path / "events.npz", events), allow_pickle=False) as archive:
        assert {name: archive[name].tolist() for name in "xytp"} == {
            "x": [1, 2],
            "y": [3, 4],
            "t": [5, 6],
            "p": [1, 0],
        }
        assert (int(archive["width"]), int(archive["height"])) == (9, 8)
        assert float(archive["timestamp_scale_ms"]) == 0.001


def test_a_single_array_is_not_an_archive(tmp_path: Path) -> None:
    path = tmp_path / "events.npz"
    with path.open("wb") as file:
        np.save(file, np.zeros(3))
    with pytest.raises(FileFormatError, match="single NumPy array"):
        load(path, size=(4, 4))


def test_random_bytes_are_no_archive_and_nobody_advises_to_unpickle_them(tmp_path: Path) -> None:
    path = tmp_path / "random.npz"
    path.write_bytes(bytes(range(7, 200)))
    with pytest.raises(FileFormatError, match="is not a NumPy archive") as caught:
        open_events(path)
    assert "pickle" not in str(caught.value)


def test_older_files_of_n_imagenet_have_longer_names_of_fields(tmp_path: Path) -> None:
    fields = [("x_pos", "<u2"), ("y_pos", "<u2"), ("timestamp", "<i8"), ("polarity", "?")]
    rows = [(3, 4, 10, True), (639, 479, 20, False)]
    np.savez(tmp_path / "old.npz", event_data=np.array(rows, dtype=fields))
    events = load(tmp_path / "old.npz", size=SensorSize(640, 480))
    assert events.x.tolist() == [3, 639]
    assert events.y.tolist() == [4, 479]
    assert events.t.tolist() == [10, 20]
    assert events.p.tolist() == [1, 0]
