"""What the kernels that join interpolation and simulation get and give.

**Candidates.** A pixel compares its brightness ln(α + I) with a reference ln(A), and fires where
they differ by θ_on upwards or θ_off downwards: where α + I ≥ A·e^θ_on or α + I ≤ A·e^−θ_off. So two
multiplications tell where something may fire, without a logarithm. `find_candidates` follows the
pixels of one pair of frames from picture to picture and lists every place where this is so, a
margin (`MARGIN`) included; the list is finished in NumPy with the logarithm that the simulators
use, which decides exactly. Where the margin leaves it open whether a pixel fired, all its later
pictures are listed.

**Grids.** When a pixel is looked at: grid g divides the pair into `parts[g]` pieces that end at the
positions `positions[g, :parts[g] − 1]` and at 1. With one grid all pixels use it: the pictures of
the frame engine. With several, a pixel takes the first one that is fine enough for how far its flow
leads and by which factor its own α + I changes.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent.pairs.motion_interpolation import frozen

Float32Array: TypeAlias = NDArray[np.float32]
Float64Array: TypeAlias = NDArray[np.float64]
Int64Array: TypeAlias = NDArray[np.int64]
Cells: TypeAlias = Float32Array
"""Darkest and brightest luma that each cell of a pair can reach; see `reach_cpu`."""

MARGIN = 1e-6
"""Relative distance from a trigger level within which the finishing pass decides."""

FOLLOWS, TAKES, STEPS_ONCE, STEPS = range(4)
"""How a reference moves: it becomes every picture's level; where it fires it becomes the level
there; it moves by one threshold; it moves by as many thresholds as were passed."""


class Pictures(NamedTuple):
    """Two frames and what leads from one to the other; see `pairs.motion_interpolation.Paths`."""

    earlier: Float32Array
    """[H, W] luma."""
    later: Float32Array
    """[H, W] luma."""
    forward: Float32Array
    """[H, W, 2] flow, px; [0, 0, 2] where the frames are blended in place."""
    backward: Float32Array
    """[H, W, 2] flow, px; [0, 0, 2] where the frames are blended in place."""

    def frozen(self) -> Pictures:
        """The same as views that cannot be written: kernels are compiled for these alone."""
        return Pictures(*(frozen(one) for one in self))


class Surveyed(NamedTuple):
    """What is known of a pair before its candidates are looked for."""

    pair: Any
    """`pairs.warp_cpu.WarpPair` of its frames."""
    cells: Cells


class Grids(NamedTuple):
    """When pixels are looked at between two frames."""

    positions: Float64Array
    """[G, P] τ of each inner picture of each grid; what lies past `parts − 1` is not read."""
    parts: Int64Array
    """[G] number of pieces, increasing."""
    reach2: Float64Array
    """[G] squared length of the longest flow that a grid is fine enough for, px²."""
    ratio: Float64Array
    """[G] largest factor of change that a grid is fine enough for."""


class Levels(NamedTuple):
    """What pixels compare with."""

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


class Candidates(NamedTuple):
    """Places where a pixel may have fired, by pixel, then in time."""

    pixel: Int64Array
    """[n] flat index y · W + x."""
    grid: NDArray[np.int16]
    """[n] the pixel's grid."""
    piece: NDArray[np.int16]
    """[n] which piece of it, from 0."""
    before: Float32Array
    """[n] luma at the start of the piece."""
    now: Float32Array
    """[n] luma at its end."""

    def take(self, rows: Int64Array | slice) -> Candidates:
        """Some of the candidates, by number."""
        return Candidates(
            self.pixel[rows], self.grid[rows], self.piece[rows], self.before[rows], self.now[rows]
        )
