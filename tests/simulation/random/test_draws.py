"""The counter-based random numbers: uniform, independent, and a function of their key alone."""

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.simulation.random.compiled_draws import draw_uniform, draw_word
from texvent.simulation.random.draws import draw_normals, draw_uniforms, draw_words, frame_key

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
