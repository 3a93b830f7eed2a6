import pytest

from texvent.capture.frame_times import read_timestamps
from texvent.errors import FileFormatError, InputError


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


@pytest.mark.parametrize(("step", "unit"), [("500", "ms"), ("33333", "us"), ("33333333", "ns")])
def test_times_that_are_hardly_seconds_name_the_likely_unit(tmp_path, step, unit):
    path = tmp_path / "t.txt"
    path.write_text(f"57922807588\n{57922807588 + int(step)}\n")
    with pytest.raises(InputError, match=f"probably {unit}; give `timestamps_unit`"):
        read_timestamps(path, None)
    assert len(read_timestamps(path, unit).times.listed_us) == 2
    path.write_text("0\n60\n")
    assert list(read_timestamps(path, None).times.listed_us) == [0, 60_000_000]
