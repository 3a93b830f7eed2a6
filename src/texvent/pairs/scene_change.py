"""Scene cuts and flashes: changes between two frames that are not motion.

Both are judged on thumbnails (at most 64 cells across, each the mean of at least 2×2 pixels), so
noise and detail hardly count, and in log brightness, so a lamp scales nothing.

* *Structure*: every 8×8-cell block of one thumbnail is looked for within 8 cells in the other, so
  motion of up to an eighth of the image, zoom and moving objects keep it. After a cut most
  blocks are found nowhere, unless the whole image has moved further than that: a whip pan
  agrees at some shift (`shift_agreement`).
* *Level*: the median change over the image. A flash moves most of it by the same step.

A fade moves everything too, but by small steps; near black those are large in log brightness, so
a scene change must also be a large change in intensity.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
from numpy.typing import NDArray

from texvent.brightness import Float64Array, balanced_log
from texvent.frames import Frame
from texvent.pairs.instants import matching_luma

DETAIL_CELLS = 5
"""Detail is the image minus its mean over this many cells: two skies that only share a gradient do
not agree."""
LEAST_OVERLAP = 0.35
"""Share of the image that must overlap for a shift to count."""
LEAST_VARIANCE = 1e-4
"""Variance of log brightness below which agreement means nothing."""


def shift_agreement(first: Float64Array, second: Float64Array) -> float:
    """Agreement of the detail of two images at the best shift.

    Args:
        first: log brightness, [H, W]; a thumbnail, because all shifts are tried.
        second: the same shape.

    Returns:
        Correlation over the overlap, at the shift where it is largest, −1..1. On thumbnails of
        real clips, 300 pairs of unrelated images reached 0.33 at most, and pairs shifted by a
        tenth to half of the width 0.80 at least.
    """
    return float(correlate_shifts(detail(first), detail(second), LEAST_VARIANCE).max())


def correlate_shifts(one: Float64Array, other: Float64Array, least_variance: float) -> Float64Array:
    """The correlation of two images over their overlap, at every shift.

    Args:
        one: [H, W].
        other: the same shape.
        least_variance: smaller variances count as this.

    Returns:
        [2 m + 1, 2 n + 1], −1..1, for shifts by −m..m rows and −n..n columns: in the middle for
        the images as they are, a row further down where `other` shows everything a row further
        down; −1 where too little overlaps.

    Source: masked normalised correlation, Padfield 2012.
    """
    shape = tuple(2 * side for side in one.shape)  # room for every shift without wrapping around
    product = np.fft.irfft2(np.fft.rfft2(other, shape) * np.conj(np.fft.rfft2(one, shape)), shape)
    most = [int((1.0 - LEAST_OVERLAP) * side) for side in one.shape]
    down, across = (np.arange(-m, m + 1) for m in most)
    product = product[np.ix_(down, across)]  # negative shifts are at the end
    # What overlaps is a rectangle at a corner of each image.
    height, width = one.shape
    rows, columns = _overlap(-down, height), _overlap(-across, width)
    other_rows, other_columns = _overlap(down, height), _overlap(across, width)
    count = np.outer(rows[1] - rows[0], columns[1] - columns[0])
    number = np.maximum(count, 1)
    sum_a, sum_b = _sums(one, rows, columns), _sums(other, other_rows, other_columns)
    covariance = product - sum_a * sum_b / number
    spread_a = _sums(one**2, rows, columns) - sum_a**2 / number
    spread_b = _sums(other**2, other_rows, other_columns) - sum_b**2 / number
    floor = number * least_variance
    agreement = covariance / np.sqrt(np.maximum(spread_a, floor) * np.maximum(spread_b, floor))
    return np.where(count >= LEAST_OVERLAP * one.size, agreement, -1.0)


def _overlap(shift: NDArray[np.intp], size: int) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First cell, and the one past the last, of what overlaps along a side."""
    return np.maximum(shift, 0), np.minimum(shift, 0) + size


def _sums(
    image: Float64Array,
    rows: tuple[NDArray[np.intp], NDArray[np.intp]],
    columns: tuple[NDArray[np.intp], NDArray[np.intp]],
) -> Float64Array:
    """Sums over rectangles: of each range of rows, and of columns."""
    total = np.pad(image.cumsum(axis=0), ((1, 0), (0, 0)))
    bands = np.pad((total[rows[1]] - total[rows[0]]).cumsum(axis=1), ((0, 0), (1, 0)))
    return np.asarray(bands[:, columns[1]] - bands[:, columns[0]])


def detail(image: Float64Array) -> Float64Array:
    """The image minus its mean over `DETAIL_CELLS` cells."""
    margin, (height, width) = DETAIL_CELLS // 2, image.shape
    padded = np.pad(image, margin, mode="edge")
    rows, total = np.zeros((height, width + 2 * margin)), np.zeros((height, width))
    for k in range(DETAIL_CELLS):
        rows += padded[k : k + height]
    for k in range(DETAIL_CELLS):
        total += rows[:, k : k + width]
    return np.asarray(image - total / DETAIL_CELLS**2)


SIDE_CELLS = 64
"""Cells of a thumbnail along its longer side, at most."""
LEAST_CELL_PX = 2
BLOCK_CELLS = 8
SEARCH_CELLS = 8
LEAST_SIDE_PX = LEAST_CELL_PX * BLOCK_CELLS
"""Frames with a side below this have no structure to judge and never count as a scene change."""
CELL_SUMS = "_cell_sums"
"""Attribute of frames whose cells were added up on a device (`on_device.measure_pair`)."""
LOG_BALANCE = 30.0
"""Balance of the logarithm of thumbnails, independent of the simulator's own."""

TEXTURE = 0.03
"""Standard deviation of log brightness from which a block has structure to be found again."""
LEAST_TEXTURED = 0.1
"""An image with a smaller share of such blocks is flat: black, white, a plain colour."""
CUT_RESIDUAL = 0.5
"""After a cut, blocks differ from their best match by more than this share of their variance."""
CUT_CORRELATION = 0.8
"""After a cut, half of the blocks correlate with their best match by less than this."""
CUT_CHANGE_LOG = 0.15
CUT_CHANGE_LEVELS = 12.0
"""A cut changes the image by at least this much on average (log units; intensity levels)."""
PAN_AGREEMENT = 0.6
"""Detail that agrees at least this well at one shift of the whole image is a pan, not a cut."""
FLASH_CHANGE_LOG = 0.35
FLASH_CHANGE_LEVELS = 32.0
"""A flash changes the median by at least this much: 1/8 of the scale within one frame."""
FLASH_SHARE = 0.75
"""Share of the image that a flash moves in one direction."""


class SceneChange(Enum):
    """Change between two frames."""

    NONE = "none"
    """Motion, a fade, noise: nothing that interpolation should not bridge."""
    CUT = "cut"
    """Another image."""
    FLASH = "flash"
    """The same image, or none, at another brightness. A flash of one frame is two such changes, up
    and down."""


def detect_scene_change(first: Frame, second: Frame) -> SceneChange:
    """Cut or flash between two frames, which no motion explains.

    Args:
        first: the earlier frame, at least 16×16 px to be judged.
        second: the later frame, same size.

    Returns:
        CUT, FLASH, or NONE; NONE for frames too small to judge.
    """
    if min(first.size) < LEAST_SIDE_PX:
        return SceneChange.NONE
    earlier, later = _thumbnail(first), _thumbnail(second)
    change = _Change.between(earlier, later)
    if not change.is_large:
        return SceneChange.NONE
    one_way, other_way = _match(earlier.log, later.log), _match(later.log, earlier.log)
    if min(one_way.textured, other_way.textured) < LEAST_TEXTURED:
        # One image is flat, so there is no structure to compare.
        if change.is_flash:
            return SceneChange.FLASH
        return SceneChange.CUT if change.mean_levels >= FLASH_CHANGE_LEVELS else SceneChange.NONE
    is_lost = (
        min(one_way.residual, other_way.residual) > CUT_RESIDUAL
        and max(one_way.correlation, other_way.correlation) < CUT_CORRELATION
    )
    if is_lost and change.is_cut:
        is_pan = shift_agreement(earlier.log, later.log) >= PAN_AGREEMENT
        return SceneChange.NONE if is_pan else SceneChange.CUT
    return SceneChange.FLASH if change.is_flash and not is_lost else SceneChange.NONE


@dataclass(frozen=True, eq=False)
class _Thumbnail:
    """Mean intensity per cell, and its brightness."""

    levels: Float64Array
    log: Float64Array


@dataclass(frozen=True)
class _Change:
    """Difference of two thumbnails, cell by cell."""

    mean_levels: float
    mean_log: float
    """Mean absolute change once the median change is taken out, log units."""
    median_levels: float
    median_log: float
    same_direction: float
    """Share of cells that change in the direction of the median."""

    @classmethod
    def between(cls, first: _Thumbnail, second: _Thumbnail) -> _Change:
        levels, log = second.levels - first.levels, second.log - first.log
        median = float(np.median(log))
        return cls(
            mean_levels=float(np.abs(levels).mean()),
            mean_log=float(np.abs(log - median).mean()),
            median_levels=abs(float(np.median(levels))),
            median_log=abs(median),
            same_direction=float(np.mean(np.sign(log) == np.sign(median))),
        )

    @property
    def is_cut(self) -> bool:
        return self.mean_log >= CUT_CHANGE_LOG and self.mean_levels >= CUT_CHANGE_LEVELS

    @property
    def is_flash(self) -> bool:
        return (
            self.median_log >= FLASH_CHANGE_LOG
            and self.median_levels >= FLASH_CHANGE_LEVELS
            and self.same_direction >= FLASH_SHARE
        )

    @property
    def is_large(self) -> bool:
        """Whether the structure is worth comparing."""
        return self.is_cut or self.is_flash or self.mean_levels >= FLASH_CHANGE_LEVELS


@dataclass(frozen=True)
class _Match:
    """Match of the blocks of one thumbnail in another."""

    residual: float
    """Squared difference to the best matches, as a share of the blocks' variance."""
    correlation: float
    """Median over the textured blocks of the best correlation."""
    textured: float
    """Share of the blocks that have structure."""


def cell_px(width: int, height: int) -> int:
    """Side of a cell of the thumbnail of such frames, px; 0 for those too small to judge."""
    if min(width, height) < LEAST_SIDE_PX:
        return 0
    cell = max(LEAST_CELL_PX, -(-max(height, width) // SIDE_CELLS))
    # A long strip keeps at least one block across.
    return min(cell, min(height, width) // BLOCK_CELLS)


def _thumbnail(frame: Frame) -> _Thumbnail:
    cell = cell_px(*frame.size)
    sums = vars(frame).get(CELL_SUMS)
    if sums is None:
        luma = matching_luma(frame)
        rows, columns = luma.shape[0] // cell, luma.shape[1] // cell
        # Rows first: whole rows add up faster than the cells of a row.
        strips = luma[: rows * cell, : columns * cell].reshape(rows, cell, columns * cell)
        sums = strips.sum(axis=1, dtype=np.float64).reshape(rows, columns, cell).sum(axis=2)
    levels = sums / cell**2
    return _Thumbnail(levels, balanced_log(levels, LOG_BALANCE))


def _match(image: Float64Array, other: Float64Array) -> _Match:
    size, area = BLOCK_CELLS, BLOCK_CELLS**2
    windows = np.lib.stride_tricks.sliding_window_view(other, (size, size))
    windows = windows - windows.mean(axis=(2, 3), keepdims=True)
    residuals, variances, correlations = [], [], []
    for top in range(0, image.shape[0] - size + 1, size):
        for left in range(0, image.shape[1] - size + 1, size):
            block = image[top : top + size, left : left + size].ravel()
            block = block - block.mean()
            rows = slice(max(0, top - SEARCH_CELLS), top + SEARCH_CELLS + 1)
            columns = slice(max(0, left - SEARCH_CELLS), left + SEARCH_CELLS + 1)
            near = windows[rows, columns].reshape(-1, area)
            variance = float(block @ block) / area
            near_variance = np.einsum("ij,ij->i", near, near) / area
            product = near @ block / area
            residuals.append(float((variance + near_variance - 2.0 * product).min()))
            variances.append(variance)
            # A hundredth of log brightness is noise: it must not make flat blocks differ.
            scale = np.sqrt((variance + 1e-4) * (near_variance + 1e-4))
            correlations.append(float((product / scale).max()))
    has_texture = np.array(variances) > TEXTURE**2
    return _Match(
        residual=sum(residuals) / (sum(variances) + 1e-4 * len(variances)),
        correlation=(
            float(np.median(np.array(correlations)[has_texture])) if has_texture.any() else 0.0
        ),
        textured=float(has_texture.mean()),
    )
