"""Kernels are compiled in the background while a slower form works."""

import logging
import sys
import threading
import types

import pytest

from texvent.runtime import background_jit
from texvent.simulate.packets import sorting_cpu, sorting_reference
from texvent.simulate.packets.sorting import SORT_EVENTS


@pytest.fixture(autouse=True)
def _fresh():
    background_jit._prepare.cache_clear()
    SORT_EVENTS._ready.clear()
    yield
    background_jit._prepare.cache_clear()
    SORT_EVENTS._ready.clear()


@pytest.fixture
def slow_module(monkeypatch):
    """A kernel that is compiled once its event is set."""
    module = types.ModuleType("slow_kernel")
    module.go_on, module.calls = threading.Event(), []

    def warm_up(*variant):
        module.calls.append(variant)
        assert module.go_on.wait(10)

    module.warm_up = warm_up
    monkeypatch.setitem(sys.modules, "slow_kernel", module)
    return module


def test_a_kernel_is_ready_when_it_was_warmed_up_and_not_before(slow_module):
    assert not background_jit.is_ready("slow_kernel", "uint8")
    assert not background_jit.is_ready("slow_kernel", "uint8")
    slow_module.go_on.set()
    background_jit.wait_until_ready("slow_kernel", "uint8")
    assert background_jit.is_ready("slow_kernel", "uint8")
    assert slow_module.calls == [("uint8",)]


def test_waiting_tells_whether_a_kernel_is_still_being_compiled(slow_module):
    background_jit.is_ready("slow_kernel")
    assert not background_jit.wait_until_idle(0.01)
    slow_module.go_on.set()
    assert background_jit.wait_until_idle()
    background_jit._compiler().shutdown()
    background_jit._compiler.cache_clear()
    assert background_jit.wait_until_idle(0.0)  # and starts no thread to find out
    assert background_jit._compiler.cache_info().currsize == 0


def test_a_kernel_that_cannot_be_compiled_is_never_ready_and_says_why_once(monkeypatch, caplog):
    module = types.ModuleType("broken_kernel")

    def warm_up():
        raise RuntimeError("no folder to keep compiled code in")

    module.warm_up = warm_up
    monkeypatch.setitem(sys.modules, "broken_kernel", module)
    with caplog.at_level(logging.WARNING):
        background_jit.wait_until_ready("broken_kernel")
        assert not background_jit.is_ready("broken_kernel")
        assert not background_jit.is_ready("broken_kernel")
    assert [record.message for record in caplog.records] == [
        "kernels stay uncompiled, events are the same: no folder to keep compiled code in"
    ]


def test_without_numba_no_kernel_is_ready_and_there_is_no_warning(monkeypatch, caplog):
    monkeypatch.setitem(sys.modules, "numba", None)
    with caplog.at_level(logging.WARNING):
        background_jit.wait_until_ready("texvent.simulate.packets.sorting_cpu")
    assert not background_jit.is_ready("texvent.simulate.packets.sorting_cpu")
    assert not caplog.records
    assert SORT_EVENTS.load("auto") is sorting_reference.sort_events


def test_auto_changes_to_the_compiled_kernel_when_it_is_ready():
    background_jit.wait_until_ready("texvent.simulate.packets.sorting_cpu")
    assert SORT_EVENTS.load("auto") is sorting_cpu.sort_events
    assert SORT_EVENTS.load("numpy") is sorting_reference.sort_events
