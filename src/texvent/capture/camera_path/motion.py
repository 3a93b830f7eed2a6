"""Camera poses over an image, and the paths that a camera can take: saccades, shake, pan.

The saccades are N-MNIST's, measured on pairs of a digit and its recording: a digit of 28×28 px is
shown on a sensor of 34×34 px, and its corner moves. The benchmark of digits uses the same numbers.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.config import CAMERA_AMPLITUDES, check_range
from texvent.frames import MICROSECONDS

Float64Array = NDArray[np.float64]


@dataclass(frozen=True)
class CameraPose2D:
    """Place of the camera, in px of the sensor, from where the image was taken."""

    x: float = 0.0
    """Shift of its view to the right of the image's centre, px: the image moves to the left."""
    y: float = 0.0
    """Shift of its view below the centre, px."""


class CameraPath(Protocol):
    """A path that is known at any instant."""

    @property
    def seconds(self) -> float:
        """Its duration, unless another one is asked for, s."""
        ...

    @property
    def facts(self) -> Mapping[str, Any]:
        """Its description, JSON-serialisable, for provenance."""
        ...

    def __call__(self, t_us: float) -> CameraPose2D:
        """Place of the camera at `t_us`, µs."""
        ...


class Segment(NamedTuple):
    """A movement along one axis; those of an axis add up."""

    start_ms: float
    stop_ms: float
    distance: float
    """px."""


START = np.array([0.44, 0.52])
"""x and y of the digit's corner at rest, px."""
SEGMENTS: tuple[tuple[Segment, ...], tuple[Segment, ...]] = (
    (
        *(Segment(2, 38, -0.14), Segment(39, 88, 1.49), Segment(86, 150, 1.2)),
        *(Segment(115, 160, 1.28), Segment(124, 229, 1.13), Segment(217, 305, -4.96)),
    ),
    (
        *(Segment(4, 83, 5.27), Segment(115, 188, -5.11), Segment(186, 213, 0.13)),
        *(Segment(216, 245, -0.22), Segment(235, 260, 0.22), Segment(257, 294, -0.4)),
    ),
)
"""Along x and y; the camera comes back to where it began. Fitted to positions every 5 ms, 0.05 px
rms away from them: those by which 100 digits best explain the signed events of their recordings,
each with its own shift, size and delay."""
DURATION_US = 315_000
"""Three movements of 105 ms, as the camera's program made them."""


def digit_corner(t_us: float, speed: Float64Array, amplitude: Float64Array) -> Float64Array:
    """Place of the corner of digits.

    Args:
        t_us: since the recording began, µs.
        speed: of each recording, 1 is the measured one, [n].
        amplitude: of each recording's movement, 1 is the measured one, [n].

    Returns:
        [n, 2] x and y, px.

    Source of the shape: minimum jerk, T. Flash and N. Hogan, "The coordination of arm movements",
        J. Neurosci. 1985.
    """
    t_ms = t_us / 1000 * speed
    moved = np.zeros((2, len(t_ms)))
    for axis, segments in enumerate(SEGMENTS):
        for one in segments:
            part = (t_ms - one.start_ms) / (one.stop_ms - one.start_ms)
            moved[axis] += one.distance * _minimum_jerk(part)
    return START + amplitude[:, None] * moved.T


def _minimum_jerk(part: Float64Array) -> Float64Array:
    """Share of the way after a share of the time."""
    u = np.clip(part, 0.0, 1.0)
    return np.asarray(u**3 * (10 - 15 * u + 6 * u**2))


@dataclass(frozen=True)
class Saccades:
    """N-MNIST's three saccades, measured; the camera is still before, between and after them."""

    amplitude: float | None = None
    """Length of the longest one along an axis, px; None: as measured."""
    name: ClassVar[str] = "saccade"
    seconds: ClassVar[float] = DURATION_US / MICROSECONDS
    measured_px: ClassVar[float] = 5.4
    """Down, the first one."""
    middle: ClassVar[tuple[float, float]] = (2.85, 3.1)
    """Middle of the path of the digit's corner, px."""

    def __post_init__(self) -> None:
        check_range("amplitude", self.amplitude, *CAMERA_AMPLITUDES)

    @property
    def facts(self) -> Mapping[str, Any]:
        """Its name and size."""
        return {"camera": self.name, "amplitude_px": self.amplitude or self.measured_px}

    def __call__(self, t_us: float) -> CameraPose2D:
        """The image moves as the digits of N-MNIST, about the middle of their path."""
        one = np.ones(1)
        factor = (self.amplitude or self.measured_px) / self.measured_px
        x, y = digit_corner(t_us, one, one)[0]
        return CameraPose2D(factor * (self.middle[0] - x), factor * (self.middle[1] - y))


@dataclass(frozen=True)
class Shake:
    """A camera held by hand: a sum of sinusoids along x and another along y.

    There is one in each of `count` equal bands from `lowest_hz` to `highest_hz`; its frequency
    and its phase are drawn from the seed, and its amplitude falls with the frequency as 1 / f.

    Raises:
        ConfigError: the amplitude or the seed is out of range.
    """

    amplitude: float | None = None
    """Root mean square along each axis, px."""
    seed: int = 0
    name: ClassVar[str] = "shake"
    seconds: ClassVar[float] = 1.0
    usual_px: ClassVar[float] = 2.0
    lowest_hz: ClassVar[float] = 1.0
    highest_hz: ClassVar[float] = 12.0
    """Physiological tremor of the hand is at 8 to 12 Hz; slower sway is larger."""
    count: ClassVar[int] = 22
    _waves: Float64Array = field(init=False, repr=False, compare=False)
    """[2, 3, count] angular frequency, 1/µs; phase; amplitude, px."""

    def __post_init__(self) -> None:
        check_range("amplitude", self.amplitude, *CAMERA_AMPLITUDES)
        check_range("seed", self.seed, 0, 2**63 - 1)
        chance = np.random.default_rng([self.seed, SHAKE_KEY])
        draws = chance.random((2, 2, self.count))
        width = (self.highest_hz - self.lowest_hz) / self.count
        hertz = self.lowest_hz + width * (np.arange(self.count) + draws[:, 0])
        amplitude = 1.0 / hertz
        rms = np.sqrt((amplitude**2).sum(axis=1, keepdims=True) / 2)
        amplitude *= (self.amplitude or self.usual_px) / rms
        angular, phase = 2 * math.pi * hertz / MICROSECONDS, 2 * math.pi * draws[:, 1]
        object.__setattr__(self, "_waves", np.stack([angular, phase, amplitude], axis=1))

    @property
    def facts(self) -> Mapping[str, Any]:
        """Its name, size and seed."""
        size = self.amplitude or self.usual_px
        return {"camera": self.name, "amplitude_px": size, "camera_seed": self.seed}

    def __call__(self, t_us: float) -> CameraPose2D:
        """The sum at `t_us`."""
        angular, phase, amplitude = self._waves[:, 0], self._waves[:, 1], self._waves[:, 2]
        x, y = (amplitude * np.sin(angular * t_us + phase)).sum(axis=1)
        return CameraPose2D(float(x), float(y))


SHAKE_KEY = 0x5AAE
"""Keeps the draws of the path apart from other draws of a seed."""


@dataclass(frozen=True)
class Pan:
    """The camera turns to the right at constant speed; half way it looks at the image's centre."""

    amplitude: float | None = None
    """Speed, px/s."""
    seconds: float = 1.0
    name: ClassVar[str] = "pan"
    usual_px: ClassVar[float] = 60.0

    def __post_init__(self) -> None:
        check_range("amplitude", self.amplitude, *CAMERA_AMPLITUDES)
        check_range("seconds", self.seconds, 0.0)

    @property
    def facts(self) -> Mapping[str, Any]:
        """Its name and speed."""
        return {"camera": self.name, "amplitude_px": self.amplitude or self.usual_px}

    def __call__(self, t_us: float) -> CameraPose2D:
        """On its way at `t_us`."""
        speed = self.amplitude or self.usual_px
        return CameraPose2D(speed * (t_us / MICROSECONDS - self.seconds / 2))
