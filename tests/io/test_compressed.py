"""Compressed files are read or named; pipes, locks and other forms are refused in one line."""

import bz2
import gzip
import lzma
import os
from pathlib import Path
from typing import Any

import h5py
import pytest

from texvent.cli.app import main
from texvent.errors import FileFormatError, InputError, TexventWarning
from texvent.io.compressed import load_zstd
from texvent.io.files import is_event_path, load, open_events, save
from texvent.sensor import SensorSize

from .format_cases import random_events

SIZE = SensorSize(64, 48)


@pytest.fixture(autouse=True)
def own_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


ZSTD = load_zstd()
PACK = {
    **{".gz": gzip.compress, ".bz2": bz2.compress, ".xz": lzma.compress, "": gzip.compress},
    ".zst": ZSTD.compress,
}


@pytest.mark.parametrize("extension", PACK)
@pytest.mark.parametrize("name", ["e.txt", "e.csv"])
def test_compressed_texts_are_read(name, extension):
    events = random_events(3000, SIZE, span_us=900_000)
    save(name, events)
    packed = Path(f"packed-{name}{extension}")
    packed.write_bytes(PACK[extension](Path(name).read_bytes()))
    assert is_event_path(packed)
    for _ in range(2):
        assert load(packed, size=SIZE).equals(events)


@pytest.mark.parametrize("extension", [".gz", ".bz2", ".zst"])
@pytest.mark.parametrize("name", ["e.txt", "e.csv"])
def test_of_a_cut_text_the_rows_before_the_end_are_repaired(name, extension):
    """Where they are packed in blocks of which some are whole."""
    events = random_events(100_000, SIZE, span_us=9_000_000)
    data = PACK[extension](Path(save(name, events)).read_bytes())
    packed = Path(f"packed-{name}{extension}")
    packed.write_bytes(data[: len(data) * 7 // 8])
    with pytest.raises(FileFormatError, match="damaged or not a compressed text"):
        load(packed, size=SIZE)
    with pytest.warns(TexventWarning, match="cut off: is damaged or not a compressed text"):
        found = load(packed, size=SIZE, repair=True)
    assert 20_000 < len(found) < 90_000
    assert found.equals(events[: len(found)])


@pytest.mark.parametrize(
    ("name", "start", "command"),
    [
        ("e.h5.gz", gzip.compress(b"\x89HDF\r\n\x1a\n" + bytes(99), mtime=0), "gunzip -k"),
        ("e.raw", bz2.compress(b"% evt 3.0\n" + bytes(99)), "bunzip2 -k"),
        ("e.mcap.zst", ZSTD.compress(b"\x89MCAP0" + bytes(99)), "unzstd"),
        ("e.txt.lz4", b"\x04\x22\x4d\x18" + bytes(99), "unlz4"),
        ("e.7z", b"7z\xbc\xaf\x27\x1c" + bytes(99), "7z x"),
        ("e.pkl", b"\x80\x04" + bytes(99), "save its arrays as .npz"),
        ("e.feather", b"ARROW1\0\0" + bytes(99), "as .parquet"),
        ("e.mat", b"MATLAB 5.0" + bytes(99), "save it with -v7.3"),
    ],
)
def test_what_is_not_read_is_named_with_a_way(name, start, command, capsys):
    Path(name).write_bytes(start)
    for words in (["info", name], ["convert", name, "o.h5"], ["validate", name]):
        assert main([*words, "--sensor", "64x48"]) == 2
        said = capsys.readouterr().err
        assert command in said
        assert said.count("\n") == 1
    assert not Path("o.h5").exists()


def test_streams_of_n_mnist_have_two_extensions():
    events = random_events(50, SensorSize(34, 34), span_us=900)
    save("e.bin", events)
    Path("e.bs2").write_bytes(Path("e.bin").read_bytes())
    assert load("e.bs2", size=SensorSize(34, 34)).equals(events)


@pytest.mark.parametrize("name", ["e.txt", "e.h5", "e.npz", "e.npy", "e.csv", "e.zip", "e.raw"])
@pytest.mark.parametrize(
    "door",
    [
        lambda name: main(["info", name]),
        lambda name: main(["convert", name, "o.h5"]),
        lambda name: main(["validate", name]),
        lambda name: main(["render", name, "-o", "o.png"]),
        lambda name: main(["compare", name, name]),
    ],
    ids=["info", "convert", "validate", "render", "compare"],
)
def test_a_named_pipe_is_refused_at_every_door(door, name, capsys):
    os.mkfifo(name)
    assert door(name) == 2
    assert "is a device or a pipe; give the name of an event file" in capsys.readouterr().err


def test_a_locked_file_is_not_called_damaged(capsys):
    save("e.h5", random_events(50, SIZE))
    real = h5py.File

    def refuse(*words: Any, **more: Any) -> Any:
        del words, more
        raise BlockingIOError(11, "Unable to synchronously open file (unable to lock file)")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(h5py, "File", refuse)
        with pytest.raises(InputError, match="is open in another program"):
            open_events("e.h5")
        assert main(["info", "e.h5"]) == 2
    assert h5py.File is real
    assert "HDF5_USE_FILE_LOCKING=FALSE" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [
        ["convert", "e.h5", "-"],
        ["convert", "e.h5", "-o", "-"],
        ["convert", "-", "o.h5"],
        ["convert", "e.h5", "o.h5", "--merge", "-"],
        ["convert", "e.h5", "o.h5", "--mask", "-"],
        ["info", "-"],
        ["validate", "-"],
        ["render", "e.h5", "-o", "-"],
        ["generate", "a car", "-o", "-"],
        ["simulate", "clip.mp4", "-o", "-"],
        ["compare", "e.h5", "-"],
    ],
)
def test_a_dash_is_no_file(words, capsys):
    save("e.h5", random_events(50, SIZE))
    assert main(words) == 2
    assert "standard input and output are not read or written as files" in capsys.readouterr().err
    assert sorted(one.name for one in Path().iterdir()) == ["e.h5"]
