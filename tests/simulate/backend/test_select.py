"""The right backend for each name."""

import sys

import pytest
from tests.simulate.references import sorting as sorting_reference
from tests.simulate.references import v2e as reference
from texvent.simulate.backend import select

from texvent.errors import MissingDependencyError
from texvent.simulate.esim import pixels as crossings_cpu
from texvent.simulate.esim.pixels import CROSS_THRESHOLDS
from texvent.simulate.packets import SORT_EVENTS
from texvent.simulate.v2e.low_pass import APPLY_LOW_PASS


@pytest.fixture
def without_numba(monkeypatch):
    select._load.cache_clear()
    monkeypatch.setitem(sys.modules, "numba", None)
    yield
    select._load.cache_clear()


def test_auto_is_the_compiled_kernel():
    assert CROSS_THRESHOLDS.load() is crossings_cpu.cross_thresholds


def test_the_reference_serves_as_numpy_where_a_model_has_no_other():
    assert SORT_EVENTS.load("numpy") is sorting_reference.sort_events


@pytest.mark.parametrize("backend", ["reference", "numpy"])
def test_a_module_named_reference_defines_the_kernels_of_its_folder(backend):
    assert APPLY_LOW_PASS.load(backend) is reference.apply_low_pass


@pytest.mark.usefixtures("without_numba")
def test_cpu_without_numba_fails_with_the_command_that_installs_it():
    with pytest.raises(MissingDependencyError, match="pip install"):
        CROSS_THRESHOLDS.load("cpu")
