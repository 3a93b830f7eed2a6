"""One sub-interval as the Texvent model sees it: its time and the brightness at both ends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from texvent.simulate.packets.interval import FrameInterval

Float64Array = NDArray[np.float64]


class FiredPixels(Protocol):
    """What the times of events are made from: brightness at both ends where pixels fired."""

    @property
    def span(self) -> FrameInterval:
        """Time of both frames, and the key of the random draws between them."""
        ...

    @property
    def width(self) -> int:
        """Of the frame, pixels."""
        ...

    def at(self, pixel: NDArray[np.int64]) -> tuple[Float64Array, Float64Array, Float64Array]:
        """Previous brightness, brightness and reference of some pixels that fired, [n] each."""
        ...


@dataclass(frozen=True, eq=False)
class SubInterval:
    """What is compared with what between two neighbouring frames, and when."""

    span: FrameInterval
    """Time of both frames, and the key of the random draws between them."""
    previous: Float64Array
    """Brightness at the start, L(α + I^{j−1}), [H, W], log units."""
    brightness: Float64Array
    """Brightness at the end, L(α + I^j), [H, W], log units."""
    reference: Float64Array
    """Reference brightness the pixels compare with, L(α + κ ⋄ I^{j−1}), [H, W], log units."""

    @property
    def width(self) -> int:
        """Of the frame, pixels."""
        return int(self.brightness.shape[1])

    def at(self, pixel: NDArray[np.int64]) -> tuple[Float64Array, Float64Array, Float64Array]:
        """Previous brightness, brightness and reference of some pixels, [n] each."""
        images = (self.previous, self.brightness, self.reference)
        previous, brightness, reference = (image.reshape(-1)[pixel] for image in images)
        return previous, brightness, reference


class SparseInterval(NamedTuple):
    """The same where only the brightness of the pixels that fired is known."""

    span: FrameInterval
    width: int
    pixel: NDArray[np.int64]
    """[n] flat index y · W + x of the pixels that fired, ascending."""
    brightness: tuple[Float64Array, Float64Array, Float64Array]
    """Previous brightness, brightness and reference of each, [n] log units."""

    def at(self, pixel: NDArray[np.int64]) -> tuple[Float64Array, Float64Array, Float64Array]:
        """See `FiredPixels`."""
        row = np.searchsorted(self.pixel, pixel)
        previous, brightness, reference = (column[row] for column in self.brightness)
        return previous, brightness, reference
