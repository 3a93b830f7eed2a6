import numpy as np
import pytest

from texvent.events import EventStream
from texvent.metrics.compare import load_metric
from texvent.metrics.uncertainty import score_windows
from texvent.sensor import SensorSize

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
