"""Every format carries every stream it can hold unchanged, and refuses the others by name."""

import itertools
import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.errors import ConfigError, InputError, OutputError, TexventWarning
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io import block_writer
from texvent.io.files import codec_for, event_extensions, load, open_events, open_writer, save
from texvent.sensor import SensorSize

from .format_cases import CASE_OF, CASES, METADATA, STREAMS, FormatCase, at_times, random_events

EMPTY_FILES = ("atis", "csv", "ecd")
"""Formats without a header: an empty file is a recording without events."""
ANY_BYTES = ("atis",)
"""Every file of the right length is a recording."""
LABELLED = ("hdf5", "npz", "dsec")
"""Formats that keep the noise label."""
WHOLE_CHUNKS = ("hdf5", "dsec", "event-utils")
"""Formats whose chunks are as long as the blocks that they are given."""
LIMITED = [case for case in CASES if case.largest.width < 65_535]


@pytest.fixture(params=CASES, ids=lambda case: case.name)
def case(request: pytest.FixtureRequest) -> FormatCase:
    chosen: FormatCase = request.param
    return chosen


@pytest.mark.parametrize("name", STREAMS)
def test_every_stream_comes_back_unchanged(tmp_path, case, name):
    stream = STREAMS[name](case)
    path = save(tmp_path / case.file, stream, format=case.name)
    back = load(path)
    assert back.equals(stream)
    assert dict(back.metadata) == dict(stream.metadata)
    assert back.t.dtype == np.int64


@pytest.mark.parametrize("name", ["other", "other.dat", "other.xyz"])
def test_content_decides_whatever_the_name(tmp_path, case, name):
    stream = random_events(20, case.sensor)
    path = save(tmp_path / case.file, stream, format=case.name)
    codec = codec_for(path, case.name)
    if path.is_dir() or codec.recognises(path) is None:
        pytest.skip("a folder, or a format without a mark of its own")
    assert load(path.rename(tmp_path / name)).equals(stream)


def test_metadata_known_only_at_the_end_is_stored(tmp_path, case):
    stream = random_events(3000, case.sensor)
    path = tmp_path / case.file
    with open_writer(path, size=stream.size, metadata=METADATA, format=case.name) as writer:
        writer.append(stream[:2000])
        writer.add_metadata({"complete": False, "stopped_us": 5})
        writer.append(stream[2000:])
    back = load(path, format=case.name)
    assert back.equals(stream)
    assert dict(back.metadata) == {**METADATA, "complete": False, "stopped_us": 5}
    beside = {path.name, f"{path.name}.json"}
    assert {one.name for one in tmp_path.iterdir()} <= beside


def test_late_times_come_back_or_are_refused_before_anything_is_kept(tmp_path, case):
    path = tmp_path / case.file
    for last in (
        2**23 - 1,
        2**23,
        2**31 - 1,
        2**31,
        2**32 - 1,
        2**32 + 5,
        2**51 - 1,
        2**53 - 1,
        2**62 - 1,
        *([] if case.stop_us is None else [case.stop_us - 1]),
    ):
        stream = at_times([last - 1, last], case.sensor)
        if case.stop_us is not None and last >= case.stop_us:
            with pytest.raises(InputError, match=f"holds times below {case.stop_us} µs.*hdf5"):
                save(path, stream, format=case.name, overwrite=True)
        else:
            save(path, stream, format=case.name, overwrite=True)
            assert load(path, format=case.name).equals(stream)
    if case.stop_us is not None:
        with pytest.raises(InputError, match="holds times below"):
            save(
                tmp_path / f"late{path.suffix}",
                at_times([case.stop_us], case.sensor),
                format=case.name,
            )
        assert not (tmp_path / f"late{path.suffix}").exists()


@pytest.mark.parametrize("case", LIMITED, ids=lambda case: case.name)
def test_a_sensor_that_does_not_fit_is_refused_with_the_formats_that_hold_it(tmp_path, case):
    for size in (SensorSize(case.largest.width + 1, 1), SensorSize(1, case.largest.height + 1)):
        with pytest.raises(InputError, match=r"cannot write .* holds? sensors .*hdf5 \(\.h5\)"):
            open_writer(tmp_path / case.file, size=size, format=case.name)
    assert not list(tmp_path.iterdir())


def test_labels_are_kept_or_left_out_with_one_warning(tmp_path, case):
    events = at_times([1, 2], case.sensor)
    labelled = replace(events, label=np.array([0, 1]))
    packets = EventPackets([labelled[:1], labelled[1:]], events.size)
    path = tmp_path / case.file
    if case.name in LABELLED:
        assert load(save(path, packets, format=case.name), format=case.name) == labelled
        return
    with pytest.warns(TexventWarning, match=r"signal/noise label.*without_label\(\)") as said:
        save(path, packets, format=case.name)
    assert len(said) == 1
    assert load(path, format=case.name) == events
    save(path, labelled.without_label(), format=case.name, overwrite=True)  # no warning


@pytest.mark.parametrize("block", [block_writer.BLOCK_EVENTS, 128])
def test_packet_sizes_do_not_change_the_file(tmp_path, case, block, monkeypatch):
    if case.name not in WHOLE_CHUNKS:
        monkeypatch.setattr(block_writer, "BLOCK_EVENTS", block)
    whole = random_events(1000, case.sensor).with_metadata({"seed": 1})
    cuts = [0, 0, 1, 2, 500, 501, 1000]
    parts = [whole[start:stop] for start, stop in itertools.pairwise(cuts)]
    files = []
    for index, packets in enumerate([[whole], parts]):
        folder = tmp_path / str(index)
        folder.mkdir()
        path = folder / case.file
        save(path, EventPackets(packets, whole.size, {"seed": 1}), format=case.name)
        back = open_events(path, format=case.name)
        assert back.collect().equals(whole)
        assert back.collect().equals(whole), "packets of a file can be read again"
        files.append(path)
    if files[0].is_file():
        assert files[0].read_bytes() == files[1].read_bytes()


@pytest.mark.parametrize("name", ["aedat4", "rosbag1", "mcap"])
def test_packets_that_players_seek_lie_between_multiples_of_ten_milliseconds(tmp_path, name):
    case = CASE_OF[name]
    events = random_events(1000, case.sensor, span_us=200_000)
    events = replace(events, t=events.t + 7_003)
    save(tmp_path / case.file, events, format=name)
    times = [packet.t for packet in open_events(tmp_path / case.file, format=name)]
    assert len(times) > 10
    assert all(one[0] // 10_000 == one[-1] // 10_000 for one in times)


def test_an_error_midway_leaves_no_file(tmp_path, case):
    def packets() -> Iterator[EventStream]:
        yield random_events(300_000, case.sensor, span_us=1_000_000)
        raise RuntimeError("the simulator stopped")

    with pytest.raises(RuntimeError, match="the simulator stopped"):
        save(tmp_path / case.file, EventPackets(packets(), case.sensor), format=case.name)
    assert not list(tmp_path.iterdir())


def test_packets_out_of_order_are_refused(tmp_path, case):
    late, early = at_times([50], case.sensor), at_times([49], case.sensor)
    with pytest.raises(InputError, match="in time order"):
        save(tmp_path / case.file, EventPackets([late, early], case.sensor), format=case.name)
    assert not list(tmp_path.iterdir())


def test_an_existing_file_is_kept_unless_overwriting_is_allowed(tmp_path, case):
    first, second = at_times([5], case.sensor), at_times([6, 7], case.sensor)
    path = save(tmp_path / case.file, first, format=case.name)
    with pytest.raises(OutputError, match="exists already"):
        save(path, second, format=case.name)
    assert load(path, format=case.name).equals(first)
    save(path, second, format=case.name, overwrite=True)
    assert load(path, format=case.name).equals(second)
    # What is written beside it is kept too.
    for beside in {*tmp_path.iterdir()} - {path}:
        path.unlink()
        with pytest.raises(OutputError, match=f"{beside.name} exists already"):
            save(path, first, format=case.name)
        assert [*tmp_path.iterdir()] == [beside]


def test_metadata_that_is_not_json_is_refused_before_any_file_exists(tmp_path, case):
    with pytest.raises(InputError, match="metadata cannot be stored"):
        open_writer(
            tmp_path / case.file, size=case.sensor, metadata={"a": object()}, format=case.name
        )
    assert not list(tmp_path.iterdir())


def test_an_empty_or_foreign_file_is_an_input_error_of_one_line(tmp_path, case):
    path = tmp_path / case.file
    for content in (b"", b"\x89PNG\r\n\x1a\n" + bytes(301), b"three words here\n"):
        path.write_bytes(content)
        if case.name in EMPTY_FILES and not content:
            assert len(load(path, format=case.name, size=case.sensor)) == 0
            continue
        if case.name in ANY_BYTES and content.startswith(b"\x89"):
            continue
        with pytest.raises(InputError) as caught:
            load(tmp_path / case.file, format=case.name, size=case.sensor)
        assert "\n" not in str(caught.value)


@examples(30)
@given(
    rows=st.lists(
        st.tuples(
            st.integers(0, 127),
            st.integers(0, 47),
            st.one_of(st.integers(0, 600), st.integers(0, 2**23 - 1)),
            st.booleans(),
        ),
        max_size=30,
    ),
    cut=st.integers(0, 30),
    name=st.sampled_from([case.name for case in CASES]),
)
def test_any_events_cut_anywhere_come_back(tmp_path_factory, rows, cut, name):
    chosen = next(case for case in CASES if case.name == name)
    rows = sorted(rows, key=lambda row: row[2])
    x, y, t, p = (list(column) for column in zip(*rows, strict=True)) if rows else ([],) * 4
    size = chosen.sensor if chosen.is_exact_size else SensorSize(128, 48)
    events = EventStream.from_columns(x, y, t, p, size=size, metadata=METADATA)
    parts = EventPackets([events[:cut], events[cut:]], size, METADATA)
    path = tmp_path_factory.mktemp("any") / chosen.file
    back = load(save(path, parts, format=name), format=name)
    assert back.equals(events)
    assert back.metadata == METADATA


@pytest.mark.parametrize(
    ("name", "format", "what"),
    [
        ("mm.aedat4", "evt3", r"\.aedat4 files are not read as evt3; name it mm\.raw"),
        ("o.h5", "aedat4", r"name it o\.aedat4"),
        ("o.npz", "dsec", r"name it o\.h5"),
    ],
)
def test_a_name_of_another_format_is_refused_before_a_file_appears(tmp_path, name, format, what):
    events = EventStream.from_columns([1], [0], [10], [1], size=(4, 3))
    with pytest.raises(ConfigError, match=what):
        events.save(tmp_path / name, format=format)
    assert not list(tmp_path.iterdir())


def test_a_name_of_no_format_may_be_given_to_any(tmp_path):
    events = EventStream.from_columns([1], [0], [10], [1], size=(4, 3))
    events.save(tmp_path / "events.bytes", format="evt3")
    assert load(tmp_path / "events.bytes", format="evt3").equals(events)


def test_none_is_no_path():
    events = EventStream.from_columns([1], [0], [10], [1], size=(4, 3))
    for call in (load, events.save):
        with pytest.raises(InputError, match="None is no path; give a text or a Path"):
            call(None)


@pytest.mark.parametrize(
    ("name", "format"),
    [("e.es", None), ("e.aedat", None), ("e.aedat", "aedat3"), ("e", "evreal"), ("e", "esim"),
     ("e.hdf5", "prophesee-hdf5"), ("e.raw", "evt2"), ("e.parquet", None),
     ("e.db3", None), ("e.DB3", "mcap")],
)  # fmt: skip
def test_formats_that_are_only_read_are_not_written(tmp_path, name, format):
    with pytest.raises(ConfigError, match=r"files are only read; write hdf5 \(\.h5\)"):
        at_times([1], SensorSize(4, 4)).save(tmp_path / name, format=format)
    assert not list(tmp_path.iterdir())


def test_extensions_to_write_are_those_that_are_written(tmp_path):
    for name in ("e.xyz", "e"):
        with pytest.raises(ConfigError, match="event files that are written end in") as caught:
            codec_for(tmp_path / name)
        said = re.findall(r"(\.\w+)[,;]", str(caught.value).split("end in ")[1])
        for extension in event_extensions():
            try:
                codec_for(f"e{extension}")
            except ConfigError:
                assert extension not in said
            else:
                assert extension in said


def test_a_missing_file_and_a_folder_are_input_errors(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        load(tmp_path / "missing.h5")
    (tmp_path / "folder.h5").mkdir()
    with pytest.raises(InputError, match="is a folder"):
        load(tmp_path / "folder.h5")


def test_a_writer_outside_its_with_block_says_so(tmp_path, case):
    writer = open_writer(tmp_path / case.file, size=case.sensor, format=case.name)
    with pytest.raises(OutputError, match="with block"):
        writer.append(at_times([5], case.sensor))


def test_an_unknown_extension_lists_the_known_ones(tmp_path):
    known = r"'\.xyz'.*\.h5, .*\.npz, .*\.aedat4; .*state the format"
    with pytest.raises(ConfigError, match=known):
        codec_for(tmp_path / "events.xyz")
    with pytest.raises(ConfigError, match="no extension"):
        codec_for(tmp_path / "events")
    with pytest.raises(ConfigError, match=r"unknown event format 'hdf'.*did you mean 'hdf5'"):
        codec_for(tmp_path / "events.h5", "hdf")
    assert codec_for(tmp_path / "EVENTS.H5").name == "hdf5"
