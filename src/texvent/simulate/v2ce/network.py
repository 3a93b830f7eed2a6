"""V2CE's 3-D U-Net for inference: pairs of frames in, voxel grids out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.networks.weight_files import Tensor
from texvent.simulate.v2ce.layout import (
    DECODERS,
    ENCODERS,
    FRAMES,
    HEAD,
    MIDDLE,
    NODES,
    POLARITIES,
    PREDICTION,
)
from texvent.simulate.v2ce.weights import read_weights

Device: TypeAlias = Literal["auto", "cpu", "cuda"]
Float32Array: TypeAlias = NDArray[np.float32]

HALVED = (1, 2, 2)
"""Stride of an encoder: half the image size, all of the time."""
HEAD_LEAK = 0.01
"""Slope of the head's activation below 0."""


def load_network(path: Path, device: Device = "auto") -> V2ceNetwork:
    """The network of a weights file.

    Raises:
        ConfigError: "cuda" without a GPU that torch can use.
        FileFormatError: the file does not hold this network.
        MissingDependencyError: torch is not installed.
    """
    torch = require("torch", extra="v2ce")
    has_gpu = torch.cuda.is_available()
    if device == "cuda" and not has_gpu:
        raise ConfigError("device is cuda, but torch finds no GPU here; use device='cpu' or auto")
    chosen = ("cuda" if has_gpu else "cpu") if device == "auto" else device
    return V2ceNetwork(read_weights(path, chosen), chosen, name=str(path))


class V2ceNetwork:
    """A U-Net over time, rows and columns; every convolution also looks one pair back and ahead.

    Each residual block is convolution, batch norm, ReLU, convolution, batch norm, plus a
    convolution of one pixel around them, then ReLU. Each decoder first doubles the image by
    repeating pixels. The output is at least 0.
    """

    def __init__(self, tensors: Mapping[str, Tensor], device: str, *, name: str) -> None:
        """A network from tensors as `read_weights` gives them.

        Args:
            tensors: name → tensor.
            device: where they are.
            name: what to call the weights in messages.
        """
        self._tensors = tensors
        self._device = device
        self._name = name

    @property
    def _torch(self) -> ModuleType:
        # Not kept as an attribute: a module cannot be copied, a simulator can.
        return require("torch", extra="v2ce")

    def predict(self, pairs: Float32Array) -> Float32Array:
        """Voxel grids of a sequence of frame pairs.

        Args:
            pairs: normalised intensities, [N, 2, H, W], in time order, any N, H, W.

        Returns:
            [N, 2, 10, H, W], at least 0: ON and OFF counts at ten nodes in time.

        Raises:
            FileFormatError: the weights give numbers that are NaN or infinite.
            InputError: the frames do not fit into the device's memory.
        """
        torch = self._torch
        count, _, height, width = pairs.shape
        try:
            with torch.inference_mode():
                x = torch.from_numpy(np.ascontiguousarray(pairs.swapaxes(0, 1)))
                voxel = self._forward(x.to(self._device).reshape(1, FRAMES, count, height, width))
                grids = voxel[0].transpose(0, 1).cpu().numpy()
        except RuntimeError as error:
            if "memory" not in str(error):
                raise
            raise InputError(
                f"{count} pairs of {width}x{height} frames do not fit into the memory of device "
                f"{self._device}; lower `sequence_length` or choose a smaller `sensor`"
            ) from error
        if not np.isfinite(grids).all():
            raise FileFormatError(f"{self._name}: the network's output is NaN or infinite")
        return np.asarray(grids.reshape(count, POLARITIES, NODES, height, width))

    def _forward(self, x: Tensor) -> Tensor:
        """[1, 2, N, H, W] to [1, 20, N, H, W]."""
        functional = self._torch.nn.functional
        x = functional.leaky_relu(self._convolve(x, HEAD, padding=1), HEAD_LEAK)
        skipped = []
        for name in ENCODERS:
            skipped.append(x)
            x = self._pass_block(x, name, stride=HALVED)
        for name in MIDDLE:
            x = self._pass_block(x, name)
        for name in DECODERS:
            beside = skipped.pop()
            x = functional.interpolate(x, size=beside.shape[2:], mode="nearest")
            x = self._pass_block(self._torch.cat([x, beside], dim=1), name)
        return self._torch.relu(self._convolve(x, PREDICTION))

    def _pass_block(self, x: Tensor, name: str, *, stride: Any = 1) -> Tensor:
        inner = self._convolve(x, f"{name}.conv1", stride=stride, padding=1)
        inner = self._torch.relu(self._normalise(inner, f"{name}.bn1"))
        inner = self._normalise(self._convolve(inner, f"{name}.conv2", padding=1), f"{name}.bn2")
        around = self._convolve(x, f"{name}.downsample.0", stride=stride)
        return self._torch.relu(inner + self._normalise(around, f"{name}.downsample.1"))

    def _convolve(self, x: Tensor, name: str, *, stride: Any = 1, padding: int = 0) -> Tensor:
        weight, bias = self._tensors[f"{name}.weight"], self._tensors.get(f"{name}.bias")
        return self._torch.nn.functional.conv3d(x, weight, bias, stride=stride, padding=padding)

    def _normalise(self, x: Tensor, name: str) -> Tensor:
        """Batch norm with the means and variances of training."""
        parts = ("running_mean", "running_var", "weight", "bias")
        return self._torch.nn.functional.batch_norm(
            x, *(self._tensors[f"{name}.{part}"] for part in parts), training=False
        )
