"""A take: the same scene staged another way, where the prompt leaves it open."""

from __future__ import annotations

from typing import NamedTuple


class Take(NamedTuple):
    """How a scene is staged otherwise than usual."""

    rise_rad: float = 0.0
    """How far the camera goes up around what it looks at."""
    distance: float = 1.0
    """Its distance, as a multiple of the usual one."""
    larger: frozenset[int] = frozenset()
    """Objects of the description that are drawn larger."""
    aim: frozenset[int] = frozenset()
    """Objects of the description at the middle of which the camera looks."""

    is_whole: bool = False
    """Whether all things that are near must be in the picture whole."""


USUAL = Take()
"""Nothing is otherwise."""
