"""V2CE and Super SloMo from files in the published layouts, and what is refused."""

import copy
import datetime
import hashlib
import sys

import numpy as np
import pytest
from tests.interpolate.rife.rife_numpy import warp

import texvent
from texvent.cli.app import main
from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError, InputError, MissingDependencyError
from texvent.frames import Frame, Video
from texvent.io.files import open_events
from texvent.networks import BATCH_COUNTER, shapes_of
from texvent.pipeline import video_to_events
from texvent.settings.resolution import resolve
from texvent.simulation.packets import FrameInterval
from texvent.simulation.random.draws import frame_key
from texvent.simulation.streaming import make_packet
from texvent_lab.plug_ins import super_slomo, v2ce
from texvent_lab.plug_ins.super_slomo import FLOW, REFINE, SuperSlomoInterpolator
from texvent_lab.plug_ins.v2ce import SEQUENCE, V2ceConfig, V2ceSimulator

from . import networks_numpy

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
from texvent_lab.plug_ins import v2ce_network  # noqa: E402  (needs torch)

STEP_US = 40_000
FILES = {"v2ce": v2ce.FILE, "super-slomo": super_slomo.FILE}


def new_network(name):
    if name == "v2ce":
        return v2ce_network.V2ce()
    nets = {FLOW: super_slomo.unet(torch, 6, 4), REFINE: super_slomo.unet(torch, 20, 5)}
    return torch.nn.ModuleDict(nets)


def random_state(name):
    shapes = shapes_of(new_network(name).state_dict())
    kept = {key: one for key, one in shapes.items() if not key.endswith(BATCH_COUNTER)}
    return networks_numpy.random_state(kept)


def save(name, state, path):
    """A file as published: V2CE's tensors alone, Super SloMo's beside what training left."""
    tensors = {key: torch.as_tensor(one) for key, one in state.items()}
    if name == "super-slomo":
        left = {"epoch": 199, "timestamp": datetime.datetime(2018, 12, 1), "loss": [[0.5]]}
        nets = {
            key: {one.removeprefix(f"{key}."): t for one, t in tensors.items() if key in one}
            for key in (FLOW, REFINE)
        }
        tensors = {**left, **nets}
    torch.save(tensors, path)
    return path


def build(name, path):
    if name == "v2ce":
        return V2ceSimulator(V2ceConfig(weights=path))
    return SuperSlomoInterpolator(InterpolateConfig(interpolator_weights=path), None)


@pytest.fixture
def weights(tmp_path, monkeypatch):
    """Folder of both files, found without naming them, of networks of a few channels.

    Every name and relation of shapes is as published.
    """
    torch.set_num_threads(1)
    monkeypatch.setattr(v2ce_network, "WIDTHS", (2, 4, 8, 16, 32))
    monkeypatch.setattr(super_slomo, "WIDTHS", (2, 4, 8, 16, 32, 32))
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    (tmp_path / "weights").mkdir()
    for name, file in FILES.items():
        save(name, random_state(name), tmp_path / "weights" / file)
    return tmp_path / "weights"


def texture(count, shape=(12, 16)):
    y, x = np.mgrid[: shape[0], : shape[1]]
    waves = (np.sin(0.7 * (x + 2 * i)) * np.cos(0.9 * y) for i in range(count))
    return np.stack([(120 + 100 * one).astype(np.uint8) for one in waves])


@pytest.mark.parametrize(
    ("network", "tensors", "numbers"),
    [("v2ce", 218, 52_916_466), ("super-slomo", 92, 19_794_116 + 19_816_357)],
)
def test_a_file_of_the_published_layout_is_read(network, tensors, numbers, tmp_path):
    with torch.device("meta"):
        shapes = shapes_of(new_network(network).state_dict())
    state = {name: torch.full(shape, 0.01) for name, shape in shapes.items()}
    assert len(state) == tensors
    assert sum(one.numel() for one in state.values()) == numbers
    built = build(network, save(network, state, tmp_path / FILES[network]))
    if network == "v2ce":
        for pixels, t_us in zip(texture(2), (0, STEP_US), strict=True):
            assert built.step(Frame(pixels, t_us)).size == (16, 12)


@pytest.mark.parametrize(
    ("name", "shape"),
    [
        ("UNet.encoders.0.downsample.0.bias", (64,)),
        ("UNet.resblocks.1.conv1.module.weight_v", (13_824,)),
        # Channels and picture stay, yet the program has a convolution around this block too.
        ("UNet.resblocks.0.downsample.0.weight", (512, 512, 1, 1, 1)),
        ("UNet.decoders.0.conv1.module.weight_bar", (256, 768, 3, 3, 3)),
        (f"{FLOW}.down1.conv1.weight", (64, 32, 5, 5)),
        (f"{REFINE}.up3.conv2.weight", (128, 256, 3, 3)),
    ],
)
def test_a_tensor_has_its_published_shape(name, shape):
    with torch.device("meta"):
        state = new_network("v2ce" if name.startswith("UNet") else "super-slomo").state_dict()
    assert tuple(state[name].shape) == shape


@pytest.mark.parametrize("shape", [(3, 37, 22), (2, 1, 1)])
def test_v2ce_gives_the_numbers_of_the_reference(shape, weights):
    count, *image = shape
    pairs = np.random.default_rng(1).normal(0, 1, (count, 2, *image)).astype(np.float32)
    network, state = new_network("v2ce").eval(), random_state("v2ce")
    network.load_state_dict(
        {key: torch.from_numpy(one) for key, one in state.items()}, strict=False
    )
    with torch.no_grad():
        found = network(torch.from_numpy(pairs)).numpy()
    expected = networks_numpy.v2ce(pairs, state)
    assert np.abs(found - expected).max() < 1e-4
    assert expected.max() > 0.1


def test_a_run_has_the_voxel_grids_of_whole_sequences(weights, plug_ins):
    frames = texture(SEQUENCE + 4)
    events = texvent.simulate(frames, fps=25, simulator="v2ce", seed=5)
    levels = ((frames / 255 - 0.153) / 0.165).astype(np.float32)
    pairs = np.stack([levels[:-1], levels[1:]], axis=1)
    state = random_state("v2ce")
    # The last sequence reaches back to be as long.
    first, last = (networks_numpy.v2ce(pairs[at:][:SEQUENCE], state) for at in (0, 3))
    for pair, grid in enumerate([*first, *last[-3:]]):
        start_us = pair * STEP_US
        span = FrameInterval(start_us, start_us + STEP_US, frame_key(5, start_us + STEP_US))
        expected = make_packet(v2ce.sample_events(grid, span), span, events.size)
        found = events.cut(span.start_us, span.stop_us)
        # Sums of float32 and of float64 may settle a part of an event differently.
        assert len(found) == pytest.approx(len(expected), abs=3)
        assert len(expected) > 50
    digest = hashlib.sha256((weights / v2ce.FILE).read_bytes()).hexdigest()
    assert events.metadata["weights"]["simulator"] == {"file": v2ce.FILE, "sha256": digest}


def test_v2ce_keeps_the_contract_of_simulators(weights, plug_ins):
    texvent.check_simulator("v2ce")
    one, shifted = (V2ceSimulator(seed=3) for _ in range(2))
    for number, pixels in enumerate(texture(4)):
        events = one.step(Frame(pixels, number * STEP_US))
        later = shifted.step(Frame(pixels, number * STEP_US + 7_000_001))
        assert np.array_equal(later.t, events.t + 7_000_001)
        assert np.array_equal(later.x, events.x)
    twin = copy.deepcopy(one)
    last = Frame(texture(5)[4], 4 * STEP_US)
    assert one.step(last) == twin.step(last)


def test_the_command_line_takes_both(weights, plug_ins, tmp_path):
    np.save(tmp_path / "clip.npy", texture(3))
    words = ["simulate", str(tmp_path / "clip.npy"), "--fps", "25", "--previews", "none", "-q"]
    out, slomo = str(tmp_path / "out.h5"), str(weights / super_slomo.FILE)
    words += ["--simulator", "v2ce", "--weights", str(weights / v2ce.FILE), "-o", out]
    words += ["--interpolate", "super-slomo", "--interpolator-weights", slomo]
    assert main([*words, "--fixed-count", "1"]) == 0
    made = open_events(out)
    assert set(made.metadata["weights"]) == {"interpolator", "simulator"}
    assert len(made.collect()) > 0


def test_super_slomo_follows_the_published_steps(weights):
    state = random_state("super-slomo")
    images = np.random.default_rng(3).integers(0, 256, (2, 32, 64)).astype(np.uint8)
    first, second = Frame(images[0], 0), Frame(images[1], 1000)
    built = build("super-slomo", None)
    a, b = (np.repeat(one[None] / 255.0, 3, axis=0) for one in images)
    mean = np.array(super_slomo.MEAN_COLOUR)[:, None, None]
    a0, b0 = a - mean, b - mean
    flows = networks_numpy.super_slomo(np.concatenate([a0, b0]), state, FLOW)
    lengths = np.hypot(flows[::2], flows[1::2])
    assert built.pair_flow.motion_px(first, second) == pytest.approx(lengths.max(), rel=1e-3)
    assert lengths.mean() > 0.01
    for frame in built.between(first, second, [250, 700]):
        t = frame.t_us / 1000
        ft0 = -t * (1 - t) * flows[:2] + t * t * flows[2:]
        ft1 = (1 - t) ** 2 * flows[:2] - t * (1 - t) * flows[2:]
        seen = [a0, b0, flows, ft1, ft0, warp(b0, ft1), warp(a0, ft0)]
        out = networks_numpy.super_slomo(np.concatenate(seen), state, REFINE)
        visible = 1 / (1 + np.exp(-out[4]))
        w0, w1 = (1 - t) * visible, t * (1 - visible)
        mixed = w0 * warp(a[:1], ft0 + out[:2])[0] + w1 * warp(b[:1], ft1 + out[2:4])[0]
        assert np.abs(frame.pixels - 255 * mixed / (w0 + w1)).max() < 0.05
        assert not frame.is_source


def test_super_slomo_takes_a_frame_per_pixel_that_its_own_flow_moves(weights, plug_ins):
    video = Video(texture(2, (33, 20)), [0, STEP_US])
    moves_px = build("super-slomo", None).motion_px(*video)
    options = {"interpolate": "super-slomo", "frames_per_pixel": 29.5 / moves_px}
    frames = [frame for frame, _ in video_to_events(video, resolve("simulate", options)).steps()]
    assert len(frames) == 2 + 30


LAST = {"v2ce": "UNet.pred.conv3d.bias", "super-slomo": f"{REFINE}.conv3.bias"}
CHANGES = {
    r"Missing key.*{last}": lambda state, last: state.pop(last),
    r"Unexpected key.*{last}x": lambda state, last: state.update({f"{last}x": np.ones(2)}),
    r"size mismatch for {last}": lambda state, last: state.update({last: np.ones(2)}),
    r"{last} holds values that are NaN": lambda state, last: state[last].fill(np.nan),
    r"Missing key": lambda state, last: [state.pop(key) for key in list(state) if key != last],
}


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("message", [*CHANGES, "cannot be read as network weights"])
def test_another_file_is_refused_in_one_line_with_its_tensors(name, message, weights):
    path, state = weights / FILES[name], random_state(name)
    if message in CHANGES:
        CHANGES[message](state, LAST[name])
        save(name, state, path)
    else:
        path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(FileFormatError, match=message.format(last=LAST[name])) as told:
        build(name, path)
    assert str(path) in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("name", FILES)
def test_weights_that_are_not_there_are_named_with_their_origin(name, tmp_path, monkeypatch):
    monkeypatch.setenv("TEXVENT_CACHE", str(tmp_path))
    for path in (None, tmp_path / "no.pt"):
        with pytest.raises(
            InputError, match=f"on GitHub links to.*{FILES[name]}.*weights`"
        ) as told:
            build(name, path)
        assert path is None or str(path) in str(told.value)


@pytest.mark.parametrize("name", FILES)
def test_without_torch_the_extra_is_named(name, weights, monkeypatch):
    monkeypatch.setitem(sys.modules, "torch", None)
    with pytest.raises(MissingDependencyError, match=r"texvent\[torch\]"):
        build(name, None)
