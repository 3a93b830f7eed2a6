"""Candidates of a pair of frames, found in bands of rows on several threads."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from texvent.pairs.motion_interpolation import MotionInterpolation
from texvent.runtime.threads import count_threads, run_parts
from texvent.simulate.fused.definitions import (
    CrossingCandidates,
    Float32Array,
    Int64Array,
    LumaBounds,
    PairArrays,
    PreparedPair,
    ReferenceLevels,
    with_sweep,
)

BAND_PIXELS = 1 << 16
"""Most pixels that a thread takes at a time: candidates are held band by band."""
BUSY = 0.65
"""From this share of active pixels on, drawing the frames costs less: each pixel has to be warped
at each instant either way, scanning whole frames is faster than evaluating pixels one by one, and
no list of candidates has to be held (docs/design.md has the measurements)."""

Decided = TypeVar("Decided")


def find_bounds(
    motion: MotionInterpolation, levels: Callable[[], ReferenceLevels]
) -> LumaBounds | None:
    """Luma bounds of a pair, if evaluating single pixels costs less than drawing its frames.

    Args:
        motion: what lies between the two frames.
        levels: gives what the pixels are compared with; not called where it makes no difference.

    Returns:
        What `map_candidates` takes; None where drawing costs less: a share of `BUSY` or more of
        the pixels, estimated from a sample of rows, may fire; or nothing moves, so that a frame
        costs next to nothing.
    """
    if motion.flows is None:
        return None
    from texvent.simulate.fused import bounds_cpu, candidates_cpu  # need Numba

    arrays = arrays_of(motion)
    bounds: LumaBounds = bounds_cpu.find_bounds(arrays)
    share = candidates_cpu.estimate_active(arrays, levels(), bounds)
    return bounds if share < BUSY else None


def map_candidates(
    decide: Callable[[CrossingCandidates], Decided],
    motion: MotionInterpolation,
    *,
    levels: ReferenceLevels,
    bounds: LumaBounds,
) -> list[Decided]:
    """The results of a function for the candidates of each band of rows, from the top.

    The number of bands and threads does not change the candidates.

    Args:
        decide: called in threads, so it must change the pixels of its candidates only.
        motion: what lies between the two frames; with flow.
        levels: what pixels are compared with.
        bounds: of `find_bounds`.
    """
    from texvent.simulate.fused.candidates_cpu import find_in_rows  # needs Numba

    arrays, positions = arrays_of(motion), np.array(motion.positions, np.float64)
    prepared = PreparedPair(motion.prepared, bounds)

    def decide_band(rows: tuple[int, int]) -> Decided:
        return decide(find_in_rows(arrays, positions, levels, prepared, rows))

    height = len(arrays.earlier)
    number = max(count_threads(), math.ceil(arrays.earlier.size / BAND_PIXELS))
    step = math.ceil(height / number)
    return run_parts(
        decide_band, [(row, min(row + step, height)) for row in range(0, height, step)]
    )


def warp_pixels(motion: MotionInterpolation, index: int, pixel: Int64Array) -> Float32Array:
    """Luma of some pixels of an intermediate frame, [n], or of the later frame after the last one.

    Args:
        motion: what lies between the two frames; with flow.
        index: number of the intermediate frame.
        pixel: [n] flat indices.
    """
    if index == len(motion):
        return motion.later.reshape(-1)[pixel]
    from texvent.simulate.fused import candidates_cpu  # needs Numba

    warped: Float32Array = candidates_cpu.warp_pixels(
        motion.prepared, motion.positions[index], pixel
    )
    return warped


def arrays_of(motion: MotionInterpolation) -> PairArrays:
    """The arrays of a pair with flow, as kernels take them for bounds."""
    if motion.flows is None:
        raise ValueError("the frames of the pair are blended, and no pixel moves")
    arrays = PairArrays(motion.earlier, motion.later, *motion.flows)
    return with_sweep(arrays, motion.prepared.sweep)
