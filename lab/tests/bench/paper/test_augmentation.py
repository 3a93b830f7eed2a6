"""Tables 3 and 6: networks trained with a share of simulated clips and streams."""

import shutil
from dataclasses import replace
from pathlib import Path

import pytest

from texvent.cli.app import main
from texvent_lab.bench.jobs import no_progress
from texvent_lab.bench.paper import augmentation
from texvent_lab.bench.paper.config import PaperConfig
from texvent_lab.train.classification.config import PREFIX

from ...train.written_samples import write_recordings


def write_streams(folder: Path, per_class: int = 5) -> Path:
    """Recorded streams to train and test with, and simulated ones."""
    write_recordings(folder, per_class=per_class)
    (folder / "val").rename(folder / "test")
    shutil.copytree(folder / "train", folder / "texvent")
    return folder


def words(folder: Path, *more: str) -> list[str]:
    given = ["bench", "paper", "--table", "6", "--folder", str(folder), "-q", "--epochs", "1"]
    return [*given, "--image-size", "64x64", *more]


@pytest.mark.parametrize("missing", ["train", "test", "texvent"])
def test_a_folder_that_lacks_streams_is_refused_before_any_training(tmp_path, capsys, missing):
    shutil.rmtree(write_streams(tmp_path) / missing)
    assert main(words(tmp_path)) == 2
    named = missing if missing != "texvent" else "of simulated streams"
    assert f"has no sub-folder {named}; Table 6 needs train, test and" in capsys.readouterr().err


@pytest.mark.detect
@pytest.mark.parametrize("name", augmentation.CLASSIFIERS.values())
def test_each_network_of_the_paper_scores_classes_of_two_channels(name):
    import torch

    from texvent_lab.networks.torchvision_models import TorchvisionModel

    network = TorchvisionModel(2, 10, name=name.removeprefix(PREFIX), shape=(64, 64)).eval()
    with torch.inference_mode():
        assert network(torch.zeros(1, 2, 64, 64)).shape == (1, 10)


@pytest.mark.detect
def test_torchvisions_networks_are_read_back_and_refuse_what_they_cannot_take(tmp_path, capsys):
    write_recordings(tmp_path / "recorded")
    text = (
        'data = {{recordings = "recorded", validation_split = "val", image_size = "{size}"}}\n'
        'network = {{name = "torchvision:{name}", representation = "binary-event-image"}}\n'
        "schedule = {{epochs = 1, batch_size = 8}}\n"
    )
    path, out = tmp_path / "spec.toml", tmp_path / "run"
    command = ["train", "classification", str(path), "-o", str(out), "--device", "cpu", "-q"]
    for name, size, message in (
        ("vit_b_16", "40x40", "vit_b_16 takes no images of 40x40 px"),
        ("squeezenet", "64x64", "unknown network 'squeezenet'; did you mean 'squeezenet1_"),
    ):
        path.write_text(text.format(name=name, size=size))
        assert main(command) == 2
        assert message in capsys.readouterr().err
    path.write_text(text.format(name="squeezenet1_1", size="64x64"))
    assert main(command) == 0
    assert main(["evaluate", "classification", str(path), str(out / "weights.pt")]) == 0


@pytest.fixture
def trainings(monkeypatch):
    """Trainings by their folder's name, none of which is done; all have the same scores."""
    found = {}

    def last_scores(training, folder):
        found[folder.name] = training
        return {"accuracy": 0.25, "psnr": 20.0, "ssim": 0.5, "lpips": 0.125, "mse": 0.0625}

    monkeypatch.setattr(augmentation, "_last_scores", last_scores)
    return found


def test_a_fifth_as_many_simulated_streams_are_learned_beside_the_recorded_ones(
    tmp_path, trainings
):
    folder = write_streams(tmp_path / "streams", per_class=15)
    config = PaperConfig(table=6, folder=folder, epochs=3, image_size="64x48")
    found = augmentation.measure_recognition(config, no_progress)
    assert {*found.rows} == {"Original", "with Texvent"}
    assert all(row == dict.fromkeys(augmentation.CLASSIFIERS, "0.2500")
               for row in found.rows.values())  # fmt: skip
    assert "of 2 classes: guessing gives 0.5000" in found.notes[0]
    assert len(trainings) == 2 * len(augmentation.CLASSIFIERS)
    for column, network in augmentation.CLASSIFIERS.items():
        alone, more = (trainings[f"{column}-{one}"] for one in ("train", "texvent"))
        assert (alone.network.name, alone.schedule.epochs, alone.data.image_size) == (
            network, 3, "64x48"
        )  # fmt: skip
        assert (alone.data.split, alone.data.validation_split) == ("train", "test")
        assert (more.extra.recordings, more.extra.split, more.extra.per_class) == (
            folder, "texvent", 3
        )  # fmt: skip
        assert replace(more, extra=alone.extra) == alone != more


def test_reconstruction_is_learned_without_and_with_simulated_clips(
    tmp_path, trainings, pan_folder
):
    config = PaperConfig(
        table=3, recordings=str(pan_folder), specification=tmp_path / "spec.toml", epochs=2
    )
    (need,) = augmentation.measure_augmented_reconstruction(
        replace(config, specification=None), no_progress
    ).needs
    assert "--specification FILE" in need
    absent = augmentation.load_measures().absent
    found = augmentation.measure_augmented_reconstruction(config, no_progress)
    assert found.notes[0].endswith("loss: L1 + 1 - SSIM" if absent else "loss: LPIPS")
    titles = ["PSNR ↑", "SSIM ↑", "LPIPS ↓", "MSE ↓"]
    assert len(found.rows) == len(trainings) == 6
    for row, (folder, one) in zip(found.rows, trainings.items(), strict=True):
        assert (folder, row.endswith(" + 5 %")) == (
            row.replace(" ", ""), one.extra.specification == tmp_path / "spec.toml"
        )  # fmt: skip
        assert augmentation.RECONSTRUCTORS[row.removesuffix(" + 5 %")] == one.network.name
        assert list(found.rows[row].items()) == list(
            zip(titles, ["20.0000", "0.5000", "0.1250", "0.0625"], strict=True)
        )
        assert (one.loss.l1, one.loss.ssim, one.loss.lpips) == ((1, 1, 0) if absent else (0, 0, 1))
        assert (one.data.crop, one.data.length, one.extra.share, one.schedule.epochs) == (
            48, 20, 0.05, 2
        )  # fmt: skip
