"""Samples by tonic's conventions: what its transforms and loaders ask of a data set."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import texvent.dataset
from texvent.dataset import EventClips
from texvent.errors import ConfigError, InputError


def test_events_and_targets_are_those_of_the_samples(cars: Path) -> None:
    clips = EventClips(cars, variant="paper", split="train")
    samples = texvent.dataset.open(cars, variant="paper", split="train")
    assert len(clips) == len(samples) == 4
    assert clips.sensor_size == (32, 24, 2)
    assert clips.classes == ["bus", "car"]
    assert clips.ordering == clips.dtype.names == ("x", "y", "t", "p")
    for (events, target), sample in zip(clips, samples, strict=True):
        assert events.dtype == clips.dtype
        for name in "xytp":
            np.testing.assert_array_equal(events[name], getattr(sample.events, name))
        assert clips.classes[target] == sample.label


def test_transforms_are_applied_in_tonics_order(cars: Path) -> None:
    clips = EventClips(
        cars,
        variant="esim",
        split="test",
        transform=len,
        target_transform=lambda target: target + 10,
        transforms=lambda events, target: (events * 2, target * 2),
    )
    plain = EventClips(cars, variant="esim", split="test")
    events, target = plain[0]
    assert clips[0] == (2 * len(events), 2 * (target + 10))


def test_what_is_not_there_is_said(cars: Path) -> None:
    with pytest.raises(InputError, match="has variants esim, paper; give variant"):
        EventClips(cars)
    with pytest.raises(ConfigError, match="unknown split 'val'"):
        EventClips(cars, variant="paper", split="val")
    with pytest.raises(IndexError):
        EventClips(cars, variant="paper")[99]


@pytest.mark.gpl
@pytest.mark.filterwarnings("ignore")
def test_tonics_own_transforms_and_cache_take_it(cars: Path) -> None:
    tonic = pytest.importorskip("tonic")
    plain = EventClips(cars, variant="paper")
    frames = tonic.transforms.ToFrame(sensor_size=plain.sensor_size, n_time_bins=3)
    clips = EventClips(cars, variant="paper", transform=frames)
    for (events, _), (image, _) in zip(plain, clips, strict=True):
        assert image.shape == (3, 2, 24, 32)
        assert len(events) - 1 <= image.sum() <= len(events)  # its last bin leaves out its end
    slicer = tonic.slicers.SliceByEventCount(event_count=5)
    sliced = tonic.SlicedDataset(plain, slicer=slicer)
    assert len(sliced[0][0]) == 5
