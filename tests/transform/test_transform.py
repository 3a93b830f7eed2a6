"""Regions, times, sizes, lenses and merging: by hand on few events, and by property on many."""

import math
from collections.abc import Iterator
from pathlib import Path

import h5py
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.calibration import read_calibration
from texvent.lens import Lens
from texvent.sensor import SensorSize
from texvent.transform.edits import Region, crop, keep_time, merge, resize, start_at_zero
from texvent.transform.undistort import Calibration, undistort

from .recordings import ROWS, SIZE, Rows, packets, rows_of
from .recordings import stream as in_time_order


def stream(rows: Rows) -> EventStream:
    """Events in the order of merged recordings: by t, y, x and p."""
    return in_time_order(sorted(rows, key=lambda row: (row[2], row[1], row[0], row[3])))


@pytest.mark.parametrize("region", [(6, 0, 3, 1), (0, 0, 0, 1), (0, 5, 1, 2), (-1, 0, 2, 2)])
def test_a_region_outside_the_sensor_is_refused(region):
    with pytest.raises(InputError, match="does not lie inside the sensor of 8x6"):
        crop(packets(stream([])), Region(*region))


@given(rows=ROWS, width=st.integers(1, 20), height=st.integers(1, 20))
def test_resize_puts_events_into_the_pixel_that_covers_their_old_one(rows, width, height):
    events = stream(rows)
    resized = resize(packets(events), SensorSize(width, height))
    assert resized.size == (width, height)
    assert rows_of(resized) == [
        (x * width // 8, y * height // 6, t, p) for x, y, t, p in rows_of(events)
    ]


@given(rows=ROWS, start=st.integers(0, 20), length=st.integers(1, 20), cut=st.integers(0, 40))
def test_a_time_range_is_half_open(rows, start, length, cut):
    events = stream(rows)
    want = [row for row in rows_of(events) if start <= row[2] < start + length]
    try:
        assert rows_of(keep_time(packets(events, [cut]), start, start + length)) == want
    except InputError:
        times = [row[2] for row in rows]
        assert start > max(times) or start + length <= min(times)


def test_what_comes_after_the_time_range_is_not_read():
    def endless() -> Iterator[EventStream]:
        yield stream([(1, 1, 1, 1)])
        yield stream([(1, 1, 9, 1)])
        raise AssertionError("read on")

    kept = keep_time(EventPackets(endless(), SIZE), 0, 5)
    assert len(kept.collect()) == 1
    with pytest.raises(InputError, match="must be after the start"):
        keep_time(EventPackets([], SIZE), 5, 5)


def test_time_may_start_at_the_first_event():
    late = stream([(1, 1, 7, 1), (2, 2, 9, 0)])
    assert start_at_zero(packets(late, [1])).collect().t.tolist() == [0, 2]
    assert len(start_at_zero(EventPackets([], SIZE)).collect()) == 0


@examples(60)
@given(
    parts=st.lists(st.tuples(ROWS, st.integers(0, 40), st.integers(0, 40)), min_size=1, max_size=4)
)
@example([([(1, 0, 5, 1), (0, 0, 5, 0)], 1, 1), ([(0, 1, 5, 1), (0, 2, 9, 0)], 1, 1)])  # ties go on
def test_merging_is_sorting_all_events(parts):
    merged = merge([packets(stream(rows), cuts) for rows, *cuts in parts])
    together = [row for rows, *_ in parts for row in rows]
    assert rows_of(merged) == rows_of(stream(together))
    assert rows_of(merged) == rows_of(stream(together)), "it can be read again"


def test_merging_keeps_the_label_only_if_all_have_one():
    label = np.array([1, 0], dtype=np.uint8)
    plain = stream([(1, 1, 1, 1), (2, 2, 2, 0)])
    labelled = EventStream(plain.x, plain.y, plain.t, plain.p, SIZE, {"seed": 3}, label)
    both = merge([packets(labelled), packets(labelled)]).collect()
    assert both.label is not None
    assert both.label.tolist() == [1, 1, 0, 0]
    one = merge([EventPackets([labelled], SIZE, labelled.metadata), packets(plain)]).collect()
    assert (one.label, dict(one.metadata)) == (None, {"seed": 3})


COEFFICIENTS = (-0.02, 0.004, -0.003, 0.0005)
FISHEYE = Calibration(Lens(110.0, 110.0, 120.5, 90.5, "equidistant", COEFFICIENTS))


def test_a_lens_without_distortion_moves_nothing():
    events = stream([(0, 0, 1, 1), (7, 5, 2, 0), (3, 2, 3, 1)])
    straight = Calibration(Lens(10.0, 10.0, 4.5, 3.5))
    assert undistort(packets(events), straight).collect().equals(events)
    assert undistort(events, straight).equals(events), "a stream gives a stream"


def test_a_calibration_file_is_nine_numbers(tmp_path):
    path = tmp_path / "calib.txt"
    path.write_text("199.1 198.8 132.2 110.7 -0.368 0.151 -0.0003 -0.0018 0.0\n")
    read = read_calibration(path)
    lens = Lens(199.1, 198.8, 132.7, 111.2, "radtan", (-0.368, 0.151, -0.0003, -0.0018, 0.0))
    assert read.lens == lens
    intrinsics, coefficients = [199.1, 198.8, 132.2, 110.7], list(lens.coefficients)
    assert read.facts == {"intrinsics": intrinsics, "coefficients": coefficients}
    with pytest.raises(InputError, match="no such file"):
        read_calibration(tmp_path / "none.txt")


KALIBR = """cam0:
  camera_model: pinhole
  distortion_coeffs: [-0.02, 0.004, -0.003, 0.0005]
  distortion_model: equidistant
  intrinsics: [110.0, 110.0, 120.0, 90.0]
  resolution: [240, 180]
"""


def test_kalibrs_cameras_are_read_by_their_name(tmp_path):
    path = tmp_path / "chain.yaml"
    path.write_text(KALIBR.replace("0.0005", "0.0005, 0.0"))  # no fifth, as OpenCV writes it
    read = read_calibration(path)
    places = read.undistorted(SensorSize(240, 180))
    np.testing.assert_array_equal(places, FISHEYE.undistorted(SensorSize(240, 180)))
    with pytest.raises(InputError, match="is of a 240x180 sensor, the events are 8x6"):
        undistort(packets(stream([(0, 0, 1, 1)])), read)
    path.write_text(KALIBR + KALIBR.replace("cam0", "cam1").replace("110.0, 110.0", "99.0, 99.0"))
    with pytest.raises(InputError, match=r"holds cam0, cam1; choose one: .*chain.yaml:cam0"):
        read_calibration(path)
    assert read_calibration(Path(f"{path}:cam1")).facts["intrinsics"][0] == 99.0


WRONG = {
    "txt": [
        *("1 2 3", "a b", "", "0 1 1 1 0 0 0 0 0", "nan 1 1 1 0 0 0 0 0", "1 1 1 1 inf 0 0 0 0"),
        "-9 9 9 9 0 0 0 0 0",
    ],
    "yaml": [
        *("a: 1", "[1]", "{", "cam0: {intrinsics: [1]}"),
        "1: {intrinsics: [1, 1, 1, .nan]}",
        "cam0: {intrinsics: [0, 1, 1, 1]}",
        *(f"cam0: {{intrinsics: [9, 9, 9, {one}]}}" for one in ("true", '"9"', "null", "[9]")),
        *(KALIBR.replace("pinhole", one) for one in ("omni", "ds", "eucm")),
        *(KALIBR.replace("equidistant", one) for one in ("fov", "[fov]")),
        KALIBR.replace("distortion_coeffs", "coeffs"),
        KALIBR.replace("equidistant", "none"),
        KALIBR.replace("distortion_model: equidistant", ""),
        *(KALIBR.replace("0.0005", f"0.0005, {one}") for one in ("0.1", "0.0, 0.0")),
        KALIBR.replace("intrinsics", "others"),
        KALIBR.replace("0.0005", ".inf"),
        *(KALIBR.replace("[240, 180]", one) for one in ("[.inf, 9]", "[9.5, 9]", "[9]", "9")),
    ],
}


@pytest.mark.parametrize(
    ("form", "text"), [(form, text) for form, texts in WRONG.items() for text in texts]
)
def test_what_is_no_calibration_is_one_short_line(tmp_path, form, text):
    path = tmp_path / f"calib.{form}"
    path.write_text(text)
    with pytest.raises(InputError, match=r"calib") as caught:
        read_calibration(path)
    assert len(str(caught.value)) < 400


@pytest.mark.parametrize("names", [("1", "2"), ("left", "right")])
def test_cameras_of_any_name_are_chosen(tmp_path, names):
    path = tmp_path / "chain.yaml"
    path.write_text("".join(KALIBR.replace("cam0", name) for name in names))
    with pytest.raises(
        InputError, match=f"holds {names[0]}, {names[1]}; choose one: .*:{names[0]}"
    ):
        read_calibration(path)
    assert read_calibration(Path(f"{path}:{names[1]}")).facts["model"] == "equidistant"


@given(x=st.floats(-1.5, 9.5), y=st.floats(-1.5, 7.5))
def test_an_event_lands_in_the_pixel_whose_square_holds_its_place(x, y):
    places = np.stack(np.meshgrid(np.arange(8.0), np.arange(6.0)), axis=-1)
    places[2, 3] = (x, y)
    found = Calibration(places).undistorted(SIZE)[2, 3].tolist()
    column, row = math.floor(x + 0.5), math.floor(y + 0.5)
    is_inside = 0 <= column < SIZE.width and 0 <= row < SIZE.height
    if 0.5 not in (x % 1.0, y % 1.0):  # on a rim, either
        assert found == ([column, row] if is_inside else [-1, -1])


def test_a_rectify_map_says_where_each_pixel_belongs(tmp_path):
    path = tmp_path / "rectify_map.h5"
    places = np.stack(np.meshgrid(np.arange(8.0), np.arange(6.0)), axis=-1).astype(np.float32)
    places[2, 3] = (5.4, 0.6)
    places[0, 0] = (-1, 2)
    places[5, 7] = np.nan
    with h5py.File(path, "w") as file:
        file["rectify_map"] = places
    events = stream([(3, 2, 1, 1), (0, 0, 2, 0), (7, 5, 3, 1), (1, 1, 4, 0)])
    with pytest.warns(TexventWarning, match="50% of the events land outside"):
        moved = undistort(packets(events), read_calibration(path)).collect()
    assert list(zip(moved.x, moved.y, moved.t, strict=True)) == [(5, 1, 1), (1, 1, 4)]


GRID = np.stack(np.meshgrid(np.arange(8.0), np.arange(6.0)), axis=-1).astype(np.float32)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda file: file.update(other=GRID), "no rectify_map"),
        (lambda file: file.update(rectify_map=GRID[..., 0]), "no rectify_map"),
        (lambda file: file.update(rectify_map=GRID.astype("i4")), "no rectify_map"),
        (lambda file: file.update(rectify_map=GRID[..., ::-1]), "x, then y, in pixels"),
        (lambda file: file.update(rectify_map=GRID / 200), "x, then y, in pixels"),
        (lambda file: file.update(rectify_map=GRID * np.nan), "leaves 0% .*check its rectify_map"),
        (lambda file: file.update(rectify_map=GRID + 100), "leaves 0% of the pixels on a 8x6"),
        (lambda file: file.update(rectify_map=GRID.transpose(1, 0, 2)), "x, then y, in pixels"),
        (
            lambda file: file.create_dataset("rectify_map", (20_000, 20_000, 2), "f4", chunks=True),
            "stores at most 0",
        ),
        (
            lambda file: file.create_dataset(
                "rectify_map", (6, 8, 2), "f4", external=[("/etc/passwd", 0, 384)]
            ),
            "in other files",
        ),
    ],
)
def test_a_map_that_cannot_be_meant_is_refused(tmp_path, change, message):
    path = tmp_path / "rectify_map.h5"
    with h5py.File(path, "w") as file:
        change(file)
    with pytest.raises(InputError, match=message):
        undistort(packets(stream([(1, 1, 1, 1)])), read_calibration(path))


def test_a_damaged_map_is_called_damaged(tmp_path):
    path = tmp_path / "rectify_map.h5"
    with h5py.File(path, "w") as file:
        file["rectify_map"] = GRID
    path.write_bytes(path.read_bytes()[:1500])
    with pytest.raises(FileFormatError, match="is damaged"):
        read_calibration(path)


@pytest.mark.parametrize("turn", [1, 2, 3])
def test_a_map_may_turn_the_image(tmp_path, turn):
    path = tmp_path / "rectify_map.h5"
    with h5py.File(path, "w") as file:
        file["rectify_map"] = np.rot90(GRID[:6, :6], turn)
    assert read_calibration(path).undistorted(SensorSize(6, 6)).min() == 0


@pytest.mark.parametrize(
    ("lens", "message"),
    [
        (Lens(9.0, 9.0, 300.0, 3.0), "far from the middle of 8x6"),
        (Lens(9.0, 9.0, 4.5, 3.5, "radtan", (-0.9, 0.0)), "% of the events land outside"),
    ],
)
def test_a_calibration_that_hardly_fits_is_warned_of(lens, message):
    events = stream([(x, 5, x, 1) for x in range(8)])
    with pytest.warns(TexventWarning, match=message):
        undistort(packets(events), Calibration(lens)).collect()


@pytest.mark.parametrize("coefficients", [(1e300,) * 5, (1e9,) * 5, (1e9, 0.0)])
def test_coefficients_that_leave_no_pixel_are_refused(coefficients):
    lens = Calibration(Lens(90.0, 90.0, 40.0, 30.0, "radtan", coefficients))
    with pytest.raises(InputError, match="leaves 0% of the pixels on a 80x60 sensor"):
        lens.undistorted(SensorSize(80, 60))
