"""Ground truth of a rendered instant: depth, instance ids, optical flow, occlusion, boxes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Float32Array = NDArray[np.float32]


@dataclass(frozen=True)
class Box:
    """An object's place in the image."""

    instance: int
    """Its id in `GroundTruth.instance`."""
    class_name: str
    """Its noun, such as "car"."""
    x0: int
    """First column with a visible pixel."""
    y0: int
    """First row with a visible pixel."""
    x1: int
    """One past the last column with a visible pixel."""
    y1: int
    """One past the last row with a visible pixel."""
    visibility: float
    """Visible pixels as a share of those it would cover with nothing before it, within the
    image: above 0, at most 1."""


@dataclass(frozen=True, eq=False)
class GroundTruth:
    """Depth, instance and flow of each pixel's centre, from t0 to t1."""

    depth: Float32Array
    """[H, W] metres along the optical axis; inf for the sky, and where a lens sees nothing."""
    instance: NDArray[np.int32]
    """[H, W] id of the object seen; 0 is ground, sky and scenery without an id."""
    flow: Float32Array
    """[H, W, 2] displacement (x to the right, y down) in pixels from t0 to t1 of the piece of
    surface seen at t0; NaN where it is not in front of the camera at t1, or its lens does not
    reach."""
    occluded: NDArray[np.bool_]
    """[H, W] true where that piece of surface cannot be seen at t1: something stands before it,
    or it is outside the image or behind the camera."""
    boxes: tuple[Box, ...]
    """Boxes at t0 of all objects with an id and at least one visible pixel, by id."""
