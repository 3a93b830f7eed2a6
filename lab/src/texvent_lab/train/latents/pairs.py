"""Pairs to train a head on: latents of a scene's frames, and the scene's changes of brightness."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.cache_folder import cache_folder, make_folder
from texvent_lab.latents.autoencoder import Autoencoder
from texvent_lab.train.latents.config import LatentData
from texvent_lab.train.latents.scenes import Arrays, LatentScenes, keep

LATENTS: Final = "latents"
MIRRORED: Final = "mirrored latents"
CHANGE: Final = "change"


@dataclass(frozen=True)
class LatentPairs:
    """Pairs by number of the scene; each is made once and kept."""

    data: LatentData
    split: str
    bins: int
    balance: float
    is_augmented: bool = False
    """Whether half of the pairs are mirrored left to right, if the data say so."""

    def __len__(self) -> int:
        """Number of scenes."""
        return len(self.scenes)

    @property
    def identity(self) -> str:
        """See `MakeSample`."""
        return f"{self.scenes.clips.recipe.identity} {self.autoencoder.digest}"

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, NDArray[Any]]:
        """A pair.

        Args:
            number: of the scene.
            chance: decides whether it is mirrored.

        Returns:
            * `latents`: as the diffusion model denoises them, [C, T, h, w] float32.
            * `change`: [T − 1, bins, H, W] float32, log units; see `texvent_lab.latents.change`.

        Raises:
            InputError: the frames do not fit the autoencoder, or cannot be rendered in between.
        """
        frames, change = self.scenes.read(number)

        def encode() -> Arrays:
            encoded = {LATENTS: frames, MIRRORED: frames[:, :, ::-1]}
            return {
                name: self.autoencoder.encode(one, change.fps).values
                for name, one in encoded.items()
            }

        identity = self.scenes.identity(number, self.autoencoder.digest)
        latents = keep(self._folder / f"{identity}.npz", encode)
        if self.is_augmented and self.data.flip_x and chance.random() < 0.5:
            flipped = np.ascontiguousarray(change.voxels[..., ::-1])
            return {LATENTS: latents[MIRRORED], CHANGE: flipped}
        return {LATENTS: latents[LATENTS], CHANGE: change.voxels}

    @cached_property
    def autoencoder(self) -> Autoencoder:
        """What encodes the scenes."""
        return Autoencoder.load(self.data.autoencoder)

    @cached_property
    def scenes(self) -> LatentScenes:
        """What is encoded."""
        return LatentScenes(
            self.data.specification,
            self.split,
            self._folder,
            self.bins,
            self.autoencoder.frames_per_latent,
            self.balance,
            self.data.variant,
        )

    @cached_property
    def _folder(self) -> Path:
        folder: Path = self.data.cache or cache_folder("latents")
        make_folder(folder)
        return folder
