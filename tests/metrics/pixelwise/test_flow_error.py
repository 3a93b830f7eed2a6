"""Errors of optical flow: cases by hand, a slow reference, properties."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

from texvent.metrics.dense_errors import FlowError

FLOWS = arrays(np.float64, (2, 3, 4), elements=st.floats(-50, 50, width=32))


def errors(
    predicted: NDArray[np.floating], true: NDArray[np.floating], *masks: NDArray[np.bool_]
) -> dict[str, float]:
    error = FlowError()
    error.update(predicted, true, *masks)
    return error.compute()


def slow_errors(predicted: NDArray[np.float64], true: NDArray[np.float64]) -> dict[str, float]:
    distances, angles = [], []
    for (x1, y1), (x2, y2) in zip(predicted.reshape(2, -1).T, true.reshape(2, -1).T, strict=True):
        distances.append(math.dist((x1, y1), (x2, y2)))
        one, two = np.array((x1, y1, 1)), np.array((x2, y2, 1))
        cosine = one @ two / math.sqrt((one @ one) * (two @ two))
        angles.append(math.degrees(math.acos(min(1.0, max(-1.0, cosine)))))
    found = {f"{n}PE": 100 * sum(d > n for d in distances) / len(distances) for n in (1, 2, 3)}
    return {"EPE": sum(distances) / len(distances), "AE": sum(angles) / len(angles), **found}


def test_four_pixels_by_hand() -> None:
    true = np.zeros((2, 2, 2))
    predicted = np.zeros((2, 2, 2))
    predicted[0] = [[0, 1], [3, 0]]
    predicted[1] = [[0, 0], [4, 0]]
    assert errors(predicted, true) == pytest.approx(
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
    found = errors(predicted, true, mask)
    assert (found["EPE"], found["2PE"], found["3PE"]) == (2.5, 100, 0)


def test_pixels_of_all_images_count_the_same() -> None:
    error = FlowError()
    error.update(np.full((2, 1, 3), 0.0), np.zeros((2, 1, 3)))
    error.update(np.array([[[4.0]], [[0.0]]]), np.zeros((2, 1, 1)))
    assert error.compute()["EPE"] == 1


@given(FLOWS, FLOWS)
def test_errors_are_those_of_the_slow_reference(
    predicted: NDArray[np.float64], true: NDArray[np.float64]
) -> None:
    # The reference's arc cosine knows small angles to 1e-6 degrees only.
    assert errors(predicted, true) == pytest.approx(slow_errors(predicted, true), abs=1e-5)
