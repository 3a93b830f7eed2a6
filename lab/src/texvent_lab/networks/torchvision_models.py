"""Classifiers of torchvision, with a first convolution for images of events.

Names of tensors are torchvision's.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import ConfigError, shown
from texvent.extending import require, suggest
from texvent.networks import Tensor, load_strictly, state_tensors
from texvent_lab.networks.layers import Network

EXTRA = "detect"
"""The texvent extra that brings torchvision of torch's build."""
VISION_TRANSFORMER = "vit_"


class TorchvisionModel(Network):
    """One score per class of images [n, channels, H, W]."""

    def __init__(self, channels: int, classes: int, *, name: str, shape: tuple[int, int]) -> None:
        """Random weights, as torchvision's; the first convolution begins as torch's own.

        Args:
            channels: of the input.
            classes: number of classes.
            name: torchvision's, such as "squeezenet1_1".
            shape: (height, width) of the images.

        Raises:
            ConfigError: torchvision has no such classifier, or it takes no images of that shape.
        """
        super().__init__()
        torch, models = require("torch", extra=EXTRA), require("torchvision.models", extra=EXTRA)
        known = models.list_models(module=models)
        if name not in known:
            raise ConfigError(f"unknown network {shown(name)}; {suggest(name, known)}")
        given = {"image_size": shape[0]} if name.startswith(VISION_TRANSFORMER) else {}
        try:
            network = models.get_model(name, weights=None, num_classes=classes, **given)
            _replace_first_convolution(network, channels)
            with torch.inference_mode():
                network.eval()(torch.zeros(1, channels, *shape))
        except (AssertionError, RuntimeError, ValueError) as error:
            raise ConfigError(
                f"{name} takes no images of {shape[1]}x{shape[0]} px ({error}); give "
                'image_size = "224x224"'
            ) from error
        self.network = network.train()

    def forward(self, images: Tensor) -> Tensor:
        """See the class."""
        return self.network(images)

    @property
    def tensors(self) -> dict[str, Tensor]:
        """See `Network`."""
        return {name.partition(".")[2]: one for name, one in super().tensors.items()}

    def read(self, content: Mapping[str, Any], path: Path, where_from: str) -> None:
        """See `Network`."""
        found = state_tensors(content, path, where_from, extra=EXTRA)
        load_strictly(self.network, found, path, where_from)


def _replace_first_convolution(network: Any, channels: int) -> None:
    """Take images of so many channels."""
    nn = require("torch.nn", extra=EXTRA)
    path, old = next(
        (path, one) for path, one in network.named_modules() if isinstance(one, nn.Conv2d)
    )
    where, _, name = path.rpartition(".")
    new = nn.Conv2d(
        channels, old.out_channels, old.kernel_size, old.stride, old.padding,
        bias=old.bias is not None,
    )  # fmt: skip
    setattr(network.get_submodule(where), name, new)
