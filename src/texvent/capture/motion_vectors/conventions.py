"""Conventions of motion vectors, by renderer, and conversion to pixels."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from texvent._registry import suggest
from texvent.errors import ConfigError, shown

Direction = Literal["forward", "backward"]


@dataclass(frozen=True)
class Convention:
    """Meaning of stored vectors. The defaults are those of `Motion`, Middlebury and KITTI."""

    direction: Direction = "forward"
    """Direction of a field without a name of its own: to the next frame, or the previous one."""
    forward_sign: int = 1
    """1 where a forward vector is the next place minus this one, -1 where it is the opposite."""
    backward_sign: int = 1
    """1 where a backward vector is the previous place minus this one, -1 for the opposite."""
    unit: str = "px"
    """A word of `UNITS`."""
    is_y_up: bool = False
    is_y_first: bool = False
    scale: float = 1.0
    """Multiplies both components, after everything else."""
    offset: float = 0.0
    """Subtracted from the stored numbers first: 0.5 where 0..1 stands for -0.5..0.5."""

    def sign(self, direction: Direction) -> int:
        """1 where a vector points to the other frame's place, -1 where it points away."""
        return self.forward_sign if direction == "forward" else self.backward_sign


UNITS: Mapping[str, tuple[str, bool]] = {
    "px": ("px", False),
    "ndc": ("ndc", False),
    "fraction": ("fraction", False),
    "px/s": ("px", True),
    "ndc/s": ("ndc", True),
    "fraction/s": ("fraction", True),
}
"""Word → what 1 means, and whether it is per second. px: a pixel of the stored field; ndc: half the
image's width or height (it spans -1..1); fraction: its whole width or height."""

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
    "xy": {"is_y_first": False},
    "yx": {"is_y_first": True},
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
    if other.is_y_first != given.is_y_first:
        words.append("yx" if other.is_y_first else "xy")
    if other.scale != given.scale:
        words.append(f"scale={other.scale:g}")
    return tuple(words)


def with_words(text: str, words: Sequence[str]) -> str:
    """The text of a convention with more words; those of it that they contradict go.

    Example:
        >>> with_words("blender,y-down", ["y-up", "scale=2"])
        'blender,scale=2'
    """
    kept = [word for word in map(str.strip, text.split(",")) if word]
    for word in words:
        kept = [one for one in kept if _sets(one) != _sets(word) or one in CONVENTIONS] + [word]
    if kept and kept[0] in CONVENTIONS:
        default = CONVENTIONS[kept[0]]
        kept = kept[:1] + [
            one for one in kept[1:] if parse_convention(f"{kept[0]},{one}") != default
        ]
    said = ",".join(kept)
    return said


def _sets(word: str) -> frozenset[str]:
    """The fields that a word sets."""
    return frozenset(_OVERRIDES.get(word.lower(), {"scale": 1}))


def named_convention(text: str | None) -> str | None:
    """The name of the renderer or data set in a convention, if there is one."""
    words = [word.strip().lower() for word in (text or "").split(",")]
    return next((word for word in reversed(words) if word in CONVENTIONS), None)


def to_pixels(
    stored: NDArray[Any],
    convention: Convention,
    direction: Direction,
    size: tuple[int, int],
    seconds: float,
) -> NDArray[np.float32]:
    """Vectors as `Motion` has them.

    Args:
        stored: [h, w, 2 or more], the first two as the convention orders them.
        convention: what they mean.
        direction: which motion they describe.
        size: width and height of the frame, px; whole multiples of w and h.
        seconds: from this frame to the other one, or back; for units per second.

    Returns:
        [H, W, 2] float32, px of the frame, x right, y down, to the other frame's place. A coarser
        field is repeated, so that no vector is a mean of two surfaces.

    Raises:
        ValueError: the frame is no whole multiple of the field.
    """
    height, width = stored.shape[:2]
    factor = size[0] // width if width else 0
    if factor < 1 or (width * factor, height * factor) != tuple(size):
        raise ValueError(f"{width}x{height} for frames of {size[0]}x{size[1]}")
    return repeat_pixels(scaled(stored, convention, direction, size, factor, seconds), factor)


def scaled(
    stored: NDArray[Any],
    convention: Convention,
    direction: Direction,
    size: tuple[int, int],
    factor: int,
    seconds: float,
) -> NDArray[np.float32]:
    """Vectors [..., 2 or more] in px of the frame, [..., 2]; arguments as `to_pixels`.

    `factor` is how many pixels of the frame one of the field covers in each direction.
    """
    unit, is_per_second = UNITS[convention.unit]
    full = {"px": (factor, factor), "ndc": (size[0] / 2, size[1] / 2), "fraction": size}[unit]
    common = convention.sign(direction) * convention.scale * (seconds if is_per_second else 1.0)
    y_sign = -1.0 if convention.is_y_up else 1.0
    first, second = (1, 0) if convention.is_y_first else (0, 1)
    result = np.empty((*stored.shape[:-1], 2), np.float32)
    result[..., 0] = (stored[..., first] - convention.offset) * (full[0] * common)
    result[..., 1] = (stored[..., second] - convention.offset) * (full[1] * common * y_sign)
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
