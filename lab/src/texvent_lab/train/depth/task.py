"""Depth from events: consecutive windows → metres at the end of each."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, ClassVar, Final

from texvent.metrics.dense_errors import FARTHEST_M, DepthError
from texvent.networks.weight_files import STATE, Tensor
from texvent_lab.train.batches import Batches
from texvent_lab.train.depth.config import DepthConfig
from texvent_lab.train.depth.e2depth import ARCHITECTURE, BINS, make_e2depth, settings_of
from texvent_lab.train.depth.log_depth import decode_depth, encode_depth
from texvent_lab.train.depth.losses import gradient_loss, scale_invariant_loss
from texvent_lab.train.sequences.truth import GRIDS, SEEN, TruthExamples
from texvent_lab.train.task import Score

DEPTH: Final = "depth"
WHERE_FROM = (
    "network.width must be that of the file; uzh-rpg/rpg_e2depth on GitHub links to the published "
    "one, E2DEPTH_si_grad_loss_mixed.pth.tar, which has 32"
)


class DepthTask:
    """Loss of E2Depth, scored by the mean relative error of depth below 80 m."""

    score: ClassVar[Score] = Score("abs_rel", is_higher_better=False)

    def __init__(self, config: DepthConfig) -> None:
        """Open the validation samples.

        Raises:
            InputError, ConfigError, FileFormatError: they do not fit; the message says why.
        """
        self._config = config
        data = config.data
        self._validation = TruthExamples.open(
            data, data.validation_split, DEPTH, BINS, is_whole=True
        )

    def make_network(self) -> Any:
        """See `Task`."""
        return make_e2depth(self._config.network.width, self._config.seed)

    def batches(self, *, workers: int) -> Batches:
        """See `Task`."""
        config = self._config
        examples = TruthExamples.open(
            config.data, config.data.split, DEPTH, BINS, flips_x=config.flip_x
        )
        return examples.batches(config.schedule.batch_size, seed=config.seed, workers=workers)

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """Mean over windows, each with all its images together, as in the program of E2Depth."""
        weights = self._config.loss
        depth = batch[DEPTH].to(device)
        if not weights.sky:
            depth = depth.where(depth < FARTHEST_M, math.nan)
        target = encode_depth(depth)
        found = network(batch[GRIDS].to(device))
        total = found.new_zeros(())
        for one, true in zip(found.unbind(1), target.unbind(1), strict=True):
            total = total + scale_invariant_loss(one, true, shift_weight=weights.shift_weight)
            total = total + weights.gradient_weight * gradient_loss(one, true)
        return total / found.shape[1]

    def validate(self, network: Any, device: Any, *, workers: int) -> dict[str, float]:
        """Errors on all windows, and the relative error where there are events."""
        whole, seen = DepthError(), DepthError()
        for batch in self._validation.batches(1, seed=0, workers=workers).epoch(0):
            found = decode_depth(network(batch[GRIDS].to(device)).float())[0, :, 0].cpu().numpy()
            true, mask = batch[DEPTH][0, :, 0].numpy(), batch[SEEN][0].numpy()
            for window in range(len(found)):
                whole.update(found[window], true[window])
                seen.update(found[window], true[window], mask[window])
        name = self.score.name
        return {**whole.compute(), f"{name} at events": seen.compute()[name]}

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `Task`; the program of E2Depth reads it too."""
        tensors = {name: one.detach().cpu() for name, one in network.tensors.items()}
        model = settings_of(self._config.network.width)
        return {
            "arch": ARCHITECTURE,
            STATE: tensors,
            "config": {"arch": ARCHITECTURE, "model": model},
        }

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `Task`."""
        network.read(content, path, WHERE_FROM)
