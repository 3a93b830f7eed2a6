"""Errors of depth: cases by hand, a slow reference, properties."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from texvent.metrics.dense_errors import DepthError

DEPTHS = arrays(np.float64, (3, 4), elements=st.floats(0.5, 79, width=32))


def errors(
    predicted: NDArray[np.floating], true: NDArray[np.floating], *masks: NDArray[np.bool_]
) -> dict[str, float]:
    error = DepthError()
    error.update(predicted, true, *masks)
    return error.compute()


def slow_errors(predicted: NDArray[np.float64], true: NDArray[np.float64]) -> dict[str, float]:
    pairs = list(zip(predicted.ravel().tolist(), true.ravel().tolist(), strict=True))
    n, logs = len(pairs), [math.log(p) - math.log(d) for p, d in pairs]
    found = {
        "abs_rel": sum(abs(p - d) / d for p, d in pairs) / n,
        "sq_rel": sum((p - d) ** 2 / d**2 for p, d in pairs) / n,
        "RMS": math.sqrt(sum((p - d) ** 2 for p, d in pairs) / n),
        "RMS_log": math.sqrt(sum(e * e for e in logs) / n),
        "SILog": sum(e * e for e in logs) / n - (sum(logs) / n) ** 2,
    }
    for k in (1, 2, 3):
        found[f"delta{k}"] = sum(max(p / d, d / p) < 1.25**k for p, d in pairs) / n
    for limit in (10, 20, 30):
        near = [abs(p - d) for p, d in pairs if d < limit]
        found[f"mean_{limit}m"] = sum(near) / len(near) if near else math.nan
    return found


def test_two_pixels_by_hand() -> None:
    found = errors(np.array([[5.0, 30.0]]), np.array([[10.0, 20.0]]))
    assert found == pytest.approx(
        {
            "abs_rel": 0.5,
            "sq_rel": 0.25,
            "RMS": math.sqrt((25 + 100) / 2),
            "RMS_log": math.sqrt((math.log(2) ** 2 + math.log(1.5) ** 2) / 2),
            "SILog": ((math.log(2) + math.log(1.5)) / 2) ** 2,
            "delta1": 0,
            "delta2": 0.5,  # 1.5 < 1.5625
            "delta3": 0.5,
            "mean_10m": math.nan,  # 10 m is not nearer than 10 m
            "mean_20m": 5,
            "mean_30m": 7.5,
        },
        nan_ok=True,
    )


def test_sky_unknown_and_masked_pixels_do_not_count() -> None:
    true = np.array([[10.0, np.inf, np.nan, 0.0, 80.0, 10.0]])
    mask = np.array([[True] * 5 + [False]])
    assert errors(np.full((1, 6), 12.0), true, mask)["abs_rel"] == pytest.approx(0.2)


def test_images_count_the_same_and_empty_ones_do_not() -> None:
    error = DepthError()
    error.update(np.full((1, 5), 10.0), np.full((1, 5), 10.0))
    error.update(np.full((1, 1), 20.0), np.full((1, 1), 10.0))
    error.update(np.full((1, 1), 20.0), np.full((1, 1), np.inf))
    assert error.compute()["abs_rel"] == 0.5


def test_a_prediction_beyond_the_farthest_depth_counts_as_that_depth() -> None:
    assert errors(np.array([[500.0]]), np.array([[40.0]]))["abs_rel"] == 1


@given(DEPTHS, DEPTHS)
def test_errors_are_those_of_the_slow_reference(
    predicted: NDArray[np.float64], true: NDArray[np.float64]
) -> None:
    expected = slow_errors(predicted, true)
    assert errors(predicted, true) == pytest.approx(expected, abs=1e-9, nan_ok=True)


@given(DEPTHS, st.floats(0.1, 1))
def test_a_scale_changes_no_scale_invariant_error(true: NDArray[np.float64], scale: float) -> None:
    assert errors(scale * true, true)["SILog"] == pytest.approx(0, abs=1e-12)
