"""Super SloMo's two U-Nets, and the checkpoint that holds both. Needs torch to import.

Source: Jiang et al., Super SloMo (CVPR 2018), section 3.3 and Figure 4; names of modules as in the
checkpoint of the open PyTorch implementation that is commonly used.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError
from texvent.interpolate.networks import EXTRA, Tensor, import_torch
from texvent.networks.weight_files import load_strictly, named_tensors, read_mapping

torch: Any = import_torch()
nn: Any = torch.nn
_Module: Any = nn.Module

DEPTH = 5
"""How often a U-Net halves the image."""
PAD_TO = 2**DEPTH
"""Sides are padded to a multiple of this, px."""
PUBLISHED_WIDTH = 32
"""Channels of the first layers of the published networks."""
GROWTH = (1, 2, 4, 8, 16, 16)
"""Channels at each depth, as multiples of the width."""
FIRST_SIDES = (7, 5, 3, 3, 3, 3)
"""Sides of the convolutions at each depth on the way down."""
LEAK = 0.1
"""Slope of leaky ReLU below 0."""
FLOW_NET, REFINE_NET = "state_dictFC", "state_dictAT"
"""Names of the networks in the checkpoint. The first: two images → the flow from each to the other.
The second: images, flows, flows at the instant, warped images → corrections of the flows,
visibility."""
CHANNELS = {FLOW_NET: (6, 4), REFINE_NET: (20, 5)}
"""Channels into and out of each network."""
WHERE_FROM = (
    "the published file is SuperSloMo.ckpt, which the project avinashpaliwal/Super-SloMo on GitHub "
    "links to"
)


class UNet(_Module):
    """Five times halved by averaging, five times doubled, joined at every size."""

    def __init__(self, inputs: int, outputs: int, width: int = PUBLISHED_WIDTH) -> None:
        super().__init__()
        channels = [width * factor for factor in GROWTH]
        self.conv1 = _convolution(inputs, channels[0], FIRST_SIDES[0])
        self.conv2 = _convolution(channels[0], channels[0], FIRST_SIDES[0])
        for depth in range(1, DEPTH + 1):
            side, wide = FIRST_SIDES[depth], channels[depth]
            self.add_module(f"down{depth}", _Two(channels[depth - 1], wide, wide, side))
        for step in range(1, DEPTH + 1):
            wide = channels[DEPTH - step]
            self.add_module(f"up{step}", _Two(channels[DEPTH - step + 1], wide, 2 * wide, 3))
        self.conv3 = _convolution(channels[0], outputs, 3)

    def forward(self, x: Tensor) -> Tensor:
        """[1, inputs, H, W] to [1, outputs, H, W]; H and W are multiples of `PAD_TO`."""
        functional = nn.functional
        x = _leak(self.conv2(_leak(self.conv1(x))))
        skipped = []
        for depth in range(1, DEPTH + 1):
            skipped.append(x)
            layers = getattr(self, f"down{depth}")
            x = _leak(layers.conv2(_leak(layers.conv1(functional.avg_pool2d(x, 2)))))
        for step in range(1, DEPTH + 1):
            layers = getattr(self, f"up{step}")
            x = functional.interpolate(x, scale_factor=2.0, mode="bilinear", align_corners=True)
            x = torch.cat((_leak(layers.conv1(x)), skipped.pop()), 1)
            x = _leak(layers.conv2(x))
        return _leak(self.conv3(x))


class _Two(_Module):
    """Two convolutions; the second one sees `joined` channels."""

    def __init__(self, inputs: int, outputs: int, joined: int, side: int) -> None:
        super().__init__()
        self.conv1 = _convolution(inputs, outputs, side)
        self.conv2 = _convolution(joined, outputs, side)


def _convolution(inputs: int, outputs: int, side: int) -> Any:
    return nn.Conv2d(inputs, outputs, side, padding=side // 2)


def _leak(x: Tensor) -> Tensor:
    return nn.functional.leaky_relu(x, LEAK)


def read_checkpoint(path: Path) -> tuple[UNet, UNet]:
    """The flow network and the refining one, float32, on the CPU.

    Training state beside the two networks is left out.

    Raises:
        FileFormatError: the file is damaged, or a network is missing or of another shape.
        MissingDependencyError: torch is not installed.
    """
    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    return _read_network(content, FLOW_NET, path), _read_network(content, REFINE_NET, path)


def _read_network(content: Mapping[str, Any], key: str, path: Path) -> UNet:
    state = content.get(key)
    if not isinstance(state, Mapping):
        raise FileFormatError(f"{path} holds no {key}; it is not Super SloMo's. {WHERE_FROM}")
    tensors = named_tensors(state, extra=EXTRA)
    first = tensors.get("conv1.bias")
    with torch.device("meta"):
        network = UNet(*CHANNELS[key], PUBLISHED_WIDTH if first is None else len(first))
    load_strictly(network, tensors, path, f"looked for {key}; {WHERE_FROM}")
    return network
