"""RVT's checkpoint: the backbone's tensors, checked one by one; the detector is left out."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent.errors import FileFormatError, InputError
from texvent.metrics.rvt import layout as rvt_layout
from texvent.metrics.rvt.layout import RvtLayout
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    named_tensors,
    read_mapping,
    shapes_of,
)

EXTRA = "torch"
"""The texvent extra that brings torch."""
PREFIX = "mdl.backbone."
"""Before the backbone's names in a checkpoint of the whole detector."""
FIRST_TENSOR = "stages.0.downsample_cf2cl.conv.weight"
WHERE_FROM = (
    "the published files are rvt-t.ckpt, rvt-s.ckpt and rvt-b.ckpt, to which the project "
    "uzh-rpg/RVT on GitHub links"
)


@dataclass(frozen=True, eq=False)
class RvtWeights:
    """The tensors of one backbone."""

    layout: RvtLayout
    tensors: Mapping[str, Tensor]
    """Names of `layout.tensor_shapes()` → tensor, float32, on the CPU."""


def read_rvt_weights(path: Path) -> RvtWeights:
    """The backbone's weights from a published checkpoint.

    Args:
        path: `rvt-t.ckpt`, `rvt-s.ckpt` or `rvt-b.ckpt`, trained on Gen1 or on 1 Mpx; which one is
            recognised from its tensors.

    Raises:
        InputError: there is no such file.
        FileFormatError: the file is damaged, or a tensor is missing, unknown or of another shape.
        MissingDependencyError: torch is not installed.
    """
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    state = read_mapping(path, WHERE_FROM, extra=EXTRA).get("state_dict")
    if not isinstance(state, Mapping):
        raise FileFormatError(f"{path} holds no state_dict; it is not RVT's: {WHERE_FROM}")
    tensors = {
        name.removeprefix(PREFIX): tensor
        for name, tensor in named_tensors(state, extra=EXTRA).items()
        if name.startswith(PREFIX)
    }
    layout = _recognise_layout(tensors, path)
    problem = describe_mismatch(shapes_of(tensors), layout.tensor_shapes())
    if problem is not None:
        raise FileFormatError(f"{path} is not {layout.name}: {PREFIX[:-1]} {problem}; {WHERE_FROM}")
    check_finite(tensors, path)
    return RvtWeights(layout, tensors)


def _recognise_layout(tensors: Mapping[str, Tensor], path: Path) -> RvtLayout:
    if FIRST_TENSOR not in tensors:
        raise FileFormatError(
            f"{path} has no tensor {PREFIX}{FIRST_TENSOR}; it is not RVT's: {WHERE_FROM}"
        )
    width = tensors[FIRST_TENSOR].shape[0]
    for layout in rvt_layout.LAYOUTS:
        if layout.embed_channels == width:
            return layout
    sizes = ", ".join(f"{one.embed_channels} ({one.name})" for one in rvt_layout.LAYOUTS)
    raise FileFormatError(
        f"{path} is of a backbone with {width} channels in its first stage; known are {sizes}. "
        f"{WHERE_FROM}"
    )
