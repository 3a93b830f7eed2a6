"""Super SloMo: the interpolator of the paper's ablation E8, with a checkpoint the user has."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from texvent.config import InterpolateConfig
from texvent.errors import ConfigError, InputError
from texvent.interpolate.networks import (
    NetworkInterpolator,
    Tensor,
    import_torch,
    pad_to_multiple,
    warp,
)
from texvent.networks.weight_files import describe_file
from texvent.video import FrameStream

MEAN_COLOUR = (0.429, 0.431, 0.397)
"""Subtracted from the images that the networks see, as in training."""


@dataclass(frozen=True, eq=False)
class _Pair:
    images: Tensor
    """[1, 6, H, W], padded, less the mean colour."""
    flows: Tensor
    """[1, 4, H, W], px: from the first to the second (x, y), and back."""


class SuperSlomoInterpolator(NetworkInterpolator):
    """One network estimates the flow of a pair, another corrects it at every instant.

    Source: Jiang et al., Super SloMo (CVPR 2018), Eqs. 1, 4 and 5; ablation E8 of the paper.
    Deviation: images are warped exactly, so that zero flow moves nothing (the open
        implementation scales coordinates by the size instead of the size less one), edges are
        repeated instead of black, and float32 luma is moved, not 8-bit colour.
    """

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: weights and device.
            stream: not used; every interpolator is built alike.

        Raises:
            MissingDependencyError: torch is not installed.
            ConfigError: no weights were named, or "cuda" without a GPU.
            InputError: there is no such file.
            FileFormatError: the weights are damaged or of another network.
        """
        del stream
        import_torch()
        from texvent.interpolate.super_slomo.network import PAD_TO, read_checkpoint  # needs torch

        super().__init__(_find_checkpoint(config.interpolator_weights), config)
        networks = read_checkpoint(self._path)
        self._flow_net, self._refine_net = (one.to(self._device) for one in networks)
        self._pad_to = PAD_TO

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name and sha256 of the checkpoint; stored with the events.

        Raises:
            MissingDependencyError, ConfigError, InputError: as when it is built.
        """
        import_torch()
        return describe_file(_find_checkpoint(config.interpolator_weights))

    def _prepare(self, images: Sequence[Tensor]) -> _Pair:
        torch = import_torch()
        mean = torch.tensor(MEAN_COLOUR).reshape(1, 3, 1, 1)
        both = torch.cat([pad_to_multiple(image - mean, self._pad_to) for image in images], 1)
        both = both.to(self._device)
        return _Pair(both, self._flow_net(both))

    def _luma_at(self, pair: _Pair, lumas: Sequence[Tensor], at: float) -> Tensor:
        torch = import_torch()
        forward, backward = pair.flows[:, :2], pair.flows[:, 2:]
        to_first = -(1 - at) * at * forward + at * at * backward
        to_second = (1 - at) * (1 - at) * forward - at * (1 - at) * backward
        warped_first = warp(pair.images[:, :3], to_first)
        warped_second = warp(pair.images[:, 3:], to_second)
        seen = (pair.images, pair.flows, to_second, to_first, warped_second, warped_first)
        correction = self._refine_net(torch.cat(seen, 1))
        height, width = lumas[0].shape[-2:]
        correction = correction[..., :height, :width]
        to_first = to_first[..., :height, :width] + correction[:, :2]
        to_second = to_second[..., :height, :width] + correction[:, 2:4]
        visible_first = torch.sigmoid(correction[:, 4:])
        weight_first = (1 - at) * visible_first
        weight_second = at * (1 - visible_first)
        mixed = weight_first * warp(lumas[0], to_first) + weight_second * warp(lumas[1], to_second)
        return (mixed / (weight_first + weight_second))[0, 0]


def _find_checkpoint(path: Path | None) -> Path:
    """The path of a checkpoint that exists.

    Raises:
        ConfigError: none was named.
        InputError: there is no such file.
    """
    if path is None:
        raise ConfigError(
            "super-slomo needs its network's weights, which no package carries: SuperSloMo.ckpt of "
            "the project avinashpaliwal/Super-SloMo on GitHub. Pass interpolator_weights=PATH"
        )
    if not path.is_file():
        raise InputError(f"there is no weights file {path}; pass SuperSloMo.ckpt")
    return path
