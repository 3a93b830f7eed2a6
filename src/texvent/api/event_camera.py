"""Event camera: frames one by one, the events of each at once.

For callbacks, live input and closed loops, where the next frame may depend on the events. The path
is that of `texvent.pipeline`: the frames are a live stream, of which one frame is there when one is
asked for.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from contextlib import ExitStack
from fractions import Fraction
from pathlib import Path
from typing import Any, Self, Unpack

from texvent.capture.intensity_scale import caller_pixels
from texvent.capture.linear_light import decode_light
from texvent.capture.scale_check import check_frames
from texvent.config import CaptureConfig
from texvent.errors import ConfigError, InputError
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.options.arrays import whole_us
from texvent.options.keywords import SimulateOptions, naming_options
from texvent.pairs.frame_pair import FramePair
from texvent.pipeline import select_events, video_to_events
from texvent.run.prepare import check_memory, check_run
from texvent.sensor import SensorSize, SizeLike, as_size
from texvent.settings.resolution import Settings, resolve
from texvent.simulation.protocol import Simulator

USED_CAPTURE = ("white_level", "fit", "transfer")
"""Options of recorded frames that have a meaning for single ones."""


class EventCamera:
    """Simulated event camera that takes frames one by one.

    The events of all steps are those of `texvent.simulate` for the same frames and options.

    Args:
        size: size of the frames, as (width, height), "346x260" or the name of a sensor; it must
            be given.
        config: a TOML or YAML file with options.
        **options: those of `texvent.simulate`, such as `seed=3` or `contrast_threshold=0.2`, but
            for those that need a whole recording. `sensor` gives the camera another size than the
            frames.

    Raises:
        ConfigError: no size, an unknown option, a value out of range, or an option that needs later
            frames.
        InputError: weights are missing, or the pixels do not fit into memory.

    Example:
        >>> import numpy as np
        >>> from texvent import EventCamera
        >>> with EventCamera((2, 1), noise="none") as camera:
        ...     first = camera.step(np.full((1, 2), 50, np.uint8), 0)
        ...     second = camera.step(np.full((1, 2), 200, np.uint8), 10_000)
        >>> len(first), len(second) > 0
        (0, True)
    """

    @naming_options(SimulateOptions)
    def __init__(
        self,
        size: SizeLike | None = None,
        *,
        config: str | Path | None = None,
        **options: Unpack[SimulateOptions],
    ) -> None:
        if size is None:
            raise ConfigError(
                "name the size of the frames: EventCamera((640, 480)), EventCamera('davis346')"
            )
        self.frame_size: SensorSize = as_size(size)
        """Size of the frames, pixels."""
        self.settings: Settings = resolve("simulate", options, config=config)
        """All options, resolved."""
        check_steps(self.settings)
        self._threads = ExitStack()
        self._frames: deque[Frame] = deque()
        self._simulator: Simulator
        self._pairs: Iterator[FramePair]
        self.size: SensorSize = self._start()
        """Size of the sensor, pixels."""
        self._stopped: str | None = None

    def step(self, frame: Any, t_us: int) -> EventStream:
        """Events between the previous frame and this one; none for the first frame.

        A model that needs later frames gives its events later, the last ones in `finish`.

        Args:
            frame: [H, W] or [H, W, 3] (RGB), as an image of `texvent.simulate`: uint8, uint16 or
                float on the 0..255 scale; it is copied, so the array may be filled again.
            t_us: its time, whole µs.

        Raises:
            InputError: another size, a time that does not increase, an intensity out of range,
                or a camera that was stopped by such an error, `finish` or `close`; `reset` starts
                it again.

        Warns:
            TexventWarning: frames are probably 0..1 or of fewer bits, or times no µs, as soon as
                that is clear.

        Example:
            >>> import numpy as np, texvent
            >>> camera = texvent.EventCamera("2x1", interpolate="none", noise="none")
            >>> images = np.array([[[50, 50]], [[50, 200]]], np.uint8)
            >>> [camera.step(image, 1000 * n).x.tolist() for n, image in enumerate(images)]
            [[], [1, 1, 1, 1, 1]]
        """
        if self._stopped is not None:
            raise InputError(f"the event camera {self._stopped}; reset() starts it again")
        t_us = whole_us(t_us, "t_us")
        source = Frame(caller_pixels(frame, f"the frame at {t_us} µs"), t_us)
        if source.size != self.frame_size:
            raise InputError(
                f"the frame is {source.size}; this event camera takes {self.frame_size}"
            )
        self._stopped = "stopped at an error"
        self._frames.append(source)
        events = self._joined(self._simulator.advance(next(self._pairs)))
        self._stopped = None
        return events

    def finish(self) -> EventStream:
        """Events that the model held back; they end the recording.

        Example:
            >>> import numpy as np, texvent
            >>> camera = texvent.EventCamera("2x1", noise="none")
            >>> for n in range(2):
            ...     events = camera.step(np.full((1, 2), 50 + 99 * n, np.uint8), 1000 * n)
            >>> camera.finish()
            EventStream(0 events, 2x1)
        """
        if self._stopped is not None:
            return EventStream.empty(self.size)
        events = self._joined(self._simulator.finish())
        self._stopped = "was finished"
        self._checked.conclude()
        return events

    def reset(self) -> None:
        """Begin a new recording with the same options, as if no frame had been given.

        Example:
            >>> import numpy as np, texvent
            >>> camera, image = texvent.EventCamera("2x1"), np.full((1, 2), 50, np.uint8)
            >>> camera.step(image, 1000), camera.reset(), camera.step(image, 0)
            (EventStream(0 events, 2x1), None, EventStream(0 events, 2x1))
        """
        self._threads.close()
        self._frames.clear()
        self.size = self._start()
        self._stopped = None

    def close(self) -> None:
        """Free what the camera holds; nothing happens if it is closed already.

        Example:
            >>> import numpy as np, texvent
            >>> camera = texvent.EventCamera("2x1")
            >>> events = camera.step(np.zeros((1, 2), np.uint8), 0)
            >>> camera.close()
        """
        self._threads.close()
        if self._stopped is None:
            self._checked.conclude()
        self._stopped = "was closed"

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _start(self) -> SensorSize:
        stepped = _SteppedFrames(self.frame_size, self._frames)
        self._checked = check_frames(stepped, self.settings.source, only_warns=True)
        video, capture = decode_light(self._checked, self.settings.source)
        if self.settings.size is not None or capture.white_level is not None:
            from texvent.capture.prepare import PreparedFrames  # may bring OpenCV

            video = PreparedFrames(video, capture, size=self.settings.size)
        check_memory(self.settings, video.size)
        simulation = video_to_events(video, self.settings)
        self._simulator, self._pairs = simulation.begin(self._threads)
        return video.size

    def _joined(self, packets: Iterator[tuple[Frame, EventStream]]) -> EventStream:
        kept = [select_events(packet, self.settings.run) for _, packet in packets]
        return EventStream.concat([EventStream.empty(self.size), *kept])


def check_steps(settings: Settings) -> None:
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


class _SteppedFrames:
    """Stream of the frames that were given so far."""

    fps: Fraction | None = None
    frame_count: int | None = None
    is_live = True

    def __init__(self, size: SensorSize, waiting: deque[Frame]) -> None:
        self.size = size
        self.metadata: dict[str, Any] = {"kind": "stepped"}
        self._waiting = waiting

    def __iter__(self) -> Iterator[Frame]:
        while self._waiting:
            yield self._waiting.popleft()
