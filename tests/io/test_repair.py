"""Damage of every kind is refused, used up to it, or repaired and counted."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from texvent.errors import FileFormatError, TexventWarning
from texvent.events import EventStream
from texvent.io import repair
from texvent.io.block_writer import Columns
from texvent.io.files import load, open_events, save
from texvent.io.repair import TURNS_US, RepairCounts, repair_blocks
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


def test_times_that_step_back_are_sorted_among_those_held_back(monkeypatch):
    assert repaired(blocks([5, 3, 9], [4, 10])) == ([3, 4, 5, 9, 10], {"out_of_order": 2})
    for name, value in {"HELD_EVENTS": 2, "BATCH_EVENTS": 5, "LOOK_EVENTS": 1}.items():
        monkeypatch.setattr(repair, name, value)
    # 5, 6 and 7 are given away before 3 comes.
    times, facts = repaired(blocks([5, 6, 7, 8, 9], [3, 10]))
    assert (times, facts) == ([5, 6, 7, 8, 9, 10], {"out_of_order": 1, "dropped_late": 1})


def cut(times: NDArray[np.int64], rng: np.random.Generator) -> Iterator[Columns]:
    """Blocks of random lengths, some of them empty or of one event."""
    ends = np.sort(rng.integers(0, len(times), rng.integers(0, 9)))
    return blocks(*(part.tolist() for part in np.split(times, ends)))


def recording(kind: str, rng: np.random.Generator) -> NDArray[np.int64]:
    """Times of a sound recording, µs."""
    gaps = {
        "steady": rng.integers(1, 1200, 3000),
        "sparse": rng.integers(20_000, 200_000, 900),
        "bursts": np.where(rng.random(3000) < 0.01, 70_000, rng.integers(0, 300, 3000)),
        "minutes": np.where(rng.random(3000) < 0.003, 500_000_000, rng.integers(0, 300, 3000)),
    }[kind]
    return np.cumsum(gaps) + int(rng.choice([0, 3_000_000, 1_700_000_000_000_000]))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("kind", ["steady", "sparse", "bursts", "minutes"])
def test_sound_recordings_and_pauses_are_not_repaired(kind, seed):
    rng = np.random.default_rng(seed)
    times = recording(kind, rng)
    assert repaired(cut(times, rng)) == (times.tolist(), {})


@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("length", [1, 2, 50])
@pytest.mark.parametrize("place", [0, 1, 700, 1499, 1500, -1])
@pytest.mark.parametrize("stamp", ["up", "down", "wild", "zero", "negative", "far"])
def test_a_few_wrong_stamps_are_dropped_and_counted(stamp, place, length, seed, monkeypatch):
    monkeypatch.setattr(repair, "BATCH_EVENTS", 1500)
    monkeypatch.setattr(repair, "LOOK_EVENTS", 400)
    rng = np.random.default_rng(seed)
    times = np.cumsum(rng.integers(1, 1200, 3000)) + (1 << 30)
    start = place if place >= 0 else len(times) - length
    wrong = {
        "up": times | 1 << int(rng.integers(31, 50)),
        "down": times & ~(1 << 30),
        "wild": rng.integers(1 << 31, 1 << 60, len(times)),
        "zero": times * 0,
        "negative": -times,
        "far": times * 0 + 10**13,
    }[stamp]
    stored = times.copy()
    stored[start : start + length] = wrong[start : start + length]
    found, facts = repaired(cut(stored, rng))
    assert facts == {"stray_times": length}
    assert found == [*times[:start].tolist(), *times[start + length :].tolist()]


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize(
    "at",
    [[100], [130, 230], [200, 1600], [1499], [1500], [500, 2990], [2880, 2960], [500, 590, 2997]],
)
@pytest.mark.parametrize("first_us", [0, 1_700_000_000_000_000])
def test_a_clock_that_was_reset_goes_on(first_us, at, seed, monkeypatch):
    monkeypatch.setattr(repair, "BATCH_EVENTS", 1500)
    monkeypatch.setattr(repair, "LOOK_EVENTS", 400)
    rng = np.random.default_rng(seed)
    times = np.cumsum(rng.integers(800, 1200, 3000)) + first_us
    stored = times.copy()
    for reset in at:
        stored[reset:] = times[reset:] - times[reset] + 7
        # The first event after a reset has the time of the last one before it.
        times[reset:] -= times[reset] - times[reset - 1]
    found, facts = repaired(cut(stored, rng))
    assert facts == {"clock_resets": len(at)}
    assert found == times.tolist()


@pytest.mark.parametrize(
    ("first_us", "range_us"),
    [*((0, one) for one in TURNS_US), (-(1 << 31), 1 << 32), (-2_147_483, 4_294_967)],
)
def test_a_clock_that_turns_over_counts_on(first_us, range_us):
    times = np.arange(3000) * 1000 + first_us + range_us - 1_500_000
    stored = (times - first_us) % range_us + first_us
    assert repaired(blocks(stored.tolist())) == (times.tolist(), {"clock_turns": 1})


def test_packets_that_come_late_are_sorted():
    times = np.arange(5000) * 200
    stored = np.concatenate([times[:1000], times[2000:3000], times[1000:2000], times[3000:]])
    assert repaired(blocks(stored.tolist())) == (times.tolist(), {"out_of_order": 1000})


def test_events_outside_the_sensor_are_dropped():
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
def test_a_damaged_file_is_refused_used_in_part_or_repaired(tmp_path, kind, count):
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


@pytest.mark.parametrize("start", [100, 40_000])
def test_zeros_in_a_text_are_dropped_and_counted(tmp_path, start):
    events = random_events(3000, SensorSize(64, 48), span_us=90_000)
    path = save(tmp_path / "e.txt", events)
    text = path.read_bytes()
    path.write_bytes(text[:start] + bytes(512) + text[start + 512 :])
    with pytest.raises(FileFormatError, match="--repair"):
        load(path)
    repaired = pytest.warns(TexventWarning, match="unreadable rows: 1")
    with repaired, pytest.warns(TexventWarning, match="512 bytes of zeros instead of text"):
        found = load(path, repair=True)
    lost = text[:start].count(b"\n"), text[: start + 512].count(b"\n") + 1
    assert found.t.tolist() == np.delete(events.t, slice(*lost)).tolist()


def test_a_sound_file_is_not_changed_by_repair(tmp_path):
    events = random_events(3000, SensorSize(64, 48))
    for name in ("e.raw", "e.h5", "e.aedat4"):
        found = load(save(tmp_path / name, events), repair=True)
        assert found.equals(events)
        assert found.metadata["repair"] == {}


@pytest.mark.parametrize("name", ["e.raw", "e.aedat4", "e.dat"])
def test_a_cut_file_is_read_up_to_its_end(tmp_path, name):
    events = random_events(3000, SensorSize(64, 48), span_us=90_000)
    path = save(tmp_path / name, events)
    path.write_bytes(path.read_bytes()[:-501])
    with pytest.warns(TexventWarning, match="cut off"):
        found = load(path, repair=True)
    assert 0 < len(found) < 3000
    assert found == events[: len(found)]


def test_columns_are_sorted_where_asked_for():
    events = EventStream.from_columns(
        [1, 2, 3], [0, 0, 0], [9, 5, 9], [1, 0, 0], size=SIZE, sort=True
    )
    assert (events.x.tolist(), events.t.tolist()) == ([2, 1, 3], [5, 9, 9])


def test_rows_that_are_no_events_are_dropped_and_counted(tmp_path):
    path = tmp_path / "e.csv"
    path.write_text("t,x,y,p\n1,1,1,1\nnan,2,2,0\nt,x,y,p\n5,3,3,0\n9,4\n")
    with pytest.warns(TexventWarning, match="unreadable rows: 3"):
        events = load(path, size=SIZE, repair=True, time_unit="us")
    assert events.t.tolist() == [1, 5]
    path.write_text("a;b;c;d\n" * 3)
    with pytest.raises(FileFormatError):
        load(path, size=SIZE, repair=True, columns="t,x,y,p")


@pytest.mark.parametrize("rows", [3, 300])
def test_a_short_text_is_repaired_and_its_error_says_so(tmp_path, rows):
    path = tmp_path / "e.txt"
    path.write_text("".join(f"{at / 1000:.6f} 1 1 1\n" for at in range(rows)) + "0.3 1")
    with pytest.raises(FileFormatError, match="--repair"):
        load(path, size=SIZE)
    with pytest.warns(TexventWarning, match="cut off: has rows of 2 values"):
        assert len(load(path, size=SIZE, repair=True)) == rows
