"""Every codec carries every stream unchanged."""

from __future__ import annotations

from pathlib import Path

import pytest

from texvent.errors import ConfigError, InputError, OutputError
from texvent.events import EventStream
from texvent.io.files import codec_for, load, open_writer, save
from texvent.sensor import SensorSize

EXTENSIONS = (".h5", ".npz", ".txt")
extensions = pytest.mark.parametrize("extension", EXTENSIONS)


@extensions
def test_a_missing_file_and_a_folder_are_input_errors(tmp_path: Path, extension: str) -> None:
    with pytest.raises(InputError, match="no such file"):
        load(tmp_path / f"missing{extension}")
    folder = tmp_path / f"folder{extension}"
    folder.mkdir()
    with pytest.raises(InputError, match="is a folder"):
        load(folder)


@extensions
def test_a_writer_outside_its_with_block_says_so(tmp_path: Path, extension: str) -> None:
    writer = open_writer(tmp_path / f"events{extension}", size=SensorSize(4, 4))
    event = EventStream.from_columns([1], [1], [5], [1], size=SensorSize(4, 4))
    with pytest.raises(OutputError, match="with block"):
        writer.append(event)


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
