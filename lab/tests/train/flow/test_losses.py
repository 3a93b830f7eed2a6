"""The loss of optical flow: a case by hand, unknown pixels, a property."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.flow.task import flow_loss  # noqa: E402

pytestmark = pytest.mark.torch


def test_two_scales_by_hand() -> None:
    target = torch.zeros(1, 2, 2, 2)
    target[0, :, 1, 1] = math.nan
    fine = torch.zeros(1, 2, 2, 2)
    fine[0, :, 0, 0] = torch.tensor([3.0, 4.0])
    coarse = torch.tensor([1.0, 0.0]).reshape(1, 2, 1, 1).expand(1, 2, 2, 2)
    # Means over three valid pixels; 0.001 px where there is no error.
    softened = math.sqrt(1 + 1e-6)
    expected = (((math.sqrt(25 + 1e-6) + 2 * 0.001) / 3) + softened) / 2
    assert float(flow_loss([coarse, fine], target)) == pytest.approx(expected)


def test_unknown_flow_gives_no_gradient() -> None:
    prediction = torch.rand(1, 2, 4, 4, requires_grad=True)
    loss = flow_loss([prediction], torch.full((1, 2, 4, 4), math.nan))
    loss.backward()
    assert float(loss.detach()) == 0
    assert float(prediction.grad.abs().max()) == 0


@given(st.integers(0, 2**32 - 1), st.floats(-3, 3))
def test_turned_flows_are_as_far_apart(seed: int, angle: float) -> None:
    draws = torch.Generator().manual_seed(seed)
    flows = torch.rand(2, 1, 2, 3, 5, generator=draws, dtype=torch.float64)
    cosine, sine = math.cos(angle), math.sin(angle)
    turn = torch.tensor([[cosine, -sine], [sine, cosine]], dtype=torch.float64)
    turned = torch.einsum("ij,knjhw->knihw", turn, flows)
    one, other = (float(flow_loss([pair[0]], pair[1])) for pair in (flows, turned))
    assert one == pytest.approx(other)
