"""Checkpoints of N-ImageNet's classifier, checked; fewer channels or blocks are read too."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent.errors import FileFormatError, InputError
from texvent.networks.layer_shapes import Shape
from texvent.networks.layers import EXTRA
from texvent.networks.resnet34 import BLOCKS, count_stages, resnet_shapes
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    read_mapping,
    shapes_of,
    state_tensors,
    trained_with,
)

REPRESENTATION, CHANNELS = "binary-event-image", 2
WHERE_FROM = (
    "the published classifiers are linked from the project 82magnolia/n_imagenet on GitHub; this "
    "one is ResNet34 on binary event images (reshape_then_flat_pol)"
)


@dataclass(frozen=True, eq=False)
class ResNetWeights:
    """The tensors of one classifier."""

    tensors: Mapping[str, Tensor]
    """Name → tensor, float32, on the CPU."""
    blocks: tuple[int, ...]
    """Residual blocks per stage; (3, 4, 6, 3) in ResNet34."""

    @property
    def class_count(self) -> int:
        """Classes told apart."""
        return int(self.tensors["fc.weight"].shape[0])


def read_resnet_weights(path: Path) -> ResNetWeights:
    """The classifier's weights from a published checkpoint, or from its tensors alone.

    Args:
        path: `{"state_dict": ...}` as N-ImageNet's program saves it, `{name: tensor}`, or
            `.safetensors`.

    Raises:
        InputError: there is no such file.
        FileFormatError: the file is damaged, or a tensor is missing, unknown or of another shape.
        MissingDependencyError: torch is not installed.
    """
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; {WHERE_FROM}")
    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    shown_to_it = trained_with(content, "network").get("representation", REPRESENTATION)
    if shown_to_it != REPRESENTATION:
        raise FileFormatError(
            f"{path} was trained on {shown_to_it}, and this benchmark shows {REPRESENTATION}; use "
            "texvent evaluate classification"
        )
    tensors = state_tensors(content, path, WHERE_FROM, extra=EXTRA)
    shapes = shapes_of(tensors)
    blocks = _count_blocks(shapes, path)
    _check_shapes(shapes, blocks, path)
    check_finite(tensors, path)
    return ResNetWeights(tensors, blocks)


def _count_blocks(shapes: Mapping[str, Shape], path: Path) -> tuple[int, ...]:
    for name, dimensions in (("conv1.weight", 4), ("fc.weight", 2)):
        if len(shapes.get(name, ())) != dimensions:
            raise FileFormatError(f"{path} has no usable {name}: it is no ResNet; {WHERE_FROM}")
    blocks = count_stages(shapes)
    if len(blocks) < len(BLOCKS):
        raise FileFormatError(
            f"{path} has no layer{len(blocks) + 1}: it is no ResNet; {WHERE_FROM}"
        )
    return blocks


def _check_shapes(shapes: Mapping[str, Shape], blocks: tuple[int, ...], path: Path) -> None:
    width, classes = shapes["conv1.weight"][0], shapes["fc.weight"][0]
    expected = resnet_shapes(CHANNELS, classes, width=width, blocks=blocks)
    problem = describe_mismatch(shapes, expected)
    if problem is not None:
        raise FileFormatError(f"{path} {problem}; {WHERE_FROM}")
