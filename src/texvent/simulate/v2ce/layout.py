"""What a file of V2CE weights holds: the name and shape of every tensor.

The names are those of the published file, `v2ce_3d.pt`. It describes a 3-D U-Net (Zhang et al.,
ICRA 2024, section on the network): head, four encoders that halve the image and double the
channels, two residual blocks, four decoders, and a last layer that gives 2 polarities × 10 nodes.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TypeAlias

Shape: TypeAlias = tuple[int, ...]

FRAMES = 2
"""Channels that go in: the frames at both ends of an interval."""
POLARITIES = 2
NODES = 10
"""Voxel nodes per polarity and interval."""
BASE_CHANNELS = 32
"""Channels after the head in the published network."""
LEVELS = 4
"""Encoders, and as many decoders."""
RESIDUAL_BLOCKS = 2

HEAD, PREDICTION = "UNet.head.conv3d", "UNet.pred.conv3d"
ENCODERS = tuple(f"UNet.encoders.{level}" for level in range(LEVELS))
MIDDLE = tuple(f"UNet.resblocks.{block}" for block in range(RESIDUAL_BLOCKS))
DECODERS = tuple(f"UNet.decoders.{level}" for level in range(LEVELS))

SPECTRAL = "module.weight_bar"
"""What a convolution's weight is called in a spectrally normalised layer: its direction."""
SPECTRAL_LEFT, SPECTRAL_RIGHT = "module.weight_u", "module.weight_v"
"""Its first singular vectors, as far as training had come."""
BATCH_COUNTER = "num_batches_tracked"
"""A counter that only training reads."""


def tensor_shapes(base_channels: int = BASE_CHANNELS) -> dict[str, Shape]:
    """Name → shape of every tensor of a network whose head gives `base_channels` channels.

    Example:
        >>> shapes = tensor_shapes()
        >>> len(shapes), shapes["UNet.pred.conv3d.weight"]
        (218, (20, 32, 1, 1, 1))
    """
    return dict(_tensors(base_channels))


def _tensors(base: int) -> Iterator[tuple[str, Shape]]:
    yield f"{HEAD}.weight", (base, FRAMES, 3, 3, 3)
    yield f"{HEAD}.bias", (base,)
    for level, name in enumerate(ENCODERS):
        yield from _block(name, base << level, base << (level + 1), is_spectral=False)
    for name in MIDDLE:
        yield from _block(name, base << LEVELS, base << LEVELS, is_spectral=True)
    for level, name in enumerate(DECODERS):
        channels = base << (LEVELS - level)
        # A decoder reads the level below and, beside it, the encoder's input of its own level.
        yield from _block(name, channels + channels // 2, channels // 2, is_spectral=True)
    yield f"{PREDICTION}.weight", (POLARITIES * NODES, base, 1, 1, 1)
    yield f"{PREDICTION}.bias", (POLARITIES * NODES,)


def _block(name: str, before: int, after: int, *, is_spectral: bool) -> Iterator[tuple[str, Shape]]:
    """A residual block: two convolutions, and one of a single pixel around them."""
    for number, channels in ((1, before), (2, after)):
        if is_spectral:
            yield f"{name}.conv{number}.{SPECTRAL_LEFT}", (after,)
            yield f"{name}.conv{number}.{SPECTRAL_RIGHT}", (channels * 27,)
            yield f"{name}.conv{number}.{SPECTRAL}", (after, channels, 3, 3, 3)
        else:
            yield f"{name}.conv{number}.weight", (after, channels, 3, 3, 3)
        yield from _batch_norm(f"{name}.bn{number}", after)
    yield f"{name}.downsample.0.weight", (after, before, 1, 1, 1)
    yield f"{name}.downsample.0.bias", (after,)
    yield from _batch_norm(f"{name}.downsample.1", after)


def _batch_norm(name: str, channels: int) -> Iterator[tuple[str, Shape]]:
    for part in ("weight", "bias", "running_mean", "running_var"):
        yield f"{name}.{part}", (channels,)
    yield f"{name}.{BATCH_COUNTER}", ()
