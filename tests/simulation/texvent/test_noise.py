"""Eq. 6 and its ablations: how much noise, where, when, and that it disturbs nothing else."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references import noise_blocks

from texvent.events import SIGNAL, EventStream
from texvent.frames import Frame, frame_time_us
from texvent.simulation.packets import FrameInterval
from texvent.simulation.random.draws import frame_key
from texvent.simulation.texvent import noise as noise_kernel
from texvent.simulation.texvent.noise import (
    NoisePlaces,
    draw_noise,
    draw_voltage_noise,
    poisson_cumulative,
    voltage_noise_sd,
)
from texvent.simulation.texvent.simulator import TexventConfig, TexventSimulator

SECOND = 1_000_000


def resting(shape, times_us, level=20.0):
    """A scene that does not move; its first and last frame are source frames."""
    picture = np.full(shape, level, np.float32)
    return [Frame(picture, t, t in (times_us[0], times_us[-1])) for t in times_us]


def anywhere(pixels, span, mean, *, on_fraction=0.5) -> NoisePlaces:
    """Noise of `mean` events per pixel, in all pixels."""
    rate_hz = mean / span.duration_s
    config = TexventConfig(noise="random", noise_rate_hz=rate_hz, noise_on_fraction=on_fraction)
    return draw_noise(config, span, pixels, np.zeros(pixels).__getitem__)


def simulate(frames, *, seed=0, **options) -> EventStream:
    config = replace(TexventSimulator.presets["paper"], **options)
    simulator = TexventSimulator(config, seed=seed)
    return EventStream.concat([simulator.step(frame) for frame in frames])


@pytest.mark.parametrize(("kind", "fps"), [("random", 24), ("gaussian", 24), ("gaussian", 1000)])
def test_noise_rate_is_the_stated_one_at_any_frame_rate(kind, fps):
    """2 Hz · 1.5 over 32×32 pixels and 1 s: mean 3072."""
    times = [frame_time_us(k, fps) for k in range(fps + 1)]
    events = simulate(resting((32, 32), times), noise=kind, noise_rate_hz=2.0, noise_scale=1.5)
    assert abs(len(events) - 3072) < 4 * np.sqrt(3072)


@pytest.mark.parametrize("reset", ["current", "step"])
@pytest.mark.parametrize("cache", ["local", "global"])
def test_gaussian_noise_leaves_no_trace_in_the_reference(reset, cache):
    """If it did, a pixel would fire back after each noise event, and the rate would double."""
    times = [frame_time_us(k, 100) for k in range(101)]
    events = simulate(
        resting((32, 32), times), noise="gaussian", noise_rate_hz=3.0, reset=reset, cache=cache
    )
    assert abs(len(events) - 3072) < 4 * np.sqrt(3072)


def test_adaptive_noise_is_only_in_dark_resting_pixels():
    first = np.full((30, 30), 20.0)
    first[:, 20:] = 79.0
    first[10:20] = 80.0
    second = first.copy()
    second[:, :5] += 60.0
    options = {"noise_rate_hz": 100.0}
    frames = [Frame(first, 0), Frame(second, SECOND)]
    noisy = simulate(frames, **options)
    clean = simulate(frames, **options | {"noise": "none"})
    per_pixel = np.zeros((30, 30), int)
    np.add.at(per_pixel, (noisy.y, noisy.x), 1)
    assert np.all(per_pixel[10:20, 5:] == 0)
    assert np.all(per_pixel[:, :5] == 1)
    assert np.all(per_pixel[:10, 5:] > 40)
    assert len(clean) == 150
    assert as_set(clean) <= as_set(noisy)


def test_random_noise_ignores_intensity_and_firing():
    frames = [Frame(np.full((30, 30), 200.0), 0), Frame(np.full((30, 30), 10.0), SECOND)]
    events = simulate(frames, noise="random", noise_rate_hz=10.0)
    assert abs(len(events) - 900 - 9000) < 4 * np.sqrt(9000)


def as_set(events):
    return set(zip(events.x, events.y, events.t, events.p, strict=True))


@pytest.mark.parametrize("kind", ["adaptive", "random"])
def test_noise_never_touches_the_reference(kind):
    """Every event of the clean run is there in the noisy one."""
    pictures = np.random.default_rng(2).uniform(0, 120, (6, 12, 12))
    frames = [Frame(picture, 1000 * k, k % 3 == 0) for k, picture in enumerate(pictures)]
    options = {"cache": "global", "reset": "step"}
    clean = simulate(frames, noise="none", **options)
    noisy = simulate(frames, noise=kind, noise_rate_hz=200.0, **options)
    assert len(clean) < len(noisy)
    assert noisy[noisy.label == SIGNAL].equals(clean)


def test_gaussian_noise_is_labelled_where_only_the_noise_fired():
    first = np.full((40, 40), 50.0)
    second = first.copy()
    second[:20] = 90.0
    options = {"noise": "gaussian", "noise_rate_hz": 100.0}
    events = simulate([Frame(first, 0), Frame(second, 1000)], **options)
    noisy = events[events.label != SIGNAL]
    assert noisy.y.min() >= 20
    assert abs(len(noisy) - 80) < 4 * np.sqrt(80)
    assert len(events) - len(noisy) > 700


@pytest.mark.parametrize("mean", [1e-9, 0.004, 0.5, 3.0, 800.0])
def test_poisson_table_has_the_mean_and_variance_of_its_distribution(mean):
    cumulative = poisson_cumulative(mean)
    mass = np.diff(cumulative, prepend=0.0)
    k = np.arange(mass.size)
    assert cumulative[0] == pytest.approx(np.exp(-mean), rel=1e-12)
    assert cumulative[-1] == pytest.approx(1.0, abs=1e-12)
    assert (k * mass).sum() == pytest.approx(mean, rel=1e-9)
    assert ((k - mean) ** 2 * mass).sum() == pytest.approx(mean, rel=1e-6)


@pytest.mark.parametrize("mean", [0.01, 0.7, 3.0])
def test_noise_counts_are_poisson_numbers_of_every_pixel(mean):
    """Although they are drawn per block of pixels; the last block is a partial one."""
    pixels = 40_000
    span = FrameInterval(1000, 2000, frame_key(0, 0))
    noise = anywhere(pixels, span, mean)
    per_pixel = np.bincount(noise.pixel, minlength=pixels)
    assert len(per_pixel) == pixels
    mass = np.diff(poisson_cumulative(mean), prepend=0.0)
    expected = mass[mass * pixels > 5] * pixels
    counts = np.bincount(per_pixel, minlength=len(expected))[: len(expected)]
    freedom = len(expected)
    deviation = ((counts - expected) ** 2 / expected).sum()
    assert float(deviation) < freedom + 5 * np.sqrt(2 * freedom)
    assert noise.fraction.min() >= 0
    assert noise.fraction.max() < 1


def test_noise_is_independent_between_places_times_and_polarities():
    span = FrameInterval(0, SECOND, frame_key(7, 3))
    noise = anywhere(64 * 4096, span, 0.2)
    columns = [noise.pixel % 4096, noise.pixel // 4096, noise.fraction, noise.p]
    correlation = np.corrcoef(np.array(columns, np.float64))
    assert np.abs(correlation - np.eye(4)).max() < 5 / np.sqrt(len(noise.p))


def test_blocks_draw_the_same_noise_whatever_the_size_of_the_frame():
    """So bands of a frame can be simulated apart."""
    span = FrameInterval(0, 1000, frame_key(1, 1))
    small, large = (anywhere(pixels, span, 0.1, on_fraction=0.3) for pixels in (5000, 20_000))
    inside = [column[large.pixel < 5000] for column in large]
    assert len(small.pixel) > 300
    assert all(np.array_equal(one, two) for one, two in zip(small, inside, strict=True))


@pytest.mark.parametrize("mean", [0.0, 1e-5, 0.01, 0.3, 0.99])
def test_voltage_noise_reaches_the_threshold_with_the_stated_probability(mean):
    shape = (400, 400)
    noise = draw_voltage_noise(shape, frame_key(1, 2), threshold=0.2, mean=mean)
    fired = np.count_nonzero(np.abs(noise) >= 0.2)
    assert abs(fired - mean * noise.size) < 4 * np.sqrt(mean * noise.size) + 1
    assert noise.std() == pytest.approx(voltage_noise_sd(0.2, mean), rel=0.01)


@examples(60)
@given(
    st.integers(0, 2**63 - 1),
    st.sampled_from([1, 7, 4095, 4096, 4097, 20_000]),
    st.sampled_from([0.0, 1e-6, 5e-4, 0.02, 1.5]),
    st.floats(0, 1),
)
def test_compiled_noise_has_the_bits_of_the_definition(seed, pixels, mean, on_fraction):
    one, two = (
        module.place_noise(frame_key(seed, 5), mean, on_fraction, pixels)
        for module in (noise_blocks, noise_kernel)
    )
    assert [column.dtype for column in one] == [column.dtype for column in two]
    assert all(np.array_equal(a, b) for a, b in zip(one, two, strict=True))
    assert np.all(np.diff(one.pixel * 2 + one.p) >= 0)
    assert np.all((one.fraction >= 0) & (one.fraction < 1))
