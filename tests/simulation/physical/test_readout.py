"""A readout that scans the columns."""

import itertools

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from texvent.frames import Frame
from texvent.simulation.packets import UnsortedEvents
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.readout import LOST, ColumnScan, scan_times_us
from texvent.simulation.physical.simulator import PhysicalSimulator

EVENTS = st.lists(st.tuples(st.integers(0, 60), st.integers(0, 19)), max_size=60)


def columns(events) -> tuple[np.ndarray, np.ndarray]:
    t, pixel = np.array(sorted(events), np.int64).reshape(-1, 2).T
    return pixel.copy(), t.copy()


def read_all(events, steps) -> list[tuple[int, ...]]:
    """(t, pixel, p) of what a scan reads from events that it gets step by step."""
    scan = ColumnScan(7300, first_us=0, width=5)
    pixel, t = columns(events)
    rows = []
    for start, stop in itertools.pairwise(steps):
        chosen = (t >= start) & (t < stop)
        fired = UnsortedEvents.signal(pixel[chosen], t[chosen], (pixel[chosen] % 2).astype("u1"))
        read = scan.read(fired, stop)
        assert ((read.t >= start) & (read.t < stop)).all()
        rows += list(zip(read.t.tolist(), read.pixel.tolist(), read.p.tolist(), strict=True))
    return sorted(rows)


@given(EVENTS, st.lists(st.integers(1, 299), unique=True))
def test_intervals_change_nothing(events, cuts):
    for steps in ([0, *sorted(cuts), 300], range(301)):  # some end where an event is read
        assert read_all(events, steps) == read_all(events, [0, 300])


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


def test_the_model_reads_its_events_by_the_scan():
    frames = np.random.default_rng(3).integers(0, 255, (6, 20, 30)).astype(np.uint8)

    def simulate(period_ns: int) -> list[tuple[int, ...]]:
        simulator = PhysicalSimulator(PhysicalConfig(scan_period_ns=period_ns), seed=1)
        packets = [simulator.step(Frame(frame, i * 2000)) for i, frame in enumerate(frames)]
        return [row for one in packets for row in zip(one.t.tolist(), one.x.tolist(), strict=True)]

    direct, read = simulate(0), simulate(30_000)
    assert 0.3 * len(direct) < len(read) <= len(direct)
    # Events with one time stamp share their column.
    assert len(set(read)) == len({t for t, _ in read})
