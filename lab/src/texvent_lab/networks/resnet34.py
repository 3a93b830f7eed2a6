"""N-ImageNet's classifier: a ResNet-34 whose first kernel is 14 px wide, from named tensors.

Names of tensors are torchvision's. Fewer channels or blocks are computed too: the numbers are in
the shapes.

Source: K. He et al., "Deep residual learning for image recognition", CVPR 2016; the first
convolution (kernel 14, stride 2, padding 3) is that of J. Kim et al., "N-ImageNet: towards robust,
fine-grained object recognition with event cameras", ICCV 2021, and its program.
docs/design.md says why no library's.
"""

from __future__ import annotations

from collections.abc import Mapping

from texvent.networks.layer_shapes import Shape, linear
from texvent.networks.weight_files import Tensor
from texvent_lab.networks.layer_shapes import batch_norm, count_blocks
from texvent_lab.networks.layers import Layers

WIDTH, BLOCKS = 64, (3, 4, 6, 3)
"""Channels of the first stage, and residual blocks per stage, of ResNet-34."""
FIRST_KERNEL, FIRST_PADDING, KERNEL = 14, 3, 3


def resnet_shapes(
    channels: int, classes: int, *, width: int = WIDTH, blocks: tuple[int, ...] = BLOCKS
) -> dict[str, Shape]:
    """Name → shape of every tensor.

    Args:
        channels: of the input.
        classes: classes told apart.
        width: channels of the first stage; each later one has twice as many.
        blocks: residual blocks per stage.
    """
    shapes: dict[str, Shape] = {
        "conv1.weight": (width, channels, FIRST_KERNEL, FIRST_KERNEL),
        **batch_norm("bn1", width),
    }
    before = width
    for stage, count in enumerate(blocks):
        after = width * 2**stage
        for block in range(count):
            at = f"layer{stage + 1}.{block}"
            shapes[f"{at}.conv1.weight"] = (after, before, KERNEL, KERNEL)
            shapes[f"{at}.conv2.weight"] = (after, after, KERNEL, KERNEL)
            shapes |= {**batch_norm(f"{at}.bn1", after), **batch_norm(f"{at}.bn2", after)}
            if before != after:
                shapes[f"{at}.downsample.0.weight"] = (after, before, 1, 1)
                shapes |= batch_norm(f"{at}.downsample.1", after)
            before = after
    return {**shapes, **linear("fc", classes, before)}


def count_stages(shapes: Mapping[str, Shape]) -> tuple[int, ...]:
    """Residual blocks per stage, by the names of tensors."""
    counts: list[int] = []
    while count := count_blocks(shapes, f"layer{len(counts) + 1}"):
        counts.append(count)
    return tuple(counts)


def resnet_scores(layers: Layers, blocks: tuple[int, ...], images: Tensor) -> Tensor:
    """One score per class, higher is likelier.

    Args:
        layers: of tensors as `resnet_shapes` says.
        blocks: residual blocks per stage.
        images: [n, channels, H, W].

    Returns:
        [n, classes].
    """
    torch = layers.torch
    x = layers.convolve(images, "conv1", stride=2, padding=FIRST_PADDING)
    x = torch.relu(layers.normalise(x, "bn1"))
    x = torch.nn.functional.max_pool2d(x, 3, stride=2, padding=1)
    for stage, count in enumerate(blocks):
        for block in range(count):
            x = _block(layers, x, f"layer{stage + 1}.{block}", 2 if stage and not block else 1)
    return layers.linear(x.mean(dim=(2, 3)), "fc")


def _block(layers: Layers, x: Tensor, at: str, stride: int) -> Tensor:
    """Two convolutions and a shortcut."""
    relu = layers.torch.relu
    inner = layers.convolve(x, f"{at}.conv1", stride=stride)
    inner = relu(layers.normalise(inner, f"{at}.bn1"))
    inner = layers.normalise(layers.convolve(inner, f"{at}.conv2"), f"{at}.bn2")
    if layers.has(f"{at}.downsample.0.weight"):
        x = layers.convolve(x, f"{at}.downsample.0", stride=stride)
        x = layers.normalise(x, f"{at}.downsample.1")
    return relu(inner + x)
