"""V2CE's network: files in the published layout, and numbers against the NumPy reference."""

import math

import numpy as np
import pytest
from tests.frame_pairs import advance_through

from texvent.errors import FileFormatError
from texvent.events import EventStream
from texvent.simulate.v2ce.simulator import V2ceConfig, V2ceSimulator, load_network

from ..pixel_frames import moving_texture
from . import v2ce_numpy
from .v2ce_files import random_tensors

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")


def save(tensors, path):
    torch.save({name: torch.from_numpy(np.asarray(one)) for name, one in tensors.items()}, path)
    return path


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    return save(random_tensors(), tmp_path_factory.mktemp("weights") / "v2ce_3d.pt")


@pytest.fixture(scope="module")
def network(weights):
    return load_network(weights)


def some_pairs(count, height, width, seed=1):
    random = np.random.default_rng(seed)
    return random.normal(0, 1, (count, 2, height, width)).astype(np.float32)


@pytest.mark.parametrize("shape", [(1, 16, 16), (3, 37, 22), (5, 9, 1), (2, 1, 1)])
def test_any_size_gives_the_numbers_of_the_reference(network, shape):
    pairs = some_pairs(*shape)
    found = network.predict(pairs)
    expected = v2ce_numpy.predict(pairs, random_tensors())
    assert found.shape == (shape[0], 2, 10, *shape[1:])
    assert found.dtype == np.float32
    # float32 through 20 layers against float64.
    assert np.abs(found - expected).max() < 1e-5 * max(1.0, expected.max())
    assert (expected > 0.01).mean() > 0.05


def test_a_pair_is_answered_by_those_around_it(network):
    pairs = some_pairs(5, 16, 16)
    changed = pairs.copy()
    changed[4] += 1.0
    before, after = network.predict(pairs), network.predict(changed)
    assert np.abs(before[2] - after[2]).max() > 1e-4


def test_spectral_layers_are_divided_by_their_largest_singular_value(tmp_path):
    tensors = random_tensors()
    name = "UNet.resblocks.0.conv1.module.weight"
    bar = tensors[f"{name}_bar"]
    left, size, _ = np.linalg.svd(bar.reshape(len(bar), -1), full_matrices=False)
    tensors[f"{name}_u"] = left[:, 0]
    unet = load_network(save(tensors, tmp_path / "w.pt"))._unet
    found = unet.UNet["resblocks"][0].conv1.weight.cpu().numpy()
    assert found == pytest.approx(bar / size[0], rel=1e-4, abs=1e-7)


def test_the_published_file_has_218_tensors_of_53_million_numbers():
    from texvent.simulate.v2ce.network import V2ceUnet

    with torch.device("meta"):
        shapes = {name: tuple(one.shape) for name, one in V2ceUnet().state_dict().items()}
    assert len(shapes) == 218
    assert sum(math.prod(shape) for shape in shapes.values()) == 52_916_466
    published = {
        "UNet.head.conv3d.weight": (32, 2, 3, 3, 3),
        "UNet.head.conv3d.bias": (32,),
        "UNet.encoders.3.conv2.weight": (512, 512, 3, 3, 3),
        "UNet.encoders.0.downsample.0.bias": (64,),
        "UNet.encoders.0.downsample.1.running_mean": (64,),
        "UNet.encoders.0.bn1.num_batches_tracked": (),
        "UNet.resblocks.1.conv1.module.weight_u": (512,),
        # Channels and picture stay, yet the original has a convolution around this block too.
        "UNet.resblocks.0.downsample.0.weight": (512, 512, 1, 1, 1),
        "UNet.decoders.0.conv1.module.weight_bar": (256, 768, 3, 3, 3),
        "UNet.decoders.0.conv1.module.weight_v": (20_736,),
        "UNet.decoders.3.downsample.0.weight": (32, 96, 1, 1, 1),
        "UNet.pred.conv3d.weight": (20, 32, 1, 1, 1),
    }
    assert published.items() <= shapes.items()


@pytest.mark.parametrize("prefix", ["module.", "model.", "model.module."])
def test_prefixes_of_training_programs_are_stripped(network, tmp_path, prefix):
    state = {prefix + name: torch.from_numpy(one) for name, one in random_tensors().items()}
    state["discriminator.weight"] = torch.zeros(3)
    path = tmp_path / "last.ckpt"
    torch.save({"epoch": 3, "state_dict": state}, path)
    pairs = some_pairs(2, 16, 16)
    assert np.array_equal(load_network(path).predict(pairs), network.predict(pairs))


def test_counters_of_training_may_be_missing(network, tmp_path):
    tensors = {k: v for k, v in random_tensors().items() if not k.endswith("tracked")}
    other = load_network(save(tensors, tmp_path / "w.pt"))
    pairs = some_pairs(2, 16, 16)
    assert np.array_equal(other.predict(pairs), network.predict(pairs))


def without(tensors, name):
    return {key: one for key, one in tensors.items() if key != name}


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            lambda t: without(t, "UNet.encoders.2.bn1.bias"),
            r'Missing key.*"UNet\.encoders\.2\.bn1\.bias"',
        ),
        (lambda t: without(t, "UNet.head.conv3d.weight"), "other weights than V2CE's"),
        (lambda t: {**t, "UNet.extra": np.zeros(2)}, r'Unexpected key.*"UNet\.extra"'),
        (
            lambda t: {**t, "UNet.pred.conv3d.bias": np.zeros(10, np.float32)},
            r"size mismatch for UNet\.pred\.conv3d\.bias",
        ),
        (
            lambda t: {**t, "UNet.head.conv3d.bias": np.full(2, np.nan, np.float32)},
            r"UNet\.head\.conv3d\.bias holds values that are NaN",
        ),
    ],
    ids=["missing", "another network", "unknown", "wrong shape", "NaN"],
)
def test_a_file_of_another_layout_fails_by_name(tmp_path, change, message):
    path = save(change(random_tensors()), tmp_path / "odd.pt")
    with pytest.raises(FileFormatError, match=message) as caught:
        load_network(path)
    assert "odd.pt" in str(caught.value)


def test_a_file_that_would_run_code_is_refused(tmp_path):
    path = tmp_path / "object.pt"
    torch.save({"UNet.head.conv3d.weight": V2ceConfig()}, path)
    with pytest.raises(FileFormatError, match=r"object of class .*V2ceConfig, whose code would"):
        load_network(path)


def test_weights_that_blow_up_fail_by_name(tmp_path):
    tensors = random_tensors()
    for name in tensors:
        if name.endswith("conv1.weight"):
            tensors[name] = tensors[name] * np.float32(1e20)
    network = load_network(save(tensors, tmp_path / "huge.pt"))
    with pytest.raises(FileFormatError, match=r"huge\.pt.*NaN or infinite"):
        network.predict(some_pairs(1, 16, 16))


def test_frames_become_events(weights):
    frames = moving_texture(7, (20, 24))
    simulator = V2ceSimulator(V2ceConfig(weights=weights, sequence_length=4))
    events = EventStream.concat([packet for _, packet in advance_through(simulator, frames)])
    assert len(events) > 100
    assert set(events.p.tolist()) == {0, 1}
    assert events.t.min() >= frames[0].t_us
    assert events.t.max() < frames[-1].t_us
    simulator.reset()
    again = EventStream.concat([packet for _, packet in advance_through(simulator, frames)])
    assert again.equals(events)
