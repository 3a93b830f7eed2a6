"""Trainings of networks: learning, files, workers, refusals; `test_schedules.py` has the loop."""

import json
from pathlib import Path

import pytest

from texvent.cli.app import main
from texvent.errors import InputError

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")


from texvent_lab.train.classification.config import ClassificationConfig  # noqa: E402
from texvent_lab.train.run import train_from_file  # noqa: E402
from texvent_lab.train.schedule import Hardware  # noqa: E402
from texvent_lab.train.task import Batches  # noqa: E402

from .written_samples import write_bars_training  # noqa: E402

pytestmark = pytest.mark.torch
CPU = Hardware(device="cpu")


@pytest.fixture
def specification(tmp_path: Path) -> Path:
    return write_bars_training(tmp_path, epochs=4)


def weights(folder: Path) -> dict[str, torch.Tensor]:
    return torch.load(folder / "weights.pt", weights_only=True)["state_dict"]


def test_a_small_network_learns_and_its_files_say_how(specification, tmp_path):
    state = train_from_file(ClassificationConfig, specification, tmp_path / "run", CPU)
    assert state.rows[-1]["accuracy"] == 1.0
    assert state.rows[-1]["training loss"] < state.rows[0]["training loss"]
    told = json.loads((tmp_path / "run" / "history.json").read_text())
    assert [row["epoch"] for row in told["epochs"]] == [1, 2, 3, 4]
    assert told["best_epoch"] == state.best_epoch
    assert told["training"]["schedule"]["epochs"] == 4
    assert (tmp_path / "run" / "curves.png").read_bytes().startswith(b"\x89PNG")
    for name, tensor in weights(tmp_path / "run").items():
        torch.testing.assert_close(tensor, state.best[name], rtol=0, atol=0)


def test_workers_change_nothing_and_another_seed_does(specification, tmp_path):
    train_from_file(ClassificationConfig, specification, tmp_path / "one", CPU)
    train_from_file(
        ClassificationConfig, specification, tmp_path / "two", Hardware(device="cpu", workers=1)
    )
    specification.write_text("seed = 1\n" + specification.read_text())
    train_from_file(ClassificationConfig, specification, tmp_path / "three", CPU)
    one, two, three = (weights(tmp_path / name) for name in ("one", "two", "three"))
    assert all(torch.equal(one[name], two[name]) for name in one)
    assert not torch.equal(one["conv0.weight"], three["conv0.weight"])


def test_another_training_is_not_continued(specification, tmp_path, capsys):
    words = ["train", "classification", str(specification), "-o", str(tmp_path / "run"), "-q"]
    assert main(words) == 0
    specification.write_text(specification.read_text().replace("0.01", "0.02"))
    assert main(words) == 2
    assert "learning_rate was 0.01, is 0.02" in capsys.readouterr().err
    specification.write_text(specification.read_text().replace("0.02", "0.01"))
    path = tmp_path / "run" / "checkpoint.pt"
    torch.save({**torch.load(path, weights_only=True), "version": "0.0.9"}, path)
    assert main(words) == 2
    assert "was begun by texvent 0.0.9" in capsys.readouterr().err


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
        (change_shape, "size mismatch for linear.weight"),
        (make_infinite, "linear.bias holds values that are NaN or infinite"),
        (lambda path: path.write_bytes(b"PK\x03\x04damaged"), "weights.pt"),
        (Path.unlink, "there is no weights file"),
    ],
)
def test_weights_that_do_not_fit_are_refused_in_one_line(tmp_path, capsys, change, message):
    specification = write_bars_training(tmp_path, epochs=1)
    words = ["classification", str(specification), "--device", "cpu", "-q"]
    assert main(["train", *words, "-o", str(tmp_path / "run")]) == 0
    weights = tmp_path / "run" / "weights.pt"
    assert main(["evaluate", words[0], words[1], str(weights), *words[2:4]]) == 0
    change(weights)
    assert main(["evaluate", words[0], words[1], str(weights), *words[2:4]]) == 2
    error = capsys.readouterr().err
    assert message in error
    assert len(error.strip().splitlines()) == 1


def refuse(number, chance):
    raise InputError(f"sample {number} is bad: give another")


@pytest.mark.parametrize("workers", [0, 1])
def test_an_error_is_the_same_from_this_process_and_from_a_worker(workers):
    batches = Batches(make=refuse, count=1, batch_size=1, seed=0, workers=workers)
    with pytest.raises(InputError) as caught:
        next(batches.epoch(0))
    assert str(caught.value) == "sample 0 is bad: give another"
