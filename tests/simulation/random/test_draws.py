"""Counter-based random numbers, uniform, independent and of their key alone; Poisson noise."""

import math

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.simulation.references import in_both_forms

from texvent.events import NOISE
from texvent.simulation.packets import FrameInterval
from texvent.simulation.random import poisson_noise
from texvent.simulation.random.compiled_draws import draw_uniform, draw_word
from texvent.simulation.random.draws import draw_normals, draw_uniforms, draw_words, frame_key
from texvent.simulation.random.poisson_noise import PoissonNoise, draw_arrivals

SEEDS = st.integers(0, 2**63 - 1)
COORDINATES = st.integers(0, 65_535)
ROWS, COLUMNS = np.mgrid[0:260, 0:346]


def uniform_image(seed: int = 0, frame: int = 0, draw: int = 0) -> np.ndarray:
    return draw_uniforms(frame_key(seed, frame), ROWS, COLUMNS, draw)


def chi_square(counts: np.ndarray) -> float:
    expected = counts.sum() / counts.size
    return float(((counts - expected) ** 2 / expected).sum())


def chi_square_limit(cells: int) -> float:
    """About the 1 - 10⁻⁶ quantile of chi-square (normal approximation, 5 sd)."""
    return (cells - 1) + 5 * np.sqrt(2 * (cells - 1))


def joint_counts(first: np.ndarray, second: np.ndarray, bins: int = 16) -> np.ndarray:
    return np.histogram2d(first.ravel(), second.ravel(), bins=bins, range=[[0, 1], [0, 1]])[0]


@pytest.mark.parametrize(
    "image",
    [
        pytest.param(uniform_image(), id="seed 0, frame 0"),
        pytest.param(uniform_image(seed=1), id="seed 1"),
        pytest.param(uniform_image(seed=2**63 - 1), id="largest seed"),
        pytest.param(uniform_image(frame=41_667), id="frame at 41667 µs"),
        pytest.param(uniform_image(frame=-5), id="negative time"),
        pytest.param(uniform_image(draw=2**32 - 1), id="last draw"),
    ],
)
def test_draws_are_uniform(image):
    counts = np.histogram(image, bins=256, range=(0, 1))[0]
    assert chi_square(counts) < chi_square_limit(256)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        pytest.param(uniform_image()[:, :-1], uniform_image()[:, 1:], id="columns"),
        pytest.param(uniform_image()[:-1], uniform_image()[1:], id="rows"),
        pytest.param(uniform_image(), uniform_image(frame=1), id="frames"),
        pytest.param(uniform_image(), uniform_image(frame=1000), id="frames 1 ms apart"),
        pytest.param(uniform_image(), uniform_image(seed=1), id="seeds"),
        pytest.param(uniform_image(), uniform_image(draw=1), id="draws"),
        pytest.param(uniform_image(seed=1), uniform_image(frame=1), id="seed against frame"),
        pytest.param(uniform_image()[:180, :180], uniform_image()[:180, :180].T, id="x against y"),
    ],
)
def test_neighbouring_keys_give_independent_draws(first, second):
    off_diagonal = first != second  # a transposed image meets itself on its diagonal
    counts = joint_counts(first[off_diagonal], second[off_diagonal])
    assert chi_square(counts) < chi_square_limit(counts.size)


def test_every_bit_is_balanced():
    words = draw_words(frame_key(0, 0), ROWS, COLUMNS, 0).ravel()
    ones = [int(np.count_nonzero((words >> np.uint64(bit)) & np.uint64(1))) for bit in range(64)]
    deviation = np.abs(np.array(ones) - words.size / 2) / np.sqrt(words.size / 4)
    assert deviation.max() < 5


def test_a_draw_does_not_depend_on_what_else_is_drawn():
    whole = draw_words(frame_key(7, 3), ROWS, COLUMNS, 2)
    assert draw_words(frame_key(7, 3), 100, 200, 2) == whole[100, 200]
    assert np.array_equal(draw_words(frame_key(7, 3), ROWS[50:], COLUMNS[50:], 2), whole[50:])


def test_normals_have_the_normal_moments_and_tails():
    sample = draw_normals(frame_key(3, 5), ROWS, COLUMNS, 0)
    error = 1 / np.sqrt(sample.size)
    assert abs(sample.mean()) < 5 * error
    assert abs(sample.var() - 1) < 5 * np.sqrt(2) * error
    assert np.mean(np.abs(sample) > 2) == pytest.approx(0.0455, abs=5 * np.sqrt(0.0455) * error)


@numba.njit
def _numba_draw(key, y, x, draw):
    return draw_word(key, y, x, draw), draw_uniform(key, y, x, draw)


@examples(200)
@given(SEEDS, st.integers(-(2**62), 2**62), COORDINATES, COORDINATES, st.integers(0, 2**32 - 1))
def test_numpy_and_numba_draw_equal_bits(seed, frame, y, x, draw):
    key = frame_key(seed, frame)
    word, uniform = _numba_draw(key, y, x, draw)
    assert word == int(draw_words(key, y, x, draw))
    assert uniform == float(draw_uniforms(key, y, x, draw))


def interval(seconds: float, frame: int = 1) -> FrameInterval:
    return FrameInterval(1000, 1000 + round(seconds * 1e6), frame_key(0, frame))


def counts(rate_hz, seconds, **options):
    events = PoissonNoise(rate_hz).draw(interval(seconds), **options)
    found = np.zeros(rate_hz.size, int)
    np.add.at(found, events.pixel, 1)
    return found.reshape(rate_hz.shape)


@pytest.mark.parametrize("mean", [0.05, 1.0, 30.0])
def test_counts_are_poisson(mean):
    found = counts(np.full((50, 60), mean), 1.0)
    assert found.mean() == pytest.approx(mean, abs=4 * math.sqrt(mean / 3000))
    # The variance of a sample variance of 3000 Poisson numbers.
    spread = math.sqrt((mean + 2 * mean * mean) / 3000)
    assert found.var() == pytest.approx(mean, abs=4 * spread)


def test_each_pixel_has_its_own_rate():
    rate_hz = np.repeat([[0.0, 2.0, 20.0]], 2000, axis=0)
    found = counts(rate_hz, 0.5).mean(axis=0)
    assert found[0] == 0
    assert found[1:] == pytest.approx([1.0, 10.0], abs=0.3)


def test_times_are_uniform_and_polarity_has_its_share():
    on_fraction = np.repeat([[0.1, 0.9]], 3000, axis=0)
    rates = PoissonNoise(np.full((3000, 2), 3.0))
    events = rates.draw(interval(1.0), on_fraction=on_fraction)
    assert events.t.min() >= 1000
    assert events.t.max() < 1_001_000
    histogram = np.histogram(events.t, bins=10, range=(1000, 1_001_000))[0]
    assert np.abs(histogram - 1800).max() < 4 * math.sqrt(1800)
    for column, share in ((0, 0.1), (1, 0.9)):
        chosen = events.p[events.pixel % 2 == column]
        assert chosen.mean() == pytest.approx(share, abs=4 * 0.3 / math.sqrt(len(chosen)))
    assert (events.label == NOISE).all()


def test_a_share_of_the_rate_keeps_that_share_of_the_events():
    rates = PoissonNoise(np.full((2000, 3), 4.0))
    share = np.array([0.0, 0.25, 1.0])
    events = rates.draw(interval(1.0), rate_fraction=lambda pixel: share[pixel % 3])
    found = np.bincount(events.pixel % 3, minlength=3)
    assert found[0] == 0
    assert found[1:] == pytest.approx([2000, 8000], abs=4 * math.sqrt(8000))


def test_every_arrival_has_draws_of_its_own():
    arrivals = draw_arrivals(np.cumsum(np.full((9, 40), 6.0), axis=1), 1.0, frame_key(0, 1), 0)
    draws = np.stack(arrivals[1:])
    assert len(np.unique(draws)) == draws.size > 6000
    columns = np.stack([*draws, draws[1].take(range(1, draws.shape[1] + 1), mode="wrap")])
    assert np.abs(np.corrcoef(columns) - np.eye(4)).max() < 5 / math.sqrt(draws.shape[1])


def test_events_come_by_pixel_and_then_in_time():
    events = PoissonNoise(np.full((7, 9), 6.0)).draw(interval(1.0))
    order = np.lexsort((events.t, events.pixel))
    assert (order == np.arange(len(order))).all()


def test_two_streams_of_one_sensor_are_independent():
    rate_hz = np.full((50, 60), 2.0)
    first, second = (PoissonNoise(rate_hz, stream=s).draw(interval(1.0)) for s in (0, 1))
    maps = [np.bincount(events.pixel, minlength=3000) for events in (first, second)]
    assert abs(np.corrcoef(*maps)[0, 1]) < 4 / math.sqrt(3000)


@examples(40)
@given(
    st.integers(0, 2**63 - 1),
    st.tuples(st.integers(1, 9), st.integers(1, 9)),
    st.sampled_from([0.0, 1e-3, 2.0, 500.0]),
    st.sampled_from([1e-6, 0.01, 1.0]),
)
def test_backends_find_the_same_events(seed, shape, highest_hz, seconds):
    rate_hz = np.random.default_rng(seed).uniform(0, 1, shape).round(1) * highest_hz
    rates = PoissonNoise(rate_hz)
    first, second = in_both_forms(lambda: rates.draw(interval(seconds, seed)))
    assert all(np.array_equal(a, b) for a, b in zip(first, second, strict=True))
    assert rate_hz.reshape(-1)[first.pixel].all()
    assert ((first.t >= 1000) & (first.t < 1000 + round(seconds * 1e6))).all()


def test_more_arrivals_than_there_is_room_for_are_all_kept(monkeypatch):
    monkeypatch.setattr(poisson_noise, "SPREAD", -20.0)
    rates = PoissonNoise(np.full((30, 40), 20.0))
    plain, compiled = in_both_forms(lambda: rates.draw(interval(1.0)))
    assert len(plain.t) > 23_000
    assert all(np.array_equal(*columns) for columns in zip(plain, compiled, strict=True))
