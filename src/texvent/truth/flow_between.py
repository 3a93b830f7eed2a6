"""Optical flow between any two instants, composed of that from frame to frame.

A point of the picture is followed from frame to frame, between two frames along a straight line at
constant speed. Between two frames that follow each other it is the stored flow itself; over several
steps it is read between pixels, bilinearly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SAME_SURFACE_PX = 1.0
"""Neighbouring pixels whose flow differs by more show different things, between which no flow is
read."""
SEARCH_STEPS = 10
FOUND_PX = 0.05
"""Largest error of a point that is sought in the frame before."""

Plane = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class FrameFlow:
    """Flow of a clip from frame to frame."""

    times_us: NDArray[np.int64]
    """[N] of the frames."""
    flow: NDArray[np.float32]
    """[N − 1, H, W, 2] px from each frame to the next; NaN where it is not known."""
    occluded: NDArray[np.bool_] | None = None
    """[N − 1, H, W] whether what a frame shows is hidden at the next; None: it is not known."""

    def between(self, start_us: int, stop_us: int) -> NDArray[np.float32]:
        """Flow from one instant to a later one, px.

        Returns:
            [2, H, W], x and y, of what each pixel shows at the start; NaN where it is not known:
            outside the time of the clip, and where it was hidden, or left the picture, before the
            last step.
        """
        times, shape = self.times_us, self.flow.shape[1:3]
        unknown = np.full((2, *shape), np.nan, np.float32)
        if len(times) < 2 or start_us < times[0] or stop_us > times[-1]:
            return unknown
        if start_us == stop_us:
            return np.zeros_like(unknown)
        places = np.indices(shape, np.float64)
        x, y = places[1], places[0]
        step = int(np.searchsorted(times, start_us, "right")) - 1
        moved = np.zeros((2, *shape))
        if (part := self._part(step, start_us)) > 0:
            moved = -part * self._found_before(step, x, y, part)
        total = moved.copy()
        while times[step] < stop_us:
            here = x + moved[0], y + moved[1]
            own = self._read(step, *here)
            total = moved + min(self._part(step, stop_us), 1.0) * own
            moved = moved + own
            moved[:, self._is_lost(step, *here)] = np.nan
            step += 1
        return total.astype(np.float32)

    def _part(self, step: int, t_us: int) -> float:
        """Share of a step that is over at an instant."""
        before, after = self.times_us[step : step + 2].tolist()
        return float((t_us - before) / (after - before))

    def _found_before(self, step: int, x: Plane, y: Plane, part: float) -> Plane:
        """Flow of the step of what a pixel shows when a part of it is over, sought by iteration."""
        own = np.nan_to_num(self._read(step, x, y, is_strict=False))
        for _ in range(SEARCH_STEPS):
            own = np.nan_to_num(
                self._read(step, x - part * own[0], y - part * own[1], is_strict=False)
            )
        place = x - part * own[0], y - part * own[1]
        found = self._read(step, *place)
        is_found = np.hypot(*(part * (found - own))) <= FOUND_PX
        return np.where(is_found & ~self._is_lost(step, *place), found, np.nan)

    def _read(self, step: int, x: Plane, y: Plane, *, is_strict: bool = True) -> Plane:
        """[2, H, W] flow of a step at places between pixels; NaN outside, and between surfaces."""
        flow = self.flow[step]
        height, width = flow.shape[:2]
        inside = (x >= 0) & (y >= 0) & (x <= width - 1) & (y <= height - 1)
        x, y = np.where(inside, x, 0.0), np.where(inside, y, 0.0)
        left, top = x.astype(np.int64), y.astype(np.int64)
        values, weights = [], []
        for below, right in ((0, 0), (0, 1), (1, 0), (1, 1)):
            rows, columns = np.minimum(top + below, height - 1), np.minimum(left + right, width - 1)
            values.append(np.moveaxis(flow[rows, columns].astype(np.float64), -1, 0))
            weights.append(np.abs(1 - below - (y - top)) * np.abs(1 - right - (x - left)))
        counts = np.array(weights)[:, None] > 0
        parts = np.where(counts, np.array(values), 0.0)
        found = (parts * np.array(weights)[:, None]).sum(axis=0)
        spread = np.where(counts, np.abs(parts - found), 0.0).max(axis=(0, 1))
        is_read = inside & (spread <= SAME_SURFACE_PX) if is_strict else inside
        return np.where(is_read, found, np.nan)

    def _is_lost(self, step: int, x: Plane, y: Plane) -> NDArray[np.bool_]:
        """Whether the pixel nearest to a place is hidden after a step."""
        if self.occluded is None:
            return np.zeros(x.shape, np.bool_)
        hidden = self.occluded[step]
        height, width = hidden.shape
        row, column = (np.nan_to_num(np.rint(one)).astype(np.int64) for one in (y, x))
        is_hidden = hidden[np.clip(row, 0, height - 1), np.clip(column, 0, width - 1)]
        return np.asarray(is_hidden, np.bool_)
