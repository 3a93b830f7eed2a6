"""From events to images: any size, what belongs to each network, memory and its end."""

import numpy as np
import pytest

from texvent.errors import FileFormatError, InputError
from texvent.events import EventStream
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.sensor import SensorSize
from texvent_lab.reconstruct.reconstructor import load_reconstructor
from texvent_lab.registries import RECONSTRUCTORS

from .network_files import HEADS, random_tensors, save_published, small_shapes

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

SIZE = SensorSize(21, 13)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("networks")
    for name in HEADS:
        save_published(torch, name, folder / f"{name}.pth")
    return folder


def load(folder, name):
    return load_reconstructor(name, folder / f"{name}.pth", device="cpu")


def noise(count=400, seed=0, size=SIZE, start_us=0):
    random = np.random.default_rng(seed)
    return EventStream.from_columns(
        random.integers(0, size.width, count),
        random.integers(0, size.height, count),
        start_us + np.sort(random.integers(0, 10_000, count)),
        random.integers(0, 2, count),
        size=size,
    )


@pytest.mark.parametrize("name", HEADS)
def test_images_have_the_size_of_the_sensor_whatever_it_is(folder, name):
    image = load(folder, name).reconstruct(noise())
    assert image.shape == SIZE.shape
    assert image.dtype == np.float32
    assert 0.0 <= image.min() < image.max() <= 1.0


@pytest.mark.parametrize("name", HEADS)
def test_the_network_gets_the_voxel_grid_that_belongs_to_it(folder, name, monkeypatch):
    seen = []
    reconstructor = load(folder, name)
    step = reconstructor._network.step
    monkeypatch.setattr(
        reconstructor._network, "step", lambda voxel: seen.append(voxel) or step(voxel)
    )
    reconstructor.reconstruct(noise())
    is_normalised = name in ("e2vid", "firenet")
    expected = voxel_e2vid(noise(), bins=5, normalise=is_normalised)
    grid = seen[0][0].numpy()
    if "firenet" in name:
        np.testing.assert_array_equal(grid, expected)
        return
    # 13 rows become 16: 2 above and 1 below; 21 columns become 24 likewise.
    assert grid.shape == (5, 16, 24)
    np.testing.assert_array_equal(grid[:, 2:15, 2:23], expected)
    assert np.count_nonzero(grid) == np.count_nonzero(expected)


def test_only_e2vid_stretches_its_images(folder):
    assert [name for name in HEADS if RECONSTRUCTORS.load(name).is_stretched] == ["e2vid"]
    image = load(folder, "e2vid").reconstruct(noise())
    assert (image == 0).mean() == pytest.approx(0.01, abs=0.01)
    assert (image == 1).mean() == pytest.approx(0.01, abs=0.01)


def test_a_reset_network_begins_anew(folder):
    reconstructor = load(folder, "e2vid+")
    first = reconstructor.reconstruct(noise())
    again = reconstructor.reconstruct(noise())
    assert not np.array_equal(first, again)
    reconstructor.reset()
    np.testing.assert_array_equal(reconstructor.reconstruct(noise()), first)


def test_a_twin_shares_weights_but_no_memory(folder):
    reconstructor = load(folder, "hypere2vid")
    first = reconstructor.reconstruct(noise())
    twin = reconstructor.twin()
    np.testing.assert_array_equal(twin.reconstruct(noise()), first)
    second = reconstructor.reconstruct(noise(seed=1))
    np.testing.assert_array_equal(twin.reconstruct(noise(seed=1)), second)
    name = HEADS["hypere2vid"]
    assert twin._network.tensors[name] is reconstructor._network.tensors[name]


def test_events_of_another_sensor_are_refused_until_the_reset(folder):
    reconstructor = load(folder, "firenet")
    reconstructor.reconstruct(noise())
    other = noise(size=SensorSize(8, 8))
    with pytest.raises(InputError, match="8x8 sensor, those before of a 21x13 one"):
        reconstructor.reconstruct(other)
    reconstructor.reset()
    assert reconstructor.reconstruct(other).shape == (8, 8)


def test_output_that_is_not_finite_is_refused(tmp_path):
    arrays = random_tensors(small_shapes("firenet"))
    arrays["net.pred.conv2d.bias"][:] = np.finfo(np.float32).max
    arrays["net.pred.conv2d.weight"][:] = np.finfo(np.float32).max
    state = {name: torch.from_numpy(array) for name, array in arrays.items()}
    torch.save({"state_dict": state}, tmp_path / "huge.pth")
    reconstructor = load_reconstructor("firenet", tmp_path / "huge.pth", device="cpu")
    with pytest.raises(FileFormatError, match="NaN or infinite"):
        reconstructor.reconstruct(noise())
