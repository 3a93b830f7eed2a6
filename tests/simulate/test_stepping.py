"""Pairs of frames through models that only know how to step."""

from __future__ import annotations

import numpy as np
from tests.frame_pairs import advance_through, pairs_of

import texvent
from texvent._registry import SIMULATORS, Registry
from texvent.events import EventStream
from texvent.simulate.build import SteppedPlugIn, with_advance
from texvent.simulate.esim.simulator import EsimSimulator

from .pixel_frames import moving_texture


class OnlySteps:
    """A plug-in of another package: `step` and the properties, no `advance`."""

    config_type = EsimSimulator.config_type
    presets = EsimSimulator.presets
    contrast_threshold = 0.2
    balance = 0.255

    def __init__(self, config, seed):
        self._inner = EsimSimulator(config, seed=seed)

    def step(self, frame):
        return self._inner.step(frame)


def test_a_pair_is_stepped_through_frame_by_frame():
    frames = moving_texture()
    found = list(advance_through(EsimSimulator(), frames))
    other = EsimSimulator()
    assert [frame for frame, _ in found] == frames
    assert all(
        packet.equals(other.step(frame)) for frame, (_, packet) in zip(frames, found, strict=True)
    )


def test_a_model_with_advance_is_left_as_it_is():
    simulator = EsimSimulator()
    assert with_advance(simulator) is simulator
    assert list(simulator.finish()) == []


def test_a_plug_in_that_only_steps_runs_in_the_pipeline(monkeypatch):
    load = Registry.load
    monkeypatch.setattr(
        Registry,
        "load",
        lambda table, name: OnlySteps if table is SIMULATORS else load(table, name),
    )
    frames = np.stack([frame.luma for frame in moving_texture()])
    events = texvent.simulate(frames, fps=25, simulator="esim", interpolate="blend")
    monkeypatch.undo()
    wanted = texvent.simulate(frames, fps=25, simulator="esim", interpolate="blend")
    assert events.equals(wanted)
    plug_in = with_advance(OnlySteps(EsimSimulator.presets["default"], 0))
    assert isinstance(plug_in, SteppedPlugIn)
    assert plug_in.balance == 0.255
    packets = [packet for pair in pairs_of(moving_texture()) for _, packet in plug_in.advance(pair)]
    assert len(EventStream.concat(packets)) > 0
