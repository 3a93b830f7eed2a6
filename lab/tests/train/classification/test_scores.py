"""Scores of validation, against their definitions."""

import math
from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.classification.config import ClassData, ClassificationConfig  # noqa: E402
from texvent_lab.train.classification.task import ClassificationTask  # noqa: E402
from texvent_lab.train.loop import score_text  # noqa: E402
from texvent_lab.train.schedule import Schedule  # noqa: E402

from ..written_samples import bar  # noqa: E402

pytestmark = pytest.mark.torch


def task(folder: Path, counts: tuple[int, ...]) -> ClassificationTask:
    """Recordings of as many classes, with so many samples each."""
    for label, count in enumerate(counts):
        place = folder / "test" / f"class{label}"
        place.mkdir(parents=True)
        for number in range(count):
            bar(label % 2, number).save(place / f"{number}.npz")
    data = ClassData(recordings=folder)
    return ClassificationTask(ClassificationConfig(data=data, schedule=Schedule(batch_size=3)))


def scores_of(table: np.ndarray):
    """A network that gives the rows of a table, batch by batch."""
    rows = iter(torch.from_numpy(table.astype(np.float32)))
    return lambda images: torch.stack([next(rows) for _ in images])


def test_accuracy_and_its_standard_error(tmp_path):
    # Classes 0, 0, 0, 1, 1: three are right.
    table = np.array([[2, 1], [0, 1], [3, 0], [5, 0], [0, 1]])
    found, _ = task(tmp_path, (3, 2)).validate(scores_of(table), torch.device("cpu"), workers=0)
    names = ["accuracy", "accuracy standard error", "validation samples", "validation loss"]
    assert [*found] == names
    assert found["validation samples"] == len(table)
    assert "validation samples 5, " in score_text({"epoch": 1, **found})
    assert found["accuracy"] == pytest.approx(3 / 5)
    assert found["accuracy standard error"] == pytest.approx(math.sqrt(0.6 * 0.4 / 5))
    margins = np.array([1, -1, 3, -5, 1])
    assert found["validation loss"] == pytest.approx(np.log1p(np.exp(-margins)).mean(), rel=1e-6)


def test_with_more_than_five_classes_the_right_one_may_be_among_the_five_likeliest(tmp_path):
    counts = (1,) * 7
    order = np.array([[0, 1, 2, 3, 4, 5, 6]] * 7)  # class 0 is the likeliest, 6 the least
    table = -order.astype(float)
    found, _ = task(tmp_path, counts).validate(scores_of(table), torch.device("cpu"), workers=0)
    assert found["accuracy"] == pytest.approx(1 / 7)
    assert found["top-5 accuracy"] == pytest.approx(5 / 7)
    assert found["top-5 accuracy standard error"] == pytest.approx(math.sqrt(10 / 49 / 7))


def test_of_equal_scores_the_first_class_is_predicted_and_no_number_recognises_nothing(tmp_path):
    table = np.array([[2, 2], [np.nan, np.nan], [3, 0], [2, 2], [0, 1]])
    _, predictions = task(tmp_path, (3, 2)).validate(
        scores_of(table), torch.device("cpu"), workers=0
    )
    assert predictions["class"] == [0, 0, 0, 1, 1]
    assert predictions["rank"] == [0, 2, 0, 1, 0]
    assert predictions["predicted"][0] == predictions["predicted"][3] == 0
    assert predictions["sample"][3].endswith("class1/0.npz")
