"""The training files of the repository: read as they are, and run on tiny data."""

import re
from pathlib import Path

import pytest

from texvent.cli.app import main
from texvent.dataset.specification.reading import read_specification

from ...nt_imagenet.tiny_data import WNIDS, write_stream

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.classification.config import ClassificationConfig  # noqa: E402
from texvent_lab.train.reconstruction.config import ReconstructionConfig  # noqa: E402
from texvent_lab.train.run import read_training  # noqa: E402

pytestmark = pytest.mark.torch
ROOT = Path(__file__).parents[4]
FILES = ROOT / "configs" / "training"


def test_n_imagenets_recipe_is_the_published_one():
    found = read_training(FILES / "n-imagenet-resnet34.toml", ClassificationConfig())
    assert (found.seed, found.data.slice_events, found.data.image_size) == (1, 30_000, "224x224")
    assert found.data.recordings == FILES / "N_Imagenet"
    schedule = found.schedule
    assert schedule.optimizer == "adam"
    assert (schedule.learning_rate, schedule.weight_decay) == (3e-4, 1e-4)
    assert (schedule.epochs, schedule.batch_size, schedule.patience) == (100, 256, 3)
    augmentation = found.augmentation
    assert (augmentation.shift, augmentation.flip_x, augmentation.flip_time) == (20, True, True)


def test_n_imagenets_recipe_learns_files_of_its_layout(tmp_path, capsys):
    for split in ("train", "val"):
        for number, wnid in enumerate(WNIDS * 4):
            place = tmp_path / "N_Imagenet" / f"extracted_{split}" / wnid / f"{number}.npz"
            write_stream(place, 500, number)
    text = (FILES / "n-imagenet-resnet34.toml").read_text()
    text = text.replace("epochs = 100", "epochs = 1")
    text = text.replace("[network]", "[network]\nwidth = 2")
    (tmp_path / "spec.toml").write_text(text)
    words = [str(tmp_path / "spec.toml"), "-o", str(tmp_path / "run"), "--device", "cpu", "-q"]
    assert main(["train", "classification", *words]) == 0
    assert re.search(r"best epoch 1 of 1: .*accuracy 0\.\d", capsys.readouterr().out)


def test_the_first_example_is_a_specification_and_a_training_of_it():
    specification = read_specification(FILES / "shapes.toml")
    training = read_training(FILES / "shapes-classifier.toml", ClassificationConfig())
    assert training.data.folder == FILES / specification.name
    assert {training.data.split, training.data.validation_split} <= {*specification.splits}


def test_the_training_files_of_the_page_are_read(tmp_path):
    page = (ROOT / "docs" / "training.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```toml\n# ([\w-]+\.toml).*?\n(.*?)```", page, re.DOTALL)
    assert [name for name, _ in blocks] == ["cars.toml", "digits.toml", "film.toml"]
    for name, text in blocks:
        (tmp_path / name).write_text(text)
    for name in ("cars.toml", "digits.toml"):
        read_training(tmp_path / name, ClassificationConfig())
    read_training(tmp_path / "film.toml", ReconstructionConfig())
