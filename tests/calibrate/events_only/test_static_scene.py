"""Constants of a sensor at rest are found again in events that it is known to have made."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.calibrate.known_scenes import simulate_static

from texvent.calibrate.estimates import Estimate
from texvent.calibrate.events_only.pixel_trains import find_dead_time
from texvent.calibrate.events_only.static_scene import find_hot_pixels, measure_static_scene
from texvent.calibrate.events_only.stationary_blocks import (
    find_stationary,
    leak_rate,
    mains_flicker,
)
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent.simulation.physical.config import PhysicalConfig

SIZE = SensorSize(96, 64)
START = PhysicalConfig(gamma=1.0)
TRUTH = dataclasses.replace(
    START,
    noise_curve="128:3",
    noise_scale=1.0,
    noise_on_fraction=0.4,
    noise_decades=0.2,
    leak_rate_hz=1.0,
    hot_pixel_fraction=0.006,
    hot_pixel_rate_hz=150.0,
    refractory_period_us=800,
)


def record(config, seconds=8.0, seed=11, size=SIZE) -> EventStream:
    """After two seconds, in which pixels forget the phase that they began with."""
    events = simulate_static(config, size, seconds + 2.0, seed=seed)
    return events.cut(2_000_000, round((seconds + 2) * 1e6))


@pytest.fixture(scope="module")
def scene():
    return measure_static_scene(record(TRUTH), START)


def test_every_constant_of_a_sensor_at_rest_is_found_within_a_tenth(scene):
    found = {one.name: one.value for one in scene.found}
    assert found["noise_rate_hz"] == pytest.approx(3.0, rel=0.1)
    for name in (
        "noise_on_fraction",
        "noise_decades",
        "leak_rate_hz",
        "hot_pixel_rate_hz",
        "refractory_period_us",
    ):
        assert found[name] == pytest.approx(getattr(TRUTH, name), rel=0.1), name
    assert all(one.low <= one.value <= one.high for one in scene.found)
    # Which pixels are hot is a matter of chance; their number is found again, not the probability.
    hot = found["hot_pixel_fraction"] * 96 * 64
    assert hot == pytest.approx(0.006 * 96 * 64, abs=3 * 6)


def test_what_a_scene_at_rest_does_not_tell_stays(scene):
    kept = {one.name for one in scene.kept}
    assert {"contrast_threshold", "on_off_ratio", "threshold_sigma", "cutoff_hz"} <= kept
    assert scene.config.contrast_threshold == START.contrast_threshold
    assert scene.config.noise_curve.startswith("128:")
    assert scene.config.refractory_period_us == pytest.approx(800, rel=0.1)


def test_a_third_of_a_second_keeps_what_it_cannot_tell():
    quiet = dataclasses.replace(START, noise_curve="128:0.02", noise_scale=1.0, leak_rate_hz=0.0)
    scene = measure_static_scene(record(quiet, seconds=0.3), START)
    kept = {one.name: one.reason for one in scene.kept}
    assert {"noise_on_fraction", "noise_decades", "leak_rate_hz", "refractory_period_us"} <= {*kept}
    assert scene.config.noise_decades == START.noise_decades
    assert "50 are needed" in kept["refractory_period_us"]


def test_a_sensor_that_never_fires_has_an_upper_end_only():
    silent = EventStream([0, 0], [0, 1], [0, 10_000_000], [1, 0], SIZE)
    scene = measure_static_scene(silent, START)
    noise = next(one for one in scene.found if one.name == "noise_rate_hz")
    # 6144 pixels for 10 s, one OFF event: 3 per exposure is the least upper end.
    assert noise.value < 1e-4
    assert noise.high >= 3 / 61_440


def test_too_little_rest_is_refused():
    with pytest.raises(InputError, match=r"pixel-seconds of this recording are at rest"):
        measure_static_scene(EventStream.empty(SIZE), START)
    random = np.random.default_rng(0)
    # A bar that sweeps once over the sensor: 200 events per column, each column at its own time.
    column = np.repeat(np.arange(96), 200)
    rows = random.integers(0, 64, column.size)
    t = column * 100_000 + random.integers(0, 5_000, column.size)
    order = np.argsort(t)
    p = random.integers(0, 2, t.size)
    swept = EventStream(column[order], rows[order], t[order], p, SIZE)
    with pytest.raises(InputError, match="at rest"):
        measure_static_scene(swept, START)


def test_hot_pixels_stand_out_of_the_spread_of_the_others():
    counts = np.random.default_rng(3).poisson(20, 4000)
    everywhere = np.ones(4000, np.bool_)
    assert find_hot_pixels(counts, everywhere).sum() <= 1
    counts[[5, 70]] = 400
    assert np.flatnonzero(find_hot_pixels(counts, everywhere)).tolist() == [5, 70]


@given(noise=st.floats(0.01, 20), leak=st.floats(0.05, 20))
def test_the_leak_is_found_from_how_often_it_fires_among_noise(noise, leak):
    if noise / leak > 20:
        return
    # After each of n events per second, leak comes first with probability exp(-n / g).
    surplus = noise / np.expm1(noise / leak)
    assert leak_rate(noise, surplus, 0.0, 0.0) == pytest.approx(leak, rel=1e-3)


@given(noise=st.floats(0.1, 5), leak=st.floats(0.2, 5), decades=st.floats(0.0, 0.3))
def test_the_mean_over_pixels_is_that_of_drawn_ones(noise, leak, decades):
    draws = np.random.default_rng(1).standard_normal(20_000)
    spread = np.log(10) * decades
    ratio = noise * np.exp(spread * draws - spread**2 / 2) / leak
    surplus = float((leak * ratio / np.expm1(np.minimum(ratio, 500))).mean())
    if surplus > 1e-3 * leak:
        assert leak_rate(noise, surplus, decades, 0.0) == pytest.approx(leak, rel=0.03)


def test_rare_intervals_only_bound_it():
    assert find_dead_time(np.array([400.0] * 49)) == "49 intervals; 50 are needed"
    sparse = find_dead_time(np.linspace(1_000, 100_000, 50))
    assert sparse == "intervals near it are too rare; it is at most 1000 µs"


@given(dead=st.integers(100, 5_000), seed=st.integers(0, 1000))
def test_the_dead_time_is_within_its_interval(dead, seed):
    waits = dead + np.random.default_rng(seed).exponential(dead * 50, 20_000)
    found = find_dead_time(waits)
    assert isinstance(found, Estimate)
    # The shortest of them lies above; 1/ρ is the mean gap, of which the interval holds three.
    assert found.low - 0.05 * dead <= dead <= found.high


BLOCKS_SIZE = SensorSize(48, 32)


def scattered(count, seed=0, span_us=8_000_000):
    random = np.random.default_rng(seed)
    t = np.sort(random.integers(0, span_us, count))
    return EventStream(
        random.integers(0, 48, count), random.integers(0, 32, count), t, t % 2, BLOCKS_SIZE
    )


def test_random_events_are_at_rest_and_a_burst_in_a_block_is_not():
    noise = scattered(5_000)
    assert find_stationary(noise).all()
    burst = EventStream([20] * 300, [5] * 300, range(4_000_000, 4_000_300), [1] * 300, BLOCKS_SIZE)
    both = np.argsort(np.concatenate([noise.t, burst.t]), kind="stable")
    columns = (np.concatenate([getattr(noise, n), getattr(burst, n)])[both] for n in "xytp")
    rests = find_stationary(EventStream(*columns, BLOCKS_SIZE))
    # Blocks of 16: the burst lies in columns 16..31 of the upper row.
    assert not rests[:16, 16:32].any()
    assert rests.sum() == 48 * 32 - 16 * 16


def test_no_events_are_at_rest():
    assert find_stationary(EventStream.empty(BLOCKS_SIZE)).all()


def test_a_lamp_on_the_mains_is_told_from_noise():
    noise = scattered(20_000)
    assert mains_flicker(noise) is None
    assert all(mains_flicker(scattered(40, seed)) is None for seed in range(9))
    assert mains_flicker(EventStream.empty(BLOCKS_SIZE)) is None
    lit = noise[(noise.t % 10_000 < 4_000) | (noise.t % 5 == 0)]
    assert mains_flicker(lit) == 100.0
