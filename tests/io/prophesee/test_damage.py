"""Damaged Prophesee files are refused in one line or give valid events; nothing else happens."""

from __future__ import annotations

import tracemalloc
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.io import block_codec, block_writer
from texvent.io.files import load, open_events, save

from ..read_only_formats import write_ecf
from .prophesee_files import EXTENSIONS, FORMATS, SIZE, row_bursts

SMALL = row_bursts(3)


@pytest.fixture(scope="module", params=FORMATS)
def sound(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("damage") / f"sound{EXTENSIONS[request.param]}"
    return save(path, SMALL, format=request.param)


def load_or_refuse(path: Path) -> EventStream | None:
    try:
        return load(path)
    except InputError as error:
        # Nearly always FileFormatError; a header that lost its size asks for it.
        message = str(error)
    assert "\n" not in message
    return None


@settings(max_examples=40)
@given(share=st.floats(0.0, 1.0, exclude_max=True))
def test_a_truncated_hdf5_file_is_refused(
    tmp_path_factory: pytest.TempPathFactory, share: float
) -> None:
    folder = tmp_path_factory.mktemp("cut")
    content = write_ecf(folder / "e.hdf5", SMALL).read_bytes()
    path = folder / "short.hdf5"
    path.write_bytes(content[: int(share * len(content))])
    with pytest.raises(FileFormatError) as caught:
        load(path)
    assert "\n" not in str(caught.value)


@settings(max_examples=80)
@given(
    flips=st.lists(
        st.tuples(st.floats(0.0, 1.0, exclude_max=True), st.integers(1, 255)),
        min_size=1,
        max_size=4,
    )
)
def test_flipped_bytes_are_refused_or_give_valid_events(
    sound: Path, flips: list[tuple[float, int]]
) -> None:
    # Words have no checksum: another bit is another event. It must still be a valid one.
    content = bytearray(sound.read_bytes())
    for share, flip in flips:
        content[int(share * len(content))] ^= flip
    path = sound.with_name(f"flipped{sound.suffix}")
    path.write_bytes(content)
    load_or_refuse(path)


@pytest.mark.parametrize("format", FORMATS)
@settings(max_examples=60)
@given(noise=st.binary(max_size=200))
def test_random_bytes_after_a_sound_header_are_refused_or_give_valid_events(
    tmp_path_factory: pytest.TempPathFactory, format: str, noise: bytes
) -> None:
    path = tmp_path_factory.mktemp("noise") / f"e{EXTENSIONS[format]}"
    save(path, EventStream.empty(SIZE), format=format)
    path.write_bytes(path.read_bytes() + noise)
    back = load_or_refuse(path)
    assert back is None or back.size == SIZE


@pytest.mark.parametrize("format", FORMATS)
def test_memory_does_not_grow_with_the_file(
    tmp_path: Path, format: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    events = row_bursts(20_000)
    whole = sum(column.nbytes for column in events.columns().values())
    monkeypatch.setattr(block_codec, "BLOCK_BYTES", 2**14)
    monkeypatch.setattr(block_writer, "BLOCK_EVENTS", 2**12)
    path = save(tmp_path / f"warm{EXTENSIONS[format]}", row_bursts(10), format=format)
    assert len(load(path))
    tracemalloc.start()
    path = save(tmp_path / f"e{EXTENSIONS[format]}", events, format=format)
    written = tracemalloc.get_traced_memory()[1]
    tracemalloc.reset_peak()
    assert sum(len(packet) for packet in open_events(path)) == len(events)
    read = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert max(written, read) < whole / 3
