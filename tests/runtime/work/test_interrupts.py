import contextlib
import signal
import sys
import threading
import weakref

import pytest

from texvent.runtime.work.interrupts import (
    ENDING,
    REPEAT_S,
    Interrupted,
    delay_interrupts,
    raise_interrupted,
    stop_on_interrupt,
)


def test_ctrl_c_takes_effect_after_the_block():
    done: list[str] = []

    def work() -> None:
        with delay_interrupts():
            signal.raise_signal(signal.SIGINT)
            done.append("finished")

    with pytest.raises(KeyboardInterrupt):
        work()
    assert done == ["finished"]
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_an_interrupt_inside_a_compiled_function_is_one():
    # As CPython says it when C code returns a result with an exception set.
    def work() -> None:
        try:
            signal.raise_signal(signal.SIGTERM)
        except BaseException as error:
            raise SystemError("CPUDispatcher returned a result with an exception set") from error

    with pytest.raises(Interrupted) as caught, raise_interrupted():
        work()
    assert caught.value.number == signal.SIGTERM
    with pytest.raises(SystemError, match="another"), raise_interrupted():
        raise SystemError("another")


@pytest.mark.parametrize("runs_on", [True, False])
def test_an_interrupt_that_meets_a_callback_is_not_lost(runs_on):
    class Referent:
        pass

    def work() -> None:
        referent = Referent()
        callback = weakref.ref(referent, lambda _: signal.raise_signal(signal.SIGTERM))
        del referent
        assert callback() is None
        if runs_on:
            threading.Event().wait(60)
            pytest.fail("the interrupt was dropped")

    before = sys.unraisablehook
    with pytest.raises(Interrupted) as caught, raise_interrupted():
        work()
    assert caught.value.number == signal.SIGTERM
    assert sys.unraisablehook is before


@pytest.mark.parametrize("number", ENDING)
def test_every_ending_signal_is_raised_with_its_number(number):
    before = signal.getsignal(number)
    with pytest.raises(Interrupted) as caught, raise_interrupted():
        signal.raise_signal(number)
    assert caught.value.number == number
    assert signal.getsignal(number) is before


def test_an_interrupt_that_a_library_replaces_keeps_its_number():
    def work() -> None:
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGTERM)
        raise KeyboardInterrupt

    with pytest.raises(Interrupted) as caught, raise_interrupted():
        work()
    assert caught.value.number == signal.SIGTERM


def test_signals_that_follow_at_once_do_not_disturb_the_clean_up():
    cleaned: list[str] = []

    def work() -> None:
        with raise_interrupted():
            try:
                signal.raise_signal(signal.SIGINT)
            finally:
                signal.raise_signal(signal.SIGINT)
                signal.raise_signal(signal.SIGTERM)
                cleaned.append("all")

    with pytest.raises(Interrupted):
        work()
    assert cleaned == ["all"]


def test_a_signal_long_after_the_first_ends_a_clean_up_that_hangs(monkeypatch):
    now = [100.0]
    monkeypatch.setattr("texvent.runtime.work.interrupts.time.monotonic", lambda: now[0])
    raised: list[int] = []
    with raise_interrupted():
        for _ in range(3):
            try:
                signal.raise_signal(signal.SIGINT)
            except Interrupted as error:
                raised.append(error.number)
            now[0] += REPEAT_S * 0.6
    assert raised == [signal.SIGINT, signal.SIGINT]


def test_an_ignored_signal_stays_ignored():
    before = signal.signal(signal.SIGHUP, signal.SIG_IGN)
    try:
        with raise_interrupted(), stop_on_interrupt() as request:
            signal.raise_signal(signal.SIGHUP)
            assert request.number is None
    finally:
        signal.signal(signal.SIGHUP, before)


def test_a_run_is_asked_to_stop_once_and_interrupted_the_second_time():
    seen: list[int | None] = []

    def work() -> None:
        with raise_interrupted(), stop_on_interrupt() as request:
            signal.raise_signal(signal.SIGTERM)
            seen.append(request.number)
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(Interrupted):
        work()
    assert seen == [signal.SIGTERM]


def test_a_delayed_signal_can_ask_a_run_to_stop():
    with raise_interrupted(), stop_on_interrupt() as request:
        with delay_interrupts():
            signal.raise_signal(signal.SIGINT)
            assert request.number is None
        assert request.number == signal.SIGINT
