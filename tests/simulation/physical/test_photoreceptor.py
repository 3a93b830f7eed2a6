"""Parts of the physical model: bandwidth, crossing times, and the readout of columns."""

import itertools
import math

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references.physical import ChangeCurve, change_after, time_to_threshold

from texvent.frames import Frame
from texvent.simulation.kernels.elementary import exponential
from texvent.simulation.packets import UnsortedEvents
from texvent.simulation.physical import crossing_time
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.physical.readout import LOST, ColumnScan, scan_times_us
from texvent.simulation.physical.simulator import PhysicalSimulator

from ..pixel_frames import curve, frames_of, run
from .physical_pixels import clean, intensity


def follow_line(t: float, slope: float, tau: float) -> float:
    """Answer of a first-order low-pass to a line from rest."""
    return slope * (t - tau * (1 - math.exp(-t / tau)))


@pytest.mark.parametrize("count", [1, 7, 100])
def test_the_low_pass_follows_a_line_by_its_closed_form(count):
    # So small a contrast that the corner frequency, (10 + 100) / 265 of the cutoff, stays.
    cutoff, threshold, balance = 5.0, 0.011, 10.0
    tau = 1 / (math.tau * cutoff * 110 / 265)
    start = math.log(110)
    values = [intensity(start + 0.05 * i / count, balance) for i in range(count + 1)]
    times = [round(i * 500_000 / count) for i in range(count + 1)]
    simulator = clean(cutoff_hz=cutoff, contrast_threshold=threshold)
    events = run(simulator, frames_of(values, times))
    assert len(events) == 3
    reached = [follow_line(t * 1e-6, 0.1, tau) for t in events.t]
    # The corner rises by 5 % on the way, in as many steps as there are frames.
    assert reached == pytest.approx([threshold, 2 * threshold, 3 * threshold], rel=0.02)


def test_frames_an_hour_apart_are_simulated_at_once():
    hour_us = 3_600_000_000
    start = math.log(110)
    values = [intensity(start, 10.0), intensity(start + 0.65, 10.0)]
    events = run(clean(cutoff_hz=250.0), frames_of(values, [0, hour_us]))
    expected = np.array([0.2, 0.4, 0.6]) / 0.65 * hour_us
    assert events.t == pytest.approx(expected, abs=hour_us / 1024)


@pytest.mark.parametrize("fps", [240, 1000])
def test_bandwidth_does_not_depend_on_the_frame_rate(fps):
    knots = np.array([4.0, 4.4, 5.2, 4.9, 4.1, 4.1, 4.8, 3.9, 4.0])

    def sampled(rate):
        wave = lambda s: intensity(float(np.interp(s * 24, np.arange(len(knots)), knots)))  # noqa: E731
        return run(clean(cutoff_hz=60.0), curve(wave, fps=rate, seconds=8 / 24))

    slow, fast = sampled(24), sampled(fps)
    assert len(slow) > 10
    assert fast.p.tolist() == slow.p.tolist()
    # What is left: corners are averaged over pieces of an interval; time constants are 12 ms here.
    assert fast.t == pytest.approx(slow.t, abs=200)


@pytest.mark.parametrize("limit_hz", [0.0, 20.0])
def test_dark_pixels_are_slower_than_bright_ones(limit_hz):
    def delay(level):
        start = math.log(10 + level)
        values = [level, intensity(start + 0.4), intensity(start + 0.4)]
        events = run(
            clean(cutoff_hz=100.0, cutoff_limit_hz=limit_hz),
            frames_of(values, [0, 100, 500_000]),
        )
        return int(events.t[0])

    # Half of a step of 0.4, which takes 100 µs, is reached after ln 2 · τ.
    for level in (2.0, 20.0, 150.0):
        end = intensity(math.log(10 + level) + 0.4)
        cutoff_hz = 100 * (10 + end) / 265
        tau = 1e6 / (math.tau * min(cutoff_hz, limit_hz or cutoff_hz))
        assert delay(level) == pytest.approx(50 + tau * math.log(2), rel=0.01)


def curve_of(change, slope, transient, cutoff, duration) -> ChangeCurve:
    kept = float(exponential(np.float64(-cutoff * duration)))
    return ChangeCurve(change, slope, transient, cutoff, duration, kept)


def first_crossing(curve: ChangeCurve, on: float, off: float) -> float:
    """By looking everywhere."""
    u = np.linspace(0, 1, 200_001) * curve.duration
    change = curve.change + curve.slope * u + curve.transient * (1 - np.exp(-curve.cutoff * u))
    hits = np.flatnonzero((change >= on) | (-change >= off))
    return float(u[hits[0]]) if len(hits) else np.inf


def compiled_times(curves: list[ChangeCurve], on, off):
    rows = np.empty((crossing_time.ROWS, len(on)))
    rows[:8] = (*np.array(curves).T, on, off)
    scratch = np.empty_like(rows), np.empty(len(on), np.int64)
    with np.errstate(all="ignore"):
        crossing_time.find_crossings(rows, *scratch, len(on))
    return rows[crossing_time.WAIT], rows[crossing_time.RISES]


def time_of(curve: ChangeCurve, on=0.2, off=0.2) -> tuple[float, int]:
    return time_to_threshold(curve, on, off)


CURVES = st.builds(
    curve_of,
    st.floats(-0.19, 0.19),
    st.sampled_from([0.0, 1e-9, 1e-6, -3e-5, 2e-4, -1e-2]),
    st.sampled_from([0.0, 1e-8, -1e-3, 0.05, -0.3, 1.7]),
    st.sampled_from([1e-6, 1e-4, 3e-3, 0.05]),
    st.sampled_from([1.0, 700.0, 41_667.0, 1e6]),
)


@examples(200)
@given(CURVES, st.floats(0.05, 0.6))
@example(curve_of(0.0, 1e-6, 1e-8, 1e-4, 1e6), 0.05)
def test_backends_agree_and_find_the_first_crossing(curve, on):
    wait, p = time_of(curve, on)
    # Beside other lanes, on a line and on a curve.
    lanes = [curve_of(0.0, 1e-4, 0.0, 1e-3, 1e4), curve_of(0.1, 1e-5, 0.2, 1e-3, 1e4), curve]
    limits = np.array([0.2, 0.2, on]), np.full(3, 0.2)
    waits, polarities = compiled_times(lanes, *limits)
    assert waits.tolist() == [time_of(one, up)[0] for one, up in zip(lanes, limits[0], strict=True)]
    # A curve may creep up to a threshold and touch it by rounding; small transients are forgotten.
    forgotten = crossing_time.NEGLIGIBLE * min(on, 0.2) + 1e-9
    early, late = (first_crossing(curve, on + d, 0.2 + d) for d in (-forgotten, forgotten))
    assert early - 1e-5 * curve.duration <= wait
    assert wait <= late
    if 0 < wait < np.inf:
        assert polarities[2] == p
        change = change_after(curve, wait, np.exp(-curve.cutoff * wait))
        assert abs(change - (on if p else -0.2)) < 1e-4


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
