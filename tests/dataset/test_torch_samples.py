"""Batches in torch: what direct reading gives, in this process and in others."""

from __future__ import annotations

import numpy as np
import pytest
from tests.dataset.stored.written_set import random_events, write_set, write_shard

import texvent.dataset
from texvent.dataset.simulated_samples import SimulatedSamples
from texvent.events import EventStream

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

CLIP = np.full((4, 6, 8), 200, np.uint8)
for _index in range(4):
    CLIP[_index, 2:4, _index : _index + 3] = 20


def batches(samples, *, batch_size, workers=0, **options):
    """Batches of torch's loader."""
    from texvent.dataset.torch_samples import SampleDataset, collate

    context = {"num_workers": workers, "multiprocessing_context": "spawn"} if workers else {}
    dataset = SampleDataset(samples, **options)
    return torch.utils.data.DataLoader(
        dataset, batch_size=batch_size, collate_fn=collate, **context
    )


@pytest.fixture(scope="module")
def samples(tmp_path_factory):
    folder = tmp_path_factory.mktemp("set") / "cars"
    write_set(folder)
    return texvent.dataset.open(folder, representation="voxel-e2vid")


def test_batches_are_what_direct_reading_gives(samples):
    (first, *_) = batches(samples, batch_size=5)
    expected = [samples.make(number) for number in range(5)]
    for name in ("representation", "stop_us"):
        np.testing.assert_array_equal(first[name].numpy(), [one[name] for one in expected])
    assert first["class_number"].tolist() == [0, 1, 0, 0, 1]
    assert first["class_number"].dtype == torch.int64
    assert first["key"] == ["k000", "k001", "k002", "k003", "k004"]
    assert first["caption"][1] == "a car drives left"


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


def dropped(events: EventStream, chance: np.random.Generator) -> EventStream:
    """Mirrored by chance, some events dropped."""
    events = events.flip("x") if chance.random() < 0.5 else events
    return events[chance.random(len(events)) < 0.7]


def test_augmentations_depend_on_epoch_and_number_and_not_on_workers(samples):
    changed = samples.augmented(dropped, seed=2)
    for epoch, workers in ((0, 0), (1, 1)):
        for batch in batches(changed, batch_size=4, workers=workers, epoch=epoch):
            for number, array in zip(
                batch["number"].tolist(), batch["representation"], strict=True
            ):
                expected = changed.make(number, epoch=epoch)["representation"]
                np.testing.assert_array_equal(array.numpy(), expected)


def test_simulated_samples_are_the_same_in_another_process():
    samples = SimulatedSamples(
        videos=[CLIP, CLIP[::-1].copy()],
        slice_us=50_000,
        targets=["frame"],
        simulation={"fps": 20, "interpolate": "none", "randomize": "stoffregen"},
        seed=3,
    )
    alone, shared = (list(batches(samples, batch_size=2, workers=n, count=5)) for n in (0, 1))
    assert [batch["number"].tolist() for batch in shared] == [[0, 1], [2, 3], [4]]
    for one, other in zip(alone, shared, strict=True):
        assert one.keys() == other.keys()
        assert all(torch.equal(one[name], other[name]) for name in one)
    expected = samples.make(2)
    assert alone[1]["source"].tolist() == [0, 1]
    for name in ("representation", "frame"):
        np.testing.assert_array_equal(alone[1][name][0].numpy(), expected[name])
    (batch,) = batches(samples, batch_size=2, first=7)
    assert batch["number"].tolist() == [7, 8]
