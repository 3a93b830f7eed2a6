"""N-ImageNet's classifier: a ResNet34 whose first kernel is 14 px wide; its checkpoint, checked.

Names of tensors are torchvision's. Fewer channels or blocks are read too: the numbers are in the
shapes. Source: J. Kim et al., "N-ImageNet: towards robust, fine-grained object recognition with
event cameras", ICCV 2021, and its program (conv1: kernel 14, stride 2, padding 3).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from texvent.errors import FileFormatError, InputError
from texvent.networks.layer_shapes import Shape, batch_norm
from texvent.networks.layers import EXTRA
from texvent.networks.weight_files import (
    Tensor,
    check_finite,
    describe_mismatch,
    read_mapping,
    shapes_of,
    state_tensors,
)

INPUT_CHANNELS, FIRST_KERNEL = 2, 14
STAGES = 4
KERNEL = 3
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
    tensors = state_tensors(content, path, WHERE_FROM, extra=EXTRA)
    shapes = shapes_of(tensors)
    blocks = _count_blocks(shapes, path)
    _check_shapes(shapes, blocks, path)
    check_finite(tensors, path)
    return ResNetWeights(tensors, blocks)


def tensor_shapes(width: int, blocks: tuple[int, ...], classes: int) -> dict[str, Shape]:
    """Name → shape of every tensor.

    Args:
        width: channels of the first stage, 64 in ResNet34; each later one has twice as many.
        blocks: residual blocks per stage.
        classes: classes told apart.
    """
    shapes: dict[str, Shape] = {
        "conv1.weight": (width, INPUT_CHANNELS, FIRST_KERNEL, FIRST_KERNEL),
        **batch_norm("bn1", width),
    }
    before = width
    for stage, count in enumerate(blocks):
        channels = width * 2**stage
        for block in range(count):
            at = f"layer{stage + 1}.{block}"
            shapes[f"{at}.conv1.weight"] = (channels, before, KERNEL, KERNEL)
            shapes[f"{at}.conv2.weight"] = (channels, channels, KERNEL, KERNEL)
            shapes.update(
                {**batch_norm(f"{at}.bn1", channels), **batch_norm(f"{at}.bn2", channels)}
            )
            if before != channels:
                shapes[f"{at}.downsample.0.weight"] = (channels, before, 1, 1)
                shapes.update(batch_norm(f"{at}.downsample.1", channels))
            before = channels
    return {**shapes, "fc.weight": (classes, before), "fc.bias": (classes,)}


def _count_blocks(shapes: Mapping[str, Shape], path: Path) -> tuple[int, ...]:
    for name, dimensions in (("conv1.weight", 4), ("fc.weight", 2)):
        if len(shapes.get(name, ())) != dimensions:
            raise FileFormatError(f"{path} has no usable {name}: it is no ResNet; {WHERE_FROM}")
    found = []
    for stage in range(1, STAGES + 1):
        numbers = {name.split(".")[1] for name in shapes if name.startswith(f"layer{stage}.")}
        if not numbers:
            raise FileFormatError(f"{path} has no layer{stage}: it is no ResNet; {WHERE_FROM}")
        found.append(len(numbers))
    return tuple(found)


def _check_shapes(shapes: Mapping[str, Shape], blocks: tuple[int, ...], path: Path) -> None:
    width, classes = shapes["conv1.weight"][0], shapes["fc.weight"][0]
    expected = tensor_shapes(width, blocks, classes)
    problem = describe_mismatch(shapes, expected)
    if problem is not None:
        raise FileFormatError(f"{path} {problem}; {WHERE_FROM}")
