"""Changes of brightness from latents: a head trained on scenes whose changes are known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any, ClassVar

import numpy as np

from texvent.networks.weight_files import STATE, Tensor
from texvent_lab.latents.head import CONFIG, HeadConfig, LatentHead
from texvent_lab.networks.layers import make_seeded
from texvent_lab.train.latents.config import LatentsConfig
from texvent_lab.train.latents.pairs import CHANGE, LATENTS, LatentPairs
from texvent_lab.train.task import Batches, Score

WHERE_FROM = "texvent train latents writes it as weights.pt"


class LatentsTask:
    """Mean squared error of the changes, bin by bin and summed up from the interval's start.

    Most voxels do not change. The least absolute error is then at no change at all, the least
    squared one at the mean of what may happen.
    """

    score: ClassVar[Score] = Score("relative error", is_higher_better=False)

    def __init__(self, config: LatentsConfig) -> None:
        """Make the first validation pair, which shows most mistakes.

        Raises:
            InputError, ConfigError: the scenes or the autoencoder do not fit; the message says why.
        """
        self._config = config
        self._validation = self._pairs(config.data.validation_split)
        first = self._validation(0, np.random.default_rng(0))
        autoencoder = self._validation.autoencoder
        self.head_config = HeadConfig(
            channels=len(first[LATENTS]),
            frames_per_latent=autoencoder.frames_per_latent,
            pixels_per_latent=autoencoder.pixels_per_latent,
            **asdict(config.network),
        )

    def make_network(self) -> Any:
        """See `Task`."""
        return make_seeded(lambda: LatentHead(self.head_config), self._config.seed)

    def batches(self, *, workers: int) -> Batches:
        """See `Task`."""
        config = self._config
        pairs = self._pairs(config.data.split, is_augmented=True)
        return Batches(
            make=pairs,
            count=len(pairs),
            batch_size=config.schedule.batch_size,
            seed=config.seed,
            workers=workers,
        )

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """See `LatentsTask`."""
        error = network(batch[LATENTS].to(device)) - batch[CHANGE].to(device)
        return error.square().mean() + error.cumsum(2).square().mean()

    def validate(self, network: Any, device: Any, *, workers: int) -> dict[str, float]:
        """Scores of what changes summed up from the interval's start.

        Returns:
            `relative error`: mean squared error over the mean squared change; a head that sees
            nothing move has 1. `relative change`: mean absolute change, predicted over true.
        """
        total = dict.fromkeys(("error", "change", "found", "true"), 0.0)
        make = self._validation
        count = self._config.schedule.batch_size
        batches = Batches(make, len(make), count, seed=0, shuffle=False, workers=workers)
        for batch in batches.epoch(0):
            found = network(batch[LATENTS].to(device)).float().cpu().cumsum(2)
            true = batch[CHANGE].cumsum(2)
            total["error"] += float((found - true).square().sum())
            total["change"] += float(true.square().sum())
            total["found"] += float(found.abs().sum())
            total["true"] += float(true.abs().sum())
        return {
            "relative error": total["error"] / (total["change"] or float("nan")),
            "relative change": total["found"] / (total["true"] or float("nan")),
        }

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `Task`; `texvent_lab.latents.head.load_head` reads it."""
        tensors = {name: one.detach().cpu() for name, one in network.tensors.items()}
        return {STATE: tensors, CONFIG: asdict(self.head_config)}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `Task`."""
        network.read(content, path, WHERE_FROM)

    def _pairs(self, split: str, *, is_augmented: bool = False) -> LatentPairs:
        data, network = self._config.data, self._config.network
        return LatentPairs(data, split, network.bins, network.balance, is_augmented)
