"""Recurrent networks that see whole sequences at once, for training."""

from __future__ import annotations

import functools
from typing import Any

from texvent.extending import require
from texvent.networks.weight_files import Tensor
from texvent_lab.reconstruct.protocol import PublishedNetwork
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors

_torch: Any = require("torch", extra=EXTRA)


def new_network(published: PublishedNetwork, seed: int) -> TensorNetwork:
    """A network of the published names and shapes, with initial weights.

    It gives an image per voxel grid, [n, windows, 1, H, W] of [n, windows, bins, H, W]. The state
    begins empty and is carried from window to window; gradients go back through all of them.
    """
    tensors = initial_tensors(published.network.tensor_shapes({}), seed)
    return TensorNetwork(tensors, functools.partial(_see_sequence, published))


# A window is compiled, not the whole sequence, which would take as many times longer.
@_torch.compiler.disable(recursive=False)  # type: ignore[untyped-decorator]
def _see_sequence(published: PublishedNetwork, network: Any, voxels: Tensor) -> Tensor:
    recurrent = published.network(network.tensors, {})
    return _torch.stack([recurrent.step(one) for one in voxels.unbind(dim=1)], dim=1)
