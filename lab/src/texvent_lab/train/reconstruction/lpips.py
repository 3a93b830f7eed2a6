"""LPIPS as a loss: the distance of `texvent.metrics.lpips`, differentiable, image by image."""

from __future__ import annotations

from collections.abc import Iterator

from texvent.extending import require
from texvent.metrics.lpips.distance import LEAST_LENGTH, SHIFT, SPREAD
from texvent.metrics.lpips.layout import COLOURS
from texvent.metrics.lpips.weights import LpipsWeights
from texvent.networks.weight_files import Tensor
from texvent_lab.train.schedule import EXTRA


class LpipsLoss:
    """The distance of grey images."""

    def __init__(self, weights: LpipsWeights) -> None:
        """Copy the weights to torch's order."""
        torch = require("torch", extra=EXTRA)
        self._layout = weights.layout
        # Kernels are [rows, columns, channels in, channels out].
        self._tensors: dict[str, Tensor] = {
            name: torch.from_numpy(array.transpose(3, 2, 0, 1).copy() if array.ndim > 1 else array)
            for name, array in weights.arrays.items()
        }
        self._tensors |= {"shift": torch.from_numpy(SHIFT), "spread": torch.from_numpy(SPREAD)}

    @property
    def least_side(self) -> int:
        """Of images that can be compared, px."""
        return self._layout.least_side

    def to(self, device: object) -> LpipsLoss:
        """Move the weights."""
        self._tensors = {name: one.to(device) for name, one in self._tensors.items()}
        return self

    def __call__(self, images: Tensor, true: Tensor) -> Tensor:
        """See `texvent.metrics.lpips.distance.lpips_distance`.

        Args:
            images: [n, 1, H, W], 0..1; values beyond are taken as they are.
            true: alike.

        Returns:
            Of each image, [n].
        """
        linalg = require("torch", extra=EXTRA).linalg
        total: Tensor = 0
        pairs = zip(self._features(images), self._features(true), strict=True)
        for number, maps in enumerate(pairs):
            # vector_norm has a gradient of 0 at features that are all 0; a square root has none.
            one, other = (
                x / (linalg.vector_norm(x, dim=1, keepdim=True) + float(LEAST_LENGTH))
                for x in (y.float() for y in maps)
            )
            head = self._tensors[f"head{number}"][:, None, None]
            total = total + ((one - other) ** 2 * head).sum(dim=1).mean(dim=(1, 2))
        return total

    def _features(self, images: Tensor) -> Iterator[Tensor]:
        functional = require("torch", extra=EXTRA).nn.functional
        shift, spread = (self._tensors[name][:, None, None] for name in ("shift", "spread"))
        x = (2 * images.expand(-1, COLOURS, -1, -1) - 1 - shift) / spread
        for number, layer in enumerate(self._layout.convolutions):
            if layer.pools:
                x = functional.max_pool2d(x, layer.pools, stride=2)
            kernel, bias = self._tensors[f"kernel{number}"], self._tensors[f"bias{number}"]
            x = functional.conv2d(x, kernel, bias, stride=layer.stride, padding=layer.padding)
            x = functional.relu(x)
            if layer.is_compared:
                yield x
