"""Losses: equal to the metrics they stand for, hand-computed, with correct gradients."""

import numpy as np
import pytest
from tests.metrics.lpips.lpips_files import narrow_weights

from texvent.metrics.image_measures import structural_similarity
from texvent.metrics.lpips import Lpips

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.reconstruction.config import ReconstructionLoss  # noqa: E402
from texvent_lab.train.reconstruction.losses import (  # noqa: E402
    SequenceLoss,
    dissimilarity,
    inconsistency,
    ssim,
)

pytestmark = pytest.mark.torch


def images(count=3, height=40, width=36, seed=0):
    return np.random.default_rng(seed).random((count, 1, height, width)).astype(np.float32)


def test_lpips_has_a_finite_gradient_where_all_features_are_zero():
    weights = narrow_weights()
    arrays = {
        name: np.full_like(one, -9) if name.startswith("bias") else one
        for name, one in weights.items()
    }
    loss = Lpips(arrays)
    a = torch.zeros(1, 1, 35, 35, requires_grad=True)
    loss(a, torch.from_numpy(images(1, 35, 35))).sum().backward()
    assert torch.isfinite(a.grad).all()


def test_ssim_equals_the_metric():
    a, b = images(), images(seed=1)
    b[0] = a[0] * 0.5 + 0.2
    found = ssim(torch.from_numpy(a), torch.from_numpy(b))
    expected = [
        structural_similarity(x[0].astype(np.float64), y[0].astype(np.float64))
        for x, y in zip(a, b, strict=True)
    ]
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-5)
    np.testing.assert_allclose(
        dissimilarity(torch.from_numpy(a), torch.from_numpy(b)), 1 - found, atol=1e-6
    )


def test_mixed_precision_changes_no_similarity_and_hardly_lpips():
    a, b, lpips = torch.from_numpy(images()), torch.from_numpy(images(seed=1)), narrow_weights()
    with torch.autocast("cpu", torch.bfloat16):
        mixed, mixed_lpips = ssim(a, b), Lpips(lpips)(a, b)
    torch.testing.assert_close(mixed, ssim(a, b), rtol=0, atol=0)
    torch.testing.assert_close(mixed_lpips, Lpips(lpips)(a, b), rtol=0.02, atol=0)


def row(*values):
    return torch.tensor(values, dtype=torch.float64).reshape(1, 1, 1, -1)


def move(*values):
    flow = torch.zeros(1, 2, 1, len(values), dtype=torch.float64)
    flow[0, 0, 0] = torch.tensor(values)
    return flow


def test_consistency_by_hand():
    # Every pixel moves one to the right; the last one leaves the image.
    flow = move(1.0, 1.0, 1.0)
    images_, true = (row(0.2, 0.4, 0.6), row(0.0, 0.3, 0.4)), (row(0.5, 0.5, 0.5),) * 2
    expected = (0.1 / (0.5 + 1e-5) + 0.0) / 3
    assert inconsistency(images_, true, flow, alpha=50).item() == pytest.approx(expected)


def test_consistency_counts_less_where_the_true_images_differ():
    flow = move(0.0, 0.0)
    images_, true = (row(0.2, 0.2), row(0.4, 0.4)), (row(0.5, 0.5), row(0.5, 0.7))
    error = 0.2 / (0.6 + 1e-5)
    expected = error * (1 + np.exp(-50 * 0.04)) / 2
    assert inconsistency(images_, true, flow, alpha=50).item() == pytest.approx(expected)


def test_consistency_takes_places_between_pixels_and_ignores_unknown_flow():
    flow = move(0.25, float("nan"), float("inf"))
    images_, true = (row(0.5, 0.9, 0.9), row(0.2, 0.6, 0.1)), (row(0.5, 0.5, 0.5),) * 2
    expected = 0.2 / (0.8 + 1e-5) / 3
    assert inconsistency(images_, true, flow, alpha=50).item() == pytest.approx(expected)
    unknown = torch.full((1, 2, 1, 3), float("nan"), dtype=torch.float64)
    later = images_[1].clone().requires_grad_()
    loss = inconsistency((images_[0], later), true, unknown, alpha=50)
    loss.sum().backward()
    assert loss.item() == 0
    assert not later.grad.any()


def test_the_consistency_of_a_window_is_with_the_one_before_along_its_own_flow():
    scene = torch.from_numpy(images(1, 20, 24)).double()
    moving = torch.stack([scene[..., :, 4:], scene[..., :, :20]], dim=1)
    flow = torch.zeros(1, 2, 2, 20, 20, dtype=torch.float64)
    flow[:, 1, 0] = 4
    options = ReconstructionLoss(lpips=0, l1=1.0, consistency=1.0, consistency_from=1)
    assert SequenceLoss(options, None)(moving, moving, flow).item() < 1e-9
    assert SequenceLoss(options, None)(moving, moving, flow.flip(1)).item() > 0.01


@pytest.mark.parametrize("begin", [1, 2, 3])
def test_the_consistency_is_a_mean_over_all_images_whichever_it_begins_with(begin):
    shown, true = (
        torch.from_numpy(images(8, 20, 24, seed=seed)).reshape(2, 4, 1, 20, 24) for seed in (1, 2)
    )
    flow = torch.zeros(2, 4, 2, 20, 24)
    weights = {"lpips": 0, "l1": 1.0, "consistency_from": begin, "consistency_alpha": 0.5}
    with_it, without = (
        SequenceLoss(ReconstructionLoss(**weights, consistency=one), None)(shown, true, flow)
        for one in (2.0, 0.0)
    )
    pairs = [
        [one[:, window - 1 : window + 1].transpose(0, 1) for one in (shown, true)]
        for window in range(begin, 4)
    ]
    total = sum(inconsistency(*pair, flow[:, 0], alpha=0.5).sum() for pair in pairs)
    assert (with_it - without).item() == pytest.approx(2.0 * total.item() / 8, rel=1e-5)
    assert total > 0
