"""N-ImageNet's ResNet-34 for inference: binary event images in, one score per class out."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.networks.layers import Layers
from texvent.networks.resnet34 import resnet_scores
from texvent_lab.bench.classification.resnet34_weights import ResNetWeights


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
        torch = self._layers.torch
        with torch.inference_mode():
            scores = resnet_scores(self._layers, self._weights.blocks, torch.from_numpy(images))
        return np.asarray(scores.numpy())
