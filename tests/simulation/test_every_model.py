"""What a user gets of every pixel model alike: labels, noise or clean only, rates per second."""

import contextlib
import dataclasses
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import texvent
from texvent._registry import SIMULATORS
from texvent.errors import ConfigError
from texvent.events import NOISE, SIGNAL

from .pixel_frames import moving_texture, run

RATE_HZ = 4.0
DARK = 10.0
"""Level of the pixels that are asked for noise."""
V2E_SHARE = 1 - 0.75 * (DARK + 20) / 275
"""v2e's noise at this level, as a share of that in the dark."""
NOISY: dict[str, dict[str, Any]] = {
    "texvent": {"noise_rate_hz": RATE_HZ},
    "physical": {
        "noise_scale": 1.0,
        "noise_curve": f"0:{RATE_HZ} 255:{RATE_HZ}",
        "leak_rate_hz": 0.0,
    },
    "v2e": {"shot_noise_rate_hz": RATE_HZ / V2E_SHARE, "leak_rate_hz": 0.0, "threshold_sigma": 0.0},
    "voltmeter": {"constants": f"5.265 20 1e-4 {RATE_HZ * 1e-6} 0 1e-5"},
    "senpi": {"noise_rate_hz": RATE_HZ},
}
"""Options with which a dark pixel at rest fires at `RATE_HZ`. ESIM has no noise."""
DENSE: dict[str, dict[str, Any]] = {
    "physical": {"noise_curve": "0:20 255:20"},
    "senpi": {"noise_rate_hz": 20.0, "contrast_threshold": 0.2},
}
"""Options with which pixels are noisy at any level, of models whose noise begins a refractory
period; in v2e it is added to what is done."""
CLEAN: dict[str, dict[str, Any]] = {
    "texvent": {"noise": "none"},
    "physical": {"preset": "clean"},
    "esim": {},
    "v2e": {"preset": "peer-common"},
    "voltmeter": {"constants": "5.265 20 0 0 0 0"},
    "senpi": {"preset": "peer-common"},
}
CLIP = Path(__file__).parents[1] / "clips" / "bigbuckbunny_excerpt.mp4"


def texture(**options: Any):
    frames = np.stack([frame.pixels for frame in moving_texture(6, (30, 40))])
    return texvent.simulate(frames, fps=24, interpolate="none", label_noise=True, **options)


def test_no_model_is_forgotten():
    assert set(SIMULATORS.builtin) == set(CLEAN) == set(BRIGHTNESS) | {"senpi"}
    assert set(CLEAN) - {"esim"} == set(NOISY)


@pytest.mark.parametrize("model", NOISY)
@pytest.mark.parametrize(("fps", "inner"), [(24, 0), (24, 20), (240, 3)])
def test_noise_has_its_rate_for_any_frame_rate_and_number_of_inner_frames(model, fps, inner):
    shape = (24, 32)
    frames = np.full((fps + 1, *shape), DARK, np.float32)
    events = texvent.simulate(
        frames,
        fps=fps,
        simulator=model,
        interpolate="blend",
        fixed_count=inner,
        label_noise=True,
        seed=fps + inner,
        **NOISY[model],
    )
    expected = RATE_HZ * shape[0] * shape[1]
    # Pixels of `physical` differ by 0.63 of their mean, which is 2.3 % of the total.
    spread = np.hypot(np.sqrt(expected), 0.025 * expected)
    assert len(events) == pytest.approx(expected, abs=4 * spread)
    assert (events.label == NOISE).all()
    # Uniform within every frame interval, not at one shared time.
    places = np.histogram(events.t * fps / 1e6 % 1, bins=20, range=(0, 1))[0]
    mean = len(events) / 20
    assert ((places - mean) ** 2 / mean).sum() < 19 + 5 * math.sqrt(2 * 19)


BRIGHTNESS: dict[str, Callable[[float, float], float]] = {
    "texvent": lambda start, stop: math.log((20 + stop) / (20 + start)) / 0.2,
    "physical": lambda start, stop: math.log((10 + stop) / (10 + start)) / 0.2,
    "esim": lambda start, stop: math.log((0.255 + stop) / (0.255 + start)) / 0.2,
    "v2e": lambda start, stop: math.log(stop / start) / 0.2,
    "voltmeter": lambda start, stop: 5.265 * (stop - start) / (20 + (start + stop) / 2),
}
"""Change from one level to another in thresholds, as each model publishes it; SENPI fires once."""


@pytest.mark.parametrize("model", BRIGHTNESS)
@pytest.mark.parametrize(("start", "stop"), [(40.0, 150.0), (150.0, 40.0)])
def test_a_ramp_fires_where_it_crosses_each_threshold(model, start, stop):
    options = {"initial_phase": "zero"} if model == "voltmeter" else {}
    options |= {"gamma": 1.0} if model == "physical" else {}
    frames = np.array([[[start]], [[stop]]], np.float32)
    events = texvent.simulate(
        frames, fps=1, simulator=model, interpolate="none", **CLEAN[model], **options
    )
    whole = BRIGHTNESS[model](start, stop)
    wanted = [k / abs(whole) * 1e6 for k in range(1, 1 + math.floor(abs(whole)))]
    assert events.t == pytest.approx(wanted, abs=2)
    assert (events.p == (whole > 0)).all()


LEAKING: dict[str, dict[str, Any]] = {
    "physical": {"preset": "clean", "leak_rate_hz": 10.0, "leak_rate_decades": 0.0},
    "v2e": {"preset": "peer-common", "leak_rate_hz": 10.0, "leak_rate_decades": 0.0},
    "voltmeter": {"constants": "5.265 20 0 1e-5 0 0", "initial_phase": "zero"},
}
"""Options with which every pixel leaks ten times a second and does nothing else."""


@pytest.mark.parametrize("model", LEAKING)
@pytest.mark.parametrize("fps", [24, 500])
def test_leak_fires_on_events_at_its_rate_for_any_frame_rate(model, fps):
    frames = np.full((1 + fps * 21 // 20, 1, 2), 90.0, np.float32)
    options = {"simulator": model, "interpolate": "none", "label_noise": True}
    events = texvent.simulate(frames, fps=fps, **options, **LEAKING[model])
    assert events.t[::2] == pytest.approx([k * 100_000 for k in range(1, 11)], abs=2)
    assert events.p.all()
    assert (events.label == NOISE).all()


def has(model, option):
    return hasattr(SIMULATORS.load(model).config_type(), option)


@pytest.mark.parametrize("model", [one for one in LEAKING if has(one, "threshold_sigma")])
def test_pixels_of_any_threshold_leak_at_the_same_rate(model):
    frames = np.full((12, 6, 8), 90.0, np.float32)
    options = {"simulator": model, "interpolate": "none", **LEAKING[model], "threshold_sigma": 0.05}
    events = texvent.simulate(frames, fps=24, seed=3, **options)
    assert events.t == pytest.approx(np.repeat([100_000, 200_000, 300_000, 400_000], 48), abs=6)


@pytest.mark.parametrize("model", DENSE)
def test_no_signal_follows_any_event_of_its_pixel_within_the_refractory_period(model):
    events = texture(simulator=model, refractory_period_us=30_000, **NOISY[model] | DENSE[model])
    pixel = np.asarray(events.y, np.int64) * 40 + events.x
    order = np.lexsort((np.arange(len(pixel)), pixel))
    same, gaps = np.diff(pixel[order]) == 0, np.diff(events.t[order])
    signal = events.label[order][1:] == SIGNAL
    assert (same & signal).sum() > 50
    assert (same & (events.label[order][:-1] == NOISE)).sum() > 50
    assert gaps[same & signal].min() >= 30_000


@pytest.mark.parametrize("model", [one for one in NOISY if has(one, "noise_on_fraction")])
@pytest.mark.parametrize("share", [0.0, 0.3, 1.0])
def test_noise_has_the_share_of_on_that_is_asked_for(model, share):
    frames = np.full((13, 60, 80), DARK, np.float32)
    options = {"simulator": model, "interpolate": "none", "noise_on_fraction": share}
    events = texvent.simulate(frames, fps=24, **options, **NOISY[model])
    spread = math.sqrt(share * (1 - share) / len(events))
    assert events.p.mean() == pytest.approx(share, abs=4 * spread)


@pytest.mark.parametrize("model", CLEAN)
def test_without_noise_every_event_is_signal_and_a_scene_at_rest_is_silent(model):
    moving = texture(simulator=model, **CLEAN[model])
    assert len(moving) > 100
    assert (moving.label == SIGNAL).all()
    still = np.full((13, 8, 9), DARK, np.float32)
    with pytest.warns(texvent.TexventWarning, match="no events: the video stands still"):
        at_rest = texvent.simulate(still, fps=24, simulator=model, **CLEAN[model])
    assert len(at_rest) == 0


@pytest.mark.parametrize("model", SIMULATORS.builtin)
def test_impossible_options_fail_by_name(model):
    config = SIMULATORS.load(model).config_type()
    numbers = -1e19, 1e19, math.nan
    for name, value in vars(config).items():
        words = ("abacus",) if isinstance(value, str) else ()
        for wrong in numbers if type(value) in (int, float) else words:
            with pytest.raises(ConfigError, match=name):
                dataclasses.replace(config, **{name: wrong})


@pytest.mark.long
@pytest.mark.parametrize("model", ["texvent", "esim"])  # compiles kernels of its own
def test_a_whole_number_may_be_an_int(model):
    kind = SIMULATORS.load(model)
    config = dataclasses.replace(kind.config_type(), **NOISY.get(model, {}))
    if hasattr(config, "noise_on_fraction"):
        config = dataclasses.replace(config, noise_on_fraction=1.0)
    floats = {name: value for name, value in vars(config).items() if isinstance(value, float)}
    whole = {name: int(value) for name, value in floats.items() if value.is_integer()}
    runs = (kind(one) for one in (config, dataclasses.replace(config, **whole)))
    expected, given = (run(simulator, moving_texture(6, (30, 40))) for simulator in runs)
    assert len(expected) > 100
    assert given.equals(expected)


@pytest.mark.parametrize("model", CLEAN)
def test_signal_and_noise_alone_are_the_parts_of_the_whole(model):
    options = {"simulator": model, **NOISY.get(model, {})}
    both = texture(**options)
    signal = texture(keep_events="signal", **options)
    says_none = contextlib.nullcontext()
    if model not in NOISY:
        says_none = pytest.warns(texvent.TexventWarning, match="those of noise alone")
    with says_none:
        noise = texture(keep_events="noise", **options)
    assert len(signal) > 0
    assert (len(noise) > 0) == (model in NOISY)
    assert both[both.label == SIGNAL].equals(signal)
    assert both[both.label == NOISE].equals(noise)
