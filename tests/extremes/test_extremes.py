"""No extreme number ends in a traceback, a hang, a crash or in more memory than allowed."""

import os
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import texvent
from texvent.errors import ConfigError, InputError, TexventError
from texvent.run import prepare
from texvent.run.prepare import estimate_bytes
from texvent.runtime.memory import usable_bytes
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulation import packets

SIMULATORS = ("texvent", "esim", "v2e", "voltmeter", "senpi", "physical")
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
    for width, height in ((1, 1), (65535, 1), (1, 65535), (65536, 1), (10_000, 10_000)):
        shape = (2, height, width)
        yield f"frames of {width}x{height}", (np.broadcast_to(np.uint8(9), shape), rate)
    for sensor in ("1x1", "1x65535", "65535x1", "65535x65535", "60000x60000", "0x5", "9" * 400):
        yield f"sensor {sensor[:20]}", (small, {**rate, "sensor": sensor})
    yield "one frame", (small[:1], rate)
    yield "no frame", (small[:0], rate)


@pytest.mark.parametrize("simulator", SIMULATORS)
@pytest.mark.parametrize("inputs", [intensities, times, sizes])
@pytest.mark.filterwarnings("ignore")
def test_extreme_inputs_end_in_events_or_in_one_short_line(simulator, inputs, monkeypatch):
    for module in (packets, prepare):
        monkeypatch.setattr(module, "usable_bytes", lambda: 5 * 10**8)
    fired = 0
    for name, (source, given) in inputs():
        try:
            events = texvent.simulate(source, simulator=simulator, interpolate="none", **given)
        except TexventError as error:
            text = str(error)
            assert "\n" not in text, name
            assert len(text) < 300, name
            continue
        assert events.size.width * events.size.height < 10**8, name  # memory holds no more
        assert not len(events) or events.x.max() < events.size.width, name
        assert not len(events) or events.y.max() < events.size.height, name
        assert not (np.diff(events.t) < 0).any(), name
        fired += len(events)
    assert fired or inputs is sizes


def test_the_range_of_intensities_is_said_and_its_ends_are_allowed():
    frames = np.full((3, 4, 4), 100.0)
    frames[1, 2, 2] = 1e9
    assert len(texvent.simulate(frames, fps=10, simulator="esim", interpolate="none"))
    frames[1, 2, 2] = 1.001e9
    with pytest.raises(InputError, match=r"above 1e\+09 .first: 1.001e\+09.*0..1e\+09"):
        texvent.simulate(frames, fps=10, simulator="esim", interpolate="none")


@pytest.mark.filterwarnings("ignore:t_us. frames are 3,000,000,000 ")
def test_noise_of_a_gap_that_memory_cannot_hold_is_refused_before_it_is_drawn(monkeypatch):
    monkeypatch.setattr(packets, "usable_bytes", lambda: 10**9)
    frames = np.full((2, 64, 64), 10, np.uint8)
    pause = {"t_us": [0, 3000 * 10**6], "interpolate": "none"}
    with pytest.raises(InputError, match=r"about 1.1e\+09 events .* memory holds"):
        texvent.simulate(frames, noise_rate_hz=90, noise_scale=1.0, **pause)
    frames[1] = 200
    per_pixel = int(np.log((20 + 200) / (20 + 10)) / 0.2)
    assert len(texvent.simulate(frames, noise="none", **pause)) == 64 * 64 * per_pixel


def test_a_large_sensor_is_refused_before_a_frame_is_read():
    frames = iter([np.zeros((4, 4), np.uint8)] * 2)
    with pytest.raises(InputError, match=r"65535x65535 pixels need about .* GB are usable"):
        texvent.simulate(frames, fps=10, sensor="65535x65535")
    assert len(list(frames)) == 2


def test_a_share_of_the_machines_memory_is_usable():
    everything = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    assert 10**8 < usable_bytes() <= 0.8 * everything


MEASURE = """
import sys, numpy as np, texvent
from texvent.runtime.memory import release_freed_memory
def clip(side):
    y, x = np.mgrid[:side, :side]
    return np.stack([(127 + 100 * np.sin((x + 3 * k) / 9) * np.cos(y / 13)).astype(np.uint8)
                     for k in range(4)])
def peak():
    status = open("/proc/self/status").read()
    return int(status.split("VmHWM:")[1].split()[0]) * 1024
def run(frames):
    parts = {"simulator": sys.argv[1], "interpolate": sys.argv[2]}
    for _ in texvent.simulate(frames, fps=100, as_packets=True, progress=False, **parts):
        pass
run(clip(64))
frames = clip(1600)
release_freed_memory()
open("/proc/self/clear_refs", "w").write("5")  # the peak begins anew
before = peak()
run(frames)
print(peak() - before)
"""


@pytest.mark.nightly
@pytest.mark.skipif(not Path("/proc/self/status").exists(), reason="needs Linux's /proc")
@pytest.mark.parametrize(
    ("simulator", "interpolator"),
    [*((simulator, "none") for simulator in SIMULATORS), ("texvent", "flow")],
)
def test_the_estimate_of_memory_is_within_a_factor_of_three(simulator, interpolator):
    command = [sys.executable, "-W", "ignore", "-c", MEASURE, simulator, interpolator]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    options = {"simulator": simulator, "interpolate": interpolator}
    estimate = estimate_bytes(resolve("simulate", options), SensorSize(1600, 1600))
    assert estimate / 3 < int(done.stdout) < 3 * estimate


@pytest.mark.parametrize(
    "text",
    [
        "seed = " + "9" * 5000,
        "simulator = ['esim']",
        "preset = {a = 1}",
        "interpolate = ['a', 'b']",
        "fps = '1e999999999'",
        "x = " + "[" * 5000 + "]" * 5000,
        "sensor = '" + "9" * 5000 + "x1'",
        "start = inf",
        "stop = nan",
        "contrast_threshold = 0",
        "'" + "x" * 3000 + "' = 1",
    ],
    ids=lambda text: text[:15],
)
def test_a_config_file_with_an_extreme_value_is_refused_in_one_short_line(text, tmp_path):
    path = tmp_path / "run.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ConfigError) as refused:
        resolve("simulate", {}, config=path)
    message = str(refused.value).replace(str(path), "run.toml")
    assert "\n" not in message
    assert len(message) < 300
