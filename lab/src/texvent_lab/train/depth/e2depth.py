"""E2Depth: the network of E2VID, giving depth in place of brightness."""

from __future__ import annotations

from typing import Any

from texvent.extending import require
from texvent.networks.layer_shapes import Shapes
from texvent.networks.padding import Padding
from texvent.networks.weight_files import Tensor
from texvent_lab.reconstruct.recurrent_unet import (
    PUBLISHED_BLOCKS,
    PUBLISHED_ENCODERS,
    E2vid,
    UNetVariant,
)
from texvent_lab.train.schedule import EXTRA
from texvent_lab.train.tensor_network import TensorNetwork, initial_tensors

ARCHITECTURE = "E2VIDRecurrent"
"""What the program of E2Depth calls it."""
BINS = 5
KERNEL = 5


def e2depth_shapes(width: int) -> Shapes:
    """Every tensor, by name; the published network has width 32."""
    variant = UNetVariant(
        width=width,
        bins=BINS,
        side=KERNEL,
        encoders=PUBLISHED_ENCODERS,
        blocks=PUBLISHED_BLOCKS,
        has_norm=False,
        is_gru=False,
        is_transposed=False,
    )
    return variant.tensor_shapes(is_dynamic=False)


def make_e2depth(width: int, seed: int) -> TensorNetwork:
    """E2Depth with random weights.

    It takes voxel grids of consecutive windows, [n, windows, 5, H, W], each normalised, and gives
    the log depth at the end of each (see `encode_depth`), [n, windows, 1, H, W].

    Args:
        width: channels of the first layer.
        seed: of the weights.

    Source: J. Hidalgo-Carrió, D. Gehrig, D. Scaramuzza, "Learning monocular dense depth from
        events", 3DV 2020, section 3.2, and its program.
    """
    return TensorNetwork(initial_tensors(e2depth_shapes(width), seed), _unroll)


def settings_of(width: int) -> dict[str, Any]:
    """What the program of E2Depth builds the network from."""
    return {
        "num_bins": BINS,
        "skip_type": "sum",
        "recurrent_block_type": "convlstm",
        "num_encoders": PUBLISHED_ENCODERS,
        "base_num_channels": width,
        "num_residual_blocks": PUBLISHED_BLOCKS,
        "use_upsample_conv": True,
        "norm": "none",
    }


def _unroll(network: Any, grids: Tensor) -> Tensor:
    recurrent = E2vid(network.tensors, {})
    padding = Padding.centred(grids.shape[-2:], recurrent.multiple)
    outputs = [recurrent.step(grid) for grid in padding.around(grids).unbind(1)]
    return padding.off(require("torch", extra=EXTRA).stack(outputs, 1))
