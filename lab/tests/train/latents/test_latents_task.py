"""A head trained end to end on a tiny autoencoder's latents of tiny scenes."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from texvent.cli.app import main

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from lab.tests.latents.tiny_autoencoder import write_autoencoder  # noqa: E402

from texvent_lab.latents.change import sample_packets  # noqa: E402
from texvent_lab.latents.head import load_head  # noqa: E402
from texvent_lab.train.latents.config import LatentsConfig  # noqa: E402
from texvent_lab.train.latents.pairs import CHANGE, LATENTS, LatentPairs  # noqa: E402
from texvent_lab.train.run import read_training, train_from_file  # noqa: E402
from texvent_lab.train.schedule import Hardware  # noqa: E402

pytestmark = pytest.mark.torch
SCENES = """\
name = "tiny"
splits = {train = 0.5, validation = 0.5}
options = {duration = 0.17, fps = 24, sensor = "16x16", samples = 1, shadows = false}
[[sources]]
template = "a {colour} ball flies {way}"
words.colour = ["red", "white"]
words.way = ["left", "right"]
"""
TRAINING = """\
data = {specification = "tiny.toml", autoencoder = "vae", cache = "cache"}
network = {bins = 4, width = 8, blocks = 1}
schedule = {epochs = 2, batch_size = 2, learning_rate = 0.001}
"""


def write_training(folder: Path) -> Path:
    (folder / "tiny.toml").write_text(SCENES)
    write_autoencoder(folder / "vae")
    path = folder / "latents.toml"
    path.write_text(TRAINING)
    return path


def test_the_weights_of_a_training_are_a_head_that_gives_events(tmp_path: Path) -> None:
    path, folder = write_training(tmp_path), tmp_path / "head"
    assert main(["train", "latents", str(path), "-o", str(folder), "--device", "cpu", "-q"]) == 0
    rows = json.loads((folder / "history.json").read_text())["epochs"]

    weights, out = folder / "weights.pt", tmp_path / "scores.json"
    words = [str(path), str(weights), "--device", "cpu", "-o", str(out)]
    assert main(["evaluate", "latents", *words]) == 0
    scores = json.loads(out.read_text())["scores"]
    best = min(rows, key=lambda row: row["relative error"])
    assert scores["relative error"] == pytest.approx(best["relative error"], rel=1e-4)

    head = load_head(weights)
    pairs = LatentPairs(read_training(path, LatentsConfig()).data, "validation", 4, 30.0)
    frames, true = pairs.scenes.read(0)
    change = head.predict(pairs.autoencoder.encode(frames, true.fps))
    assert change.voxels.shape == true.voxels.shape == (2, 4, 16, 16)
    events = list(sample_packets(change, contrast_threshold=0.01))
    assert len(events) == 2
    assert sum(map(len, events)) > 0


def test_a_head_learns_the_changes_of_a_pair(tmp_path: Path) -> None:
    task = read_training(write_training(tmp_path), LatentsConfig()).make_task()
    network = task.make_network()
    batch = next(iter(task.batches(workers=0).epoch(0)))
    optimizer = torch.optim.Adam(network.parameters(), lr=0.01)
    losses = []
    for _ in range(60):
        optimizer.zero_grad()
        loss = task.loss(network, batch, "cpu")
        loss.backward()
        optimizer.step()
        losses.append(float(loss.detach()))
    # At first the head sees nothing move.
    true = batch[CHANGE]
    nothing = float(true.square().mean() + true.cumsum(2).square().mean())
    assert losses[0] == pytest.approx(nothing, rel=1e-5)
    assert losses[-1] < 0.7 * nothing


def test_the_loss_of_an_epoch_is_the_mean_of_its_batches(tmp_path: Path) -> None:
    path, losses = write_training(tmp_path), []
    for size in (1, 2):
        text = TRAINING.replace("batch_size = 2", f"batch_size = {size}")
        path.write_text(text.replace("0.001", "1e-12"))
        state = train_from_file(LatentsConfig, path, tmp_path / f"{size}", Hardware(device="cpu"))
        losses.append(state.rows[0]["training loss"])
    assert losses[0] == pytest.approx(losses[1], rel=1e-5)


def test_mirrored_pairs_are_latents_of_mirrored_frames(tmp_path: Path) -> None:
    data = read_training(write_training(tmp_path), LatentsConfig()).data
    pairs = LatentPairs(data, "train", 4, 30.0, is_augmented=True)
    frames, change = pairs.scenes.read(0)
    draws = [pairs(0, np.random.default_rng(seed)) for seed in range(8)]
    seen = {bool((one[CHANGE] == change.voxels).all()): one for one in draws}
    assert seen.keys() == {True, False}
    np.testing.assert_array_equal(seen[False][CHANGE], change.voxels[..., ::-1])
    for is_plain, one in seen.items():
        shown = frames if is_plain else frames[:, :, ::-1]
        expected = pairs.autoencoder.encode(shown, change.fps).values
        np.testing.assert_allclose(one[LATENTS], expected, rtol=0, atol=1e-6)
