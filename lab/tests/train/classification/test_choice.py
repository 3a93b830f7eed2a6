"""Samples of several sources, chosen and put together; nothing of it needs torch."""

from dataclasses import replace

import numpy as np
import pytest

from texvent_lab.train.classification.config import ClassData, ClassificationConfig, LabelledSource
from texvent_lab.train.classification.samples import open_training, open_validation

from ..written_samples import SIZE, bar, write_bars, write_recordings


def config(folder, extra=None, seed=0, **data):
    found = ClassData(recordings=folder / "rec", validation_split="val", **data)
    return ClassificationConfig(data=found, extra=extra or LabelledSource(), seed=seed)


def opened(*given, **data):
    chosen = config(*given, **data)
    return open_training(chosen, open_validation(chosen))


@pytest.mark.parametrize(("format", "sensor"), [("npz", None), ("bin", "16x12"), ("csv", "16x12")])
def test_recordings_of_any_format_are_read(tmp_path, format, sensor):
    write_recordings(tmp_path / "rec", format=format)
    for beside in (tmp_path / "rec").rglob("*.json") if sensor else ():
        beside.unlink()  # which states the size
    samples = open_validation(config(tmp_path, sensor=sensor))
    assert samples.class_number.tolist() == [0, 0, 0, 0, 1, 1, 1, 1]
    for place in range(len(samples)):
        assert samples.events(place).equals(bar(place // 4, 100 + place % 4))
        assert samples.events(place).size == SIZE
        assert samples.title(place).startswith(
            str(tmp_path / "rec/val" / ["bus", "car"][place // 4])
        )


def test_recorded_and_simulated_samples_are_mixed(tmp_path):
    write_recordings(tmp_path / "rec")
    write_bars(tmp_path / "made")
    chosen = opened(tmp_path, LabelledSource(folder=tmp_path / "made", per_class=3), per_class=2)
    assert chosen.labels == ("bus", "car")
    assert np.bincount(chosen.source).tolist() == [4, 6]
    assert np.bincount(chosen.class_number).tolist() == [5, 5]
    # Labels of a made set are numbered otherwise: bus, car, dog.
    for place in range(len(chosen)):
        events = chosen.events(place)
        assert events.size == SIZE
        assert (events.x.mean() > 8) == chosen.class_number[place]


def test_few_of_each_class_are_drawn_by_the_seed_and_by_the_source(tmp_path):
    write_recordings(tmp_path / "rec", per_class=9)
    extra = LabelledSource(recordings=tmp_path / "rec", per_class=3)
    first, again, other = (
        opened(tmp_path, extra, seed, per_class=3).number.tolist() for seed in (0, 0, 1)
    )
    assert len(first) == 12
    assert first == again != other
    assert first[:6] != first[6:]


def test_only_the_first_classes_are_told_apart(tmp_path):
    write_recordings(tmp_path / "rec")
    for split in ("train", "val"):
        (tmp_path / "rec" / split / "ape").mkdir()
        bar(0, 7).save(tmp_path / "rec" / split / "ape" / "a.npz")
    validation = open_validation(config(tmp_path, classes=2))
    assert validation.labels == ("ape", "bus")
    assert len(opened(tmp_path, classes=2)) == len(validation) == 5


def test_polarity_is_exchanged_where_it_is_asked_for(tmp_path):
    write_recordings(tmp_path / "rec")
    plain, flipped = (
        open_validation(config(tmp_path, flip_polarity=is_flipped)) for is_flipped in (False, True)
    )
    for place in range(len(plain)):
        one, two = plain.events(place), flipped.events(place)
        assert replace(two, p=1 - two.p).equals(one)
