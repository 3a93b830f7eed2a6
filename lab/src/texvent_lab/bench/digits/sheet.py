"""Many digits side by side, moving as N-MNIST's did, as one stream that shows any instant.

In every pixel model a pixel knows nothing of its neighbours, so a digit gets the events on a sheet
that it gets alone, in a small part of the time. Between frames, optical flow is estimated; the
margins keep digits apart for it.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.camera_path.motion import DURATION_US, digit_corner
from texvent.events import EventStream
from texvent.frames import MICROSECONDS, Frame, frame_time_us
from texvent.sensor import SensorSize

TILE = 34
"""Width and height that a digit has on the sensor, px: N-MNIST's."""
MARGIN = 3
"""Pixels around a tile that show its background, and what leaves it."""
PITCH = TILE + 2 * MARGIN
FPS = Fraction(60)
"""Frame rate of the display."""
FRAMES = math.ceil(DURATION_US * FPS / MICROSECONDS) + 1
WHITE = 255.0


@dataclass(frozen=True)
class Stimulus:
    """Display and motion, and how much they differ between recordings, evenly to both sides."""

    amplitude: float
    """Range of the size of movements, ± share of the measured ones."""
    speed: float
    """Range of the speed of movements, ± share."""
    shift: float
    """Range of the start, ± px along x and y."""
    black: tuple[float, float]
    """Share of white that the display shows as black: lowest and highest."""
    gamma: float = 1.0
    """Exponent by which the display turns levels into light."""
    lead_ms: float = 0.0
    """Lead of the sensor's motion over `digit_corner`, ms: the latency of its pixels, which that
    path has in it, where the pixel model has latency of its own."""


WIDE = Stimulus(amplitude=0.2, speed=0.1, shift=1.0, black=(0.05, 0.2))
"""More motions than the sensor made, before a display of high contrast."""
MEASURED = Stimulus(amplitude=0.06, speed=0.01, shift=0.3, black=(0.5, 0.65), gamma=2.2)
"""As the 100 pairs for fitting have them: all but one follow one clock, ± 3 ms; the contrast is
that of a display in a lit room, its gamma an ordinary one (2.0 to 2.2, left free in the fit)."""


@dataclass(frozen=True, eq=False)
class Digits:
    """Digits, and how each is shown and moved."""

    images: NDArray[np.uint8]
    """[n, 28, 28]."""
    amplitude: NDArray[np.float64]
    """[n], 1 is the measured one."""
    speed: NDArray[np.float64]
    """[n], 1 is the measured one."""
    shift: NDArray[np.float64]
    """[n, 2] px along x and y."""
    black: NDArray[np.float64]
    """[n] level 0..255 of the background."""
    gamma: float = 1.0
    """See `Stimulus`."""
    lead_ms: float = 0.0
    """See `Stimulus`."""

    @classmethod
    def draw(
        cls,
        images: NDArray[np.uint8],
        numbers: NDArray[np.int64],
        seed: int,
        stimulus: Stimulus = WIDE,
    ) -> Digits:
        """Draw motion and contrast; they depend on (seed, number of the image) alone.

        Args:
            images: [n, 28, 28].
            numbers: [n] of the images in their file.
            seed: of all.
            stimulus: the range of motions and contrasts.
        """
        chances = np.stack([np.random.default_rng((seed, int(one))).random(5) for one in numbers])
        signed = 2 * chances - 1
        low, high = stimulus.black
        return cls(
            images=images,
            amplitude=1 + stimulus.amplitude * signed[:, 0],
            speed=1 + stimulus.speed * signed[:, 1],
            shift=stimulus.shift * signed[:, 2:4],
            black=WHITE * (low + (high - low) * chances[:, 4]),
            gamma=stimulus.gamma,
            lead_ms=stimulus.lead_ms,
        )

    @classmethod
    def as_measured(cls, images: NDArray[np.uint8], stimulus: Stimulus = WIDE) -> Digits:
        """With the measured motion and the middle contrast of a stimulus."""
        count = len(images)
        return cls(
            images=images,
            amplitude=np.ones(count),
            speed=np.ones(count),
            shift=np.zeros((count, 2)),
            black=np.full(count, WHITE * sum(stimulus.black) / 2),
            gamma=stimulus.gamma,
            lead_ms=stimulus.lead_ms,
        )


@dataclass(frozen=True, eq=False)
class DigitSheet:
    """A `RenderableStream`: 60 frames per second, and any instant between them."""

    digits: Digits
    fps: Fraction = FPS
    frame_count: int = FRAMES
    is_live: bool = False

    @property
    def metadata(self) -> Mapping[str, Any]:
        """Nothing: the benchmark stores what it draws from."""
        return {}

    @property
    def size(self) -> SensorSize:
        """Size of the sheet, px."""
        rows = math.ceil(len(self.digits.images) / self._columns)
        return SensorSize(PITCH * self._columns, PITCH * rows)

    def __iter__(self) -> Iterator[Frame]:
        for index in range(self.frame_count):
            t_us = frame_time_us(index, self.fps)
            yield Frame(self._render(t_us), t_us)

    def at(self, t_us: int) -> Frame:
        """The frame at any instant."""
        return Frame(self._render(t_us), t_us, is_source=False)

    def cut(self, images: NDArray[Any]) -> NDArray[Any]:
        """Parts of images that belong to each digit.

        Args:
            images: [..., H, W] of the sheet.

        Returns:
            [n, ..., 34, 34].
        """
        rows = images.shape[-2] // PITCH
        tiles = images.reshape(*images.shape[:-2], rows, PITCH, self._columns, PITCH)
        tiles = np.moveaxis(tiles, (-4, -2), (0, 1)).reshape(-1, *images.shape[:-2], PITCH, PITCH)
        inside = slice(MARGIN, MARGIN + TILE)
        return tiles[: len(self.digits.images), ..., inside, inside]

    def lay_out(self, recordings: Sequence[EventStream]) -> EventStream:
        """Recordings of 34×34 px, one per digit, as one recording of the sheet."""
        numbers = np.repeat(np.arange(len(recordings)), [len(one) for one in recordings])
        x, y, t, p = (np.concatenate([getattr(one, name) for one in recordings]) for name in "xytp")
        x = (x + numbers % self._columns * PITCH + MARGIN).astype(np.uint16)
        y = (y + numbers // self._columns * PITCH + MARGIN).astype(np.uint16)
        order = np.argsort(t, kind="stable")
        return EventStream(x[order], y[order], t[order], p[order], self.size)

    @property
    def _columns(self) -> int:
        return math.ceil(math.sqrt(len(self.digits.images)))

    @cached_property
    def _padded(self) -> NDArray[np.float32]:
        """[n, 28 + 2 PITCH, 28 + 2 PITCH]: each digit, 0..1, amid more background than it needs."""
        around = (PITCH, PITCH)
        light = (self.digits.images.astype(np.float32) / WHITE) ** np.float32(self.digits.gamma)
        return np.pad(light, ((0, 0), around, around))

    def _render(self, t_us: int) -> NDArray[np.float32]:
        """[H, W] levels; a pixel has the mean over its area of a digit of square pixels."""
        digits = self.digits
        path = digit_corner(t_us + 1000 * digits.lead_ms, digits.speed, digits.amplitude)
        corner = MARGIN + digits.shift + path
        first = np.floor(corner).astype(np.int64)
        part = (corner - first).astype(np.float32)
        reach = np.arange(PITCH - 1, 2 * PITCH)
        x, y = (reach - first[:, axis, None] for axis in (0, 1))
        number = np.arange(len(x))[:, None, None]
        cells = self._padded[number, y[:, :, None], x[:, None, :]]
        part_x, part_y = part[:, 0, None, None], part[:, 1, None, None]
        rows = cells[:, 1:] * (1 - part_y) + cells[:, :-1] * part_y
        cover = rows[:, :, 1:] * (1 - part_x) + rows[:, :, :-1] * part_x
        black = digits.black.astype(np.float32)[:, None, None]
        return self._tile(black + (np.float32(WHITE) - black) * cover)

    def _tile(self, tiles: NDArray[np.float32]) -> NDArray[np.float32]:
        """[n, PITCH, PITCH] side by side, row by row; what is left over is black."""
        width, height = self.size
        rows = height // PITCH
        whole = np.zeros((rows * self._columns, PITCH, PITCH), np.float32)
        whole[: len(tiles)] = tiles
        grid = whole.reshape(rows, self._columns, PITCH, PITCH).swapaxes(1, 2)
        return grid.reshape(height, width)
