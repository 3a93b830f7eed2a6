"""The Texvent pixel model (Eqs. 5-7) on a pair of frames, without drawing the frames between them.

Pixels that may fire are found first (`simulation.fused`); only they are evaluated, with the
logarithm of the model itself. So the events are those of the drawn frames, bit for bit.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, balanced_log
from texvent.events import EventStream
from texvent.frames import Frame
from texvent.pairs.frame_pair import FramePair
from texvent.simulation.crossing.trigger_levels import trigger_factors
from texvent.simulation.fused.bounds import (
    CrossingCandidates,
    Int64Array,
    ReferenceLevels,
)
from texvent.simulation.fused.candidates import map_candidates, warp_pixels
from texvent.simulation.packets import FrameInterval
from texvent.simulation.random.draws import frame_key
from texvent.simulation.texvent.config import TexventConfig
from texvent.simulation.texvent.noise import draw_noise
from texvent.simulation.texvent.pixel_memory import FiredPixels, Memory
from texvent.simulation.texvent.timestamps import timestamp_events


class FusedPass:
    """Packets of one pair after another. References live in the `Memory` of the pixels.

    With a cache that outlives a pair (global), references are read from and written to that
    memory. With one that forgets (local), a pair starts from its own first frame, and no memory is
    needed.
    """

    def __init__(self, config: TexventConfig, seed: int) -> None:
        """Prepare a pass.

        Args:
            config: options for which `is_fusible`.
            seed: of noise and random times.
        """
        self._config, self._seed = config, seed
        self._keeps_start = config.timestamp_rule == "linear"
        self._scratch: Float64Array = np.empty(0)

    def packets(
        self, pair: FramePair, memory: Memory | None, first_us: int
    ) -> Iterator[tuple[Frame, EventStream]]:
        """Every frame of a pair, undrawn, with the packet of events that ends at it.

        Args:
            pair: not the first of a stream, with flow.
            memory: of the pixels, whose references this moves (before the first packet is read);
                None where the cache forgets at every pair.
            first_us: time of the stream's first frame: random draws are keyed by the time since.
        """
        motion = pair.motion
        edges_us = pair.edges_us.tolist()
        decide = functools.partial(
            self._decide, earlier=motion.earlier.reshape(-1), memory=memory, parts=len(motion) + 1
        )
        bands = map_candidates(decide, self._levels(pair, memory), motion)
        return self._timestamp(pair, list(zip(*bands, strict=True)), edges_us, first_us)

    def _timestamp(
        self,
        pair: FramePair,
        fired: list[tuple[FiredPixels, ...]],
        edges_us: list[int],
        first_us: int,
    ) -> Iterator[tuple[Frame, EventStream]]:
        """Eqs. 6 and 7 for each sub-interval."""
        motion, size = pair.motion, pair.second.size
        spans = itertools.pairwise(edges_us)
        for part, (frame, span_us) in enumerate(zip(pair.undrawn_frames, spans, strict=True)):
            span = FrameInterval(*span_us, frame_key(self._seed, span_us[1] - first_us))
            luma_of = functools.partial(warp_pixels, motion, part)
            noise = draw_noise(self._config, span, size.width * size.height, luma_of)
            bands = FiredPixels(*map(np.concatenate, zip(*fired[part], strict=True)))
            x, y, t, p, label = timestamp_events(bands, noise, self._config, span, size.shape)
            yield frame, EventStream.unchecked(x, y, t, p, size=size, label=label)

    def _levels(self, pair: FramePair, memory: Memory | None) -> ReferenceLevels:
        """References at the start of a pair, and the rule by which they move."""
        config = self._config
        up, down = trigger_factors(config.contrast_threshold, config.contrast_threshold)
        level = np.empty((0, 0))
        if memory is not None:
            # Rounded to float32, which the margin of the search covers.
            level = memory.reference.reshape(pair.second.size.shape).astype(np.float64)
        return ReferenceLevels(level, config.balance, up, down, config.reset == "step")

    def _decide(
        self,
        found: CrossingCandidates,
        *,
        earlier: NDArray[np.float32],
        memory: Memory | None,
        parts: int,
    ) -> list[FiredPixels]:
        """Eq. 5 for the candidates of a band: what fires in each sub-interval.

        Args:
            found: the candidates.
            earlier: luma of the earlier frame, flat.
            memory: of the pixels; its references are moved.
            parts: number of sub-intervals.
        """
        if memory is None:
            if self._scratch.size != earlier.size:
                self._scratch = np.empty(earlier.size)
            reference = self._scratch
            reference[found.pixel] = self._brightness_of(earlier[found.pixel])
        else:
            reference = memory.level
        pixels = found.pixel
        found = found.take(np.argsort(found.segment, kind="stable"))
        cuts = np.searchsorted(found.segment, np.arange(parts + 1)).tolist()
        stop = self._brightness_of(found.now)
        start = self._brightness_of(found.before) if self._keeps_start else stop[:0]
        fired = [
            self._fire(found.pixel[rows], start[rows], stop[rows], reference)
            for rows in itertools.starmap(slice, itertools.pairwise(cuts))
        ]
        if memory is not None:
            memory.reference[pixels] = np.exp(reference[pixels])
        return fired

    def _fire(
        self, pixel: Int64Array, start: Float64Array, stop: Float64Array, reference: Float64Array
    ) -> FiredPixels:
        """Eq. 5: which of the candidates of a sub-interval fire; moves their references.

        Args:
            pixel: the candidates, [n].
            start: their brightness at the start, [n], or [0] if it is not needed.
            stop: their brightness at the end, [n].
            reference: reference brightness of all pixels, flat.
        """
        config = self._config
        then = reference[pixel]
        change = stop - then
        fires = np.abs(change) >= config.contrast_threshold
        if not fires.all():
            pixel, change, then = pixel[fires], change[fires], then[fires]
            start, stop = start[fires] if start.size else start, stop[fires]
        reference[pixel] = stop
        if config.reset == "step":
            threshold = config.contrast_threshold
            number = np.floor(np.abs(change) / threshold)
            reference[pixel] = then + np.sign(change) * (number * threshold)
        return FiredPixels(pixel, change, start, stop, then)

    def _brightness_of(self, luma: NDArray[np.float32]) -> Float64Array:
        return balanced_log(luma, self._config.balance)
