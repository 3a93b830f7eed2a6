"""Stored depth and ids as `Motion` has them, and what is wrong with vectors and depth."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from texvent.capture.motion_vectors.conventions import repeat_pixels
from texvent.errors import InputError, warn

NO_SURFACE_M = 1e8
"""Depth from here on means that there is no surface: Blender writes 1e10."""
FAR_M = 500.0
"""A median depth beyond this is hardly in metres."""
LONGEST = 1e6
"""Largest number of a vector, in any unit."""
MOST_COMPONENTS = 4
"""Numbers per vector: renderers add unused ones."""
MOST_UNKNOWN = 0.5
"""Share of the vectors of a frame that may be NaN."""


def check_vectors(stored: NDArray[Any], where: str) -> float:
    """Refuse what cannot be vectors.

    Args:
        stored: of one frame.
        where: what to call it in messages.

    Returns:
        The share that is NaN, which counts as not known.

    Raises:
        InputError: not [h, w, 2 or more] numbers, an infinity, or most of it NaN.
    """
    has_shape = stored.ndim == 3 and stored.size and 2 <= stored.shape[2] <= MOST_COMPONENTS
    if not has_shape or stored.dtype.kind not in "fiu":
        hint = ""
        if stored.ndim == 3 and stored.shape[0] == 2:
            hint = "; the components come last: .transpose(1, 2, 0)"
        raise InputError(
            f"{where} has {stored.dtype} of shape {list(stored.shape)}; vectors are numbers "
            f"[H, W, 2]{hint}"
        )
    vectors = stored[..., :2]
    if bool(vectors.min() >= -LONGEST and vectors.max() <= LONGEST):
        return 0.0
    absurd = int((np.abs(vectors.astype(np.float64)) > LONGEST).any(-1).sum())
    if absurd:
        raise InputError(
            f"{where} has {absurd} infinite vector(s), or of more than {LONGEST:g}; write NaN "
            "where none is known"
        )
    unknown = float(np.isnan(vectors).any(-1).mean())
    if unknown > MOST_UNKNOWN:
        raise InputError(
            f"{where} is NaN in {unknown:.0%} of its pixels; at most {MOST_UNKNOWN:.0%} may be "
            "unknown, so render the vectors again or leave them out"
        )
    return unknown


def metric_depth(
    stored: NDArray[Any], scale: float | None, size: tuple[int, int], where: str
) -> NDArray[np.float32]:
    """Depth, m, inf where there is no surface.

    Args:
        stored: [h, w] or [h, w, 1].
        scale: metres per stored unit; None: 1 for floats, and integers are refused.
        size: width and height of the frame.
        where: what to call it in messages.

    Raises:
        InputError: the shape is wrong, integers without a scale, NaN, or a negative depth.
    """
    stored = _plane(stored, size, where)
    if scale is None and stored.dtype.kind in "iu":
        raise InputError(
            f"{where} is in whole numbers, whose unit is not known; give `depth_scale`: metres per "
            "step, such as 0.001 for mm, 0.00390625 for KITTI's PNG"
        )
    depth = stored.astype(np.float32) * np.float32(1.0 if scale is None else scale)
    bad = int((np.isnan(depth) | (depth < 0)).sum())
    if bad:
        raise InputError(
            f"{where} has {bad} value(s) that are NaN or negative; depth is in m, and inf or 0 "
            "where there is no surface"
        )
    depth[(depth == 0) | (depth >= NO_SURFACE_M)] = np.inf
    return np.asarray(depth, dtype=np.float32)


def warn_of_unit(depth: NDArray[np.float32], where: str) -> None:
    """Warn if depth is hardly in metres; it orders surfaces only, so events do not depend on it."""
    near = depth[np.isfinite(depth)]
    middle = float(np.median(near)) if near.size else 0.0
    if middle > FAR_M:
        warn(
            f"{where} has a median of {middle:.0f} m, so it is probably in another unit; give "
            "`depth_scale`: 0.001 for mm, 0.01 for Unreal's cm (events do not change: depth says "
            "which surface is in front)"
        )


def instance_ids(stored: NDArray[Any], size: tuple[int, int], where: str) -> NDArray[np.int32]:
    """Ids of objects, whole numbers; arguments as `metric_depth`.

    Raises:
        InputError: the shape is wrong, or the values are no whole numbers.
    """
    stored = _plane(stored, size, where)
    if stored.dtype.kind == "f" and not (np.isfinite(stored).all() and (stored % 1 == 0).all()):
        raise InputError(
            f"{where} has values that are no whole numbers; ids are, so write them without blending"
        )
    return stored.astype(np.int32)


def _plane(stored: NDArray[Any], size: tuple[int, int], where: str) -> NDArray[Any]:
    if stored.ndim == 3 and stored.shape[2] == 1:
        stored = stored[..., 0]
    width, height = size
    factor = width // stored.shape[1] if stored.ndim == 2 and stored.shape[1] else 0
    if stored.dtype.kind not in "fiu" or factor < 1:
        raise InputError(f"{where} has {stored.dtype} of shape {list(stored.shape)}; it is [H, W]")
    if (stored.shape[1] * factor, stored.shape[0] * factor) != (width, height):
        raise InputError(wrong_size(where, stored.shape, size))
    return repeat_pixels(stored, factor)


def wrong_size(where: str, shape: tuple[int, ...], size: tuple[int, int]) -> str:
    """The message for a field that does not have the size of the frames or a whole fraction."""
    return (
        f"{where} is {shape[1]}x{shape[0]}, the frames are {size[0]}x{size[1]}; it must have their "
        "size, or a half, a third, ... of it in both directions"
    )
