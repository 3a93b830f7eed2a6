"""Losses: equal to the metrics they stand for and to definitions pixel by pixel; gradients."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples
from tests.metrics.lpips.lpips_files import narrow_weights

from texvent.metrics.image_measures import structural_similarity
from texvent.metrics.lpips import Lpips
from texvent_lab.train.reconstruction.config import ReconstructionLoss


def images(*shape, seed=0):
    return np.random.default_rng(seed).random(shape or (3, 1, 40, 36)).astype(np.float32)


@pytest.mark.torch
def test_lpips_has_a_finite_gradient_where_all_features_are_zero():
    torch = pytest.importorskip("torch")
    arrays = {
        name: np.full_like(one, -9) if name.startswith("bias") else one
        for name, one in narrow_weights().items()
    }
    loss = Lpips(arrays)
    a = torch.zeros(1, 1, 35, 35, requires_grad=True)
    loss(a, torch.from_numpy(images(1, 1, 35, 35))).sum().backward()
    assert torch.isfinite(a.grad).all()


@pytest.mark.torch
def test_mixed_precision_changes_no_similarity_and_hardly_lpips():
    torch = pytest.importorskip("torch")
    from texvent_lab.train.reconstruction.losses import ssim

    a, b, lpips = torch.from_numpy(images()), torch.from_numpy(images(seed=1)), narrow_weights()
    with torch.autocast("cpu", torch.bfloat16):
        mixed, mixed_lpips = ssim(a, b), Lpips(lpips)(a, b)
    torch.testing.assert_close(mixed, ssim(a, b), rtol=0, atol=0)
    torch.testing.assert_close(mixed_lpips, Lpips(lpips)(a, b), rtol=0.02, atol=0)


@pytest.mark.torch
def test_where_flow_is_not_known_there_is_no_gradient():
    torch = pytest.importorskip("torch")
    from texvent_lab.train.reconstruction.losses import inconsistency

    before, later = torch.from_numpy(images(2, 1, 3, 4)).split(1)
    later = later.clone().requires_grad_()
    unknown = torch.full((1, 2, 3, 4), float("nan"))
    loss = inconsistency((before, later), (before, before), unknown, alpha=50)
    loss.sum().backward()
    assert loss.item() == 0
    assert not later.grad.any()


def between(image, x, y):
    """Value of an image [H, W] at a place between pixels."""
    left, top = int(x), int(y)
    right, below = min(left + 1, image.shape[1] - 1), min(top + 1, image.shape[0] - 1)
    rows = [(1 - (x - left)) * image[row, left] + (x - left) * image[row, right]
            for row in (top, below)]  # fmt: skip
    return (1 - (y - top)) * rows[0] + (y - top) * rows[1]


def inconsistency_by_definition(before, later, true_before, true_later, flow, alpha):
    height, width = before.shape
    total = 0.0
    for y, x in np.ndindex(height, width):
        u, v = x + flow[0, y, x], y + flow[1, y, x]
        if 0 <= u <= width - 1 and 0 <= v <= height - 1:
            shown, true = between(later, u, v), between(true_later, u, v)
            weight = np.exp(-alpha * (true - true_before[y, x]) ** 2)
            total += weight * abs(shown - before[y, x]) / (shown + before[y, x] + 1e-5)
    return total / (height * width)


@given(seed=st.integers(0, 999), begin=st.integers(1, 3), alpha=st.sampled_from([0.0, 5.0, 50.0]))
@examples(0.2)
def test_a_loss_is_the_weighted_sum_of_its_parts_and_each_is_a_mean_over_images(
    torch, seed, begin, alpha
):
    from texvent_lab.train.reconstruction.losses import SequenceLoss

    chance = np.random.default_rng(seed)
    shown, true = (images(2, 4, 1, 12, 13, seed=seed + part) for part in (0, 1000))
    flow = np.rint(chance.uniform(-24, 24, (2, 4, 2, 12, 13)).astype(np.float32)) / 8
    flow[chance.random(flow.shape) < 0.1] = np.nan
    l1, ssim, consistency = chance.uniform(0.1, 2, 3)
    options = {"consistency_from": begin, "consistency_alpha": alpha, "lpips": 0}

    def loss(moved, **weights):
        chosen = ReconstructionLoss(**options, **weights)
        parts = (torch.from_numpy(one) for one in (shown, true))
        return float(SequenceLoss(chosen, None)(*parts, moved))

    pairs = [(shown[n, w, 0].astype(float), true[n, w, 0].astype(float))
             for n, w in np.ndindex(2, 4)]  # fmt: skip
    expected = l1 * np.mean([abs(a - b).mean() for a, b in pairs])
    expected += ssim * np.mean([1 - structural_similarity(a, b) for a, b in pairs])
    assert loss(None, l1=l1, ssim=ssim) == pytest.approx(expected, abs=1e-5)
    changes = [
        inconsistency_by_definition(
            shown[n, w - 1, 0], shown[n, w, 0], true[n, w - 1, 0], true[n, w, 0], flow[n, w], alpha
        )
        for n in range(2)
        for w in range(begin, 4)
    ]
    found = loss(torch.from_numpy(flow), l1=l1, ssim=ssim, consistency=consistency)
    assert found == pytest.approx(expected + consistency * np.sum(changes) / 8, abs=1e-5)
    assert np.sum(changes) > 0
