"""Scores of trained weights: equal to those of training, and refused where they do not fit."""

import json
from pathlib import Path

import pytest

from texvent.cli.app import main

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from .written_samples import write_bars_training  # noqa: E402

pytestmark = pytest.mark.torch


@pytest.fixture
def trained(tmp_path: Path) -> Path:
    """A folder with a training file and what it trained."""
    path = write_bars_training(tmp_path, epochs=2)
    words = [str(path), "-o", str(tmp_path / "run"), "--device", "cpu", "-q"]
    assert main(["train", "classification", *words]) == 0
    return tmp_path


def evaluate(folder: Path, *words: str, specification: str = "bars.toml") -> int:
    paths = [str(folder / specification), str(folder / "run" / "weights.pt")]
    return main(["evaluate", "classification", *paths, "--device", "cpu", *words])


def test_the_scores_are_those_of_the_best_epoch(trained):
    assert evaluate(trained, "-o", str(trained / "scores.json")) == 0
    told = json.loads((trained / "run" / "history.json").read_text())
    best = max(told["epochs"], key=lambda row: row["accuracy"])
    found = json.loads((trained / "scores.json").read_text())
    assert found["scores"]["accuracy"] == best["accuracy"]
    assert found["scores"]["loss"] == pytest.approx(best["validation loss"], rel=1e-6)
    assert found["scores"]["samples"] == best["validation samples"]
    assert not any("validation" in name for name in found["scores"])  # the split is "test"
    assert found["weights"]["file"] == "weights.pt"
    assert found["scored_on"]["data"]["validation_split"] == "test"
    predictions = found["predictions"]
    assert predictions["sample"][:2] == ["sample test000", "sample test001"]
    assert predictions["class"] == [0, 1] * 4
    is_right = [
        one == two
        for one, two in zip(*(predictions[name] for name in ("class", "predicted")), strict=True)
    ]
    assert is_right == [rank == 0 for rank in predictions["rank"]]
    assert sum(is_right) / 8 == best["accuracy"]


def test_other_samples_need_no_training_split(trained):
    (trained / "other.toml").write_text(
        'data = {folder = "bars", split = "no such", validation_split = "train"}\n'
    )
    assert evaluate(trained, specification="other.toml") == 0


def change_classes(path: Path) -> None:
    content = torch.load(path, weights_only=True)
    torch.save({**content, "classes": ["cat", "dog"]}, path)


def change_shape(path: Path) -> None:
    content = torch.load(path, weights_only=True)
    content["state_dict"]["linear.weight"] = torch.zeros(7, 64)
    torch.save(content, path)


def make_infinite(path: Path) -> None:
    content = torch.load(path, weights_only=True)
    content["state_dict"]["linear.bias"][0] = float("inf")
    torch.save(content, path)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (change_classes, "tells apart the classes ['cat', 'dog'], and the samples have"),
        (change_shape, "size mismatch for linear.weight"),
        (make_infinite, "linear.bias holds values that are NaN or infinite"),
        (lambda path: path.write_bytes(b"PK\x03\x04damaged"), "weights.pt"),
        (Path.unlink, "there is no weights file"),
    ],
)
def test_weights_that_do_not_fit_are_refused_in_one_line(trained, capsys, change, message):
    change(trained / "run" / "weights.pt")
    assert evaluate(trained) == 2
    error = capsys.readouterr().err
    assert message in error
    assert len(error.strip().splitlines()) == 1
