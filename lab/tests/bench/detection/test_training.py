import dataclasses
import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from texvent.errors import ConfigError, InputError
from texvent.truth.boxes import BOX_RECORD
from texvent_lab.bench.detection.clips import (
    BoxedClip,
    bin_pixels,
    mark_resting,
    read_classes,
    read_clips,
    scale,
)
from texvent_lab.bench.detection.config import DetectionConfig, DetectionData
from texvent_lab.bench.detection.results import ArmScore, DetectionReport, detection_table
from texvent_lab.commands.bench.bench import run

CARS = """
name = "cars"
truth = ["boxes"]
previews = false
splits = { train = 0.34, val = 0.33, test = 0.33 }
filters = { min_events = 0 }
options = { duration = 0.1, sensor = "64x48", samples = 1, interpolate = "none" }

[[sources]]
template = "a red {thing} drives left"
words = { thing = ["car", "bus", "truck"] }
count = 3

[variants.esim]
simulator = "esim"
"""


def boxes(*rows):
    """Records of (track, x, y, w, h)."""
    return np.array([(0, x, y, w, h, 0, track, 1) for track, x, y, w, h in rows], BOX_RECORD)


def test_a_box_at_rest_is_ignored_until_an_edge_moves():
    windows = [
        boxes((1, 10, 10, 20, 20), (2, 40, 10, 8, 8)),
        boxes((1, 10, 10, 20, 20), (2, 43, 10, 8, 8)),
        boxes((1, 10, 10, 20, 20.6), (3, 50, 10, 8, 8)),
    ]
    marked = [one["class_confidence"].tolist() for one in mark_resting(windows)]
    assert marked == [[0, 1], [0, 1], [1, 1]]


def test_what_is_no_export_is_refused_in_one_line(tmp_path: Path):
    with pytest.raises(InputError, match=r"has no texvent-export\.json; write it with"):
        read_classes(tmp_path)
    with pytest.raises(InputError, match=r"there are no clips in .*train; make and export"):
        read_clips(tmp_path, "train", 1)
    for name in ("train", "val"):
        (tmp_path / name).mkdir()
    with pytest.raises(InputError, match=r"or name one of train, val \(rvt calls validation val\)"):
        read_clips(tmp_path, "validation", 1)
    with pytest.raises(ConfigError, match=r"data\.folder is missing; name what"):
        DetectionConfig().make_task()


def test_cells_add_the_counts_of_their_pixels():
    histogram = np.arange(2 * 3 * 5, dtype=np.uint8).reshape(2, 3, 5) * 8
    cells = bin_pixels(histogram, 2)
    assert cells.shape == (2, 2, 3)
    assert cells[0, 0].tolist() == [8 * (0 + 1 + 5 + 6), 8 * (2 + 3 + 7 + 8), 8 * (4 + 9)]
    assert cells[1, 0].tolist() == [255, 255, 255]


@pytest.mark.detect
def test_a_detector_finds_what_it_was_trained_on():
    import torch

    from texvent_lab.bench.detection.precision import average_precision
    from texvent_lab.bench.detection.task import DetectionTask, detect_clips, join_boxes

    clips = [_square(number) for number in range(4)]
    task = DetectionTask(DetectionConfig(), ("square",), clips)
    network = task.make_network().train()
    optimizer = DetectionConfig().schedule.make_optimizer(network)
    learned = torch.tensor([[0, 1]] * 4)
    batch = {
        "number": torch.arange(4),
        "flip": torch.zeros(4, dtype=torch.bool),
        "first": torch.zeros(4, dtype=torch.int64),
        "learned": learned,
    }
    for _ in range(80):
        loss = task.loss(network, batch, torch.device("cpu"))
        optimizer.zero_grad()
        loss.backward()
        optimizer.step()
    found = detect_clips(network.eval(), clips, "cpu")
    truth = join_boxes([one.boxes for one in clips])
    precision = average_precision(found, truth, classes=("square",), iou=(0.5,))["all"]
    assert precision > 0.5


def _square(number: int) -> BoxedClip:
    """A filled square of 16 to 22 px that moves by 4 px."""
    side = 16 + 2 * number
    histograms = np.zeros((2, 20, 64, 64), np.uint8)
    found = []
    for window in range(2):
        x, y = 4 + 8 * number + 4 * window, 30 - 6 * number
        histograms[window, :, y : y + side, x : x + side] = 3
        found.append(boxes((1, x, y, side, side)))
    return BoxedClip.of(str(number), list(histograms), found)


@pytest.mark.detect
@pytest.mark.parametrize("binning", [1, 2])
def test_eqs_computes_with_the_stored_weights_as_evlib_does(tmp_path: Path, binning: int):
    import torch

    from texvent.metrics.rvt_backbone import read_rvt
    from texvent_lab.bench.detection.task import DetectionTask, run_backbone

    config = DetectionConfig(data=DetectionData(binning=binning))
    histogram = np.random.default_rng(4).poisson(0.3, (20, 90, 140)).astype(np.uint8)
    cells = bin_pixels(histogram, binning)
    task = DetectionTask(config, ("car",), [BoxedClip.of("a", [cells], [boxes()])])
    network = task.make_network().eval()
    with torch.no_grad():
        for one in network.backbone.parameters():  # attention is scaled by 1e-5 at first
            one.normal_(0, 0.1)
        windows = torch.from_numpy(cells)[None, None]
        (expected,) = run_backbone(network, windows)
    torch.save(task.published(network), tmp_path / "weights.pt")
    for number, one in enumerate(
        read_rvt(tmp_path / "weights.pt", "")(histogram.astype(np.float32))
    ):
        other = expected[number + 1][0, :, : one.shape[1], : one.shape[2]]
        np.testing.assert_allclose(one, other, atol=1e-5)
        assert np.abs(one).max() > 0.05


def test_without_the_recorded_street_there_is_no_score_of_it(torch, tmp_path: Path, monkeypatch):
    from texvent_lab.bench.detection.run import score_street

    monkeypatch.setenv("TEXVENT_DATA", str(tmp_path))
    assert score_street(None, ("car",), "cpu", 1) is None


@pytest.mark.detect
def test_arms_are_trained_and_tested_on_the_same_boxes(tmp_path: Path, monkeypatch):
    from texvent_lab.bench.detection.run import CLASSES

    monkeypatch.setenv("TEXVENT_DATA", str(tmp_path / "no recordings"))
    (tmp_path / "cars.toml").write_text(f"{CARS}\n[variants.texvent]\n")
    words = ["detection", str(tmp_path / "cars.toml"), "--work", str(tmp_path / "work")]
    words += ["--clips", "3", "--epochs", "1", "--batch-size", "2", "--device", "cpu"]
    run([*words, "-o", str(tmp_path / "one.json")])
    document = json.loads((tmp_path / "one.json").read_text())
    assert [one["arm"] for one in document["scores"]] == ["esim", "texvent"]
    first, second = document["scores"]
    assert first["clips"] == {"train": 1, "val": 1, "test": 1}
    assert first["boxes"] == second["boxes"] > 0
    assert list(first["ap50"]) == [*CLASSES.split(","), "all"]
    with pytest.raises(ConfigError, match="unknown arm 'rvt'"):
        run([*words, "--arms", "rvt"])


@given(seed=st.integers(0, 999))
def test_parts_of_a_clip_are_those_of_its_dense_histograms(seed):
    rng = np.random.default_rng(seed)
    whole = rng.poisson(0.1, (6, 3, 4, 5)).astype(np.uint8)
    rows = [boxes(*[(1, 0, 0, 4, 4)] * count) for count in rng.integers(0, 3, 6)]
    for one in rows:
        one["class_confidence"] = rng.integers(0, 2, len(one))
    clip = BoxedClip.of("a", list(whole), rows)
    first, count = rng.integers(0, 6), rng.integers(1, 7)
    part = clip.part(first, count)
    flat = np.zeros(part.shape, np.uint8).ravel()
    flat[part.places] = part.counts
    assert np.array_equal(flat.reshape(part.shape), whole[first : first + count])
    assert part.learnable == [n for n, one in enumerate(rows[first : first + count])
                              if sum(one["class_confidence"]) > 0]  # fmt: skip
    assert scale(boxes((7, 2, 4, 6, 8)), 0.5).tolist() == boxes((7, 1, 2, 3, 4)).tolist()


def test_a_row_of_detectors_has_means_over_its_networks():
    def score(arm, seed, value):
        ap50 = {one: {"value": value, "low": value - 0.1, "high": value + 0.1}
                for one in ("all", "car", "bus")}  # fmt: skip
        ap50["bus"] = {**ap50["bus"], "value": value / 2}
        return ArmScore(
            arm=arm, seed=seed, clips={}, events=1234.5, boxes=1, ap={"all": value / 4},
            ap50=ap50, ap50_by_size={"small": value / 5}, street={"AP50": ap50["car"], "AP": {}},
        )  # fmt: skip

    scores = [score("a", 0, 0.4), score("b", 0, 0.8), score("a", 1, 0.6)]
    scores[1] = dataclasses.replace(scores[1], street=None)
    head, _, *rows = detection_table(DetectionReport({}, {}, scores, 0.0)).splitlines()
    assert head == ("| trained on | events | AP | AP50 [95 %] | car | bus | small | "
                    "recorded street, car AP50 [95 %] |")  # fmt: skip
    both = "0.400 [0.300, 0.500], 0.600 [0.500, 0.700]"
    assert rows == [
        f"| a | 1,234 | 0.125 ± 0.025 | {both} | 0.500 ± 0.100 | 0.250 ± 0.050 | 0.100 ± 0.020 | "
        f"{both} |",
        "| b | 1,234 | 0.200 | 0.800 [0.700, 0.900] | 0.800 | 0.400 | 0.160 | – |",
    ]
