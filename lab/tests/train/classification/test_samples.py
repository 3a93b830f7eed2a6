"""Samples of every kind, put together, and refused before any work where they do not fit."""

import json
from pathlib import Path

import pytest
from tests.dataset.stored.written_set import write_shard

from texvent.cli.app import main
from texvent.events import EventStream
from texvent.sensor import SensorSize

from ..written_samples import SIZE, bar, write_bars, write_recordings

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.train.classification.config import ClassificationConfig  # noqa: E402
from texvent_lab.train.classification.task import ClassificationTask  # noqa: E402
from texvent_lab.train.run import read_training  # noqa: E402

pytestmark = pytest.mark.torch


def write(path: Path, data: str, more: str = "") -> Path:
    path.write_text(
        f"data = {{{data}}}\n{more}\n[schedule]\nepochs = 1\nbatch_size = 4\nlearning_rate = 0.01\n"
    )
    return path


def train(path: Path, *words: str) -> int:
    out = str(path.parent / path.stem)
    return main(["train", "classification", str(path), "-o", out, "--device", "cpu", "-q", *words])


def weights(path: Path) -> dict[str, torch.Tensor]:
    return torch.load(path.parent / path.stem / "weights.pt", weights_only=True)["state_dict"]


def config(path: Path) -> ClassificationConfig:
    return read_training(path, ClassificationConfig())


def error_of(path: Path, capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """What refuses a training: one line, and nothing is written."""
    assert train(path, *words) == 2
    error = capsys.readouterr().err.strip()
    assert len(error.splitlines()) == 1, error
    return error


RECORDED = 'recordings = "rec", validation_split = "val"'


def test_images_have_the_size_that_is_asked_for_whatever_the_sensor(tmp_path):
    write_recordings(tmp_path / "rec")
    events = bar(0, 1)
    large = EventStream.from_columns(
        4 * events.x.astype(int), 4 * events.y.astype(int), events.t, events.p, size=(64, 48)
    )
    large.save(tmp_path / "rec" / "val" / "bus" / "large.npz")
    path = write(tmp_path / "scaled.toml", f'{RECORDED}, image_size = "8x6"')
    task = ClassificationTask(config(path))
    batch = next(task._batches(task._validation, task._config.augmentation, 0, shuffle=False)
                 .epoch(0))  # fmt: skip
    assert batch["image"].shape == (4, 2, 6, 8)
    assert train(path) == 0


def test_a_sample_without_events_is_an_image_of_zeros(tmp_path):
    write_recordings(tmp_path / "rec")
    for split in ("train", "val"):
        EventStream.empty(SIZE).save(tmp_path / "rec" / split / "car" / "empty.npz")
    path = write(
        tmp_path / "empty.toml",
        f"{RECORDED}, slice_events = 10",
        'network = {representation = "timestamp-image"}\naugmentation = {flip_time = true}',
    )
    assert train(path) == 0


def test_sizes_within_a_data_set_are_all_checked(tmp_path, capsys):
    write_bars(tmp_path / "made")
    odd = {"odd0": bar(0, 1), "odd1": EventStream([1], [1], [1], [1], SensorSize(8, 6))}
    record = write_shard(tmp_path / "made", "paper", "train", 1, odd, labels=("bus", "car"))
    facts = json.loads(record.with_suffix(".json").read_text())
    facts["samples"][-1] |= {"width": 8, "height": 6}
    record.with_suffix(".json").write_text(json.dumps(facts))
    path = write(tmp_path / "spec.toml", 'folder = "made"')
    assert "odd1 has 8x6, others 16x12" in error_of(path, capsys)


def test_a_damaged_file_is_named_in_one_line(tmp_path, capsys):
    write_recordings(tmp_path / "rec")
    path = write(tmp_path / "spec.toml", RECORDED)
    (tmp_path / "rec" / "train" / "car" / "2.npz").write_bytes(b"PK\x03\x04damaged")
    assert "rec/train/car/2.npz" in error_of(path, capsys, "--workers", "1")


@pytest.mark.parametrize(
    ("data", "message"),
    [
        ("", "there are no samples to train on; give folder or recordings in"),
        (f'{RECORDED}, folder = "made"', "folder and recordings are given; give one of"),
        ('recordings = "rec", validation_split = "none"', "holds no event files in folders of"),
        ('recordings = "rec", validation_split = "one"', "has 1 classes, and a network tells at"),
        (f'{RECORDED}, variant = "esim"', "variant belongs to folder, not to recordings"),
        ('folder = "made", flip_polarity = true', "flip_polarity belong to recordings, not to f"),
        (f"{RECORDED}}}\nextra = {{per_class = 3", "[extra] has no samples; give folder or"),
        (
            'recordings = "rec", validation_split = "few", classes = 2',
            "holds no sample of ['ape', ",
        ),
        (f"{RECORDED}, per_class = 0", "per_class is 0; it must be at least 1"),
        (f'{RECORDED}, image_size = "0x4"', "0x4"),
    ],
)
def test_samples_that_do_not_fit_are_refused_in_one_line(tmp_path, capsys, data, message):
    write_recordings(tmp_path / "rec")
    (tmp_path / "rec" / "none").mkdir()
    (tmp_path / "rec" / "one" / "bus").mkdir(parents=True)
    bar(0, 1).save(tmp_path / "rec" / "one" / "bus" / "a.npz")
    for name in ("ape", "bee", "bus"):
        (tmp_path / "rec" / "few" / name).mkdir(parents=True)
    bar(0, 1).save(tmp_path / "rec" / "few" / "bus" / "a.npz")
    write_bars(tmp_path / "made")
    assert message in error_of(write(tmp_path / "spec.toml", data), capsys)
    assert not (tmp_path / "spec").exists()


def test_training_begins_with_given_weights_and_a_new_last_layer_for_other_classes(tmp_path):
    write_recordings(tmp_path / "rec")
    first = write(tmp_path / "first.toml", RECORDED)
    assert train(first) == 0
    again = write(tmp_path / "again.toml", RECORDED, 'start_from = "first/weights.pt"')
    network = ClassificationTask(config(again)).make_network()
    assert all(torch.equal(network.tensors[name], one) for name, one in weights(first).items())
    for split in ("train", "val"):
        (tmp_path / "rec" / split / "dog").mkdir()
        bar(0, 5).save(tmp_path / "rec" / split / "dog" / "a.npz")
    network = ClassificationTask(config(again)).make_network()
    assert torch.equal(network.tensors["conv1.weight"], weights(first)["conv1.weight"])
    assert network.tensors["linear.weight"].shape == (3, 64)
    assert train(again) == 0
