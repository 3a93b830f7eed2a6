"""A training that is killed amid an epoch goes on to the last bit of one that was not."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent.extending import full_version  # noqa: E402

from .windowed_specification import TEXT, write_specification  # noqa: E402
from .written_samples import write_bars  # noqa: E402

pytestmark = pytest.mark.torch
# Every training is a process of its own, as a user's is: libraries that other tests loaded, and
# what they set, could change a last bit. It takes its version from this process: a commit on the
# tree, made while the tests run, is no other version of texvent.
TRAINING = """
import os, signal, sys
from pathlib import Path
import torch
torch.set_num_threads(1)
from texvent import _version
_version.full_version = lambda version=sys.argv[1]: version
from texvent_lab.registries import TASKS
from texvent.runtime.progress import NoProgress
from texvent_lab.train.run import train_from_file
from texvent_lab.train.schedule import Hardware

class Kill(NoProgress):
    def advance(self, stage, done, total):
        if stage == "epoch 2 of 3" and done < total:
            os.kill(os.getpid(), signal.SIGKILL)

if __name__ == "__main__":
    task, path, folder, end = sys.argv[2:]
    watcher = Kill() if end == "killed" else NoProgress()
    train_from_file(TASKS.load(task), Path(path), Path(folder), Hardware(device="cpu"), watcher)
"""
TRAININGS = {
    "classification": 'data = {folder = "bars"}\n',
    "reconstruction": 'data = {specification = "tiny.toml", variant = "paper", cache = "cache", '
    'slice_us = 20_000, length = 3, crop = 16}\nnetwork.name = "firenet"\n'
    "loss = {lpips = 0, l1 = 1}\n",
}
SCHEDULE = "schedule = {epochs = 3, batch_size = 1, learning_rate = 0.003}\n"


def stored(folder: Path) -> dict[str, Any]:
    """The state of a training as texts, which are equal where all bits are, and its seconds."""
    state = torch.load(folder / "checkpoint.pt", weights_only=True)
    seconds = [row.pop("seconds") for row in state["rows"]]
    texts = {name: json.dumps(one, default=torch.Tensor.tolist) for name, one in state.items()}
    return {**texts, "seconds": seconds}


@pytest.mark.parametrize("task", TRAININGS)
def test_a_killed_training_ends_as_one_that_was_not(task: str, tmp_path: Path) -> None:
    write_bars(tmp_path / "bars")
    write_specification(tmp_path, TEXT.replace("0.125", "0.17"))
    path = tmp_path / "training.toml"
    path.write_text(SCHEDULE + TRAININGS[task])
    one, other = tmp_path / "whole", tmp_path / "killed"

    def train(folder: Path, end: str) -> int:
        words = [sys.executable, "-c", TRAINING, full_version(), task, str(path), str(folder), end]
        return subprocess.run(words, timeout=600, check=False).returncode

    assert train(one, "done") == 0
    assert train(other, "killed") == -signal.SIGKILL
    before = stored(other)
    assert before["epochs"] == "1"
    assert train(other, "done") == 0
    whole, killed = stored(one), stored(other)
    # What was done before is not done again.
    assert killed.pop("seconds")[:1] == before.pop("seconds")
    assert [name for name in killed if killed[name] != whole[name]] == []
    assert killed["network"] != before["network"]
