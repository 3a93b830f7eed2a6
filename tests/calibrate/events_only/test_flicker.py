"""Constants of a sensor before a flickering field are found again."""

import dataclasses
import itertools
import math

import numpy as np
import pytest
from tests.calibrate.known_scenes import simulate_flicker

from texvent.calibrate.events_only.flicker import NAMES, measure_flicker
from texvent.calibrate.events_only.flicker_cycles import Cycles, find_bursts, find_cycles
from texvent.calibrate.events_only.pixel_trains import PixelTrains
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulation.physical.config import PhysicalConfig
from texvent_lab.bench.oracle.pixel import NOISY, PixelArray

SIZE = SensorSize(28, 20)
START = PhysicalConfig(gamma=1.0)
TRUTH = dataclasses.replace(
    START,
    contrast_threshold=0.26,
    on_off_ratio=1.3,
    threshold_sigma=0.04,
    cutoff_hz=120.0,
    refractory_period_us=500,
    noise_curve="128:0.2",
    noise_scale=1.0,
)


@pytest.fixture(scope="module")
def recording():
    return simulate_flicker(TRUTH, SIZE, 5.0, ratio=6.0, number=14, seed=4)


@pytest.fixture(scope="module")
def flicker(recording):
    return measure_flicker(recording, START, hz=5.04, ratio=6.0)


@pytest.mark.long
def test_every_constant_of_the_circuit_is_found_within_a_tenth(flicker):
    found = {one.name: one.value for one in flicker.found}
    for name in NAMES:
        assert found[name] == pytest.approx(getattr(TRUTH, name), rel=0.1), name
        assert getattr(flicker.config, name) == pytest.approx(found[name], abs=0.5)
    assert flicker.cycles.hz == pytest.approx(5.0, rel=1e-4)
    assert all(one.low <= one.value <= one.high for one in flicker.found)


@pytest.mark.long
@pytest.mark.parametrize("bright", [0.9, 2.5])
def test_a_sensor_of_other_making_is_found_within_a_tenth(bright):
    """The benchmark's sensor shares no code with ours: its bandwidth falls with the light below a
    radiance of 0.5 and is constant above, it has four times the noise, and the recording begins and
    ends within a burst."""
    model = dataclasses.replace(NOISY, shot_hz=4.0)
    sensor = PixelArray(model, SensorSize(20, 16), seed=3)
    for step in range(4801):
        is_bright = step * 5 % 4800 < 2400
        radiance = np.full((16, 20), bright if is_bright else bright / 6)
        sensor.expose(radiance, round(step * 1e6 / 4800))
    flicker = measure_flicker(
        sensor.events(), dataclasses.replace(START, balance=1.0), hz=5.0, ratio=6.0
    )
    found = {one.name: one.value for one in flicker.found}
    # White is the bright half.
    expected = 0.2, 1.0, 0.03, 250.0 * bright / 0.5, 300.0, 250.0
    for name, value in zip((*NAMES, "cutoff_limit_hz"), expected, strict=True):
        assert found[name] == pytest.approx(value, rel=0.1), name
        assert getattr(flicker.config, name) == pytest.approx(found[name], abs=0.5)
    for measured, true in zip(flicker.thresholds, (sensor._on, sensor._off), strict=True):
        error = measured.reshape(-1) * true.mean() - true
        assert np.sqrt(np.nanmean(error**2)) < 0.2 * true.std()


@pytest.mark.long
def test_pixels_with_high_thresholds_are_bright_in_the_map(flicker):
    both = np.mean(flicker.thresholds, 0)
    known = both[np.isfinite(both)]
    assert known.size > 0.9 * both.size
    assert known.mean() == pytest.approx(1.0, abs=0.02)
    # Mean of two thresholds that spread by 0.04 around 0.297 and 0.228.
    relative = math.hypot(0.04 / 0.297, 0.04 / 0.228) / 2
    assert known.std() == pytest.approx(relative, rel=0.2)


@pytest.mark.long
def test_without_the_ratio_thresholds_are_relative(recording):
    flicker = measure_flicker(recording, START, hz=5.0, ratio=None)
    kept = {one.name: one.reason for one in flicker.kept}
    assert kept["contrast_threshold"] == "--flicker-ratio is not given"
    assert flicker.config.contrast_threshold == START.contrast_threshold
    relative = flicker.config.threshold_sigma / START.contrast_threshold
    assert relative == pytest.approx(0.04 / 0.26, rel=0.15)
    assert flicker.config.on_off_ratio == pytest.approx(1.3, rel=0.15)


def test_what_is_no_flicker_is_refused(recording):
    with pytest.raises(InputError, match="do not alternate at 9 Hz"):
        measure_flicker(recording, START, hz=9.0, ratio=6.0)
    with pytest.raises(InputError, match="needs 3"):
        measure_flicker(recording.cut(0, 700_000), START, hz=5.0, ratio=6.0)
    weak = simulate_flicker(TRUTH, SIZE, 5.0, ratio=1.6, number=5)
    with pytest.raises(InputError, match="brighter against the dark"):
        measure_flicker(weak, START, hz=5.0, ratio=1.6)


def test_a_refractory_period_that_hides_the_burst_keeps_the_old_values():
    hidden = dataclasses.replace(
        TRUTH, cutoff_hz=1000.0, contrast_threshold=0.15, refractory_period_us=300
    )
    events = simulate_flicker(hidden, SensorSize(12, 10), 5.0, ratio=10.0, number=8)
    flicker = measure_flicker(events, START, hz=5.0, ratio=10.0)
    assert not flicker.found
    assert "use less light" in flicker.kept[0].reason
    assert flicker.config == START


@pytest.mark.parametrize("stated", [9.82, 9.953, 10.0, 10.17])
def test_cycles_and_bursts_of_a_pixel_by_hand(stated):
    # 10 Hz: bright from 0, dark from 50 ms; two ON events each, then one OFF event.
    t = [start + after for start in range(0, 500_000, 100_000) for after in (1000, 3000, 52_000)]
    events = EventStream([0] * 15, [0] * 15, t, [1, 1, 0] * 5, SensorSize(1, 1))
    cycles = find_cycles(events, stated)
    assert cycles.hz == pytest.approx(10.0, rel=1e-6)
    trains = PixelTrains.of(events)
    on, off = find_bursts(trains, cycles, 1), find_bursts(trains, cycles, 0)
    assert on.follows.tolist() == [False, True] * (len(on.pixel) // 2)
    assert np.diff(on.since_us)[::2] == pytest.approx(2000, abs=1)
    assert not off.follows.any()


def test_bursts_are_those_of_their_definition():
    """Events of a burst and of noise, several a pixel and a cycle, also before and after all."""
    random = np.random.default_rng(2)
    half, number, period = 50_000.0, 6, 100_000.0
    late = np.concatenate([random.exponential(2_000, 900), random.uniform(0, 100_000, 300)])
    pixel = random.integers(0, 400, 1200)
    p = (pixel % 2 == 1) ^ (random.random(1200) < 0.1)  # most pixels have one polarity
    t = random.integers(-1, number + 1, 1200) * period + late + np.where(p, 0, half)
    order, t = np.argsort(t), np.floor(t).astype(np.int64) + 10**6
    columns = (column[order] for column in (pixel % 20, pixel // 20, t, p))
    events = EventStream.from_columns(*columns, size=(20, 20))
    trains = PixelTrains.of(events)
    for polarity in (0, 1):
        starts = np.array([1e6 + half, 1e6])
        found = find_bursts(trains, Cycles(10.0, starts, number), polarity)
        columns = (trains.pixel.tolist(), trains.t.tolist(), trains.is_on.tolist())
        rows = []  # place among all events, pixel, cycle, µs since the half began
        for place, (where, t_us, is_on) in enumerate(zip(*columns, strict=True)):
            cycle, since = divmod(t_us - starts[polarity], period)
            if is_on == polarity and since < half and 0 <= cycle < number:
                rows.append((place, where, int(cycle), since))
        late_us = np.array([since for *_, since in rows])
        noise = 4 * np.sum(late_us >= half / 2) / (half / 2)
        ends = [half / 1000 * 1000 ** (one / 99) for one in range(100)]
        busy = [
            stop
            for start, stop in itertools.pairwise(ends)
            if np.sum((late_us >= start) & (late_us < stop)) > noise * (stop - start)
        ]
        rows = [row for row in rows if row[-1] < busy[-1]]
        before = {(one, *group): one for one, *group, _ in rows}
        follows = [(one - 1, *group) in before for one, *group, _ in rows]
        assert 0.02 < np.mean(follows) < 0.9
        assert (found.pixel.tolist(), found.cycle.tolist()) == (
            [row[1] for row in rows],
            [row[2] for row in rows],
        )
        assert found.since_us == pytest.approx(np.array([row[3] for row in rows]), abs=1e-3)
        assert found.follows.tolist() == follows
