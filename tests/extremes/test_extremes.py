"""No extreme number ends in a traceback, a hang, a crash or in more memory than allowed."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent.errors import ConfigError, InputError, shown
from texvent.run.prepare import estimate_bytes
from texvent.runtime.memory import usable_bytes
from texvent.sensor import SensorSize
from texvent.settings.resolution import resolve
from texvent.simulate import packets

ROOT = Path(__file__).parents[2]
SIMULATORS = ("texvent", "esim", "v2e", "senpi", "voltmeter", "physical")


def run_attack(simulator: str, interpolators: str, groups: str) -> list[str]:
    """What went wrong, one line each."""
    command = [sys.executable, "-W", "ignore", "-m", "tests.extremes.attack"]
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "NUMBA_NUM_THREADS": "1"}
    done = subprocess.run(
        [*command, simulator, interpolators, groups],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    wrong = [f"{line['end']}: {line['wrong']}" for line in lines if line.get("wrong")]
    if done.returncode or not lines or "begin" in lines[-1]:
        wrong.append(f"exit {done.returncode} at {lines[-1:]}: {done.stderr[-500:]}")
    return wrong


@pytest.mark.nightly
@pytest.mark.parametrize("simulator", SIMULATORS)
def test_every_model_survives_extreme_inputs_and_options(simulator):
    assert run_attack(simulator, "none,blend,flow", "intensities,times,sizes,options") == []


def test_the_range_of_intensities_is_said_and_its_ends_are_allowed():
    frames = np.full((3, 4, 4), 100.0)
    frames[1, 2, 2] = 1e9
    assert len(texvent.simulate(frames, fps=10, simulator="esim", interpolate="none"))
    frames[1, 2, 2] = 1.001e9
    with pytest.raises(InputError, match=r"above 1e\+09 .first: 1.001e\+09.*0..1e\+09"):
        texvent.simulate(frames, fps=10, simulator="esim", interpolate="none")


def test_noise_of_a_gap_that_memory_cannot_hold_is_refused_before_it_is_drawn(monkeypatch):
    monkeypatch.setattr(packets, "usable_bytes", lambda: 10**9)
    frames = np.full((2, 64, 64), 10, np.uint8)
    month = {"t_us": [0, 30 * 86_400 * 10**6], "interpolate": "none"}
    with pytest.raises(InputError, match=r"about 1.1e\+09 events .* memory holds"):
        texvent.simulate(frames, noise_rate_hz=0.1, noise_scale=1.0, **month)
    frames[1] = 200
    per_pixel = int(np.log((20 + 200) / (20 + 10)) / 0.2)
    assert len(texvent.simulate(frames, noise="none", **month)) == 64 * 64 * per_pixel


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
from texvent.runtime.allocator import release_freed_memory
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


VALUES = {
    "digits": 10**5000,
    "text": "x" * 10**6,
    "list": [10**5000],
    "float": 1e300,
    "lines": "a\nb",
    "mapping": {1: "y" * 99},
}


@pytest.mark.parametrize("value", VALUES.values(), ids=VALUES)
def test_messages_show_at_most_80_characters_of_a_value(value):
    text = shown(value)
    assert 0 < len(text) <= 80
    assert text.isprintable()
