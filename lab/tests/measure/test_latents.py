"""The benchmark of latents, from training to tables, on tiny scenes."""

from __future__ import annotations

from argparse import Namespace

import numpy as np
import pytest

from texvent.runtime.progress import NoProgress

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.measure.latents import __main__ as command  # noqa: E402
from texvent_lab.measure.latents import score  # noqa: E402

pytestmark = pytest.mark.torch
SCENES = """\
name = "tiny"
splits = {train = 0.34, validation = 0.33, test = 0.33}
options = {duration = 0.34, fps = 24, sensor = "32x32", samples = 1, shadows = false}
[[sources]]
template = "a {colour} ball flies {way}"
words.colour = ["red", "white", "blue"]
words.way = ["left", "right"]
"""
TRAINING = """\
data = {specification = "tiny.toml", autoencoder = "vae"}
network = {bins = 4, width = 8, blocks = 1}
schedule = {epochs = 1, batch_size = 2, learning_rate = 0.001}
"""
WAYS = [
    score.ORIGINAL, score.TRUE_CHANGE, score.TRUE_LDATI,
    score.FULL, score.TINY, score.HEAD, score.HEAD_LDATI,
]  # fmt: skip


@pytest.fixture
def options(tmp_path, monkeypatch):
    (tmp_path / "tiny.toml").write_text(SCENES)
    (tmp_path / "training.toml").write_text(TRAINING)
    monkeypatch.setattr(command, "TRAINING", tmp_path / "training.toml")
    return Namespace(out=tmp_path / "out", steps=4, scenes=None)


def test_a_run_trains_once_and_scores_every_way(options):
    made = command.run(options, NoProgress())
    assert [row["way"] for row in made["summary"]] == WAYS
    assert len(made["rows"]) == len(WAYS) * len({row["scene"] for row in made["rows"]})
    original, true_change, _, decoded = made["summary"][:4]
    # What is known of the changes between frames is more than the frames show.
    assert true_change["1-stpp"][0] <= original["1-stpp"][0]
    assert original["minus original"] == [0, 0, 0]
    assert "psnr" in decoded
    assert "psnr" not in original
    assert all(way in score.table(made["summary"]) for way in WAYS)

    weights = {path: path.read_bytes() for path in options.out.rglob("*.safetensors")}
    assert len(weights) == 2
    again = command.run(options, NoProgress())
    assert {path: path.read_bytes() for path in weights} == weights
    scores = [[row["1-stpp"] for row in one["rows"]] for one in (made, again)]
    np.testing.assert_array_equal(*scores)


def test_means_and_intervals_by_hand():
    rows = [
        {"scene": scene, "way": score.ORIGINAL, "1-stpp": 0.5, "events": events,
         "true_events": 10, "frames": 4, "cpu_s": 0.002}
        for scene, events in enumerate((5, 10, 15))
    ]  # fmt: skip
    (summary,) = score.summarise(rows)
    assert summary["1-stpp"] == [0.5, 0.5, 0.5]
    assert summary["cpu_ms_per_frame"] == pytest.approx(0.5)
    middle, low, high = summary["rate ratio"]
    assert middle == 1.0
    assert 0.5 <= low < 1.0 < high <= 1.5
