"""RIFE from a published file to frames: any size, pixel type, device option; refusals by name."""

import hashlib
from pathlib import Path

import numpy as np
import pytest

from texvent._registry import INTERPOLATORS
from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError
from texvent.frames import Frame, Video
from texvent.interpolate.rife.interpolator import RifeInterpolator, image_tensors
from texvent.interpolate.rife.weights import read_rife_weights, write_rife_weights
from texvent.pairs.instants import matching_levels
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.transfer import Transfer

from .rife_files import random_tensors, save_published
from .rife_numpy import NumpyRife, warp

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")

TIMES_US = [250, 500, 750]
LAYOUTS = ("4.0", "4.6", "4.25")


@pytest.fixture(scope="module")
def files(tmp_path_factory) -> dict[str, Path]:
    """Layout name → a file as published, untrained, 8 channels wide instead of 192 to 32."""
    from texvent.interpolate.rife import network

    folder = tmp_path_factory.mktemp("rife")
    return {
        layout.name: save_published(torch, layout, folder / f"{layout.name}.pkl")
        for layout in network.LAYOUTS
    }


@pytest.fixture
def build(files, stream):
    def make(layout="4.6", **options) -> RifeInterpolator:
        config = InterpolateConfig(
            interpolate="rife", interpolator_weights=files[layout], **options
        )
        return INTERPOLATORS.load("rife")(config, stream)

    return make


def frames_of(interpolator, first, second, times_us=TIMES_US):
    found = list(interpolator.between(Frame(first, 0), Frame(second, 1000), times_us))
    assert [frame.t_us for frame in found] == list(times_us)
    assert not any(frame.is_source for frame in found)
    return [frame.pixels for frame in found]


def noise(height=40, width=50, seed=0, *, channels=None):
    shape = (2, height, width) if channels is None else (2, height, width, channels)
    return np.random.default_rng(seed).integers(0, 256, shape).astype(np.uint8)


@pytest.mark.parametrize(
    ("layout", "size"), [("4.0", (64, 64)), ("4.6", (1, 1)), ("4.25", (33, 70))]
)
def test_every_layout_takes_any_size(build, layout, size):
    for image in frames_of(build(layout), *noise(*size)):
        assert image.shape == size
        assert image.dtype == np.float32
        # A mix of two moved images stays between their levels.
        assert image.min() >= 0
        assert image.max() <= 255


def test_every_pixel_type_gives_the_same_image(build):
    grey = noise()
    interpolator = build()
    expected = frames_of(interpolator, *grey)
    for levels in (
        grey.astype(np.float64),
        grey.astype(np.uint16) * 257,
        np.repeat(grey[..., None], 3, axis=-1),
    ):
        for found, wanted in zip(frames_of(interpolator, *levels), expected, strict=True):
            assert np.abs(found - wanted).max() < 0.02


def test_colour_decides_the_motion_but_luma_is_moved(build):
    colour = noise(channels=3)
    images = frames_of(build(), *colour)
    from_luma = frames_of(build(), *(Frame(one, 0).luma for one in colour))
    assert max(np.abs(a - b).max() for a, b in zip(images, from_luma, strict=True)) > 1.0
    assert all(image.ndim == 2 for image in images)


def test_levels_above_white_are_compressed_for_the_network_only(build):
    bright = noise().astype(np.float32) * 2
    tensors = image_tensors(*(Frame(one, t_us) for t_us, one in enumerate(bright)))
    levels = matching_levels(bright, Transfer.GAMMA)
    for tensor, one in zip(tensors, levels, strict=True):
        np.testing.assert_allclose(tensor[0, 0].numpy(), one / levels.max(), rtol=1e-5)
    assert max(float(image.max()) for image in frames_of(build(), *bright)) > 300.0


def test_the_motion_is_the_networks_at_each_instant_or_that_of_the_middle(build):
    from texvent.interpolate.rife import network

    first, second = noise(32, 32)
    defined = NumpyRife(network.RIFE_4_6, random_tensors(torch, network.RIFE_4_6))
    each, once = (frames_of(build(rife_flow=kind), first, second) for kind in ("each", "once"))
    for t_us, image, shared in zip(TIMES_US, each, once, strict=True):
        colour = (np.repeat(one[None] / 255, 3, axis=0) for one in (first, second))
        flow, mask = defined.estimate(*colour, t_us / 1000)
        weight, back, forth = 1 / (1 + np.exp(-mask)), warp(first[None], flow[:2]), flow[2:]
        expected = weight * back + (1 - weight) * warp(second[None], forth)
        assert np.abs(image - expected[0]).max() < 0.1
        assert (np.abs(shared - image).max() < 0.01) == (t_us == 500)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_layout_is_recognised_beside_a_teacher(files, tmp_path, layout):
    state = torch.load(files[layout])
    path = tmp_path / "flownet.pkl"
    torch.save({**state, "module.block_tea.conv0.0.0.weight": torch.zeros(45, 16, 3, 3)}, path)
    network = read_rife_weights(path)
    assert network.layout.name == layout
    assert not any(name.startswith("block_tea") for name in network.state_dict())


def test_a_network_is_loaded_once_and_again_where_its_file_is_another(files, stream, tmp_path):
    path = tmp_path / "flownet.pkl"
    config = InterpolateConfig(interpolate="rife", interpolator_weights=path)
    networks = []
    for name in ("4.6", "4.6", "4.25"):
        if len(networks) != 1:
            path.write_bytes(files[name].read_bytes())
        networks.append(RifeInterpolator(config, stream)._network)
    assert networks[0] is networks[1]
    assert networks[2].layout.name == "4.25"


def test_safetensors_hold_the_same_network(files, tmp_path):
    pytest.importorskip("safetensors")
    network = read_rife_weights(files["4.6"])
    path = tmp_path / "rife.safetensors"
    write_rife_weights(network, path)
    again = read_rife_weights(path)
    assert again.layout is network.layout
    for name, tensor in network.state_dict().items():
        assert torch.equal(again.state_dict()[name], tensor)
    path.write_bytes(path.read_bytes()[:-100])
    with pytest.raises(FileFormatError, match=r"rife\.safetensors cannot be read as network"):
        read_rife_weights(path)


def other_network(path):
    torch.save({"conv1.weight": torch.zeros(3, 3)}, path)


def a_layer_less(path):
    tensors = torch.load(path)
    del tensors["module.block3.lastconv.0.bias"]
    torch.save(tensors, path)


def changed(change):
    def spoil(path):
        torch.save({name: change(one) for name, one in torch.load(path).items()}, path)

    return spoil


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (changed(lambda one: one * float("nan")), "holds values that are NaN or infinite"),
        (changed(lambda one: one.double() * 1e300), "holds values that are NaN or infinite"),
        (changed(torch.zeros_like), "weights that are all 0"),
        (changed(lambda one: one.to(torch.complex64)), "dense tensors of real numbers"),
        (changed(torch.Tensor.to_sparse), "dense tensors of real numbers"),
        (
            changed(lambda one: torch.zeros(1, dtype=torch.half).expand(30_000, 30_000)),
            "claims to unpack to",
        ),
        (other_network, "has no tensor of RIFE's network"),
        (a_layer_less, r"Missing key.*block3\.lastconv\.0\.bias"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_a_wrong_file_is_refused_by_name(files, tmp_path, spoil, complaint):
    path = tmp_path / "flownet.pkl"
    path.write_bytes(files["4.6"].read_bytes())
    spoil(path)
    with pytest.raises(FileFormatError, match=rf"flownet\.pkl:? .*{complaint}|{complaint}") as told:
        read_rife_weights(path)
    assert str(path) in str(told.value)
    assert "\n" not in str(told.value)


def test_events_store_which_weights_made_them(files, tmp_path):
    path = tmp_path / "mine.pkl"
    video = Video(noise(), [0, 40_000])
    settings = resolve(
        "simulate", {"interpolate": "rife", "interpolator_weights": str(path), "fixed_count": 1}
    )
    for layout in ("4.0", "4.6"):  # one path, another file: it is looked at again
        path.write_bytes(files[layout].read_bytes())
        sha256 = hashlib.sha256(path.read_bytes()).hexdigest()
        expected = {"file": "mine.pkl", "sha256": sha256, "layout": layout}
        metadata = video_to_events(video, settings).packets.collect().metadata
        assert metadata["weights"] == {"interpolator": expected}
    plain = video_to_events(video, resolve("simulate", {"interpolate": "blend"}))
    assert "weights" not in plain.provenance
