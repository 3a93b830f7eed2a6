"""Backends: equal bits, and the right one for each name."""

import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from texvent.errors import ConfigError, MissingDependencyError
from texvent.simulate.draws import frame_key
from texvent.simulate.kernels import cpu, reference, select
from texvent.simulate.kernels.select import load_kernels


@settings(max_examples=100, deadline=None)
@given(
    st.integers(0, 2**32),
    st.integers(1, 9),
    st.integers(1, 9),
    st.sampled_from([0.1, 0.25, 1.0]),
)
def test_crossings_are_equal_on_both_backends(seed, height, width, threshold):
    """Levels are multiples of 0.25, so that many changes lie exactly on the threshold."""
    rng = np.random.default_rng(seed)
    brightness, level = rng.integers(0, 8, (2, height, width)) / 4
    one, two = (
        backend.find_crossings(brightness, level, threshold) for backend in (reference, cpu)
    )
    assert np.array_equal(one.pixel, two.pixel)
    assert one.change.tobytes() == two.change.tobytes()
    assert one.pixel.dtype == two.pixel.dtype == np.int64


@settings(max_examples=100, deadline=None)
@given(
    st.integers(0, 2**63 - 1),
    st.integers(1, 9),
    st.integers(1, 9),
    st.floats(0, 1),
)
def test_noisy_pixels_are_equal_on_both_backends(seed, height, width, quiet):
    mask = np.random.default_rng(seed).random((height, width)) < 0.7
    key = frame_key(seed, 1)
    one, two = (backend.find_noisy_pixels(mask, key, 0, quiet) for backend in (reference, cpu))
    assert np.array_equal(one, two)
    assert one.dtype == two.dtype == np.int64


def test_crossings_of_a_two_by_two_case(backend):
    crossings = load_kernels(backend).find_crossings(
        np.array([[0.0, 1.0], [-1.0, 0.25]]), np.array([[0.0, 0.5], [0.0, 0.5]]), 0.25
    )
    assert crossings.pixel.tolist() == [1, 2, 3]
    assert crossings.change.tolist() == [0.5, -1.0, -0.25]


def test_noise_certain_and_impossible(backend):
    mask = np.array([[True, False], [False, True]])
    kernels = load_kernels(backend)
    assert kernels.find_noisy_pixels(mask, frame_key(0, 0), 0, 0.0).tolist() == [0, 3]
    assert kernels.find_noisy_pixels(mask, frame_key(0, 0), 0, 1.0).tolist() == []


@pytest.fixture
def without_numba(monkeypatch):
    for cached in (load_kernels, select._load):
        cached.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    yield
    for cached in (load_kernels, select._load):
        cached.cache_clear()


def test_auto_is_cpu():
    assert load_kernels("auto") is cpu


@pytest.mark.usefixtures("without_numba")
def test_auto_falls_back_to_the_reference_without_numba():
    assert load_kernels("auto") is reference


@pytest.mark.usefixtures("without_numba")
def test_cpu_without_numba_fails_with_the_command_that_installs_it():
    with pytest.raises(MissingDependencyError, match="pip install"):
        load_kernels("cpu")


def test_unknown_backend_fails():
    with pytest.raises(ConfigError, match=r"unknown backend 'cqu'.*did you mean 'cpu'"):
        load_kernels("cqu")
