"""The physical model against closed forms, its rates against their definition."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import ConfigError
from texvent.events import NOISE, SIGNAL
from texvent.simulate.kernels.circuit_reference import answer_to_line
from texvent.simulate.physical import PhysicalSimulator
from texvent.simulate.physical_config import PRESETS, RANGES, PhysicalConfig
from texvent.video import Frame

from .published import curve, frames_of, moving_texture, run, static

CLEAN = dataclasses.replace(PRESETS["clean"], gamma=1.0)


def clean(backend="reference", *, seed=0, **options) -> PhysicalSimulator:
    return PhysicalSimulator(dataclasses.replace(CLEAN, **options), seed=seed, backend=backend)


def intensity(brightness: float, balance: float = 10.0) -> float:
    """The linear intensity with ln(balance + I) = brightness."""
    return math.exp(brightness) - balance


def poisson_interval(mean: float) -> float:
    """Five standard deviations: missed once in two million tests."""
    return 5 * math.sqrt(mean)


# One pixel, closed forms.


@pytest.mark.parametrize("sign", [1, -1])
def test_a_ramp_fires_where_it_crosses_each_threshold(backend, sign):
    frames = frames_of([intensity(4), intensity(4 + sign * 1.05)], [0, 1_000_000])
    events = run(clean(backend), frames)
    assert events.t == pytest.approx([k * 0.2 / 1.05 * 1e6 for k in range(1, 6)], abs=2)
    assert (events.polarity == sign).all()


def test_a_slow_ramp_is_summed_over_frames_and_keeps_the_rest(backend):
    # Ramp B' of docs/equations.md: 0.055 per frame.
    frames = frames_of([intensity(4 + 0.055 * i) for i in range(21)], range(0, 21_000, 1000))
    events = run(clean(backend), frames)
    assert events.t == pytest.approx([k * 0.2 / 0.055 * 1000 for k in range(1, 6)], abs=1)


def test_a_step_fires_once_per_threshold(backend):
    frames = frames_of([intensity(v) for v in (4, 4, 4.9, 4.9)], [0, 1000, 1001, 500_000])
    events = run(clean(backend), frames)
    assert events.t.tolist() == [1000] * 4
    assert events.p.all()


def test_a_sinusoid_fires_at_its_levels(backend):
    amplitude = 0.51
    frames = curve(lambda s: intensity(4 + amplitude * math.sin(math.tau * s)), fps=1000, seconds=1)
    events = run(clean(backend), frames)
    up = [math.asin(level / amplitude) / math.tau for level in (0.2, 0.4)]
    down = [0.5 - math.asin(level / amplitude) / math.tau for level in (0.2, 0.0, -0.2, -0.4)]
    back = [1 + math.asin(level / amplitude) / math.tau for level in (-0.2, 0.0)]
    # The last one is the end of the clip, and the clip does not contain its end.
    expected = up + down + back[:1]
    assert events.t[:7] == pytest.approx([t * 1e6 for t in expected], abs=6)
    assert events.p[:7].tolist() == [1, 1, 0, 0, 0, 0, 1]


@pytest.mark.parametrize("fps", [24, 240, 1000])
def test_a_static_scene_without_noise_gives_nothing(backend, fps):
    assert len(run(clean(backend), static(90.0, fps=fps, seconds=0.2, shape=(3, 4)))) == 0


def test_gamma_makes_video_linear(backend):
    levels = [255 * (linear / 255) ** (1 / 2.2) for linear in (50, 120)]
    coded = run(clean(backend, gamma=2.2), frames_of(levels, [0, 100_000]))
    linear = run(clean(backend), frames_of([50, 120], [0, 100_000]))
    assert len(coded) == 3  # ln(130 / 60) = 0.773
    assert coded.t == pytest.approx(linear.t, abs=2)


def test_on_and_off_have_their_own_thresholds(backend):
    simulator = clean(backend, contrast_threshold=0.2, on_off_ratio=1.44)
    assert simulator.config.contrast_threshold_on == pytest.approx(0.24)
    assert simulator.config.contrast_threshold_off == pytest.approx(0.2 / 1.2)
    events = run(
        simulator, frames_of([intensity(v) for v in (4, 5, 5.1, 4)], [0, 10**6, 2 * 10**6, 10**7])
    )
    # Up by 1.1: 4 at 0.24 (the rest, 0.14, stays). Down by 1.1: 0.14 + 5 at 0.1667.
    assert int(events.p.sum()) == 4
    assert int((events.p == 0).sum()) == 5


def test_refractory_time_adds_to_the_time_between_events(backend):
    # 1 log unit per second, threshold 0.2: 200 ms to charge after each 50 ms in reset.
    frames = frames_of([intensity(4), intensity(5)], [0, 1_000_000])
    events = run(clean(backend, refractory_period_us=50_000), frames)
    # Times are rounded down, and the next period starts from the rounded one.
    assert events.t == pytest.approx([200_000, 450_000, 700_000, 950_000], abs=6)


def test_a_change_in_the_refractory_period_is_lost(backend):
    values, times = [intensity(v) for v in (4, 4.25, 4.25, 4.45, 4.45)], [0, 10, 20, 30, 10**6]
    kept = run(clean(backend), frames_of(values, times))
    lost = run(clean(backend, refractory_period_us=1000), frames_of(values, times))
    assert len(kept) == 2
    assert len(lost) == 1


def test_unfired_change_decays_at_its_rate(backend):
    # Jumps of 0.15 that are 0.1 s apart; at 5 per second 0.15 becomes 0.0910 in between.
    values = [intensity(v) for v in (4, 4.15, 4.15, 4.3)]
    times = [0, 1, 100_001, 100_002]
    decaying = run(clean(backend, residual_decay_hz=5.0), frames_of(values, times))
    assert len(decaying) == 1  # 0.0910 + 0.15 > 0.2
    assert len(run(clean(backend, residual_decay_hz=12.0), frames_of(values, times))) == 0
    assert len(run(clean(backend), frames_of(values, times))) == 1


# The photoreceptor.


def follow_line(t: float, slope: float, tau: float) -> float:
    """Answer of a first-order low-pass to a line from rest."""
    return slope * (t - tau * (1 - math.exp(-t / tau)))


@pytest.mark.parametrize("count", [1, 7, 100])
def test_the_low_pass_follows_a_line_by_its_closed_form(backend, count):
    # So small a contrast that the corner frequency, (100 + 20) / 275 of the cutoff, stays.
    cutoff, threshold, balance = 5.0, 0.011, 10.0
    tau = 1 / (math.tau * cutoff * 120 / 275)
    start = math.log(110)
    values = [intensity(start + 0.05 * i / count, balance) for i in range(count + 1)]
    times = [round(i * 500_000 / count) for i in range(count + 1)]
    simulator = clean(backend, cutoff_hz=cutoff, contrast_threshold=threshold)
    events = run(simulator, frames_of(values, times))
    assert len(events) == 3
    reached = [follow_line(t * 1e-6, 0.1, tau) for t in events.t]
    # The corner rises by 2 % on the way, in as many steps as there are frames.
    assert reached == pytest.approx([threshold, 2 * threshold, 3 * threshold], rel=0.01)


@pytest.mark.parametrize("angle", [1e-9, 0.1, 0.25, 0.5, 0.501, 1.0, 3.7, 40.0, 800.0, 1e9])
def test_the_answer_to_a_line_is_right_for_pieces_of_any_length(angle):
    decay, gain = answer_to_line(angle)
    assert decay == pytest.approx(math.exp(-angle), rel=2e-4, abs=1e-12)
    assert gain == pytest.approx(-math.expm1(-angle) / angle, rel=1e-4)


def test_frames_an_hour_apart_are_simulated_at_once(backend):
    hour_us = 3_600_000_000
    start = math.log(110)
    values = [intensity(start, 10.0), intensity(start + 0.65, 10.0)]
    events = run(clean(backend, cutoff_hz=250.0), frames_of(values, [0, hour_us]))
    expected = np.array([0.2, 0.4, 0.6]) / 0.65 * hour_us
    assert events.t == pytest.approx(expected, abs=hour_us / 1024)


@pytest.mark.parametrize("fps", [240, 1000])
def test_bandwidth_does_not_depend_on_the_frame_rate(backend, fps):
    knots = np.array([4.0, 4.4, 5.2, 4.9, 4.1, 4.1, 4.8, 3.9, 4.0])

    def sampled(rate):
        wave = lambda s: intensity(float(np.interp(s * 24, np.arange(len(knots)), knots)))  # noqa: E731
        return run(clean(backend, cutoff_hz=60.0), curve(wave, fps=rate, seconds=8 / 24))

    slow, fast = sampled(24), sampled(fps)
    assert len(slow) > 10
    assert fast.p.tolist() == slow.p.tolist()
    # What is left: the corner of a pixel that does not fire is averaged over each interval.
    assert fast.t == pytest.approx(slow.t, abs=100)


def test_dark_pixels_are_slower_than_bright_ones(backend):
    def delay(level):
        start = math.log(10 + level)
        values = [level, intensity(start + 0.4), intensity(start + 0.4)]
        events = run(clean(backend, cutoff_hz=100.0), frames_of(values, [0, 100, 500_000]))
        return int(events.t[0])

    # Half of a step of 0.4 is reached after ln 2 · τ.
    for level in (20.0, 150.0):
        end = (level + intensity(math.log(10 + level) + 0.4)) / 2
        tau = 275 / (math.tau * 100 * (end + 20)) * 1e6
        assert delay(level) == pytest.approx(tau * math.log(2), rel=0.35)
    assert delay(20.0) > 2 * delay(150.0)


def test_more_bandwidth_converges_to_no_limit():
    frames = moving_texture(4)
    limited = run(clean("cpu", cutoff_hz=1e5), frames)
    unlimited = run(clean("cpu"), frames)
    assert abs(len(limited) - len(unlimited)) <= 0.01 * len(unlimited)


# Leak.


def test_leak_fires_on_events_at_its_rate_labelled_noise(backend):
    simulator = clean(backend, leak_rate_hz=5.0, leak_rate_decades=0.0)
    events = run(simulator, static(90.0, fps=24, seconds=1.0))
    assert events.t == pytest.approx([200_000, 400_000, 600_000, 800_000], abs=2)
    assert events.p.all()
    assert (events.label == NOISE).all()


@pytest.mark.parametrize("fps", [24, 240, 1000])
def test_the_leak_rate_is_per_second_at_any_frame_rate(fps):
    simulator = clean(
        "cpu", leak_rate_hz=4.0, leak_rate_decades=0.1, initial_phase="random", threshold_sigma=0.03
    )
    events = run(simulator, static(90.0, fps=fps, seconds=1.0, shape=(30, 40)))
    # The first event of a pixel is early: its phase is uniform over both thresholds.
    mean = 4.0 * 1200
    late = events.between(500_000, 1_000_000)
    assert len(late) == pytest.approx(mean / 2, abs=poisson_interval(mean / 2))


def test_an_event_that_light_made_more_than_leak_is_signal(backend):
    # The leak makes a sixth of the change.
    frames = frames_of([intensity(4), intensity(5)], [0, 1_000_000])[:1] + frames_of(
        [intensity(4.99)], [990_000]
    )
    events = run(clean(backend, leak_rate_hz=1.0, leak_rate_decades=0.0), frames)
    assert events.t == pytest.approx([k / 6 * 1e6 for k in range(1, 6)], abs=2)
    assert (events.label == SIGNAL).all()


# Noise.


def noisy(backend="cpu", **options) -> PhysicalSimulator:
    return clean(backend, **{"noise_scale": 1.0, "noise_decades": 0.0, **options})


@pytest.mark.parametrize("fps", [24, 240, 1000])
@pytest.mark.parametrize(("level", "rate"), [(0.5, 0.46), (3.5, 0.77), (25.0, 0.015)])
def test_noise_has_the_measured_rate_at_any_frame_rate(fps, level, rate):
    frames = static(level, fps=fps, seconds=0.5, shape=(60, 80))
    events = run(noisy(noise_scale=10.0), frames)
    mean = 10 * rate * 0.5 * 4800
    assert len(events) == pytest.approx(mean, abs=poisson_interval(mean))
    assert (events.label == NOISE).all()


@pytest.mark.parametrize("intermediate", [0, 9, 30])
def test_noise_does_not_depend_on_intermediate_frames(intermediate):
    steps = 5 * (intermediate + 1)
    frames = [
        Frame(np.full((60, 80), 3.5, np.float32), round(i * 200_000 / steps), i % 5 == 0)
        for i in range(steps + 1)
    ]
    mean = 10 * 0.77 * 0.2 * 4800
    assert len(run(noisy(noise_scale=10.0), frames)) == pytest.approx(
        mean, abs=poisson_interval(mean)
    )


def test_noise_has_the_stated_share_of_on():
    events = run(
        noisy(noise_scale=20.0, noise_on_fraction=0.3),
        static(3.5, fps=24, seconds=1, shape=(40, 40)),
    )
    assert events.p.mean() == pytest.approx(0.3, abs=5 * math.sqrt(0.21 / len(events)))


def test_noise_of_pixels_varies_around_the_stated_mean():
    frames = static(3.5, fps=24, seconds=1.0, shape=(60, 80))
    even, uneven = (run(noisy(noise_scale=20.0, noise_decades=d), frames) for d in (0.0, 0.25))
    counts = [np.bincount(e.y.astype(int) * 80 + e.x, minlength=4800) for e in (even, uneven)]
    # Log-normal with sd 0.5756 of its logarithm: relative sd 0.627; its mean over 4800 pixels.
    mean = 20 * 0.77
    assert counts[1].mean() == pytest.approx(mean, rel=5 * 0.63 / math.sqrt(4800))
    assert counts[0].var() == pytest.approx(mean, rel=0.15)
    assert counts[1].var() == pytest.approx(mean + (0.627 * mean) ** 2, rel=0.2)


def test_noise_resets_its_pixel_unless_told_not_to():
    # 0.1 of 0.2 log units per 0.1 s, and noise every 10 ms: with resets no signal is left.
    frames = curve(lambda s: intensity(math.log(13) + s), fps=100, seconds=1.0)
    options = {"noise_scale": 100 / 0.77, "noise_curve": "0:0.77"}
    reset = run(noisy(**options), frames)
    added = run(noisy(**options, noise_resets=False), frames)
    assert (reset.label == NOISE).all()
    assert int((added.label == SIGNAL).sum()) in (4, 5)  # the fifth falls on the end


def test_hot_pixels_are_as_many_and_as_hot_as_stated():
    simulator = clean("cpu", hot_pixel_fraction=0.01, hot_pixel_rate_hz=100.0)
    events = run(simulator, static(200.0, fps=24, seconds=1.0, shape=(100, 100)))
    count = np.bincount(events.y.astype(int) * 100 + events.x, minlength=10_000)
    hot = count > 0
    assert hot.sum() == pytest.approx(100, abs=poisson_interval(100))
    mean = 100 * hot.sum()
    assert len(events) == pytest.approx(mean, abs=poisson_interval(mean))


def test_a_static_scene_at_the_default_preset_fires_at_the_sum_of_its_rates():
    config = dataclasses.replace(PRESETS["davis346"], gamma=1.0)
    frames = static(10.0, fps=24, seconds=3.0, shape=(100, 120))
    events = run(PhysicalSimulator(config, backend="cpu"), frames)
    rate = math.exp(np.interp(10, [7.5, 15], np.log([0.30, 0.12])))
    mean = rate * 3 * 12_000
    # 2 %: the mean of 12,000 log-normal factors.
    assert len(events) == pytest.approx(mean, abs=poisson_interval(mean) + 0.02 * mean)


# The sensor.


def first_times(simulator) -> np.ndarray:
    frames = [
        Frame(np.full((20, 30), intensity(v), np.float32), t) for v, t in ((4, 0), (5, 10**6))
    ]
    events = run(simulator, frames)
    times = np.full((20, 30), 10**6)
    np.minimum.at(times, (events.y, events.x), events.t)
    return times


def test_thresholds_have_the_stated_mean_and_mismatch(backend):
    thresholds = first_times(clean(backend, threshold_sigma=0.03)) * 1e-6
    assert thresholds.mean() == pytest.approx(0.2, abs=5 * 0.03 / math.sqrt(600))
    assert thresholds.std() == pytest.approx(0.03, rel=5 / math.sqrt(1200))


def test_the_sensor_seed_fixes_the_sensor_and_nothing_else():
    maps = [
        first_times(clean(seed=seed, sensor_seed=sensor, threshold_sigma=0.03))
        for seed, sensor in ((0, None), (1, None), (1, 0), (2, 0))
    ]
    assert not np.array_equal(maps[0], maps[1])
    assert np.array_equal(maps[0], maps[2])
    assert np.array_equal(maps[0], maps[3])
    frames = static(3.5, fps=24, seconds=1, shape=(20, 20))
    noise = [run(noisy(seed=seed, sensor_seed=0, noise_scale=5.0), frames) for seed in (0, 1)]
    assert not noise[0].equals(noise[1])


def test_the_first_frame_finds_pixels_in_random_phase(backend):
    times = first_times(clean(backend, initial_phase="random")) * 1e-6
    # From anywhere in -0.2..0.2 up to 0.2: uniform over 0..0.4 s.
    assert np.quantile(times, [0.25, 0.5, 0.75]) == pytest.approx([0.1, 0.2, 0.3], abs=0.05)
    assert times.max() <= 0.4


# Everything at once.


def test_ideal_events_are_recovered_from_240_frames_per_second(backend):
    """An ideal camera, written down independently: every threshold passed at 4800 fps."""

    def radiance(t: float) -> np.ndarray:
        y, x = np.mgrid[:12, :16]
        wave = np.sin(0.7 * (x - 40 * t)) + np.sin(0.5 * (y + 25 * t)) * np.cos(0.4 * (x + 30 * t))
        return 0.12 + 0.2 * (wave + 2)

    level = np.log(radiance(0) + 0.004)
    truth = []
    for i in range(1, 4801):
        now = np.log(radiance(i / 4800 / 4) + 0.004)
        steps = np.trunc((now - level) / 0.2).astype(int)
        level = level + 0.2 * steps
        truth += [(i, p, s) for p, s in enumerate(steps.ravel()) if s]
    counts = np.zeros((2, 192), int)
    for _, pixel, steps in truth:
        counts[int(steps > 0), pixel] += abs(steps)

    def photograph(t: float) -> np.ndarray:
        return np.round(255 * np.clip(0.9 * radiance(t), 0, 1) ** (1 / 2.2)).astype(np.uint8)

    frames = [Frame(photograph(i / 240), round(i * 1e6 / 240)) for i in range(61)]
    camera = clean(backend, gamma=2.2, balance=0.004 * 0.9 * 255)
    events = run(camera, frames)
    assert counts.sum() > 1000
    assert len(events) / counts.sum() == pytest.approx(1, abs=0.03)
    mine = np.zeros((2, 192), int)
    np.add.at(mine, (events.p, events.y.astype(int) * 16 + events.x), 1)
    assert np.abs(mine - counts).sum() <= 0.06 * counts.sum()


CONFIGS = st.builds(
    PhysicalConfig,
    gamma=st.sampled_from([1.0, 2.2]),
    balance=st.floats(0.5, 40),
    contrast_threshold=st.floats(0.03, 0.6),
    on_off_ratio=st.floats(0.6, 1.6),
    threshold_sigma=st.sampled_from([0.0, 0.05]),
    initial_phase=st.sampled_from(["zero", "random"]),
    residual_decay_hz=st.sampled_from([0.0, 3.0]),
    cutoff_hz=st.sampled_from([0.0, 5.0, 250.0]),
    refractory_period_us=st.sampled_from([0, 1, 300, 60_000]),
    leak_rate_hz=st.sampled_from([0.0, 0.1, 30.0]),
    noise_scale=st.sampled_from([0.0, 1.0, 300.0]),
    noise_resets=st.booleans(),
    hot_pixel_fraction=st.sampled_from([0.0, 0.2]),
    readout_latency_us=st.sampled_from([0, 20_000]),
    readout_jitter_us=st.sampled_from([0, 70_000]),
    clock_step_us=st.sampled_from([1, 1000]),
    rate_limit_hz=st.sampled_from([0.0, 2000.0]),
)


@settings(max_examples=60, deadline=None)
@given(CONFIGS, st.integers(0, 2**63 - 1), st.integers(0, 99))
def test_backends_agree_and_packets_are_sound_for_any_options(config, seed, scene):
    frames = moving_texture(5, (4, 6), step_us=41_667, seed=scene)
    streams = []
    for backend in ("reference", "cpu"):
        simulator = PhysicalSimulator(config, seed=seed, backend=backend)
        last = frames[0].t_us
        packets = []
        for frame in frames:
            packets.append(simulator.step(frame))
            assert not len(packets[-1]) or last <= packets[-1].t[0]
            assert not len(packets[-1]) or packets[-1].t[-1] < frame.t_us
            last = frame.t_us
        streams.append(packets)
    assert all(one.equals(two) for one, two in zip(*streams, strict=True))


def events_of_pixels(events) -> list:
    """The events of each pixel on its own."""
    return [
        events[(events.y == y) & (events.x == x)]
        for y in range(events.size.height)
        for x in range(events.size.width)
    ]


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32))
def test_inverted_contrast_swaps_on_and_off(scene):
    logs = np.random.default_rng(scene).uniform(-1, 1, (5, 3, 4))
    events, inverted = (
        run(
            clean("cpu"),
            [Frame(80 * np.exp(s * log) - 10, i * 10_000) for i, log in enumerate(logs)],
        )
        for s in (1, -1)
    )
    assert len(events) == len(inverted)
    by_pixel = [events_of_pixels(e) for e in (events, inverted)]
    for here, there in zip(*by_pixel, strict=True):
        # Frames are float32, so a crossing may move by a microsecond.
        assert here.t == pytest.approx(there.t, abs=2)
        assert here.p.tolist() == (1 - there.p).tolist()


def test_eq4_counts_in_the_gamma_coded_scale():
    simulator = PhysicalSimulator(
        PhysicalConfig(contrast_threshold=0.22, on_off_ratio=1.21, balance=255.0)
    )
    assert simulator.contrast_threshold == pytest.approx(0.2 / 2.2)
    assert simulator.balance == pytest.approx(255.0)


@pytest.mark.parametrize("preset", PRESETS)
def test_every_preset_makes_events_of_a_moving_texture(preset):
    events = run(PhysicalSimulator(PRESETS[preset]), moving_texture())
    assert len(events) > 100


@pytest.mark.parametrize("option", RANGES)
def test_options_out_of_range_fail_by_name(option):
    low, high = RANGES[option]
    for value in (low - 1, high * 2 + 1, float("nan")):
        with pytest.raises(ConfigError, match=option):
            dataclasses.replace(PhysicalConfig(), **{option: value})


@pytest.mark.parametrize(
    ("option", "value"),
    [("initial_phase", "half"), ("sensor_seed", -1), ("noise_curve", "dark")],
)
def test_impossible_choices_fail_by_name(option, value):
    with pytest.raises(ConfigError, match=option):
        dataclasses.replace(PhysicalConfig(), **{option: value})
