"""Data sets: made shard by shard, read back for training, or simulated while they are asked for.

    import texvent.dataset

    samples = texvent.dataset.open("cars", split="train")

Importing this package loads nothing else; each part loads when it is used.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from texvent.dataset.generation.make import make
    from texvent.dataset.simulated_samples import SimulatedSamples
    from texvent.dataset.specification.reading import read_specification
    from texvent.dataset.specification.specification import (
        Filters,
        SampleSource,
        Specification,
        Variant,
    )
    from texvent.dataset.stored.stored_samples import StoredSample, StoredSamples, open

_HOME_OF = {
    "Filters": "specification.specification",
    "SampleSource": "specification.specification",
    "SimulatedSamples": "simulated_samples",
    "Specification": "specification.specification",
    "StoredSample": "stored.stored_samples",
    "StoredSamples": "stored.stored_samples",
    "Variant": "specification.specification",
    "make": "generation.make",
    "open": "stored.stored_samples",
    "read_specification": "specification.reading",
}

__all__ = [
    "Filters",
    "SampleSource",
    "SimulatedSamples",
    "Specification",
    "StoredSample",
    "StoredSamples",
    "Variant",
    "make",
    "open",
    "read_specification",
]


def __getattr__(name: str) -> Any:
    """Load a public name on first use (PEP 562)."""
    if name not in _HOME_OF:
        raise AttributeError(f"module 'texvent.dataset' has no attribute {name!r}")
    value = getattr(importlib.import_module(f"texvent.dataset.{_HOME_OF[name]}"), name)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    """Public names only."""
    return __all__
