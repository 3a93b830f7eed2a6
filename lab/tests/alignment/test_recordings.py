"""What is scored: samples of a data set, recorded streams, and the images made of them."""

import json
from pathlib import Path

import numpy as np
import pytest

import texvent
from texvent.cli.app import main
from texvent.errors import InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.alignment.recordings import (
    DrawnEvents,
    TextRecording,
    keep_common,
    list_samples,
    list_streams,
)
from texvent_lab.nt_imagenet.files import Captioned

from ..nt_imagenet.tiny_data import WNIDS, stream_id, write_n_imagenet

SPECIFICATION = """\
name = "tiny"
splits = {train = 0.5, test = 0.5}
options = {duration = 0.1, sensor = "32x24"}
filters = {min_events = 0}
[[sources]]
prompts = ["a red car drives left", "a dog runs"]
[variants.paper]
[variants.esim]
simulator = "esim"
seeds = 2
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("sets")
    (path / "tiny.toml").write_text(SPECIFICATION)
    words = ["make", str(path / "tiny.toml"), "-o", str(path / "tiny"), "--workers", "1", "-q"]
    assert main(["dataset", *words]) == 0
    return path / "tiny"


def stream(count: int, size: SensorSize) -> EventStream:
    t = np.arange(count)
    return EventStream(t % size.width, t % size.height, t, t % 2, size)


@pytest.mark.long
def test_samples_come_by_variant_with_their_prompts_and_events(folder):
    found = list_samples(folder)
    assert {name: len(one) for name, one in found.items()} == {"paper": 2, "esim": 4}
    for one in found["paper"]:
        record = next(
            sample
            for path in (folder / "paper").glob("*.json")
            for sample in json.loads(path.read_text())["samples"]
            if sample["clip"] == one.id
        )
        events = one.load()
        expected = texvent.generate(one.text, seed=record["seed"], duration=0.1, sensor="32x24")
        for name in "xytp":
            np.testing.assert_array_equal(getattr(events, name), getattr(expected, name))
        assert events.size == SensorSize(32, 24)
    assert len(list_samples(folder, split="test")["esim"]) == 2


def test_recorded_streams_are_read_at_their_size(tmp_path):
    write_n_imagenet(tmp_path, {WNIDS[0]: {1: 3_000}})
    caption = Captioned(id=stream_id(1), caption="a tench", label=WNIDS[0], seed=1)
    (one,) = list_streams(tmp_path, [caption])
    assert (one.id, one.text) == (stream_id(1), "a tench")
    assert one.load().size == SensorSize(640, 480)
    assert len(one.load()) == 3_000
    missing = Captioned(id=stream_id(2), caption="a tench", label=WNIDS[0], seed=2)
    with pytest.raises(InputError, match=f"lacks {WNIDS[0]}/{stream_id(2)}.npz"):
        list_streams(tmp_path, [missing])


def test_sources_are_scored_on_the_ids_they_share():
    def some(*ids: str) -> list[TextRecording]:
        return [TextRecording(id, id, lambda: EventStream.empty(SensorSize(1, 1))) for id in ids]

    kept = keep_common({"a": some("1", "2", "3", "3"), "b": some("4", "3", "2")})
    assert {name: [one.id for one in found] for name, found in kept.items()} == {
        "a": ["2", "3", "3"],
        "b": ["3", "2"],
    }
    many = {"a": some(*map(str, range(10, 20)))}
    assert [one.id for one in keep_common(many, limit=3)["a"]] == ["10", "13", "16"]
    with pytest.raises(InputError, match="a and b share no id"):
        keep_common({"a": some("1"), "b": some("2")})


@pytest.mark.parametrize(("count", "expected"), [(0, [0]), (50, [50]), (250, [100, 100]),
                                                 (1000, [100] * 4)])  # fmt: skip
def test_runs_hold_the_same_number_of_events_spread_over_the_recording(count, expected):
    events = stream(count, SensorSize(20, 10))
    runs = DrawnEvents(images=4, events_per_image=100).runs(events)
    assert [len(run) for run in runs] == expected
    if count >= 100:
        assert runs[0].t[0] == 0
        assert runs[-1].t[-1] == count - 1


def test_events_are_drawn_on_white_also_where_there_are_none():
    size = SensorSize(8, 6)
    (image,) = DrawnEvents()(EventStream([2, 3], [1, 1], [0, 5], [1, 0], size))
    assert image.shape == (6, 8, 3)
    assert image[1, 2].tolist() == [0, 0, 255]
    assert image[1, 3].tolist() == [255, 0, 0]
    assert (image[0] == 255).all()
    (blank,) = DrawnEvents()(EventStream.empty(size))
    assert (blank == 255).all()
