from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.io.prophesee import ecf_index
from texvent.io.prophesee.ecf_index import TimeIndex


def build(*packets: list[int]) -> list[tuple[int, int]]:
    index = TimeIndex()
    pieces = [piece for packet in packets for piece in index.add(np.array(packet))]
    return [tuple(entry) for piece in [*pieces, index.close()] for entry in piece.tolist()]


def by_definition(times: list[int]) -> list[tuple[int, int]]:
    """Entry k: the first event of the last bin, not empty, that ends by 2000 k; then the last."""
    if not times:
        return []
    since = [time - times[0] for time in times]
    firsts: dict[int, tuple[int, int]] = {}
    for number, time in enumerate(since):
        firsts.setdefault(time // 2000, (number, time))
    entries = [(0, -1)]
    for k in range(1, max(firsts) + 1):
        entries.append(firsts[max(bin for bin in firsts if bin < k)])
    return [*entries, firsts[max(firsts)]]


def test_a_case_worked_out_by_hand() -> None:
    # Bins of 2 ms after 500 µs: 0 (events 0, 1), 1 (event 2), 4 (event 3).
    times = [500, 2499, 2500, 8501]
    assert build(times) == [(0, -1), (0, 0), (2, 2000), (2, 2000), (2, 2000), (3, 8001)]
    assert by_definition(times) == build(times)


def test_no_event_has_no_index() -> None:
    assert build() == []


def test_one_event_has_two_entries() -> None:
    assert build([7]) == [(0, -1), (0, 0)]


@settings(max_examples=60)
@given(st.lists(st.integers(0, 30_000), max_size=25), st.integers(0, 25))
def test_the_index_follows_its_definition_however_packets_are_cut(
    times: list[int], cut: int
) -> None:
    times = sorted(times)
    parts = [part for part in (times[:cut], times[cut:]) if part]
    assert build(*parts) == by_definition(times)


def test_long_silences_are_made_in_pieces(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(ecf_index, "BATCH", 7)
    times = [0, 5, 100_000, 100_001, 140_000]
    pieces = list(TimeIndex().add(np.array(times)))
    assert max(len(piece) for piece in pieces) == 7
    assert build(times) == by_definition(times)
