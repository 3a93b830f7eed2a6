"""A run whose frames stay on a device gives the packets of the CPU, and hardly ever waits."""

import gc
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest

from texvent._registry import INTERPOLATORS, SIMULATORS
from texvent.errors import ConfigError, InputError
from texvent.frames import Frame, Video
from texvent.pairs import on_device
from texvent.pipeline import video_to_events
from texvent.runtime.devices import find_gpu
from texvent.runtime.work.worker_threads import BackgroundWriter
from texvent.settings.resolution import resolve
from texvent.simulation.gpu.support import MODELS, RunDevice, choose_device, find_model

pytestmark = pytest.mark.torch
torch = pytest.importorskip("torch")
pytest.importorskip("triton")

from tests.interpolate.rife.rife_files import save_published  # noqa: E402

HEIGHT, WIDTH, FRAMES = 16, 16, 3


def runs_on_a_gpu(config):
    try:
        return bool(find_model(config))
    except ConfigError:
        return False


def presets_of(model):
    """Those that run on a GPU, one of those that are alike."""
    names = {}
    for name, config in SIMULATORS.load(model).presets.items():
        if runs_on_a_gpu(config):
            names.setdefault(config, name)
    return list(names.values())


PRESETS = [
    (model, preset, interpolate)
    for model in MODELS
    for interpolate, most in {"none": None, "blend": 2}.items()
    for preset in presets_of(model)[:most]
]
PIXELS = {
    "bytes": lambda grey: grey.astype(np.uint8),
    "colour": lambda grey: np.stack([grey, grey[:, ::-1], 255 - grey], -1).astype(np.uint8),
    "16 bits": lambda grey: (grey * 257).astype(np.uint16),
    "colour of 16 bits": lambda grey: np.stack([grey * 257, grey[:, ::-1] * 200, grey], -1).astype(
        np.uint16
    ),
    "floats": lambda grey: grey.astype(np.float64),
}


def clip(kind="bytes", frames=FRAMES):
    """A texture that moves and, in the last frame, is another one: a cut."""
    random = np.random.default_rng(3)
    grey = np.cumsum(random.normal(0, 6, (frames, HEIGHT, WIDTH)), axis=0) + 60
    y, x = np.mgrid[:HEIGHT, :WIDTH]
    grey[-1] = 130 + 120 * np.sin(2.0 * x) * np.cos(1.7 * y + x)
    times_us = [0, *np.cumsum(random.integers(900, 1100, frames - 1)).tolist()]
    return Video(PIXELS[kind](np.clip(grey, 0, 255).round()), times_us)


def simulation(video, **options):
    options = {"seed": 5, "device": "cpu", **options}
    if options.get("interpolate") != "none":
        options = {"max_intermediate": 3, **options}
    return video_to_events(video, resolve("simulate", options))


def on(device, run):
    return replace(run, device=RunDevice(find_gpu(device) or torch.device(device)))


def packets(run):
    """All that a run gives: time and kind of each frame, and the columns of its packet."""
    return [
        (frame.t_us, frame.is_source, *(column.tolist() for column in packet.columns().values()))
        for frame, packet in run.steps()
    ]


def assert_same(run, device, *, least=30):
    expected = packets(run)
    assert sum(len(packet[2]) for packet in expected) >= least
    assert packets(on(device, run)) == expected


@pytest.fixture(scope="module")
def weights(tmp_path_factory):
    """A file of RIFE as published, untrained and narrow."""
    from texvent.interpolate.rife import network

    return save_published(torch, network.RIFE_4_6, tmp_path_factory.mktemp("rife") / "rife.pkl")


@pytest.mark.parametrize(("simulator", "preset", "interpolate"), PRESETS)
def test_every_preset_gives_the_packets_of_the_cpu(simulator, preset, interpolate, device):
    options = {"simulator": simulator, "preset": preset, "interpolate": interpolate}
    assert_same(simulation(clip(), **options), device)


@pytest.mark.parametrize("kind", PIXELS)
def test_every_pixel_type_gives_the_packets_of_the_cpu(kind, device):
    assert_same(simulation(clip(kind), preset="paper", interpolate="blend"), device)


class Rendered(Video):
    """Frames between which any instant can be had."""

    def at(self, t_us):
        first, second = self[0], self[1]
        share = (t_us / second.t_us) ** 2
        levels = first.float_luma + np.float32(share) * (second.float_luma - first.float_luma)
        return Frame(levels, t_us, is_source=False)


def test_frames_that_are_drawn_on_the_host_go_up(device):
    video = clip()
    run = simulation(
        Rendered(video.pixels[:2], video.times_us[:2]), preset="paper", interpolate="exact"
    )
    assert_same(run, device, least=1)


@pytest.mark.parametrize("rife_flow", ["once", "each"])
def test_frames_that_a_network_makes_stay_there(rife_flow, weights, device, monkeypatch):
    run = simulation(
        clip("colour"), preset="paper", interpolate="rife", rife_flow=rife_flow,
        interpolator_weights=str(weights),
    )  # fmt: skip
    monkeypatch.setattr("texvent.pairs.on_device.BATCH_BYTES", 2 * 4 * HEIGHT * WIDTH)
    assert_same(run, device)


WAITS = (
    "cpu", "item", "numpy", "tolist", "__bool__", "__float__", "__int__", "__index__", "__array__",
    "nonzero", "argwhere", "masked_select", "unique", "equal",
)  # fmt: skip


def test_the_host_waits_as_often_for_many_intermediate_frames_as_for_one(
    weights, device, monkeypatch
):
    waits: list[str] = []

    def counting(name, original):
        def call(*arguments, **keywords):
            caller = sys._getframe(1).f_globals["__name__"]
            if caller.startswith("texvent.") and name != "numpy":
                waits.append(name)
            return original(*arguments, **keywords)

        return call

    video, counts = clip("colour", frames=3), {}
    for count in (1, 6):
        run = simulation(
            video, preset="paper", interpolate="rife", interpolator_weights=str(weights),
            fixed_count=count, max_intermediate=9, detect_cuts=False,
        )  # fmt: skip
        chosen = on(device, run)
        INTERPOLATORS.load("rife")(run.settings.interpolate, video, device=chosen.device.gpu)
        with monkeypatch.context() as patch:
            for name in WAITS:
                patch.setattr(torch.Tensor, name, counting(name, getattr(torch.Tensor, name)))
            patch.setattr(torch.cuda, "synchronize", counting("wait", torch.cuda.synchronize))
            waits.clear()
            pairs = sum(frame.is_source for frame, _ in chosen.steps()) - 1
        counts[count] = list(waits)
    assert counts[1] == counts[6]
    # Of a pair: Eq. 4 with thumbnails, the number of events, the events.
    assert counts[1] == ["cpu"] * 3 * pairs


PATIENCE_S = 20.0
"""Wait for what another thread does; a run without that thread does it never."""


class Noted(Video):
    """Frames that are noted as they are decoded."""

    def __iter__(self):
        self.metadata["decoded"] = []
        for frame in super().__iter__():
            self.metadata["decoded"].append((frame.t_us, threading.current_thread()))
            yield frame


class Patient:
    """A file whose first packet is written only after later ones were simulated."""

    def __init__(self):
        self.later, self.written = threading.Event(), []

    def append(self, packet):
        if not self.written:
            assert self.later.wait(PATIENCE_S), "nothing is simulated while a packet is written"
        self.written.append(len(packet))


@pytest.mark.parametrize("interpolate", ["none", "blend"])
def test_frames_are_decoded_and_go_up_while_earlier_ones_are_simulated_and_written(
    interpolate, device, monkeypatch
):
    whole, up = clip(frames=9), {}
    video = Noted(whole.pixels, whole.times_us)
    begin_copy, has_fourth = on_device._begin_copy, threading.Event()

    def noting(frame, device):
        copy = begin_copy(frame, device)
        up[frame.t_us] = threading.current_thread()
        if frame.t_us == video.times_us[3]:
            has_fourth.set()
        return copy

    monkeypatch.setattr(on_device, "_begin_copy", noting)
    run, sink, packets = on(device, simulation(video, interpolate=interpolate)), Patient(), []
    with BackgroundWriter(sink) as behind:
        for number, (_, packet) in enumerate(run.steps()):
            if number == 1:  # the fourth frame goes up without another step
                assert has_fourth.wait(PATIENCE_S), "nothing goes up while frames are simulated"
            packets.append(packet)
            behind.append(packet)
            if number == 3:
                assert not sink.written
                sink.later.set()
    decoded = dict(video.metadata["decoded"])
    assert list(decoded) == list(up) == list(video.times_us)
    assert threading.main_thread() not in {*decoded.values(), *up.values()}
    assert sink.written == [len(packet) for packet in packets]
    assert sum(sink.written) > 0


def test_tensors_are_let_go_of_as_frames_pass(device):
    run, live = on(device, simulation(clip(frames=9), preset="paper", interpolate="none")), []
    for frame, _ in run.steps():
        assert frame.is_source
        gc.collect()
        # By type: to be asked for its class fails a weak reference of another test.
        tensors = (one for one in gc.get_objects() if issubclass(type(one), torch.Tensor))
        live.append(sum(one.nbytes for one in tensors))
    # The last frame is another picture, of more events.
    assert live[-2] <= max(live[1:4])


def test_bad_frames_are_refused_as_on_the_cpu(device):
    video = clip("floats")
    video.pixels[2, 3, 3] = np.nan
    run = simulation(video, interpolate="blend")
    for one in (run, on(device, run)):
        with pytest.raises(InputError, match=r"frame 2 .* 1 pixel\(s\) that are NaN"):
            packets(one)


def test_events_store_the_device_that_made_them(device):
    run = simulation(clip())
    assert "device" not in run.provenance
    facts = on(device, run).provenance["device"]
    assert {"device", "torch", "triton"} <= set(facts)
    assert on(device, run).device.note.startswith(f"{find_gpu(device) or device} (")
    beside = replace(on(device, run).device, obstacle="why")
    assert (beside.facts["device"]["pixel_model"], beside.resident) == ("cpu", None)
    assert beside.note == "pixel model on the CPU: why"
    assert run.settings.as_tables() == simulation(clip(), device="auto").settings.as_tables()


@pytest.mark.parametrize("simulator", SIMULATORS.builtin)
def test_a_model_runs_on_a_gpu_or_says_what_does(simulator):
    settings = resolve("simulate", {"simulator": simulator, "device": "cuda"})
    if not runs_on_a_gpu(settings.simulate):
        with pytest.raises(ConfigError, match=f"device is 'cuda': .*{simulator}.*device='auto'"):
            choose_device(settings.run, settings.simulate)
    assert runs_on_a_gpu(settings.simulate) == (simulator in MODELS)


def test_a_model_of_another_package_keeps_its_own_pixels_whatever_its_options(held_back):
    settings = resolve("simulate", {"simulator": held_back, "device": "cuda"})
    find_model(settings.simulate)  # they are those of esim
    with pytest.raises(ConfigError, match="'held-back' does not run on a GPU"):
        choose_device(settings.run, settings.simulate)


def test_a_gpu_that_is_not_there_is_refused():
    wish = "cuda:99" if torch.cuda.is_available() else "cuda"
    with pytest.raises(ConfigError, match=rf"device is '{wish}'.* (finds|is built for CPUs) "):
        find_gpu(wish)
    for word in ("gpu", "cuda:", "cuda:x", "cuda:00", "cuda:128", "cpu:0"):
        with pytest.raises(ConfigError, match="it must be auto, cpu, cuda"):
            resolve("simulate", {"device": word})
