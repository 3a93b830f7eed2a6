"""Voxel grids of runs of windows with what the simulated scene knows exactly: flow or depth."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from texvent.dataset.samples import Target
from texvent.errors import ConfigError
from texvent.represent.event_frame import count_events
from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.train.batches import Batches
from texvent_lab.train.sequences.clips import WindowedClips
from texvent_lab.train.sequences.config import SequenceData
from texvent_lab.train.sequences.views import crop_randomly, flip

TRUTHS: tuple[Target, ...] = ("flow", "depth")
"""Of every stored clip, so that depth and flow are trained on the same files."""
GRIDS, SEEN = "grids", "seen"
"""Names in an example; its truth has the name of the target."""


@dataclass(frozen=True)
class TruthExamples:
    """Examples by number of the clip; see `__call__`."""

    clips: WindowedClips
    target: Target
    bins: int
    """Of the voxel grids."""
    flips_x: bool = False
    """Mirror half of the examples left to right."""
    flips_y: bool = False
    """Turn half of them upside down."""
    is_whole: bool = False
    """All windows of a clip, as they are; else a random run of them, cropped and mirrored."""

    @classmethod
    def open(
        cls, data: SequenceData, split: str, target: Target, bins: int, **options: bool
    ) -> TruthExamples:
        """The examples of a split; its first clip is simulated.

        Args:
            data: which clips, and how they are cut.
            split: which of them.
            target: flow or depth.
            bins: of the voxel grids.
            options: see above.

        Raises:
            InputError, ConfigError: as `WindowedClips.open`, or the clips come from videos.
        """
        clips = WindowedClips.open(data, split, TRUTHS)
        if target not in clips.targets:
            raise ConfigError(
                f"{data.specification} simulates videos, whose {target} is not known; give prompts "
                "for the generator 'procedural'"
            )
        return cls(clips, target, bins, **options)

    def __len__(self) -> int:
        """Number of clips."""
        return len(self.clips)

    @property
    def identity(self) -> str:
        """See `MakeSample`."""
        return self.clips.identity

    def batches(self, batch_size: int, *, seed: int, workers: int) -> Batches:
        """The examples in batches; whole clips stay in their order."""
        return Batches(
            make=self,
            count=len(self),
            batch_size=batch_size,
            seed=seed,
            shuffle=not self.is_whole,
            workers=workers,
        )

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """An example.

        Args:
            number: of the clip.
            chance: of this clip in this epoch.

        Returns:
            * `grids`: voxel grids as E2VID sees them, normalised, [windows, bins, H, W].
            * the target: [windows, 2, H, W] px for flow, [windows, 1, H, W] m for depth.
            * `seen`: where there is an event, [windows, H, W] bool.

        Raises:
            InputError: the clip is too short, or cannot be simulated.
        """
        windows = self.clips.read(number) if self.is_whole else self.clips.draw(number, chance)
        grids = [voxel_e2vid(one, bins=self.bins, normalise=True) for one in windows.events]
        seen = [count_events(one).any(axis=0) for one in windows.events]
        truth = windows.targets[self.target]
        if truth.ndim == 3:
            truth = truth[:, None]
        maps = {GRIDS: np.stack(grids), SEEN: np.stack(seen), self.target: truth}
        if not self.is_whole:
            maps = crop_randomly(maps, self.clips.data.crop, chance)
            x, y = chance.random(2) < 0.5
            maps = flip(maps, x=bool(self.flips_x and x), y=bool(self.flips_y and y))
        return {name: np.ascontiguousarray(one) for name, one in maps.items()}
