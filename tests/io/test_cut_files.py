"""A cut file of every format is refused, or gives its beginning. Other damage: `tests/fuzz`."""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path

import pytest

from texvent.errors import InputError
from texvent.events import EventStream
from texvent.io.block_codec import BlockCodec
from texvent.io.files import codec_for, save

from .format_cases import CASES, FormatCase, random_events

COUNT = 12
FILES = [
    case
    for case in CASES
    if case.file != "folder" and (case.extra is None or importlib.util.find_spec(case.extra))
]
SEALED = ("e2vid", "n-imagenet", "dsec", "rosbag1", "mcap", "hdf5", "npz")
"""Formats whose end can be told; of the others, a cut file may be a shorter recording."""


def events_of(case: FormatCase) -> EventStream:
    return random_events(COUNT, case.sensor, span_us=30_000).with_metadata({"seed": 5})


@dataclass(frozen=True)
class SoundFile:
    """A file that is damaged again and again; what lies beside it stays."""

    codec: BlockCodec
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
