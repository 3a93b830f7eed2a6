"""backend="gpu" of the simulators, and --backend gpu of the command line."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent._registry import SIMULATORS
from texvent.cli.app import main
from texvent.config import RunConfig
from texvent.errors import ConfigError
from texvent.simulate.build import build_simulator
from texvent.simulate.esim.simulator import EsimConfig, EsimSimulator
from texvent.simulate.texvent.simulator import TexventConfig, TexventSimulator

from .clips import SEED, TWO_PAIRS, on_cpu, random_clips, random_times

CLIP = Path(__file__).parents[2] / "clips" / "bigbuckbunny_excerpt.mp4"
NEEDS_TORCH = pytest.mark.torch


@NEEDS_TORCH
@pytest.mark.parametrize(
    ("model", "config"),
    [
        (TexventSimulator, TexventConfig(noise_rate_hz=5.0)),
        (EsimSimulator, EsimConfig(log_eps=0.1, refractory_period_us=500)),
    ],
)
def test_a_simulator_with_backend_gpu_steps_as_on_the_cpu(model, config, device):
    clip, times_us = random_clips(np.uint8)[0], random_times()[0]
    gpu, cpu = (model(config, seed=SEED, backend=name) for name in ("gpu", "cpu"))
    expected = on_cpu(cpu, clip, times_us, TWO_PAIRS)
    assert len(expected) > 200
    assert on_cpu(gpu, clip, times_us, TWO_PAIRS).equals(expected)
    gpu.reset()
    assert on_cpu(gpu, clip, times_us, TWO_PAIRS).equals(expected)


@NEEDS_TORCH
def test_a_run_with_backend_gpu_has_the_same_events(device):
    frames = random_clips(np.uint8)[0]
    options = {"fps": 100, "interpolate": "blend", "fixed_count": 1}
    runs = [texvent.simulate(frames, backend=name, **options) for name in ("gpu", "cpu")]
    assert len(runs[0]) > 200
    if device == "cpu":
        assert runs[0].equals(runs[1])
    else:
        assert abs(len(runs[0]) - len(runs[1])) <= 1e-3 * len(runs[1])


@pytest.mark.parametrize(
    "name", [one for one in SIMULATORS.names() if one not in ("texvent", "esim", "v2ce")]
)
def test_other_simulators_refuse_backend_gpu_by_name(name):
    with pytest.raises(ConfigError, match="has no backend gpu"):
        build_simulator(RunConfig(simulator=name, backend="gpu"), None)


def test_without_a_gpu_the_command_line_says_so_in_one_line(tmp_path, capsys, monkeypatch):
    monkeypatch.delenv("TRITON_INTERPRET", raising=False)
    torch = pytest.importorskip("torch") if _has("torch") else None
    if torch is not None and torch.cuda.is_available():
        pytest.skip("there is a GPU here")
    words = ["simulate", str(CLIP), "--backend", "gpu", "-o", str(tmp_path / "e.h5"), "-q"]
    assert main(words) != 0
    lines = capsys.readouterr().err.strip().splitlines()
    assert len(lines) == 1
    expected = "torch finds none here" if torch is not None else "pip install 'texvent[gpu]'"
    assert expected in lines[0]
    assert not (tmp_path / "e.h5").exists()


def _has(module: str) -> bool:
    import importlib.util

    return importlib.util.find_spec(module) is not None
