"""Leak, noise and mismatch of the physical model against their definition."""

import math

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent.events import NOISE, SIGNAL
from texvent.frames import Frame
from texvent.simulation.physical.config import DAVIS346_NOISE, parse_noise_curve

from ..pixel_frames import curve, frames_of, run, static
from .physical_pixels import clean, intensity, noisy, poisson_interval

# Leak.


def test_an_event_that_light_made_more_than_leak_is_signal():
    # The leak makes a sixth of the change.
    frames = frames_of([intensity(4), intensity(5)], [0, 1_000_000])[:1] + frames_of(
        [intensity(4.99)], [990_000]
    )
    events = run(clean(leak_rate_hz=1.0, leak_rate_decades=0.0), frames)
    assert events.t == pytest.approx([k / 6 * 1e6 for k in range(1, 6)], abs=2)
    assert (events.label == SIGNAL).all()


# Noise.


def test_noise_of_a_pair_follows_the_curve_at_both_frames():
    """By its definition: log-linear in the level, the mean over both frames, Poisson in number."""
    start, stop = np.meshgrid([0.5, 3.5, 12.0, 25.0, 200.0], [0.5, 5.0, 40.0, 200.0])
    start, stop = np.stack([start.reshape(-1), stop.reshape(-1)])
    frames = [Frame(np.tile(row, (400, 1)), t) for row, t in ((start, 0), (stop, 1_000_000))]
    events = run(noisy(noise_scale=20.0, contrast_threshold=10.0), frames)
    points = np.array([point.split(":") for point in DAVIS346_NOISE.split()], float)
    rates = np.exp(np.interp(np.stack([start, stop]), points[:, 0], np.log(points[:, 1])))
    expected = 20 * rates.mean(axis=0)
    counts = np.zeros((400, len(start)))
    np.add.at(counts, (events.y, events.x), 1)
    assert (np.abs(counts.mean(axis=0) - expected) < 5 * np.sqrt(expected / 400)).all()
    in_rows = counts.sum(axis=1)
    assert in_rows.var() == pytest.approx(expected.sum(), rel=5 * math.sqrt(2 / 400))
    assert (events.label == NOISE).all()


def test_noise_of_pixels_varies_around_the_stated_mean():
    frames = static(3.5, fps=24, seconds=1.0, shape=(60, 80))
    even, uneven = (run(noisy(noise_scale=20.0, noise_decades=d), frames) for d in (0.0, 0.25))
    counts = [np.bincount(e.y.astype(int) * 80 + e.x, minlength=4800) for e in (even, uneven)]
    # Log-normal with sd 0.5756 of its logarithm: relative sd 0.627; its mean over 4800 pixels.
    mean = 20 * 0.77
    assert counts[1].mean() == pytest.approx(mean, rel=5 * 0.63 / math.sqrt(4800))
    assert counts[0].var() == pytest.approx(mean, rel=0.15)
    assert counts[1].var() == pytest.approx(mean + (0.627 * mean) ** 2, rel=0.2)


def test_noise_resets_its_pixel():
    # 0.1 of 0.2 log units per 0.1 s, and noise every 10 ms: no signal is left.
    frames = curve(lambda s: intensity(math.log(13) + s), fps=100, seconds=1.0)
    events = run(noisy(noise_scale=100 / 0.77, noise_curve="0:0.77"), frames)
    assert len(events)
    assert (events.label == NOISE).all()


def test_hot_pixels_are_as_many_and_as_hot_as_stated():
    simulator = clean(hot_pixel_fraction=0.01, hot_pixel_rate_hz=100.0)
    events = run(simulator, static(200.0, fps=24, seconds=1.0, shape=(100, 100)))
    count = np.bincount(events.y.astype(int) * 100 + events.x, minlength=10_000)
    hot = count > 0
    assert hot.sum() == pytest.approx(100, abs=poisson_interval(100))
    mean = 100 * hot.sum()
    assert len(events) == pytest.approx(mean, abs=poisson_interval(mean))


@pytest.mark.parametrize("share", [0.0, 0.2, 1.0])
@pytest.mark.parametrize(
    "source",
    [{"hot_pixel_fraction": 0.5, "hot_pixel_rate_hz": 40.0}, {"noise_scale": 20.0}],
    ids=lambda one: next(iter(one)),
)
def test_random_events_are_on_in_the_stated_share(source, share):
    simulator = noisy(noise_on_fraction=share, **{"noise_scale": 0.0, **source})
    events = run(simulator, static(3.5, fps=24, seconds=1.0, shape=(20, 30)))
    assert len(events) > 5000
    assert events.p.mean() == pytest.approx(share, abs=5 * math.sqrt(share * (1 - share) / 5000))


# The sensor.


def first_times(simulator) -> np.ndarray:
    frames = [
        Frame(np.full((20, 30), intensity(v), np.float32), t) for v, t in ((4, 0), (5, 10**6))
    ]
    events = run(simulator, frames)
    times = np.full((20, 30), 10**6)
    np.minimum.at(times, (events.y, events.x), events.t)
    return times


def test_thresholds_have_the_stated_mean_and_mismatch():
    thresholds = first_times(clean(threshold_sigma=0.03)) * 1e-6
    assert thresholds.mean() == pytest.approx(0.2, abs=5 * 0.03 / math.sqrt(600))
    assert thresholds.std() == pytest.approx(0.03, rel=5 / math.sqrt(1200))


def test_two_runs_of_one_sensor_share_what_is_fixed_to_its_pixels_alone():
    def maps(**options):
        seeds = ((0, None), (1, None), (1, 0), (2, 0))
        simulators = [clean(seed=one, sensor_seed=sensor, **options) for one, sensor in seeds]
        return [first_times(simulator) for simulator in simulators]

    thresholds = maps(threshold_sigma=0.03)
    assert not np.array_equal(thresholds[0], thresholds[1])
    assert all(np.array_equal(thresholds[0], one) for one in thresholds[2:])
    phases = maps(initial_phase="random")
    assert len({one.tobytes() for one in phases}) == 3  # the second and third have one seed
    frames = static(3.5, fps=24, seconds=1, shape=(20, 20))
    fires = {"sensor_seed": 0, "noise_scale": 0.0, "hot_pixel_fraction": 0.2}
    hot = [run(noisy(seed=seed, **fires), frames) for seed in (1, 2)]
    assert hot[0] != hot[1]
    places = [set(zip(one.x.tolist(), one.y.tolist(), strict=True)) for one in hot]
    assert places[0] == places[1]
    noise = [run(noisy(seed=seed, sensor_seed=0, noise_scale=5.0), frames) for seed in (1, 2)]
    assert noise[0] != noise[1]


def test_hot_pixels_and_other_noise_fire_independently():
    """Both 20 times a second, in every pixel: never at one time but by chance."""
    fires = {"noise_curve": "0:20", "hot_pixel_fraction": 1.0, "hot_pixel_rate_hz": 20.0}
    events = run(noisy(**fires), static(90.0, fps=24, seconds=1, shape=(20, 20)))
    assert len(events) == pytest.approx(16_000, abs=poisson_interval(16_000))
    seen = set(zip(events.x.tolist(), events.y.tolist(), events.t.tolist(), strict=True))
    assert len(seen) > len(events) - 10


@pytest.mark.parametrize(("ratio", "whole"), [(1.0, 0.4), (0.25, 0.5)])
def test_the_first_frame_finds_pixels_in_random_phase(ratio, whole):
    times = first_times(clean(initial_phase="random", on_off_ratio=ratio)) * 1e-6
    # From anywhere between both thresholds, 0.2 and 0.2 or 0.4 and 0.1, up to the ON threshold.
    quartiles = np.quantile(times / whole, [0.25, 0.5, 0.75])
    assert quartiles == pytest.approx([0.25, 0.5, 0.75], abs=0.1)
    assert 0.95 * whole < times.max() <= whole


# The noise curve.


def test_a_curve_reads_back_what_it_writes():
    curve = parse_noise_curve(DAVIS346_NOISE)
    again = parse_noise_curve(str(curve))
    assert np.array_equal(curve.levels, again.levels)
    assert np.array_equal(curve.rates_hz, again.rates_hz)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "LEVEL:RATE"),
        ("dark", "LEVEL:RATE"),
        ("1:2:3", "LEVEL:RATE"),
        ("1:0.5 0.3", "LEVEL:RATE"),
        ("5:0.1 5:0.2", "increase"),
        ("-1:0.1", "increase"),
        ("5:0.1 300:0.2", "increase"),
        ("5:0", "above 0"),
        ("5:nan", "above 0"),
        ("nan:1", "increase"),
    ],
)
def test_other_texts_fail_and_say_what_is_wanted(text, message):
    with pytest.raises(ConfigError, match=message):
        parse_noise_curve(text)
