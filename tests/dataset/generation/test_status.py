"""The state of a data set, read from its folder; what is known to be complete is not read again."""

from __future__ import annotations

from pathlib import Path

from tests.dataset.generation.small_sets import clips_recipe, make

from texvent.dataset.generation.recipe import Shard
from texvent.dataset.generation.shards import ShardSummary
from texvent.dataset.generation.status import read_status


def test_complete_shards_are_read_once(tmp_path: Path) -> None:
    recipe, folder = clips_recipe(tmp_path), tmp_path / "out"
    work = make(recipe, folder)
    seen: dict[Shard, ShardSummary] = {}
    first = read_status(recipe, folder, seen)
    assert [(one.samples, one.total, one.complete) for one in first] == [(18, 18, 3), (6, 6, 3)]
    assert sum(one.events for one in first) == sum(one.events for one in work.complete.values())
    assert seen == work.complete
    for record in folder.rglob("train-*.json"):
        record.unlink()
    assert read_status(recipe, folder, seen) == first
    assert all(one.complete == 0 for one in read_status(recipe, folder))
