"""The definition of the paper's pixel model (Eqs. 5-7), on whole frames in the paper's order."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log, check_intensity
from texvent.events import NOISE, EventStream
from texvent.frames import Frame
from texvent.simulation.packets import FrameInterval, UnsortedEvents
from texvent.simulation.random.draws import Purpose, draw_uniforms
from texvent.simulation.streaming import make_packet
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.noise import draw_noise, draw_voltage_noise

Float64Array = NDArray[np.float64]


class TexventPixels:
    """All pixels of a sensor, as whole frames of brightness."""

    def __init__(self, config: TexventConfig, frame: Frame, where: str) -> None:
        check_intensity(frame.pixels, where)
        self._config, self._last = config, frame
        self._brightness = balanced_log(frame.luma, config.balance)
        self._reference = self._brightness.copy()
        self._decayed_us: int | None = None

    def advance(self, frame: Frame, span: FrameInterval, where: str) -> EventStream:
        """Events until this frame."""
        check_intensity(frame.pixels, where)
        config = self._config
        brightness = balanced_log(frame.luma, config.balance)
        shaken = brightness
        if config.noise == "gaussian":
            shaken = brightness + draw_voltage_noise(
                brightness.shape,
                span.key,
                threshold=config.contrast_threshold,
                mean=config.expected_noise(span.duration_s),
            )
        self._renew()
        change, without_noise = shaken - self._reference, brightness - self._reference
        fires, signal = (abs(one) >= config.contrast_threshold for one in (change, without_noise))
        events = self._timed(fires, change, shaken, span)
        events.label[~signal.reshape(-1)[events.pixel]] = NOISE
        noise = self._draw_noise(frame, fires, span)
        moved = np.sign(without_noise) * (self._number(without_noise) * config.contrast_threshold)
        after = brightness if config.reset == "current" else self._reference + moved
        self._reference = np.where(signal, after, self._reference)
        self._brightness, self._last = brightness, frame
        return make_packet(UnsortedEvents.concat((events, noise)), span, frame.size)

    def _renew(self) -> None:
        """κ ⋄ I^{j−1}: move every reference towards the frame before."""
        config, earlier = self._config, self._last
        if config.cache == "none" or (config.cache == "local" and earlier.is_source):
            self._reference = self._brightness.copy()
        if config.cache != "global" or not earlier.is_source:
            return
        if self._decayed_us is None:
            self._decayed_us = earlier.t_us
        elapsed_s = (earlier.t_us - self._decayed_us) / 1e6
        share = -math.expm1(-config.residual_decay_hz * elapsed_s)
        if share >= 0.01:
            self._reference += share * (self._brightness - self._reference)
            self._decayed_us = earlier.t_us

    def _number(self, change: Float64Array) -> Any:
        """Events of each change: floor(Δ / δ), or one."""
        if self._config.multi_event:
            return np.floor(np.abs(change) / self._config.contrast_threshold)
        return np.ones(change.shape)

    def _timed(
        self, fires: NDArray[np.bool_], change: Float64Array, now: Float64Array, span: FrameInterval
    ) -> UnsortedEvents:
        """Eq. 7: a row per event, those of a pixel one after the other."""
        config = self._config
        pixel = np.flatnonzero(fires)
        number = self._number(change[fires]).astype(np.int64)
        row = np.repeat(np.arange(pixel.size), number)
        order = np.arange(row.size) - np.repeat(np.cumsum(number) - number, number) + 1
        before, now, reference, change = (
            one[fires][row] for one in (self._brightness, now, self._reference, change)
        )
        if config.timestamp_rule == "eq7":
            size = np.abs(change)
            spread = np.ptp(size) if size.size else 0.0
            fraction = 1.0 - (size - size.min()) / spread if spread else np.full(size.shape, 0.5)
        elif config.timestamp_rule == "random":
            y, x = np.divmod(pixel[row], fires.shape[1])
            fraction = draw_uniforms(span.key, y, x, Purpose.TIMESTAMP.draw(order))
        elif config.timestamp_rule == "linear":
            sign = np.sign(change)
            level = reference + sign * (order * config.contrast_threshold)
            is_over, moves = sign * (before - level) >= 0, now != before
            fraction = np.ones(level.shape)
            np.divide(level - before, now - before, out=fraction, where=~is_over & moves)
            fraction = np.clip(np.where(is_over, 0.0, fraction), 0.0, 1.0)
        else:
            fraction = np.ones(row.size)
        p = (change > 0).astype(np.uint8)
        return UnsortedEvents.signal(pixel[row], place_in(span, fraction), p)

    def _draw_noise(
        self, frame: Frame, fires: NDArray[np.bool_], span: FrameInterval
    ) -> UnsortedEvents:
        """Eq. 6."""
        luma = frame.luma.reshape(-1)
        pixel, fraction, p = draw_noise(self._config, span, luma.size, luma.__getitem__)
        noise = UnsortedEvents.noise(pixel, place_in(span, fraction), p)
        if self._config.noise == "random":
            return noise
        return noise.take(~fires.reshape(-1)[pixel])


def place_in(interval: FrameInterval, fraction: Float64Array) -> NDArray[np.int64]:
    """Times at fractions 0..1 of an interval, µs, rounded down; never its end."""
    offset = np.floor(fraction * interval.duration_us).astype(np.int64)
    return np.minimum(interval.start_us + offset, interval.stop_us - 1)
