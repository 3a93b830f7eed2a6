"""Maps learned from windows of events with exact truth: examples, and the task that scores them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.samples import Target
from texvent.errors import ConfigError
from texvent.networks.weight_files import STATE
from texvent.represent.event_frame import count_events
from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.train.schedule import TrainingConfig
from texvent_lab.train.sequences import SequenceData, WindowedClips
from texvent_lab.train.task import Batches, Score

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
            maps = flip_randomly(maps, chance, x=self.flips_x, y=self.flips_y)
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


def flip_randomly(
    maps: Maps, chance: np.random.Generator, *, x: bool = True, y: bool = True
) -> dict[str, Any]:
    """Mirrored along each axis with probability 1/2, if that axis is chosen at all."""
    drawn_x, drawn_y = chance.random(2) < 0.5
    return flip(maps, x=bool(x and drawn_x), y=bool(y and drawn_y))


class TruthTask:
    """A network that predicts a map for each window, scored at all pixels and at those with events.

    Subclasses name what they predict and the network, its loss and its errors.
    """

    score: ClassVar[Score]
    target: ClassVar[Target]
    errors: ClassVar[type[Any]]
    """Class with `update(predicted, true, mask)` and `compute`, of `texvent.metrics`."""
    where_from: ClassVar[str]
    """Source of weights that fit, for messages."""

    def __init__(
        self, config: TrainingConfig, data: SequenceData, *, bins: int, **flips: bool
    ) -> None:
        """Open the validation samples.

        Args:
            config: of the training.
            data: its clips.
            bins: of the voxel grids.
            flips: `flips_x` and `flips_y` of the training samples.

        Raises:
            InputError, ConfigError, FileFormatError: they do not fit; the message says why.
        """
        self._config, self._data, self._bins, self._flips = config, data, bins, flips
        self._validation = TruthExamples.open(
            data, data.validation_split, self.target, bins, is_whole=True
        )

    def predict(self, network: Any, grids: Any) -> Any:
        """Predicted maps of a clip, [windows, ...] as the truth, from [windows, bins, H, W]."""
        raise NotImplementedError

    def batches(self, *, workers: int) -> Batches:
        """See `Task`."""
        examples = TruthExamples.open(
            self._data, self._data.split, self.target, self._bins, **self._flips
        )
        schedule, seed = self._config.schedule, self._config.seed
        return Batches(examples, len(examples), schedule.batch_size, seed, workers=workers)

    def validate(
        self, network: Any, device: Any, *, workers: int
    ) -> tuple[dict[str, float], dict[str, list[Any]]]:
        """Errors on all windows, and the score where there are events."""
        whole, seen = self.errors(), self.errors()
        clips = Batches(
            self._validation, len(self._validation), 1, 0, shuffle=False, workers=workers
        )
        for batch in clips.epoch(0):
            found = self.predict(network, batch[GRIDS][0].to(device)).float().cpu().numpy()
            true, mask = batch[self.target][0].numpy(), batch[SEEN][0].numpy()
            for window in range(len(found)):
                whole.update(found[window], true[window])
                seen.update(found[window], true[window], mask[window])
        name = self.score.name
        return {**whole.compute(), f"{name} at events": seen.compute()[name]}, {}

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `Task`."""
        return {STATE: {name: one.detach().cpu() for name, one in network.tensors.items()}}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `Task`."""
        network.read(content, path, self.where_from)
