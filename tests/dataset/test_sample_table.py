"""Samples by number, stored or simulated: arrays are those of their events."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from tests.dataset.conftest import dropped

from texvent.dataset.sample_table import SampleTable
from texvent.errors import ConfigError, InputError
from texvent.represent.named import represent_window

REPRESENTATIONS: list[dict[str, Any]] = [
    {},
    {"representation": "voxel-e2vid", "bins": 4},
    {"representation": "time-surface", "tau_us": 5000},  # of the end of the window
]


@pytest.mark.parametrize("options", REPRESENTATIONS)
@pytest.mark.parametrize("length", [{}, {"slice_us": 3000}, {"slice_events": 10}])
def test_arrays_are_those_of_the_whole_slices_of_the_events(
    table: SampleTable, length: dict[str, int], options: dict[str, Any]
) -> None:
    whole = table.make(1)
    events, end = whole["events"], int(whole["stop_us"])
    slices = [(events, (0, end))]
    if step := length.get("slice_us"):
        slices = [
            (events.cut(stop - step, stop), (stop - step, stop))
            for stop in range(step, end + 1, step)
        ]
    if count := length.get("slice_events"):
        parts = [events[place * count :][:count] for place in range(len(events) // count)]
        slices = [(part, (int(part.t[0]), int(part.t[-1]) + 1)) for part in parts]
    made = table.represented(**options, **length).make(1)
    stops = made["stop_us"].tolist()
    assert (stops if length else [stops]) == [stop for _, (_, stop) in slices]
    assert len(slices) > 1 or not length
    own = made["representation" if options else "events"]
    for part, (wanted, window) in zip(own if length else [own], slices, strict=True):
        if not options:
            assert part.equals(wanted)
            continue
        others = {one: value for one, value in options.items() if one != "representation"}
        array = represent_window(options["representation"], wanted, window, **others)
        np.testing.assert_array_equal(part, array)


def test_samples_are_augmented_by_their_number_and_epoch_before_they_are_sliced(
    table: SampleTable,
) -> None:
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
    ("changes", "said"),
    [
        ({"slice_us": 0}, "slice_us is 0"),
        ({"slice_us": 5, "slice_events": 5}, "give either slice_us or slice_events"),
        ({"representation": "voxel-e2vdi"}, "did you mean 'voxel-e2vid'"),
        ({"representation": "voxel-e2vid", "binss": 4}, "voxel-e2vid has no option 'binss'"),
        ({"representation": "voxel-e2vid", "bins": 0}, "bins is 0"),
        ({"bins": 4}, "representation_options belong to a representation; name it"),
    ],
)
def test_arrays_that_cannot_be_made_are_refused_at_once(
    table: SampleTable, changes: dict[str, Any], said: str
) -> None:
    with pytest.raises(ConfigError, match=said):
        table.represented(**changes)


def test_unknown_targets_and_those_that_an_augmentation_leaves_behind_are_refused(
    table: SampleTable,
) -> None:
    with pytest.raises(ConfigError, match=r"unknown target 'box'; .* did you mean 'boxes'"):
        table.with_targets("box")
    with pytest.raises(ConfigError, match="changes the events, and targets stay"):
        table.augmented(dropped).with_targets("depth")
