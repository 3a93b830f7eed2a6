import json
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from texvent.cli.app import main
from texvent.events import EventStream
from texvent.metrics.compare import load_metric
from texvent.sensor import SensorSize
from texvent_lab.bench.uncertainty import (
    LEAST_WINDOWS,
    Verdict,
    average_blocks,
    bootstrap_interval,
    independent_block_size,
    paired_differences,
    score_windows,
)

VALUES = arrays.arrays(np.float64, st.integers(6, 20), elements=st.floats(-5, 5, width=32))


@pytest.mark.parametrize("count", [6, 16])
def test_95_of_100_intervals_hold_the_true_mean_of_few_normal_values(count):
    rng = np.random.default_rng(5)
    intervals = [bootstrap_interval(rng.normal(1.0, 2.0, count), seed=seed) for seed in range(300)]
    held = np.mean([low <= 1.0 <= high for low, high in intervals])
    # Three standard errors of 300 experiments are 0.038.
    assert 0.91 <= held <= 0.985


@given(VALUES, st.floats(-3, 3))
def test_the_interval_moves_with_the_values_and_holds_their_mean(values, shift):
    low, high = bootstrap_interval(values)
    assert low - 1e-9 <= values.mean() <= high + 1e-9
    assert bootstrap_interval(values) == (low, high)
    assert bootstrap_interval(values + shift) == pytest.approx((low + shift, high + shift))
    assert bootstrap_interval(-values) == pytest.approx((-high, -low))


def test_blocks_are_means_of_the_windows_that_are_defined():
    blocks = average_blocks([1.0, 3.0, math.nan, 5.0, 7.0, math.nan, math.nan], 2)
    # Seven windows make three blocks, the first of three.
    assert blocks[:2].tolist() == [2.0, 6.0]
    assert math.isnan(blocks[2])
    assert len(blocks) == 3
    assert average_blocks([1.0, math.nan], 1)[0] == 1.0
    assert len(average_blocks([1.0, 2.0, 3.0], 4)) == 0


def test_windows_that_follow_each_other_are_averaged_and_others_are_not():
    rng = np.random.default_rng(1)
    assert independent_block_size(rng.normal(size=64)) == 1
    assert independent_block_size([0.1] * 64) == 1
    # Each value four times: neighbours are equal until four make one block.
    assert independent_block_size(np.repeat(rng.normal(size=32), 4)) == 4
    # A drift never ends: the blocks run out.
    assert 16 // independent_block_size(np.arange(16.0)) < LEAST_WINDOWS


PAIRS = arrays.arrays(
    np.float64, st.tuples(st.just(2), st.integers(6, 10)), elements=st.floats(0, 1, width=16)
)


def difference(first, second, **options):
    column = np.subtract(first, second)
    return paired_differences({"it": column}, **{"is_in_sequence": False, **options})["it"]


def sentence(first, second, found, better="lower", unit=""):
    return Verdict("it", first, second, found, better, unit).sentence


def test_identical_candidates_do_not_differ():
    found = difference([0.5, 0.6, 0.7, 0.5, 0.4, 0.6], [0.5, 0.6, 0.7, 0.5, 0.4, 0.6])
    assert (found.mean, found.interval) == (0.0, (0.0, 0.0))
    assert sentence("A", "B", found) == (
        "A and B do not differ significantly (difference 0.000, 95 % interval 0.000 to 0.000, "
        "6 windows)"
    )


def test_a_constant_advantage_over_eight_windows_is_significant():
    found = difference([0.75] * 8, [0.5] * 8)
    assert (found.mean, found.interval) == (0.25, (0.25, 0.25))
    text = "is closer than {} by 0.250 ms (95 % interval 0.250 to 0.250, 8 windows)"
    higher = sentence("A", "B", found, better="higher", unit="ms")
    assert higher == f"A {text.format('B')}"
    assert sentence("A", "B", found, unit="ms") == f"B {text.format('A')}"


@given(PAIRS)
def test_the_order_of_candidates_only_flips_signs(pair):
    found, other = difference(*pair), difference(*pair[::-1])
    assert other.mean == pytest.approx(-found.mean)
    assert other.interval == pytest.approx(found.reversed().interval)
    assert found.is_significant == other.is_significant
    if found.is_significant:
        assert sentence("A", "B", found) == sentence("B", "A", other)


def test_more_comparisons_widen_the_interval_and_equals_rarely_differ():
    rng = np.random.default_rng(4)
    tables = rng.normal(size=(60, 12, 16))
    alone = wrong = 0
    for table in tables:
        columns = dict(enumerate(table))
        found = paired_differences(columns, is_in_sequence=False)
        wrong += any(one.is_significant for one in found.values())
        single = bootstrap_interval(table[0])
        alone += single.low > 0 or single.high < 0
        assert found[0].interval.low <= single.low <= single.high <= found[0].interval.high
    assert alone <= 8
    assert wrong <= 8


def test_windows_that_drift_count_by_blocks_of_which_too_few_are_left():
    drift = np.arange(16.0)
    assert difference(drift, 0 * drift).is_significant
    found = difference(drift, 0 * drift, is_in_sequence=True)
    assert (found.windows, found.block, found.is_significant) == (4, 4, False)
    assert "too few independent windows to compare (n = 4;" in sentence("A", "B", found)


def test_undefined_windows_are_left_out():
    found = difference([1.0, math.nan, 3, 4, 5, 6, 7], [0.0] * 7)
    assert (found.mean, found.windows) == (26 / 6, 6)
    nothing = difference([math.nan] * 7, [0.0] * 7)
    assert math.isnan(nothing.mean)
    assert not nothing.is_enough


SIZE = SensorSize(8, 6)


def stream(times_us):
    times_us = np.asarray(times_us)
    return EventStream(times_us % 8, times_us % 6, times_us, times_us % 2, SIZE)


TRUTH = stream(np.arange(70_000, 1_010_000, 1_000))


def windows_of(candidates, *metrics, reference=TRUTH, **options):
    return score_windows(candidates, reference, list(map(load_metric, metrics)), **options)


def test_windows_are_whole_and_begin_at_multiples_of_stpps_window():
    scores = windows_of({"a": TRUTH}, "stpp")
    assert scores.window_us == 100_000
    assert scores.starts_us == list(range(100_000, 900_001, 100_000))
    assert scores.values["stpp", "a"].tolist() == [1.0] * 9


def test_long_recordings_get_longer_windows():
    scores = windows_of({"a": TRUTH}, "count_ratio", reference=stream(range(0, 20_000_000, 10_000)))
    assert scores.window_us == 400_000
    assert len(scores.starts_us) <= 50


def test_a_window_is_scored_as_if_it_were_all():
    late = stream(TRUTH.t + 3_000)
    scores = windows_of({"late": late}, "nearest", window_us=200_000)
    nearest = load_metric("nearest")
    for start, value in zip(scores.starts_us, scores.values["nearest", "late"], strict=True):
        stop = start + 200_000
        assert value == nearest(late.between(start, stop), TRUTH.between(start, stop))


def test_metrics_that_are_good_near_one_are_compared_by_their_distance_from_one():
    half, double = TRUTH[::2], stream(np.repeat(TRUTH.t, 2))
    (verdict,) = windows_of({"half": half, "double": double}, "count_ratio").verdicts()
    assert verdict.difference.mean == pytest.approx(0.5 - 1.0)
    assert verdict.closer == "half"
    assert verdict.sentence.startswith("half is closer than double by 0.500 (")


def test_infinite_and_undefined_windows_are_left_out():
    scores = windows_of({"a": TRUTH}, "ef_psnr", "ef_ssim")
    assert np.isnan(scores.values["ef_psnr", "a"]).all()  # equal frames: infinite
    assert scores.mean("ef_ssim", "a").windows == 0  # a side below 11 px


@pytest.fixture
def candidates(tmp_path, monkeypatch):
    """A truth of 1.2 s, a candidate that is 1 ms late, and one that is 4 ms late."""
    monkeypatch.chdir(tmp_path)
    rng = np.random.default_rng(0)
    size = SensorSize(16, 10)
    t = np.sort(rng.integers(0, 1_250_000, 6000))
    t[0] = 0
    x, y, p = rng.integers(0, 16, 6000), rng.integers(0, 10, 6000), rng.integers(0, 2, 6000)
    for name, late_us in (("truth", 0), ("near", 1_000), ("far", 4_000)):
        EventStream(x, y, t + late_us, p, size).save(f"{name}.npz")


def test_event_files_are_compared_by_windows_in_words(candidates, capsys):
    words = ["bench", "closer", "near.npz", "far.npz", "truth.npz", "--metrics", "nearest,ef_ssim"]
    assert main(words) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "nearest: near.npz is closer than far.npz by" in shown
    assert "12 windows of 0.1 s" in shown
    assert "undefined" in shown
    assert main([*words, "--json", "--window", "0.2"]) == 0
    document = json.loads(capsys.readouterr().out)
    nearest = document["differences"][0]
    assert (nearest["metric"], nearest["closer"]) == ("nearest", "near.npz")
    means = [document["means"][name]["nearest"] for name in ("near.npz", "far.npz")]
    assert nearest["mean"] == pytest.approx(np.mean(np.subtract(*(one["values"] for one in means))))
    assert nearest["high"] < 0
    assert document["windows"]["starts_us"] == list(range(0, 1_200_000, 200_000))
    assert all(one["low"] < one["mean"] < one["high"] for one in means)
