from pathlib import Path

import pytest

from texvent.errors import FileFormatError
from texvent.io.files import load

from .prophesee_files import SIZE, events_of, write_words


def test_words_built_by_hand_from_the_published_table(tmp_path: Path) -> None:
    words = [
        0b0001_000001_00000000011_00000000100,  # before any TIME_HIGH: no time, left out
        0x8000_0002,  # TIME_HIGH: 2 · 64 µs
        0b0001_000101_10011111111_01011001111,  # ON, 5 µs, x 1279, y 719
        0b1010_000110_00000000000_00000000001,  # a trigger
        0b0000_111111_00000000011_00000000100,  # OFF, 63 µs, x 3, y 4
        0x8000_0003,
        0b0000_000000_00000000000_00000000000,
    ]
    events = load(write_words(tmp_path, "evt2", words))
    assert events.size == SIZE
    assert events_of(events) == [(1279, 719, 133, 1), (3, 4, 191, 0), (0, 0, 192, 0)]


def test_a_wrapped_counter_of_another_writer_is_unrolled(tmp_path: Path) -> None:
    words = [0x8FFF_FFFF, 0x0FC0_0000, 0x8000_0000, 0x0000_0000, 0x8FFF_FFFF, 0x8000_0001, 0x0]
    times = load(write_words(tmp_path, "evt2", words)).t.tolist()
    assert times == [2**34 - 1, 2**34, 2 * 2**34 + 64]


def test_a_small_fall_of_time_is_damage_not_a_wrap(tmp_path: Path) -> None:
    words = [0x8000_0005, 0x0, 0x8000_0004, 0x0]
    path = write_words(tmp_path, "evt2", words)
    with pytest.raises(FileFormatError, match="time decreases"):
        load(path)
