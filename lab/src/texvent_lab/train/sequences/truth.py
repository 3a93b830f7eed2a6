"""Windows of clips with their truth, cut for training."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.samples import Target
from texvent.errors import ConfigError
from texvent.represent.event_frame import count_events
from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.train.sequences.clips import WindowedClips
from texvent_lab.train.sequences.config import SequenceData
from texvent_lab.train.task import Batches

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


Maps = Mapping[str, NDArray[Any]]
"""Name → [..., H, W]; "flow" is [..., 2, H, W], displacement (x, y) in px."""
FLOW = "flow"


def crop_randomly(maps: Maps, side: int | None, chance: np.random.Generator) -> dict[str, Any]:
    """The same random square of every map.

    Args:
        maps: all of one height and width.
        side: of the square, px, at most the shorter side; None: everything.
        chance: of this sample in this epoch.
    """
    if side is None:
        return dict(maps)
    height, width = next(iter(maps.values())).shape[-2:]
    top, left = (int(chance.integers(length - side + 1)) for length in (height, width))
    return {name: one[..., top : top + side, left : left + side] for name, one in maps.items()}


def flip(maps: Maps, *, x: bool, y: bool) -> dict[str, Any]:
    """Every map mirrored along the axes that are chosen; displacements turn round with them."""
    steps = slice(None, None, -1 if y else 1), slice(None, None, -1 if x else 1)
    flipped = {name: one[..., *steps] for name, one in maps.items()}
    if FLOW in flipped:
        signs = np.array([-1 if x else 1, -1 if y else 1], np.float32)
        flipped[FLOW] = flipped[FLOW] * signs[:, None, None]
    return flipped


def flip_randomly(maps: Maps, chance: np.random.Generator) -> dict[str, Any]:
    """Mirrored along each axis with probability 1/2."""
    x, y = chance.random(2) < 0.5
    return flip(maps, x=bool(x), y=bool(y))
