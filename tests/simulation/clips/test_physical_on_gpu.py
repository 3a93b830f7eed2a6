"""Clips of `physical` on a GPU, each with constants of its own, are those of the CPU."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from texvent.errors import ConfigError
from texvent.simulation.clips.physical import simulate_physical
from texvent.simulation.clips.pixels import ClipOutputs
from texvent.simulation.physical.config import PhysicalConfig
from texvent.simulation.random.draws import frame_key

from .test_clips import ALL, some_clips

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from texvent.simulation.clips.physical_gpu import simulate_physical_on_gpu  # noqa: E402
from texvent.simulation.gpu import GpuSimulator  # noqa: E402

USUAL = PhysicalConfig(
    contrast_threshold=0.3, cutoff_hz=250.0, noise_scale=200.0, initial_phase="random"
)
OTHERS: dict[str, dict[str, Any]] = {
    "threshold": {"contrast_threshold": 0.15},
    "ratio": {"on_off_ratio": 3.0},
    "mismatch": {"threshold_sigma": 0.2},
    "hot pixels": {"hot_pixel_fraction": 0.5, "hot_pixel_rate_hz": 300.0},
    "noise": {"noise_scale": 900.0},
    "polarity of noise": {"noise_on_fraction": 0.0},
    "leak": {"leak_rate_hz": 300.0},
    "low-pass": {"cutoff_hz": 40.0},
    "limit of the low-pass": {"cutoff_limit_hz": 20.0},
    "refractory period": {"refractory_period_us": 40_000},
    "phase": {"initial_phase": "zero"},
    "gamma": {"gamma": 1.6},
    "balance": {"balance": 60.0},
}
"""Constants that a clip may have of its own."""
KEYS = np.array([frame_key(3, number) for number in range(2)])
EVENTS = ClipOutputs(grids=False, events=True)


def clips(count: int) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    frames, times_us = some_clips()
    return frames[:2, :count, :6, :8].copy(), times_us[:2, :count]


def assert_equal(found: Any, expected: Any) -> None:
    for field, mine, other in zip(found._fields, found, expected, strict=True):
        assert (mine is None) == (other is None), field
        mine = mine.cpu().numpy() if isinstance(mine, torch.Tensor) else mine
        assert mine is None or np.array_equal(mine, other), field
        assert mine is None or mine.dtype == other.dtype, field


def test_clips_of_one_launch_have_constants_of_their_own(device):
    """Each clip bit for bit that of the CPU, and every constant changes its events."""
    configs = [USUAL, *(replace(USUAL, **other) for other in OTHERS.values())]
    frames, times_us = (np.repeat(one[:1], len(configs), axis=0) for one in clips(4))
    keys = np.repeat(KEYS[:1], len(configs))
    found = simulate_physical_on_gpu(
        torch.from_numpy(frames).to(device), times_us, configs, keys, EVENTS
    )
    expected = simulate_physical(frames, times_us, configs, keys, EVENTS)
    assert_equal(found, expected)
    usual, *others = np.split(expected.words, expected.ends[:-1])
    assert len(usual) > 20
    for name, other in zip(OTHERS, others, strict=True):
        assert not np.array_equal(other, usual), name


@pytest.mark.parametrize("outputs", [ALL, ClipOutputs(bins=1, intervals_per_window=2)])
def test_arrays_are_those_of_the_cpu(outputs, device):
    frames, times_us = clips(5)
    frames[1, :] = frames[1, :1]  # windows without events
    configs = [USUAL, replace(USUAL, noise_scale=0.0, leak_rate_hz=0.0, cutoff_hz=80.0)]
    found = simulate_physical_on_gpu(
        torch.from_numpy(frames).to(device), times_us, configs, KEYS, outputs
    )
    expected = simulate_physical(frames, times_us, configs, KEYS, outputs)
    assert_equal(found, expected)
    assert expected.grids[0].any()
    assert not expected.grids[1].any()


def test_a_batch_without_events_has_empty_arrays(device):
    frames, times_us = clips(3)
    frames[:] = 100
    quiet = replace(USUAL, noise_scale=0.0, leak_rate_hz=0.0)
    found = simulate_physical_on_gpu(
        torch.from_numpy(frames).to(device), times_us, [quiet, quiet], KEYS, ALL
    )
    assert_equal(found, simulate_physical(frames, times_us, [quiet, quiet], KEYS, ALL))


@pytest.mark.parametrize(
    ("configs", "message"),
    [
        ([USUAL], "options of 1 clips, and there are 2"),
        ([], "one per clip"),
        ([USUAL, replace(USUAL, cutoff_hz=0.0)], "cutoff_hz, 0 or not, must be the same"),
        ([USUAL, replace(USUAL, gamma=1.0)], "gamma, 1 or not, must be the same"),
        ([USUAL, replace(USUAL, noise_curve="1:2")], "noise_curve must be the same"),
        ([USUAL, replace(USUAL, scan_period_ns=500)], "scan_period_ns 500 lets events wait"),
    ],
)
def test_clips_that_one_launch_cannot_hold_are_refused(configs, message, device):
    frames = torch.from_numpy(clips(3)[0]).to(device)
    with pytest.raises(ConfigError, match=message):
        GpuSimulator(configs).step(frames, range(3))
