"""The Texvent pixel model (Eqs. 5-7) on candidates, or on pictures where that costs less."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import balanced_log
from texvent.engine.fused import earlier_of, edges_of, paths_of, undrawn_frames
from texvent.events import EventStream
from texvent.interpolate.densify import Pair
from texvent.pairs.motion_interpolation import Paths
from texvent.simulate.backend.select import AUTO
from texvent.simulate.fused.candidates import CandidateFinder, one_grid, show_pixels
from texvent.simulate.fused.interface import (
    FOLLOWS,
    STEPS,
    STEPS_ONCE,
    TAKES,
    Candidates,
    Float64Array,
    Int64Array,
    Levels,
)
from texvent.simulate.packets.interval import FrameInterval
from texvent.simulate.random.draws import frame_key
from texvent.simulate.texvent.brightness_cache import BrightnessCache
from texvent.simulate.texvent.config import TexventConfig
from texvent.simulate.texvent.kernels.noise_blocks import NoisePlaces
from texvent.simulate.texvent.kernels.scan import Fired
from texvent.simulate.texvent.kernels.timestamping import load_stamp_events
from texvent.simulate.texvent.pixels import SparsePixels, draw_noise_places, timing_of
from texvent.video import Frame


class FusedTexvent:
    """Texvent on the pictures of the frame engine; see `fused.FusedPixels`.

    Equation: (5)-(7), section 3.2.2; the events are those of `TexventSimulator`.
    """

    def __init__(self, config: TexventConfig, seed: int) -> None:
        self._config, self._seed = config, seed
        self._is_kept = config.cache in ("global", "leaky")
        self._has_line = config.stamp == "linear" or config.cache == "none"
        self._timing = timing_of(config)
        self._watching: SparsePixels | None = None
        """What saw the last pair, if it was drawn; None where the cache outlives pairs."""

    def begin(self, frame: Frame) -> None:
        """Take the first frame."""
        config = self._config
        self._cache = BrightnessCache(
            self._brightness_of(frame.luma),
            policy=config.cache if self._is_kept else "global",
            leak=config.cache_leak,
            reset_pairs=config.cache_reset_pairs if self._is_kept else 0,
        )

    def fire(self, finder: CandidateFinder, pair: Pair) -> Iterator[tuple[Frame, EventStream]]:
        """Events of each sub-interval, noise included."""
        reference = self._calibrate(pair)
        levels = functools.cache(lambda: self._levels(reference))
        cells = finder.survey(pair, levels)
        if cells is None:
            yield from self._watch(pair, reference)
            return
        self._watching = None
        paths, edges_us = paths_of(pair), edges_of(pair).tolist()
        settle = self._settler(paths, reference, len(edges_us) - 1)
        grids = one_grid(paths.positions)
        bands = list(finder.map(settle, paths, grids=grids, levels=levels(), cells=cells))
        stamp_events, size = load_stamp_events(AUTO), paths.size
        spans = itertools.pairwise(edges_us)
        for piece, (frame, span_us) in enumerate(zip(undrawn_frames(pair), spans, strict=True)):
            fired = [band[piece] for band in bands]
            span = FrameInterval(*span_us, frame_key(self._seed, span_us[1]))
            noise = self._draw_noise(paths, piece, span)
            x, y, t, p, label = stamp_events(fired, noise, self._timing, span, size.shape)
            yield frame, EventStream.unchecked(x, y, t, p, size=size, label=label)

    def _watch(self, pair: Pair, reference: Float64Array) -> Iterator[tuple[Frame, EventStream]]:
        """The same from pictures."""
        edges_us = edges_of(pair).tolist()
        pixels, last = self._watching, pair.second
        if self._is_kept:
            # The cache itself forgets at source frames (`_calibrate`), and keeps the references.
            paths = paths_of(pair)
            first = Frame(paths.earlier, edges_us[0])
            level = reference.reshape(-1)
            pixels = SparsePixels(self._config, AUTO, first, "a frame", level=level)
            last = Frame(paths.later, edges_us[-1], is_source=False)
        elif pixels is None:
            first = earlier_of(pair)
            pixels = self._watching = SparsePixels(self._config, AUTO, first, "a frame")
        for frame, span_us in zip(pair.frames, itertools.pairwise(edges_us), strict=True):
            span = FrameInterval(*span_us, frame_key(self._seed, span_us[1]))
            seen = last if frame is pair.second else frame
            yield frame, pixels.advance(seen, span, "a frame")

    def _settler(
        self, paths: Paths, reference: Float64Array, pieces: int
    ) -> Callable[[Candidates], list[Fired]]:
        """What settles the candidates of a band; moves their references."""
        flat, first = reference.reshape(-1), paths.earlier.reshape(-1)

        def settle(found: Candidates) -> list[Fired]:
            if not self._is_kept:
                # The pair begins at its own first frame; other references are not looked at.
                flat[found.pixel] = self._brightness_of(first[found.pixel])
            return self._settle(found, flat, pieces)

        return settle

    def _calibrate(self, pair: Pair) -> Float64Array:
        """The references that a pair starts with, [H, W], log units: the cache's own array."""
        if not self._is_kept:
            return self._cache.calibrate(np.empty((0, 0)), is_source=False)
        return self._cache.calibrate(self._brightness_of(earlier_of(pair).luma), is_source=True)

    def _levels(self, reference: Float64Array) -> Levels:
        """What `kernels.interface` calls levels, for references [H, W] that count where kept."""
        config = self._config
        if config.cache == "none":
            rule = FOLLOWS
        elif config.reset == "current":
            rule = TAKES
        else:
            rule = STEPS if config.multi_event else STEPS_ONCE
        up, down = math.exp(config.contrast_threshold), math.exp(-config.contrast_threshold)
        level = np.exp(reference) if self._is_kept else np.empty((0, 0))
        return Levels(level, config.balance, up, down, rule)

    def _settle(self, found: Candidates, reference: Float64Array, pieces: int) -> list[Fired]:
        """Eq. 5 for the candidates of a band: what fires in each sub-interval."""
        found = found.take(np.argsort(found.piece, kind="stable"))
        cuts = np.searchsorted(found.piece, np.arange(pieces + 1)).tolist()
        stop = self._brightness_of(found.now)
        start = self._brightness_of(found.before) if self._has_line else stop[:0]
        fired = []
        for cut in itertools.pairwise(cuts):
            rows = slice(*cut)
            fired.append(self._settle_piece(found.pixel[rows], start[rows], stop[rows], reference))
        return fired

    def _settle_piece(
        self, pixel: Int64Array, start: Float64Array, stop: Float64Array, reference: Float64Array
    ) -> Fired:
        """Eq. 5: which of the candidates of a sub-interval fire; moves their references.

        Args:
            pixel: the candidates, [n].
            start: their brightness at the start, [n], or [0] where nobody wants to know.
            stop: their brightness at the end, [n].
            reference: reference brightness of all pixels, flat.
        """
        config = self._config
        then = start if config.cache == "none" else reference[pixel]
        change = stop - then
        fires = np.abs(change) >= config.contrast_threshold
        if not fires.all():
            pixel, change, then = pixel[fires], change[fires], then[fires]
            start, stop = start[fires] if start.size else start, stop[fires]
        reference[pixel] = stop
        if config.reset == "step":
            threshold = config.contrast_threshold
            number = np.floor(np.abs(change) / threshold) if config.multi_event else 1.0
            reference[pixel] = then + np.sign(change) * (number * threshold)
        return Fired(pixel, change, start, stop, then)

    def _draw_noise(self, paths: Paths, piece: int, span: FrameInterval) -> NoisePlaces:
        """Eq. 6."""
        luma_of = functools.partial(show_pixels, paths, piece)
        return draw_noise_places(self._config, span, paths.later.size, luma_of, AUTO)

    def _brightness_of(self, luma: NDArray[np.float32]) -> Float64Array:
        return balanced_log(luma, self._config.balance)
