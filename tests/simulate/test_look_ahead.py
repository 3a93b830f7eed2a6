"""Frames through models that answer at once, and through one that answers later."""

from texvent.events import EventStream
from texvent.simulate.esim.simulator import EsimSimulator
from texvent.simulate.look_ahead import LookAheadSimulator, step_through

from .published import moving_texture


class Pairwise(EsimSimulator):
    """Answers for two frames at a time."""

    def steps(self, frames):
        waiting = []
        for frame in frames:
            waiting.append((frame, self.step(frame)))
            if len(waiting) == 2:
                yield from waiting
                waiting = []
        yield from waiting


def test_a_model_without_look_ahead_steps_frame_by_frame():
    frames = moving_texture()
    simulator = EsimSimulator()
    assert not isinstance(simulator, LookAheadSimulator)
    found = list(step_through(simulator, iter(frames)))
    other = EsimSimulator()
    assert [frame for frame, _ in found] == frames
    assert all(
        packet.equals(other.step(frame)) for frame, (_, packet) in zip(frames, found, strict=True)
    )


def test_a_model_with_look_ahead_decides_when_to_answer():
    frames = moving_texture(5)
    found = list(step_through(Pairwise(), iter(frames)))
    assert [frame for frame, _ in found] == frames
    whole = EventStream.concat([packet for _, packet in step_through(EsimSimulator(), frames)])
    assert EventStream.concat([packet for _, packet in found]).equals(whole)
