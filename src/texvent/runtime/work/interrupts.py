"""Signals that end a process clean up alike, or stop a run early.

They are Ctrl-C, SIGTERM and SIGHUP; on Windows Ctrl-C, SIGTERM and Ctrl-Break.
"""

from __future__ import annotations

import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

ENDING: tuple[signal.Signals, ...] = tuple(
    getattr(signal, name)
    for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK")
    if hasattr(signal, name)
)
REPEAT_S = 2.0
"""Further signals within this time are ignored: they belong to the first, which is cleaning up."""
AGAIN_S = 0.05
"""After this time an interrupt that Python dropped is raised again."""

Handler = Callable[[int, FrameType | None], object]
clean_ups: list[Callable[[], None]] = []
"""Calls that a process makes before it ends early."""


def clean_up() -> None:
    """Make all calls of `clean_ups`."""
    for one in clean_ups:
        one()


class Interrupted(KeyboardInterrupt):
    """A signal asked the process to end."""

    def __init__(self, number: int) -> None:
        super().__init__(signal.Signals(number).name)
        self.number = number


class StopRequest:
    """Whether a run was asked to stop."""

    number: int | None = None
    """The signal that asked, if any."""


def has_threads() -> bool:
    """Whether the system gives this process one more thread."""
    try:
        threading.Thread(target=int).start()
    except RuntimeError:
        return False
    return True


@contextmanager
def raise_interrupted(*, until_exit: bool = False) -> Iterator[None]:
    """Raise `Interrupted` when a signal of `ENDING` arrives inside the block.

    A signal that the process was started to ignore, as `nohup` does with SIGHUP, stays ignored.
    Outside the main thread, which alone receives signals, this does nothing. Python drops an
    exception that meets it in a callback (of a weak reference, a destructor, C code) and runs on:
    an interrupt is then raised again.

    Args:
        until_exit: after an interrupt, ignore further signals: the process is about to end.
    """
    last_s, received = -REPEAT_S, Interrupted(signal.SIGINT)

    def interrupt(number: int, frame: FrameType | None) -> None:
        del frame
        nonlocal last_s, received
        if time.monotonic() - last_s >= REPEAT_S:
            last_s, received = time.monotonic(), Interrupted(number)
            raise received

    def forget() -> None:
        nonlocal last_s
        last_s = -REPEAT_S

    with _handling(interrupt, only_callable=False):
        try:
            with _raising_again(forget):
                yield
        except (KeyboardInterrupt, SystemError) as error:
            # A library may catch the interrupt and raise one of its own, as Ray does.
            is_other = isinstance(error, KeyboardInterrupt)
            interrupted = _interrupted_in(error) or (received if is_other else None)
            if interrupted is None:
                raise
            if until_exit:
                for number in ENDING:
                    signal.signal(number, signal.SIG_IGN)
            raise interrupted from None


@contextmanager
def _raising_again(forget: Callable[[], None]) -> Iterator[None]:
    """Raise in the block, or at its end, an interrupt that Python dropped; `forget` comes first."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before, waiting = sys.unraisablehook, list[tuple[threading.Timer, Interrupted]]()

    def hear(dropped: sys.UnraisableHookArgs) -> None:
        error = dropped.exc_value
        if not isinstance(error, Interrupted):
            before(dropped)
            return
        forget()
        timer = threading.Timer(AGAIN_S, _send_to_main_thread, (error.number,))
        timer.daemon = True
        waiting[:] = [(timer, error)]
        timer.start()

    sys.unraisablehook = hear
    try:
        yield
        if waiting and waiting[0][0].is_alive():
            raise waiting[0][1]
    finally:
        sys.unraisablehook = before
        for timer, _ in waiting:
            timer.cancel()


def _send_to_main_thread(number: int) -> None:
    if hasattr(signal, "pthread_kill"):
        signal.pthread_kill(threading.main_thread().ident or 0, number)
    else:
        signal.raise_signal(number)


def _interrupted_in(error: BaseException) -> Interrupted | None:
    """The interrupt behind an error: a compiled function that it meets ends in a SystemError."""
    cause: BaseException | None = error
    while cause is not None and not isinstance(cause, Interrupted):
        cause = cause.__cause__ or cause.__context__
    return cause


@contextmanager
def stop_on_interrupt() -> Iterator[StopRequest]:
    """Note the first signal of `ENDING` instead of raising it; a second one takes effect."""
    request = StopRequest()
    before = {number: signal.getsignal(number) for number in ENDING}

    def note(number: int, frame: FrameType | None) -> None:
        handler = before[signal.Signals(number)]
        if request.number is None:
            request.number = number
        elif callable(handler):
            handler(number, frame)

    with _handling(note, only_callable=True):
        yield request


@contextmanager
def delay_interrupts() -> Iterator[None]:
    """Let the block finish before Ctrl-C (or another handled signal) takes effect.

    HDF5 calls back into Python while it cleans up, where an exception is printed and dropped: a
    KeyboardInterrupt raised there would be lost, and the run would go on. Outside the main
    thread, where Python never raises it, this does nothing.
    """
    received: list[tuple[int, FrameType | None]] = []
    before = {number: signal.getsignal(number) for number in ENDING}
    try:
        with _handling(lambda *signalled: received.append(signalled), only_callable=True):
            yield
    finally:
        for number, frame in received[:1]:
            handler = before[signal.Signals(number)]
            if callable(handler):
                handler(number, frame)


@contextmanager
def _handling(handler: Handler, *, only_callable: bool) -> Iterator[None]:
    """Handle signals in the block, except those ignored; `only_callable`: and those by default."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    before = {number: signal.getsignal(number) for number in ENDING}
    handled = [
        number
        for number, old in before.items()
        if callable(old) or (old is signal.SIG_DFL and not only_callable)
    ]
    for number in handled:
        signal.signal(number, handler)
    try:
        yield
    finally:
        for number in handled:
            if signal.getsignal(number) is handler:
                signal.signal(number, before[number])
