"""Reconstruction learned from the training stream: clips are cut and their pixels drawn anew."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import numpy as np

from texvent.dataset.generation.recipe import Recipe
from texvent.dataset.specification.reading import read_specification
from texvent.errors import InputError
from texvent.options.values import plain
from texvent.runtime.identity import derived_seed, digest
from texvent.training import Clip, EventStream, PromptClips
from texvent_lab.train.one_clip import OneClip
from texvent_lab.train.reconstruction.config import ReconstructionConfig
from texvent_lab.train.reconstruction.task import IMAGES, VOXELS, WHITE, ReconstructionTask
from texvent_lab.train.task import Batches

MOST_BYTES = 2**30


class StreamedTask(ReconstructionTask):
    """A reconstruction that learns from `EventStream`; it validates as any other does.

    The loss has no term of flow, and grids have the noise and pauses of the stream's draws alone.
    """

    def __init__(self, config: ReconstructionConfig, randomize: str) -> None:
        """As `ReconstructionTask`.

        Args:
            config: the training; its specification lists prompts.
            randomize: draws of the stream, see `EventStream`.
        """
        super().__init__(config)
        self._examples = StreamedExamples(config, randomize)

    def batches(self, *, workers: int) -> Batches:
        """See `TrainingTask`."""
        config = self._config
        return Batches(
            make=self._examples,
            count=len(self._examples.prompts),
            batch_size=config.schedule.batch_size,
            seed=config.seed,
            workers=workers,
        )


@dataclass
class StreamedExamples:
    """Voxel grids and true images of a clip of the stream, by number of the prompt."""

    config: ReconstructionConfig
    randomize: str
    prompts: list[tuple[str, int]] = field(init=False)
    """Prompt and seed of each clip."""
    options: dict[str, Any] = field(init=False)
    """Options of the videos."""

    def __post_init__(self) -> None:
        data = self.config.data
        spec = read_specification(data.specification)
        every = Recipe.of(spec).clips
        items = [every.clip(data.split, n).item for n in range(every.counts[data.split])]
        if any(one.prompt is None for one in items):
            raise InputError(f"{data.specification} lists videos; the stream needs prompts here")
        self.prompts = [
            (str(one.prompt), derived_seed(spec.seed, one.key) if one.seed is None else one.seed)
            for one in items
        ]
        # What is drawn for each clip, such as thresholds, the stream draws itself.
        self.options = {n: one for n, one in spec.options.items() if not isinstance(one, Mapping)}

    @property
    def identity(self) -> str:
        """See `MakeSample`."""
        return digest([self.randomize, self.prompts, self.options])

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """A run of the clip.

        Returns:
            `voxels` [windows, bins, H, W] and `images` [windows, 1, H, W], 0..1, all float32.
        """
        data = self.config.data
        clip = self.clip(number)
        between_us = float(np.median(np.diff(clip.times_us)))
        side = data.crop or clip.frames.shape[1]
        stream = EventStream(
            OneClip(clip),
            batch=1,
            frames=data.length,
            size=(side, side),
            frames_per_grid=max(1, round(data.slice_us / between_us)),
            randomize=self.randomize,
            seed=int(chance.integers(2**62)),
            rank=0,
            world=1,
        )
        batch = next(iter(stream))
        images = batch.frames[0, :, None].numpy().astype(np.float32) / WHITE
        return {VOXELS: batch.grids[0].numpy(), IMAGES: images}

    def clip(self, number: int) -> Clip:
        """A clip in memory, made once for all trainings of a process."""
        return _rendered(*self.prompts[number], json.dumps(plain(self.options), sort_keys=True))


@cache
def _rendered(prompt: str, seed: int, options: str) -> Clip:
    return PromptClips([prompt], **json.loads(options), seed=seed).read(0, (), MOST_BYTES)
