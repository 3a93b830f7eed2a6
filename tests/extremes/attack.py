"""Runs one simulator on extreme inputs, in a process with limits of time and memory.

    python -m tests.extremes.attack SIMULATOR INTERPOLATOR,... GROUP,...

Prints a JSON line before and after every input: if the second is missing, the process died of it.
"""

from __future__ import annotations

import contextlib
import json
import resource
import signal
import sys
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

import texvent
from texvent.errors import TexventError

MEMORY = "500MB"
"""That runs are allowed; more than a few GB of addresses are a blow-up."""
ADDRESS_BYTES = 6 << 30
SECONDS = 20
LONGEST_ERROR = 300
DAY_US = 86_400 * 10**6
DIGITS = 10**5000
"""Longer than Python converts to text."""

Run = tuple[Any, dict[str, Any]]


def frames(seed: int, *values: float, dtype: str = "float64") -> np.ndarray:
    """Three frames of 8 x 6 pixels: levels of 0..255, and extreme ones at a few pixels."""
    rng = np.random.default_rng(seed)
    pixels = rng.integers(0, 256, (3, 6, 8)).astype(dtype)
    for number, value in enumerate(values):
        pixels[1 + number % 2, rng.integers(6), rng.integers(8)] = value
    return pixels


def intensities() -> Iterator[tuple[str, Run]]:
    """Extreme intensities at some pixels and everywhere."""
    double, single = np.finfo(np.float64), np.finfo(np.float32)
    values = {
        "1e300": 1e300,
        "largest double": double.max,
        "largest float32": float(single.max),
        "1e20": 1e20,
        "1e9": 1e9,
        "denormal": 5e-324,
        "float32 denormal": 1e-45,
        "negative": -1e-300,
        "minus zero": -0.0,
        "NaN": np.nan,
        "infinity": np.inf,
    }
    rate = {"fps": 100}
    for seed, (name, value) in enumerate(values.items()):
        yield f"{name} at a pixel", (frames(seed, value), rate)
        whole = np.full((3, 6, 8), 100.0)
        whole[1] = value
        yield f"{name} everywhere", (whole, rate)
        with np.errstate(over="ignore"):
            yield f"{name} in float32", (frames(seed, value, dtype="float32"), rate)
    for white in (5e-324, 1e-300, 1e300, np.nan, np.inf):
        yield f"white level {white}", (frames(7), {**rate, "white_level": white})


def times() -> Iterator[tuple[str, Run]]:
    """Extreme gaps and frame rates."""
    grey = frames(1, dtype="uint8")
    still = np.full((3, 6, 8), 3, np.uint8)
    for name, gap_us in {
        "1 µs": 1,
        "1 hour": 3600 * 10**6,
        "30 days": 30 * DAY_US,
        "10 years": 3652 * DAY_US,
        "200 years": 73_000 * DAY_US,
        "2^62": 2**62,
    }.items():
        listed = {"t_us": [0, gap_us, gap_us + 10]}
        yield f"a gap of {name}", (grey, listed)
        yield f"nothing moves for {name}", (still, listed)
    yield "times up to 2^63", (grey, {"t_us": [-(2**63), 0, 2**63 - 1]})
    yield "times up to 2^64", (grey, {"t_us": np.array([0, 2**63, 2**64 - 1], np.uint64)})
    yield "times beyond 2^64", (grey, {"t_us": [0, 2**64, 2**70]})
    for fps in (1e-15, 1e-9, 1e-4, 1e6, 1e7, 1e300, "1/" + "9" * 60, DIGITS, "9" * 5000):
        yield f"fps {str(fps)[:20] if fps is not DIGITS else '10^5000'}", (grey, {"fps": fps})


def sizes() -> Iterator[tuple[str, Run]]:
    """Extreme sizes; the largest are views of one pixel."""
    rate = {"fps": 100}
    small = frames(2, dtype="uint8")
    for width, height in ((1, 1), (65535, 1), (1, 65535), (65536, 1), (60_000, 60_000)):
        shape = (2, height, width)
        yield f"frames of {width}x{height}", (np.broadcast_to(np.uint8(9), shape), rate)
    for sensor in ("1x1", "1x65535", "65535x1", "65535x65535", "60000x60000", "0x5", "9" * 400):
        yield f"sensor {sensor[:20]}", (small, {**rate, "sensor": sensor})
    yield "one frame", (small[:1], rate)
    yield "no frame", (small[:0], rate)


def options(simulator: str) -> Iterator[tuple[str, Run]]:
    """Extreme numbers, and lists, in every option of the run and of the simulator."""
    grey = frames(3, dtype="uint8")
    numbers = (0, -1, 5e-324, 1e300, 2**64, np.nan, np.inf, DIGITS, -DIGITS, "9" * 5000)
    odd = ([1, 2], {"a": 1}, [["x" * 3000]], "x" * 3000, "a\nb", b"\0", object)
    for name in option_names(simulator):
        for value in (*numbers, *odd):
            label = type(value).__name__ if value in odd else short(value)
            yield f"{name} = {label}", (grey, {"fps": 100, name: value})


def option_names(simulator: str) -> list[str]:
    """All options of a simulation but those that decide what code runs."""
    from texvent.settings.resolution import default_settings

    settings = default_settings("simulate", simulator=simulator)
    groups = (settings.run, settings.source, settings.interpolate, settings.simulate)
    return [name for group in groups for name in vars(group)]


def short(value: Any) -> str:
    """A number that may have thousands of digits."""
    return f"{value:g}" if isinstance(value, float) else f"{type(value).__name__} {value != 0}"


@contextlib.contextmanager
def time_limit(seconds: int) -> Iterator[None]:
    """Raise in Python code, end the process in compiled code that does not return."""

    def stop(*_: Any) -> None:
        raise TimeoutError(f"took longer than {seconds} s")

    # Of processor time: other work on the machine does not count.
    signal.signal(signal.SIGPROF, stop)
    signal.setitimer(signal.ITIMER_PROF, seconds)
    resource.setrlimit(
        resource.RLIMIT_CPU, (int(time.process_time()) + 3 * seconds, resource.RLIM_INFINITY)
    )
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0)


def verdict(run: Callable[[], Any]) -> str:
    """What is wrong with the way a run ended; empty if it ended well."""
    try:
        with time_limit(SECONDS):
            events = run()
    except TexventError as error:
        text = str(error)
        if "\n" in text or len(text) >= LONGEST_ERROR:
            return f"error of {len(text)} characters: {text[:200]!r}"
        return ""
    except BaseException as error:  # noqa: BLE001  (what must not happen is counted)
        return f"{type(error).__name__}: {str(error)[:200]}"
    width, height = events.size.width, events.size.height
    if len(events) and not (events.x.max() < width and events.y.max() < height):
        return "events outside the sensor"
    if len(events) > 1 and (np.diff(events.t) < 0).any():
        return "events out of order"
    return ""


def attack(simulator: str, interpolators: list[str], groups: list[str]) -> None:
    """Run all inputs; one JSON line each."""
    makers: dict[str, Any] = {
        "intensities": intensities,
        "times": times,
        "sizes": sizes,
        "options": lambda: options(simulator),
    }
    for interpolator in interpolators:
        for dtype in ("uint8", "float32"):
            # Kernels are compiled without a limit of time.
            clip = frames(0, dtype=dtype)
            texvent.simulate(clip, fps=100, simulator=simulator, interpolate=interpolator)
        for group in groups:
            for name, (source, given) in makers[group]():
                chosen = {
                    "simulator": simulator,
                    "interpolate": interpolator,
                    "memory": MEMORY,
                    **given,
                }
                what = f"{simulator}, {interpolator}: {name}"
                say({"begin": what})
                start = time.perf_counter()

                def run(source: Any = source, chosen: dict[str, Any] = chosen) -> Any:
                    return texvent.simulate(source, progress=False, **chosen)

                wrong = verdict(run)
                took = round(time.perf_counter() - start, 2)
                say({"end": what, "wrong": wrong, "s": took})


def say(facts: dict[str, Any]) -> None:
    """A JSON line at once: the process may die of what follows."""
    sys.stdout.write(json.dumps(facts) + "\n")
    sys.stdout.flush()


if __name__ == "__main__":
    resource.setrlimit(resource.RLIMIT_AS, (ADDRESS_BYTES, ADDRESS_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    simulator, interpolators, groups = (argument.split(",") for argument in sys.argv[1:4])
    attack(simulator[0], interpolators, groups)
