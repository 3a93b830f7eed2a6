"""A detector's samples, loss and scores, with a stand-in that sees squares where there are some."""

from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.examples import examples

from texvent.events import EventStream
from texvent.represent.histogram import stacked_histogram
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.detection.clips import WINDOW_US, BoxedClip, bin_pixels
from texvent_lab.bench.detection.config import DetectionConfig, DetectionData
from texvent_lab.bench.detection.labels import COUNTED, IGNORED, read_street_labels

CHANNELS, HEIGHT, WIDTH = 2, 40, 64
CLASSES = ("car", "bus")


class Squares:
    """A network of evlib's form: its memory halves in each window, its boxes are around events."""

    backbone = SimpleNamespace(config=SimpleNamespace(partition_size=(1, 1)))
    head, num_classes = SimpleNamespace(), len(CLASSES)

    def __init__(self, torch):
        self._torch = torch

    def forward_backbone(self, image, states):
        memory = image if states is None else states / 2 + image
        return {2: self._torch.stack([image, memory], dim=1)}, memory

    def forward_detect(self, features, targets):
        if targets is not None:
            self.learned = features[2].numpy(), targets.numpy()
            return None, {"loss": features[2].sum()}
        found = []
        for image in features[2].numpy()[:, 0]:
            y, x = np.nonzero(image.sum(axis=0))
            kind = image[1].any()
            row = [x.min(), y.min(), x.max() + 1, y.max() + 1, 0.9, 0.8, kind] if len(x) else None
            found.append(row and self._torch.tensor(np.array([row], np.float32)))
        return found, None


@pytest.fixture(scope="module")
def task(torch):
    """The module, with evlib's part of it replaced."""
    from texvent_lab.bench.detection import task

    require = task.require
    heads = SimpleNamespace(postprocess=lambda found, *_: found)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(task, "require", lambda name, extra=None: heads if "evlib" in name
                      else require(name, extra=extra))  # fmt: skip
        yield task


def boxed_clip(seed, windows):
    """A square of a class in every window but some; some of its boxes rest, some lack it."""
    rng = np.random.default_rng(seed)
    histograms = np.zeros((windows, CHANNELS, HEIGHT, WIDTH), np.uint8)
    rows = []
    for window in range(windows):
        x, y, w, h = (int(one) for one in rng.integers((0, 0, 8, 8), (40, 20, 20, 20)))
        kind, rests = rng.integers(2), rng.random() < 0.2
        histograms[window, kind, y : y + h, x : x + w] = rng.integers(1, 9, (h, w))
        box = (window, x, y, w, h, kind, 1, IGNORED if rests else COUNTED)
        rows.append(np.array([box][: rng.random() < 0.8], BOX_RECORD))
    rows[-1] = np.array([(0, x, y, w, h, kind, 1, COUNTED)], BOX_RECORD)
    return BoxedClip.of(f"clip{seed}", list(histograms), rows), histograms


def opened(task, clips, **data):
    config = DetectionConfig(data=DetectionData(**data))
    return task.DetectionTask(config, CLASSES, [clip for clip, _ in clips])


@given(seed=st.integers(0, 99), length=st.integers(1, 6), windows=st.integers(1, 4))
@examples(0.4)
def test_the_loss_is_of_boxes_and_of_all_that_was_seen_before_them(
    torch, task, seed, length, windows
):
    clips = [boxed_clip(10 * seed + number, 2 + number) for number in range(4)]
    make = task.DrawnClips([clip for clip, _ in clips], length, windows, flips=True)
    drawn = [make(number, np.random.default_rng((seed, number))) for number in range(8)]
    batch = {name: torch.tensor(np.stack([one[name] for one in drawn])) for name in drawn[0]}
    network = Squares(torch)
    opened(task, clips, length=length).loss(network, batch, torch.device("cpu"))
    features, targets = network.learned
    expected = []
    for number, one in enumerate(drawn):
        clip, histograms = clips[one["number"]]
        assert one["number"] == number % 4
        assert len(one["learned"]) == windows
        mirror = -1 if one["flip"] else 1
        for window in one["learned"]:
            assert 0 <= window < length
            assert one["first"] + window in clip.learnable
            memory = np.zeros((CHANNELS, HEIGHT, WIDTH))
            for histogram in histograms[one["first"] :][: window + 1]:
                memory = memory / 2 + histogram
            boxes = clip.boxes[one["first"] + window]
            rows = [[box["class_id"], WIDTH - x if one["flip"] else x, box["y"] + box["h"] / 2,
                     box["w"], box["h"]]
                    for box in boxes if box["class_confidence"] == COUNTED
                    for x in [box["x"] + box["w"] / 2]]  # fmt: skip
            expected.append((window, np.stack([histogram, memory])[..., ::mirror], rows))
    expected.sort(key=lambda row: row[0])
    assert features.shape == (8 * windows, 2, CHANNELS, 64, 64)  # whole windows of attention
    for feature, target, (_, seen, rows) in zip(features, targets, expected, strict=True):
        np.testing.assert_array_equal(feature[..., :HEIGHT, :], seen)
        assert not feature[..., HEIGHT:, :].any()
        assert target[: len(rows)].tolist() == rows
        assert not target[len(rows) :].any()


def test_half_of_the_clips_are_mirrored_where_that_is_asked_for(task):
    clip, _ = boxed_clip(3, 4)
    for flips, share in ((True, 0.5), (False, 0)):
        make = task.DrawnClips([clip], 2, 1, flips)
        drawn = [make(0, np.random.default_rng(seed)) for seed in range(400)]
        assert np.mean([one["flip"] for one in drawn]) == pytest.approx(share, abs=0.1)
        learned = {int(one["first"] + one["learned"][0]) for one in drawn}
        assert learned == {*clip.learnable}


@pytest.mark.parametrize("batch", [1, 2, 8])
def test_what_is_around_the_events_is_found_in_windows_with_boxes(torch, task, batch):
    clips = [boxed_clip(seed, windows) for seed, windows in enumerate((3, 1, 4, 2, 2))]
    network, device = Squares(torch), torch.device("cpu")
    found = task.detect_clips(network, [clip for clip, _ in clips], device, batch=batch)
    found = found[np.argsort(found["t"])]
    truth = task.join_boxes([clip.boxes for clip, _ in clips])
    assert len(truth) < sum(len(histograms) for _, histograms in clips)
    for name in ("t", "class_id", *"xywh"):
        assert np.abs(found[name].astype(float) - truth[name]).max() <= (name in "wh"), name
    assert found["t"].tolist() == [
        number * task.CLIP_US + (window + 1) * WINDOW_US
        for number, (clip, _) in enumerate(clips)
        for window, boxes in enumerate(clip.boxes)
        if len(boxes)
    ]
    assert found["class_confidence"] == pytest.approx(0.72)
    scores, columns = opened(task, clips, binning=2).validate(network, device, workers=0)
    assert scores["AP50"] == 1
    assert scores["boxes of validation samples"] == np.sum(truth["class_confidence"] == COUNTED)
    told = sorted(zip(*(columns[one] for one in ("sample", "t_us", "class", *"xywh")), strict=True))
    assert told == [
        (clips[int(one["t"] // task.CLIP_US)][0].key, one["t"] % task.CLIP_US,
         CLASSES[one["class_id"]], *(2 * float(one[side]) for side in "xywh"))
        for one in found
    ]  # fmt: skip


def test_boxes_end_at_the_edges_and_none_is_without_area(torch, task):
    rows = [[-5, -4, 10, 8, 1, 0.5, 1], [60, 30, 90, 50, 0.5, 0.5, 0], [-9, 3, -2, 9, 1, 1, 0]]
    found = task.as_boxes(torch.tensor(np.array(rows, np.float32)), 7, (HEIGHT, WIDTH))
    assert [tuple(one) for one in found[[*"xywh", "class_id", "class_confidence", "t"]]] == [
        (0, 0, 10, 8, 1, 0.5, 7), (60, 30, 3, 9, 0, 0.25, 7)
    ]  # fmt: skip
    assert len(task.as_boxes(None, 7, (HEIGHT, WIDTH))) == 0


def test_every_box_is_of_one_size_and_the_others_are_ignored_there(task):
    from texvent_lab.bench.detection.run import SIZES, _of_size

    sides = np.array([1, 31.9, 32, 95.9, 96, 200])
    boxes = np.array([(0, 0, 0, side, side, 0, 1, COUNTED) for side in sides], BOX_RECORD)
    parts = {name: _of_size(boxes, boxes, limits) for name, limits in SIZES.items()}
    assert {name: found["w"].tolist() for name, (found, _) in parts.items()} == {
        name: boxes["w"][one].tolist() for name, one in
        {"small": [0, 1], "medium": [2, 3], "large": [4, 5]}.items()
    }  # fmt: skip
    for found, marked in parts.values():
        assert marked["w"][marked["class_confidence"] == COUNTED].tolist() == found["w"].tolist()
        assert len(marked) == len(boxes)
    assert (boxes["class_confidence"] == COUNTED).all()


@pytest.fixture
def tested(task, tmp_path, monkeypatch):
    """The module that tests networks, on clips of five lengths; no street is pulled."""
    from texvent_lab.bench.detection import run

    clips = [boxed_clip(seed, windows)[0] for seed, windows in enumerate((3, 1, 4, 2, 2))]
    for split, count in (("train", 3), ("val", 1), ("test", 5)):
        for number in range(count):
            (tmp_path / split / str(number)).mkdir(parents=True)
    monkeypatch.setattr(run, "read_clips", lambda folder, split, binning: clips)
    monkeypatch.setattr(run, "find_pulled", lambda name: None)
    return run, clips


@pytest.mark.parametrize("binning", [1, 4])
def test_a_network_is_scored_in_pixels_on_the_clips_that_it_did_not_learn(
    torch, tested, binning, tmp_path
):
    run, clips = tested
    config = DetectionConfig(seed=6, data=DetectionData(folder=tmp_path, binning=binning))
    score = run.score_network(Squares(torch), config, torch.device("cpu"), "esim")
    assert (score.arm, score.seed, score.street) == ("esim", 6, None)
    assert score.clips == {"train": 3, "val": 1, "test": 5}
    assert score.events == np.median([one.counts.astype(int).sum() for one in clips])
    counted = [box for one in clips for boxes in one.boxes for box in boxes
               if box["class_confidence"] == COUNTED]  # fmt: skip
    assert score.boxes == len(counted)
    assert score.ap50["all"]["value"] == 1
    sides = {name: [low <= binning**2 * one["w"] * one["h"] < high for one in counted]
             for name, (low, high) in run.SIZES.items()}  # fmt: skip
    assert {name for name, value in score.ap50_by_size.items() if not np.isnan(value)} == {
        name for name, found in sides.items() if any(found)
    }


def test_a_kept_score_is_of_its_training_epochs_clips_and_street(tested, tmp_path, monkeypatch):
    run, _ = tested
    state = SimpleNamespace(version="1", tables={"seed": 1}, epochs=3)
    rows = {"a": {"of": "x"}, "b": {"of": "y"}}
    ledger = lambda path, remedy: type("L", (dict,), {"row": dict.__getitem__})(rows)  # noqa: E731
    monkeypatch.setattr(run, "Ledger", ledger)
    seen = [run._facts_of_score(state, tmp_path)] * 2
    for change in ({"version": "2"}, {"tables": {"seed": 2}}, {"epochs": 4}):
        seen.append(run._facts_of_score(SimpleNamespace(**{**vars(state), **change}), tmp_path))
    rows["b"] = {"of": "z"}
    seen.append(run._facts_of_score(state, tmp_path))
    monkeypatch.setattr(run, "find_pulled", lambda name: tmp_path)
    seen.append(run._facts_of_score(state, tmp_path))
    assert [seen.index(one) for one in seen] == [0, 0, 2, 3, 4, 5, 6]


@pytest.mark.parametrize("binning", [1, 2])
def test_a_street_is_seen_in_the_windows_before_each_of_its_instants(
    torch, task, binning, tmp_path, monkeypatch
):
    from texvent_lab.bench.detection import run

    rng, truth = np.random.default_rng(4), read_street_labels()
    times_us = np.unique(truth["t"])
    last_us = int(times_us[-1])
    instants = [int(times_us[0]), int(times_us[5]), last_us]
    t = np.sort(rng.integers(times_us[0] - 120_000, last_us, 4000))
    t[1:4] = instants[0] - np.array([2, 1, 0]) * WINDOW_US  # at the ends of windows
    t.sort()
    events = EventStream(rng.integers(0, 346, 4000), rng.integers(0, 260, 4000), t,
                         rng.integers(0, 2, 4000), (346, 260))  # fmt: skip
    events.save(tmp_path / "street.h5")
    seen = []
    monkeypatch.setattr(run, "detect_last", lambda network, windows, device: seen.append(windows))
    found = [*run._detect_street(None, tmp_path / "street.h5", np.array(instants), None, binning)]
    assert [len(one) for one in found] == [0, 0, 0]
    assert [len(one) for one in seen] == [2, (instants[1] - t[0]) // WINDOW_US, 10]
    for t_us, windows in zip(instants, seen, strict=True):
        for back, window in enumerate(reversed(windows)):
            end = t_us - back * WINDOW_US
            part = events.cut(end - WINDOW_US, end + 1)
            np.testing.assert_array_equal(window, bin_pixels(stacked_histogram(part), binning))
