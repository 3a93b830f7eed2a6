"""Estimates of a trial against the data set that is made."""

import pytest
from tests.dataset.generation.small_sets import clips_recipe, make

from texvent.dataset.generation.dry_run import try_samples
from texvent.dataset.generation.shard_files import size_in_tar
from texvent.dataset.stored.folder import StoredDataset
from texvent.runtime.progress import NO_PROGRESS


def test_a_trial_of_all_clips_tells_samples_events_and_bytes_of_the_data_set(tmp_path):
    recipe = clips_recipe(tmp_path, clips=2)
    make(recipe, tmp_path / "out")
    for stage in try_samples(recipe, 2, NO_PROGRESS):
        shards = StoredDataset.open(tmp_path / "out").shards(stage.name)
        samples = [sample for shard in shards for sample in shard.samples]
        sizes = [size_in_tar(size) for one in samples for _, size in one.members.values()]
        assert (
            stage.samples == stage.tried == len(samples) == 2 * {"paper": 3, "esim": 1}[stage.name]
        )
        assert stage.events == pytest.approx(sum(one.events for one in samples) / len(samples))
        assert stage.bytes == pytest.approx(sum(sizes) / len(samples), rel=0.02)
