"""Frames of a generated clip, kept for the next simulation of it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol, Self, runtime_checkable

from texvent.frames import FrameStream

MOST_BYTES = 2**29
"""Size of kept frames: .5 s at 304×240 pixels take 60 MB, 2 s at 346×260 about 300 MB. What comes
after that is rendered again."""


class KeptFrames:
    """Frames rendered of a clip; rendered again, they would be equal to the last bit."""

    def __init__(self) -> None:
        self.clear()

    def clear(self) -> None:
        """Forget the clip."""
        self.values, self.bytes = dict[Any, Any](), 0

    def once(self, key: Any, make: Callable[[], Any], size_bytes: int) -> Any:
        """The value of a key, made at its first call and kept while there is room."""
        if key in self.values:
            return self.values[key]
        value = make()
        if self.bytes + size_bytes <= MOST_BYTES:
            self.bytes += size_bytes
            self.values[key] = value
        return value


@runtime_checkable
class KeepingStream(FrameStream, Protocol):
    """Frames that are rendered on demand, and can be kept."""

    def keeping(self, kept: KeptFrames) -> Self:
        """The same frames; what is kept of them is not rendered again."""
        ...
