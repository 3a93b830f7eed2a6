"""Failed samples made again: a kill between the new file and its record harms nothing."""

from __future__ import annotations

from pathlib import Path

import pytest
from tests.dataset.generation.small_sets import clips_recipe, digests, make

from texvent.dataset.generation import make_shard
from texvent.dataset.generation.make import find_work
from texvent.dataset.generation.shards import FAILED


def test_a_record_of_before_never_stands_beside_the_new_file(
    tmp_path: Path,
) -> None:
    recipe = clips_recipe(tmp_path, clips=8, samples_per_shard=8, variants={"esim": {}})
    bad = tmp_path / "clips" / "0.npy"
    good = bad.read_bytes()
    bad.write_bytes(b"no array")
    folder = tmp_path / "out"
    (counts,) = make(recipe, folder).complete.values()
    assert counts[FAILED] == 1
    bad.write_bytes(good)
    (task,) = find_work(recipe, folder, retry_failed=True).todo
    shard = folder / task.shard.path
    with pytest.MonkeyPatch.context() as patch:

        def killed(*words: object) -> None:
            raise KeyboardInterrupt

        patch.setattr(make_shard, "write_record", killed)
        with pytest.raises(KeyboardInterrupt):
            make_shard.make_shard(recipe, folder, task.shard, retry_failed=True)
    assert shard.exists()
    assert not shard.with_suffix(".json").exists()
    assert len(find_work(recipe, folder).todo) == 1
    make(recipe, folder)
    make(recipe, tmp_path / "wanted")
    assert digests(folder) == digests(tmp_path / "wanted")
