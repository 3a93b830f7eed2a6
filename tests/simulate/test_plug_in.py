"""Simulators of other packages: the broken ones end in one line that names them."""

from __future__ import annotations

import sys
import types

import numpy as np
import pytest

import texvent
from texvent import _registry
from texvent.errors import TexventError, TexventWarning
from texvent.events import EventStream
from texvent.simulate.esim.simulator import EsimSimulator
from texvent.simulate.stepping import SteppingSimulator

from .pixel_frames import moving_texture

SIMULATORS = [name for name in _registry.SIMULATORS.builtin if name != "v2ce"]  # needs weights


class Plain(SteppingSimulator):
    """A plug-in that is right; the others break it in one place."""

    config_type = EsimSimulator.config_type
    presets = EsimSimulator.presets
    contrast_threshold = 0.2
    balance = 0.255

    def __init__(self, config, seed):
        self.inner = EsimSimulator(config, seed=seed)

    def reset(self):
        self.inner.reset()

    def step(self, frame):
        return self.inner.step(frame)


class NoConfig(Plain):
    config_type = None


class NoPresets(Plain):
    presets = types.MappingProxyType({})


class WrongPreset(Plain):
    presets = types.MappingProxyType({"default": {"contrast_threshold": 0.2}})


class NoStep:
    config_type = EsimSimulator.config_type
    presets = EsimSimulator.presets


class NoThreshold(Plain):
    contrast_threshold = None


class NoSeed(Plain):
    def __init__(self, config):
        super().__init__(config, 0)


class Raises(Plain):
    def step(self, frame):
        return self.no_such_thing


class GivesTuples(Plain):
    def step(self, frame):
        return np.zeros((3, 4))


class Late(Plain):
    """Its last events come at the time of the frame."""

    def step(self, frame):
        packet = self.inner.step(frame)
        if not len(packet):
            return packet
        t = packet.t.copy()
        t[-1] = frame.t_us
        return EventStream(packet.x, packet.y, t, packet.p, packet.size)


class Milliseconds(Plain):
    def step(self, frame):
        packet = self.inner.step(frame)
        return EventStream(packet.x, packet.y, packet.t // 1000, packet.p, packet.size)


class FirstFrame(Plain):
    def step(self, frame):
        return EventStream.from_columns([0], [0], [frame.t_us], [1], size=frame.size)


class Outside(Plain):
    def step(self, frame):
        packet = self.inner.step(frame)
        columns = (packet.x + np.uint16(24), packet.y, packet.t.copy(), packet.p.copy())
        return EventStream.unchecked(*columns, size=packet.size, label=None)


class Floats(Plain):
    def step(self, frame):
        packet = self.inner.step(frame)
        columns = (packet.x.copy(), packet.y.copy(), packet.t.astype(float), packet.p.copy())
        return EventStream.unchecked(*columns, size=packet.size, label=None)


class OtherSize(Plain):
    def step(self, frame):
        return EventStream.empty("100x100")


RUN_TIME = [
    (NoThreshold, "failed in its construction (TypeError"),
    (NoSeed, "failed in its construction (TypeError"),
    (Raises, "failed in advance (AttributeError: 'Raises' object has no attribute"),
    (GivesTuples, "gave Frame and ndarray; it must give a Frame and an EventStream"),
    (Late, "whose end does not belong to it"),
    (Milliseconds, "µs for the interval from"),
    (FirstFrame, "gave 1 events for the first frame; it has none"),
    (Outside, "gave x up to"),
    (Floats, "gave t as float64; it must be int64"),
    (OtherSize, "gave events of 100x100 for frames of"),
]
LOAD_TIME = [
    (NoConfig, "has config_type None; it must be a frozen dataclass"),
    (NoPresets, "has presets mappingproxy({})"),
    (WrongPreset, "has preset 'default', which is no"),
    (NoStep, "has neither step(frame) nor advance(pair)"),
]


class EachOther(Plain):
    """Every one that is built gives other events, whatever its seed."""

    built = 0

    def __init__(self, config, seed):
        super().__init__(config, seed)
        EachOther.built += 1
        self.left_out = EachOther.built

    def step(self, frame):
        return self.inner.step(frame)[self.left_out :]


class KeepsState(Plain):
    count = 0

    def reset(self):
        self.inner.reset()
        self.count = 1

    def step(self, frame):
        return self.inner.step(frame)[self.count :]


class LosesFrames(Plain):
    def advance(self, pair):
        steps = list(super().advance(pair))
        yield from steps if pair.first is None else steps[:-1]


class Unsorted(Plain):
    def step(self, frame):
        packet = self.inner.step(frame)
        t = np.full_like(packet.t, packet.t[0]) if len(packet) else packet.t
        return EventStream(packet.x[::-1], packet.y[::-1], t, packet.p[::-1], packet.size)


class Blind(Plain):
    def step(self, frame):
        return EventStream.empty(frame.size)


DEEPER = [
    (EachOther, "gave other events for the same frames and seed"),
    (KeepsState, "gave other events after reset"),
    (LosesFrames, "each source frame must come once"),
    (Unsorted, "ties go by (t, y, x, p)"),
]


@pytest.fixture
def install(tmp_path, monkeypatch):
    """A function that makes a class the simulator "mine" of an installed package."""
    info = tmp_path / "mine-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: mine\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[texvent.simulators]\nmine = mine_module:Part\n")
    monkeypatch.syspath_prepend(tmp_path)
    _registry._plugged_in.cache_clear()

    def put(kind):
        module = types.ModuleType("mine_module")
        if kind is not None:
            module.Part = kind
        monkeypatch.setitem(sys.modules, "mine_module", module)

    yield put
    _registry._plugged_in.cache_clear()


def simulate():
    frames = np.stack([frame.luma for frame in moving_texture()])
    return texvent.simulate(frames, fps=25, simulator="mine", interpolate="blend")


@pytest.mark.parametrize("name", SIMULATORS)
def test_our_simulators_keep_the_contract(name):
    texvent.check_simulator(name)


def test_a_plug_in_that_is_right_is_run_and_passes(install):
    install(Plain)
    frames = np.stack([frame.luma for frame in moving_texture()])
    wanted = texvent.simulate(frames, fps=25, simulator="esim", interpolate="blend")
    assert simulate().equals(wanted)
    texvent.check_simulator("mine")
    texvent.check_simulator(Plain)
    texvent.check_simulator(EsimSimulator())


@pytest.mark.parametrize(("kind", "said"), [*LOAD_TIME, *RUN_TIME])
def test_a_broken_plug_in_ends_in_a_line_that_names_it(install, kind, said):
    install(kind)
    for run in (simulate, lambda: texvent.check_simulator("mine")):
        with pytest.raises(TexventError) as caught:
            run()
        message = str(caught.value)
        assert said in message
        assert message.startswith("simulator 'mine' ")
        assert len(message) < 300
        assert "\n" not in message


@pytest.mark.parametrize(("kind", "said"), LOAD_TIME)
def test_what_a_class_lacks_is_found_when_it_is_loaded(install, kind, said):
    install(kind)
    with pytest.raises(TexventError, match="simulator 'mine' has"):
        texvent.presets("mine")


@pytest.mark.parametrize(("kind", "said"), DEEPER)
def test_what_only_a_trial_shows_is_found_by_the_check(kind, said):
    with pytest.raises(TexventError) as caught:
        texvent.check_simulator(kind)
    assert said in str(caught.value)
    assert str(caught.value).startswith(f"simulator {kind.__name__!r} ")


def test_a_simulator_without_events_warns():
    with pytest.warns(TexventWarning, match="simulator 'Blind' gave no event"):
        texvent.check_simulator(Blind)


def test_a_plug_in_that_cannot_be_imported_is_named(install):
    install(None)
    assert "mine" in texvent.simulators()
    with pytest.raises(TexventError, match=r"simulator 'mine' of another package .*mine_module"):
        texvent.presets("mine")


def test_all_that_a_class_lacks_is_said_at_once():
    class Nothing:
        pass

    with pytest.raises(TexventError) as caught:
        texvent.check_simulator(Nothing)
    said = str(caught.value)
    for what in ("step(frame)", "reset()", "config_type", "presets"):
        assert what in said
    assert len(said) < 300
