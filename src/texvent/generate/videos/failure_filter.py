"""Does a generated clip look failed? Cheap checks without weights (paper 9.6 asks for a filter).

The measures are taken on luma (0..255), averaged in blocks down to about 64 pixels across, in one
pass with one frame in memory. Every limit was set between what real clips and embedded scenes
measure and what deliberately broken ones do; docs/generators.md has the table. The checks see
failed video, not a wrong one: whether a video shows the prompt needs a model
(`clip_score.py`).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.video import Frame

GRID = 64
"""Blocks along the longer side."""
STILL_LEVELS = 0.02
"""Mean change of a pair below which it counts as still: an eighth of what a sensor's noise or a
codec leaves in a static shot."""
FROZEN_SHARE = 0.5
"""Share of still pairs above which a clip that moves elsewhere counts as frozen."""
MOTION_LEVELS = 3.0
"""Range over time of the liveliest blocks (99th percentile) below which nothing moves."""
FLICKER_LEVELS = 2.0
"""Upper quartile of the jitter of a frame's mean against its neighbours."""
FLASH_LEVELS = 20.0
"""Jump of a frame's mean away from both neighbours that counts as a flash."""
CUT_LEVELS = 20.0
"""Smallest mean change of a pair that can be a cut."""
CUT_RATIO = 2.5
"""How many times the change of the pairs before and after it a cut must be."""
DARK_LEVEL = 12.0
"""95th percentile of all blocks below which the clip is dark."""
BRIGHT_LEVEL = 243.0
"""5th percentile of all blocks above which the clip is saturated."""
NOISE_CORRELATION = 0.4
"""Correlation of neighbouring pixels below which an image is noise; images have above 0.8."""


@dataclass(frozen=True)
class FailureReport:
    """What the checks found."""

    problems: tuple[str, ...]
    """Of: frozen, no motion, flicker, flash, cut, dark, saturated, noise."""
    measures: dict[str, float]

    @property
    def is_fine(self) -> bool:
        """True if nothing was found."""
        return not self.problems

    @property
    def summary(self) -> str:
        """The problems in one line."""
        return ", ".join(self.problems) if self.problems else "nothing found"

    def as_facts(self) -> dict[str, Any]:
        """JSON-ready, for metadata."""
        rounded = {name: round(value, 4) for name, value in self.measures.items()}
        return {"problems": list(self.problems), **rounded}


def check_video(frames: Iterable[Frame]) -> FailureReport:
    """Look through a clip once.

    Args:
        frames: a video; at least two frames, else it has no motion.
    """
    return judge_measures(measure_video(frames))


def judge_measures(measures: dict[str, float]) -> FailureReport:
    """The problems that the numbers of `VideoMeasurer` amount to."""
    found = {
        "frozen": measures["still_share"] > FROZEN_SHARE,
        "no motion": measures["motion"] < MOTION_LEVELS,
        "flicker": measures["flicker"] > FLICKER_LEVELS,
        "flash": measures["flash"] > FLASH_LEVELS,
        "cut": measures["cut"] > CUT_LEVELS and measures["cut_ratio"] > CUT_RATIO,
        "dark": measures["bright_end"] < DARK_LEVEL,
        "saturated": measures["dark_end"] > BRIGHT_LEVEL,
        "noise": measures["correlation"] < NOISE_CORRELATION,
    }
    return FailureReport(tuple(name for name, is_found in found.items() if is_found), measures)


def measure_video(frames: Iterable[Frame]) -> dict[str, float]:
    """The numbers behind the checks; see `VideoMeasurer.measures`."""
    measurer = VideoMeasurer()
    for frame in frames:
        measurer.add(frame)
    return measurer.measures()


class VideoMeasurer:
    """Takes the measures of a clip while its frames pass by; keeps block means only."""

    def __init__(self) -> None:
        self._blocks: list[NDArray[np.float32]] = []
        self._correlations: list[float] = []

    def add(self, frame: Frame) -> None:
        """Take one frame."""
        luma = frame.luma.astype(np.float32)
        self._blocks.append(block_means(luma))
        self._correlations.append(neighbour_correlation(luma))

    def measures(self) -> dict[str, float]:
        """The numbers behind the checks.

        Returns:
            By name: `still_share`, share of pairs that do not change; `motion`, 99th percentile
            over blocks of their range over time; `flicker` and `flash`, upper quartile and
            maximum of how far a frame's mean stands out from both neighbours; `cut` and
            `cut_ratio`, change of the pair that stands out most from those beside it, and how
            many times theirs it is; `dark_end` and `bright_end`, 5th and 95th percentile of all
            blocks; `correlation`, of neighbouring pixels, median over frames.
        """
        stack = np.stack(self._blocks)
        change = np.abs(np.diff(stack, axis=0)).mean(axis=(1, 2)) if len(stack) > 1 else np.zeros(1)
        jitter = _jitter(stack.mean(axis=(1, 2)))
        cut, cut_ratio = _sharpest_cut(change)
        return {
            "still_share": float((change < STILL_LEVELS).mean()),
            "motion": float(np.percentile(stack.max(axis=0) - stack.min(axis=0), 99)),
            "flicker": float(np.percentile(jitter, 75)),
            "flash": float(jitter.max()),
            "cut": cut,
            "cut_ratio": cut_ratio,
            "dark_end": float(np.percentile(stack, 5)),
            "bright_end": float(np.percentile(stack, 95)),
            "correlation": float(np.median(self._correlations)),
        }


def block_means(luma: NDArray[np.float32]) -> NDArray[np.float32]:
    """Means of square blocks, at most about `GRID` along a side; incomplete blocks are left out."""
    side = max(1, max(luma.shape) // GRID)
    rows, columns = (length // side * side for length in luma.shape)
    tiled = luma[:rows, :columns].reshape(rows // side, side, columns // side, side)
    return np.asarray(tiled.mean(axis=(1, 3)), dtype=np.float32)


def neighbour_correlation(luma: NDArray[np.float32]) -> float:
    """Correlation of pixels with their right and lower neighbours; 1 for a flat image."""
    centred = luma - luma.mean()
    variance = float((centred * centred).mean())
    if variance < STILL_LEVELS:
        return 1.0
    right = float((centred[:, 1:] * centred[:, :-1]).mean()) if luma.shape[1] > 1 else variance
    below = float((centred[1:] * centred[:-1]).mean()) if luma.shape[0] > 1 else variance
    return (right + below) / (2 * variance)


def _sharpest_cut(change: NDArray[np.floating[Any]]) -> tuple[float, float]:
    """Change of the pair that stands out most among those above `CUT_LEVELS`, and by how much."""
    padded = np.concatenate([[0.0], change.astype(np.float64), [0.0]])
    beside = np.maximum(np.maximum(padded[:-2], padded[2:]), CUT_LEVELS / CUT_RATIO / 2)
    ratio = np.where(change > CUT_LEVELS, change / beside, 0.0)
    index = int(ratio.argmax())
    return float(change[index]), float(ratio[index])


def _jitter(means: NDArray[np.float32]) -> NDArray[np.float64]:
    """How far each inner frame's mean stands out from both neighbours, on the same side."""
    if len(means) < 3:
        return np.zeros(1)
    before = (means[1:-1] - means[:-2]).astype(np.float64)
    after = (means[1:-1] - means[2:]).astype(np.float64)
    return np.where(before * after > 0, np.minimum(np.abs(before), np.abs(after)), 0.0)
