"""RIFE's weights: the file, and the layout of its network."""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path

from texvent._require import require
from texvent.errors import FileFormatError, InputError
from texvent.interpolate.networks.torch_import import EXTRA
from texvent.interpolate.rife.layouts import (
    LAYOUTS,
    RifeLayout,
    is_network_tensor,
    recognise_layout,
)
from texvent.io.atomic import atomic_file
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_file,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)
from texvent.runtime.cache_folder import cache_folder

DEFAULT_FILE = "rife.safetensors"
"""Name, in the weights folder, of the file that `texvent weights pull rife` writes."""
WHERE_FROM = (
    "fetch version 4.0 with: texvent weights pull rife; or pass the flownet.pkl of "
    "Practical-RIFE 4.0, 4.6, 4.25 or 4.26 with interpolator_weights=PATH"
)


@dataclass(frozen=True, eq=False)
class RifeWeights:
    """The tensors of one network."""

    layout: RifeLayout
    tensors: dict[str, Tensor]
    """Name → tensor, float32, on the CPU; nothing but the network's own."""


def find_rife_weights(path: Path | None) -> Path:
    """The weights file: `path`, else the one that was pulled.

    Raises:
        InputError: it does not exist.
    """
    chosen = path or cache_folder("weights") / DEFAULT_FILE
    if not chosen.is_file():
        what = "there is no weights file" if path else "RIFE's weights are not here:"
        raise InputError(f"{what} {chosen}; {WHERE_FROM}")
    return chosen


def read_rife_weights(path: Path) -> RifeWeights:
    """Weights from a published file, or from one that `texvent weights pull` converted.

    Args:
        path: `.safetensors`, or a torch state dict. The layout is recognised from the tensors.

    Raises:
        FileFormatError: the file is damaged or holds another network.
        MissingDependencyError: torch or safetensors is not installed.
    """
    tensors = named_tensors(read_mapping(path, WHERE_FROM, extra=EXTRA), extra=EXTRA)
    inner = {name: tensor for name, tensor in tensors.items() if is_network_tensor(name)}
    layout = recognise_layout(shapes_of(inner))
    if layout is None:
        raise FileFormatError(f"{path} {_describe_layout_mismatch(inner)}; {WHERE_FROM}")
    check_finite(inner, path)
    return RifeWeights(layout, inner)


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


def write_rife_weights(weights: RifeWeights, path: Path) -> None:
    """Store weights as safetensors, replacing a file of that name.

    Raises:
        OutputError: the file cannot be written.
        MissingDependencyError: safetensors is not installed.
    """
    writer = require("safetensors.torch", extra=EXTRA)
    tensors = {name: tensor.contiguous() for name, tensor in weights.tensors.items()}
    with atomic_file(path, overwrite=True) as part:
        part.write_bytes(writer.save(tensors, metadata={"layout": weights.layout.name}))


def _describe_layout_mismatch(tensors: dict[str, Tensor]) -> str:
    """How the tensors differ from the layout that they are closest to."""
    if not tensors:
        return "has no tensor of RIFE's network (none is called block0...)"
    shapes = shapes_of(tensors)
    closest = max(LAYOUTS, key=lambda one: len(shapes.items() & one.tensor_shapes().items()))
    known = ", ".join(layout.name for layout in LAYOUTS)
    problem = describe_mismatch(shapes, closest.tensor_shapes())
    return f"{problem} (closest layout: {closest.name}; known layouts: {known})"
