"""A ResNet of basic blocks for inference: binary event images in, one score per class out.

Source: K. He et al., "Deep residual learning for image recognition", CVPR 2016; the first
convolution is N-ImageNet's (`resnet34_weights`).
"""

from __future__ import annotations

from types import ModuleType

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.bench.classification.resnet34_weights import EXTRA, ResNetWeights
from texvent.runtime.network_files import Tensor

FIRST_PADDING = 3
NORM_FLOOR = 1e-5


class ResNetClassifier:
    """Scores of images by a network with fixed weights."""

    def __init__(self, weights: ResNetWeights) -> None:
        """A classifier, on the CPU: an accuracy must not depend on the machine.

        Args:
            weights: see `resnet34_weights.read_resnet_weights`.
        """
        self._weights = weights
        self._torch: ModuleType = require("torch", extra=EXTRA)

    @property
    def class_count(self) -> int:
        """Classes told apart."""
        return self._weights.class_count

    def __call__(self, images: NDArray[np.float32]) -> NDArray[np.float32]:
        """Scores, higher is likelier.

        Args:
            images: [n, 2, H, W] float32 binary event images, ON first.

        Returns:
            [n, classes] float32.
        """
        torch = self._torch
        functional = torch.nn.functional
        with torch.inference_mode():
            found = self._convolve(torch.from_numpy(images), "conv1", stride=2)
            found = functional.relu(self._norm(found, "bn1"))
            found = functional.max_pool2d(found, 3, stride=2, padding=1)
            for stage, blocks in enumerate(self._weights.blocks):
                for block in range(blocks):
                    stride = 2 if stage and not block else 1
                    found = self._block(found, f"layer{stage + 1}.{block}", stride)
            pooled = found.mean(dim=(2, 3))
            scores = functional.linear(pooled, self._tensor("fc.weight"), self._tensor("fc.bias"))
        return np.asarray(scores.numpy())

    def _block(self, found: Tensor, at: str, stride: int) -> Tensor:
        """Two convolutions and a shortcut."""
        relu = self._torch.nn.functional.relu
        inner = relu(self._norm(self._convolve(found, f"{at}.conv1", stride=stride), f"{at}.bn1"))
        inner = self._norm(self._convolve(inner, f"{at}.conv2"), f"{at}.bn2")
        if f"{at}.downsample.0.weight" in self._weights.tensors:
            found = self._convolve(found, f"{at}.downsample.0", stride=stride)
            found = self._norm(found, f"{at}.downsample.1")
        return relu(inner + found)

    def _convolve(self, found: Tensor, name: str, *, stride: int = 1) -> Tensor:
        kernel = self._tensor(f"{name}.weight")
        padding = FIRST_PADDING if name == "conv1" else kernel.shape[2] // 2
        return self._torch.nn.functional.conv2d(found, kernel, stride=stride, padding=padding)

    def _norm(self, found: Tensor, name: str) -> Tensor:
        parts = ("running_mean", "running_var", "weight", "bias")
        return self._torch.nn.functional.batch_norm(
            found, *(self._tensor(f"{name}.{part}") for part in parts), eps=NORM_FLOOR
        )

    def _tensor(self, name: str) -> Tensor:
        return self._weights.tensors[name]
