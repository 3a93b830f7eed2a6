"""The simulator against worked numbers: one pixel, computed by hand, in both forms.

Unless said: the paper's options, δ = 0.2, α = 30, no noise. Ramp A is `α + I = 50 · exp(1.05 t)`
over one second, whose true crossings are at 0.190, 0.381, 0.571, 0.762 and 0.952 s.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

import texvent
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.simulation.texvent.simulator import TexventConfig, TexventSimulator

SECOND = 1_000_000
BALANCE = 30.0
TRUE_CROSSINGS = (0.190, 0.381, 0.571, 0.762, 0.952)


def pixel(intensity: float, t_us: int, *, is_source: bool = True) -> Frame:
    return Frame(np.full((1, 1), intensity, np.float64), t_us, is_source)


def paper(**options) -> TexventConfig:
    return replace(TexventSimulator.presets["paper"], **options)


def simulate(frames, *, seed: int = 0, **options) -> EventStream:
    simulator = TexventSimulator(paper(**{"noise": "none"} | options), seed=seed)
    return EventStream.concat([simulator.step(frame) for frame in frames])


def seconds(events: EventStream) -> list[float]:
    return [round(t / SECOND, 3) for t in events.t.tolist()]


def ramp_a(inner: int = 5) -> list[Frame]:
    steps = inner + 1
    frames = []
    for k in range(steps + 1):
        phase = k / steps
        level = 50 * np.exp(1.05 * phase) - BALANCE
        t_us = round(k * SECOND / steps)
        frames.append(pixel(level, t_us, is_source=k in (0, steps)))
    return frames


def ramp_b() -> list[Frame]:
    """0.055 log units per source frame, 20 pairs, no intermediate frame, 1 s per pair."""
    return [pixel(70 * np.exp(0.055 * k) - BALANCE, k * SECOND) for k in range(21)]


@pytest.mark.parametrize(
    ("reset", "stamp", "times"),
    [
        ("current", "end", (0.333, 0.667, 1.0)),
        ("current", "eq7", (0.250, 0.583, 0.917)),
        ("current", "linear", (0.190, 0.524, 0.857)),
        ("step", "end", (0.333, 0.5, 0.667, 0.833, 1.0)),
        ("step", "eq7", (0.250, 0.417, 0.583, 0.750, 0.917)),
        ("step", "linear", TRUE_CROSSINGS),
    ],
)
def test_eq5_fires_on_ramp_a_as_worked_out(reset, stamp, times):
    events = simulate(ramp_a(), reset=reset, timestamp_rule=stamp)
    assert seconds(events) == pytest.approx(times, abs=1e-9)
    assert set(events.p.tolist()) == {1}


def test_a_single_event_per_frame_keeps_the_first_crossing_only():
    events = simulate(ramp_a(inner=0), reset="step", timestamp_rule="linear")
    assert seconds(events) == [0.190]


GLOBAL_STEP = (3.636, 7.273, 10.909, 14.545, 18.182)


@pytest.mark.parametrize(
    ("options", "times"),
    [
        ({"cache": "global", "reset": "step"}, GLOBAL_STEP),
        ({"cache": "global", "reset": "current"}, (3.636, 7.636, 11.636, 15.636, 19.636)),
        # 10 % and 5 % per second.
        ({"cache": "global", "residual_decay_hz": -math.log(0.9)}, (4.541, 8.896, 13.480, 17.856)),
        (
            {"cache": "global", "residual_decay_hz": -math.log(0.95)},
            (3.926, 7.867, 11.818, 15.778, 19.746),
        ),
        ({"cache": "global", "residual_decay_hz": 1e6}, ()),
        ({"cache": "local"}, ()),
        ({"cache": "none"}, ()),
    ],
    ids=str,
)
def test_cache_decides_how_slow_a_ramp_still_fires(options, times):
    events = simulate(ramp_b(), timestamp_rule="linear", **({"reset": "step"} | options))
    assert seconds(events) == pytest.approx(times, abs=1e-9)


@pytest.mark.filterwarnings("ignore:no events")
def test_references_decay_by_the_same_share_at_any_frame_rate():
    """.9 of a threshold, a second later .2 of one: too little if the first is nearly forgotten."""
    levels = np.exp(np.log(120.0) + 0.2 * np.array([0.0, 0.9, 1.1])) - 20.0
    for fps in (10, 400):
        frames = np.repeat(levels, [1, fps, 1]).astype(np.float32).reshape(-1, 1, 1)
        options = {"contrast_threshold": 0.2, "noise": "none", "interpolate": "none", "fps": fps}
        fired = [len(texvent.simulate(frames, cache="global", residual_decay_hz=rate, **options))
                 for rate in (0.0, 3.0)]  # fmt: skip
        assert fired == [1, 0]


def test_eq1_fires_exactly_from_the_threshold_on():
    """δ is set to the change itself, then to the next larger number."""
    frames = [Frame(np.full((1, 1), level, np.uint8), level) for level in (70, 90)]
    change = float(np.log(120.0) - np.log(100.0))
    assert len(simulate(frames, contrast_threshold=change)) == 1
    above = float(np.nextafter(change, 1))
    assert len(simulate(frames, contrast_threshold=above)) == 0


def test_local_cache_adds_up_inside_a_pair_and_forgets_at_its_end():
    """0.15 + 0.15 fires within a pair, and does not across a source frame."""
    levels = [70 * np.exp(0.15 * k) - BALANCE for k in range(3)]

    def clip(middle_is_source):
        return [
            pixel(level, k * 1000, is_source=k != 1 or middle_is_source)
            for k, level in enumerate(levels)
        ]

    assert len(simulate(clip(False))) == 1
    assert len(simulate(clip(True))) == 0
    assert len(simulate(clip(False), cache="none")) == 0


def test_the_paper_preset_is_the_publication():
    config = paper()
    assert (config.contrast_threshold, config.balance) == (0.2, 30.0)
    assert (config.cache, config.reset, config.noise, config.timestamp_rule) == (
        "local",
        "current",
        "adaptive",
        "eq7",
    )
    assert not config.multi_event
    simulator = TexventSimulator(TexventConfig(contrast_threshold=0.3, balance=10.0))
    assert (simulator.contrast_threshold, simulator.balance) == (0.3, 10.0)


def test_step_fails_if_gaussian_noise_would_fire_every_time():
    config = paper(noise="gaussian", noise_rate_hz=30.0)
    simulator = TexventSimulator(config)
    simulator.step(pixel(50, 0))
    with pytest.raises(InputError, match=r"1\.5 events per pixel.*lower noise_rate_hz"):
        simulator.step(pixel(50, 50_000))
