"""Pairs whose frames are not drawn give the events of the drawn frames, bit for bit."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

import texvent
from texvent.frames import Video
from texvent.simulation.fused import candidates

from .clips import fused, panning, readable

OPTIONS = {
    "default": {},
    "the paper's": {"preset": "paper"},
    "without noise": {"noise": "none"},
    "noise anywhere": {"noise": "random"},
    "global cache": {"preset": "paper", "cache": "global"},
    "decay": {"residual_decay_hz": 3.0},
    "random times": {"timestamp_rule": "random"},
    "many events": {"multi_event": True, "contrast_threshold": 0.06},
    "times at the end": {"timestamp_rule": "end"},
    "ESIM": {"simulator": "esim"},
    "two thresholds": {
        "simulator": "esim", "contrast_threshold_on": 0.1, "contrast_threshold_off": 0.3,
    },
    "refractory": {
        "simulator": "esim", "refractory_period_us": 9000, "contrast_threshold_on": 0.05,
    },
}  # fmt: skip


def assert_equal(video, **options):
    wanted, got = readable(video, options), fused(video, options)
    assert [frame.t_us for frame, _ in got] == [frame.t_us for frame, _ in wanted]
    for (frame, packet), (true_frame, true_packet) in zip(got, wanted, strict=True):
        assert packet.equals(true_packet)
        assert (frame.size, frame.is_source) == (true_frame.size, true_frame.is_source)
        np.testing.assert_array_equal(frame.luma, true_frame.luma)
    return sum(len(packet) for _, packet in got)


def mixed_clips():
    """Pairs that move, brighten, do both or neither, next to each other: fused or stepped each."""
    p = np.clip(panning(5, dtype=np.float32).pixels, 0, 220)
    gains = [p[0], p[1], 1.15 * p[1], 1.15 * p[2], 1.15 * p[3], p[3], p[4]]
    steps = [p[0], p[1], p[1] + 0.5, p[1] + 12, p[2], p[2] + 9, p[3], p[4]]
    deep = [np.round(257 * one).astype(np.uint16) for one in steps]
    for frames in (gains, deep):
        yield Video(np.stack(frames), [1000 + 40_000 * index for index in range(len(frames))])


@pytest.mark.parametrize("options", OPTIONS.values(), ids=OPTIONS)
def test_pairs_give_the_same_events_drawn_or_not(options):
    if "simulator" not in options and options.get("noise") != "none":
        options = {"noise_rate_hz": 20.0, "seed": 3, **options}
    for video in mixed_clips():
        assert assert_equal(video, max_intermediate=5, **options) > 300


@pytest.mark.parametrize("simulator", ["texvent", "esim"])
def test_cuts_pairs_without_intermediate_frames_and_short_pairs_are_the_same_too(simulator):
    moving = panning(3, size=(64, 64)).pixels
    other = np.random.default_rng(0).integers(0, 255, (64, 64), np.uint8)
    frames = np.stack([moving[0], moving[0], moving[1], other, other, moving[2]])
    video = Video(frames, [0, 10, 40_000, 80_000, 80_003, 80_004])
    assert_equal(video, simulator=simulator, max_intermediate=9)


@examples(15)
@given(st.integers(0, 2**32), st.sampled_from(["texvent", "esim"]), st.floats(0, 40))
def test_any_frames_give_the_same_events(seed, simulator, spread):
    rng = np.random.default_rng(seed)
    frames = np.clip(90 + np.cumsum(rng.normal(0, spread, (4, 5, 9)), axis=0), 0, 255)
    video = Video(frames.astype(np.float32), [0, 1000, 1007, 5000])
    assert_equal(video, simulator=simulator, seed=seed % 1000, max_intermediate=9)


@pytest.mark.parametrize(
    ("options", "is_tried"),
    [
        ({}, True),
        ({"preset": "paper"}, True),
        ({"simulator": "esim"}, True),
        ({"interpolate": "blend"}, False),
        ({"interpolate": "none", "simulator": "esim"}, False),
        ({"noise": "gaussian"}, False),
        ({"cache": "none"}, False),
        ({"simulator": "esim", "threshold_sigma": 0.03}, False),
    ],
)
def test_a_pair_is_not_drawn_where_it_can_be_fused(options, is_tried, monkeypatch):
    bounded = []
    whole = candidates.bound_pair
    monkeypatch.setattr(candidates, "bound_pair", lambda pair: bounded.append(1) or whole(pair))
    texvent.simulate(panning(3), **options)
    assert bool(bounded) is is_tried
