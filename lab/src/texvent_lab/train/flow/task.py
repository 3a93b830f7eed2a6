"""Optical flow from events: a window → displacement over it of what each pixel shows."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Final

from texvent.errors import ConfigError
from texvent.extending import require
from texvent.metrics.dense_errors import FlowError
from texvent.networks.weight_files import STATE, Tensor
from texvent_lab.train.batches import Batches
from texvent_lab.train.flow.config import FlowConfig
from texvent_lab.train.flow.e_raft import make_e_raft
from texvent_lab.train.flow.ev_flow_net import make_ev_flow_net
from texvent_lab.train.flow.losses import flow_loss
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.sequences.truth import GRIDS, SEEN, TruthExamples
from texvent_lab.train.task import Score

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
