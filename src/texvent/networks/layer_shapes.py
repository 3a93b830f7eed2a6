"""Names and shapes of the tensors in a file of network weights, layer by layer."""

from __future__ import annotations

from typing import TypeAlias

Shape: TypeAlias = tuple[int, ...]
Shapes: TypeAlias = dict[str, Shape]
"""Name → shape."""

BATCH_COUNTER = "num_batches_tracked"
"""A counter that only training reads; some files have it and some have not."""


def linear(name: str, features_out: int, features_in: int) -> Shapes:
    """A fully connected layer."""
    return {f"{name}.weight": (features_out, features_in), f"{name}.bias": (features_out,)}


def layer_norm(name: str, features: int) -> Shapes:
    """A layer normalisation."""
    return {f"{name}.weight": (features,), f"{name}.bias": (features,)}
