"""Damaged files of every format are refused in one line, or give valid events; nothing else."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.files import codec_for, save
from texvent.io.protocol import EventCodec

from .format_cases import CASES, FormatCase, random_events

COUNT = 12
FILES = [
    case
    for case in CASES
    if case.file != "folder" and (case.extra is None or importlib.util.find_spec(case.extra))
]
SEALED = ("e2vid", "n-imagenet", "v2e", "dsec", "dsec-blosc", "rosbag1", "mcap", "parquet")
"""Formats whose end can be told; of the others, a cut file may be a shorter recording."""


def events_of(case: FormatCase) -> EventStream:
    return random_events(COUNT, case.sensor, span_us=30_000).with_metadata({"seed": 5})


@dataclass(frozen=True)
class SoundFile:
    """A file that is damaged again and again; what lies beside it stays."""

    codec: EventCodec
    path: Path
    content: bytes

    def read(self, damaged: bytes) -> EventStream | None:
        """The events of the damaged file, or None if it is refused in one line."""
        self.path.write_bytes(damaged)
        try:
            return self.codec.read(self.path).collect()
        except InputError as error:
            message = str(error)
        assert "\n" not in message
        return None


@pytest.fixture(scope="module")
def sound(tmp_path_factory: pytest.TempPathFactory) -> dict[str, SoundFile]:
    files = {}
    for case in FILES:
        path = tmp_path_factory.mktemp(case.name) / case.file
        save(path, events_of(case), format=case.name)
        files[case.name] = SoundFile(codec_for(path, case.name), path, path.read_bytes())
    return files


def cuts(length: int) -> list[int]:
    """Every length below that of a small file; of a large one a few hundred, and all at its end."""
    if length < 1500:
        return list(range(length))
    return sorted({*range(0, length, length // 250), *range(length - 60, length)})


@pytest.mark.parametrize("case", FILES, ids=lambda case: case.name)
def test_a_file_cut_at_any_byte_is_refused_or_gives_its_beginning(
    sound: dict[str, SoundFile], case: FormatCase
) -> None:
    whole = events_of(case)
    file = sound[case.name]
    for length in cuts(len(file.content)):
        back = file.read(file.content[:length])
        if back is not None:
            assert case.name not in SEALED
            assert back.equals(whole[: len(back)])


@settings(max_examples=300, deadline=None, derandomize=True)
@given(
    name=st.sampled_from([case.name for case in FILES]),
    share=st.floats(0.0, 1.0, exclude_max=True),
    flip=st.integers(1, 255),
    length=st.integers(1, 8),
)
def test_flipped_bytes_are_refused_or_give_valid_events(
    sound: dict[str, SoundFile], name: str, share: float, flip: int, length: int
) -> None:
    content = bytearray(sound[name].content)
    start = int(share * len(content))
    for place in range(start, min(start + length, len(content))):
        content[place] ^= flip
    back = sound[name].read(bytes(content))
    assert back is None or len(back) <= len(content)


@settings(max_examples=200, deadline=None, derandomize=True)
@given(
    name=st.sampled_from([case.name for case in FILES]),
    place=st.floats(0.0, 1.0, exclude_max=True),
    word=st.sampled_from([b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80", bytes(8)]),
)
def test_absurd_numbers_anywhere_are_refused_or_give_valid_events(
    sound: dict[str, SoundFile], name: str, place: float, word: bytes
) -> None:
    content = bytearray(sound[name].content)
    start = int(place * len(content))
    content[start : start + len(word)] = word
    back = sound[name].read(bytes(content))
    assert back is None or len(back) <= len(content)


@settings(max_examples=150, deadline=None)
@given(
    name=st.sampled_from([case.name for case in FILES]),
    keep=st.integers(0, 200),
    noise=st.binary(max_size=300),
)
def test_random_bytes_after_a_sound_beginning_are_refused_or_give_valid_events(
    sound: dict[str, SoundFile], name: str, keep: int, noise: bytes
) -> None:
    back = sound[name].read(sound[name].content[:keep] + noise)
    assert back is None or len(back) <= keep + len(noise)
