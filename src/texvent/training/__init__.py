"""Training on simulated events: a stream of batches that never ends; needs torch (extra `torch`).

    import texvent.training

    stream = texvent.training.EventStream("videos/", batch=12, frames=40, size=(128, 128))

Importing this package loads nothing else; each part loads when it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from texvent.training.draws import ClipRanges, PhysicalRanges
    from texvent.training.sources import Clip, ClipSource, PromptClips, StoredClips, VideoClips
    from texvent.training.stream import Batch, EventStream

_HOME_OF = {
    "Batch": "stream",
    "Clip": "sources",
    "ClipRanges": "draws",
    "ClipSource": "sources",
    "EventStream": "stream",
    "PhysicalRanges": "draws",
    "PromptClips": "sources",
    "StoredClips": "sources",
    "VideoClips": "sources",
}

__all__ = [
    "Batch",
    "Clip",
    "ClipRanges",
    "ClipSource",
    "EventStream",
    "PhysicalRanges",
    "PromptClips",
    "StoredClips",
    "VideoClips",
]


def __getattr__(name: str) -> Any:
    """Load a public name on first use (PEP 562)."""
    if name not in _HOME_OF:
        raise AttributeError(f"module 'texvent.training' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"texvent.training.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
