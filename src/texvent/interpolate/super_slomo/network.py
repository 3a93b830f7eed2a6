"""A U-Net of Super SloMo for inference."""

from __future__ import annotations

from collections.abc import Mapping
from types import ModuleType

from texvent.interpolate.networks.torch_import import Tensor, import_torch
from texvent.interpolate.super_slomo.layout import DEPTH

LEAK = 0.1
"""Slope of leaky ReLU below 0."""


class UNet:
    """Five times halved by averaging, five times doubled, joined at every size.

    Source: Jiang et al., Super SloMo (CVPR 2018), Figure 4.
    """

    def __init__(self, tensors: Mapping[str, Tensor]) -> None:
        """A network from the tensors of `UNetLayout.tensor_shapes`."""
        self._tensors = dict(tensors)

    @property
    def _torch(self) -> ModuleType:
        # Not kept as an attribute: a module cannot be copied, an interpolator can.
        return import_torch()

    def predict(self, x: Tensor) -> Tensor:
        """[1, inputs, H, W] to [1, outputs, H, W]; H and W are multiples of `PAD_TO`."""
        functional = self._torch.nn.functional
        x = self._layer(self._layer(x, "conv1"), "conv2")
        skipped = []
        for depth in range(1, DEPTH + 1):
            skipped.append(x)
            x = functional.avg_pool2d(x, 2)
            x = self._layer(self._layer(x, f"down{depth}.conv1"), f"down{depth}.conv2")
        for step in range(1, DEPTH + 1):
            x = functional.interpolate(x, scale_factor=2.0, mode="bilinear", align_corners=True)
            x = self._layer(x, f"up{step}.conv1")
            x = self._layer(self._torch.cat((x, skipped.pop()), 1), f"up{step}.conv2")
        return self._layer(x, "conv3")

    def _layer(self, x: Tensor, name: str) -> Tensor:
        functional = self._torch.nn.functional
        weight, bias = self._tensors[f"{name}.weight"], self._tensors[f"{name}.bias"]
        x = functional.conv2d(x, weight, bias, padding=weight.shape[-1] // 2)
        return functional.leaky_relu(x, LEAK)
