import contextlib

import numpy as np
import pytest
from tests.video_check.made_clips import encode

from texvent.capture.given_times import listed_times, read_timestamps
from texvent.capture.open import open_frames
from texvent.config import CaptureConfig
from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.frames import Video
from texvent.view.video_writer import write_images


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


ROWS = {"": "0{0}a.png{1}0.04{0}b.png{1}", "first": "a.png{0}0{1}b.png{0}0.04{1}"}
HEADERS = ("", "timestamp{0}filename{1}", "# t{0}name{1}", "\ufeff{1}time [s]{0}image{1}{1}")


@pytest.mark.parametrize("row", ROWS.values(), ids=list(ROWS))
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r", " # a comment\n", " \n\n"])
@pytest.mark.parametrize("separator", [" ", "  ", "\t", ",", ", ", ";", "\u00a0"])
def test_a_table_of_times_is_read_however_it_is_written(tmp_path, separator, end, row):
    path = tmp_path / "t.txt"
    for header in HEADERS:
        path.write_text((header + row).format(separator, end), encoding="utf-8", newline="")
        found = read_timestamps(path, "s")
        assert (list(found.times.listed_us), found.names) == ([0, 40_000], ("a.png", "b.png"))
        bare = row.replace("{0}a.png", "").replace("a.png{0}", "")
        bare = bare.replace("{0}b.png", "").replace("b.png{0}", "")
        path.write_text((header + bare).format(separator, end), encoding="utf-8", newline="")
        assert read_timestamps(path, "s").names is None


@pytest.mark.parametrize(
    ("line", "name"),
    [
        ("{} first\u2028shot.png", "first\u2028shot.png"),
        ("{} a,b.png", "a,b.png"),
        ('"{}","a, b.png"', "a, b.png"),
        ("'a b.png' {}", "'a b.png'"),
        ("{} shot #1.png", "shot #1.png"),
        ("/data/clip/b c.png {}", "/data/clip/b c.png"),
    ],
)
def test_names_may_hold_spaces_and_what_separates_others(tmp_path, line, name):
    path = tmp_path / "t.txt"
    path.write_text(f"{line.format(0, 0)}\n{line.format(1, 1)}\n")
    with pytest.warns(TexventWarning, match="more than once, so the same image is shown again"):
        assert read_timestamps(path, "s").names == (name, name)


@pytest.mark.parametrize(
    ("lines", "error", "message"),
    [
        ("0\n2\n1\n", InputError, "time 2 .* is not after time 1"),
        ("0\n0\n", InputError, "strictly increase"),
        ("1\n2\n", InputError, "another unit: `timestamps_unit`"),
        ("0\nabc\n", FileFormatError, "line 2 is 'abc'; each line must hold one time"),
        ("0\nnan\n", FileFormatError, "line 2 is 'nan'"),
        ("0 a.png\n1\n", FileFormatError, "1 of 2 lines name a file"),
        ("0,00\n0,04\n", FileFormatError, "line 1 is '0,00'; .*decimal point"),
        ("0 0.0\n1 0.04\n", FileFormatError, "line 1 is '0 0.0'; each line must hold one time"),
        ("0;a.png;7\n1;b.png;7\n", FileFormatError, "line 1 is '0;a.png;7'"),
        ("time\nname\n", FileFormatError, "line 2 is 'name'"),
        ("2024-05-01 12:00:00.04\n", FileFormatError, "A date is no number: write"),
        ("a.png,12:00:00.04\n", FileFormatError, "A date is no number: write"),
        ("20240501_120000\n", FileFormatError, "line 1 .*A date is no number: write"),
        ("20240501120000\n", FileFormatError, "beyond 64 bits .*A date is no number: write"),
        ("# nothing\n", FileFormatError, "has no times"),
    ],
)
def test_wrong_files_are_refused(tmp_path, lines, error, message):
    path = tmp_path / "t.txt"
    path.write_text(lines)
    with pytest.raises(error, match=message):
        read_timestamps(path, "ns" if lines == "1\n2\n" else "s")


def test_a_list_that_cannot_be_read_is_named(tmp_path):
    with pytest.raises(InputError, match=r"none\.txt does not exist; check `timestamps`"):
        read_timestamps(tmp_path / "none.txt", "s")
    (tmp_path / "t.txt").write_bytes(b"0 caf\xe9.png\n")
    with pytest.raises(FileFormatError, match=r"cannot be read \(.*save it as UTF-8 text"):
        read_timestamps(tmp_path / "t.txt", "s")


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
    with pytest.warns(TexventWarning, match=r"33 µs apart.* ms \(30.3 .*, multiply them by 1000"):
        listed_times([0, 33, 66])
    with pytest.warns(TexventWarning, match=r"ns \(25 .*, divide them by 1000"):
        listed_times([0, 40_000_000, 80_000_000])
    listed_times([0, 100, 200])
