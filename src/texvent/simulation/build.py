"""The simulator of a run, built from its options; and the check of one of another package."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, cast

import numpy as np

from texvent._registry import SIMULATORS
from texvent._require import require
from texvent.config import RunConfig
from texvent.errors import TexventError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.runtime.devices import EXTRA, Device
from texvent.simulation.protocol import Simulator
from texvent.simulation.streaming import SteppingSimulator


class SteppedPlugIn(SteppingSimulator):
    """A simulator of another package that has `step` but not `advance`."""

    def __init__(self, simulator: Any) -> None:
        """Wrap a simulator that has seen no frame."""
        self._simulator = simulator

    def __getattr__(self, name: str) -> Any:
        return getattr(self._simulator, name)

    def step(self, frame: Frame) -> EventStream:
        """Step the wrapped simulator."""
        packet: EventStream = self._simulator.step(frame)
        return packet


def benefits_from_denser_frames(simulator: Simulator) -> bool:
    """Whether a simulator declares that more frames than Eq. 4's make its events better."""
    return bool(getattr(simulator, "benefits_from_denser_frames", False))


def build_simulator(run: RunConfig, config: Any, device: Device | None = None) -> Simulator:
    """The simulator of a run, before its first frame.

    Args:
        run: its simulator and seed.
        config: the simulator's options.
        device: torch.device of its kernels; None: those of the CPU.

    Raises:
        ConfigError: there is no such simulator.
        TexventError: a simulator of another package cannot be loaded.
    """
    simulator = with_advance(SIMULATORS.load(run.simulator)(config, seed=run.seed))
    if device is None:
        return simulator
    require("triton", extra=EXTRA)
    from texvent.simulation.gpu.resident import ResidentSimulator  # brings torch and Triton

    resident: Any = ResidentSimulator(simulator, config, run.seed, device)
    return cast("Simulator", resident)


def with_advance(simulator: Any) -> Simulator:
    """The simulator itself if it has `advance`, else one that steps it through every pair."""
    complete: Any = simulator if hasattr(simulator, "advance") else SteppedPlugIn(simulator)
    return cast("Simulator", complete)


def check_simulator(simulator: Any) -> None:
    """Step a simulator of another package through a small clip and check its packets.

    Args:
        simulator: the class, or the name of a registered one.

    Raises:
        TexventError: an event is outside its interval or sensor or is out of order, the first
            frame gives events, or the seed does not decide them.

    Example:
        >>> import texvent
        >>> texvent.check_simulator("esim")
    """
    kind: Any = SIMULATORS.load(simulator) if isinstance(simulator, str) else simulator
    name = simulator if isinstance(simulator, str) else kind.__name__
    config = next(iter(kind.presets.values()))
    first, again = (list(_packets(kind(config, seed=3))) for _ in range(2))
    problem = None
    if len(first[0][1]):
        problem = "gave events for the first frame"
    elif any(packet != other for (_, packet), (_, other) in zip(first, again, strict=True)):
        problem = "gave other events for the same frames and seed"
    for start_us, packet in first if problem is None else ():
        order = np.lexsort((packet.p, packet.x, packet.y, packet.t))
        if len(packet) and not start_us <= packet.t.min() <= packet.t.max() < start_us + 20_000:
            problem = "gave events outside the interval that their frame ends"
        elif (np.diff(order) < 0).any():
            problem = "gave events out of order; they go by (t, y, x, p)"
        elif len(packet) and (packet.x.max() >= 24 or packet.y.max() >= 16 or packet.p.max() > 1):
            problem = "gave events outside the sensor, or of a polarity other than 0 and 1"
    if problem:
        raise TexventError(f"simulator {name!r} {problem}; see texvent/simulation/protocol.py")


def _packets(simulator: Any) -> Iterator[tuple[int, EventStream]]:
    """Start of each interval, µs, and its packet: a texture of 24x16 pixels that moves."""
    y, x = np.mgrid[:16, :24]
    for number in range(4):
        pixels = 120 + 100 * np.sin(0.7 * (x + 2 * number)) * np.cos(0.9 * y)
        frame = Frame(pixels.astype(np.uint8), 1_000_000 + 20_000 * number)
        packet = simulator.step(frame)
        if not isinstance(packet, EventStream):
            kind = type(packet).__name__
            name = type(simulator).__name__
            raise TexventError(f"simulator {name!r} gave {kind}; it must give an EventStream")
        yield frame.t_us - 20_000, packet
