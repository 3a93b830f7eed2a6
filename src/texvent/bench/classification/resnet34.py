"""A ResNet of basic blocks for inference: binary event images in, one score per class out.

Source: K. He et al., "Deep residual learning for image recognition", CVPR 2016; the first
convolution is N-ImageNet's (`resnet34_weights`). docs/design/libraries.md says why no library's.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.bench.classification.resnet34_weights import ResNetWeights
from texvent.networks.layers import Layers
from texvent.networks.weight_files import Tensor

FIRST_PADDING = 3


class ResNetClassifier:
    """Scores of images by a network with fixed weights."""

    def __init__(self, weights: ResNetWeights) -> None:
        """A classifier, on the CPU: an accuracy must not depend on the machine.

        Args:
            weights: see `resnet34_weights.read_resnet_weights`.
        """
        self._weights = weights
        self._layers = Layers(weights.tensors)

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
        layers, torch = self._layers, self._layers.torch
        with torch.inference_mode():
            found = torch.from_numpy(images)
            found = layers.convolve(found, "conv1", stride=2, padding=FIRST_PADDING)
            found = torch.relu(layers.normalise(found, "bn1"))
            found = torch.nn.functional.max_pool2d(found, 3, stride=2, padding=1)
            for stage, blocks in enumerate(self._weights.blocks):
                for block in range(blocks):
                    stride = 2 if stage and not block else 1
                    found = self._block(found, f"layer{stage + 1}.{block}", stride)
            scores = layers.linear(found.mean(dim=(2, 3)), "fc")
        return np.asarray(scores.numpy())

    def _block(self, found: Tensor, at: str, stride: int) -> Tensor:
        """Two convolutions and a shortcut."""
        layers, relu = self._layers, self._layers.torch.relu
        inner = layers.convolve(found, f"{at}.conv1", stride=stride)
        inner = relu(layers.normalise(inner, f"{at}.bn1"))
        inner = layers.normalise(layers.convolve(inner, f"{at}.conv2"), f"{at}.bn2")
        if layers.has(f"{at}.downsample.0.weight"):
            found = layers.convolve(found, f"{at}.downsample.0", stride=stride)
            found = layers.normalise(found, f"{at}.downsample.1")
        return relu(inner + found)
