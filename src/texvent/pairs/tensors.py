"""Images in torch tensors, on any device."""

from __future__ import annotations

from typing import Any, TypeAlias

from texvent.brightness import LUMA_WEIGHTS
from texvent.errors import InputError

Tensor: TypeAlias = Any


def rgb_and_luma(image: Tensor, device: str) -> tuple[Tensor, Tensor]:
    """An image in three channels, as networks expect it, and its luma.

    Args:
        image: [H, W] luma or [3, H, W] RGB, 0..255 scale, uint8 or float, on any device.
        device: where both results go.

    Returns:
        [1, 3, H, W] and [1, 1, H, W], both float32, 0..255 scale.

    Raises:
        InputError: it has another shape.
    """
    if image.ndim not in (2, 3) or (image.ndim == 3 and len(image) != 3):
        raise InputError(f"an image must be [H, W] or [3, H, W]; got {list(image.shape)}")
    levels = image.to(device).float()
    if levels.ndim == 2:
        return levels.expand(1, 3, -1, -1), levels[None, None]
    luma = levels[0] * LUMA_WEIGHTS[0]
    luma += levels[1] * LUMA_WEIGHTS[1]
    luma += levels[2] * LUMA_WEIGHTS[2]
    return levels[None], luma[None, None]
