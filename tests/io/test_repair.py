"""Damage of every kind is refused, used up to it, or repaired and counted."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from texvent.errors import FileFormatError, TexventWarning
from texvent.events import EventStream
from texvent.io import repair
from texvent.io.block_writer import Columns
from texvent.io.files import load, open_events, save
from texvent.io.repair import RepairCounts, repair_blocks
from texvent.sensor import SensorSize

from .format_cases import random_events

SIZE = SensorSize(8, 6)


def blocks(*times: list[int], x: int = 1) -> Iterator[Columns]:
    for part in times:
        ones = np.full(len(part), x)
        yield {"x": ones, "y": ones, "t": np.array(part), "p": ones * 0}


def repaired(parts: Iterator[Columns]) -> tuple[list[int], dict[str, int | str]]:
    counts = RepairCounts()
    found = [one["t"].tolist() for one in repair_blocks(parts, SIZE, counts)]
    return [t for part in found for t in part], counts.facts()


def test_times_that_step_back_are_sorted_among_those_held_back(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    assert repaired(blocks([5, 3, 9], [4, 10])) == ([3, 4, 5, 9, 10], {"out_of_order": 2})
    monkeypatch.setattr(repair, "HELD_EVENTS", 2)
    monkeypatch.setattr(repair, "RESET_EVENTS", 0)
    # 5, 6 and 7 are given away before 3 comes.
    times, facts = repaired(blocks([5, 6, 7, 8, 9], [3, 10]))
    assert (times, facts) == ([5, 6, 7, 8, 9, 10], {"out_of_order": 1, "dropped_late": 1})


@pytest.mark.parametrize("cut", [150, 200, 250, 399])
def test_a_clock_that_was_reset_goes_on(cut: int) -> None:
    before = [3_000_000 + 10 * i for i in range(200)]
    times = [*before, *(10 * i for i in range(200))]
    found, facts = repaired(blocks(times[:cut], times[cut:]))
    assert facts == {"clock_resets": 1}
    assert found == [*before, *(before[-1] + 10 * i for i in range(200))]


def test_a_stray_time_is_no_reset() -> None:
    times = [2_000_000 + i for i in range(300)]
    times[150] = 5
    found, facts = repaired(blocks(times))
    assert facts == {"out_of_order": 1}
    assert found == sorted(times)


def test_events_outside_the_sensor_are_dropped() -> None:
    parts = [*blocks([1, 2], x=7), *blocks([3]), *blocks([4], x=-1)]
    assert repaired(iter(parts)) == ([3], {"outside_sensor": 3})


def damaged(tmp_path: Path, kind: str) -> tuple[Path, EventStream]:
    events = random_events(3000, SensorSize(64, 48), span_us=90_000)
    path = save(tmp_path / "e.txt", events)
    lines = path.read_text().splitlines(keepends=True)
    if kind == "outside":
        lines[2000] = lines[2000].split()[0] + " 64 1 1\n"
    if kind == "back":
        lines[2000], lines[2100] = lines[2100], lines[2000]
    if kind == "cut":
        lines[2000:] = [lines[2000][:9]]
    path.write_text("".join(lines))
    return path, events


@pytest.mark.parametrize(("kind", "count"), [("outside", 2999), ("back", 3000), ("cut", 2000)])
def test_a_damaged_file_is_refused_used_in_part_or_repaired(
    tmp_path: Path, kind: str, count: int
) -> None:
    path, events = damaged(tmp_path, kind)
    with pytest.raises(FileFormatError, match=r"repair=True \(--repair\) reads what is sound"):
        load(path)
    stop_us = int(events.t[1990])
    assert open_events(path).between(0, stop_us).collect() == events.between(0, stop_us)
    with pytest.warns(TexventWarning, match="was repaired"):
        found = load(path, repair=True)
    assert len(found) == count
    assert found.metadata["repair"]
    again = load(save(tmp_path / "r.h5", found))
    assert again.metadata["repair"] == found.metadata["repair"]
    if kind == "back":
        assert found.equals(events)


def test_a_sound_file_is_not_changed_by_repair(tmp_path: Path) -> None:
    events = random_events(3000, SensorSize(64, 48))
    for name in ("e.raw", "e.h5", "e.aedat4"):
        found = load(save(tmp_path / name, events), repair=True)
        assert found.equals(events)
        assert found.metadata["repair"] == {}


@pytest.mark.parametrize("name", ["e.raw", "e.aedat4", "e.dat"])
def test_a_cut_file_is_read_up_to_its_end(tmp_path: Path, name: str) -> None:
    events = random_events(3000, SensorSize(64, 48), span_us=90_000)
    path = save(tmp_path / name, events)
    path.write_bytes(path.read_bytes()[:-501])
    with pytest.warns(TexventWarning, match="cut off"):
        found = load(path, repair=True)
    assert 0 < len(found) < 3000
    assert found == events[: len(found)]


def test_columns_are_sorted_where_asked_for() -> None:
    events = EventStream.from_columns(
        [1, 2, 3], [0, 0, 0], [9, 5, 9], [1, 0, 0], size=SIZE, sort=True
    )
    assert (events.x.tolist(), events.t.tolist()) == ([2, 1, 3], [5, 9, 9])


def test_rows_that_are_no_events_are_dropped_and_counted(tmp_path: Path) -> None:
    path = tmp_path / "e.csv"
    path.write_text("t,x,y,p\n1,1,1,1\nnan,2,2,0\nt,x,y,p\n5,3,3,0\n9,4\n")
    with pytest.warns(TexventWarning, match="unreadable rows: 3"):
        events = load(path, size=SIZE, repair=True, time_unit="us")
    assert events.t.tolist() == [1, 5]
    path.write_text("a;b;c;d\n" * 3)
    with pytest.raises(FileFormatError):
        load(path, size=SIZE, repair=True, columns="t,x,y,p")
