from pathlib import Path

import numpy as np

from texvent.events import EventStream
from texvent.io import byte_blocks
from texvent.io.files import load, open_events, save

from .prophesee_files import SIZE, at_times, events_of, row_bursts, write_words

BY_HAND = [
    0x2003,  # an event before any TIME_HIGH: no time, left out
    0x8001,  # TIME_HIGH 1: 4096 µs
    0x2003,  # an event before any row, left out
    0x0002,  # row 2
    0x2801,  # ON at x 1, at the first µs of this TIME_HIGH
    0x6005,  # TIME_LOW 5
    0x2007,  # OFF at x 7
    0x3864,  # VECT_BASE_X: ON from x 100
    0x4803,  # VECT_12: x 100, 101, 111
    0x4001,  # VECT_12: x 112
    0x5081,  # VECT_8: x 124, 131
    0xA001,  # a trigger
    0x7123,  # a continuation
    0x0003,  # row 3
    0x5001,  # VECT_8 goes on at x 132
    0x1004,  # a row of another kind
    0x2005,  # … whose events are left out
    0x02CF,  # row 719
    0x8002,  # TIME_HIGH 2: low bits start at 0
    0x24FF,  # OFF at x 1279
]
MEANING = [
    (1, 2, 4096, 1),
    (7, 2, 4101, 0),
    *[(x, 2, 4101, 1) for x in (100, 101, 111, 112, 124, 131)],
    (132, 3, 4101, 1),
    (1279, 719, 8192, 0),
]


def written_words(path: Path) -> list[int]:
    return np.frombuffer(path.read_bytes().split(b"% end\n")[1], dtype="<u2").tolist()


def test_blocks_that_cut_a_vector_group_change_nothing(tmp_path, monkeypatch):
    path = write_words(tmp_path, "evt3", BY_HAND)
    for block in (2, 4, 6):
        monkeypatch.setattr(byte_blocks, "BLOCK_BYTES", block)
        packets = list(open_events(path))
        assert len(packets) > 1
        assert events_of(EventStream.concat(packets)) == MEANING


def test_words_repeat_only_what_changes_and_start_at_time_high_zero(tmp_path):
    events = EventStream.from_columns(
        [1, 2, 3, 4], [5, 5, 6, 6], [9, 9, 9, 5000], [1, 0, 1, 0], size=SIZE
    )
    assert written_words(save(tmp_path / "e.raw", events)) == [
        *(0x8000, 0x6009),
        *(0x0005, 0x2801, 0x2002),
        *(0x0006, 0x2803),
        *(0x8001, 0x6388, 0x0006, 0x2004),
    ]


def test_no_vector_words_are_written(tmp_path):
    # OpenEB loses events in groups other than 12 + 12 + 8.
    kinds = {word >> 12 for word in written_words(save(tmp_path / "e.raw", row_bursts(50)))}
    assert kinds == {0, 2, 6, 8}


def test_a_silence_is_padded_with_every_turn_of_the_counter(tmp_path):
    path = save(tmp_path / "e.raw", at_times(10, 3 * 2**24 + 4096))
    highs = [word & 0xFFF for word in written_words(path) if word >> 12 == 8]
    assert highs == [0, 4095, 0, 4095, 0, 4095, 0, 1]
    assert load(path).t.tolist() == [10, 3 * 2**24 + 4096]


def test_twelve_days_of_silence_cost_less_than_half_a_megabyte(tmp_path):
    path = save(tmp_path / "e.raw", at_times(0, 2**40))
    assert path.stat().st_size < 500_000
    assert load(path).t.tolist() == [0, 2**40]


def test_the_header_says_what_openeb_asks_for(tmp_path):
    path = save(tmp_path / "e.raw", at_times(1))
    assert path.read_bytes().split(b"% end\n")[0].decode().splitlines() == [
        "% camera_integrator_name Prophesee",
        "% evt 3.0",
        "% format EVT3;height=720;width=1280",
        "% geometry 1280x720",
        "% integrator_name Prophesee",
        "% plugin_integrator_name Prophesee",
        '% texvent {"seed": 0}',
    ]
