"""Backward warping in torch, always in float32."""

from __future__ import annotations

from texvent.interpolate.networks.torch_import import Tensor, import_torch


def warp(image: Tensor, flow: Tensor) -> Tensor:
    """The image that `flow` looks up: bilinear, edges repeated.

    float32 even for half-precision images: a half cannot tell the columns of a wide image apart.

    Args:
        image: [N, C, H, W].
        flow: from each pixel to where it is looked up, [N, 2, H, W] as (x, y), px.

    Returns:
        [N, C, H, W], of the image's type.
    """
    torch = import_torch()
    height, width = image.shape[-2:]
    flow = flow.float()
    columns = torch.arange(width, device=flow.device, dtype=torch.float32)
    rows = torch.arange(height, device=flow.device, dtype=torch.float32)
    # grid_sample wants -1..1 from the first pixel's centre to the last one's.
    x = (flow[:, 0] + columns) * (2.0 / max(width - 1, 1)) - 1.0
    y = (flow[:, 1] + rows[:, None]) * (2.0 / max(height - 1, 1)) - 1.0
    moved = torch.nn.functional.grid_sample(
        image.float(),
        torch.stack((x, y), dim=-1),
        mode="bilinear",
        padding_mode="border",
        align_corners=True,
    )
    return moved.to(image.dtype)
