"""Events of a batch of clips, in tensors of the device that made them."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from texvent.events import EventStream
from texvent.represent.tensors import EventTensors
from texvent.sensor import SensorSize
from texvent.simulate.gpu.kernel_types import Tensor


@dataclass(frozen=True, eq=False)
class EventBatch:
    """The events of all clips, clip by clip, each sorted by (t, y, x, p, label)."""

    x: Tensor
    """Column, pixels, [n] int32."""
    y: Tensor
    """Row, pixels from the top, [n] int32."""
    t: Tensor
    """Time, µs, [n] int64."""
    p: Tensor
    """Polarity, [n] int8: 1 = ON, 0 = OFF."""
    label: Tensor
    """[n] int8: `events.SIGNAL` or `events.NOISE`."""
    clip_offsets: Tensor
    """[B + 1] int64: where the events of each clip begin, and n; on the same device."""
    size: SensorSize
    """Width and height of the sensor, pixels."""
    frame_ends: NDArray[np.int64] = field(repr=False)
    """[B, T + 1] on the host: where the events of each interval begin, and where the last ends."""

    def __len__(self) -> int:
        return len(self.t)

    @property
    def clips(self) -> int:
        """B."""
        return len(self.frame_ends)

    def clip(self, index: int) -> EventTensors:
        """The events of one clip, without a copy; every representation takes them.

        `EventTensors` checks what it is given, which waits for the device.
        """
        part = self._part(index)
        return EventTensors(self.x[part], self.y[part], self.t[part], self.p[part], self.size)

    def stream(self, index: int) -> EventStream:
        """The events of one clip, copied to the host."""
        part = self._part(index)
        x, y, t, p, label = (
            column[part].cpu().numpy() for column in (self.x, self.y, self.t, self.p, self.label)
        )
        return EventStream(
            x.astype(np.uint16), y.astype(np.uint16), t, p.astype(np.uint8), self.size,
            label=label.astype(np.uint8),
        )  # fmt: skip

    def _part(self, index: int) -> slice:
        ends = self.frame_ends[index]
        return slice(int(ends[0]), int(ends[-1]))
