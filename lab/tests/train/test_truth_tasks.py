"""Depth and flow, trained end to end: they learn, are scored and refused."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from texvent.cli.app import main

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.registries import TASKS  # noqa: E402
from texvent_lab.train.depth import (  # noqa: E402
    DepthConfig,
    encode_depth,
    settings_of,
)
from texvent_lab.train.run import read_training, train_from_file  # noqa: E402
from texvent_lab.train.schedule import Hardware  # noqa: E402

from .windowed_specification import write_specification  # noqa: E402

pytestmark = pytest.mark.torch
TASK_NAMES = ("depth", "flow")
SCORES = {"depth": "abs_rel", "flow": "EPE"}
CPU = Hardware(device="cpu")


def write_training(folder: Path, *, network: str = "width = 2", epochs: int = 3) -> Path:
    write_specification(folder)
    path = folder / "training.toml"
    path.write_text(
        'data = {specification = "tiny.toml", variant = "paper", slice_us = 20_000, length = 3, '
        'cache = "cache"}\n'
        f"network = {{{network}}}\n"
        f"schedule = {{epochs = {epochs}, batch_size = 2, learning_rate = 0.003}}\n"
    )
    return path


@pytest.mark.parametrize("task", TASK_NAMES)
def test_a_training_learns_and_its_weights_score_as_they_did(task: str, tmp_path: Path) -> None:
    words = ["train", task, str(write_training(tmp_path, epochs=4)), "--device", "cpu", "-q"]
    folder = tmp_path / "run"
    assert main([*words, "-o", str(folder)]) == 0
    rows = json.loads((folder / "history.json").read_text())["epochs"]
    assert rows[-1]["training loss"] < rows[0]["training loss"]

    out = tmp_path / "scores.json"
    words = [str(tmp_path / "training.toml"), str(folder / "weights.pt"), "--device", "cpu"]
    assert main(["evaluate", task, *words, "-o", str(out)]) == 0
    best = min(rows, key=lambda row: row[SCORES[task]])
    scores = json.loads(out.read_text())["scores"]
    assert np.isfinite(scores[SCORES[task]])
    for name, value in scores.items():
        assert value == pytest.approx(best[name], rel=1e-4, nan_ok=True)


@pytest.mark.parametrize("sky", ["true", "false"])
def test_the_sky_is_learned_as_80_m_or_not_at_all(sky: str, tmp_path: Path) -> None:
    path = write_training(tmp_path)
    path.write_text(path.read_text() + f"loss = {{shift_weight = 0, sky = {sky}}}\n")
    task = read_training(path, DepthConfig()).make_task()
    depth = torch.full((1, 1, 1, 16, 16), 20.0)
    depth[..., :4, :] = torch.tensor([math.inf, 90.0, 80.0, 500.0]).repeat(4)
    right = encode_depth(depth)
    wrong = right.clone()
    wrong[..., :4, :] = 0
    batch = {"grids": depth, "depth": depth}
    of_right, of_wrong = (float(task.loss(lambda _, x=x: x, batch, "cpu")) for x in (right, wrong))
    assert of_right == 0
    if sky == "true":
        assert of_wrong > 0.25
    else:
        assert of_wrong == 0


def test_depth_has_the_published_layout(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_training(tmp_path, epochs=1)
    train_from_file(TASKS.load("depth"), path, tmp_path / "run", CPU)
    content = torch.load(tmp_path / "run" / "weights.pt", weights_only=True)
    assert content["arch"] == "E2VIDRecurrent"
    assert content["config"]["model"] == settings_of(2)
    assert "unetrecurrent.encoders.2.recurrent_block.Gates.weight" in content["state_dict"]
    wider = write_training(tmp_path, network="width = 4")
    assert main(["evaluate", "depth", str(wider), str(tmp_path / "run" / "weights.pt")]) == 2
    error = capsys.readouterr().err
    assert "network.width must be that of the file" in error
    assert len(error.strip().splitlines()) == 1


def test_videos_have_no_truth(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = write_training(tmp_path)
    np.save(tmp_path / "video.npy", np.zeros((4, 24, 32), np.uint8))
    (tmp_path / "tiny.toml").write_text(
        'name = "videos"\nsplits = {validation = 1.0}\nfilters = {min_events = 0}\n'
        '[options]\nfps = 24\n[[sources]]\nvideos = ["video.npy"]\n[variants.paper]\n'
    )
    assert main(["train", "depth", str(path), "-o", str(tmp_path / "run"), "-q"]) == 2
    error = capsys.readouterr().err
    assert "tiny.toml simulates videos, whose depth is not known; give prompts" in error
    assert len(error.strip().splitlines()) == 1
