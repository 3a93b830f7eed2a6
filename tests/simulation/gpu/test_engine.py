"""The GPU backend gives the CPU's events: every option, frame type, chunk size."""

import itertools
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from texvent.errors import ConfigError, InputError, TexventWarning
from texvent.events import NOISE
from texvent.simulation.esim.config import EsimConfig
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.physical.simulator import PhysicalConfig, PhysicalSimulator
from texvent.simulation.texvent.noise import NOISE_BLOCK
from texvent.simulation.texvent.simulator import TexventConfig, TexventSimulator
from texvent.simulation.v2e.config import V2eConfig

from .clips import CLIPS, SEED, TWO_PAIRS, on_cpu, on_gpu, random_clips, random_times, rows

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from texvent.simulation.gpu import GpuSimulator  # noqa: E402

PAPER = TexventSimulator.presets["paper"]
TEXVENT = {
    "paper": {"noise_rate_hz": 5.0},
    "other noise": {"noise": "random", "noise_rate_hz": 9.0, "noise_on_fraction": 0.3},
    "dark": {"noise_rate_hz": 9.0, "noise_intensity": 120.5},
    "no cache": {"noise": "none", "cache": "none", "timestamp_rule": "random"},
    "current": {"cache": "global"},
    "default": {
        "noise": "none", "cache": "global", "reset": "step", "multi_event": True,
        "timestamp_rule": "linear", "residual_decay_hz": 3.0,
    },
    "many": {
        "cache": "global", "multi_event": True, "timestamp_rule": "random", "noise_rate_hz": 5.0,
    },
    "steps": {"noise": "none", "cache": "global", "reset": "step", "timestamp_rule": "eq7"},
    "end": {"noise": "none", "balance": 5.0, "contrast_threshold": 0.3, "timestamp_rule": "end"},
}  # fmt: skip
FEW: dict[str, Any] = {"log_eps": 0.1}
"""Few crossings per pixel, each of which costs the interpreter time."""
ESIM = {"esim": {}, "esim, two thresholds": {"contrast_threshold_off": 0.4}}
PHYSICAL = {
    "physical": {
        "gamma": 1.0, "balance": 40.0, "cutoff_hz": 150.0, "cutoff_limit_hz": 60.0,
        "on_off_ratio": 1.5, "refractory_period_us": 3000, "noise_scale": 300.0,
        "hot_pixel_fraction": 0.1, "hot_pixel_rate_hz": 300.0, "sensor_seed": 4,
    },
    "physical, leak": {
        "initial_phase": "random", "leak_rate_hz": 90.0, "refractory_period_us": 0,
        "cutoff_hz": 0.0, "noise_scale": 0.0, "balance": 40.0,
    },
}  # fmt: skip
SMALL = slice(12), slice(16)
"""Pixels for a model whose steps cost the interpreter most."""


MODELS = {
    **{name: (TexventSimulator, replace(PAPER, **one)) for name, one in TEXVENT.items()},
    **{name: (EsimSimulator, EsimConfig(**FEW, **one)) for name, one in ESIM.items()},
    **{name: (PhysicalSimulator, PhysicalConfig(**one)) for name, one in PHYSICAL.items()},
}
CASES = [
    *((name, np.uint8) for name in MODELS),
    *((name, np.float32) for name in ("paper", "current", "default", "esim")),
]


@pytest.mark.parametrize(("name", "dtype"), CASES)
def test_the_events_are_those_of_the_cpu(name, dtype, device):
    model, config = MODELS[name]
    clips, times_us = random_clips(dtype), random_times()
    if name in PHYSICAL:
        clips = clips[..., *SMALL].copy()
    found = on_gpu(
        torch, GpuSimulator(config, seed=SEED), clips, times_us, TWO_PAIRS, device=device,
        chunks=(3, 2),
    )  # fmt: skip
    for clip in range(CLIPS):
        simulator = model(config, seed=SEED + clip)
        expected = rows(on_cpu(simulator, clips[clip], times_us[clip], TWO_PAIRS))
        assert len(expected) > clips[clip, 0].size // 3
        if dtype == np.uint8 or device == "cpu":
            assert np.array_equal(rows(found[clip]), expected)
        else:
            assert_equal_but_beside_the_threshold(rows(found[clip]), expected)


def assert_equal_but_beside_the_threshold(found, expected):
    """A GPU's float64 logarithm may differ in its last bit from the CPU's: no more than that."""
    places = [{tuple(event[[1, 2, 3, 4]]) for event in one} for one in (found, expected)]
    assert len(places[0] ^ places[1]) <= 1e-3 * len(expected)
    if len(found) == len(expected):
        assert np.abs(found[:, 0] - expected[:, 0]).max() <= 1


@pytest.mark.parametrize("noise", ["adaptive", "random"])
def test_noise_of_several_blocks_is_that_of_the_cpu(noise, device):
    clip = np.random.default_rng(2).integers(60, 100, (1, 3, 72, 80)).astype(np.uint8)
    times_us = np.array([[0, 900, 2500]])
    config = TexventConfig(
        noise=noise, noise_rate_hz=8.0, noise_intensity=80.0, contrast_threshold=0.35
    )
    flags = [True] * 3
    found = on_gpu(torch, GpuSimulator(config), clip, times_us, flags, device=device, chunks=(3,))[
        0
    ]
    expected = on_cpu(TexventSimulator(config), clip[0], times_us[0], flags)
    assert np.array_equal(rows(found), rows(expected))
    noisy = found.label == NOISE
    assert (found.y[noisy].astype(int) * 80 + found.x[noisy] >= NOISE_BLOCK).any()
    assert 10 < noisy.sum() < len(found)


def test_floats_differ_from_the_cpu_at_most_within_rounding_of_the_threshold(device):
    reference, balance = np.float32(100.0), 30.0
    tie = np.log(np.float64(130.0) + balance) - np.log(np.float64(100.0) + balance)
    steps = np.arange(-240, 240, dtype=np.int32)
    # Every float32 around the intensity that lies exactly on the threshold.
    around = (np.float32(130.0).view(np.int32) + steps).view(np.float32).reshape(20, 24)
    clip = np.stack([np.full((20, 24), reference), around])[None]
    config = TexventConfig(
        noise="none", balance=balance, contrast_threshold=float(tie), timestamp_rule="end"
    )
    found = on_gpu(torch, GpuSimulator(config), clip, np.array([[0, 9]]), [True] * 2, device=device)
    expected = on_cpu(TexventSimulator(config), clip[0], [0, 9], [True] * 2)
    pixels = [set((one.y.astype(int) * 24 + one.x).tolist()) for one in (found[0], expected)]
    on_threshold = {int(np.flatnonzero(steps == 0)[0])}
    assert pixels[0] ^ pixels[1] <= on_threshold
    assert pixels[0] - on_threshold == set(np.flatnonzero(steps > 0).tolist())


def test_bytes_followed_by_floats_keep_their_references(device):
    clips, times_us = random_clips(np.uint8), random_times()
    config = TexventConfig(noise="none", cache="global")
    simulator = GpuSimulator(config)
    bytes_, floats = (
        torch.from_numpy(clips[:, part]).to(device) for part in (slice(2), slice(2, 5))
    )
    simulator.step(bytes_, times_us[:, :2])
    events = simulator.step(floats.float(), times_us[:, 2:])
    expected = on_cpu(TexventSimulator(config), clips[0], times_us[0])
    assert np.array_equal(rows(events.stream(0)), rows(expected[expected.t >= times_us[0, 1]]))


def test_a_batch_lies_in_one_piece_clip_by_clip_in_order(device):
    clips, times_us = random_clips(np.uint8), random_times()
    events = GpuSimulator(TexventConfig(noise_rate_hz=5.0)).step(
        torch.from_numpy(clips).to(device), times_us
    )
    assert {str(column.device.type) for column in (events.x, events.t, events.label)} == {device}
    offsets = events.clip_offsets.cpu().numpy()
    assert offsets.tolist() == [0, *events.frame_ends[:, -1].tolist()]
    for clip in range(events.clips):
        table = rows(events.stream(clip))
        assert np.array_equal(np.lexsort(table.T[::-1]), np.arange(len(table)))
        for interval, (first, last) in enumerate(itertools.pairwise(events.frame_ends[clip])):
            inside = events.t[first:last].cpu().numpy()
            assert (inside >= times_us[clip, interval]).all()
            assert (inside < times_us[clip, interval + 1]).all()


def test_a_bad_intensity_is_refused_and_changes_nothing(device):
    clips, times_us = random_clips(np.float32), random_times()
    frames = torch.from_numpy(clips).to(device)
    simulator = GpuSimulator()
    simulator.step(frames[:, :2], times_us[:, :2])
    for value in (float("nan"), -1.0, 2e9):
        bad = frames[:, 2:].clone()
        bad[1, 1, 3, 3] = value
        with pytest.raises(InputError, match="have 1 pixel"):
            simulator.step(bad, times_us[:, 2:])
    again = simulator.step(frames[:, 2:], times_us[:, 2:])
    whole = GpuSimulator().step(frames, times_us)
    late = whole.stream(1)
    assert again.stream(1).equals(late[late.t >= times_us[1, 1]])


def test_frames_of_0_to_1_bring_a_warning_and_dark_ones_do_not(device):
    frames = torch.linspace(0, 1, 6, device=device).reshape(1, 2, 1, 3)
    simulator = GpuSimulator()
    with pytest.warns(TexventWarning, match=r"above 1, while 255 is white: give frames \* 255"):
        simulator.step(frames, [0, 1])
    simulator.step(frames, [2, 3])
    for quiet in (frames * 255, frames * 0, frames.to(torch.uint8)):
        GpuSimulator().step(quiet, [0, 1])
    GpuSimulator(is_scale_known=True).step(frames, [0, 1])


@pytest.mark.parametrize("name", MODELS)
def test_eq_4_counts_with_the_numbers_of_the_cpu(name):
    model, config = MODELS[name]
    expected, found = model(config), GpuSimulator(config)
    assert (found.contrast_threshold, found.balance) == (
        expected.contrast_threshold,
        expected.balance,
    )


def test_a_call_that_breaks_off_leaves_nothing_to_go_on_with(device, monkeypatch):
    clips, times_us = random_clips(np.uint8)[..., :4, :4].copy(), random_times()
    early, late = slice(0, 2), slice(2, None)
    frames = torch.from_numpy(clips).to(device)
    simulator = GpuSimulator(seed=np.uint8(5))
    expected = simulator.step(frames, times_us).stream(1)
    simulator.reset()
    simulator.step(frames[:, early], times_us[:, early])
    with monkeypatch.context() as patch:
        patch.setattr(torch, "sort", lambda words: bytearray(2**62))
        with pytest.raises(MemoryError):
            simulator.step(frames[:, late], times_us[:, late])
    with pytest.raises(InputError, match=r"call reset\(\)"):
        simulator.step(frames[:, late], times_us[:, late])
    simulator.reset()
    assert simulator.step(frames, times_us).stream(1).equals(expected)


@pytest.mark.parametrize(
    ("seed", "message"),
    [
        (-1, "seed is -1; it must be"),
        (0.5, "seed is 0.5; it must be"),
        ([0, 0.5], "must hold one whole number per clip"),
        ([0, -1], "seed is -1; it must be"),
        ([[1, 2]], "there are 1 x 2 seeds; give one per clip"),
        ([1, 2, 3], "there are 3 seeds for 2 clips"),
    ],
)
def test_seeds_that_are_no_whole_number_per_clip_are_refused(seed, message, device):
    frames = torch.zeros(2, 1, 3, 4, dtype=torch.uint8, device=device)
    with pytest.raises((ConfigError, InputError), match=message):
        GpuSimulator(seed=seed).step(frames, [0])


@pytest.mark.parametrize(
    ("frames", "times_us", "message"),
    [
        (np.zeros((1, 2, 3, 4), np.uint8), [0, 1], "must be a torch tensor"),
        (torch.zeros(2, 3, 4), [0, 1], r"\[B, T, H, W\]"),
        (torch.zeros(1, 2, 3, 4, dtype=torch.float64), [0, 1], "uint8 or float32"),
        (torch.zeros(1, 2, 3, 4), [0, 0], "strictly increase"),
        (torch.zeros(1, 2, 3, 4), [0], r"must be \[2\] or \[1, 2\]"),
        (torch.zeros(1, 2, 3, 4), [0.0, 0.5], "whole microseconds"),
        (torch.zeros(1, 2, 3, 4), [0, 2**60], "1152921504606846976 µs, beyond"),
    ],
)
def test_frames_and_times_that_cannot_be_used_are_refused(frames, times_us, message, device):
    if isinstance(frames, torch.Tensor):
        frames = frames.to(device)
    with pytest.raises(InputError, match=message):
        GpuSimulator().step(frames, times_us)


@pytest.mark.parametrize(
    ("config", "message"),
    [
        (TexventConfig(noise="gaussian"), "noise 'gaussian'"),
        (EsimConfig(threshold_sigma=0.1), "threshold_sigma 0.1"),
        (EsimConfig(refractory_period_us=5), "refractory_period_us 5"),
        (PhysicalConfig(scan_period_ns=7), "scan_period_ns 7"),
        (V2eConfig(), "'v2e' does not run on a GPU; texvent, esim and physical do"),
    ],
)
def test_what_only_the_cpu_does_is_refused_by_name(config, message):
    with pytest.raises(ConfigError, match=message):
        GpuSimulator(config)
