"""Frames given one by one, events at once: a run for callbacks, where frames cannot be pulled.

The same path as `texvent.pipeline`: what is pushed becomes a live stream, of which exactly one
frame is there when exactly one is asked for.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack
from dataclasses import replace
from fractions import Fraction
from typing import Any

from texvent.capture.linear_light import decode_light
from texvent.config import CaptureConfig
from texvent.errors import ConfigError
from texvent.events import EventStream
from texvent.interpolate.pairing import plan_pairs
from texvent.pipeline import select_events
from texvent.run.light import suit_light
from texvent.run.memory import check_memory
from texvent.run.prepare import check_run, warn_of_unread_weights
from texvent.run.settings import Settings
from texvent.sensor import SensorSize
from texvent.simulate.build import benefits_from_denser_frames, build_simulator
from texvent.simulate.model_options import draw_training_config
from texvent.video import Frame

USED_CAPTURE = ("white_level", "fit", "transfer")
"""Options of frames that have a meaning for pushed ones."""


class PushedSimulation:
    """A simulation that takes frames one by one.

    Args:
        settings: all options, as `resolve("simulate", ...)` gives them.
        size: size of the frames that will be pushed, pixels.

    Raises:
        ConfigError: an option needs frames that are not there yet.
        InputError: the pixels do not fit into memory, or weights are missing.

    Example:
        >>> import numpy as np
        >>> from texvent.run.settings import resolve
        >>> run = PushedSimulation(resolve("simulate", {"noise": "none"}), SensorSize(2, 1))
        >>> len(run.push(Frame(np.full((1, 2), 50, np.uint8), 0)))
        0
        >>> len(run.push(Frame(np.full((1, 2), 200, np.uint8), 10_000))) > 0
        True
    """

    def __init__(self, settings: Settings, size: SensorSize) -> None:
        check_pushable(settings)
        self._threads = ExitStack()  # a live stream has no thread to end
        self._frames = _PushedFrames(size)
        source, config = decode_light(self._frames, settings.source)
        if settings.size is not None or config.white_level is not None:
            from texvent.capture.prepare import PreparedFrames  # may bring OpenCV

            is_coded = source is self._frames
            source = PreparedFrames(source, config, size=settings.size, check_scale=is_coded)
        source, settings = suit_light(source, settings)
        self.size: SensorSize = source.size
        """Sensor size, pixels."""
        check_memory(settings, self.size)
        if settings.run.randomize != "none":
            drawn = draw_training_config(
                settings.simulate, settings.run.randomize, seed=settings.run.seed
            )
            settings = replace(settings, simulate=drawn)
        self._run = settings.run
        self._simulator = build_simulator(settings.run, settings.simulate)
        self._pairs = plan_pairs(
            source,
            settings.interpolate,
            self._threads,
            balance=self._simulator.balance,
            contrast_threshold=self._simulator.contrast_threshold,
            counts_motion=benefits_from_denser_frames(self._simulator),
        )

    def push(self, frame: Frame) -> EventStream:
        """The events between the frame before and this one; none for the first frame.

        A model that needs later frames gives its events later, the last ones in `finish`.

        Raises:
            InputError: another size, a time that does not increase, or a bad intensity; no frame
                can be pushed after that.
        """
        self._frames.waiting.append(frame)
        pair = next(self._pairs)
        return self._joined(self._simulator.advance(pair))

    def finish(self) -> EventStream:
        """The events that the model held back; no frame can be pushed after that."""
        return self._joined(self._simulator.finish())

    def _joined(self, packets: Iterator[tuple[Frame, EventStream]]) -> EventStream:
        kept = [select_events(packet, self._run) for _, packet in packets]
        return EventStream.concat([EventStream.empty(self.size), *kept])


def check_pushable(settings: Settings) -> None:
    """Refuse options that need more than the frames so far.

    Raises:
        ConfigError: there is one; or as `check_run`.
    """
    plain = CaptureConfig(**{name: getattr(settings.source, name) for name in USED_CAPTURE})
    for name, value in vars(settings.source).items():
        if value != getattr(plain, name):
            raise ConfigError(
                f"{name} is for videos and files, and here frames arrive one by one; leave it out"
            )
    if settings.run.target_rate is not None:
        raise ConfigError(
            "target_rate reads the first second of a video twice, and here frames arrive one by "
            "one; set contrast_threshold"
        )
    if settings.interpolate.interpolate in ("motion", "exact"):
        raise ConfigError(
            f"interpolate is {settings.interpolate.interpolate}, which needs more than frames; "
            "choose flow, blend, rife or none"
        )
    check_run(settings)
    warn_of_unread_weights(settings.interpolate)


class _PushedFrames:
    """A stream of the frames that were pushed."""

    fps: Fraction | None = None
    frame_count: int | None = None
    is_live = True

    def __init__(self, size: SensorSize) -> None:
        self.size = size
        self.metadata: dict[str, Any] = {"kind": "pushed"}
        self.waiting: deque[Frame] = deque()

    def __iter__(self) -> Iterator[Frame]:
        while self.waiting:
            yield self.waiting.popleft()
