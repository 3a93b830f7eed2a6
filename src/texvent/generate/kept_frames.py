"""Rendered frames of a clip kept in memory, for the next simulation of the same clip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

MOST_BYTES = 2**29
"""Of kept frames: .5 s at 304×240 pixels take 60 MB, 2 s at 346×260 about 300 MB. What comes after
that is rendered again."""

Value = TypeVar("Value")


@dataclass
class KeptFrames:
    """What was made of the frames of a scene; made again, it would be equal to the last bit."""

    most_bytes: int = MOST_BYTES
    """0: nothing is kept."""
    bytes: int = 0
    values: dict[Any, Any] = field(default_factory=dict)

    def once(self, key: Any, make: Callable[[], Value], size: int) -> Value:
        """The value of a key, made where it is not kept.

        Args:
            key: of the value.
            make: makes it.
            size: of the value, bytes.
        """
        if key in self.values:
            kept: Value = self.values[key]
            return kept
        value = make()
        if self.bytes + size <= self.most_bytes:
            self.bytes += size
            self.values[key] = value
        return value
