"""What the kernels exchange that fuse interpolation and simulation.

**Candidates.** A pixel compares its brightness ln(α + I) with a reference ln(A). It fires where the
two differ by θ_on upwards or θ_off downwards: where α + I ≥ A·e^θ_on or α + I ≤ A·e^−θ_off. So two
multiplications tell where a pixel may fire, without a logarithm. `find_candidates` evaluates the
pixels of one pair of frames at every intermediate instant and lists each place where this is so,
with a margin (`trigger_levels.MARGIN`). The simulator then decides in NumPy, with its own
logarithm. Where the margin leaves open whether a pixel fired, all its later instants are listed.

**Segments.** K intermediate instants divide the time between the two frames into K + 1 segments.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.runtime.read_only import read_only

Float32Array: TypeAlias = NDArray[np.float32]
Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]
LumaBounds: TypeAlias = Float32Array
"""Darkest and brightest luma that each cell of a pair can reach; see `bounds_cpu`."""

FOLLOWS, TAKES, STEPS_ONCE, STEPS = range(4)
"""How a reference moves: it becomes the level at every instant; where the pixel fires it becomes
the level there; it moves by one threshold; it moves by as many thresholds as were passed."""


class PairArrays(NamedTuple):
    """Two frames and the flow between them, read-only; see `MotionInterpolation`."""

    earlier: Float32Array
    """[H, W] luma."""
    later: Float32Array
    """[H, W] luma."""
    forward: Float32Array
    """[H, W, 2] flow, px."""
    backward: Float32Array
    """[H, W, 2] flow, px."""


def with_sweep(arrays: PairArrays, sweep: Float32Array) -> PairArrays:
    """The arrays, with the longer of forward flow and sweep along each axis: for bounds.

    Args:
        arrays: of a pair.
        sweep: [H, W, 2] px, or empty; see `pairs.paths_reference.find_sweep`.
    """
    if sweep.size == 0:
        return arrays
    longer = np.where(np.abs(sweep) > np.abs(arrays.forward), sweep, arrays.forward)
    return arrays._replace(forward=read_only(longer))


class PreparedPair(NamedTuple):
    """A pair, prepared for the search of candidates."""

    pair: Any
    """`pairs.warp_cpu.WarpPair` of its frames."""
    bounds: LumaBounds


class ReferenceLevels(NamedTuple):
    """What pixels compare with, and how it moves."""

    reference: Float64Array
    """[H, W] A of every pixel at the start, a balanced level; [0, 0]: the earlier frame's own."""
    balance: float
    """α."""
    up: float
    """e^θ_on."""
    down: float
    """e^−θ_off."""
    rule: int
    """How references move: one of FOLLOWS, TAKES, STEPS_ONCE, STEPS."""


class CrossingCandidates(NamedTuple):
    """Places where a pixel may have fired, by pixel, then in time."""

    pixel: Int64Array
    """[n] flat index y · W + x."""
    segment: NDArray[np.int16]
    """[n] which segment, from 0."""
    before: Float32Array
    """[n] luma at the start of the segment."""
    now: Float32Array
    """[n] luma at its end."""

    def take(self, rows: Int64Array | slice) -> CrossingCandidates:
        """Some of the candidates, by number."""
        return CrossingCandidates(
            self.pixel[rows], self.segment[rows], self.before[rows], self.now[rows]
        )
