"""Numbered clips of a data set, and the settings of their runs."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from texvent.batch.identity import derived_seed, digest
from texvent.config import InterpolateConfig
from texvent.dataset.specification.items import KEY_DIGITS, Item, Items
from texvent.dataset.specification.specification import (
    Specification,
    Variant,
    draw_options,
    extreme_options,
)
from texvent.errors import ConfigError
from texvent.options.values import option_names
from texvent.run.prepare import check_run
from texvent.settings.config_files import Command
from texvent.settings.resolution import Settings, resolve

MOST_SHARDS = 1_000_000
"""Most shards of a variant."""


@dataclass(frozen=True, slots=True)
class Clip:
    """One video of a data set, of which every variant makes samples."""

    key: str
    """Identity of the clip: a digest of its item and its seed."""
    item: Item
    split: str
    number: int
    """Place in its split."""
    seed: int
    """Seed of its video, and what those of its simulations are derived from."""


class Clips:
    """All clips, each computed from its number: none is stored.

    The prompts of a split are in the order of a digest, so every shard holds some of each kind,
    and repeat after repeat.
    """

    def __init__(self, specification: Specification, items: Items) -> None:
        """Share the items out over the splits.

        Raises:
            ConfigError: a split would be empty.
        """
        self._seed = specification.seed
        self._repeats = specification.repeats
        self._items = _share_out(specification, items)
        shards = sum(-(-count // specification.samples_per_shard) for count in self.counts.values())
        if shards > MOST_SHARDS:
            raise ConfigError(
                f"{shards:,} shards are too many for a folder, which holds {MOST_SHARDS:,}; set a "
                "larger samples_per_shard"
            )
        for split, share in specification.splits.items():
            if share > 0 and not self._items[split]:
                raise ConfigError(
                    f"split {split} would be empty: {len(items.all)} prompts or videos are too "
                    f"few for a share of {share:g}; give more, or other splits"
                )

    @property
    def counts(self) -> dict[str, int]:
        """Split → number of clips."""
        return {split: len(items) * self._repeats for split, items in self._items.items()}

    def clip(self, split: str, number: int) -> Clip:
        """The clip at a place, 0 ≤ number < counts[split]."""
        repeat, place = divmod(number, len(self._items[split]))
        item = self._items[split][place]
        seed = video_seed(self._seed, item.key, item.seed, repeat)
        return Clip(clip_key(item.key, seed), item, split, number, seed)


def video_seed(root: int, item_key: str, item_seed: int | None, repeat: int) -> int:
    """Seed of a repeat of an item, from 0; the first has the one that its list gives, if any."""
    if repeat == 0 and item_seed is not None:
        return item_seed
    return derived_seed(root, item_key, repeat)


def clip_key(item_key: str, seed: int) -> str:
    """Key of the video of an item with a seed."""
    return digest([item_key, seed])[:KEY_DIGITS]


def _share_out(specification: Specification, items: Items) -> dict[str, list[Item]]:
    """Split → its items: those that ask for it, and its share of the others."""
    seed = specification.seed
    ordered = sorted(items.all, key=lambda item: digest([seed, "order", item.key]))
    shared: dict[str, list[Item]] = {split: [] for split in specification.splits}
    free: list[Item] = []
    for item in ordered:
        (free if item.split is None else shared[item.split]).append(item)
    begin, sum_of_shares = 0, 0.0
    for split, share in specification.splits.items():
        sum_of_shares += share
        end = min(math.floor(sum_of_shares * len(free) + 0.5), len(free))
        shared[split] += free[begin:end]
        begin = end
    return shared


def check_options(specification: Specification, command: Command, *, is_stored: bool) -> None:
    """Refuse options that some run would refuse, and options of a variant that change the video.

    Args:
        specification: of the data set.
        command: whose options it has.
        is_stored: whether videos are stored before they are simulated.

    Raises:
        ConfigError, InputError, MissingDependencyError: as `texvent.run.prepare.check_run`.
    """
    for variant in specification.variants:
        for options in extreme_options(_options(specification, variant, is_stored)):
            settings = resolve(command, options)
            check_run(settings)
            if command == "generate":
                _refuse_video_options(settings, variant)


def _refuse_video_options(settings: Settings, variant: Variant) -> None:
    of_video = {"generator", *option_names(type(settings.source))}
    for name in variant.options:
        if name in of_video:
            raise ConfigError(
                f"variant {variant.name} sets {name}, which changes the video; all variants are "
                "simulated from the same one: set it in options"
            )


def video_settings(specification: Specification, clip: Clip, command: Command) -> Settings:
    """Settings of a clip's video, at the size of its generator."""
    options = draw_options(specification.options, specification.seed, clip.key)
    settings = resolve(command, {**options, "seed": clip.seed})
    return dataclasses.replace(settings, run=dataclasses.replace(settings.run, sensor=None))


def clip_settings(
    specification: Specification, variant: Variant, clip: Clip, command: Command, *, is_stored: bool
) -> Settings:
    """Settings of a clip in a variant; the seed is that of the video.

    What is drawn depends on the clip alone, so that all variants of a clip share it.
    """
    options = draw_options(
        _options(specification, variant, is_stored), specification.seed, clip.key
    )
    return resolve(command, {**options, "seed": clip.seed})


def simulation_seed(clip: Clip, number: int) -> int:
    """Seed of the simulation `number` of a clip; the first is the clip's own."""
    return clip.seed if number == 0 else derived_seed(clip.seed, "simulation", number)


def _options(specification: Specification, variant: Variant, is_stored: bool) -> Mapping[str, Any]:
    # A stored video cannot be rendered at any instant, whatever its generator could do.
    basis = {"interpolate": InterpolateConfig.interpolate} if is_stored else {}
    return {**basis, **specification.options, **variant.options}
