"""The definition of the paper's pixel model, on whole frames in NumPy float64.

It reads as the paper does, makes several arrays as large as the frame at every step, and is what
the tests compare `pixels` with. Gaussian noise, an ablation that shakes every pixel, runs here.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, balanced_log
from texvent.events import NOISE, EventStream
from texvent.simulate.packets import FrameInterval, UnsortedEvents, make_packet, place_in
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.event_frame import (
    BrightnessCache,
    EventFrame,
    generate_event_frame,
    list_threshold_crossings,
)
from texvent.simulate.texvent.noise import (
    draw_noise,
    draw_voltage_noise,
    is_background,
)
from texvent.simulate.texvent.timestamps import SubInterval, reconstruct_timestamps
from texvent.video import Frame, check_intensity


class DensePixels:
    """All pixels of a sensor, as whole frames of brightness."""

    def __init__(self, config: TexventConfig, frame: Frame, where: str) -> None:
        """Begin with the first frame.

        Args:
            config: options.
            frame: the first frame.
            where: which frame that is, for messages.
        """
        check_intensity(frame.pixels, where)
        self._config = config
        self._brightness = balanced_log(frame.luma, config.balance)
        self._t_us, self._is_source = frame.t_us, frame.is_source
        self._cache = BrightnessCache(
            self._brightness,
            policy=config.cache,
            decay_hz=config.residual_decay_hz,
        )

    def advance(self, frame: Frame, span: FrameInterval, where: str) -> EventStream:
        """Events until this frame.

        Args:
            frame: the next frame, of the same size.
            span: time since the frame before, and the key of its random draws.
            where: which frame it is, for messages.

        Raises:
            InputError: an intensity is NaN, infinite or negative, or Gaussian noise would fire
                every time; the pixels are then as they were.
            ConfigError: the balance is 0 and a pixel is black; the same.
        """
        check_intensity(frame.pixels, where)
        brightness = balanced_log(frame.luma, self._config.balance)
        shaken = self._add_voltage_noise(brightness, span)
        # κ ⋄ I^{j−1}
        reference = self._cache.calibrate(self._brightness, self._t_us, is_source=self._is_source)
        events = self._generate_event_frame(shaken, reference)  # Eq. 5
        noise = self._draw_noise(frame, events.pixel, span)  # Eq. 6
        signal = events
        if shaken is not brightness:
            # What would have fired without voltage noise: only this renews the reference.
            signal = self._generate_event_frame(brightness, reference)
        previous, now, then = (
            image.reshape(-1)[events.pixel] for image in (self._brightness, shaken, reference)
        )
        interval = SubInterval(span, frame.size.width, events.pixel, (previous, now, then))
        timed = self._reconstruct_timestamps(events, signal, interval)  # Eq. 7
        self._cache.update(signal, brightness, step=self._config.reset_step)
        self._brightness = brightness
        self._t_us, self._is_source = frame.t_us, frame.is_source
        return make_packet(UnsortedEvents.concat((timed, noise)), span, frame.size)

    def _add_voltage_noise(self, brightness: Float64Array, span: FrameInterval) -> Float64Array:
        """The brightness itself, unless noise is "gaussian" (ablation E10)."""
        if self._config.noise != "gaussian":
            return brightness
        return brightness + draw_voltage_noise(
            brightness.shape,
            span.key,
            threshold=self._config.contrast_threshold,
            mean=self._config.expected_noise(span.duration_s),
        )

    def _generate_event_frame(
        self, brightness: Float64Array, reference: Float64Array
    ) -> EventFrame:
        """Eq. 5."""
        return generate_event_frame(
            brightness,
            reference,
            threshold=self._config.contrast_threshold,
            multi_event=self._config.multi_event,
        )

    def _reconstruct_timestamps(
        self, events: EventFrame, signal: EventFrame, interval: SubInterval
    ) -> UnsortedEvents:
        """Eq. 7. Events that only voltage noise let fire are labelled as noise."""
        crossings = list_threshold_crossings(events)
        t = reconstruct_timestamps(
            crossings,
            interval,
            timestamp_rule=self._config.timestamp_rule,
            threshold=self._config.contrast_threshold,
            scale=self._config.timestamp_scale,
        )
        fired = UnsortedEvents.signal(crossings.pixel, t, crossings.polarity)
        if signal is not events:
            fired.label[is_background(crossings.pixel, signal.pixel)] = NOISE
        return fired

    def _draw_noise(
        self, frame: Frame, fired: NDArray[np.int64], span: FrameInterval
    ) -> UnsortedEvents:
        """Eq. 6; nothing for "gaussian", which shakes the brightness instead."""
        luma = frame.luma.reshape(-1)
        pixel, fraction, p = draw_noise(self._config, span, luma.size, luma.__getitem__)
        events = UnsortedEvents.noise(pixel, place_in(span, fraction), p)
        if self._config.noise == "random":
            return events
        return events.take(is_background(pixel, fired))
