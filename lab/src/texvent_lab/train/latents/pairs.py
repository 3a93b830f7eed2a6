"""Pairs to train a head on: latents of a scene's frames, and the scene's changes of brightness."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.simulated_clips import SimulatedClips
from texvent.errors import InputError
from texvent.io.atomic import atomic_file
from texvent.runtime.cache_folder import cache_folder, make_folder
from texvent.transfer import WHITE, Transfer
from texvent.video import transfer_of
from texvent_lab.latents.autoencoder import Autoencoder
from texvent_lab.latents.change import BrightnessChange, measure_change
from texvent_lab.train.latents.config import LatentData

Arrays = dict[str, NDArray[Any]]


@dataclass(frozen=True)
class LatentScenes:
    """Scenes by number, kept in files."""

    specification: Path
    split: str
    folder: Path
    """Of the files; it must exist."""
    bins: int
    frames_per_latent: int
    balance: float
    variant: str | None = None

    def __len__(self) -> int:
        """Number of scenes."""
        return len(self.clips)

    @cached_property
    def clips(self) -> SimulatedClips:
        """The same scenes, to be simulated."""
        return SimulatedClips(self.specification, split=self.split, variant=self.variant)

    def read(self, number: int) -> tuple[NDArray[np.float32], BrightnessChange]:
        """A scene.

        Returns:
            Frames, [n, H, W, 3] float32 RGB, 0..255, and the changes between them.

        Raises:
            InputError: it cannot be rendered between its frames, is too short, or is brighter than
                white.
        """

        def render() -> Arrays:
            video = self.clips.simulation(number).video
            change = measure_change(
                video, self.bins, frames_per_latent=self.frames_per_latent, balance=self.balance
            )
            frames = np.stack([frame.pixels for frame in video]).astype(np.float32)
            if transfer_of(video) is Transfer.LINEAR or frames.max() > WHITE:
                raise InputError(
                    "the scenes are brighter than white, and autoencoders take ordinary frames; "
                    "leave hdr out of the specification"
                )
            fps = np.array([change.fps.numerator, change.fps.denominator])
            return {"frames": frames, "change": change.voxels, "fps": fps}

        found = keep(self.folder / f"{self.identity(number)}.npz", render)
        fps = Fraction(*found["fps"].tolist())
        change = BrightnessChange(found["change"], fps, self.frames_per_latent, self.balance)
        return found["frames"], change

    def identity(self, number: int, *facts: object) -> str:
        """Digest of all that decides a scene, and of other facts."""
        rules = (self.bins, self.frames_per_latent, self.balance)
        return self.clips.identity(number, *rules, *facts)


def keep(path: Path, make: Callable[[], Arrays]) -> Arrays:
    """The arrays of a file, made now if it is not there."""
    if not path.exists():
        arrays = make()
        with atomic_file(path, overwrite=True) as part, part.open("wb") as file:
            np.savez(file, allow_pickle=False, **arrays)
        return arrays
    with np.load(path) as file:
        return dict(file)


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
