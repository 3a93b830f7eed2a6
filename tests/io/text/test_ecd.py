import json
from decimal import Decimal
from pathlib import Path

import pytest

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io.files import load, open_events, save
from texvent.io.text import codecs as text_rows
from texvent.sensor import SensorSize

RECORDED = "0.003811000 96 133 0\n0.003820001 127 171 1\n0.003820999 13 34 1\n"
"""Rows as the data set writes them: nine decimals."""


def write(folder: Path, text: str) -> Path:
    path = folder / "events.txt"
    path.write_text(text)
    return path


def test_rows_of_the_data_set_are_read_to_the_microsecond(tmp_path):
    events = load(write(tmp_path, RECORDED), size=(240, 180))
    assert events.t.tolist() == [3811, 3820, 3821]
    assert (events.x.tolist(), events.y.tolist()) == ([96, 127, 13], [133, 171, 34])
    assert events.p.tolist() == [0, 1, 1]


def test_whole_microseconds_are_written_exactly(tmp_path):
    times = [0, 1, 999_999, 1_000_000, 1_790_000_000_123_456]
    for late in ([], [5_000_000_000_000_001, 2**33 * 1_000_000 + 7, 2**63 - 1]):
        ones = [1] * len(times + late)
        events = EventStream.from_columns(ones, ones, times + late, ones, size=SensorSize(4, 4))
        path = save(tmp_path / "events.txt", events, overwrite=True)
        assert path.read_text().split("\n")[4] == "1790000000.123456 1 1 1"
        assert load(path).equals(events)


def test_size_and_metadata_lie_beside_the_rows(tmp_path):
    events = EventStream.from_columns([1], [2], [3], [1], size=SensorSize(4, 5))
    path = save(tmp_path / "events.txt", events.with_metadata({"seed": 0}))
    beside = json.loads((tmp_path / "events.txt.json").read_text())
    assert beside == {"width": 4, "height": 5, "texvent": {"seed": 0}}
    assert path.read_text() == "0.000003 1 2 1\n"


def test_blocks_that_cut_lines_change_nothing(tmp_path, monkeypatch):
    path = write(tmp_path, RECORDED * 1)
    whole = load(path, size=(240, 180))
    monkeypatch.setattr(text_rows, "BLOCK_BYTES", 30)
    packets = list(open_events(path, size=(240, 180)))
    assert len(packets) > 1
    assert EventStream.concat(packets).equals(whole)


def test_a_file_without_a_last_newline_is_whole(tmp_path):
    assert len(load(write(tmp_path, RECORDED.rstrip("\n")), size=(240, 180))) == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("0.1 1 1\n", "rows of 3 values without names"),
        ("0.1 1 1 maybe\n", "polarity holds 'maybe'"),
        ("0.1 1 1 1\n0.2 1\n", "not rows of 4 numbers.*--repair"),
        ("nan 1 1 1\n", "no numbers of s"),
        ("1e30 1 1 1\n", "no numbers of us"),
        ("9223372036854.775808 1 1 1\n", "not rows of 4 numbers"),
        ("0.1 1.5 1 1\n", "not whole numbers"),
        ("0.1 4 1 1\n", "x runs from 4 to 4"),
        ("0.1 1 1 2\n", "polarity holds"),
        ("0.2 1 1 1\n0.1 1 1 1\n", "time decreases"),
    ],
)
def test_a_wrong_row_is_one_clear_line(tmp_path, text, message):
    with pytest.raises(FileFormatError, match=message) as caught:
        load(write(tmp_path, text), size=(4, 4))
    assert "\n" not in str(caught.value)


def test_a_damaged_companion_file_is_reported(tmp_path):
    path = write(tmp_path, RECORDED)
    for text in ("{", "[]", '{"width": 4}', '{"width": "a", "height": 4}'):
        (tmp_path / "events.txt.json").write_text(text)
        with pytest.raises(FileFormatError):
            load(path)


@pytest.mark.parametrize(
    ("step", "unit", "meant"),
    [
        ("10.5", "s", "ms"),
        ("10500.5", "s", "us"),
        ("100000000000", "us", None),
        ("500000", "us", "ns"),
    ],
)
def test_times_that_cannot_be_meant_name_the_likely_unit(tmp_path, step, unit, meant):
    path = write(tmp_path, "".join(f"{k * Decimal(step)} 3 4 1\n" for k in range(9_000)))
    wanted = f"probably {meant}: give" if meant else r"give time_unit \(--time-unit s, ms"
    with pytest.raises(FileFormatError, match=f"read as {unit} .*{wanted}"):
        load(path, size=(240, 180))
    assert len(load(path, size=(240, 180), time_unit=meant or unit)) == 9_000


@pytest.mark.parametrize("clock_us", [0, 1_700_000_000_123_456])
@pytest.mark.parametrize(("unit", "more"), [("s", 6), ("ms", 3), ("us", 0), ("ns", -3)])
def test_text_of_any_unit_and_clock_is_the_nearest_us_and_ns_are_cut(
    tmp_path, unit, more, clock_us
):
    # Of a Unix time, a float64 holds no tenths of a µs: only ns, which are read as whole numbers.
    tenths = [10, 14, 26, 38, 51] if unit == "ns" or not clock_us else [10, 10, 30, 40, 50]
    exact = [(clock_us + Decimal(one) / 10).scaleb(-more) for one in tenths]
    path = write(tmp_path, "".join(f"{one:f} 3 4 1\n" for one in exact))
    cut = [1, 1, 2, 3, 5] if unit == "ns" else [1, 1, 3, 4, 5]
    found = load(path, size=(240, 180), time_unit=unit)
    assert found.t.tolist() == [clock_us + one for one in cut]


def test_a_quiet_sensor_is_no_wrong_unit(tmp_path):
    path = write(tmp_path, "".join(f"{k * Decimal('0.19')} 3 4 1\n" for k in range(500)))
    assert len(load(path, size=(240, 180))) == 500
    assert len(load(write(tmp_path, "0.5 1 1 1\n86400.5 1 1 1\n"), size=(4, 4))) == 2


@pytest.mark.parametrize(
    ("text", "options"),
    [
        ("\ufeff0.000070 3 5 1\n0.000080 4 6 0\n", {}),
        ("9 9\n0.000070 3 5 1\n0.000080 4 6 0\n", {}),
        ("# exported\n\n% by hand\n70,3,5,1\n# again\n80,4,6,0\n", {}),
        ("70\t3\t5\ttrue\n80\t4\t6\tfalse\n", {}),
        ("Timestamp [us];X;Y;Polarity\n70;3;5;True\n80;4;6;False\n", {}),
        ("t_ns,x,y,p\n70999,3,5,1\n80000,4,6,0\n", {}),
        ("t (ms) x y p\n".replace(" (ms)", "[ms]") + "0.07 3 5 1\n0.08 4 6 0\n", {}),
        ("3 5 1 70\n4 6 0 80\n", {}),
        ("3 5 70 1\n4 6 80 0\n", {}),
        ("3 5 0.00007 1 7\n4 6 0.00008 0 8\n", {"columns": "x,y,t,p,_"}),
        ("a,b,c,d\n70,3,5,1\n80,4,6,0\n", {"columns": "t=a,x=b,y=c,p=d"}),
        ("70 3 5 1\n80 4 6 0\n", {"time_unit": "us"}),
    ],
)  # fmt: skip
def test_dialects_of_other_programs_are_read(tmp_path, text, options):
    expected = EventStream.from_columns([3, 4], [5, 6], [70, 80], [1, 0], size=SensorSize(9, 9))
    for name in ("events.txt", "events.csv", "events.rows"):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        assert load(path, size=(9, 9), **options).equals(expected), name


def test_an_order_that_is_not_certain_is_asked_for(tmp_path):
    path = tmp_path / "events.csv"
    path.write_text("1,1,5,1\n2,1,5,1\n")
    with pytest.raises(InputError, match=r"fit txyp and xytp \(the first is 1, 1, 5, 1\); give"):
        load(path, size=(9, 9))
    assert load(path, size=(9, 9), columns="t,x,y,p").x.tolist() == [1, 1]
