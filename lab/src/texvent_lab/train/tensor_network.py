"""Networks given as named tensors, as modules that optimisers train.

texvent computes its networks from named tensors of published names and shapes. Trained tensors
therefore are a checkpoint that texvent, and the programs the layout comes from, read as they are.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from texvent.errors import FileFormatError
from texvent.extending import require
from texvent.networks.layer_shapes import Shapes
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    shapes_of,
    state_tensors,
)
from texvent_lab.train.schedule import EXTRA

_nn: Any = require("torch.nn", extra=EXTRA)
_torch: Any = require("torch", extra=EXTRA)
_Module: Any = _nn.Module
BUFFERS = (".running_mean", ".running_var")
"""Ends of the names of tensors that no gradient changes."""


class TensorNetwork(_Module):
    """Parameters by name, and a function of them and of the input."""

    def __init__(
        self, tensors: Mapping[str, Tensor], compute: Callable[..., Any] | None = None
    ) -> None:
        """Keep copies of the tensors.

        Args:
            tensors: see `initial_tensors`.
            compute: (network, *inputs) → output; see `forward`.
        """
        super().__init__()
        self._compute = compute
        self._names = tuple(tensors)
        for name, tensor in tensors.items():
            if name.endswith(BUFFERS):
                self.register_buffer(_key(name), tensor.clone())
            else:
                self.register_parameter(_key(name), _nn.Parameter(tensor.clone()))

    @property
    def tensors(self) -> dict[str, Tensor]:
        """Name → parameter or buffer."""
        return {name: getattr(self, _key(name)) for name in self._names}

    def read(self, content: Mapping[str, Any], path: Path, where_from: str) -> None:
        """Take over the tensors of a checkpoint.

        Args:
            content: of the file; see `state_tensors`.
            path: of the file, for messages.
            where_from: where to get the right file, for messages.

        Raises:
            FileFormatError: a tensor is missing, unknown, of another shape, NaN or infinite.
        """
        found = state_tensors(content, path, where_from, extra=EXTRA)
        problem = describe_mismatch(shapes_of(found), shapes_of(self.tensors))
        if problem is not None:
            raise FileFormatError(f"{path} does not fit the network: it {problem}; {where_from}")
        check_finite(found, path)
        self.load_state_dict({_key(name): tensor for name, tensor in found.items()})

    def forward(self, *inputs: Any) -> Any:
        """The output for inputs, as `compute` gives it."""
        if self._compute is None:
            raise NotImplementedError("this network was made without a function")
        return self._compute(self, *inputs)


def _key(name: str) -> str:
    # A module allows no point in the name of a parameter.
    return name.replace(".", "/")


def initial_tensors(shapes: Shapes, seed: int, *, normal: str | None = None) -> dict[str, Tensor]:
    """Random tensors as torch's own layers begin with.

    Kernels and their biases are uniform within 1/√(inputs of a neuron); a normalisation begins as
    the identity.

    Args:
        shapes: name → shape.
        seed: of the draws, which depend on the order of names.
        normal: kernels whose names begin so are normal with variance 2/(outputs of a neuron), as
            those of torchvision's ResNets.
    """
    draws = _torch.Generator().manual_seed(seed)
    tensors = {}
    for name, shape in shapes.items():
        owner = name.rpartition(".")[0]
        kernel = shapes.get(f"{owner}.weight", ())
        if len(shape) > 1 and normal is not None and name.startswith(normal):
            deviation = math.sqrt(2 / (shape[0] * math.prod(shape[2:])))
            tensors[name] = deviation * _torch.randn(shape, generator=draws)
        elif len(kernel) > 1:
            limit = 1 / math.sqrt(math.prod(kernel[1:]))
            tensors[name] = (2 * _torch.rand(shape, generator=draws) - 1) * limit
        else:
            is_one = name.endswith((".weight", ".running_var"))
            tensors[name] = _torch.full(shape, float(is_one))
    return tensors
