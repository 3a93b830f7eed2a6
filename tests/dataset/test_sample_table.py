"""Samples by number, stored or simulated: arrays are those of their events, batches of arrays."""

import numpy as np
import pytest
from tests.dataset.conftest import dropped
from tests.dataset.stored.written_set import random_events, write_shard

import texvent.dataset
from texvent.errors import ConfigError, InputError
from texvent.represent.named import represent, represent_window

REPRESENTATIONS = (
    {},
    {"representation": "voxel-e2vid", "bins": 4},
    {"representation": "time-surface", "tau_us": 5000},  # of the end of the window
)


@pytest.mark.parametrize("options", REPRESENTATIONS)
@pytest.mark.parametrize("length", [{}, {"slice_us": 3000}, {"slice_events": 10}])
def test_arrays_are_those_of_the_whole_slices_of_the_events(table, length, options):
    whole = table.make(1)
    events, end = whole["events"], int(whole["stop_us"])
    slices = [(events, (0, end))]
    if step := length.get("slice_us"):
        windows = [(stop - step, stop) for stop in range(step, end + 1, step)]
        slices = [(events.cut(*window), window) for window in windows]
    if count := length.get("slice_events"):
        parts = [events[place * count :][:count] for place in range(len(events) // count)]
        slices = [(part, (int(part.t[0]), int(part.t[-1]) + 1)) for part in parts]
    made = table.represented(**options, **length).make(1)
    stops, own = made["stop_us"].tolist(), made["representation" if options else "events"]
    assert (stops if length else [stops]) == [stop for _, (_, stop) in slices]
    assert len(slices) > 1 or not length
    name, *others = options.items() or [(None, None)]
    for part, (wanted, window) in zip(own if length else [own], slices, strict=True):
        if options:
            array = represent_window(name[1], wanted, window, **dict(others))
            np.testing.assert_array_equal(part, array)
        else:
            assert part.equals(wanted)


def test_samples_are_augmented_by_their_number_and_epoch_before_they_are_sliced(table):
    changed = table.augmented(dropped, seed=5)
    for number, epoch in ((0, 0), (3, 0), (3, 1)):
        events, key = (
            table.make(number)["events"],
            np.random.SeedSequence(5, spawn_key=(epoch, number)),
        )
        wanted = dropped(events, np.random.default_rng(key))
        assert changed.make(number, epoch=epoch)["events"].equals(wanted)
        parts = changed.represented(slice_events=10).make(number, epoch=epoch)["events"]
        assert parts[1].equals(wanted[10:20])
    assert changed.augmented(None).make(3)["events"].equals(table.make(3)["events"])
    none_left = table.represented(slice_events=30).augmented(lambda events, _: events[:1])
    with pytest.raises(InputError, match=r"augment leaves 1 events .* fewer than a slice of 30"):
        none_left.make(0)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda one: one.represented(slice_us=0), "slice_us is 0"),
        (lambda one: one.represented(slice_us=5, slice_events=5), "give either slice_us or slice_"),
        (lambda one: one.represented("voxel-e2vdi"), "did you mean 'voxel-e2vid'"),
        (lambda one: one.represented("voxel-e2vid", binss=4), "voxel-e2vid has no option 'binss'"),
        (lambda one: one.represented("voxel-e2vid", bins=0), "bins is 0"),
        (lambda one: one.represented(bins=4), "options belong to a representation; name it"),
        (lambda one: one.with_targets("box"), "unknown target 'box'; .* did you mean 'boxes'"),
        (lambda one: one.augmented(dropped).with_targets("flow"), "the events, and targets stay"),
    ],
)
def test_arrays_that_cannot_be_made_are_refused_at_once(table, change, said):
    with pytest.raises(ConfigError, match=said):
        change(table)


def batches(samples, *, batch_size, workers=0, **options):
    """Batches of torch's loader."""
    torch = pytest.importorskip("torch")
    from texvent.dataset.torch_samples import SampleDataset, collate

    context = {"num_workers": workers, "multiprocessing_context": "spawn"} if workers else {}
    dataset = SampleDataset(samples, **options)
    return torch.utils.data.DataLoader(
        dataset, batch_size=batch_size, collate_fn=collate, **context
    )


@pytest.mark.torch
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
            assert str(values.dtype) == f"torch.{np.asarray(wanted[0]).dtype}"


@pytest.mark.torch
def test_a_pass_takes_every_stored_sample_or_every_source_once(table):
    (batch,) = batches(table.represented("event-frame"), batch_size=99)
    assert batch["number"].tolist() == list(range(table.count))


@pytest.mark.torch
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
    np.testing.assert_array_equal(
        represent("voxel-e2vid", events[0]).numpy(), represent("voxel-e2vid", streams["a"])
    )


@pytest.mark.torch
def test_slices_and_unequal_shapes_become_lists(tmp_path):
    write_shard(tmp_path, "paper", "train", 0, {"a": random_events(1, 30), "b": random_events(2)})
    samples = texvent.dataset.open(tmp_path, slice_events=10)
    (batch,) = batches(samples, batch_size=2)
    assert [len(slices) for slices in batch["events"]] == [3, 4]
    assert [len(one) for one in batch["events"][1]] == [10] * 4
    (batch,) = batches(samples.represented("event-frame", slice_events=10), batch_size=2)
    assert [one.shape[0] for one in batch["representation"]] == [3, 4]
