"""Worked values, slow twins and properties of the paired metrics."""

import dataclasses
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from tests.examples import examples

from texvent._registry import METRICS
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.metrics.compare import compare, describe_metrics
from texvent.metrics.protocol import bin_index
from texvent.sensor import SensorSize

from . import slow
from .recordings import SMALL, one_beat, one_event, random_events, streams

WANTING = ("ef_lpips", "eqs")
"""Metrics of trained networks, whose weights no test may count on; they have tests of their own."""
EVERY_METRIC = [name for name in METRICS.names() if name not in WANTING]
"""Parameters of the tests below: a new metric is tested the moment it is registered."""


@given(
    times=st.lists(st.integers(-(2**52), 2**52), min_size=1, max_size=9),
    rate=st.fractions(Fraction(1, 100), 10**6, max_denominator=1001),
)
def test_the_bin_of_a_time_is_that_of_exact_fractions(times, rate):
    found = bin_index(np.array(times, np.int64), rate)
    assert found.tolist() == [math.floor(Fraction(t) * rate / 10**6) for t in times]


@pytest.fixture(autouse=True)
def _without_weights(tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))


@pytest.mark.parametrize("name", EVERY_METRIC)
@given(a=streams(), b=streams())
@example(a=EventStream.empty(SMALL), b=random_events(1, 9))
@example(a=random_events(1, 9), b=EventStream.empty(SMALL))
@example(a=EventStream.empty(SMALL), b=EventStream.empty(SMALL))
@example(a=EventStream([0], [0], [100_000], [1], SMALL), b=EventStream([1], [0], [0], [1], SMALL))
def test_every_metric_equals_its_definition(name, a, b):
    found = describe_metrics()[name](a, b)
    assert found == pytest.approx(slow.DEFINITIONS[name](a, b), rel=1e-6, abs=1e-9, nan_ok=True)


@pytest.mark.parametrize("name", EVERY_METRIC)
def test_every_metric_of_busy_streams_equals_its_definition(name):
    a, b = random_events(1, 300), random_events(2, 400)
    found = describe_metrics()[name](a, b)
    assert found == pytest.approx(slow.DEFINITIONS[name](a, b), rel=1e-6)


@pytest.mark.parametrize("name", EVERY_METRIC)
def test_every_parameter_of_a_metric_counts(name):
    usual = describe_metrics()[name]
    a, b = random_events(1, 300), random_events(2, 400)
    numbers = {name: one for name, one in vars(usual).items() if not callable(one)}
    for parameter, one in numbers.items():
        assert dataclasses.replace(usual, **{parameter: 3 * one})(a, b) != usual(a, b), parameter


DIVISIBLE = SensorSize(96, 96)
"""By cells of STPP and patches of LFS, which then lie symmetrically."""


def shuffled(events):
    """The same, those of one instant in another order."""
    order = np.lexsort((np.random.default_rng(3).random(len(events)), events.t))
    return events[order]


@pytest.mark.parametrize("name", EVERY_METRIC)
@pytest.mark.parametrize(
    "change",
    [
        lambda one: EventStream(one.x, one.y, one.t + 1_700_000_000_000_000, one.p, one.size),
        lambda one: one.flip("x"),
        lambda one: one.flip("y"),
        lambda one: one.rotate(90),
        lambda one: one[np.repeat(np.arange(len(one)), 2)],
        shuffled,
    ],
    ids=["at clock times", "mirrored", "upside down", "turned", "each twice", "ties shuffled"],
)
def test_what_happens_to_both_streams_changes_no_value(name, change):
    metric = describe_metrics()[name]
    a, b = (one_beat(random_events(seed, 800, DIVISIBLE), 1000) for seed in (1, 2))
    assert metric(change(a), change(b)) == pytest.approx(metric(a, b), rel=1e-6)


@pytest.mark.parametrize("name", EVERY_METRIC)
@given(a=streams(), b=streams())
@examples(12)
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
@examples(8)
def test_a_stream_scores_best_against_itself(name, a):
    metric = describe_metrics()[name]
    best = {"lower": metric.range[0], "higher": metric.range[1], "one": 1.0}[metric.better]
    value = metric(a, a)
    assert math.isnan(value) or value == pytest.approx(best, abs=1e-9)


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
