"""PIE-Net as its authors' package runs it."""

import numpy as np
import pytest
from tests.represent.definitions import random_events

from texvent.errors import FileFormatError
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.sensor import SensorSize
from texvent_lab.reconstruct.reconstructor import load_reconstructor

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pie_net = pytest.importorskip("pie_net")

SIZE = SensorSize(45, 38)


def slices():
    return [random_events(seed, 800, SIZE) for seed in range(3)]


def test_images_equal_those_of_the_package():
    theirs, expected = pie_net.load_model(device="cpu").eval(), []
    with torch.inference_mode():
        for events in slices():
            grid = torch.from_numpy(voxel_e2vid(events, bins=5))[None]
            expected.append(theirs(grid)["image"][0, 0].numpy())
    ours = load_reconstructor("pie-net", device="cpu")
    assert len(ours.sha256) == 64
    twin = ours.twin()
    for events, image in zip(slices(), expected, strict=True):
        np.testing.assert_allclose(ours.reconstruct(events), image, atol=1e-6)
    for events, image in zip(slices(), expected, strict=True):
        np.testing.assert_allclose(twin.reconstruct(events), image, atol=1e-6)
    assert not np.allclose(expected[0], ours.reconstruct(slices()[0]))
    ours.reset()
    np.testing.assert_allclose(ours.reconstruct(slices()[0]), expected[0], atol=1e-6)


def test_a_file_of_another_network_is_refused(tmp_path):
    torch.save({"state_dict": {"head.weight": torch.zeros(2)}}, tmp_path / "other.pth")
    with pytest.raises(FileFormatError, match="holds another network"):
        load_reconstructor("pie-net", tmp_path / "other.pth")
