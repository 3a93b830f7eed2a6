"""Conventions of motion vectors, by renderer; their conversion to pixels, and of depth and ids."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.errors import ConfigError, InputError, shown

Direction = Literal["forward", "backward"]


@dataclass(frozen=True)
class Convention:
    """Meaning of stored vectors; by default that of `MotionVectors`, Middlebury and KITTI."""

    direction: Direction = "forward"
    """Direction of a field without a name of its own: to the next frame, or the previous one."""
    forward_sign: int = 1
    """1 where a forward vector is the next place minus this one, -1 where it is the opposite."""
    backward_sign: int = 1
    """1 where a backward vector is the previous place minus this one, -1 for the opposite."""
    unit: str = "px"
    """px: a pixel of the stored field; ndc: half the image's width or height (it spans -1..1)."""
    is_y_up: bool = False
    scale: float = 1.0
    """Multiplies both components, after everything else."""
    offset: float = 0.0
    """Subtracted from the stored numbers first: 0.5 where 0..1 stands for -0.5..0.5."""

    def sign(self, direction: Direction) -> int:
        """1 where a vector points to the other frame's place, -1 where it points away."""
        return self.forward_sign if direction == "forward" else self.backward_sign


UNITS = ("px", "ndc")

CONVENTIONS: Mapping[str, Convention] = {
    "standard": Convention(),
    "blender": Convention(forward_sign=-1, is_y_up=True),
    "carla": Convention("backward", backward_sign=-1, unit="ndc", is_y_up=True),
    "unreal": Convention(
        "backward", backward_sign=-1, unit="ndc", is_y_up=True, scale=4.0, offset=0.5
    ),
    "isaac": Convention("backward"),
}
"""Renderer → its convention.

standard: px to the next frame, x right, y down; also Middlebury, KITTI and DSEC.
blender: pass Vector; measured with Blender 5.0: X, Y lead to the previous frame, Z, W away from the
    next one, y up, px.
carla: sensor.camera.optical_flow: the motion since the previous frame, in normalised device
    coordinates (issue 4795 of CARLA); the velocity buffer of Unreal, decoded, is the same.
unreal: MovieRenderQueue_MotionVectors: the same encoded as v / 4 + 0.5 (Common.ush,
    EncodeVelocityToTexture, of Unreal 4).
isaac: motion_vectors of Isaac Lab and Replicator: positive where the movement was to the left and
    to the top, which is the way back to the previous frame.
"""

_OVERRIDES: Mapping[str, Mapping[str, Any]] = {
    "forward": {"direction": "forward"},
    "backward": {"direction": "backward"},
    "to": {"forward_sign": 1, "backward_sign": 1},
    "from": {"forward_sign": -1, "backward_sign": -1},
    **{unit: {"unit": unit} for unit in UNITS},
    "y-down": {"is_y_up": False},
    "y-up": {"is_y_up": True},
}
"""Word → fields that it sets."""
_SCALE = re.compile(r"scale=([0-9.eE+-]+)")


def parse_convention(text: str) -> Convention:
    """The convention that a comma-separated list of words describes, later words changing earlier.

    Example:
        >>> changed = parse_convention("carla,forward,y-down")
        >>> changed.direction, changed.unit, changed.is_y_up
        ('forward', 'ndc', False)

    Raises:
        ConfigError: an unknown word.
    """
    convention = Convention()
    for word in text.split(","):
        word = word.strip().lower()
        scale = _SCALE.fullmatch(word)
        if word in CONVENTIONS:
            convention = CONVENTIONS[word]
        elif word in _OVERRIDES:
            convention = replace(convention, **_OVERRIDES[word])
        elif scale is not None and _number(scale[1]):
            convention = replace(convention, scale=_number(scale[1]))
        else:
            allowed = (*CONVENTIONS, *_OVERRIDES, "scale=NUMBER")
            raise ConfigError(
                f"motion_convention has {shown(word)}; {suggest(word, allowed, longest=300)}"
            )
    return convention


def changes(given: Convention, other: Convention, direction: Direction) -> tuple[str, ...]:
    """The words that make the one convention the other, for a field of this direction.

    Example:
        >>> changes(CONVENTIONS["isaac"], CONVENTIONS["carla"], "backward")
        ('from', 'ndc', 'y-up')
    """
    words: list[str] = []
    if other.direction != given.direction:
        words.append(other.direction)
    if other.sign(other.direction) != given.sign(direction):
        words.append("to" if other.sign(other.direction) > 0 else "from")
    if other.unit != given.unit:
        words.append(other.unit)
    if other.is_y_up != given.is_y_up:
        words.append("y-up" if other.is_y_up else "y-down")
    if other.scale != given.scale:
        words.append(f"scale={other.scale:g}")
    return tuple(words)


def named_convention(text: str | None) -> str | None:
    """The name of the renderer or data set in a convention, if there is one."""
    words = [word.strip().lower() for word in (text or "").split(",")]
    return next((word for word in reversed(words) if word in CONVENTIONS), None)


def to_pixels(
    stored: NDArray[Any],
    convention: Convention,
    direction: Direction,
    size: tuple[int, int],
) -> NDArray[np.float32]:
    """Vectors as `MotionVectors` has them.

    Args:
        stored: [h, w, 2 or more], the first two are x and y.
        convention: what they mean.
        direction: which motion they describe.
        size: width and height of the frame, px; whole multiples of w and h.

    Returns:
        [H, W, 2] float32, px of the frame, x right, y down, to the other frame's place. A coarser
        field is repeated, so that no vector is a mean of two surfaces.
    """
    factor = size[0] // stored.shape[1]
    return repeat_pixels(scaled(stored, convention, direction, size, factor), factor)


def scaled(
    stored: NDArray[Any],
    convention: Convention,
    direction: Direction,
    size: tuple[int, int],
    factor: int,
) -> NDArray[np.float32]:
    """Vectors [..., 2 or more] in px of the frame, [..., 2]; arguments as `to_pixels`.

    `factor` is how many pixels of the frame one of the field covers in each direction.
    """
    full = (size[0] / 2, size[1] / 2) if convention.unit == "ndc" else (factor, factor)
    common = convention.sign(direction) * convention.scale
    y_sign = -1.0 if convention.is_y_up else 1.0
    result = np.empty((*stored.shape[:-1], 2), np.float32)
    result[..., 0] = (stored[..., 0] - convention.offset) * (full[0] * common)
    result[..., 1] = (stored[..., 1] - convention.offset) * (full[1] * common * y_sign)
    return result


def repeat_pixels(field: NDArray[Any], factor: int) -> NDArray[Any]:
    """Every pixel of a field [h, w, ...] as `factor` × `factor` equal ones."""
    return field if factor == 1 else field.repeat(factor, 0).repeat(factor, 1)


def _number(text: str) -> float:
    """A finite number other than 0, or 0.0 where the text is none."""
    try:
        number = float(text)
    except ValueError:
        return 0.0
    return number if np.isfinite(number) else 0.0


NO_SURFACE_M = 1e8
"""Depth from here on means that there is no surface: Blender writes 1e10."""
LONGEST = 1e6
"""Largest number of a vector, in any unit."""
MOST_COMPONENTS = 4
"""Numbers per vector: renderers add unused ones."""
MOST_UNKNOWN = 0.5
"""Share of the vectors of a frame that may be NaN."""


def check_vectors(stored: NDArray[Any], where: str) -> None:
    """Refuse what cannot be vectors. Single NaN are unknown vectors.

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
        return
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
    if stored.size and not -(2**31) <= stored.min() <= stored.max() < 2**32:
        raise InputError(f"{where} has ids of more than 32 bits, which would become one another")
    return stored.astype(np.int64).astype(np.int32)


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
