"""RVT's backbone: its three published sizes, and the tensors that its checkpoint holds.

Source: M. Gehrig, D. Scaramuzza, "Recurrent vision transformers for object detection with event
cameras" (CVPR 2023), and the configurations released with it.
"""

from __future__ import annotations

from dataclasses import dataclass

from texvent.networks.layer_shapes import Shapes, layer_norm, linear

INPUT_CHANNELS = 20
"""Of the stacked histogram: 2 polarities of 10 bins."""
STRIDES = (4, 2, 2, 2)
"""By how much each stage reduces the image it is given."""
MLP_RATIO = 4
ATTENTIONS = ("att_window", "att_grid")
"""Parts of a stage, in order: attention inside a window, then across the image."""
GATES = 4
"""Of the LSTM: forget, input, output, and the new content."""


@dataclass(frozen=True)
class RvtLayout:
    """One size of the backbone."""

    name: str
    embed_channels: int
    """Channels of the first stage; each later one has twice as many."""
    head_channels: int
    """Channels of one attention head."""

    def channels(self, stage: int) -> int:
        """Channels of a stage, 0..3."""
        return int(self.embed_channels * 2**stage)

    def tensor_shapes(self) -> Shapes:
        """Name → shape of every tensor of the four stages, without the checkpoint's prefix."""
        shapes: Shapes = {}
        channels_in = INPUT_CHANNELS
        for stage, stride in enumerate(STRIDES):
            width, at = self.channels(stage), f"stages.{stage}"
            side = kernel_side(stride)
            shapes[f"{at}.downsample_cf2cl.conv.weight"] = (width, channels_in, side, side)
            shapes |= layer_norm(f"{at}.downsample_cf2cl.norm", width)
            for part in ATTENTIONS:
                shapes |= _attention_shapes(f"{at}.att_blocks.0.{part}", width)
            shapes[f"{at}.lstm.conv1x1.weight"] = (GATES * width, 2 * width, 1, 1)
            shapes[f"{at}.lstm.conv1x1.bias"] = (GATES * width,)
            channels_in = width
        return shapes


def kernel_side(stride: int) -> int:
    """Side of the convolution that reduces by `stride`: neighbours overlap."""
    return 2 * (stride - 1) + 1


def _attention_shapes(at: str, width: int) -> Shapes:
    shapes: Shapes = {}
    if at.endswith("att_grid"):
        # The window's input is normalised already, by the layer before.
        shapes |= layer_norm(f"{at}.norm1", width)
    shapes |= linear(f"{at}.self_attn.qkv", 3 * width, width)
    shapes |= linear(f"{at}.self_attn.proj", width, width)
    shapes[f"{at}.ls1.gamma"] = (width,)
    shapes |= layer_norm(f"{at}.norm2", width)
    shapes |= linear(f"{at}.mlp.net.0.0", MLP_RATIO * width, width)
    shapes |= linear(f"{at}.mlp.net.2", width, MLP_RATIO * width)
    shapes[f"{at}.ls2.gamma"] = (width,)
    return shapes


LAYOUTS: tuple[RvtLayout, ...] = (
    RvtLayout("rvt-t", 32, 32),
    RvtLayout("rvt-s", 48, 24),
    RvtLayout("rvt-b", 64, 32),
)
