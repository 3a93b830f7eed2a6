"""Pairs of frames through models that only know how to step."""

from __future__ import annotations

from tests.frame_pairs import advance_through

from texvent.simulate.build import with_advance
from texvent.simulate.esim.simulator import EsimSimulator

from .pixel_frames import moving_texture


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
