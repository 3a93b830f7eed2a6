"""Numbered clips of a data set, and the settings of their runs."""

from __future__ import annotations

import itertools
import math
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

from texvent.dataset.specification.items import KEY_DIGITS, Item, Items
from texvent.dataset.specification.specification import (
    Specification,
    draw_options,
    extreme_options,
)
from texvent.errors import ConfigError
from texvent.runtime.identity import derived_seed, digest
from texvent.settings.config_files import Command
from texvent.settings.resolution import Settings, resolve

ROUNDING = 1e-6
MOST_SHARDS = 1_000_000
"""Most shards of a variant."""


@dataclass(frozen=True, slots=True)
class NumberedClip:
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
    and repeat after repeat. Each class is shared out by itself.
    """

    def __init__(self, specification: Specification, items: Items) -> None:
        """Share the items out over the splits.

        Raises:
            ConfigError: a split would be empty.
        """
        self._seed = specification.seed
        self._repeats = specification.repeats
        self._shares = specification.splits
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

    @property
    def class_counts(self) -> dict[str, Counter[str]]:
        """Split → number of clips of each class."""
        return {
            split: Counter(one.label for one in items * self._repeats if one.label is not None)
            for split, items in self._items.items()
        }

    def lacking(self) -> dict[str, list[str]]:
        """Split with a share → the classes that it lacks, of those that are shared out."""
        every = itertools.chain.from_iterable(self._items.values())
        shared = {one.label for one in every if one.split is None and one.label is not None}
        counts = ((split, has) for split, has in self.class_counts.items() if self._shares[split])
        return {split: lacks for split, has in counts if (lacks := sorted(shared - has.keys()))}

    def clip(self, split: str, number: int) -> NumberedClip:
        """The clip at a place, 0 ≤ number < counts[split]."""
        repeat, place = divmod(number, len(self._items[split]))
        item = self._items[split][place]
        seed = video_seed(self._seed, item.key, item.seed, repeat)
        return NumberedClip(clip_key(item.key, seed), item, split, number, seed)


def video_seed(root: int, item_key: str, item_seed: int | None, repeat: int) -> int:
    """Seed of a repeat of an item, from 0; the first has the one that its list gives, if any."""
    if repeat == 0 and item_seed is not None:
        return item_seed
    return derived_seed(root, item_key, repeat)


def clip_key(item_key: str, seed: int) -> str:
    """Key of the video of an item with a seed."""
    return digest([item_key, seed])[:KEY_DIGITS]


def _share_out(specification: Specification, items: Items) -> dict[str, list[Item]]:
    """Split → its items: those that ask for it, and its share of the others of each class."""
    seed = specification.seed
    ordered = sorted(items.all, key=lambda item: digest([seed, "order", item.key]))
    classes: dict[str, list[Item]] = {}
    for item in ordered:
        if item.split is None:
            classes.setdefault(item.label or "", []).append(item)
    split_of: dict[str, str] = {}
    sizes = [len(classes[label]) for label in sorted(classes)]
    for label, counts in zip(sorted(classes), _part(sizes, specification.splits), strict=True):
        places = itertools.chain.from_iterable(map(itertools.repeat, counts, counts.values()))
        split_of |= {item.key: split for item, split in zip(classes[label], places, strict=True)}
    shared: dict[str, list[Item]] = {split: [] for split in specification.splits}
    for item in ordered:
        shared[item.split or split_of[item.key]].append(item)
    return shared


def _part(sizes: Sequence[int], splits: Mapping[str, float]) -> Iterator[dict[str, int]]:
    """Split → number of items, of each class of such a size.

    Each split has its share of a class to within one item; what rounding leaves over goes to the
    splits that lack most of their shares of all classes so far.
    """
    whole = sum(splits.values())
    lacking = dict.fromkeys(splits, 0.0)
    for size in sizes:
        due = {split: size * share / whole for split, share in splits.items()}
        counts = {split: math.floor(one + ROUNDING) for split, one in due.items()}
        lacking = {split: lacking[split] + due[split] - counts[split] for split in splits}
        partly = [split for split in splits if due[split] - counts[split] > ROUNDING]
        left_over = size - sum(counts.values())
        for split in sorted(partly, key=lambda split: -lacking[split])[:left_over]:
            counts[split] += 1
            lacking[split] -= 1
        yield counts


@dataclass(frozen=True, eq=False)
class ClipSettings:
    """Settings of the clips of a variant, or of the videos; resolved once, but for ranges."""

    command: Command
    options: Mapping[str, Any]
    """Some may be ranges."""
    seed: int
    """Seed of the data set."""

    @cached_property
    def extremes(self) -> tuple[Settings, ...]:
        """Settings that together hold every end and every choice of each range."""
        return tuple(resolve(self.command, one) for one in extreme_options(self.options))

    def of(self, clip: NumberedClip) -> Settings:
        """Settings of a clip; the seed is that of its video.

        What is drawn depends on the clip alone, so that all variants of a clip share it.
        """
        settings = self.extremes[0]
        if len(self.extremes) > 1:
            options = draw_options(self.options, self.seed, clip.key)
            settings = resolve(self.command, options)
        return with_seed(settings, clip.seed)


def with_seed(settings: Settings, seed: int) -> Settings:
    """The same settings with another seed."""
    return replace(settings, run=replace(settings.run, seed=seed))


def simulation_seed(clip: NumberedClip, number: int) -> int:
    """Seed of the simulation `number` of a clip; the first is the clip's own."""
    return clip.seed if number == 0 else derived_seed(clip.seed, "simulation", number)
