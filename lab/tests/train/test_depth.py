"""Losses and code of depth: cases by hand, a slow reference, properties."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.typing import NDArray

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.depth import (  # noqa: E402
    decode_depth,
    encode_depth,
    gradient_loss,
    scale_invariant_loss,
)

pytestmark = pytest.mark.torch
CODES = arrays(np.float64, (2, 1, 8, 16), elements=st.floats(0, 1))


def slow_gradient_loss(predicted: NDArray[np.float64], target: NDArray[np.float64]) -> float:
    """Pixel by pixel, as the docstring says."""
    sobel = np.array([[-1, 0, 1], [-2, 0, 2], [-1, 0, 1]]) / 8
    error = np.where(np.isnan(target), 0, predicted - np.nan_to_num(target))
    total = 0.0
    for side in (1, 2, 4, 8):
        for image in error[:, 0]:
            rows, columns = image.shape[0] // side, image.shape[1] // side
            coarse = image.reshape(rows, side, columns, side).mean(axis=(1, 3))
            for kernel in (sobel, sobel.T):
                found = 0.0
                for row in range(rows):
                    for column in range(columns):
                        value = 0.0
                        for i in range(3):
                            for j in range(3):
                                r = min(max(row + i - 1, 0), rows - 1)
                                c = min(max(column + j - 1, 0), columns - 1)
                                value += kernel[i, j] * coarse[r, c]
                        found += abs(value)
                total += found / (rows * columns)
    return total / len(error) / 4


def test_depth_is_coded_as_published() -> None:
    metres = torch.tensor([0.0, 1.9, 80 * math.exp(-3.70378 / 2), 80, 500, math.inf, math.nan])
    assert encode_depth(metres).tolist() == pytest.approx(
        [0, 0, 0.5, 1, 1, 1, math.nan], nan_ok=True
    )
    assert decode_depth(0.0) == pytest.approx(1.97, abs=0.005)


@given(st.floats(1.98, 80))
def test_decoding_undoes_the_code(metres: float) -> None:
    code = encode_depth(torch.tensor(metres, dtype=torch.float64))
    assert float(decode_depth(code)) == pytest.approx(metres)


def test_scale_invariant_loss_by_hand() -> None:
    predicted = torch.tensor([0.1, 0.5, 0.9])
    target = torch.tensor([0.0, 0.2, math.nan])
    # Differences 0.1 and 0.3: mean square 0.05, mean 0.2.
    for weight, expected in ((0.0, 0.05), (0.5, 0.03), (1.0, 0.01)):
        found = scale_invariant_loss(predicted, target, shift_weight=weight)
        assert float(found) == pytest.approx(expected)


@given(CODES, CODES, arrays(np.bool_, (2, 1, 8, 16)))
def test_gradient_loss_is_that_of_the_slow_reference(
    predicted: NDArray[np.float64], target: NDArray[np.float64], unknown: NDArray[np.bool_]
) -> None:
    target = np.where(unknown, np.nan, target)
    found = gradient_loss(torch.from_numpy(predicted), torch.from_numpy(target))
    assert float(found) == pytest.approx(slow_gradient_loss(predicted, target), abs=1e-12)


def test_a_step_has_a_gradient_by_hand() -> None:
    predicted = torch.zeros(1, 1, 8, 8)
    predicted[..., 4:] = 1
    # Two columns of 8 with gradient 1/2, then two of 4, two of 2; one pixel has no neighbours.
    expected = (2 * 0.5 / 8 + 2 * 0.5 / 4 + 2 * 0.5 / 2 + 0) / 4
    assert float(gradient_loss(predicted, torch.zeros(1, 1, 8, 8))) == pytest.approx(expected)


def test_unknown_depth_gives_no_gradient() -> None:
    predicted = torch.rand(1, 1, 8, 8, requires_grad=True)
    target = torch.full((1, 1, 8, 8), math.nan)
    loss = scale_invariant_loss(predicted, target, shift_weight=1.0)
    (loss + gradient_loss(predicted, target)).backward()
    assert float(loss.detach()) == 0
    assert float(predicted.grad.abs().max()) == 0
