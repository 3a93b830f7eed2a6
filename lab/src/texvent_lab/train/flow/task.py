"""Optical flow from events: EV-FlowNet or E-RAFT, loss, scores."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Final

from texvent.errors import ConfigError
from texvent.extending import require
from texvent.metrics.dense_errors import FlowError
from texvent.networks.weight_files import STATE, Tensor
from texvent_lab.networks import Padding
from texvent_lab.networks.layers import (
    ConvLayer,
    Network,
    ResidualBlock,
    UpsampleLayer,
    make_seeded,
)
from texvent_lab.train.flow.config import FlowConfig
from texvent_lab.train.flow.e_raft import make_e_raft
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.sequences.truth import GRIDS, SEEN, TruthExamples
from texvent_lab.train.task import Batches, Score

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


FLOW: Final = "flow"
E_RAFT = "e-raft"
E_RAFT_STATE = "model"
"""Under which the program of E-RAFT stores its tensors."""
WHERE_FROM = {
    E_RAFT: "network.bins must be that of the file, 15 for DSEC's; uzh-rpg/E-RAFT on GitHub links "
    "to the published files",
    "ev-flownet": "network.bins and network.width must be those of the file; texvent train flow "
    "writes it as weights.pt",
}


class FlowTask:
    """Distance to the exact flow at four scales, scored by the mean end-point error."""

    score: ClassVar[Score] = Score("EPE", is_higher_better=False)

    def __init__(self, config: FlowConfig) -> None:
        """Open the validation samples.

        Raises:
            InputError, ConfigError, FileFormatError: they do not fit; the message says why.
        """
        self._config = config
        data = config.data
        self._is_e_raft = config.network.name == E_RAFT
        self._validation = TruthExamples.open(
            data, data.validation_split, FLOW, config.network.bins, is_whole=True
        )

    def make_network(self) -> Any:
        """See `Task`."""
        network, seed = self._config.network, self._config.seed
        if self._is_e_raft:
            return make_e_raft(network.bins, seed)
        return make_ev_flow_net(network.bins, network.width, seed)

    def batches(self, *, workers: int) -> Batches:
        """See `Task`.

        Raises:
            ConfigError: the network is E-RAFT.
        """
        config = self._config
        if self._is_e_raft:
            raise ConfigError(
                "e-raft is not trained here, only evaluated (texvent evaluate flow); train "
                "ev-flownet"
            )
        examples = TruthExamples.open(
            config.data,
            config.data.split,
            FLOW,
            config.network.bins,
            flips_x=config.flip_x,
            flips_y=config.flip_y,
        )
        return examples.batches(config.schedule.batch_size, seed=config.seed, workers=workers)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """Of all windows, each by itself."""
        grids, true = (batch[name].to(device).flatten(0, 1) for name in (GRIDS, FLOW))
        return flow_loss(network(grids), true)

    def validate(self, network: Any, device: Any, *, workers: int) -> dict[str, float]:
        """Errors at all pixels, and at those with events, of all windows but each clip's first.

        E-RAFT needs the window before, so the first one is left out for every network.
        """
        whole, seen = FlowError(), FlowError()
        for batch in self._validation.batches(1, seed=0, workers=workers).epoch(0):
            found = self._predict(network, batch[GRIDS][0].to(device)).float().cpu().numpy()
            true, mask = batch[FLOW][0, 1:].numpy(), batch[SEEN][0, 1:].numpy()
            for window in range(len(found)):
                whole.update(found[window], true[window])
                seen.update(found[window], true[window], mask[window])
        at_events = {f"{name} at events": value for name, value in seen.compute().items()}
        return {**whole.compute(), **at_events}

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `Task`."""
        return {STATE: {name: one.detach().cpu() for name, one in network.tensors.items()}}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `Task`."""
        if self._is_e_raft and E_RAFT_STATE in content:
            content = {STATE: content[E_RAFT_STATE]}
        network.read(content, path, WHERE_FROM[self._config.network.name])

    def _predict(self, network: Any, grids: Tensor) -> Tensor:
        """Flow of all windows but the first, [windows − 1, 2, H, W], from [windows, bins, H, W]."""
        if not self._is_e_raft:
            return network(grids[1:])[-1]
        # One by one: all correlations of a window are in memory at once.
        flows = [
            network(one, two) for one, two in zip(grids[:-1, None], grids[1:, None], strict=True)
        ]
        return require("torch", extra=EXTRA).cat(flows)
