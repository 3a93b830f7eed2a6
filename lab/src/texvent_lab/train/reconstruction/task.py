"""Reconstruction: events → images, by a network with memory."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from texvent.dataset.simulated_samples import Target
from texvent.errors import ConfigError, InputError
from texvent.extending import require
from texvent.metrics.image_measures import Float64Array
from texvent.metrics.lpips import find_lpips_weights, read_lpips_weights
from texvent.networks import STATE, Tensor
from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.networks.layers import make_seeded
from texvent_lab.reconstruct.image_measures import load_measures
from texvent_lab.reconstruct.reconstructor import Intensity, Reconstructor
from texvent_lab.reconstruct.recurrent_network import PublishedNetwork, RecurrentNetwork
from texvent_lab.registries import RECONSTRUCTORS
from texvent_lab.train.reconstruction.augmentation import (
    FLOW,
    add_hot_pixels,
    add_noise,
    crop_randomly,
    draw_pauses,
    flip_randomly,
)
from texvent_lab.train.reconstruction.config import (
    ExtraClips,
    ReconstructionAugmentation,
    ReconstructionConfig,
)
from texvent_lab.train.reconstruction.losses import SequenceLoss
from texvent_lab.train.reconstruction.recorded_clips import (
    ExtendedClips,
    NumberedClips,
    RecordedClips,
)
from texvent_lab.train.reconstruction.sequences import SequenceData, WindowedClips
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.task import Batches


def new_network(published: PublishedNetwork, seed: int) -> RecurrentNetwork:
    """A network of the published names and shapes, with initial weights."""
    return make_seeded(lambda: published.network.like({}, {}), seed)


VOXELS, IMAGES = "voxels", "images"
WHITE = np.float32(255)


class ReconstructionTask:
    """Closeness to the true images and consistency in time, scored as the benchmark scores.

    Source: H. Rebecq et al., "High speed and high dynamic range video with an event camera", TPAMI
        2021, section 3.2; T. Stoffregen et al., "Reducing the sim-to-real gap for event cameras",
        ECCV 2020.
    """

    score: ClassVar[str] = "ssim"

    def __init__(self, config: ReconstructionConfig) -> None:
        """Read the specification and simulate the first validation clip.

        Raises:
            InputError, ConfigError, FileFormatError: the data does not fit; the message says why.
        """
        self._config = config
        self._published: PublishedNetwork = RECONSTRUCTORS.load(config.network.name)
        self._validation = _open(config.data, config.data.validation_split, ["frame"])

    @property
    def identity(self) -> str:
        """See `TrainingTask`."""
        return self._validation.identity

    @functools.cached_property
    def _loss(self) -> SequenceLoss:
        options = self._config.loss
        weights = None
        if options.lpips:
            weights = read_lpips_weights(find_lpips_weights())
        return SequenceLoss(options, weights)

    def make_network(self) -> Any:
        """See `TrainingTask`."""
        return new_network(self._published, self._config.seed)

    def batches(self, *, workers: int) -> Batches:
        """See `TrainingTask`."""
        config, published = self._config, self._published
        has_flow = config.loss.consistency and config.extra.specification is None
        targets: list[Target] = ["frame", "flow"] if has_flow else ["frame"]
        clips = _open(config.data, config.data.split, targets)
        if config.extra.specification is not None:
            clips = _extended(clips, config.extra)
        network = self.make_network()
        self._check_sides(clips, network.multiple)
        return Batches(
            make=ReconstructionExamples(
                clips, config.augmentation, network.bins, published.is_normalised
            ),
            count=len(clips),
            batch_size=config.schedule.batch_size,
            seed=config.seed,
            workers=workers,
        )

    def _check_sides(self, clips: NumberedClips, multiple: int) -> None:
        """Refuse a crop that the network or its loss cannot take."""
        crop = clips.data.crop
        sides = tuple(clips.size) if crop is None else (crop, crop)
        least_side = self._loss.least_side
        if min(sides) < least_side or any(side % multiple for side in sides):
            raise ConfigError(
                f"{self._published.name} would be trained on {sides[0]}x{sides[1]} px; give a crop "
                f"of at least {least_side} px"
                + (f" that {multiple} divides" if multiple > 1 else "")
            )

    def loss(self, network: Any, batch: Mapping[str, Any], device: Any) -> Tensor:
        """See `TrainingTask`."""
        images = network(batch[VOXELS].to(device)).float()
        flow = batch[FLOW].to(device) if FLOW in batch else None
        return self._loss.to(device)(images, batch[IMAGES].to(device), flow)

    def validate(
        self, network: Any, device: Any, *, workers: int
    ) -> tuple[dict[str, float], dict[str, list[Any]]]:
        """Means over windows of whole clips, by the path that `texvent reconstruct` takes."""
        del workers
        torch, measures = require("torch", extra=EXTRA), load_measures().chosen
        same = self._published.network.from_tensors(self._tensors(network), {})
        reconstructor = Reconstructor(self._published, same, device=str(device))
        values: dict[str, list[float]] = {one.name: [] for one in measures}
        with torch.autocast(device.type, enabled=False):
            for number in range(len(self._validation)):
                windows = self._validation.read(number)
                reconstructor.reset()
                pairs = zip(windows.events, windows.targets["frame"], strict=True)
                for place, (events, frame) in enumerate(pairs):
                    image = reconstructor.reconstruct(events)
                    if (place + 1) % self._config.score_every == 0:
                        for one in measures:
                            values[one.name].append(one.compare(*_as_scored(image, frame)))
        # Small images have no LPIPS.
        defined = {name: [x for x in values[name] if not np.isnan(x)] for name in values}
        return {name: float(np.mean(numbers)) for name, numbers in defined.items() if numbers}, {}

    def published(self, network: Any) -> Mapping[str, Any]:
        """See `TrainingTask`."""
        return {STATE: {name: one.cpu() for name, one in self._tensors(network).items()}}

    def read(self, network: Any, content: Mapping[str, Any], path: Path) -> None:
        """See `TrainingTask`."""
        network.read(content, path, self._published.where_from)

    def _tensors(self, network: Any) -> dict[str, Tensor]:
        return {name: one.detach() for name, one in network.tensors.items()}


def _open(data: SequenceData, split: str, targets: list[Target]) -> NumberedClips:
    """The clips of a split; recordings have frames alone."""
    if data.recordings:
        return RecordedClips.open(data, split)
    return WindowedClips.open(data, split, targets)


def _extended(clips: NumberedClips, extra: ExtraClips) -> ExtendedClips:
    """The clips, and a share of simulated ones.

    Raises:
        InputError: there are not as many, or they are of another sensor and not cropped.
    """
    data = dataclasses.replace(
        clips.data,
        recordings=(),
        specification=extra.specification or Path(),
        variant=extra.variant,
    )
    more = WindowedClips.open(data, extra.split, ["frame"])
    count = max(1, round(extra.share * len(clips)))
    if count > len(more):
        raise InputError(
            f"share is {extra.share:g} of {len(clips)} clips, {count} simulated ones, and "
            f"{extra.specification} has {len(more)} of split {extra.split}; give it more"
        )
    if data.crop is None and more.size != clips.size:
        raise InputError(
            f"{extra.specification} has a sensor of {more.size}, the other clips of {clips.size}; "
            "give crop, or that sensor"
        )
    return ExtendedClips(clips, more, count)


def _as_scored(image: Intensity, frame: NDArray[np.float32]) -> tuple[Float64Array, Float64Array]:
    """An image, 0..1, and the true one, 0..255, as measures compare them."""
    return image.astype(np.float64), np.clip(frame.astype(np.float64) / WHITE, 0.0, 1.0)


@dataclass(frozen=True)
class ReconstructionExamples:
    """Voxel grids, true images and flow of training sequences, by number of the clip."""

    clips: NumberedClips
    augmentation: ReconstructionAugmentation
    bins: int
    is_normalised: bool

    @property
    def identity(self) -> str:
        """See `MakeSample`."""
        return self.clips.identity

    def __call__(self, number: int, chance: np.random.Generator) -> Mapping[str, Any]:
        """A random run of the clip.

        Returns:
            `voxels` [windows, bins, H, W], `images` [windows, 1, H, W], 0..1, and `flow`
            [windows, 2, H, W] if the clips have it, all float32.
        """
        options, data = self.augmentation, self.clips.data
        is_pause = draw_pauses(
            data.length, begin=options.pause_begin, stay=options.pause_stay, chance=chance
        )
        windows = self.clips.draw(number, chance, int(np.sum(~is_pause)))
        grids = [
            voxel_e2vid(events, bins=self.bins, normalise=self.is_normalised)
            for events in windows.events
        ]
        maps = {VOXELS: np.stack(grids), IMAGES: windows.targets["frame"][:, None] / WHITE}
        if "flow" in windows.targets:
            maps[FLOW] = windows.targets["flow"]
        maps = crop_randomly(maps, data.crop, chance)
        if options.flip:
            maps = flip_randomly(maps, chance)
        # A pause shows the last window again, without its events and its motion.
        maps = {name: one[np.cumsum(~is_pause) - 1] for name, one in maps.items()}
        for name in maps.keys() - {IMAGES}:
            maps[name][is_pause] = 0
        voxels = add_noise(maps[VOXELS], deviation=options.noise, chance=chance)
        maps[VOXELS] = add_hot_pixels(
            voxels,
            deviation=options.hot_pixels,
            max_fraction=options.hot_pixel_fraction,
            chance=chance,
        )
        return maps
