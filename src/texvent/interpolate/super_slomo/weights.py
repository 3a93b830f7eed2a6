"""Super SloMo's checkpoint: two networks in one file, checked tensor by tensor."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from texvent.errors import ConfigError, FileFormatError, InputError
from texvent.interpolate.networks.torch_import import EXTRA
from texvent.interpolate.super_slomo.layout import FLOW_NET, REFINE_NET, UNetLayout
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)

WHERE_FROM = (
    "the published file is SuperSloMo.ckpt, which the project avinashpaliwal/Super-SloMo on GitHub "
    "links to"
)
FIRST_TENSOR = "conv1.weight"


def check_checkpoint_path(path: Path | None) -> Path:
    """The path of a checkpoint that exists.

    Raises:
        ConfigError: none was named.
        InputError: there is no such file.
    """
    if path is None:
        raise ConfigError(
            "super-slomo needs its network's weights, which no package carries; "
            f"{WHERE_FROM}. Then pass interpolator_weights=PATH"
        )
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    return path


def read_checkpoint(path: Path) -> dict[str, dict[str, Tensor]]:
    """Key of the network in the checkpoint → its tensors, float32, on the CPU.

    Training state beside the two networks is left out.

    Raises:
        FileFormatError: the file is damaged, or a network is missing or of another shape.
        MissingDependencyError: torch is not installed.
    """
    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    return {net.key: _read_network(content, net, path) for net in (FLOW_NET, REFINE_NET)}


def _read_network(content: Mapping[str, Any], net: UNetLayout, path: Path) -> dict[str, Tensor]:
    state = content.get(net.key)
    if not isinstance(state, Mapping):
        raise FileFormatError(f"{path} holds no {net.key}; it is not Super SloMo's. {WHERE_FROM}")
    tensors = named_tensors(state, extra=EXTRA)
    width = getattr(tensors.get(FIRST_TENSOR), "shape", (0,))[0]
    expected = net.tensor_shapes(width)
    problem = describe_mismatch(shapes_of(tensors), expected)
    if problem is not None:
        raise FileFormatError(f"{path}: {net.key} {problem}; {WHERE_FROM}")
    check_finite(tensors, path)
    return tensors
