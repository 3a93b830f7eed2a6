"""Optical flow from events: EV-FlowNet, its loss, its scores."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar

from texvent.config import check_range
from texvent.dataset.samples import Target
from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent.represent.voxel_grid import MAX_BINS
from texvent_lab.networks import Padding
from texvent_lab.networks.layers import (
    ConvLayer,
    Network,
    ResidualBlock,
    UpsampleLayer,
    make_seeded,
)
from texvent_lab.train.dense_errors import FlowError
from texvent_lab.train.schedule import EXTRA, TrainingConfig
from texvent_lab.train.sequences import SequenceData
from texvent_lab.train.task import Score, Task
from texvent_lab.train.truth import FLOW, GRIDS, TruthTask


@dataclass(frozen=True, kw_only=True)
class FlowNetwork:
    """EV-FlowNet and its input."""

    bins: int = 5
    """Of the voxel grids."""
    width: int = 32
    """Half the channels of the first layer; the published network has 32."""

    def __post_init__(self) -> None:
        check_range("bins", self.bins, 1, MAX_BINS)
        check_range("width", self.width, 1, 1024)


@dataclass(frozen=True, kw_only=True)
class FlowConfig(TrainingConfig):
    """A network that gives optical flow from events."""

    flip_x: bool = True
    """Mirror half of the training samples left to right."""
    flip_y: bool = True
    """Turn half of the training samples upside down."""
    data: SequenceData = field(default_factory=SequenceData)
    network: FlowNetwork = field(default_factory=FlowNetwork)

    def make_task(self) -> Task:
        """See `TrainingConfig`."""
        return FlowTask(self)


ENCODERS = 4
BLOCKS = 2
FLOW_CHANNELS = 2
KERNEL = 3
MULTIPLE = 2**ENCODERS
"""Both sides are padded to multiples of this, px."""


class EvFlowNet(Network):
    """EV-FlowNet: voxel grids → displacement over each, found at four sizes.

    Source: A. Z. Zhu, L. Yuan, K. Chaney, K. Daniilidis, "EV-FlowNet: self-supervised optical flow
        estimation for event-based cameras", RSS 2018, section IV-B.
    Deviation: the input is a voxel grid, as in their paper of CVPR 2019, in place of images of
        counts and times; flow is the last convolution's output in px, without 256 · tanh; no batch
        normalisation, and bilinear enlargement, as in event_flow and event_cnn_minimal, whose
        width 32 is the published network's 64.
    """

    def __init__(self, bins: int, width: int) -> None:
        """Random weights.

        Args:
            bins: of the voxel grid.
            width: half the channels of the first encoder; the published networks have 32.
        """
        super().__init__()
        widths = [width << number for number in range(1, ENCODERS + 1)]
        befores = [bins, *widths[:-1]]
        down = [ConvLayer(*sides, KERNEL, stride=2) for sides in zip(befores, widths, strict=True)]
        up, predictions = [], []
        for number, wide in enumerate(reversed(widths)):
            before = 2 * wide + (FLOW_CHANNELS if number else 0)
            up.append(UpsampleLayer(before, wide // 2, KERNEL))
            predictions.append(ConvLayer(wide // 2, FLOW_CHANNELS, 1))
        nn = require("torch.nn", extra=EXTRA)
        layers = {
            "encoders": down,
            "resblocks": [ResidualBlock(widths[-1]) for _ in range(BLOCKS)],
            "decoders": up,
            "preds": predictions,
        }
        self.multires_unet = nn.ModuleDict(
            {name: nn.ModuleList(inner) for name, inner in layers.items()}
        )

    def forward(self, grids: Tensor) -> tuple[Tensor, ...]:
        """Displacements (x, y), px, found at an eighth, a quarter, half and the whole of the size.

        Args:
            grids: [n, bins, H, W].

        Returns:
            Four [n, 2, H, W].
        """
        torch, net = require("torch", extra=EXTRA), self.multires_unet
        padding = Padding.centred(grids.shape[-2:], MULTIPLE)
        padded = x = padding.around(grids)
        skipped: list[Tensor] = []
        flows: list[Tensor] = []
        for encoder in net["encoders"]:
            x = encoder(x).relu()
            skipped.append(x)
        for block in net["resblocks"]:
            x = block(x)
        for decoder, prediction in zip(net["decoders"], net["preds"], strict=True):
            x = decoder(torch.cat([*flows[-1:], x, skipped.pop()], 1))
            flows.append(prediction(x))
        enlarge, size = torch.nn.functional.interpolate, padded.shape[-2:]
        whole = [enlarge(one, size=size, mode="bilinear", align_corners=False) for one in flows]
        return tuple(padding.off(flow) for flow in whole)


def make_ev_flow_net(bins: int, width: int, seed: int) -> EvFlowNet:
    """A network with random weights; see `EvFlowNet`."""
    return make_seeded(lambda: EvFlowNet(bins, width), seed)


SOFTNESS_PX = 1e-3
"""Distance below which the loss is quadratic, px."""


def flow_loss(predictions: Sequence[Tensor], target: Tensor) -> Tensor:
    """Mean Charbonnier distance of valid pixels, `√(|predicted − true|² + 0.001²)`, over scales.

    Args:
        predictions: (x, y) displacement, px, [n, 2, H, W] each.
        target: the same; NaN where it is not known.

    Returns:
        A scalar, px; 0 where nothing is known.

    Source: A. Z. Zhu et al., "EV-FlowNet: self-supervised optical flow estimation for event-based
        cameras", RSS 2018, section IV-C: the loss at each scale, with a Charbonnier norm.
    Deviation: the difference is that to the true flow, which the paper does not have; exponent 0.5
        in place of 0.45, of the whole distance in place of each component, so that a loss is an
        end-point error; scales of equal weight.
    """
    valid = target.isfinite().all(dim=1, keepdim=True)
    count = valid.sum().clamp(min=1)
    true = target.where(valid, 0)
    total = true.new_zeros(())
    for prediction in predictions:
        squared = ((prediction - true) ** 2).sum(dim=1, keepdim=True)
        total = total + ((squared + SOFTNESS_PX**2).sqrt() * valid).sum() / count
    return total / len(predictions)


class FlowTask(TruthTask):
    """Distance to the exact flow at four scales, scored by the mean end-point error."""

    score = Score("EPE", is_higher_better=False)
    target: ClassVar[Target] = "flow"
    errors = FlowError
    where_from = (
        "network.bins and network.width must be those of the file; texvent train flow writes it as "
        "weights.pt"
    )

    def __init__(self, config: FlowConfig) -> None:
        """See `TruthTask`."""
        self._network = config.network
        super().__init__(
            config,
            config.data,
            bins=config.network.bins,
            flips_x=config.flip_x,
            flips_y=config.flip_y,
        )

    def make_network(self) -> Any:
        """See `Task`."""
        return make_ev_flow_net(self._network.bins, self._network.width, self._config.seed)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """Of all windows, each by itself."""
        grids, true = (batch[name].to(device).flatten(0, 1) for name in (GRIDS, FLOW))
        return flow_loss(network(grids), true)

    def predict(self, network: Any, grids: Any) -> Any:
        """See `TruthTask`."""
        return network(grids)[-1]
