"""Errors of depth and optical flow: cases by hand, and what does not count."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.typing import NDArray

from texvent_lab.train.dense_errors import DepthError, FlowError


def errors(
    kind: type[DepthError] | type[FlowError], predicted: NDArray[np.floating],
    true: NDArray[np.floating], *masks: NDArray[np.bool_],
) -> dict[str, float]:  # fmt: skip
    error = kind()
    error.update(predicted, true, *masks)
    return error.compute()


def test_depth_of_two_pixels_by_hand() -> None:
    found = errors(DepthError, np.array([[5.0, 30.0]]), np.array([[10.0, 20.0]]))
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
    assert errors(DepthError, np.full((1, 6), 12.0), true, mask)["abs_rel"] == pytest.approx(0.2)


def test_images_count_the_same_and_empty_ones_do_not() -> None:
    error = DepthError()
    error.update(np.full((1, 5), 10.0), np.full((1, 5), 10.0))
    error.update(np.full((1, 1), 20.0), np.full((1, 1), 10.0))
    error.update(np.full((1, 1), 20.0), np.full((1, 1), np.inf))
    assert error.compute()["abs_rel"] == 0.5


def test_a_prediction_beyond_the_farthest_depth_counts_as_that_depth() -> None:
    assert errors(DepthError, np.array([[500.0]]), np.array([[40.0]]))["abs_rel"] == 1


def test_flow_of_four_pixels_by_hand() -> None:
    true = np.zeros((2, 2, 2))
    predicted = np.zeros((2, 2, 2))
    predicted[0] = [[0, 1], [3, 0]]
    predicted[1] = [[0, 0], [4, 0]]
    assert errors(FlowError, predicted, true) == pytest.approx(
        {
            "EPE": (0 + 1 + 5 + 0) / 4,
            "AE": (45 + math.degrees(math.atan(5))) / 4,
            "1PE": 25,  # an error of exactly 1 px is none
            "2PE": 25,
            "3PE": 25,
        }
    )


def test_unknown_and_masked_pixels_do_not_count() -> None:
    true = np.zeros((2, 1, 3))
    true[1, 0, 1] = np.nan
    predicted = np.array([[[2.5, 100, 7]], [[0, 0, 0]]])
    mask = np.array([[True, True, False]])
    found = errors(FlowError, predicted, true, mask)
    assert (found["EPE"], found["2PE"], found["3PE"]) == (2.5, 100, 0)


def test_pixels_of_all_images_count_the_same() -> None:
    error = FlowError()
    error.update(np.full((2, 1, 3), 0.0), np.zeros((2, 1, 3)))
    error.update(np.array([[[4.0]], [[0.0]]]), np.zeros((2, 1, 1)))
    assert error.compute()["EPE"] == 1
