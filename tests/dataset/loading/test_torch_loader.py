"""Batches in torch: every sample once over ranks and workers; no worker changes the order."""

from __future__ import annotations

import numpy as np
import pytest
from tests.dataset.loading.written_set import random_events, write_set, write_shard

import texvent.dataset
from texvent import Augment
from texvent.errors import ConfigError

# Python 3.12 and newer warn of forks beside threads.
pytestmark = [pytest.mark.torch, pytest.mark.filterwarnings("ignore:.*fork:DeprecationWarning")]
torch = pytest.importorskip("torch")


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("set") / "cars"
    write_set(folder)
    return folder


@pytest.fixture
def samples(folder):
    return texvent.dataset.open(folder, representation="event-frame")


def numbers(batches):
    return [batch["number"].tolist() for batch in batches]


def test_batches_are_what_direct_reading_gives(samples):
    (first, *_) = samples.loader(batch_size=5)
    expected = [samples.make(number) for number in range(5)]
    for name in ("representation", "stop_us"):
        np.testing.assert_array_equal(first[name].numpy(), [one[name] for one in expected])
    assert first["class_number"].tolist() == [0, 1, 0, 0, 1]
    assert first["class_number"].dtype == torch.int64
    assert first["key"] == ["k000", "k001", "k002", "k003", "k004"]
    assert first["caption"][1] == "a car drives left"


def test_events_of_a_batch_lie_end_to_end(folder, tmp_path):
    streams = {"a": random_events(1, 30), "b": random_events(2, 0), "c": random_events(3, 7)}
    write_shard(tmp_path, "paper", "train", 0, streams)
    (batch,) = texvent.dataset.open(tmp_path).loader(batch_size=3)
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


def test_slices_and_unequal_shapes_become_lists(folder, tmp_path):
    write_shard(tmp_path, "paper", "train", 0, {"a": random_events(1, 30), "b": random_events(2)})
    samples = texvent.dataset.open(tmp_path, slice_events=10)
    (batch,) = samples.loader(batch_size=2)
    assert [len(slices) for slices in batch["events"]] == [3, 4]
    assert [len(one) for one in batch["events"][1]] == [10] * 4
    (batch,) = samples.represented("event-frame", slice_events=10).loader(batch_size=2)
    assert [one.shape[0] for one in batch["representation"]] == [3, 4]


@pytest.mark.parametrize("options", [{}, {"shuffle": True}])
@pytest.mark.parametrize("drop_last", [False, True])
def test_ranks_get_every_sample_once(samples, options, drop_last):
    for world_size in (1, 2, 5):
        ranks = [
            samples.loader(
                batch_size=3,
                rank=rank,
                world_size=world_size,
                seed=4,
                drop_last=drop_last,
                **options,
            )
            for rank in range(world_size)
        ]
        parts = [numbers(loader) for loader in ranks]
        assert [len(loader) for loader in ranks] == list(map(len, parts))
        together = [number for part in parts for batch in part for number in batch]
        assert len(set(together)) == len(together)
        if drop_last:
            assert len({len(part) for part in parts}) == 1
            assert {len(batch) for part in parts for batch in part} == {3}
        else:
            assert sorted(together) == list(range(24))


def test_no_number_of_workers_changes_a_batch_and_epochs_differ(folder):
    samples = texvent.dataset.open(folder)
    sharing = {"batch_size": 5, "shuffle": True, "seed": 3, "rank": 1, "world_size": 2}
    alone = samples.loader(**sharing)
    expected = [list(alone) for _ in range(3)]
    assert alone.epoch == 3
    assert len({str(numbers(epoch)) for epoch in expected}) == 3
    for workers in (1, 2):
        loader = samples.loader(workers=workers, start_method="fork", **sharing)
        for batches in expected:
            for batch, other in zip(batches, loader, strict=True):
                assert batch["key"] == other["key"]
                assert torch.equal(batch["events"].t, other["events"].t)


@pytest.mark.parametrize("workers", [0, 2])
def test_an_epoch_goes_on_where_it_stopped(samples, workers):
    def loader():
        return samples.loader(
            batch_size=5, shuffle=True, seed=1, workers=workers, start_method="fork"
        )

    whole = loader()
    expected = numbers(whole) + numbers(whole)
    stopped = loader()
    seen = []
    for batch in stopped:
        seen.append(batch["number"].tolist())
        if len(seen) == 2:
            break
    state = stopped.state_dict()
    assert (state["epoch"], state["position"]) == (0, 10)
    resumed = loader()
    resumed.load_state_dict(state)
    assert resumed.state_dict() == state
    seen += numbers(resumed)
    seen += numbers(resumed)
    assert seen == expected
    # Without the state, a pass that was not finished begins again.
    assert numbers(stopped) == expected[:5]


@pytest.mark.parametrize(
    "change",
    [
        {"seed": 2},
        {"batch_size": 4},
        {"drop_last": False},
        {"rank": 0},
        {"world_size": 3},
        {"shuffle": False},
    ],
)
def test_a_state_of_another_order_is_refused(samples, change):
    options = {"batch_size": 2, "shuffle": True, "seed": 1, "drop_last": True, "rank": 1,
               "world_size": 2}  # fmt: skip
    state = samples.loader(**options).state_dict()
    (name,) = change
    with pytest.raises(ConfigError, match=f"{name} was {options.get(name, 'not set')}, is "):
        samples.loader(**options | change).load_state_dict(state)
    others = samples.select([*range(1, len(samples)), 0])
    with pytest.raises(ConfigError, match=r"samples was 24 \(.*, is 24 \("):
        others.loader(**options).load_state_dict(state)


def test_every_sample_comes_once_if_batches_get_larger(samples):
    small = samples.loader(batch_size=2, rank=1, world_size=2)
    assert next(iter(small))["number"].tolist() == [12, 13]
    large = samples.loader(batch_size=4, rank=1, world_size=2)
    large.load_state_dict(small.state_dict())
    assert numbers(large) == [[14, 15, 16, 17], [18, 19, 20, 21], [22, 23]]


def train_rank(rank, folder, store, results):
    torch.distributed.init_process_group("gloo", init_method=store, rank=rank, world_size=2)
    batches = numbers(texvent.dataset.open(folder).loader(batch_size=4, shuffle=True))
    torch.distributed.destroy_process_group()
    results.put((rank, batches))


def test_ranks_of_torch_distributed_are_taken(folder, tmp_path):
    context = torch.multiprocessing.get_context("fork")
    results = context.Queue()
    processes = [
        context.Process(target=train_rank, args=(rank, folder, f"file://{tmp_path}/store", results))
        for rank in range(2)
    ]
    for process in processes:
        process.start()
    found = dict(results.get(timeout=300) for _ in processes)
    for process in processes:
        process.join()
        assert process.exitcode == 0
    samples = texvent.dataset.open(folder)
    for rank, batches in found.items():
        sharing = {"batch_size": 4, "shuffle": True, "rank": rank, "world_size": 2}
        assert batches == numbers(samples.loader(**sharing))
    both = [number for batch in found[0] + found[1] for number in batch]
    assert sorted(both) == list(range(24))


def test_a_user_s_own_sampler_takes_the_map_style_dataset(samples):
    from texvent.dataset.loading.torch_loader import SampleDataset, collate

    loader = torch.utils.data.DataLoader(
        SampleDataset(samples), sampler=[5, 3, 8], batch_size=2, collate_fn=collate
    )
    assert numbers(loader) == [[5, 3], [8]]


@pytest.mark.parametrize("workers", [0, 2])
def test_augmentations_depend_on_epoch_and_number_and_not_on_workers(samples, workers):
    changed = samples.augmented(Augment(["flip-x", "shift:pixels=3", "drop-events"], seed=2))
    loader = changed.loader(batch_size=4, workers=workers, shuffle=True, start_method="fork")
    seen = []
    for epoch in range(2):
        for batch in loader:
            for number, array in zip(
                batch["number"].tolist(), batch["representation"], strict=True
            ):
                expected = changed.make(number, epoch=epoch)["representation"]
                np.testing.assert_array_equal(array.numpy(), expected)
                seen.append((epoch, number))
    assert len(set(seen)) == 2 * len(samples)
    from texvent.dataset.loading.torch_loader import SampleDataset

    alone = SampleDataset(changed)[3, 1]["representation"]
    np.testing.assert_array_equal(alone, changed.make(3, epoch=1)["representation"])
