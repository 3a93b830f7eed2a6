"""Networks: against torch's own layers, in training and after it; initial weights; read back."""

import math

import numpy as np
import pytest

from texvent.cli.app import main

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.networks.layers import make_seeded  # noqa: E402
from texvent_lab.networks.resnet34 import BLOCKS, ResNet  # noqa: E402

from ..written_samples import write_recordings  # noqa: E402
from .torch_resnet import torch_resnet  # noqa: E402

pytestmark = pytest.mark.torch


def resnet34(channels: int, classes: int, seed: int, width: int = 64) -> ResNet:
    return make_seeded(lambda: ResNet(channels, classes, width=width), seed)


def images(count: int = 4, side: int = 70) -> torch.Tensor:
    chance = np.random.default_rng(3)
    return torch.from_numpy((chance.random((count, 2, side, side + 6)) < 0.2).astype(np.float32))


@pytest.mark.parametrize("is_training", [True, False])
def test_resnet34_computes_what_torchs_layers_do(is_training):
    network = resnet34(2, 3, seed=1, width=4).train(is_training)
    layers = torch_resnet(network.tensors, BLOCKS).train(is_training)
    for _ in range(2):  # the second time with the statistics that the first has noted
        with torch.no_grad():
            found, expected = network(images()), layers(images())
        torch.testing.assert_close(found, expected, rtol=1e-4, atol=1e-5)
    noted = dict(layers.named_buffers())
    for name, tensor in network.tensors.items():
        if name.endswith(("running_mean", "running_var")):
            torch.testing.assert_close(tensor, noted[name], rtol=1e-4, atol=1e-6)


def test_kernels_begin_as_torchvisions_and_the_replaced_layers_as_torchs():
    found = resnet34(2, 10, seed=5).tensors
    tensors = {name: one.detach() for name, one in found.items()}
    for name in ("layer1.0.conv1.weight", "layer3.0.downsample.0.weight", "layer4.2.conv2.weight"):
        kernel = tensors[name]
        expected = math.sqrt(2 / (kernel.shape[0] * kernel.shape[2] * kernel.shape[3]))
        assert float(kernel.std()) == pytest.approx(expected, rel=0.02)
        assert float(kernel.mean()) == pytest.approx(0, abs=0.02 * expected)
        # Normal, not uniform: the fourth moment.
        assert float((kernel / expected).pow(4).mean()) == pytest.approx(3, rel=0.1)
    for name, inputs in (("conv1.weight", 2 * 14 * 14), ("fc.weight", 512)):
        assert float(tensors[name].abs().max()) == pytest.approx(1 / math.sqrt(inputs), rel=0.01)
    assert set(tensors["layer2.1.bn1.weight"].tolist()) == {1.0}
    assert set(tensors["layer2.1.bn1.running_mean"].tolist()) == {0.0}


def test_resnet34_has_the_published_number_of_parameters():
    trained = sum(one.numel() for one in ResNet(2, 1000).parameters())
    # torchvision's 21,797,672 with a first kernel of 14 on two channels instead of 7 on three.
    assert trained == 21_797_672 - 64 * 3 * 7 * 7 + 64 * 2 * 14 * 14


def test_weights_of_another_representation_are_refused(tmp_path, capsys):
    write_recordings(tmp_path / "recorded")
    text = (
        'data = {recordings = "recorded", validation_split = "val", image_size = "64x48"}\n'
        'network = {name = "resnet34", width = 2, representation = "binary-event-image"}\n'
        "schedule = {epochs = 1, batch_size = 8}\n"
    )
    (tmp_path / "spec.toml").write_text(text)
    words = [str(tmp_path / "spec.toml"), "-o", str(tmp_path / "run"), "--device", "cpu", "-q"]
    assert main(["train", "classification", *words]) == 0
    (tmp_path / "other.toml").write_text(text.replace("binary-event-image", "histogram-2d"))
    weights = str(tmp_path / "run" / "weights.pt")
    assert main(["evaluate", "classification", str(tmp_path / "other.toml"), weights]) == 2
    assert "with representation 'binary-event-image', and [net" in capsys.readouterr().err


def test_a_checkpoint_of_n_imagenets_program_is_evaluated(tmp_path):
    write_recordings(tmp_path / "recorded")
    (tmp_path / "spec.toml").write_text(
        'data = {recordings = "recorded", validation_split = "val", image_size = "64x48"}\n'
        'network = {name = "resnet34", width = 2, representation = "binary-event-image"}\n'
    )
    # Several GPUs put "module." before every name; torch counts the batches of normalisations.
    state = {f"module.{name}": one for name, one in resnet34(2, 2, 1, width=2).tensors.items()}
    state["module.bn1.num_batches_tracked"] = torch.tensor(7)
    torch.save({"epoch": 3, "state_dict": state}, tmp_path / "published.tar")
    paths = [str(tmp_path / "spec.toml"), str(tmp_path / "published.tar")]
    assert main(["evaluate", "classification", *paths, "--device", "cpu"]) == 0
