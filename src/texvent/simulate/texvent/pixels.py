"""The paper's pixel model without a logarithm per pixel: the same events, as fast as memory.

`kernels.texvent` tells how. This hands each frame to the kernels of a backend, together with what
the pixels remember; no array as large as a frame is made after the first, unless frames have
colour or more than one type.
"""

from __future__ import annotations

import copy
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, check_balance
from texvent.events import EventStream
from texvent.runtime.allocator import keep_freed_memory
from texvent.runtime.threads import count_threads, run_parts, split
from texvent.sensor import SensorSize
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.packets.sorting import read_only
from texvent.simulate.texvent.brightness_cache import CacheSchedule, Renewal
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.kernels.noise_blocks import Block, NoisePlaces, load_place_noise
from texvent.simulate.texvent.kernels.scan import (
    NOISE_BLOCK,
    Fired,
    FireRule,
    Intensity,
    Memory,
    load_find_fired,
)
from texvent.simulate.texvent.kernels.timestamping import Timing, load_stamp_events
from texvent.simulate.texvent.noise import poisson_cumulative
from texvent.simulate.texvent.pixel_state import (
    as_luma,
    move_levels,
    remember,
    resume,
    scan_levels,
    turn_to_float,
)
from texvent.video import Frame, bad_intensity, check_intensity, is_intensity

Int64Array = NDArray[np.int64]
_FRAMES_AT_ONCE = 4
"""Frames for which threads are asked together: asking takes some 20 µs each time, and what fired in
so many frames should stay in the cache."""
_QUIET = NoisePlaces(np.empty(0, np.int64), np.empty(0), np.empty(0, np.uint8))


class SparsePixels:
    """All pixels of a sensor, by their trigger levels; takes and gives what `DensePixels` does."""

    def __init__(
        self,
        config: TexventConfig,
        backend: str,
        frame: Frame,
        where: str,
        *,
        level: Float64Array | None = None,
    ) -> None:
        """Begin with the first frame; see `texvent_reference.DensePixels`.

        Args:
            config: options.
            backend: which kernels compute.
            frame: the first frame; float32 if there is a level.
            where: what messages call it.
            level: reference brightness, [n], that somebody else has kept until this frame; moved
                along in place. None: the frame's own.
        """
        check_intensity(frame.pixels, where)
        check_balance(frame.luma, config.balance)
        self._config, self._backend = config, backend
        self._schedule = CacheSchedule(config.cache, config.cache_reset_pairs)
        self._schedule.pass_frame(is_source=frame.is_source)
        first = _native_intensity(frame)
        self._memory = remember(first, config) if level is None else resume(first, level, config)
        self._levels = scan_levels(config, self._memory)
        self._rule = FireRule(
            threshold=config.contrast_threshold,
            balance=config.balance,
            multi_event=config.multi_event,
            is_step=config.reset == "step",
            is_renewed=False,
            has_line=config.stamp == "linear",
        )
        self._rule_that_renews = self._rule._replace(is_renewed=True)
        self._timing = timing_of(config)

    def advance(self, frame: Frame, span: FrameInterval, where: str) -> EventStream:
        """What fires until this frame; see `texvent_reference.DensePixels.advance`."""
        intensity = self._read(frame, where)
        renewal = self._schedule.renewal_after(is_source=frame.is_source)
        fired = self._fire(self._memory, intensity, renewal)
        if fired is None:
            raise bad_intensity(frame.pixels, where)
        self._schedule.pass_frame(is_source=frame.is_source)
        return self._stamp([fired], intensity, span, frame.size)

    def advance_batch(
        self, frames: Sequence[Frame], spans: Sequence[FrameInterval], where: Sequence[str]
    ) -> list[EventStream]:
        """The same for several frames at once, shared out among threads; all of them or none.

        A pixel's references depend on no other pixel. So each thread takes a band of rows through
        all frames, and then, for some of the frames, times and order of the events.
        """
        # What fires in all the frames is kept until the last one is done.
        keep_freed_memory()
        named = list(zip(frames, where, strict=True))
        intensities = [self._read(*one) for one in named]
        if any(one.dtype != self._memory.reference.dtype for one in intensities):
            # A frame of another type has changed that of the memory.
            intensities = [self._read(*one) for one in named]
        schedule = copy.copy(self._schedule)
        renewals = [schedule.pass_frame(is_source=frame.is_source) for frame in frames]
        memory, packets = self._memory, []
        kept = [one.copy() for one in (memory.reference, memory.previous, memory.level)]
        for part in split(len(frames), -(-len(frames) // _FRAMES_AT_ONCE)):
            fired = self._fire_bands(intensities[part], renewals[part])
            if fired is None:
                memory.reference[:], memory.previous[:], memory.level[:] = kept
                raise next(
                    bad_intensity(frame.pixels, place)
                    for frame, place in named
                    if not is_intensity(frame.pixels)
                )
            packets += self._stamp_all(fired, intensities[part], spans[part], frames[0].size)
        self._schedule = schedule
        return packets

    def _fire_bands(
        self, intensities: Sequence[Intensity], renewals: Sequence[Renewal]
    ) -> list[list[Fired]] | None:
        """Eq. 5 for a few frames, a band of rows per thread.

        Returns:
            What fired, a row per frame with its bands; None where an intensity is impossible.
        """
        memory = self._memory
        parts = split(memory.reference.size, count_threads(), unit=NOISE_BLOCK)
        bands = [memory.band(part) for part in parts]

        def fire(number: int) -> list[Fired]:
            part, band, rows = parts[number], bands[number], []
            for place, (intensity, renewal) in enumerate(zip(intensities, renewals, strict=True)):
                band.work = memory.band_work.get((part.start, place))
                fired = self._fire(band, intensity[part], renewal)
                if fired is None:
                    break
                memory.band_work[part.start, place] = band.work
                rows.append(fired)
            return rows

        fired = run_parts(fire, range(len(parts)))
        if any(len(rows) < len(renewals) for rows in fired):
            return None
        if not memory.level.size and renewals.count("renew") % 2:
            # As every band did; an even number of times leaves them as they were.
            memory.reference, memory.renewed = memory.renewed, memory.reference
        return [list(rows) for rows in zip(*fired, strict=True)]

    def _stamp_all(
        self,
        fired: Sequence[Sequence[Fired]],
        intensities: Sequence[Intensity],
        spans: Sequence[FrameInterval],
        size: SensorSize,
    ) -> list[EventStream]:
        """Packets of a few frames, some of the frames per thread."""
        rows = list(zip(fired, intensities, spans, strict=True))

        def stamp(part: slice) -> list[EventStream]:
            return [self._stamp(*row, size) for row in rows[part]]

        packets = run_parts(stamp, split(len(rows), count_threads()))
        return [packet for part in packets for packet in part]

    def _fire(self, memory: Memory, intensity: Intensity, renewal: Renewal) -> Fired | None:
        """Eq. 5 for the pixels of a memory; None where an intensity is impossible."""
        has_levels = memory.level.size > 0
        rule = self._rule_that_renews if renewal == "renew" and not has_levels else self._rule
        find_fired = load_find_fired(self._backend, intensity.dtype.str)
        fired = find_fired(intensity, memory, self._levels, rule)
        if has_levels and renewal != "keep" and fired is not None:
            move_levels(memory, intensity, self._config, renewal)
        return fired

    def _stamp(
        self, bands: Sequence[Fired], intensity: Intensity, span: FrameInterval, size: SensorSize
    ) -> EventStream:
        """Eqs. 6 and 7: the packet of one sub-interval."""
        noise = self._draw_noise(intensity, span)
        stamp_events = load_stamp_events(self._backend)
        x, y, t, p, label = stamp_events(bands, noise, self._timing, span, size.shape)
        return EventStream.unchecked(x, y, t, p, size=size, label=label)

    def _read(self, frame: Frame, where: str) -> Intensity:
        """The intensity of a frame in the type of the memory, [n] read-only."""
        if frame.pixels.ndim != 2 or frame.pixels.dtype != np.float32:
            # The kernels look at float32 luma themselves.
            check_intensity(frame.pixels, where)
        if self._config.balance == 0:
            check_balance(frame.luma, 0.0)
        intensity = _native_intensity(frame)
        if intensity.dtype == self._memory.reference.dtype:
            return intensity
        if self._memory.reference.dtype != np.float32:
            turn_to_float(self._memory)
            self._levels = scan_levels(self._config, self._memory)
        return read_only(as_luma(intensity))

    def _draw_noise(self, intensity: Intensity, span: FrameInterval) -> NoisePlaces:
        """Eq. 6."""

        def luma_of(pixel: Int64Array) -> Intensity:
            luma = intensity[pixel]
            return as_luma(luma) if luma.dtype == np.uint16 else luma

        return draw_noise_places(self._config, span, intensity.size, luma_of, self._backend)


def timing_of(config: TexventConfig) -> Timing:
    """How a configuration gives times to events."""
    return Timing(
        config.stamp,
        config.stamp_scale,
        config.contrast_threshold,
        config.multi_event,
        config.noise == "adaptive",
    )


def draw_noise_places(
    config: TexventConfig,
    span: FrameInterval,
    size: int,
    luma_of: Callable[[Int64Array], Intensity],
    backend: str,
) -> NoisePlaces:
    """Noise of Eq. 6 where pixels are dark, or, as ablation E11, anywhere.

    Args:
        config: options.
        span: the sub-interval.
        size: number of pixels.
        luma_of: luma at the end of the sub-interval, 0..255 scale, of pixels given by flat index.
        backend: which kernels draw.
    """
    if not config.has_added_noise:
        return _QUIET
    cumulative = poisson_cumulative(config.expected_noise(span.duration_s) * NOISE_BLOCK)
    block = Block(span.key, cumulative, config.noise_on_fraction)
    noise = load_place_noise(backend)(block, size)
    if config.noise == "random" or not len(noise.pixel):
        return noise
    dark = np.flatnonzero(luma_of(noise.pixel) < config.noise_intensity)
    if not len(dark):
        return _QUIET
    return NoisePlaces(noise.pixel[dark], noise.fraction[dark], noise.p[dark])


def _native_intensity(frame: Frame) -> Intensity:
    """The intensity in the smallest type that holds it: grey integers as they are, else luma."""
    is_grey_integer = frame.pixels.ndim == 2 and frame.pixels.dtype in (np.uint8, np.uint16)
    return read_only(frame.pixels if is_grey_integer else frame.luma)
