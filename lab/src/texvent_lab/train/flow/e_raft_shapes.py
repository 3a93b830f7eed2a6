"""Names and shapes of E-RAFT's published tensors."""

from __future__ import annotations

from texvent.networks.layer_shapes import Shapes, batch_norm, convolution

FEATURES, CONTEXT = "fnet", "cnet"
"""The encoder of both grids, and that of the later one alone."""
UPDATE = "update_block"
WIDTHS = (64, 96, 128)
"""Channels of an encoder at half, a quarter and an eighth of the size."""
FEATURE_CHANNELS, HIDDEN, CONTEXT_CHANNELS = 256, 128, 128
LEVELS, RADIUS = 4, 4
"""Sizes at which correlations are looked up, and how far around, px of each size."""
LOOKED_UP = LEVELS * (2 * RADIUS + 1) ** 2
MOTION = 128
"""Channels of the motion features, the flow itself among them."""
ENLARGEMENT = 8
CONVEX = 9 * ENLARGEMENT**2
"""Weights of the neighbours of each of 8×8 fine pixels."""


def e_raft_shapes(bins: int) -> Shapes:
    """Every tensor, batch counters left out.

    Args:
        bins: of the voxel grids; the published network of DSEC has 15.
    """
    shapes = _encoder_shapes(FEATURES, bins, FEATURE_CHANNELS, has_norm=False)
    shapes |= _encoder_shapes(CONTEXT, bins, HIDDEN + CONTEXT_CHANNELS, has_norm=True)
    motion, unit, head = f"{UPDATE}.encoder", f"{UPDATE}.gru", f"{UPDATE}.flow_head"
    shapes |= convolution(f"{motion}.convc1", 256, LOOKED_UP, 1)
    shapes |= convolution(f"{motion}.convc2", 192, 256, 3)
    shapes |= convolution(f"{motion}.convf1", 128, 2, 7)
    shapes |= convolution(f"{motion}.convf2", 64, 128, 3)
    shapes |= convolution(f"{motion}.conv", MOTION - 2, 64 + 192, 3)
    before = HIDDEN + CONTEXT_CHANNELS + MOTION
    for number, sides in ((1, (1, 5)), (2, (5, 1))):
        for gate in "zrq":
            name = f"{unit}.conv{gate}{number}"
            shapes |= {f"{name}.weight": (HIDDEN, before, *sides), f"{name}.bias": (HIDDEN,)}
    shapes |= convolution(f"{head}.conv1", 256, HIDDEN, 3)
    shapes |= convolution(f"{head}.conv2", 2, 256, 3)
    shapes |= convolution(f"{UPDATE}.mask.0", 256, HIDDEN, 3)
    return shapes | convolution(f"{UPDATE}.mask.2", CONVEX, 256, 1)


def _encoder_shapes(name: str, bins: int, channels: int, *, has_norm: bool) -> Shapes:
    """An encoder whose normalisations are those of the batch, or of each image without tensors."""
    shapes = convolution(f"{name}.conv1", WIDTHS[0], bins, 7)
    if has_norm:
        shapes |= batch_norm(f"{name}.norm1", WIDTHS[0])
    for layer, wide in enumerate(WIDTHS, 1):
        narrow = WIDTHS[max(layer - 2, 0)]
        for block, before in ((0, narrow), (1, wide)):
            inner = f"{name}.layer{layer}.{block}"
            shapes |= convolution(f"{inner}.conv1", wide, before, 3)
            shapes |= convolution(f"{inner}.conv2", wide, wide, 3)
            is_smaller = layer > 1 and block == 0
            if is_smaller:
                shapes |= convolution(f"{inner}.downsample.0", wide, before, 1)
            # The program stores the normalisation of the shortcut under two names.
            norms = ("norm1", "norm2", *(("norm3", "downsample.1") if is_smaller else ()))
            for norm in norms if has_norm else ():
                shapes |= batch_norm(f"{inner}.{norm}", wide)
    return shapes | convolution(f"{name}.conv2", channels, WIDTHS[-1], 1)
