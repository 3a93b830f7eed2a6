"""From events to images: any size, what belongs to each network, memory and its end."""

import numpy as np
import pytest
from tests.represent.definitions import random_events

from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.represent.voxel_grid import voxel_e2vid
from texvent.sensor import SensorSize
from texvent_lab.reconstruct.reconstructor import Reconstructor, find_network, load_reconstructor
from texvent_lab.registries import RECONSTRUCTORS

from .network_files import HEADS, random_state, save_published

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
from texvent_lab.reconstruct.e2depth import depth_in_metres  # noqa: E402

SIZE = SensorSize(21, 13)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("networks")
    for name in HEADS:
        save_published(torch, name, folder / f"{name}.pth")
    return folder


def load(folder, name):
    return load_reconstructor(name, folder / f"{name}.pth", device="cpu")


def noise(seed=0, size=SIZE):
    return random_events(seed, 400, size, 10_000)


@pytest.mark.parametrize("name", HEADS)
def test_a_network_gets_its_voxel_grid_and_gives_an_image_of_any_size(folder, name, monkeypatch):
    seen = []
    reconstructor = load(folder, name)
    step = reconstructor._network.step
    monkeypatch.setattr(
        reconstructor._network, "step", lambda voxel: seen.append(voxel) or step(voxel)
    )
    image = reconstructor.reconstruct(noise())
    assert image.shape == SIZE.shape
    assert image.dtype == np.float32
    assert 0.0 <= image.min() < image.max() <= 1.0
    is_normalised = name in ("e2vid", "firenet", "e2depth")
    expected = voxel_e2vid(noise(), bins=5, normalise=is_normalised)
    grid = seen[0][0].numpy()
    if "firenet" in name:
        np.testing.assert_array_equal(grid, expected)
        return
    # 13 rows become 16: 2 above and 1 below; 21 columns become 24 likewise.
    assert grid.shape == (5, 16, 24)
    how = "reflect" if name == "e2depth" else "constant"
    np.testing.assert_array_equal(grid, np.pad(expected, ((0, 0), (2, 1), (2, 1)), mode=how))


@pytest.mark.parametrize("name", RECONSTRUCTORS.names())
@pytest.mark.parametrize("size", [(1, 1), (16, 12), (3, 70)], ids=str)
def test_no_sensor_is_too_small_for_a_network(name, size):
    published = RECONSTRUCTORS.load(name)
    reconstructor = Reconstructor(published, published.network.like({}, {}))
    for seed in range(2):
        image = reconstructor.reconstruct(noise(seed, SensorSize(*size)))
        assert image.shape == SensorSize(*size).shape


def test_only_e2vid_stretches_its_images(folder):
    assert [name for name in HEADS if RECONSTRUCTORS.load(name).is_stretched] == ["e2vid"]
    image = load(folder, "e2vid").reconstruct(noise())
    assert (image == 0).mean() == pytest.approx(0.01, abs=0.01)
    assert (image == 1).mean() == pytest.approx(0.01, abs=0.01)


@pytest.mark.parametrize("name", ["e2vid+", "hypere2vid", "et-net"])
def test_a_twin_shares_weights_but_no_memory(folder, name):
    reconstructor = load(folder, name)
    first = reconstructor.reconstruct(noise())
    twin = reconstructor.twin()
    np.testing.assert_array_equal(twin.reconstruct(noise()), first)
    second = reconstructor.reconstruct(noise(seed=1))
    np.testing.assert_array_equal(twin.reconstruct(noise(seed=1)), second)
    assert twin._network.tensors[HEADS[name]] is reconstructor._network.tensors[HEADS[name]]


def test_events_of_another_sensor_are_refused_until_the_reset(folder):
    reconstructor = load(folder, "firenet")
    reconstructor.reconstruct(noise())
    other = noise(size=SensorSize(8, 8))
    with pytest.raises(InputError, match="8x8 sensor, those before of a 21x13 one"):
        reconstructor.reconstruct(other)
    reconstructor.reset()
    assert reconstructor.reconstruct(other).shape == (8, 8)


def test_depth_has_colours_and_is_not_compared_with_frames(folder):
    reconstructor = load(folder, "e2depth")
    output = reconstructor.reconstruct(noise())
    assert 1.97 < depth_in_metres(output).min() < depth_in_metres(output).max() < 80
    colours = reconstructor.picture(output)
    assert colours.shape == (*SIZE.shape, 3)
    near, far = (colours.reshape(-1, 3)[one] for one in (output.argmin(), output.argmax()))
    assert near.tolist() == pytest.approx([0.987, 0.991, 0.749], abs=0.01)  # both ends of magma
    assert far.tolist() == pytest.approx([0.001, 0.0, 0.014], abs=0.01)
    flat = reconstructor.picture(np.full(SIZE.shape, 0.5, np.float32))
    assert (flat == flat[0, 0]).all()
    with pytest.raises(ConfigError, match="e2depth, which gives depth; frames are compared"):
        find_network("e2depth")
    image = load(folder, "e2vid+").reconstruct(noise())
    assert load(folder, "e2vid+").picture(image) is image


def test_output_that_is_not_finite_is_refused(tmp_path):
    state = random_state(torch, "firenet")
    state["net.pred.conv2d.bias"].fill_(torch.finfo(torch.float32).max)
    state["net.pred.conv2d.weight"].fill_(torch.finfo(torch.float32).max)
    torch.save({"state_dict": state}, tmp_path / "huge.pth")
    reconstructor = load_reconstructor("firenet", tmp_path / "huge.pth", device="cpu")
    with pytest.raises(FileFormatError, match="NaN or infinite"):
        reconstructor.reconstruct(noise())


@pytest.mark.parametrize("name", HEADS)
def test_without_weights_the_message_says_where_they_come_from_and_go(name, tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    with pytest.raises(InputError) as told:
        load_reconstructor(name)
    message = str(told.value)
    assert f"{name} needs its weights" in message
    assert ("uzh-rpg/rpg_e2depth" if name == "e2depth" else "ercanburak/EVREAL") in message
    assert "`weights`" in message
    assert str(tmp_path / "weights" / f"{name}.pth") in message
    assert "\n" not in message
