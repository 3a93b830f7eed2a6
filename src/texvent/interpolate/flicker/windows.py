"""Source frames with the light of a lamp around each of them; a window of frames slides along."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from texvent.errors import warn
from texvent.interpolate.flicker.fit_reference import WINDOW_FRAMES, design_fit, together, waves
from texvent.interpolate.flicker.image_gain import STEADY, fit_gain
from texvent.interpolate.flicker.known_light import KnownLight, to_light
from texvent.pairs.deflicker import measure_gain
from texvent.transfer import Transfer
from texvent.video import Frame, frame_time_us

BYTES_PER_PIXEL = 150
"""Memory of the frames of a window, as they came and as light, and of a fit."""


def with_light(
    frames: Iterable[Frame], hz: float, *, looks_ahead: bool = True
) -> Iterator[tuple[Frame, KnownLight | None]]:
    """The frames, each with the light that a lamp adds to it and to those before it.

    The fit looks at `WINDOW_FRAMES` frames, with the frame in their middle; at both ends of a
    clip at the first and the last ones. A warning says if none of them shows the lamp.

    Args:
        frames: source frames in time order.
        hz: frequency of the light, Hz.
        looks_ahead: False for a live source: the window ends with the frame itself.

    Yields:
        (the frame as it came, the light); None where no pixel follows the lamp.
    """
    window = _Window(hz)
    left = 0  # frames of the window that were not yielded
    was_found = False
    for frame in frames:
        window.add(frame)
        left += 1
        middle = WINDOW_FRAMES // 2 if looks_ahead else 0
        while left > middle and (window.is_full or not looks_ahead):
            light = window.light()
            was_found |= light is not None
            yield window.frames[-left], light
            left -= 1
    while left:
        light = window.light()
        was_found |= light is not None
        yield window.frames[-left], light
        left -= 1
    if not was_found:
        warn(f"lamp_hz: no part of the video follows a lamp of {hz:g} Hz; nothing was changed")


class _Window:
    """The last frames, and what a lamp adds to them."""

    def __init__(self, hz: float) -> None:
        self._hz = hz
        self.frames: deque[Frame] = deque(maxlen=WINDOW_FRAMES)
        self._light: deque[NDArray[np.float32]] = deque(maxlen=WINDOW_FRAMES)
        self._log_gains: deque[float] = deque(maxlen=WINDOW_FRAMES - 1)
        self._found: KnownLight | None = None
        self._is_fitted = False

    @property
    def is_full(self) -> bool:
        """Whether a further frame drops the first one."""
        return len(self.frames) == WINDOW_FRAMES

    def add(self, frame: Frame) -> None:
        """Take a frame in, and the first one out if there are too many."""
        light = to_light(frame.luma, frame.transfer)
        if self.frames:
            earlier, later = (
                Frame(one, 0, transfer=Transfer.LINEAR) for one in (self._light[-1], light)
            )
            self._log_gains.append(measure_gain(earlier, later)[0])
        self.frames.append(frame)
        self._light.append(light)
        self._is_fitted = False

    def light(self) -> KnownLight | None:
        """What the lamp adds to these frames, or None."""
        if not self._is_fitted:
            self._found, self._is_fitted = self._fit(), True
        return self._found

    def _fit(self) -> KnownLight | None:
        from texvent.interpolate.flicker.fit_cpu import fit_pixels  # brings Numba

        times_us = np.array([frame.t_us for frame in self.frames], np.int64)
        origin_us = int(times_us[0])
        design = design_fit(times_us, origin_us, self._hz)
        if not design.is_enough:
            return None
        gain = fit_gain(np.array(self._log_gains), times_us, origin_us, self._hz)
        inverse = 1 / (1 + waves(times_us, origin_us, self._hz) @ gain)
        alone, amplitude = fit_pixels(np.stack(self._light), inverse, design)
        pixel = np.flatnonzero(together(alone))
        if gain == STEADY and not len(pixel):
            return None
        return KnownLight(self._hz, origin_us, gain, pixel, amplitude.reshape(-1, 2)[pixel])


def can_be_seen(hz: float, fps: Fraction | None) -> bool:
    """Whether frames at a rate may show a lamp; a warning says why not.

    Args:
        hz: frequency of the light, Hz.
        fps: frames per second; None where they are irregular, which may show any lamp.
    """
    if fps is None:
        return True
    times_us = np.array([frame_time_us(index, fps) for index in range(WINDOW_FRAMES)], np.int64)
    is_seen = design_fit(times_us, 0, hz).is_enough
    if not is_seen:
        warn(
            f"lamp_hz: frames at {float(fps):g} per second show light of {hz:g} Hz as "
            f"{alias_hz(hz, fps):.3g} Hz, which {WINDOW_FRAMES} frames cannot tell; it is left "
            "as it is"
        )
    return is_seen


def alias_hz(hz: float, fps: Fraction) -> float:
    """At which frequency frames show a faster one, 0..fps/2.

    Example:
        >>> round(alias_hz(37.0, Fraction(24)), 9), round(alias_hz(100.0, Fraction(25)), 9)
        (11.0, 0.0)
    """
    rate = float(fps)
    return abs(hz - round(hz / rate) * rate)
