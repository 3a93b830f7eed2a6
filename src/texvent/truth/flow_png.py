"""Optical flow as 16-bit PNG, as DSEC stores it.

Three channels, in the order of the file (RGB): `u · 128 + 2¹⁵`, `v · 128 + 2¹⁵`, 1 where the
flow is valid. Steps are 1/128 px; displacements lie in ±256 px.

Source: Gehrig et al., E-RAFT: Dense Optical Flow from Event Cameras, 3DV 2021, whose ground truth
DSEC publishes.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

STEPS_PER_PX = 128.0
ZERO = 2.0**15
HIGHEST = 2**16 - 1


def encode_flow(flow: NDArray[np.floating[Any]]) -> NDArray[np.uint16]:
    """Flow as DSEC's pixels.

    Args:
        flow: [H, W, 2] x and y, pixels; NaN where it is not known.

    Returns:
        [H, W, 3] RGB. Where the flow is not known, or beyond ±256 px, it is 0 and not valid.

    Example:
        >>> encode_flow(np.array([[[1.0, -0.5], [np.nan, np.nan]]])).tolist()
        [[[32896, 32704, 1], [32768, 32768, 0]]]
    """
    steps = np.rint(flow.astype(np.float64) * STEPS_PER_PX + ZERO)
    is_valid = np.logical_and(steps >= 0, steps <= HIGHEST).all(axis=2)
    pixels = np.full((*flow.shape[:2], 3), ZERO, dtype=np.uint16)
    pixels[is_valid, :2] = steps[is_valid]
    pixels[..., 2] = is_valid
    return pixels


def decode_flow(pixels: NDArray[np.uint16]) -> NDArray[np.float32]:
    """DSEC's pixels as flow: [H, W, 2] px, NaN where it is not valid."""
    flow = ((pixels[..., :2].astype(np.float64) - ZERO) / STEPS_PER_PX).astype(np.float32)
    flow[pixels[..., 2] == 0] = np.nan
    return flow
