"""Readout of the pixels: rows that queue, and scans."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.simulate.references import row_arbiter

from texvent.simulate.packets import UnsortedEvents
from texvent.simulate.physical import readout
from texvent.simulate.physical.config import PhysicalConfig
from texvent.simulate.physical.readout import (
    LOST,
    WAITS,
    Arbiter,
    RowRules,
    scan_times_us,
)
from texvent.simulate.physical.simulator import PhysicalSimulator
from texvent.video import Frame

SHAPE = (4, 5)
EVENTS = st.lists(st.tuples(st.integers(0, 60), st.integers(0, 19)), max_size=60)


def columns(events) -> tuple[np.ndarray, np.ndarray]:
    t, pixel = np.array(sorted(events), np.int64).reshape(-1, 2).T
    return pixel.copy(), t.copy()


def read_all(kind: str, events, steps, **options: int) -> list[tuple[int, ...]]:
    """(t, pixel, p) of what an arbiter reads from events that it gets step by step."""
    config = PhysicalConfig(arbiter=kind, **options)
    arbiter = Arbiter(config, first_us=0, shape=SHAPE)
    pixel, t = columns(events)
    rows = []
    for start, stop in itertools.pairwise(steps):
        chosen = (t >= start) & (t < stop)
        fired = UnsortedEvents.signal(pixel[chosen], t[chosen], (pixel[chosen] % 2).astype("u1"))
        read = arbiter.read(fired, stop)
        assert ((read.t >= start) & (read.t < stop)).all()
        rows += list(zip(read.t.tolist(), read.pixel.tolist(), read.p.tolist(), strict=True))
    return sorted(rows)


def test_rows_queue_and_leave_whole(kernels):
    # Row 0 (pixels 0..4) is read at once and takes 3 + 1 µs. Row 1 asked at 1 µs; by 4 µs it has
    # two events, which take 5 µs. Row 2 asked after it and is read at 9 µs.
    pixel, t = np.array([0, 5, 10, 6, 0]), np.array([0, 1, 2, 3, 8])
    read_us, free_ns = readout.serve_rows(pixel, t, SHAPE, RowRules(3000, 1000), 0, 100)
    assert read_us.tolist() == [0, 4, 9, 4, 13]
    assert free_ns == 17_000


def test_a_waiting_pixel_loses_what_it_fires(kernels):
    pixel, t = np.array([0, 5, 5, 5]), np.array([0, 1, 2, 11])
    read_us, _ = readout.serve_rows(pixel, t, SHAPE, RowRules(10_000, 0), 0, 15)
    assert read_us.tolist() == [0, 10, LOST, WAITS]


@given(EVENTS, st.integers(0, 9000), st.integers(0, 3000), st.integers(0, 80))
def test_compiled_rows_equal_the_reference(events, row_ns, event_ns, stop_us):
    pixel, t = columns(events)
    arguments = pixel, t, SHAPE, RowRules(row_ns, event_ns), 0, stop_us
    expected, free_ns = row_arbiter.serve_rows(*arguments)
    found, found_free_ns = readout.serve_rows(*arguments)
    assert found.tolist() == expected.tolist()
    assert found_free_ns == free_ns


@given(EVENTS, st.lists(st.integers(1, 299), unique=True), st.sampled_from(["rows", "scan"]))
def test_intervals_change_nothing(events, cuts, kind):
    options = {"arbiter_row_ns": 4100, "scan_period_ns": 7300}
    whole = read_all(kind, events, [0, 300], **options)
    assert read_all(kind, events, [0, *sorted(cuts), 300], **options) == whole


@given(EVENTS)
def test_an_arbiter_that_takes_no_time_changes_nothing(events):
    events = sorted(set(events))
    fired = sorted((t, pixel, pixel % 2) for t, pixel in events)
    assert read_all("rows", events, [0, 300], arbiter_row_ns=0, arbiter_event_ns=0) == fired


def test_a_scan_reads_the_last_column_first_and_a_pixel_once():
    # Columns 4, 3, .. 0 at 0, 2, .. 8 µs, then again 10 µs later.
    pixel, t = np.array([4, 0, 3, 0, 5]), np.array([0, 0, 3, 7, 9])
    assert scan_times_us(pixel, t, 5, 10_000, 0).tolist() == [0, 8, 12, LOST, 18]


@given(EVENTS)
def test_a_scan_delays_by_less_than_a_period(events):
    pixel, t = columns(events)
    read_us = scan_times_us(pixel, t, 5, 7300, 0)
    kept = read_us != LOST
    assert ((read_us >= t) & (read_us - t <= 8))[kept].all()
    # The same column is read at whole numbers of periods.
    phase = (read_us * 1000 - (4 - pixel % 5) * 1460) % 7300
    assert ((phase == 0) | (phase > 7300 - 1000))[kept].all()


@pytest.mark.parametrize("kind", ["rows", "scan"])
def test_the_model_reads_its_events_through_the_arbiter(kind):
    frames = np.random.default_rng(3).integers(0, 255, (6, 20, 30)).astype(np.uint8)

    def simulate(arbiter: str) -> list[tuple[int, ...]]:
        options = {"arbiter_row_ns": 2000, "scan_period_ns": 30_000}
        simulator = PhysicalSimulator(PhysicalConfig(arbiter=arbiter, **options), seed=1)
        rows = []
        for i, frame in enumerate(frames):
            packet = simulator.step(Frame(frame, i * 2000))
            rows += list(zip(packet.t.tolist(), packet.y.tolist(), packet.x.tolist(), strict=True))
        return rows

    direct, read = simulate("none"), simulate(kind)
    assert 0.3 * len(direct) < len(read) <= len(direct)
    assert read != direct
    # Those with one time stamp share their row, or their column.
    place = {"rows": 1, "scan": 2}[kind]
    assert len({(row[0], row[place]) for row in read}) == len({row[0] for row in read})
