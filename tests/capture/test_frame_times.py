import contextlib

import numpy as np
import pytest
from tests.video_check.made_clips import encode

from texvent.capture.frame_times import listed_times, read_timestamps
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.video import Video
from texvent.view.video.writer import write_images


@pytest.mark.parametrize(
    ("unit", "lines", "expected"),
    [
        ("s", "0.0000014\n1e-3\n", (1, 1000)),
        ("ms", "0.5,a.png\n1.5,b.png\n", (500, 1500)),
        ("us", "# t\n\n7 a.png\n9 b.png\n", (7, 9)),
        # A float64 cannot hold these: its step is 256 ns here.
        ("ns", "1700000000123456501\n1700000000123457789\n", (1700000000123457, 1700000000123458)),
    ],
)
def test_times_are_rounded_from_the_exact_decimal(tmp_path, unit, lines, expected):
    path = tmp_path / "t.txt"
    path.write_text(lines)
    assert tuple(read_timestamps(path, unit).times.listed_us) == expected


@pytest.mark.parametrize("count", [3, 5, 6])
@pytest.mark.parametrize("kind", ["array", "stored array", "images", "video"])
def test_a_list_has_as_many_times_as_there_are_frames(tmp_path, kind, count):
    images = np.random.default_rng(1).integers(0, 256, (5, 16, 16), dtype=np.uint8)
    times = [20_000 * number**2 for number in range(count)]
    (tmp_path / "t.txt").write_text("".join(f"{one}\n" for one in times))
    config = CaptureConfig(timestamps=tmp_path / "t.txt", timestamps_unit="us")
    source, given = images, {"t_us": times}
    if kind != "array":
        given = {}
        source = tmp_path / {"stored array": "a.npy", "images": "images", "video": "a.avi"}[kind]
        if kind == "stored array":
            np.save(source, images)
        elif kind == "video":
            encode(images, source, codec="ffv1")
        else:
            write_images(Video(images, list(range(5))), source, overwrite=False)
    with contextlib.nullcontext() if count == 5 else pytest.raises(InputError, match="one time"):
        frames = list(open_frames(source, CaptureConfig() if given else config, **given))
        assert [frame.t_us for frame in frames] == times


def test_names_follow_the_times_and_may_hold_spaces(tmp_path):
    path = tmp_path / "t.txt"
    path.write_text("0 first\u2028shot.png\n1 second.png\n")
    assert read_timestamps(path, "s").names == ("first\u2028shot.png", "second.png")


@pytest.mark.parametrize(
    ("lines", "error", "message"),
    [
        ("0\n2\n1\n", InputError, "time 2 .* is not after time 1"),
        ("0\n0\n", InputError, "strictly increase"),
        ("1\n2\n", InputError, "another unit: `timestamps_unit`"),
        ("0\nabc\n", FileFormatError, "line 2 begins with 'abc'"),
        ("0\nnan\n", FileFormatError, "line 2 begins with 'nan'"),
        ("0 a.png\n1\n", FileFormatError, "1 of 2 lines name a file"),
        ("# nothing\n", FileFormatError, "has no times"),
    ],
)
def test_wrong_files_are_refused(tmp_path, lines, error, message):
    path = tmp_path / "t.txt"
    path.write_text(lines)
    with pytest.raises(error, match=message):
        read_timestamps(path, "ns" if lines == "1\n2\n" else "s")


def test_names_may_come_before_the_times(tmp_path):
    path = tmp_path / "info.txt"
    path.write_text("/data/clip/a.png 0\n/data/clip/b c.png 33333\n")
    found = read_timestamps(path, "us")
    assert found.names == ("/data/clip/a.png", "/data/clip/b c.png")
    assert list(found.times.listed_us) == [0, 33_333]


@pytest.mark.parametrize(
    ("step", "units"),
    [
        ("33", ["ms (30.3 frames per second, 0.033 s in all)"]),
        ("33.4", []),
        ("500", ["ms", "us (2,000 frames per second"]),
        ("1000", ["ms", "us (1,000 frames per second"]),
        ("33333", ["us"]),
        ("33333333", ["ns"]),
    ],
)
def test_times_that_are_hardly_seconds_name_the_units_that_fit(tmp_path, step, units):
    path = tmp_path / "t.txt"
    path.write_text(f"57922807588\n{57922807588 + float(step):.1f}\n")
    if not units:
        with pytest.warns(TexventWarning, match=r"33.4 s apart; if they are ms \(29.94"):
            read_timestamps(path, None)
        return
    with pytest.raises(InputError) as caught:
        read_timestamps(path, None)
    said = str(caught.value)
    assert all(unit in said for unit in units)
    assert "give `timestamps_unit`" in said
    assert sum(f" {unit} (" in said for unit in ("ms", "us", "ns")) == len(units)
    assert len(read_timestamps(path, units[0][:2]).times.listed_us) == 2
    assert len(read_timestamps(path, "s").times.listed_us) == 2


@pytest.mark.parametrize(
    "lines", ["0\n0.033\n0.066\n", "0\n0.25\n60\n60.25\n", "1.7e9\n1700000000.04\n"]
)
def test_times_that_can_be_seconds_are_not_doubted(tmp_path, lines):
    path = tmp_path / "t.txt"
    path.write_text(lines)
    read_timestamps(path, None)


def test_whole_numbers_that_may_be_seconds_are_said(tmp_path):
    path = tmp_path / "t.txt"
    path.write_text("0\n1\n2\n")
    with pytest.warns(TexventWarning, match=r"1 s apart; if they are ms .* give `timestamps_unit`"):
        assert list(read_timestamps(path, None).times.listed_us) == [0, 1_000_000, 2_000_000]


def test_times_in_memory_that_are_hardly_microseconds_are_said():
    with pytest.warns(TexventWarning, match="33 µs apart, 30,303 per second"):
        listed_times([0, 33, 66])
    listed_times([0, 100, 200])
