"""Scenes of a specification as frames and true changes of brightness, each rendered once."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.simulated_clips import SimulatedClips
from texvent.errors import InputError
from texvent.io.atomic import atomic_file
from texvent.transfer import WHITE, Transfer
from texvent.video import transfer_of
from texvent_lab.latents.change import BrightnessChange, measure_change

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
