"""RIFE's network on frames of any size: padded, tiled, on any device and at any precision."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from texvent.config import InterpolateConfig
from texvent.interpolate.networks.device import (
    Placement,
    explain_failures,
    pad_to_multiple,
)
from texvent.interpolate.networks.tiles import Tile, cut_tiles, tile_weights
from texvent.interpolate.networks.torch_import import Tensor, import_torch
from texvent.interpolate.rife.network import EncodedPair, Motion, RifeNetwork
from texvent.interpolate.rife.weights import RifeWeights


@dataclass(frozen=True, eq=False)
class PreparedPair:
    """A pair of frames, cut into tiles and encoded."""

    height: int
    width: int
    tiles: tuple[tuple[Tile, EncodedPair], ...]


class RifeEstimator:
    """The motion between two frames at any instant."""

    def __init__(
        self, weights: RifeWeights, placement: Placement, config: InterpolateConfig
    ) -> None:
        """An estimator with loaded weights.

        Args:
            weights: the network.
            placement: where it runs.
            config: the side of tiles, and whether the network is compiled.
        """
        torch = import_torch()
        tensors = {
            name: tensor.to(placement.device, placement.dtype)
            for name, tensor in weights.tensors.items()
        }
        self._layout = weights.layout
        self._placement = placement
        self._tile = config.interpolator_tile
        self._is_compiled = config.interpolator_compile
        self._network = RifeNetwork(weights.layout, tensors)
        estimate: Callable[[EncodedPair, Tensor], Motion] = self._network.estimate
        # Sizes never change within a stream, so nothing is gained by general shapes.
        self._estimate: Any = (
            torch.compile(estimate, dynamic=False) if self._is_compiled else estimate
        )

    def prepare(self, *images: Tensor) -> PreparedPair:
        """What all instants of a pair share.

        Args:
            *images: the earlier and the later one, [1, 3, H, W], 0..1, on any device.

        Raises:
            InputError: they do not fit into the device's memory.
        """
        height, width = images[0].shape[-2:]
        tiles = []
        with self._running():
            for tile in cut_tiles(height, width, self._tile):
                parts = (
                    pad_to_multiple(image[..., tile.rows, tile.columns], self._layout.pad_to).to(
                        self._placement.device, self._placement.dtype
                    )
                    for image in images
                )
                tiles.append((tile, self._network.encode(*parts)))
        return PreparedPair(height, width, tuple(tiles))

    def estimate(self, pair: PreparedPair, position: float) -> Motion:
        """The motion at τ = `position`, of the frames' size.

        Where tiles overlap, their flows and masks are averaged, each counting less towards its
        own edge.

        Raises:
            InputError: the frames do not fit into the device's memory.
            ConfigError: the network cannot be compiled here.
        """
        torch = import_torch()
        instant = torch.tensor(position, dtype=torch.float32, device=self._placement.device)
        with self._running():
            if len(pair.tiles) == 1:
                tile, encoded = pair.tiles[0]
                motion = self._estimate(encoded, instant)
                return Motion(
                    motion.flow[..., : tile.height, : tile.width],
                    motion.mask[..., : tile.height, : tile.width],
                )
            total = torch.zeros(1, 5, pair.height, pair.width, device=self._placement.device)
            weight_sum = torch.zeros(1, 1, pair.height, pair.width, device=self._placement.device)
            for tile, encoded in pair.tiles:
                motion = self._estimate(encoded, instant)
                both = torch.cat((motion.flow, motion.mask), 1)[..., : tile.height, : tile.width]
                weights = torch.from_numpy(tile_weights(tile, pair.height, pair.width))
                weights = weights.to(self._placement.device)
                total[..., tile.rows, tile.columns] += both * weights
                weight_sum[..., tile.rows, tile.columns] += weights
            total /= weight_sum
            return Motion(total[:, :4], total[:, 4:])

    def _running(self) -> Any:
        return explain_failures(self._placement.device, is_compiled=self._is_compiled)
