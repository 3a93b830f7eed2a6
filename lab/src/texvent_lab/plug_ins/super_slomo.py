"""Super SloMo: the interpolator of VID2E and of the paper's ablation E8.

Source: H. Jiang et al., "Super SloMo", CVPR 2018. Tensors have the names of SuperSloMo.ckpt, which
the open implementation published and VID2E uses.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, ClassVar

from texvent.config import InterpolateConfig
from texvent.extending import require
from texvent.frames import Frame, FrameStream
from texvent.interpolate.rife.interpolator import RifeInterpolator, image_tensors, pad_to_multiple
from texvent.networks import (
    Tensor,
    describe_file,
    load_strictly,
    named_tensors,
    read_mapping,
)
from texvent.runtime.memory import explain_memory
from texvent_lab.networks import EXTRA, locate_weights

FILE = "SuperSloMo.ckpt"
WHERE_FROM = f"the project avinashpaliwal/Super-SloMo on GitHub links to the published {FILE}"
FLOW, REFINE = "state_dictFC", "state_dictAT"
"""Networks in the file: flow between two images; corrections of it at an instant."""
WIDTHS, SIDES = (32, 64, 128, 256, 512, 512), (7, 5, 3, 3, 3, 3)
"""Channels and sides of the kernels at full size, at half of it ..."""
PAD_TO, LEAK = 32, 0.1
MEAN_COLOUR = (0.429, 0.431, 0.397)
"""Subtracted from the images that the networks see, as in training."""


class SuperSlomoInterpolator(RifeInterpolator):
    """One network estimates the flow of a pair, another corrects it at every instant.

    Deviation: images are warped exactly, so that zero flow moves nothing (the open implementation
        scales coordinates by the size instead of the size less one), edges are repeated instead of
        black, and float32 luma is moved, not 8-bit colour.
    """

    bytes_per_pixel: ClassVar[int] = 2_000

    def __init__(
        self, config: InterpolateConfig, stream: FrameStream, *, device: Any = None
    ) -> None:
        """An interpolator with its weights loaded; every stream has the same."""
        del stream
        torch = require("torch", extra=EXTRA)
        self._device = torch.device("cpu") if device is None else device
        self._is_shared = True
        self._path = find_super_slomo(config.interpolator_weights)
        self._nets: Any = read_super_slomo(self._path).to(self._device)
        self.pair_flow = self
        """`CountPolicy` measures motion by the network's own flow, as VID2E does."""

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name and sha256 of the checkpoint; stored with the events."""
        return describe_file(find_super_slomo(config.interpolator_weights))

    def motion_px(self, first: Frame, second: Frame) -> float:
        """Longest vector of the flows both ways, px."""
        what = f"frames of {first.size} do not fit into the memory of device {self._device}"
        with explain_memory(what), require("torch", extra=EXTRA).inference_mode():
            _, flows = self._prepare(image_tensors(first, second, self._device))
            return float(flows.unflatten(1, (2, 2)).norm(dim=2).max())

    def _prepare(self, images: Sequence[Tensor]) -> Any:
        """Both images less the mean colour, [1, 6, H, W]; flows there and back, [1, 4, H, W]."""
        torch = require("torch", extra=EXTRA)
        mean = torch.tensor(MEAN_COLOUR, device=self._device).reshape(1, 3, 1, 1)
        both = torch.cat([pad_to_multiple(image - mean, PAD_TO) for image in images], 1)
        return both, _run_unet(self._nets[FLOW], both)

    def _lumas_at(self, pair: Any, lumas: Sequence[Tensor], positions: Sequence[float]) -> Tensor:
        torch = require("torch", extra=EXTRA)
        return torch.stack([self._luma_at(pair, lumas, at) for at in positions])

    def _luma_at(self, pair: Any, lumas: Sequence[Tensor], at: float) -> Tensor:
        """Eqs. 1, 4 and 5 of the source."""
        from texvent.interpolate.rife.network import warp  # needs torch

        torch, (images, flows) = require("torch", extra=EXTRA), pair
        forward, backward = flows[:, :2], flows[:, 2:]
        to_first = at * at * backward - (1 - at) * at * forward
        to_second = (1 - at) * (1 - at) * forward - at * (1 - at) * backward
        warped = warp(images[:, 3:], to_second), warp(images[:, :3], to_first)
        known = torch.cat((images, flows, to_second, to_first, *warped), 1)
        correction = _run_unet(self._nets[REFINE], known)
        flows = torch.cat((to_first, to_second), 1) + correction[:, :4]
        height, width = lumas[0].shape[-2:]
        flows, visible = flows[..., :height, :width], correction[:, 4:, :height, :width].sigmoid()
        weights = (1 - at) * visible, at * (1 - visible)
        moved = warp(lumas[0], flows[:, :2]), warp(lumas[1], flows[:, 2:])
        mixed = weights[0] * moved[0] + weights[1] * moved[1]
        return (mixed / (weights[0] + weights[1]))[0, 0]


def find_super_slomo(path: Path | None) -> Path:
    """The checkpoint: the one named, else that in the weights folder.

    Raises:
        InputError: there is no such file.
    """
    option = "interpolator_weights"
    return locate_weights("interpolator super-slomo", FILE, WHERE_FROM, path, option=option)


def read_super_slomo(path: Path) -> Any:
    """The two networks of a published checkpoint by their keys; training's state is left out.

    Raises:
        FileFormatError: the file is damaged, or a tensor is missing, unknown or of another shape.
    """
    content = read_mapping(path, WHERE_FROM, extra=EXTRA)
    tensors: dict[str, Tensor] = {}
    for key in (FLOW, REFINE):
        state = content.get(key)
        inner = named_tensors(state, path, extra=EXTRA) if isinstance(state, Mapping) else {}
        tensors |= {f"{key}.{name}": tensor for name, tensor in inner.items()}
    torch = require("torch", extra=EXTRA)
    with torch.device("meta"):
        networks = torch.nn.ModuleDict({FLOW: unet(torch, 6, 4), REFINE: unet(torch, 20, 5)})
    load_strictly(networks, tensors, path, WHERE_FROM)
    return networks


def unet(torch: Any, inputs: int, outputs: int) -> Any:
    """A U-Net with random weights: five times halved, five times doubled, joined at every size."""

    def two(narrow: int, joined: int, wide: int, side: int) -> Any:
        sizes = {"conv1": narrow, "conv2": joined}
        layers = {one: torch.nn.Conv2d(n, wide, side, padding="same") for one, n in sizes.items()}
        return torch.nn.ModuleDict(layers)

    net = two(inputs, WIDTHS[0], WIDTHS[0], SIDES[0])
    last = len(WIDTHS) - 1
    for depth in range(1, last + 1):
        net[f"down{depth}"] = two(WIDTHS[depth - 1], WIDTHS[depth], WIDTHS[depth], SIDES[depth])
        wide = WIDTHS[last - depth]
        net[f"up{depth}"] = two(WIDTHS[last - depth + 1], 2 * wide, wide, 3)
    net["conv3"] = torch.nn.Conv2d(WIDTHS[0], outputs, 3, padding="same")
    return net


def _run_unet(net: Any, x: Tensor) -> Tensor:
    """[1, inputs, H, W] to [1, outputs, H, W]; H and W are multiples of `PAD_TO`."""
    torch = require("torch", extra=EXTRA)
    functional = torch.nn.functional

    def activated(layer: Any, x: Tensor) -> Tensor:
        return functional.leaky_relu(layer(x), LEAK)

    x, skipped = activated(net["conv2"], activated(net["conv1"], x)), []
    for depth in range(1, len(WIDTHS)):
        skipped.append(x)
        down = net[f"down{depth}"]
        x = activated(down["conv2"], activated(down["conv1"], functional.avg_pool2d(x, 2)))
    for step in range(1, len(WIDTHS)):
        up = net[f"up{step}"]
        x = functional.interpolate(x, scale_factor=2.0, mode="bilinear", align_corners=True)
        joined = torch.cat((activated(up["conv1"], x), skipped.pop()), 1)
        x = activated(up["conv2"], joined)
    return activated(net["conv3"], x)
