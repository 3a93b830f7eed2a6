"""N-ImageNet's protocol: slices, labels, accuracy; and its ResNet on tiny random weights."""

import numpy as np
import pytest

from texvent.cli.app import main
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.sensor import SensorSize
from texvent_lab.bench.classification import (
    Sample,
    classify,
    list_samples,
    read_resnet,
    take_slice,
)

from .torch_resnet import torch_resnet

SIZE = SensorSize(64, 48)
WIDTH, BLOCKS, CLASSES = 4, (1, 2, 1, 1), 3


def stream(x, *, events=50, on=1):
    t = np.arange(events)
    return EventStream(np.full(events, x), t % SIZE.height, t, np.full(events, on, np.uint8), SIZE)


@pytest.fixture
def folder(tmp_path):
    for number, name in enumerate(("n01", "n02", "n03")):
        (tmp_path / "set" / name).mkdir(parents=True)
        for copy in range(2):
            stream(10 * number).save(tmp_path / "set" / name / f"{copy}.npz", format="n-imagenet")
    return tmp_path / "set"


def by_column(images):
    """Scores of a made-up network: class k where events stand in the k-th column of its own."""
    columns = [round(10 * number * 224 / 64) for number in range(CLASSES)]
    return images[:, 0][:, :, columns].sum(axis=1)


def test_labels_follow_the_order_of_the_sub_folders_or_of_a_file(folder, tmp_path):
    samples = list_samples(folder, CLASSES)
    assert [sample.label for sample in samples] == [0, 0, 1, 1, 2, 2]
    (tmp_path / "classes.txt").write_text("n03 fish\nn00\nn02\nn01\n\n")
    samples = list_samples(folder, 4, classes=tmp_path / "classes.txt")
    assert [sample.label for sample in samples] == [3, 3, 2, 2, 0, 0]


def test_accuracy_counts_the_likeliest_and_the_five_likeliest_classes(folder):
    samples = list_samples(folder, CLASSES)
    assert classify(samples, by_column).top1 == 1.0
    wrong = [Sample(one.path, (one.label + 1) % 3) for one in samples[:2]] + samples[2:]
    found = classify(wrong, by_column)
    assert (found.count, found.top1, found.top5) == (6, pytest.approx(4 / 6), 1.0)
    assert found.standard_errors[0] == pytest.approx(np.sqrt(4 / 6 * 2 / 6 / 6))


def test_a_file_without_a_size_is_n_imagenets_sensor(tmp_path):
    (tmp_path / "set" / "n01").mkdir(parents=True)
    event = np.zeros(3, [("x", "<u2"), ("y", "<u2"), ("t", "<i8"), ("p", "?")])
    event["x"] = 639
    np.savez(tmp_path / "set" / "n01" / "a.npz", event_data=event)

    def last_column(images):
        assert images[0, 1, 0, 223] == 1  # OFF, at the right edge of 224
        return np.ones((1, 1), np.float32)

    assert classify(list_samples(tmp_path / "set", 1), last_column).top1 == 1.0


def test_a_slice_is_a_run_of_30000_events_drawn_per_file():
    events = stream(5, events=40_000)
    first, again, other = (take_slice(events, 3, index) for index in (0, 0, 1))
    assert len(first) == 30_000
    assert np.array_equal(first.t, np.arange(first.t[0], first.t[0] + 30_000))
    assert first.t[0] == again.t[0] != other.t[0]
    assert len(take_slice(stream(5), 3, 0)) == 50


def test_folders_that_do_not_fit_are_refused(folder, tmp_path):
    with pytest.raises(InputError, match="has 3 classes, the network tells 100 apart"):
        list_samples(folder, 100)
    (tmp_path / "classes.txt").write_text("n01\nn02\n")
    with pytest.raises(InputError, match="'n03'"):
        list_samples(folder, 2, classes=tmp_path / "classes.txt")
    with pytest.raises(InputError, match="no folder"):
        list_samples(tmp_path / "none", 3)
    (tmp_path / "empty" / "n01").mkdir(parents=True)
    with pytest.raises(InputError, match="no event file"):
        list_samples(tmp_path / "empty", 1)
    with pytest.raises(ConfigError, match="nothing to classify"):
        classify([], by_column)


@pytest.mark.torch
def test_resnet34_has_the_published_number_of_parameters(torch):
    from texvent_lab.networks.resnet34 import ResNet

    trained = sum(one.numel() for one in ResNet(2, 1000).parameters())
    # torchvision's 21,797,672 with a first kernel of 14 on two channels instead of 7 on three.
    assert trained == 21_797_672 - 64 * 3 * 7 * 7 + 64 * 2 * 14 * 14


@pytest.fixture(scope="module")
def torch():
    return pytest.importorskip("torch")


@pytest.fixture
def checkpoint(torch, tmp_path):
    """Random weights as N-ImageNet's program saves them."""
    from texvent_lab.networks.resnet34 import ResNet

    tensors = ResNet(2, CLASSES, width=WIDTH, blocks=BLOCKS).tensors
    generator = torch.Generator().manual_seed(4)
    state = {
        name: torch.rand(one.shape, generator=generator) + (0.5 if "running_var" in name else -0.5)
        for name, one in tensors.items()
    }
    state["bn1.num_batches_tracked"] = torch.tensor(7)
    torch.save({"epoch": 3, "state_dict": state}, tmp_path / "checkpoint.tar")
    return tmp_path / "checkpoint.tar"


@pytest.mark.torch
def test_the_network_agrees_with_layers_of_torch_put_together_by_hand(torch, checkpoint):
    classifier = read_resnet(checkpoint)
    assert classifier.class_count == CLASSES
    images = (np.random.default_rng(1).random((2, 2, 70, 64)) < 0.2).astype(np.float32)
    with torch.no_grad():
        expected = torch_resnet(classifier.network.tensors, BLOCKS).eval()(torch.from_numpy(images))
    scores = classifier(images)
    np.testing.assert_allclose(scores, expected.numpy(), rtol=1e-5, atol=1e-4)
    assert np.ptp(scores) > 1e-3


@pytest.mark.torch
def test_the_command_states_both_accuracies(folder, checkpoint, tmp_path, capsys):
    words = ["bench", "classify", str(folder), "--weights", str(checkpoint), "-q"]
    assert main([*words, "-o", str(tmp_path / "result.json")]) == 0
    printed = capsys.readouterr().out
    assert printed.startswith("top-1 ")
    assert "top-5 1.0000" in printed  # of three classes the right one is always among five
    assert '"count": 6' in (tmp_path / "result.json").read_text()
