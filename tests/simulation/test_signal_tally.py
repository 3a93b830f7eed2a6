"""A run that loses its signal says so, why, and which option helps."""

import warnings

import numpy as np
import pytest

import texvent

FPS = 120


def drifting(levels=80.0, frames=FPS // 2):
    """A grating that moves so slowly that no pixel changes by a threshold from frame to frame."""
    x = np.arange(48)[None] - 40 * np.arange(frames)[:, None] / FPS
    rows = 128 + levels * np.sin(2 * np.pi * x / 50)
    return np.repeat(rows[:, None, :], 36, axis=1).astype(np.float32)


def doubt_of(frames, **options):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        events = texvent.simulate(frames, fps=FPS, interpolate="none", **options)
    said = [str(one.message) for one in caught if one.category is texvent.TexventWarning]
    assert len(said) < 2
    return events, "".join(said)


@pytest.mark.parametrize("noise_rate_hz", [0.0, 20.0])
def test_slow_change_that_a_cache_forgets_is_named_with_the_option_that_helps(noise_rate_hz):
    options = {"noise_rate_hz": noise_rate_hz, "noise_intensity": 255.0}
    events, said = doubt_of(drifting(), cache="local", **options)
    head = f"all {len(events):,} events are noise" if noise_rate_hz else "no events"
    assert said.startswith(f"{head}, though 9")
    assert "cache='local' forgets" in said
    assert "give cache='global'" in said
    events, said = doubt_of(drifting(), cache="global", **options)
    assert len(events) > 5_000
    assert said == ""


@pytest.mark.parametrize("simulator", ["physical", "esim", "v2e", "voltmeter"])
def test_models_that_remember_are_not_doubted(simulator):
    events, said = doubt_of(drifting(), simulator=simulator)
    assert len(events) > 5_000
    assert said == ""


def test_two_equal_frames_stand_still():
    _, said = doubt_of(drifting(frames=1).repeat(2, axis=0))
    assert said.startswith("no events: the video stands still, no pixel changes by more than 0")


def test_a_model_that_holds_change_back_otherwise_gets_general_advice():
    _, said = doubt_of(drifting(), simulator="v2e", cutoff_hz=0.01, shot_noise_rate_hz=0.0)
    assert "hold it back; give a lower contrast_threshold=0.1" in said


def test_a_scene_at_rest_with_noise_is_said_to_be_noise():
    events, said = doubt_of(drifting(levels=2.0), noise_rate_hz=20.0, noise_intensity=255.0)
    assert said.startswith(
        f"all {len(events):,} events are noise: nothing changed by more than the"
    )
    # 2 levels of 148 in each direction are .027 log units; half of that is suggested.
    assert "lower it, such as contrast_threshold=0.01" in said
    options = {"keep_events": "noise", "noise_intensity": 255.0}
    assert doubt_of(drifting(levels=2.0), noise_rate_hz=20.0, **options)[1] == ""
    assert "keeps those of noise alone" in doubt_of(drifting(), noise_rate_hz=0.0, **options)[1]
