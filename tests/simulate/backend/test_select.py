"""The right backend for each name."""

import sys

import pytest

from texvent.errors import ConfigError, MissingDependencyError
from texvent.simulate.backend import select
from texvent.simulate.backend.select import load_kernel
from texvent.simulate.crossing import ramp, ramp_cpu, ramp_reference
from texvent.simulate.packets import sorting, sorting_reference


@pytest.fixture
def without_numba(monkeypatch):
    select._load.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    yield
    select._load.cache_clear()


def test_auto_is_cpu():
    assert load_kernel(ramp.__name__, "cross_thresholds", "auto") is ramp_cpu.cross_thresholds


@pytest.mark.usefixtures("without_numba")
def test_auto_falls_back_to_the_reference_without_numba():
    assert load_kernel(ramp.__name__, "cross_thresholds", "auto") is ramp_reference.cross_thresholds


def test_the_reference_serves_as_numpy_where_a_model_has_no_other():
    assert load_kernel(sorting.__name__, "sort_events", "numpy") is sorting_reference.sort_events


@pytest.mark.usefixtures("without_numba")
def test_cpu_without_numba_fails_with_the_command_that_installs_it():
    with pytest.raises(MissingDependencyError, match="pip install"):
        load_kernel(ramp.__name__, "cross_thresholds", "cpu")


def test_unknown_backend_fails():
    with pytest.raises(ConfigError, match=r"unknown backend 'cqu'.*did you mean 'cpu'"):
        load_kernel(ramp.__name__, "cross_thresholds", "cqu")
