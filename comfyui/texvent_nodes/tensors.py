"""ComfyUI's IMAGE, a torch tensor [B, H, W, C] of 0..1, to and from NumPy."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.errors import InputError, warn
from texvent.options.arrays import as_array

WHITE = 255.0
OVERSHOOT = 0.25
"""Resized images exceed 0..1 by as much."""
FEW = 0.1
"""Share of highlights."""


def frames_of(images: Any) -> NDArray[np.float32]:
    """Frames on texvent's 0..255 scale.

    Args:
        images: IMAGE: anything that NumPy reads as [B, H, W, C], or a tensor of any device.

    Returns:
        [B, H, W] or [B, H, W, 3] float32, alpha left out.

    Raises:
        InputError: another shape or type, fewer than two images, or values that are not finite or
            often far beyond 0..1.

    Warns:
        TexventWarning: a few are, and are cut.
    """
    given = as_array(images, "images")
    if given.dtype.kind != "f":
        raise InputError(f"images hold {given.dtype}; an IMAGE holds floats of 0..1")
    pixels = given.astype(np.float32)
    if pixels.ndim != 4 or pixels.shape[3] not in (1, 3, 4):
        raise InputError(
            f"images have shape {list(pixels.shape)}; an IMAGE is [B, H, W, C] with 1, 3 or 4 "
            "channels"
        )
    if len(pixels) < 2:
        raise InputError(
            f"there is {len(pixels)} image; events are changes, so connect a batch of at least "
            "two, such as the frames of a video"
        )
    if not np.isfinite(pixels).all():
        raise InputError("images hold NaN or infinite values; check the node that makes them")
    share = np.count_nonzero((pixels > 1 + OVERSHOOT) | (pixels < -OVERSHOOT)) / pixels.size
    if share:
        beyond = (
            f"images hold values from {pixels.min():g} to {pixels.max():g}, a share of {share:.2g} "
            "far beyond the 0..1 of an IMAGE"
        )
        if share > FEW:
            raise InputError(
                f"{beyond}; divide them by their white, and of -1..1 take (images + 1) / 2"
            )
        warn(f"{beyond}; they are cut")
    pixels = np.clip(pixels, 0.0, 1.0) * np.float32(WHITE)
    return pixels[..., 0] if pixels.shape[3] == 1 else pixels[..., :3]


def images_of(pixels: NDArray[np.uint8]) -> Any:
    """IMAGE of RGB pixels [B, H, W, 3], uint8."""
    import torch  # ComfyUI brings it

    return torch.from_numpy(pixels.astype(np.float32) / np.float32(WHITE))
