"""Worked values, slow twins and properties of the paired metrics."""

import math

import numpy as np
import pytest
from hypothesis import given, settings

from texvent._registry import METRICS
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.metrics.compare import compare, describe_metrics
from texvent.metrics.count_statistics import ActiveIou, CountRatio, OnDifference
from texvent.metrics.event_frames import EventFrameMse, EventFramePsnr, EventFrameSsim
from texvent.metrics.spike_trains import NearestTime, VanRossum
from texvent.metrics.stpp import Stpp
from texvent.sensor import SensorSize

from . import slow
from .recordings import SMALL, TOY, one_beat, one_event, random_events, streams

WANTING = ("ef_lpips", "eqs")
"""Metrics of trained networks, whose weights no test may count on; they have tests of their own."""
EVERY_METRIC = [name for name in METRICS.names() if name not in WANTING]
"""Parameters of the tests below: a new metric is tested the moment it is registered."""


@pytest.fixture(autouse=True)
def _without_weights(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))


@pytest.mark.parametrize(
    ("other", "expected"),
    [
        (one_event(), 1.0),
        (one_event(63, 63), 1 / 6),
        (one_event(t=26_000), 0.2),
        (one_event(p=0), 0.0),
        (one_event(count=2), 0.5),
        (one_event(x=1), 1.0),
        (one_event(x=2), 29 / 30 * 1.0 - 4 / 30),
    ],
    ids=["same", "far corner", "25 ms later", "other polarity", "twice", "same cell", "next cell"],
)
def test_stpp_of_one_event_pairs_is_as_worked_by_hand(other, expected):
    assert Stpp()(other, one_event()) == pytest.approx(expected)


def test_stpp_weighs_windows_by_their_events():
    # Window 0: 1 against 1, equal. Window 2: 3 against 0, nothing in common.
    a = EventStream([0] * 4, [0] * 4, [10, 100_000, 100_001, 100_002], [1] * 4, SMALL)
    assert Stpp()(a, a[:1]) == pytest.approx((2 * 1 + 3 * 0) / 5)


@pytest.mark.parametrize(("delay_us", "expected"), [(1250, 0.2212), (5000, 0.6321)])
def test_van_rossum_of_a_delayed_event_is_one_minus_its_decay(delay_us, expected):
    value = VanRossum()(one_event(t=1000 + delay_us), one_event())
    assert value == pytest.approx(1 - math.exp(-delay_us / 5000))
    assert value == pytest.approx(expected, abs=5e-5)


def test_van_rossum_counts_other_pixels_and_polarities_as_missing():
    assert VanRossum()(one_event(x=1), one_event()) == pytest.approx(1.0)
    assert VanRossum()(one_event(p=0), one_event()) == pytest.approx(1.0)
    # One of two coinciding events missing: (2 − 1)² / (2² + 1²).
    assert VanRossum()(one_event(count=2), one_event()) == pytest.approx(0.2)


@pytest.mark.parametrize(("delay_us", "expected_ms"), [(5000, 5.0), (20_000, 10.0)])
def test_nearest_time_is_capped_at_ten_ms(delay_us, expected_ms):
    assert NearestTime()(one_event(t=1000 + delay_us), one_event()) == pytest.approx(expected_ms)


def test_nearest_time_of_an_empty_stream_is_the_cap_and_of_two_undefined():
    nothing = EventStream.empty(one_event().size)
    assert NearestTime()(nothing, one_event()) == pytest.approx(10.0)
    assert NearestTime()(one_event(), nothing) == pytest.approx(10.0)
    assert math.isnan(NearestTime()(nothing, nothing))


def test_event_frame_values_of_one_event():
    # One of 64 · 64 pixels: 0 instead of 1, and 0.5 instead of 1.
    assert EventFrameMse()(one_event(p=0), one_event()) == pytest.approx(1 / 4096)
    nothing = EventStream.empty(one_event().size)
    assert EventFrameMse()(nothing, one_event()) == pytest.approx(0.25 / 4096)
    assert EventFramePsnr()(nothing, one_event()) == pytest.approx(-10 * math.log10(0.25 / 4096))
    assert EventFramePsnr()(one_event(), one_event()) == math.inf


def test_event_frames_without_events_count_as_equal():
    # Frames 0 and 24 hold one event each, the 23 between them none.
    a = EventStream([0, 0], [0, 0], [0, 1_000_000], [1, 1], SMALL)
    b = EventStream([0, 0], [0, 0], [0, 1_000_000], [1, 0], SMALL)
    assert EventFrameMse()(a, b) == pytest.approx(1 / (13 * 12) / 25)
    one_frame = EventFrameSsim()(b[1:], a[1:])
    assert EventFrameSsim()(a, b) == pytest.approx((24 + one_frame) / 25)


def test_marginals_are_as_counted_by_hand():
    a = EventStream([0, 1, 1, 2], [0, 0, 0, 0], [1, 2, 3, 4], [1, 1, 1, 0], SMALL)
    b = EventStream([1, 2], [0, 0], [1, 2], [1, 0], SMALL)
    assert CountRatio()(a, b) == 2.0
    assert OnDifference()(a, b) == 0.25
    assert ActiveIou()(a, b) == pytest.approx(2 / 3)


@pytest.mark.parametrize("seed", [0, 1])
def test_metrics_agree_with_their_slow_twins(seed):
    a, b = random_events(2 * seed, 300), random_events(2 * seed + 1, 400)
    assert Stpp().levels(a, b) == pytest.approx(slow.stpp_levels(a, b))
    assert NearestTime()(a, b) == pytest.approx(slow.nearest_ms(a, b))
    assert EventFrameMse()(a, b) == pytest.approx(slow.ef_mse(a, b))
    similarities = [slow.ssim(one, two) for one, two in slow.frame_pairs(a, b, 24)]
    assert EventFrameSsim()(a, b) == pytest.approx(np.mean(similarities))


def test_van_rossum_agrees_with_sampled_traces():
    a, b = random_events(5, 60, SensorSize(2, 2)), random_events(6, 50, SensorSize(2, 2))
    # 400 samples per τ leave an error of this order.
    assert VanRossum()(a, b) == pytest.approx(slow.van_rossum(a, b), rel=5e-3)


@pytest.mark.parametrize("name", EVERY_METRIC)
@given(a=streams(), b=streams())
@settings(max_examples=12)
def test_values_are_symmetric_and_in_range_or_undefined(name, a, b):
    metric = describe_metrics()[name]
    value, mirrored = metric(a, b), metric(b, a)
    if not math.isnan(value):
        low, high = metric.range
        assert low - 1e-9 <= value <= high + 1e-9
    if metric.better == "one":
        return  # these say in which direction they differ
    assert value == pytest.approx(mirrored, nan_ok=True, abs=1e-6)


@pytest.mark.parametrize("name", EVERY_METRIC)
@given(a=streams(least=1))
@settings(max_examples=8)
def test_a_stream_scores_best_against_itself(name, a):
    metric = describe_metrics()[name]
    best = {"lower": metric.range[0], "higher": metric.range[1], "one": 1.0}[metric.better]
    value = metric(a, a)
    assert math.isnan(value) or value == pytest.approx(best, abs=1e-9)


@pytest.mark.parametrize("name", EVERY_METRIC)
def test_a_busy_stream_has_a_defined_value_that_is_worse_against_another(name):
    metric = describe_metrics()[name]
    a, b = random_events(1, 4000, TOY), one_beat(random_events(2, 3000, TOY))
    to_itself, to_other = metric(a, a), metric(a, b)
    assert not math.isnan(to_itself)
    assert not math.isnan(to_other)
    assert to_itself != to_other


@pytest.mark.parametrize("name", ["stpp", "ef_mse", "nearest", "van_rossum"])
def test_recordings_with_epoch_times_do_not_overflow(name):
    metric = describe_metrics()[name]
    a, b = random_events(1), random_events(2)
    # A whole number of seconds keeps every window where it was.
    later = [
        EventStream(one.x, one.y, one.t + 1_700_000_000_000_000, one.p, SMALL) for one in (a, b)
    ]
    assert metric(*later) == pytest.approx(metric(a, b))


def test_compare_cuts_both_streams_to_the_span():
    a = EventStream([0, 1], [0, 0], [100, 900], [1, 1], SMALL)
    b = EventStream([0, 5], [0, 5], [100, 950], [1, 0], SMALL)
    assert compare(a, b, ["stpp"], span_us=(0, 500)) == {"stpp": 1.0}
    assert compare(a, b, ["stpp"])["stpp"] < 1.0


def test_compare_runs_every_metric_that_lacks_nothing_by_default():
    assert set(compare(random_events(1), random_events(2))) == set(EVERY_METRIC)


def test_metrics_without_their_weights_say_what_they_need():
    missing = {name: metric.missing() for name, metric in describe_metrics().items()}
    assert {name for name, reason in missing.items() if reason} == set(WANTING)
    assert "texvent weights pull lpips" in missing["ef_lpips"]
    assert "--rvt-weights" in missing["eqs"]
    with pytest.raises(InputError, match="texvent weights pull lpips"):
        compare(one_event(), one_event(), ["ef_lpips"])


def test_compare_refuses_other_sensors_unknown_metrics_and_an_empty_span():
    with pytest.raises(InputError, match="13x12 sensor with a 64x64"):
        compare(random_events(1), one_event(), ["stpp"])
    with pytest.raises(ConfigError, match="did you mean 'stpp'"):
        compare(one_event(), one_event(), ["stp"])
    with pytest.raises(ConfigError, match="stop must come after"):
        compare(one_event(), one_event(), span_us=(5, 5))
