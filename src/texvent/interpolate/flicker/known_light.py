"""The light of a lamp around a pair of frames: taken off source frames, put back between them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.interpolate.flicker.fit_reference import waves
from texvent.interpolate.flicker.image_gain import STEADY
from texvent.transfer import WHITE, Transfer, decode_srgb, encode_srgb
from texvent.video import Frame

_LEVELS = decode_srgb(np.arange(256) / WHITE) * np.float32(WHITE)


@dataclass(frozen=True, eq=False)
class KnownLight:
    """What a lamp of known frequency adds to the light of frames near a time."""

    hz: float
    """Frequency of the light, Hz."""
    origin_us: int
    """Where the phase is 0, µs."""
    gain: tuple[float, float]
    """Modulation of the whole image by cosine and sine, as shares of its mean light."""
    pixel: NDArray[np.int64]
    """Flat indices of the pixels that follow the lamp beside that, [k]."""
    amplitude: NDArray[np.float32]
    """Their amplitudes of cosine and sine, linear light on the 0..255 scale, [k, 2]."""

    def take_off(self, frame: Frame) -> Frame:
        """A source frame as it would be under steady light, [H, W] float32 luma."""
        return self._lit(frame, is_on=False)

    def put_back(self, frames: Iterable[Frame]) -> Iterator[Frame]:
        """Frames of the steady scene, with the light of the lamp at their times."""
        for frame in frames:
            yield self._lit(frame, is_on=True)

    def _lit(self, frame: Frame, *, is_on: bool) -> Frame:
        cosine, sine = waves(np.array([frame.t_us]), self.origin_us, self.hz)[0]
        gain = 1 + self.gain[0] * cosine + self.gain[1] * sine
        added = self.amplitude[:, 0] * np.float32(cosine) + self.amplitude[:, 1] * np.float32(sine)
        luma = np.array(frame.luma, np.float32)
        if self.gain != STEADY:
            light = to_light(frame.luma, frame.transfer)
            changed = light * np.float32(gain if is_on else 1 / gain)
            changed.ravel()[self.pixel] += added * np.float32(gain) if is_on else -added
            luma = from_light(changed, frame.transfer)
        elif len(self.pixel):
            light = to_light(luma.ravel()[self.pixel], frame.transfer)
            luma.ravel()[self.pixel] = from_light(
                light + added if is_on else light - added, frame.transfer
            )
        return replace(frame, pixels=luma)


def to_light(luma: NDArray[Any], transfer: Transfer) -> NDArray[np.float32]:
    """Luma as linear light, 255 being white."""
    if transfer is Transfer.LINEAR:
        return np.asarray(luma, np.float32)
    if luma.dtype == np.uint8:
        return np.asarray(_LEVELS[luma])
    return decode_srgb(luma / np.float32(WHITE)) * np.float32(WHITE)


def from_light(light: NDArray[np.float32], transfer: Transfer) -> NDArray[np.float32]:
    """Linear light, 255 being white, as luma; light below 0 is none."""
    if transfer is Transfer.LINEAR:
        return np.maximum(light, np.float32(0))
    return encode_srgb(light / np.float32(WHITE))
