"""Measures of a pair of frames that its planning needs, from a device in one wait."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from texvent._require import require
from texvent.frames import Frame
from texvent.pairs.on_device import luma_on
from texvent.pairs.scene_change import CELL_SUMS, cell_px
from texvent.runtime.devices import EXTRA, Device, Tensor
from texvent.transfer import WHITE, Transfer

FLOAT64_ERROR = 1e-12
"""Largest difference of a change of brightness on a device from the host's."""


class PairMeasures(NamedTuple):
    """Bounds of the largest |ΔL| of a pair, log units; the thumbnails are kept with the frames."""

    low: float
    high: float


def measure_pair(first: Frame, second: Frame, balance: float, device: Device) -> PairMeasures:
    """The largest change of brightness, and the thumbnails by which scene changes are found.

    Args:
        first: the earlier frame.
        second: the later frame, same size.
        balance: α, on the 0..255 scale.
        device: where their luma is.
    """
    torch = require("torch", extra=EXTRA)
    frames = (first, second)
    earlier, later = (luma_on(one, device) for one in frames)
    change = ((later.double() + balance).log() - (earlier.double() + balance).log()).abs().max()
    new = [one for one in frames if CELL_SUMS not in vars(one) and _has_thumbnail(one)]
    sums = [_cell_sums(luma_on(one, device), cell_px(*one.size)) for one in new]
    # The host waits for the device here.
    found = torch.cat([change[None], *(one.flatten() for one in sums)]).cpu().numpy()
    parts = np.split(found[1:], np.cumsum([one.numel() for one in sums])[:-1])
    for frame, one, part in zip(new, sums, parts, strict=False):
        vars(frame)[CELL_SUMS] = part.reshape(tuple(one.shape))
    largest = float(found[0])
    largest = math.inf if math.isnan(largest) else largest
    return PairMeasures(largest - FLOAT64_ERROR, largest + FLOAT64_ERROR)


def _has_thumbnail(frame: Frame) -> bool:
    """Whether a scene change is looked for in it, in levels that need no curve of the host's."""
    return cell_px(*frame.size) > 0 and frame.transfer is Transfer.GAMMA


def _cell_sums(luma: Tensor, cell: int) -> Tensor:
    """Sums of `matching_levels` over the cells of a thumbnail, float64."""
    torch = require("torch", extra=EXTRA)
    if luma.is_floating_point():
        bright = luma.clamp(min=WHITE)
        luma = torch.where(luma > WHITE, WHITE * (1 + torch.log(bright / WHITE)), luma)
    rows, columns = luma.shape[0] // cell, luma.shape[1] // cell
    cells = luma[: rows * cell, : columns * cell].double()
    return cells.reshape(rows, cell, columns, cell).sum((1, 3))
