"""Simulators of other packages: run as ours are, and checked on request."""

import sys
import types

import numpy as np
import pytest

import texvent
from texvent import _registry
from texvent.errors import TexventError
from texvent.events import EventStream
from texvent.simulation.esim.simulator import EsimSimulator
from texvent.simulation.streaming import SteppingSimulator

from .pixel_frames import moving_texture

SIMULATORS = list(_registry.SIMULATORS.builtin)


class PlugIn(SteppingSimulator):
    """A plug-in that gives the packets of ESIM, changed in one place."""

    config_type, presets = EsimSimulator.config_type, EsimSimulator.presets
    contrast_threshold, balance = 0.2, 0.255
    built = 0

    def __init__(self, config, seed, change=None):
        self.inner, self.change = EsimSimulator(config, seed=seed), change
        PlugIn.built += 1
        self.number = PlugIn.built

    def step(self, frame):
        packet = self.inner.step(frame)
        return self.change(self, packet, frame) if self.change else packet


def gives_tuples(plug_in, packet, frame):
    return np.zeros((3, 4))


def is_late(plug_in, packet, frame):
    """The last events come at the time of the frame."""
    t = packet.t.copy()
    t[-1:] = frame.t_us
    return EventStream(packet.x, packet.y, t, packet.p, packet.size)


def fires_at_first(plug_in, packet, frame):
    return EventStream.from_columns([0], [0], [frame.t_us], [1], size=frame.size)


def is_outside(plug_in, packet, frame):
    columns = (packet.x + np.uint16(24), packet.y, packet.t.copy(), packet.p.copy())
    return EventStream.unchecked(*columns, size=packet.size, label=None)


def ignores_its_seed(plug_in, packet, frame):
    return packet[plug_in.number :]


def is_unsorted(plug_in, packet, frame):
    t = np.full_like(packet.t, packet.t[0]) if len(packet) else packet.t
    return EventStream(packet.x[::-1], packet.y[::-1], t, packet.p[::-1], packet.size)


BROKEN = [
    (gives_tuples, "gave ndarray; it must give an EventStream"),
    (is_late, "outside the interval that their frame ends"),
    (fires_at_first, "events for the first frame"),
    (is_outside, "outside the sensor"),
    (is_unsorted, "they go by (t, y, x, p)"),
    (ignores_its_seed, "other events for the same frames and seed"),
]


@pytest.fixture
def mine(install, monkeypatch):
    """A function that makes attributes of a module those of an installed package."""
    install("mine", "[texvent.simulators]\nmine = mine_module:Part\n")
    return lambda **parts: monkeypatch.setitem(
        sys.modules, "mine_module", types.SimpleNamespace(**parts)
    )


@pytest.mark.parametrize("name", SIMULATORS)
def test_our_simulators_keep_the_contract(name):
    texvent.check_simulator(name)


def test_a_plug_in_that_is_right_is_run_and_passes(mine):
    mine(Part=PlugIn)
    frames = np.stack([frame.luma for frame in moving_texture()])
    wanted, events = (
        texvent.simulate(frames, fps=25, simulator=name, interpolate="blend")
        for name in ("esim", "mine")
    )
    assert events.equals(wanted)
    texvent.check_simulator("mine")
    texvent.check_simulator(PlugIn)


@pytest.mark.parametrize(("change", "said"), BROKEN)
def test_a_broken_simulator_is_named_by_the_check(change, said):
    class Mine(PlugIn):
        def __init__(self, config, seed):
            super().__init__(config, seed, change)

    with pytest.raises(TexventError) as caught:
        texvent.check_simulator(Mine)
    assert said in str(caught.value)
    assert str(caught.value).startswith("simulator 'Mine' ")


def test_a_plug_in_that_cannot_be_imported_is_named(mine):
    mine()
    assert "mine" in texvent.simulators()
    with pytest.raises(TexventError, match=r"simulator 'mine' of another package .*mine_module"):
        texvent.presets("mine")
