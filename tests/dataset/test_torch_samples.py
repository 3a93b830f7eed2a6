"""Batches in torch: what direct reading gives, in this process and in others."""

from __future__ import annotations

import numpy as np
import pytest
from tests.dataset.conftest import dropped
from tests.dataset.stored.written_set import random_events, write_shard

import texvent.dataset

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")


def batches(samples, *, batch_size, workers=0, **options):
    """Batches of torch's loader."""
    from texvent.dataset.torch_samples import SampleDataset, collate

    context = {"num_workers": workers, "multiprocessing_context": "spawn"} if workers else {}
    dataset = SampleDataset(samples, **options)
    return torch.utils.data.DataLoader(
        dataset, batch_size=batch_size, collate_fn=collate, **context
    )


def test_batches_are_what_the_samples_give_in_any_process_and_epoch(table):
    changed = table.augmented(dropped, seed=2).represented("voxel-e2vid")
    for epoch, workers in ((0, 0), (1, 1)):
        options = {"epoch": epoch, "workers": workers, "first": 3, "count": 5}
        (first, second) = batches(changed, batch_size=4, **options)
        expected = [changed.make(number, epoch=epoch) for number in range(3, 8)]
        assert second["number"].tolist() == [7]
        assert first.keys() == expected[0].keys()
        for name, values in first.items():
            wanted = [one[name] for one in expected[:4]]
            if isinstance(wanted[0], str):
                assert values == wanted
                continue
            np.testing.assert_array_equal(values.numpy(), wanted)
            assert values.dtype == torch.as_tensor(wanted[0]).dtype


def test_a_pass_takes_every_stored_sample_or_every_source_once(table):
    (batch,) = batches(table.represented("event-frame"), batch_size=99)
    assert batch["number"].tolist() == list(range(table.count))


def test_events_of_a_batch_lie_end_to_end(tmp_path):
    streams = {"a": random_events(1, 30), "b": random_events(2, 0), "c": random_events(3, 7)}
    write_shard(tmp_path, "paper", "train", 0, streams)
    (batch,) = batches(texvent.dataset.open(tmp_path), batch_size=3)
    events = batch["events"]
    assert len(events) == 3
    for tensors, stream in zip(events, streams.values(), strict=True):
        assert tensors.size == stream.size
        for name in "xytp":
            np.testing.assert_array_equal(getattr(tensors, name).numpy(), getattr(stream, name))
    assert events.sample.tolist() == [0] * 30 + [2] * 7
    assert events.to("cpu").ends == (30, 30, 37)
    assert events[-1].t.tolist() == streams["c"].t.tolist()
    from texvent.represent.named import represent

    np.testing.assert_array_equal(
        represent("voxel-e2vid", events[0]).numpy(), represent("voxel-e2vid", streams["a"])
    )


def test_slices_and_unequal_shapes_become_lists(tmp_path):
    write_shard(tmp_path, "paper", "train", 0, {"a": random_events(1, 30), "b": random_events(2)})
    samples = texvent.dataset.open(tmp_path, slice_events=10)
    (batch,) = batches(samples, batch_size=2)
    assert [len(slices) for slices in batch["events"]] == [3, 4]
    assert [len(one) for one in batch["events"][1]] == [10] * 4
    (batch,) = batches(samples.represented("event-frame", slice_events=10), batch_size=2)
    assert [one.shape[0] for one in batch["representation"]] == [3, 4]
