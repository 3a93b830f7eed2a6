"""Super SloMo: the interpolator of the paper's ablation E8, with a checkpoint the user has."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from texvent._require import require
from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError
from texvent.interpolate.networks.device import (
    Placement,
    explain_failures,
    luma_tensor,
    pad_to_multiple,
    picture_tensors,
    place,
)
from texvent.interpolate.networks.files import EXTRA, Tensor
from texvent.interpolate.networks.torch_warp import warp
from texvent.interpolate.super_slomo.layout import FLOW_NET, PAD_TO, REFINE_NET
from texvent.interpolate.super_slomo.network import UNet
from texvent.interpolate.super_slomo.weights import check_checkpoint_path, read_checkpoint
from texvent.pairs.instants import check_between, position
from texvent.runtime.network_files import describe_file
from texvent.video import Frame, FrameStream

MEAN_COLOUR = (0.429, 0.431, 0.397)
"""Subtracted from the pictures that the networks see, as in training."""


class SuperSlomoInterpolator:
    """One network estimates the flow of a pair, another corrects it at every instant.

    Source: Jiang et al., Super SloMo (CVPR 2018), Eqs. 1, 4 and 5; ablation E8 of the paper.
    Deviation: pictures are warped exactly, so that zero flow moves nothing (the open
        implementation scales coordinates by the size instead of the size less one), edges are
        repeated instead of black, and float32 luma is moved, not 8-bit colour.
    """

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: weights, device and precision.
            stream: not used; every interpolator is built alike.

        Raises:
            MissingDependencyError: torch is not installed.
            ConfigError: no weights were named, or "cuda" without a GPU.
            InputError: there is no such file.
            FileFormatError: the weights are damaged or of another network.
        """
        del stream
        require("torch", extra=EXTRA)
        self._path: Path = check_checkpoint_path(config.interpolator_weights)
        self._placement: Placement = place(config)
        networks = read_checkpoint(self._path)
        self._flow_net = self._load(networks[FLOW_NET.key])
        self._refine_net = self._load(networks[REFINE_NET.key])

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name and sha256 of the checkpoint; stored with the events.

        Raises:
            MissingDependencyError, ConfigError, InputError: as when it is built.
        """
        require("torch", extra=EXTRA)
        return describe_file(check_checkpoint_path(config.interpolator_weights))

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames with every point moved along its path from `first` to `second`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Yields:
            One frame per time, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the frames differ in size, a time is not between theirs, or they do not
                fit into the device's memory.
            FileFormatError: the weights give numbers that are NaN or infinite.
        """
        check_between(first, second, times_us)
        torch = require("torch", extra=EXTRA)
        device = self._placement.device
        with torch.inference_mode(), explain_failures(device):
            lumas = luma_tensor(first, device), luma_tensor(second, device)
            mean = torch.tensor(MEAN_COLOUR).reshape(1, 3, 1, 1)
            pictures = torch.cat(
                [pad_to_multiple(one - mean, PAD_TO) for one in picture_tensors(first, second)], 1
            ).to(device)
            flows = self._predict(self._flow_net, pictures)
        for t_us in times_us:
            # Not around the yield: the caller must not inherit the mode.
            with torch.inference_mode(), explain_failures(device):
                picture = self._picture(lumas, pictures, flows, position(first, second, t_us))
            yield Frame(picture, t_us, is_source=False)

    def _load(self, tensors: dict[str, Tensor]) -> UNet:
        placement = self._placement
        return UNet(
            {name: one.to(placement.device, placement.dtype) for name, one in tensors.items()}
        )

    def _predict(self, network: UNet, x: Tensor) -> Tensor:
        """The network's output, float32."""
        return network.predict(x.to(self._placement.dtype)).float()

    def _picture(
        self, lumas: tuple[Tensor, Tensor], pictures: Tensor, flows: Tensor, at: float
    ) -> Tensor:
        """Luma at τ = `at`, [H, W] float32 NumPy."""
        torch = require("torch", extra=EXTRA)
        forward, backward = flows[:, :2], flows[:, 2:]
        to_first = -(1 - at) * at * forward + at * at * backward
        to_second = (1 - at) * (1 - at) * forward - at * (1 - at) * backward
        warped_first = warp(pictures[:, :3], to_first)
        warped_second = warp(pictures[:, 3:], to_second)
        seen = (pictures, flows, to_second, to_first, warped_second, warped_first)
        correction = self._predict(self._refine_net, torch.cat(seen, 1))
        height, width = lumas[0].shape[-2:]
        correction = correction[..., :height, :width]
        to_first = to_first[..., :height, :width] + correction[:, :2]
        to_second = to_second[..., :height, :width] + correction[:, 2:4]
        visible_first = torch.sigmoid(correction[:, 4:])
        weight_first = (1 - at) * visible_first
        weight_second = at * (1 - visible_first)
        mixed = weight_first * warp(lumas[0], to_first) + weight_second * warp(lumas[1], to_second)
        mixed = (mixed / (weight_first + weight_second))[0, 0]
        if not bool(mixed.isfinite().all()):
            raise FileFormatError(
                f"{self._path}: the networks' output is NaN or infinite; with float16 try "
                "bfloat16 or float32"
            )
        return mixed.cpu().numpy()
