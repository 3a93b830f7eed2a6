"""Super SloMo from a checkpoint in the published format, against a reference in NumPy."""

import datetime

import numpy as np
import pytest

from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError
from texvent.video import Frame

from ..rife.rife_numpy import warp

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

from texvent.interpolate.super_slomo.network import (  # noqa: E402  (torch first)
    CHANNELS,
    FLOW_NET,
    REFINE_NET,
    UNet,
    read_checkpoint,
)

WIDTH = 2
"""Instead of 32; every name and relation of shapes stays."""
MEAN = np.array([0.429, 0.431, 0.397])[:, None, None]
TIMES_US = [250, 500, 700]


def make_network(key, width=WIDTH):
    with torch.device("meta"):
        return UNet(*CHANNELS[key], width)


def random_tensors(key, seed):
    random = np.random.default_rng(seed)
    shapes = {name: tuple(one.shape) for name, one in make_network(key).state_dict().items()}
    return {
        name: random.normal(0, 1.2 / np.sqrt(max(1, np.prod(shape[1:]))), shape).astype(np.float32)
        for name, shape in shapes.items()
    }


def save(path, *, legacy=False, **changes):
    """A training checkpoint as published: networks beside dates, losses and counters."""
    content = {
        "Detail": "End to end Super SloMo.",
        "epoch": 199,
        "timestamp": datetime.datetime(2018, 12, 1, 3, 4, 5),
        "trainBatchSz": 6,
        "loss": [[0.5, 0.25]],
        "valPSNR": [[30.1]],
    }
    for seed, key in enumerate((FLOW_NET, REFINE_NET)):
        tensors = random_tensors(key, seed).items()
        content[key] = {name: torch.from_numpy(one) for name, one in tensors}
    content.update(changes)
    torch.save(content, path, _use_new_zipfile_serialization=not legacy)
    return path


def convolve(x, weight, bias):
    side = weight.shape[-1]
    padded = np.pad(x, ((0, 0), *[(side // 2, side // 2)] * 2))
    windows = np.lib.stride_tricks.sliding_window_view(padded, (side, side), axis=(1, 2))
    return np.einsum("chwyx,ocyx->ohw", windows, weight) + bias[:, None, None]


def double(x):
    """Bilinear from corner to corner."""
    for axis in (1, 2):
        length = x.shape[axis]
        at = np.linspace(0, length - 1, 2 * length)
        low = np.floor(at).astype(int)
        high = np.minimum(low + 1, length - 1)
        shape = [1, 1, 1]
        shape[axis] = -1
        share = (at - low).reshape(shape)
        x = np.take(x, low, axis) * (1 - share) + np.take(x, high, axis) * share
    return x


def unet(x, tensors):
    def layer(x, name):
        x = convolve(x, tensors[f"{name}.weight"].astype(float), tensors[f"{name}.bias"])
        return np.where(x > 0, x, 0.1 * x)

    x = layer(layer(x, "conv1"), "conv2")
    skipped = []
    for depth in range(1, 6):
        skipped.append(x)
        channels, height, width = x.shape
        x = x.reshape(channels, height // 2, 2, width // 2, 2).mean(axis=(2, 4))
        x = layer(layer(x, f"down{depth}.conv1"), f"down{depth}.conv2")
    for step in range(1, 6):
        x = layer(double(x), f"up{step}.conv1")
        x = layer(np.concatenate([x, skipped.pop()]), f"up{step}.conv2")
    return layer(x, "conv3")


def expected_frame(first, second, t):
    """The published steps in float64; images [3, H, W], 0..1; returns grey levels."""
    a, b = first - MEAN, second - MEAN
    flows = unet(np.concatenate([a, b]), random_tensors(FLOW_NET, 0))
    f01, f10 = flows[:2], flows[2:]
    ft0, ft1 = -t * (1 - t) * f01 + t * t * f10, (1 - t) ** 2 * f01 - t * (1 - t) * f10
    seen = [a, b, f01, f10, ft1, ft0, warp(b, ft1), warp(a, ft0)]
    out = unet(np.concatenate(seen), random_tensors(REFINE_NET, 1))
    visible = 1 / (1 + np.exp(-out[4]))
    w0, w1 = (1 - t) * visible, t * (1 - visible)
    mixed = w0 * warp(first[:1], ft0 + out[:2])[0] + w1 * warp(second[:1], ft1 + out[2:4])[0]
    return 255 * mixed / (w0 + w1), np.abs(flows).mean()


def test_the_networks_have_the_published_sizes():
    sizes, states = [], []
    for key in (FLOW_NET, REFINE_NET):
        states.append(make_network(key, 32).state_dict())
        sizes.append(sum(one.numel() for one in states[-1].values()))
    assert sizes == [19_794_116, 19_816_357]
    assert tuple(states[0]["down5.conv2.weight"].shape) == (512, 512, 3, 3)
    assert tuple(states[1]["up3.conv2.weight"].shape) == (128, 256, 3, 3)


@pytest.fixture
def build(tmp_path, stream):
    def make(**options):
        path = save(tmp_path / "SuperSloMo.ckpt")
        config = InterpolateConfig(interpolator_weights=path, **options)
        return INTERPOLATORS.load("super-slomo")(config, stream)

    return make


def test_a_network_gives_the_numbers_of_the_reference():
    tensors = random_tensors(REFINE_NET, 1)
    x = np.random.default_rng(0).normal(0, 1, (20, 32, 64))
    network = UNet(*CHANNELS[REFINE_NET], WIDTH)
    network.load_state_dict({name: torch.from_numpy(one) for name, one in tensors.items()})
    with torch.no_grad():
        found = network(torch.from_numpy(x.astype(np.float32))[None])[0].numpy()
    expected = unet(x, tensors)
    assert np.abs(found - expected).max() < 1e-4
    assert np.std(expected) > 0.05


def test_frames_follow_the_published_steps(build):
    images = np.random.default_rng(3).integers(0, 256, (2, 32, 64)).astype(np.uint8)
    found = list(build().between(Frame(images[0], 0), Frame(images[1], 1000), TIMES_US))
    levels = [np.repeat(one[None] / 255.0, 3, axis=0) for one in images]
    for frame, t_us in zip(found, TIMES_US, strict=True):
        expected, motion = expected_frame(*levels, t_us / 1000)
        assert motion > 0.01
        assert frame.t_us == t_us
        assert not frame.is_source
        assert frame.pixels.dtype == np.float32
        assert np.abs(frame.pixels - expected).max() < 0.05


@pytest.mark.parametrize("legacy", [False, True])
def test_a_checkpoint_with_dates_and_losses_is_read(tmp_path, legacy):
    path = save(tmp_path / "SuperSloMo.ckpt", legacy=legacy)
    networks = zip(read_checkpoint(path), (FLOW_NET, REFINE_NET), strict=True)
    for seed, (network, key) in enumerate(networks):
        for name, array in random_tensors(key, seed).items():
            assert np.array_equal(network.state_dict()[name].numpy(), array)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        ({"state_dictAT": None}, "holds no state_dictAT"),
        ({"state_dictFC": {}}, r"Missing key.*conv1\.weight.*state_dictFC"),
        (
            {"state_dictAT": "swapped"},
            r"size mismatch for conv1\.weight.*state_dictAT",
        ),
    ],
)
def test_a_wrong_checkpoint_is_refused_by_name(tmp_path, change, complaint):
    if "swapped" in change.values():
        flow = random_tensors(FLOW_NET, 0)
        change = {"state_dictAT": {name: torch.from_numpy(one) for name, one in flow.items()}}
    path = save(tmp_path / "SuperSloMo.ckpt", **change)
    with pytest.raises(FileFormatError, match=complaint) as told:
        read_checkpoint(path)
    assert str(path) in str(told.value)
