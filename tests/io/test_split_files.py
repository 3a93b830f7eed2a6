"""Recordings cut into files by frame times and by tables of labels."""

import itertools

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from texvent.errors import FileFormatError, InputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.files import load
from texvent.io.split_files import Interval, read_intervals, split, write_split
from texvent.sensor import SensorSize

SIZE = SensorSize(4, 3)
TIMES = [5, 10, 11, 11, 25, 39, 40, 41]


def events() -> EventStream:
    zeros = [0] * len(TIMES)
    return EventStream.from_columns(zeros, zeros, TIMES, zeros, size=SIZE)


def packets(*cuts: int) -> EventPackets:
    ends = [0, *cuts, len(TIMES)]
    return EventPackets([events()[a:b] for a, b in itertools.pairwise(ends)], SIZE)


PLACES = st.integers(0, 50)


@given(
    st.lists(st.tuples(PLACES, PLACES).map(sorted), max_size=5),
    st.lists(st.integers(0, len(TIMES)), max_size=7).map(sorted),
)
@example([(10, 25), (25, 40), (0, 100), (90, 95), (11, 12)], [3, 3])
def test_intervals_are_half_open_and_packets_may_be_cut_anywhere(ends, cuts):
    found = list(split(packets(*cuts), [Interval(*pair) for pair in ends]))
    assert sorted(number for number, _ in found) == [*range(len(ends))]
    for number, parts in found:
        start, stop = ends[number]
        times = [t for part in parts for t in part.t.tolist()]
        assert times == [t for t in TIMES if start <= t < stop]


@pytest.mark.parametrize(
    ("text", "intervals"),
    [
        ("0.00001 a.png\n0.000025 b.png\n0.00004 c.png\n", [(10, 25, None), (25, 40, None)]),
        ("# t\n10\n25\n40\n", [(10, 25, None), (25, 40, None)]),
        ("class,startTime_usec,endTime_usec\n7,10,25\n8,20,40\n", [(10, 25, "7"), (20, 40, "8")]),
        ("start end label\n0.00001 0.000025 wave\n", [(10, 25, "wave")]),
        ("7 10 25\n", [(10, 25, "7")]),
        ("label,start,end\nright hand wave,10,25\n", [(10, 25, "right hand wave")]),
        ('label;start;end\n"a; b";10;25\n', [(10, 25, "a; b")]),
        ('"wave, left",10,25\n"größe",25,40\n', [(10, 25, "wave, left"), (25, 40, "größe")]),
        ("label\tstart\tend\nright hand\t10\t25\n", [(10, 25, "right hand")]),
        ('"right hand" 10 25\n', [(10, 25, "right hand")]),
        ("-1.5\n-0.25\n2\n", [(-1_500_000, -250_000, None), (-250_000, 2_000_000, None)]),
    ],
)
def test_times_and_tables_are_read(tmp_path, text, intervals):
    path = tmp_path / "t.txt"
    path.write_text(text)
    assert read_intervals(path) == [Interval(*one) for one in intervals]


def test_what_is_no_table_of_times_is_refused(tmp_path):
    path = tmp_path / "t.txt"
    for text in (
        "",
        "a b\n",
        "10\n",
        "10\n10\n",
        "10\nx\n",
        "7 25 10\n",
        "/ 10 25\n",
        "7 1 2\n7 1\n",
    ):
        path.write_text(text)
        with pytest.raises(FileFormatError):
            read_intervals(path)
    with pytest.raises(InputError, match="no such file"):
        read_intervals(tmp_path / "none.txt")


def test_a_folder_has_one_file_per_frame_interval(tmp_path):
    folder = tmp_path / "split"
    intervals = [Interval(10, 25), Interval(25, 40)]
    assert write_split(packets(3), intervals, folder, format="npz") == 5
    assert sorted(one.name for one in folder.iterdir()) == [
        *("000000.npz", "000001.npz", "timestamps.txt")
    ]
    assert (folder / "timestamps.txt").read_text() == "0.000010\n0.000025\n0.000040\n"
    with np.load(folder / "000001.npz") as arrays:
        assert arrays["t"].tolist() == [25, 39]
        assert arrays["p"].tolist() == [0, 0]
    assert read_intervals(folder / "timestamps.txt") == intervals
    write_split(packets(), intervals, folder, overwrite=True)


def test_labels_make_a_folder_each(tmp_path):
    folder = tmp_path / "split"
    write_split(
        packets(), [Interval(0, 11, "wave"), Interval(39, 50, "clap")], folder, format="hdf5"
    )
    assert load(folder / "clap" / "000001.h5").t.tolist() == [39, 40, 41]
    with pytest.raises(InputError, match=r"no event lies in the intervals, 900\.\.990 µs"):
        write_split(packets(), [Interval(900, 990)], tmp_path / "none")
    assert not (tmp_path / "none").exists()
    assert (folder / "labels.csv").read_text().splitlines() == [
        "file,label,start_us,stop_us",
        "wave/000000.h5,wave,0,11",
        "clap/000001.h5,clap,39,50",
    ]


def test_labels_become_folders_of_their_own(tmp_path):
    intervals = [Interval(10, 25, "right hand"), Interval(25, 40, "../x, y")]
    write_split(packets(3), intervals, tmp_path / "parts")
    found = sorted(str(one.relative_to(tmp_path)) for one in tmp_path.rglob("*.npz"))
    assert found == ["parts/___x__y/000001.npz", "parts/right_hand/000000.npz"]
    assert '000001.npz,"../x, y",25,40' in (tmp_path / "parts/labels.csv").read_text()
    path = tmp_path / "same.csv"
    path.write_text("label,start,end\na b,1,2\na-b,2,3\nA_b,3,4\n")
    with pytest.raises(FileFormatError, match="'a b' and 'A_b' would have one folder"):
        read_intervals(path)


def test_times_below_zero_are_written_as_they_are(tmp_path):
    intervals = [Interval(-1_500_000, -250_000), Interval(-250_000, 2_000_000)]
    write_split(packets(3), intervals, tmp_path / "parts")
    written = (tmp_path / "parts/timestamps.txt").read_text()
    assert written == "-1.500000\n-0.250000\n2.000000\n"
