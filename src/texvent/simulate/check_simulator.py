"""`texvent.check_simulator`: does a simulator keep the contract of `protocol.Simulator`?"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from texvent._registry import SIMULATORS
from texvent.errors import TexventError, warn
from texvent.events import COLUMN_TYPES, EventStream
from texvent.pairs.frame_pair import FramePair
from texvent.pairs.scene_change import SceneChange
from texvent.simulate.stepping import with_advance
from texvent.video import Frame

SEED = 3
WIDTH, HEIGHT = 24, 16
TIMES_US = (1_000_000, 1_040_000, 1_041_000, 1_120_000, 1_160_000)
"""The clip starts late and has uneven intervals."""
INTERMEDIATE = (0, 0, 3, 1)
"""Intermediate frames of each pair."""


def check_simulator(simulator: Any) -> None:
    """Run a simulator on a small synthetic clip and check what it gives.

    Checked are its attributes; that packets lie in `[t of the frame before, t of this frame)`, in
    order and inside the sensor, with the right types and labels; that the first frame gives no
    event and every frame comes back once, `finish` included; and that the seed decides the events,
    for a new simulator as after `reset`.

    Args:
        simulator: the class, an instance (its class is built anew with its `config`), or the name
            of one that is registered.

    Raises:
        TexventError: it breaks the contract; the message names it and says how.

    Warns:
        TexventWarning: it gives no event though every pixel of the clip changes threefold.

    Example:
        >>> check_simulator("esim")
    """
    part = SIMULATORS.load(simulator) if isinstance(simulator, str) else simulator
    kind: Any = part if isinstance(part, type) else type(part)
    name = simulator if isinstance(simulator, str) else kind.__name__
    missing = [one for one in ("config_type", "presets", "reset") if not hasattr(kind, one)]
    if missing:
        raise _broken(name, f"has no {', '.join(missing)}")
    config = getattr(simulator, "config", None)
    if not isinstance(config, kind.config_type):
        config = next(iter(kind.presets.values()))

    def build() -> Any:
        return with_advance(kind(config, seed=SEED))

    first = build()
    events = _run(first, name)
    if events != _run(build(), name):
        raise _broken(name, "gave other events for the same frames and seed")
    first.reset()
    if events != _run(first, name):
        raise _broken(name, "gave other events after reset than a new simulator")
    if not len(events):
        warn(f"simulator {name!r} gave no event, though every pixel of the clip changes threefold")


def _broken(name: str, problem: str) -> TexventError:
    """The error for a simulator that breaks the contract."""
    return TexventError(f"simulator {name!r} {problem}; see texvent/simulate/protocol.py")


def _run(simulator: Any, name: str) -> EventStream:
    """All events of the clip; packets and the frames that came back are checked."""
    given: list[int] = []
    found: list[int] = []
    packets: list[EventStream] = []

    def steps() -> Iterator[tuple[Any, Any]]:
        for pair in _pairs():
            given.extend([*pair.times_us, pair.second.t_us])
            yield from simulator.advance(pair)
        yield from simulator.finish()

    for frame, packet in steps():
        _check_packet(frame, packet, found[-1] if found else None, name)
        found.append(frame.t_us)
        packets.append(packet)
    sources = [t_us for t_us in found if t_us in TIMES_US]
    if sources != list(TIMES_US) or not set(found) <= set(given) or found != sorted(set(found)):
        raise _broken(
            name, f"gave back frames at {found} µs of {given}; each source frame must come once"
        )
    try:
        whole = EventStream.concat(packets)
    except TexventError as error:
        raise _broken(name, f"gave packets that do not follow each other ({error})") from error
    order = np.lexsort((whole.p, whole.x, whole.y, whole.t))
    if np.any(order[1:] < order[:-1]):
        raise _broken(name, "gave events of one time out of order; ties go by (t, y, x, p)")
    return whole


def _check_packet(frame: Any, packet: Any, start_us: int | None, name: str) -> None:
    """Refuse a packet outside `[t of the frame before, t of this frame)`, or of wrong columns."""
    if not (isinstance(frame, Frame) and isinstance(packet, EventStream)):
        kinds = f"{type(frame).__name__} and {type(packet).__name__}"
        raise _broken(name, f"gave {kinds}; it must give a Frame and an EventStream")
    if packet.size != frame.size:
        raise _broken(name, f"gave events of {packet.size} for frames of {frame.size}")
    if not len(packet):
        return
    if start_us is None:
        raise _broken(name, f"gave {len(packet):,} events for the first frame; it has none")
    limits = {"x": packet.size.width, "y": packet.size.height, "p": 2, "label": 2}
    for column, values in packet.columns().items():
        if values.dtype != COLUMN_TYPES[column]:
            wanted = np.dtype(COLUMN_TYPES[column])
            raise _broken(name, f"gave {column} as {values.dtype}; it must be {wanted}")
        if column in limits and int(values.max()) >= limits[column]:
            allowed = f"0..{limits[column] - 1}"
            raise _broken(name, f"gave {column} up to {int(values.max())}; {allowed} is allowed")
    first, last = int(packet.t.min()), int(packet.t.max())
    if first < start_us or last >= frame.t_us:
        raise _broken(
            name,
            f"gave events from {first} to {last} µs for the interval from {start_us} to "
            f"{frame.t_us} µs, whose end does not belong to it",
        )


def _pairs() -> Iterator[FramePair]:
    """A texture that moves and gets brighter and darker, with intermediate frames by blending."""
    x, y = np.meshgrid(np.arange(WIDTH), np.arange(HEIGHT))
    frames = []
    for number, t_us in enumerate(TIMES_US):
        pattern = 0.5 + 0.25 * np.sin(0.7 * (x + 2 * number)) + 0.2 * np.sin(0.9 * y)
        level = 60.0 if number % 2 else 200.0
        frames.append(Frame((level * pattern).astype(np.uint8), t_us))
    yield FramePair(None, frames[0], SceneChange.NONE, (), ())
    for count, earlier, later in zip(INTERMEDIATE, frames[:-1], frames[1:], strict=True):
        shares = [(number + 1) / (count + 1) for number in range(count)]
        times = [round(earlier.t_us + share * (later.t_us - earlier.t_us)) for share in shares]
        between = [
            Frame(_blended(earlier, later, share), t_us, is_source=False)
            for share, t_us in zip(shares, times, strict=True)
        ]
        yield FramePair(earlier, later, SceneChange.NONE, times, between)


def _blended(earlier: Frame, later: Frame, share: float) -> Any:
    return np.asarray((1 - share) * earlier.luma + share * later.luma, np.float32)
