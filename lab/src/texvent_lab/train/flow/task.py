"""Optical flow from events: EV-FlowNet or E-RAFT, loss, scores."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar, Final

from texvent.errors import ConfigError
from texvent.extending import require
from texvent.metrics.dense_errors import FlowError
from texvent.networks.layer_shapes import Shapes
from texvent.networks.weight_files import STATE, Tensor
from texvent_lab.networks.layer_shapes import conv_layer, residual_block
from texvent_lab.networks.layers import Layers, Padding
from texvent_lab.train.flow.config import FlowConfig
from texvent_lab.train.flow.e_raft import make_e_raft
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.sequences.truth import GRIDS, SEEN, TruthExamples
from texvent_lab.train.task import Batches, Score
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors

PREFIX = "multires_unet"
ENCODERS = 4
BLOCKS = 2
FLOW_CHANNELS = 2
KERNEL = 3
MULTIPLE = 2**ENCODERS
"""Both sides are padded to multiples of this, px."""


def ev_flow_net_shapes(bins: int, width: int) -> Shapes:
    """Every tensor, by name.

    Args:
        bins: of the voxel grid.
        width: half the channels of the first encoder; the published networks have 32.
    """
    shapes: Shapes = {}
    for number in range(ENCODERS):
        narrow, wide = width << number, width << (number + 1)
        name = f"{PREFIX}.encoders.{number}"
        shapes |= conv_layer(name, wide, narrow if number else bins, KERNEL)
    for number in range(BLOCKS):
        shapes |= residual_block(f"{PREFIX}.resblocks.{number}", width << ENCODERS)
    for number in range(ENCODERS):
        wide = width << (ENCODERS - number)
        before = 2 * wide + (FLOW_CHANNELS if number else 0)
        shapes |= conv_layer(f"{PREFIX}.decoders.{number}", wide // 2, before, KERNEL)
        shapes |= conv_layer(f"{PREFIX}.preds.{number}", FLOW_CHANNELS, wide // 2, 1)
    return shapes


def make_ev_flow_net(bins: int, width: int, seed: int) -> TensorNetwork:
    """EV-FlowNet with random weights.

    It takes voxel grids, [n, bins, H, W], and gives the displacement over each, (x, y) in px: a
    tuple of four [n, 2, H, W], found at an eighth, a quarter, half and the whole of the size.

    Args:
        bins: of the voxel grid.
        width: see `ev_flow_net_shapes`.
        seed: of the weights.

    Source: A. Z. Zhu, L. Yuan, K. Chaney, K. Daniilidis, "EV-FlowNet: self-supervised optical flow
        estimation for event-based cameras", RSS 2018, section IV-B.
    Deviation: the input is a voxel grid, as in their paper of CVPR 2019, in place of images of
        counts and times; flow is the last convolution's output in px, without 256 · tanh; no batch
        normalisation, and bilinear enlargement, as in event_flow and event_cnn_minimal, whose
        width 32 is the published network's 64.
    """
    return TensorNetwork(initial_tensors(ev_flow_net_shapes(bins, width), seed), _compute)


def _compute(network: Any, grids: Tensor) -> tuple[Tensor, ...]:
    layers = Layers(network.tensors)
    torch = layers.torch
    padding = Padding.centred(grids.shape[-2:], MULTIPLE)
    padded = x = padding.around(grids)
    skipped: list[Tensor] = []
    flows: list[Tensor] = []
    for number in range(ENCODERS):
        x = torch.relu(layers.conv_layer(x, f"{PREFIX}.encoders.{number}", stride=2))
        skipped.append(x)
    for number in range(BLOCKS):
        x = layers.residual_block(x, f"{PREFIX}.resblocks.{number}")
    for number in range(ENCODERS):
        x = torch.cat([*flows[-1:], x, skipped.pop()], 1)
        x = layers.upsample_layer(x, f"{PREFIX}.decoders.{number}")
        flows.append(layers.conv_layer(x, f"{PREFIX}.preds.{number}"))
    whole = [
        torch.nn.functional.interpolate(
            flow, size=padded.shape[-2:], mode="bilinear", align_corners=False
        )
        for flow in flows
    ]
    return tuple(padding.off(flow) for flow in whole)


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
