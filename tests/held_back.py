"""A simulator that answers when all frames are there."""

from texvent.simulation.esim.simulator import EsimSimulator


class HeldBack(EsimSimulator):
    """ESIM whose events all come in `finish`."""

    def reset(self):
        super().reset()
        self._frames = []

    def advance(self, pair):
        self._frames += pair.frames
        yield from ()

    def finish(self):
        frames, self._frames = self._frames, []
        for frame in frames:
            yield frame, self.step(frame)
