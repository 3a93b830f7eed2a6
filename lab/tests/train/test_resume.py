"""Trainings, disturbed between two runs, end as undisturbed ones, or say why not."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.resume.disturbed import DISTURBANCES, Resumable, Runs, undisturbed

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from .windowed_specification import TEXT, write_specification  # noqa: E402
from .written_samples import as_weights, write_bars_training  # noqa: E402

pytestmark = pytest.mark.torch


def write_bars(shift: int = 0) -> None:
    write_bars_training(Path(), epochs=2, shift=shift)


def write_clips() -> None:
    write_specification(Path(), TEXT.replace("0.125", "0.07").replace(', "white"', ""))
    Path("clips.toml").write_text(
        "schedule = {epochs = 1, batch_size = 1}\nnetwork.name = 'firenet'\n"
        "data = {specification = 'tiny.toml', variant = 'paper', cache = 'cache', "
        "slice_us = 20_000, length = 2, crop = 16}\nloss = {lpips = 0, l1 = 1}\n"
    )


def other_option() -> None:
    path = Path("bars.toml")
    path.write_text(f"{path.read_text()}weight_decay = 0.5\n")


TRAIN = {
    "index": ("checkpoint.pt",),
    "readers": {".pt": as_weights},
    "rewritten": ("weights.pt", "history.json", "curves.png"),
}
TRAININGS = {
    "classification": Resumable(
        prepare=write_bars,
        words=("train", "classification", "bars.toml", "-o", "out", "--device", "cpu", "-q"),
        changes={"content": lambda: write_bars(shift=1), "option": other_option},
        **TRAIN,
    ),
    "reconstruction": Resumable(
        prepare=write_clips,
        words=("train", "reconstruction", "clips.toml", "-o", "out", "--device", "cpu", "-q"),
        **TRAIN,
    ),
}


@pytest.fixture(scope="module", params=TRAININGS)
def runs(
    request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[Runs]:
    torch.set_num_threads(1)
    with undisturbed(TRAININGS[request.param], tmp_path_factory.mktemp("runs")) as runs:
        yield runs


@pytest.mark.parametrize("disturb", DISTURBANCES)
def test_a_training_ends_as_an_undisturbed_one_or_says_why_not(runs, disturb, capsys):
    disturb(runs, capsys)
