"""The whole benchmark on ten made-up figures: trained, resumed, shown."""

import dataclasses
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from texvent_lab.bench.digits import run as digits
from texvent_lab.bench.digits.data import read_mnist, read_recordings
from texvent_lab.bench.digits.inputs import represent_all, represent_recordings
from texvent_lab.bench.digits.plan import (
    ABLATION,
    ARMS,
    Cell,
    DigitsPlan,
    DigitsTraining,
    find_arm,
)
from texvent_lab.bench.digits.results import digits_table, read_report
from texvent_lab.bench.digits.run import DigitsRun, run_digits, simulate_digits
from texvent_lab.bench.digits.sheet import Digits, DigitSheet
from texvent_lab.bench.digits.training import shift_images
from texvent_lab.bench.document import read_document, write_document
from texvent_lab.bench.page import page_files
from texvent_lab.train.schedule import Schedule

from .synthetic_data import PAIRS, TRAIN, write_mnist, write_recordings


@pytest.fixture(scope="module")
def data(tmp_path_factory):
    """(folder of MNIST's files, folder of recordings)."""
    folder = tmp_path_factory.mktemp("digits")
    images = write_mnist(folder / "mnist")
    write_recordings(folder / "recordings", images)
    return folder / "mnist", folder / "recordings"


SCHEDULE = Schedule(epochs=12, batch_size=16, learning_rate=0.01)
OPTIONS = {"steps": 48, "schedule": SCHEDULE, "precision": "float32"}
MATCHED = "recommended about the matched threshold"


def tiny_plan(data, work):
    return DigitsPlan(
        mnist=data[0],
        nmnist=data[1],
        work=work,
        arms=("esim", "frame difference"),
        ways=("exact", "frames"),
        digits=60,
        recorded=TRAIN,
        pairs=PAIRS,
        seeds=2,
        folds=3,
        schedule=SCHEDULE,
    )


class Nearest(NamedTuple):
    """A network that names the class of the nearest mean image, one of a seed's noise."""

    kinds: Any
    means: Any

    @classmethod
    def train(cls, images, labels, *, seed, **options):
        assert options == OPTIONS
        kinds = np.unique(labels)
        means = np.stack([images[labels == kind].astype(float).mean(axis=0) for kind in kinds])
        return cls(kinds, means + np.random.default_rng(seed).normal(0, 0.02, means.shape))

    def predict(self, images):
        away = ((images[:, None] - self.means[None]) ** 2).sum(axis=(2, 3, 4))
        return self.kinds[away.argmin(axis=1)]


def right_share(training, recorded, kind):
    """Share of recordings that networks of (images, labels, seed, recordings to ask) know."""
    right = []
    for images, labels, seed, asked in training:
        network = Nearest.train(images, labels, seed=seed, **OPTIONS)
        right += (network.predict(recorded.images[kind][asked]) == recorded.labels[asked]).tolist()
    assert len(right) == TRAIN
    return np.mean(right)


def test_without_torch_scores_are_those_of_networks_that_never_saw_what_they_are_asked(
    data, tmp_path, monkeypatch
):
    monkeypatch.setattr(digits, "require", lambda *_, **__: None)
    monkeypatch.setattr(digits, "train_network", Nearest.train)
    monkeypatch.setattr(digits, "predict", Nearest.predict)
    plan = tiny_plan(data, tmp_path)
    found = run_digits(plan)
    numbers, mnist = np.arange(TRAIN), read_mnist(data[0])
    recorded = represent_recordings(read_recordings(data[1], range(1, TRAIN + 1)))
    target = np.median([len(one.events) for one in
                        read_recordings(data[1], range(60_001, 60_001 + PAIRS))])  # fmt: skip
    assert found.protocol["events of the pair in the middle"] == pytest.approx(target, rel=0.01)
    assert found.recorded_events == np.median(recorded.counts.sum(axis=1))
    assert found.recorded_on_share == recorded.counts[:, 1].sum() / recorded.counts.sum()
    cells = [Cell("esim", "exact"), Cell("frame difference", "frames")]
    for kind, score in zip(np.repeat(["histogram", "surface"], 2), found.scores, strict=True):
        cell = cells[score.way == "frames"]
        assert (score.arm, score.way, score.representation) == (cell.arm, cell.way, kind)
        made = simulate_digits(
            mnist, PAIRS + 1 + np.arange(60), find_arm(cell.arm), cell.way, score.threshold
        )
        assert made.labels.tolist() == [n % 10 for n in range(PAIRS, PAIRS + 60)]
        arm, seventh = find_arm(cell.arm), np.array([7])  # image 7 is the seventh of the file
        sheet = DigitSheet(Digits.draw(mnist.images[6:7], seventh, 0, arm.stimulus))
        events = digits._events_of(sheet, arm, cell.way, score.threshold, 7)
        one = simulate_digits(mnist, seventh, arm, cell.way, score.threshold)
        assert one.counts.tolist() == [[np.sum(sheet.cut(represent_all(events)[1])[0, p])
                                        for p in (0, 1)]]  # fmt: skip
        assert score.events == np.median(made.counts.sum(axis=1))
        assert score.on_share == made.counts[:, 1].sum() / made.counts.sum()
        assert score.accuracy == [
            right_share([(made.images[kind], made.labels, seed, numbers)], recorded, kind)
            for seed in range(2)
        ]
        folds = [[(recorded.images[kind][numbers % 3 != fold], recorded.labels[numbers % 3 != fold],
                   seed, numbers[numbers % 3 == fold]) for fold in range(3)]
                 for seed in range(2)]  # fmt: skip
        assert found.ceiling[kind] == [right_share(one, recorded, kind) for one in folds]
        assert score.p is None
    monkeypatch.setattr(digits, "train_network", None)
    again = run_digits(plan)
    assert dataclasses.replace(again, seconds=found.seconds) == found


@pytest.fixture(scope="module")
def report(data, tmp_path_factory):
    pytest.importorskip("torch")
    return run_digits(tiny_plan(data, tmp_path_factory.mktemp("work")))


@pytest.mark.torch
def test_networks_learn_the_recorded_figures_from_simulated_ones(report):
    esim = report.scores[0]
    assert (esim.arm, esim.representation, esim.is_matched) == ("esim", "histogram", True)
    assert 0.3 < esim.threshold < 0.7  # recorded with 0.5
    assert len(esim.accuracy) == 2
    assert np.mean(esim.accuracy) > 0.25  # chance is 0.1
    assert report.protocol["share of events with the right sign"] > 0.95
    assert [(one.arm, one.way) for one in report.scores[:2]] == [
        ("esim", "exact"),
        ("frame difference", "frames"),
    ]


@pytest.mark.torch
def test_the_page_shows_what_the_document_holds(report, tmp_path):
    write_document(tmp_path / "digits.json", report.document(), overwrite=False)
    document = read_document(tmp_path / "digits.json")
    assert read_report(document) == report
    files = page_files(document, "digits.json")
    assert sorted(files) == ["digits.md", "digits.svg"]
    assert digits_table(report).rstrip() in files["digits.md"].decode()
    assert "| esim | true frames |" in digits_table(report)


def test_an_arm_may_draw_as_the_training_stream_does(torch, data, tmp_path, monkeypatch):
    monkeypatch.setattr(digits, "train_network", lambda images, labels, **options:
                        Nearest.train(images, labels, seed=0, **OPTIONS))  # fmt: skip
    monkeypatch.setattr(digits, "predict", Nearest.predict)
    plan = dataclasses.replace(
        tiny_plan(data, tmp_path), arms=("recommended", MATCHED), digits=20, seeds=1, folds=2
    )
    found = run_digits(plan)
    recommended, matched = found.scores[:2]
    assert (recommended.arm, matched.arm) == ("recommended", MATCHED)
    assert recommended.threshold is matched.threshold is None
    assert matched.events > 1.5 * recommended.events > 100  # by a third of the threshold
    assert "| recommended | true frames | drawn | " in digits_table(found)


def test_images_move_by_whole_pixels_with_zeros_behind():
    image = np.arange(1, 26).reshape(1, 1, 5, 5)
    expected = np.zeros_like(image)
    expected[..., :3, 1:] = image[..., 2:, :4]
    assert np.array_equal(shift_images(image, np.array([[1, -2]])), expected)


def run(**changes):
    plan = DigitsPlan(mnist=Path("m"), nmnist=Path("n"), work=Path("w"), **changes)
    return DigitsRun(plan, mnist="a", recorded="b", target=4000.0, polarity=0.9)


@pytest.mark.parametrize("arm", [*ARMS, *ABLATION], ids=lambda arm: arm.name)
def test_every_arm_has_settings_and_a_threshold_that_can_be_set(arm):
    for way in () if arm.stream else arm.ways:
        first, second = arm.settings(way), arm.settings(way, threshold=0.4)
        assert first.simulate != second.simulate
        assert first.interpolate.interpolate in ("exact", "flow", "none")


def test_drawn_thresholds_lie_about_the_fitted_one_and_depend_on_the_image():
    wide = next(arm for arm in ABLATION if arm.threshold_range > 1)
    drawn = np.array([wide.threshold_of(number, 0.3) for number in range(400)])
    parts = np.log(drawn / 0.3) / np.log(wide.threshold_range)
    assert -0.5 <= parts.min() < -0.49
    assert 0.49 < parts.max() <= 0.5
    assert wide.threshold_of(7, 0.3) == drawn[7]
    assert ARMS[0].threshold_of(7, 0.3) == 0.3


def test_pairs_and_training_digits_are_disjoint():
    plan = run(digits=9000).plan
    assert (plan.numbers[0], plan.numbers[-1]) == (plan.pairs + 1, 9100)


def test_files_depend_on_what_they_hold_and_on_nothing_else():
    training = DigitsTraining(None, "histogram", 0, fold=1)
    first = run().prediction_path(training)
    assert run(arms=("v2e",), seeds=9).prediction_path(training) == first
    others = [
        run(digits=1000).prediction_path(training),
        dataclasses.replace(run(), recorded="x").prediction_path(training),
        run().prediction_path(dataclasses.replace(training, seed=1)),
        run().prediction_path(dataclasses.replace(training, fold=2)),
        run(folds=5).prediction_path(training),
        run(precision="bfloat16").prediction_path(training),
        run().prediction_path(DigitsTraining(Cell("esim", "exact"), "histogram", 0)),
    ]
    assert len({first, *others}) == 1 + len(others)
    cell = Cell("esim", "exact")
    assert run(seeds=9).set_path(cell) == run().set_path(cell)
    ablated = {run().set_path(Cell(arm.name, arm.ways[0])) for arm in ABLATION}
    assert len(ablated) == len(ABLATION)
    assert run().set_path(dataclasses.replace(cell, way="flow")) != run().set_path(cell)
