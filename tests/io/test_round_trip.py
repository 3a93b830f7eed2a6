"""Every codec carries every stream unchanged."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import ConfigError, FileFormatError, InputError, OutputError
from texvent.event_packets import EventPackets
from texvent.events import EventStream
from texvent.io.files import codec_for, load, open_events, open_writer, save
from texvent.sensor import SensorSize

EXTENSIONS = (".h5", ".npz", ".txt")
extensions = pytest.mark.parametrize("extension", EXTENSIONS)


@extensions
def test_every_stream_comes_back_unchanged(
    tmp_path: Path, stream: EventStream, extension: str
) -> None:
    path = save(tmp_path / f"events{extension}", stream)
    back = load(path)
    assert back.equals(stream)
    assert dict(back.metadata) == dict(stream.metadata)
    assert back.t.dtype == np.int64


@extensions
def test_packet_sizes_do_not_change_the_file_content(tmp_path: Path, extension: str) -> None:
    times = np.arange(1000) * 7
    whole = EventStream(times % 10, times % 9, times, times % 2, SensorSize(10, 9))
    cuts = [0, 0, 1, 2, 500, 501, 1000]
    parts = [whole[start:stop] for start, stop in itertools.pairwise(cuts)]
    path = save(tmp_path / f"events{extension}", EventPackets(parts, whole.size, {"seed": 1}))
    back = open_events(path)
    assert back.metadata == {"seed": 1}
    assert back.collect().equals(whole)
    assert back.collect().equals(whole), "packets of a file can be read again"


@extensions
def test_an_error_midway_leaves_no_file(
    tmp_path: Path, extension: str, folder_is_clean: Callable[[], bool]
) -> None:
    def packets() -> Iterator[EventStream]:
        yield EventStream.from_columns([1], [1], [5], [1], size=SensorSize(4, 4))
        raise RuntimeError("the simulator stopped")

    with pytest.raises(RuntimeError, match="the simulator stopped"):
        save(tmp_path / f"events{extension}", EventPackets(packets(), SensorSize(4, 4)))
    assert folder_is_clean()


@extensions
def test_packets_out_of_order_or_of_another_size_are_refused(
    tmp_path: Path, extension: str, folder_is_clean: Callable[[], bool]
) -> None:
    late = EventStream.from_columns([1], [1], [50], [1], size=SensorSize(4, 4))
    early = EventStream.from_columns([1], [1], [49], [1], size=SensorSize(4, 4))
    wide = EventStream.from_columns([1], [1], [60], [1], size=SensorSize(5, 4))
    for second in (early, wide):
        with pytest.raises(InputError):
            save(tmp_path / f"e{extension}", EventPackets([late, second], SensorSize(4, 4)))
    assert folder_is_clean()


@extensions
def test_an_existing_file_is_kept_unless_overwriting_is_allowed(
    tmp_path: Path, extension: str
) -> None:
    first = EventStream.from_columns([1], [1], [5], [1], size=SensorSize(4, 4))
    second = EventStream.from_columns([2], [2], [6], [0], size=SensorSize(4, 4))
    path = save(tmp_path / f"events{extension}", first)
    with pytest.raises(OutputError, match="exists already"):
        open_writer(path, size=first.size)
    assert load(path).equals(first)
    save(path, second, overwrite=True)
    assert load(path).equals(second)


@extensions
def test_a_missing_file_and_a_folder_are_input_errors(tmp_path: Path, extension: str) -> None:
    with pytest.raises(InputError, match="no such file"):
        load(tmp_path / f"missing{extension}")
    folder = tmp_path / f"folder{extension}"
    folder.mkdir()
    with pytest.raises(InputError, match="is a folder"):
        load(folder)


@extensions
def test_an_empty_or_foreign_file_is_a_format_error(tmp_path: Path, extension: str) -> None:
    path = tmp_path / f"events{extension}"
    for content in (b"", b"\x89PNG\r\n\x1a\n" + bytes(300), b"three words here\n"):
        path.write_bytes(content)
        if extension == ".txt" and not content:
            assert len(load(path, size=(4, 4))) == 0
            continue
        with pytest.raises(FileFormatError) as caught:
            load(path, size=(4, 4))
        assert "\n" not in str(caught.value)


@extensions
def test_a_writer_outside_its_with_block_says_so(tmp_path: Path, extension: str) -> None:
    writer = open_writer(tmp_path / f"events{extension}", size=SensorSize(4, 4))
    event = EventStream.from_columns([1], [1], [5], [1], size=SensorSize(4, 4))
    with pytest.raises(OutputError, match="with block"):
        writer.append(event)


@extensions
def test_metadata_that_is_not_json_is_refused_before_any_file_exists(
    tmp_path: Path, extension: str, folder_is_clean: Callable[[], bool]
) -> None:
    with pytest.raises(InputError, match="metadata cannot be stored"):
        open_writer(tmp_path / f"e{extension}", size=SensorSize(4, 4), metadata={"scene": object()})
    assert folder_is_clean()


@pytest.mark.parametrize("extension", [".h5", ".npz"])
def test_the_noise_label_is_kept(tmp_path: Path, extension: str) -> None:
    label = np.array([0, 1, 0], dtype=np.uint8)
    events = EventStream(
        np.arange(3), np.arange(3), np.arange(3), np.ones(3, int), SensorSize(4, 4), {}, label
    )
    assert load(save(tmp_path / f"e{extension}", events)).equals(events)


def test_the_format_may_be_given_instead_of_an_extension(tmp_path: Path) -> None:
    events = EventStream.from_columns([1], [1], [5], [1], size=SensorSize(4, 4))
    path = save(tmp_path / "events.bin2", events, format="npz")
    assert load(path, format="npz").equals(events)


def test_a_format_may_be_read_under_any_name_but_not_written_under_that_of_another(
    tmp_path: Path,
) -> None:
    events = EventStream.from_columns([1], [1], [5], [1], size=SensorSize(4, 4))
    save(tmp_path / "events.npz", events).rename(tmp_path / "events.dat")
    assert load(tmp_path / "events.dat", format="npz").equals(events)
    with pytest.raises(ConfigError, match=r"name it other\.npz"):
        save(tmp_path / "other.dat", events, format="npz")


def test_an_unknown_extension_lists_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(ConfigError, match=r"'\.xyz'.*\.h5, .*\.npz, .*\.es, .*state the format"):
        codec_for(tmp_path / "events.xyz")
    with pytest.raises(ConfigError, match="no extension"):
        codec_for(tmp_path / "events")
    with pytest.raises(ConfigError, match=r"unknown event format 'hdf'.*did you mean 'hdf5'"):
        codec_for(tmp_path / "events.h5", "hdf")


def test_extensions_are_read_in_any_case(tmp_path: Path) -> None:
    assert codec_for(tmp_path / "EVENTS.H5").name == "hdf5"


@settings(max_examples=25)
@given(
    rows=st.lists(
        st.tuples(st.integers(0, 9), st.integers(0, 6), st.integers(0, 3_000_000), st.booleans()),
        max_size=30,
    ),
    cut=st.integers(0, 30),
)
def test_any_events_cut_anywhere_come_back_from_hdf5_and_text(
    tmp_path_factory: pytest.TempPathFactory,
    rows: list[tuple[int, int, int, bool]],
    cut: int,
) -> None:
    rows = sorted(rows, key=lambda row: row[2])
    x, y, t, p = (list(column) for column in zip(*rows, strict=True)) if rows else ([],) * 4
    events = EventStream.from_columns(x, y, t, p, size=SensorSize(10, 7))
    folder = tmp_path_factory.mktemp("any")
    for extension in (".h5", ".txt"):
        parts = EventPackets([events[:cut], events[cut:]], events.size)
        assert load(save(folder / f"e{extension}", parts)).equals(events)
