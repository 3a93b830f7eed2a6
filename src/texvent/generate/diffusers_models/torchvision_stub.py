"""The two torchvision functions that diffusers' Cosmos pipelines use.

torchvision from the package index does not match a CPU build of torch, and importing it then
fails, so texvent does not depend on it. Nearest-neighbour resizing of the padding mask and
turning an image into a tensor are all that is needed; torch's own give the same values.
"""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np

from texvent._require import require

EXTRA = "generate"
TRANSFORMER = "diffusers.models.transformers.transformer_cosmos"
PREDICT = "diffusers.pipelines.cosmos.pipeline_cosmos2_5_predict"


def install_torchvision_stub() -> None:
    """Give the Cosmos modules what they need, where torchvision is not installed."""
    functions = SimpleNamespace(resize=_resize, to_tensor=_to_tensor)
    modes = SimpleNamespace(NEAREST="nearest")
    transforms = SimpleNamespace(functional=functions, InterpolationMode=modes)
    transformer: Any = require(TRANSFORMER, extra=EXTRA)
    if not hasattr(transformer, "transforms"):
        transformer.transforms = transforms
    predict: Any = require(PREDICT, extra=EXTRA)
    if not hasattr(predict, "torchvision"):
        predict.torchvision = SimpleNamespace(transforms=transforms)


def _resize(image: Any, size: list[int], interpolation: str) -> Any:
    """Resize a tensor [N, C, H, W] to `size` (height, width)."""
    functional = require("torch.nn.functional", extra=EXTRA)
    return functional.interpolate(image, size=size, mode=interpolation)


def _to_tensor(image: Any) -> Any:
    """A PIL image as a float tensor [3, H, W] in 0..1."""
    torch = require("torch", extra=EXTRA)
    levels = np.asarray(image, dtype=np.float32).transpose(2, 0, 1) / 255.0
    return torch.from_numpy(np.ascontiguousarray(levels))
