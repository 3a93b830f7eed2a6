"""EV-FlowNet and the loss of optical flow: sizes, a case by hand, unknown pixels, a property."""

from __future__ import annotations

import math

import pytest

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.flow import flow_loss, make_ev_flow_net  # noqa: E402

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


def test_ev_flow_net_gives_flow_at_four_scales() -> None:
    network = make_ev_flow_net(5, 4, seed=0)
    flows = network(torch.rand(2, 5, 45, 60))
    assert [tuple(flow.shape) for flow in flows] == [(2, 2, 45, 60)] * 4
    sum(flow.sum() for flow in flows).backward()
    assert all(one.grad is not None for one in network.parameters())


def test_ev_flow_net_has_as_many_channels_as_published() -> None:
    tensors = make_ev_flow_net(5, 32, 0).tensors
    assert tensors["multires_unet.encoders.3.conv2d.weight"].shape == (512, 256, 3, 3)
    assert tensors["multires_unet.decoders.1.conv2d.weight"].shape == (128, 514, 3, 3)
    assert tensors["multires_unet.preds.3.conv2d.weight"].shape == (2, 32, 1, 1)
