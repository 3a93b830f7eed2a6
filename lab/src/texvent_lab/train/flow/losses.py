"""What EV-FlowNet is trained on: distances to the exact flow, at every scale of the network."""

from __future__ import annotations

from collections.abc import Sequence

from texvent.networks.weight_files import Tensor

SOFTNESS_PX = 1e-3
"""Distance below which the loss is quadratic, px."""


def flow_loss(predictions: Sequence[Tensor], target: Tensor) -> Tensor:
    """Mean Charbonnier distance of valid pixels, `√(|predicted − true|² + 0.001²)`, over scales.

    Args:
        predictions: (x, y) displacement, px, [n, 2, H, W] each.
        target: the same; NaN where it is not known.

    Returns:
        A scalar, px; 0 where nothing is known.

    Source: A. Z. Zhu et al., "EV-FlowNet: self-supervised optical flow estimation for event-based
        cameras", RSS 2018, section IV-C: the loss at each scale, with a Charbonnier norm.
    Deviation: the difference is that to the true flow, which the paper does not have; exponent 0.5
        in place of 0.45, of the whole distance in place of each component, so that a loss is an
        end-point error; scales of equal weight.
    """
    valid = target.isfinite().all(dim=1, keepdim=True)
    count = valid.sum().clamp(min=1)
    true = target.where(valid, 0)
    total = true.new_zeros(())
    for prediction in predictions:
        squared = ((prediction - true) ** 2).sum(dim=1, keepdim=True)
        total = total + ((squared + SOFTNESS_PX**2).sqrt() * valid).sum() / count
    return total / len(predictions)
