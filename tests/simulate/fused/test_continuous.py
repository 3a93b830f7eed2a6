"""The continuous-time engine: exact ramps, and agreement with the frame engine."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import texvent
from texvent.events import EventStream
from texvent.simulate.esim import simulator as esim_simulator
from texvent.simulate.fused.candidates import one_grid
from texvent.simulate.fused.continuous import SegmentPlan, dyadic_segments
from texvent.simulate.packets.interval import FrameInterval
from texvent.video import Video

from .clips import panning, plan, readable

LINES = {"multi_event": True, "reset": "step", "timestamp_rule": "linear"}


def continuous(video, **options):
    return texvent.simulate(video, engine="continuous", **options)


def test_a_ramp_between_two_frames_fires_at_the_exact_microseconds():
    # ESIM's: ln((200 + .255) / (50 + .255)) = 1.38244 in 1000 µs, θ = .5: 361.7 and 723.4 µs.
    video = Video(np.array([[[50]], [[200]]], np.uint8), [0, 1000])
    options = {"interpolate": "none", "contrast_threshold_on": 0.5}
    assert continuous(video, simulator="esim", **options).t.tolist() == [361, 723]
    # Texvent's: α + I from 50 to 130, ln = .95551, δ = .3: 313.97, 627.94, 941.9 µs.
    video = Video(np.array([[[20]], [[100]]], np.uint8), [0, 1000])
    options = {"interpolate": "none", "contrast_threshold": 0.3, **LINES}
    events = continuous(video, simulator="texvent", noise="none", **options)
    assert (events.t.tolist(), events.p.tolist()) == ([313, 627, 941], [1, 1, 1])


def test_a_residual_is_carried_over_frames():
    # Facts, ramp B': .055 per frame, 20 frames, cache global: 5 events at 3.636, 7.273, ... frames.
    levels = 50 * np.exp(0.055 * np.arange(21)) - 30
    video = Video(levels[:, None, None].astype(np.float64), [1000 * k for k in range(21)])
    events = continuous(video, interpolate="none", cache="global", noise="none", **LINES)
    np.testing.assert_allclose(events.t / 1000, [3.636, 7.273, 10.909, 14.545, 18.182], atol=2e-3)
    with pytest.warns(texvent.TexventWarning, match="no events"):
        forgetful = continuous(video, interpolate="none", cache="local", noise="none", **LINES)
    assert len(forgetful) == 0


def test_a_blend_is_straight_in_intensity_not_in_brightness():
    # α + I = 50 + 250 τ; the k-th crossing is where it is 50 · e^(k/5). Pieces change by at most
    # a factor 1.5, on which a chord of the logarithm is off by less than 2 % of the interval.
    video = Video(np.array([[[20]], [[270]]], np.float32), [0, 100_000])
    events = continuous(video, interpolate="blend", noise="none", detect_cuts=False, **LINES)
    exact = [(50 * math.exp(0.2 * k) - 50) / 250 for k in range(1, 9)]
    np.testing.assert_allclose(events.t / 100_000, exact, atol=0.02)


@settings(max_examples=12)
@given(st.integers(0, 2**32), st.sampled_from(["flow", "blend"]))
def test_at_the_instants_of_the_frames_it_gives_the_events_of_the_frames(seed, interpolate):
    rng = np.random.default_rng(seed)
    frames = np.clip(90 + np.cumsum(rng.normal(0, 25, (3, 6, 8)), axis=0), 0, 255)
    video = Video(frames.astype(np.float32), [0, 1000, 1900])
    options = {"simulator": "esim", "interpolate": interpolate}
    wanted = EventStream.concat([packet for _, packet in readable(video, options)])
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(esim_simulator, "plan_segments", frame_instants)
        assert continuous(video, **options).equals(wanted.without_label())


def frame_instants(pair):
    """The segments between the intermediate frames of a pair, for all pixels."""
    return SegmentPlan(one_grid(pair.motion.positions), pair.edges_us[np.newaxis])


def test_there_is_a_packet_per_source_frame_within_its_pair():
    video = panning(4)
    _, simulator, pairs = plan(video, {"simulator": "esim", "engine": "continuous"})
    steps = [step for pair in pairs() for step in simulator.advance(pair)]
    assert [frame.t_us for frame, _ in steps] == list(video.times_us)
    assert len(steps[0][1]) == 0
    for (before, _), (frame, packet) in itertools.pairwise(steps):
        assert len(packet) > 200
        assert before.t_us <= packet.t[0] <= packet.t[-1] < frame.t_us


def test_it_comes_close_to_the_frames_engine_with_many_frames():
    video = panning(4)
    many = {"count": "fixed", "fixed_count": 40}
    fine = texvent.simulate(video, simulator="esim", **many)
    own = continuous(video, simulator="esim")
    assert len(own) == pytest.approx(len(fine), rel=0.03)
    assert abs(np.median(own.t) - np.median(fine.t)) < 500


def test_pieces_are_dyadic_and_last_at_least_a_microsecond():
    grids, edges = dyadic_segments(FrameInterval(100, 105, np.uint64(0)))
    assert grids.parts.tolist() == [1, 2, 4]
    assert edges.tolist() == [
        [100, 105, 105, 105, 105],
        [100, 103, 105, 105, 105],
        [100, 101, 103, 104, 105],
    ]
    np.testing.assert_allclose(grids.positions[2], [0.2, 0.6, 0.8, 1.0])


def test_noise_falls_on_dark_pixels_that_did_not_fire_and_has_its_rate():
    frames = np.full((25, 30, 40), 200, np.uint8)
    frames[:, :, :20] = 10
    video = Video(frames, [40_000 * k for k in range(25)])
    events = continuous(video, noise_rate_hz=5.0, label_noise=True, **LINES)
    assert events.x.max() < 20
    assert len(events) == pytest.approx(5 * 0.96 * 600, rel=0.1)
    assert (events.label == 1).all()


@pytest.mark.parametrize("cache", ["local", "leaky", "global"])
def test_the_cache_forgets_as_in_the_frames_engine(cache):
    options = {"interpolate": "none", "cache": cache, "noise": "none", **LINES}
    video = panning(6, step=0.4)
    frames, own = texvent.simulate(video, **options), continuous(video, **options)
    assert len(frames) > 50
    assert own.equals(frames)


def test_black_pixels_without_balance_are_refused():
    video = Video(np.zeros((2, 4, 4), np.uint8), [0, 1000])
    with pytest.raises(texvent.errors.ConfigError, match="balance is 0"):
        continuous(video, balance=0.0, **LINES)


@pytest.mark.parametrize("simulator", ["esim", "texvent"])
def test_after_a_reset_the_events_are_the_same_again(simulator):
    options = {"simulator": simulator, "noise": "none", **LINES} if simulator == "texvent" else {}
    _, model, pairs = plan(panning(3), {"simulator": simulator, "engine": "continuous", **options})
    once = [packet for pair in pairs() for _, packet in model.advance(pair)]
    model.reset()
    again = [packet for pair in pairs() for _, packet in model.advance(pair)]
    assert all(one.equals(other) for one, other in zip(once, again, strict=True))
