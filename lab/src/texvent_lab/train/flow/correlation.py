"""Correlation of all pixels of one image with all of another, looked up around given places."""

from __future__ import annotations

import math

from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent_lab.train.schedule import EXTRA


class CorrelationPyramid:
    """Scalar products of the features of two images, at several sizes of the second one.

    Source: Z. Teed, J. Deng, "RAFT: recurrent all-pairs field transforms for optical flow", ECCV
        2020, section 3.2.
    """

    def __init__(self, first: Tensor, second: Tensor, *, levels: int) -> None:
        """Correlate every pixel with every other.

        Args:
            first: features, [n, channels, h, w].
            second: of the other image, of the same shape; h and w at least 2^(levels − 1).
            levels: sizes of the second image, each half of the one before.
        """
        functional = require("torch", extra=EXTRA).nn.functional
        n, channels, height, width = first.shape
        product = first.flatten(2).transpose(1, 2) @ second.flatten(2)
        volume = product.reshape(n * height * width, 1, height, width) / math.sqrt(channels)
        self._levels = [volume]
        for _ in range(levels - 1):
            self._levels.append(functional.avg_pool2d(self._levels[-1], 2))

    def look_up(self, places: Tensor, radius: int) -> Tensor:
        """Correlations around a place in the second image for each pixel of the first.

        Args:
            places: (x, y), px, [n, 2, h, w].
            radius: neighbours up to this distance along both axes, px of each size.

        Returns:
            [n, levels · (2 · radius + 1)², h, w]; sizes from the largest, then columns from the
            left, then rows from above. Bilinear between pixels, 0 outside.
        """
        torch = require("torch", extra=EXTRA)
        n, _, height, width = places.shape
        steps = torch.arange(-radius, radius + 1, dtype=places.dtype, device=places.device)
        # x varies along the first axis: the published weights expect columns before rows.
        around = torch.stack(torch.meshgrid(steps, steps, indexing="ij"), -1)
        centres = places.permute(0, 2, 3, 1).reshape(-1, 1, 1, 2)
        parts = []
        for level, volume in enumerate(self._levels):
            sides = places.new_tensor(volume.shape[:-3:-1])
            # From pixels, whose centres are whole numbers, to −1..1 between the borders.
            grid = (2 * (centres / 2**level + around) + 1) / sides - 1
            found = torch.nn.functional.grid_sample(volume, grid, align_corners=False)
            parts.append(found.reshape(n, height, width, -1))
        return torch.cat(parts, -1).permute(0, 3, 1, 2)
