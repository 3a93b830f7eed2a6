"""Some samples of a data set, drawn by chance and yet the same every time."""

from __future__ import annotations

import random
from dataclasses import dataclass

from texvent.dataset.contents.made_set import MadeSet, MadeShard
from texvent.dataset.contents.stored_events import read_events
from texvent.dataset.generation.records import SampleRecord
from texvent.errors import InputError, shown
from texvent.events import EventStream


@dataclass(frozen=True, kw_only=True)
class Choice:
    """Which samples to look at."""

    count: int = 24
    variant: str | None = None
    split: str | None = None
    label: str | None = None
    seed: int = 0


@dataclass(frozen=True)
class ChosenSample:
    """A sample to look at."""

    shard: MadeShard
    record: SampleRecord

    def events(self) -> EventStream:
        """Its events."""
        return read_events(self.shard.path, self.record)


def choose_samples(made: MadeSet, choice: Choice) -> list[ChosenSample]:
    """Samples in the order of the data set.

    Raises:
        InputError: there are none such.
    """
    variants = [] if choice.variant is None else [made.check_variant(choice.variant)]
    chance = random.Random(choice.seed)
    chosen: list[tuple[int, ChosenSample]] = []
    seen = 0
    for shard in made.shards(*variants):
        if choice.split not in (None, shard.record.split):
            continue
        for record in shard.samples:
            if choice.label not in (None, record.label):
                continue
            # Each sample has the same chance, and no more than those chosen are held.
            place = seen if seen < choice.count else chance.randrange(seen + 1)
            if place < choice.count:
                chosen[place : place + 1] = [(seen, ChosenSample(shard, record))]
            seen += 1
    if not chosen:
        asked = {"split": choice.split, "label": choice.label}
        asked_for = [f"{name} {shown(value)}" for name, value in asked.items() if value]
        which = f" with {' and '.join(asked_for)}" if asked_for else ""
        raise InputError(f"{made.folder} holds no samples{which}")
    return [sample for _, sample in sorted(chosen, key=lambda pair: pair[0])]
