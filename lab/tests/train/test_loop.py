"""The training loop: scores, files, refusals; `test_resuming.py` has what follows a kill."""

import json
from pathlib import Path

import pytest

from texvent.cli.app import main

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")


from texvent_lab.train.classification.config import ClassificationConfig  # noqa: E402
from texvent_lab.train.classification.task import ClassificationTask  # noqa: E402
from texvent_lab.train.run import train_from_file  # noqa: E402
from texvent_lab.train.schedule import Hardware, Schedule  # noqa: E402

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


@pytest.mark.parametrize("keep", ["best", "last"])
def test_the_best_network_is_kept_or_the_last(specification, tmp_path, monkeypatch, capsys, keep):
    specification.write_text(
        f'data = {{folder = "bars"}}\n[schedule]\nepochs = 3\nkeep = "{keep}"\n'
    )
    scores = iter([0.5, 0.9, 0.6])
    monkeypatch.setattr(
        ClassificationTask, "validate", lambda *_, **__: ({"accuracy": next(scores)}, {})
    )
    state = train_from_file(ClassificationConfig, specification, tmp_path / "run", CPU)
    assert state.best_epoch == 2
    wanted, other = state.best, state.network
    if keep == "last":
        wanted, other = other, wanted
    kept = weights(tmp_path / "run")
    assert all(torch.equal(kept[name], wanted[name]) for name in kept)
    assert not all(torch.equal(kept[name], other[name]) for name in kept)
    told = json.loads((tmp_path / "run" / "history.json").read_text())
    assert told["best_epoch"] == 2
    words = ["classification", str(specification), "-o", str(tmp_path / "run"), "--device", "cpu"]
    assert main(["train", *words, "-q"]) == 0  # it is complete: tells the same
    number, score = (3, "0.6") if keep == "last" else (2, "0.9")
    assert told["kept_epoch"] == number
    assert f"{keep} epoch {number} of 3: " in (said := capsys.readouterr().out)
    assert f"accuracy {score}" in said


def test_options_of_the_schedule_reach_the_optimiser(specification, tmp_path):
    optimizer = Schedule(
        optimizer="adamw", learning_rate=0.1, weight_decay=0.2, amsgrad=True
    ).make_optimizer(torch.nn.Linear(1, 1))
    assert isinstance(optimizer, torch.optim.AdamW)
    expected = {"lr": 0.1, "weight_decay": 0.2, "amsgrad": True}
    assert optimizer.param_groups[0].items() >= expected.items()
    specification.write_text(specification.read_text() + "clip_gradient = 1e-6\n")
    state = train_from_file(ClassificationConfig, specification, tmp_path / "run", CPU)
    moments = [one["exp_avg_sq"].sum() for one in state.optimizer["state"].values()]
    assert 0 < sum(moments) < 1e-12


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
