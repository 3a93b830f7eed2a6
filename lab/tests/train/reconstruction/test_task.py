"""Training of reconstruction networks: examples, learning, published files."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.metrics.lpips.lpips_files import narrow_weights

from texvent.cli.app import main
from texvent.metrics.lpips import ALEX, FILE_NAME, write_lpips_weights
from texvent.represent.voxel_grid import voxel_e2vid
from texvent_lab.registries import RECONSTRUCTORS

from ..windowed_specification import TEXT, write_specification

torch = pytest.importorskip("torch", reason="make test-torch runs the tests that need torch")

from texvent_lab.reconstruct.reconstructor import load_reconstructor  # noqa: E402
from texvent_lab.train.reconstruction.config import (  # noqa: E402
    ReconstructionConfig,
)
from texvent_lab.train.reconstruction.task import ReconstructionTask, new_network  # noqa: E402
from texvent_lab.train.run import (  # noqa: E402
    read_training,
    train_from_file,
)
from texvent_lab.train.schedule import Hardware  # noqa: E402

pytestmark = pytest.mark.torch
CPU = Hardware(device="cpu")
TRAINING = """\
network = {name = "firenet"}
loss = {lpips = 0.0, l1 = 1.0, ssim = 1.0}
[data]
specification = "tiny.toml"
variant = "esim"
slice_us = 20000
length = 4
crop = 16
cache = "cache"
[schedule]
epochs = 2
batch_size = 1
learning_rate = 0.005
"""


@pytest.fixture(autouse=True)
def no_weights_of_this_machine(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path / "texvent-cache"))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A training file, its specification, and clips that are simulated once for all tests."""
    folder = tmp_path_factory.mktemp("training")
    write_specification(folder)
    write(folder, TRAINING)
    return folder


def write(folder: Path, text: str, name: str = "training.toml") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def config_of(folder: Path, **changes: Any) -> ReconstructionConfig:
    return replace(read_training(folder / "training.toml", ReconstructionConfig()), **changes)


def weights(folder: Path) -> dict[str, torch.Tensor]:
    return torch.load(folder / "weights.pt", weights_only=True)["state_dict"]


def test_mixed_precision_trains_weights_of_full_precision(folder, tmp_path):
    mixed = replace(CPU, precision="bfloat16")
    state = train_from_file(ReconstructionConfig, folder / "training.toml", tmp_path / "run", mixed)
    assert np.isfinite(state.rows[-1]["training loss"])
    assert {one.dtype for one in weights(tmp_path / "run").values()} == {torch.float32}


@pytest.mark.parametrize("name", ["firenet", "firenet+", "e2vid", "e2vid+", "hypere2vid", "et-net"])
def test_a_published_file_is_read_as_that_network_and_gives_its_images(folder, tmp_path, name):
    config = config_of(folder)
    task = ReconstructionTask(replace(config, network=replace(config.network, name=name)))
    network = task.make_network().eval()
    torch.save(task.published(network), tmp_path / "weights.pt")
    reconstructor = load_reconstructor(name, tmp_path / "weights.pt", device="cpu")
    published = RECONSTRUCTORS.load(name)
    windows = task._validation.read(0)
    grids = np.stack([voxel_e2vid(e, normalise=published.is_normalised) for e in windows.events])
    with torch.inference_mode():
        images = network(torch.from_numpy(grids)[None])[0, :, 0].numpy()
    found = [reconstructor.reconstruct(events) for events in windows.events]
    if not published.is_stretched:
        np.testing.assert_allclose(found, np.clip(images, 0, 1), rtol=0, atol=1e-5)
    again = task.make_network()
    with torch.no_grad():
        for tensor in again.tensors.values():
            tensor.zero_()
    content = torch.load(tmp_path / "weights.pt", weights_only=True)
    task.read(again, content, tmp_path / "weights.pt")
    assert all(torch.equal(one, again.tensors[key]) for key, one in network.tensors.items())


def test_lpips_is_trained_with_where_its_weights_are(folder, tmp_path, capsys):
    pulled = tmp_path / "texvent-cache" / "weights"
    pulled.mkdir(parents=True)
    write_specification(folder, TEXT.replace("32x24", "40x32"))
    text = TRAINING.replace("lpips = 0.0", "lpips = 1.0").replace("crop = 16", "crop = 32")
    text = text.replace("epochs = 2", "epochs = 1")
    path = write(folder, text, "lpips.toml")
    words = ["train", "reconstruction", str(path), "-o", str(tmp_path / "run"), "-q"]
    assert main(words) == 2
    assert "LPIPS's weights are not here" in capsys.readouterr().err
    write_lpips_weights(narrow_weights(layers=ALEX), pulled / FILE_NAME)
    try:
        state = train_from_file(ReconstructionConfig, path, tmp_path / "run", CPU)
    finally:
        write_specification(folder)
    assert {"ssim", "mse", "lpips"} <= state.rows[0].keys()


def voxels(count: int = 2) -> torch.Tensor:
    return torch.randn(2, count, 5, 16, 16, generator=torch.Generator().manual_seed(0))


@pytest.mark.parametrize("name", ["firenet", "e2vid+", "hypere2vid"])
def test_the_state_is_carried_from_window_to_window(name):
    published = RECONSTRUCTORS.load(name)
    network, grids = new_network(published, 0).eval(), voxels(3)
    with torch.no_grad():
        images = network(grids)
        one_by_one = published.network.from_tensors(network.tensors, {})
        expected = [one_by_one.step(grids[:, place]) for place in range(3)]
        torch.testing.assert_close(images, torch.stack(expected, dim=1))
        assert not torch.equal(network(grids[:, 1:])[:, 0], images[:, 1])


def test_gradients_reach_all_parameters_through_time():
    network, grids = new_network(RECONSTRUCTORS.load("e2vid+"), 0), voxels(3).requires_grad_()
    network(grids)[:, -1].sum().backward()
    assert grids.grad[:, 0].any()
    assert all(one.grad.any() for one in network.parameters())
