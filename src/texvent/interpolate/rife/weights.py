"""RIFE's weights file: find it, read it, write it."""

from __future__ import annotations

import functools
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.io.atomic import atomic_file
from texvent.networks import (
    describe_file,
    load_strictly,
    named_tensors,
    read_mapping,
)
from texvent.runtime.files.cache_folder import cache_folder

if TYPE_CHECKING:
    from texvent.interpolate.rife.network import RifeNetwork

EXTRA = "rife"
"""The texvent extra that installs torch and safetensors."""
DEFAULT_FILE = "rife.safetensors"
"""Name, in the weights folder, of the file that `texvent weights pull rife` writes."""
WHERE_FROM = (
    "fetch version 4.0 with: texvent weights pull rife; or pass the flownet.pkl of "
    "Practical-RIFE 4.0, 4.6, 4.25 or 4.26 with interpolator_weights=PATH"
)


def import_torch() -> ModuleType:
    """The module torch.

    Raises:
        MissingDependencyError: it is not installed.
    """
    return require("torch", extra=EXTRA)


def find_rife_weights(path: Path | None) -> Path:
    """The weights file: `path`, else the one that was pulled.

    Raises:
        InputError: it does not exist.
    """
    chosen = path or cache_folder("weights") / DEFAULT_FILE
    if not chosen.is_file():
        problem = "there is no weights file" if path else "RIFE's weights are not here:"
        raise InputError(f"{problem} {chosen}; {WHERE_FROM}")
    return chosen


def read_rife_weights(path: Path) -> RifeNetwork:
    """The network in a published file, or in one that `texvent weights pull` converted.

    Tensors outside the blocks and the encoder (a training teacher, a refinement network) are
    ignored.

    Args:
        path: `.safetensors`, or a torch state dict. The layout is recognised from the tensors.

    Returns:
        The network, float32, on the CPU.

    Raises:
        FileFormatError: the file is damaged or holds another network.
        MissingDependencyError: torch or safetensors is not installed.
    """
    torch = import_torch()
    from texvent.interpolate.rife.network import RifeNetwork, closest_layout  # needs torch

    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    tensors = named_tensors(content, path, extra=EXTRA)
    inner = {name: tensor for name, tensor in tensors.items() if _is_network_tensor(name)}
    if not inner:
        raise FileFormatError(
            f"{path} has no tensor of RIFE's network (none is called block0...); {WHERE_FROM}"
        )
    layout, widths = closest_layout(inner)
    with torch.device("meta"):
        network = RifeNetwork(layout, widths)
    load_strictly(network, inner, path, f"closest version: {layout.name}; {WHERE_FROM}")
    return network


def _is_network_tensor(name: str) -> bool:
    """Whether a tensor belongs to the encoder or to a numbered block."""
    part = name.partition(".")[0]
    return part == "encode" or (part.startswith("block") and part[5:].isdigit())


def describe_rife_weights(path: Path) -> dict[str, str]:
    """Name, sha256 and layout of a weights file, for the provenance of events.

    Raises:
        FileFormatError, MissingDependencyError: as `read_rife_weights`.
    """
    facts = describe_file(path)
    return {**facts, "layout": _layout_name(path, facts["sha256"])}


@functools.cache
def _layout_name(path: Path, sha256: str) -> str:
    del sha256  # only so that another file under that path is read again
    return read_rife_weights(path).layout.name


def write_rife_weights(network: RifeNetwork, path: Path) -> None:
    """Store a network's weights as safetensors, replacing a file of that name.

    Raises:
        OutputError: the file cannot be written.
        MissingDependencyError: safetensors is not installed.
    """
    writer = require("safetensors.torch", extra=EXTRA)
    tensors = {name: tensor.contiguous() for name, tensor in network.state_dict().items()}
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(writer.save(tensors, metadata={"layout": network.layout.name}))
