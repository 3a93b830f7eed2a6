"""RIFE: the paper's interpolator, with its published weights."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from texvent.config import InterpolateConfig
from texvent.errors import InputError
from texvent.interpolate.networks.device import WHITE
from texvent.interpolate.networks.interpolator import NetworkInterpolator
from texvent.interpolate.networks.torch_import import Tensor, import_torch
from texvent.interpolate.networks.torch_warp import warp
from texvent.interpolate.rife.estimator import PreparedPair, RifeEstimator
from texvent.interpolate.rife.network import MIDDLE, Motion, move_motion
from texvent.interpolate.rife.weights import (
    describe_rife_weights,
    find_rife_weights,
    read_rife_weights,
)
from texvent.pairs.tensors import rgb_and_luma
from texvent.video import FrameStream


@dataclass(frozen=True, eq=False)
class _Pair:
    tiles: PreparedPair
    middle: Motion | None
    """The motion at τ = 1/2, where all instants share it."""


class RifeInterpolator(NetworkInterpolator):
    """Moves both frames along the flow that a trained network estimates, and mixes them.

    The network only sees the frames; what is moved is their float32 luma, whatever the network's
    precision, so intermediate frames have no steps.

    Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation
        (ECCV 2022); section 3.2.1 of the paper.
    Deviation: grey frames are shown to the network as colour, edges are padded by repetition
        instead of with black, and the result is not clipped.
    """

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: weights, device, precision, tiles, and how often the flow is estimated.
            stream: not used; every interpolator is built alike.

        Raises:
            MissingDependencyError: torch or safetensors is not installed.
            InputError: there are no weights.
            FileFormatError: the weights are damaged or of another network.
            ConfigError: "cuda" without a GPU.
        """
        del stream
        import_torch()
        super().__init__(find_rife_weights(config.interpolator_weights), config)
        weights = read_rife_weights(self._path)
        self._estimator = RifeEstimator(weights, self._placement, config)
        self._is_shared = config.rife_flow == "shared"

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name, sha256 and layout of the weights file; stored with the events.

        Raises:
            MissingDependencyError, InputError, FileFormatError: as when it is built.
        """
        import_torch()
        return describe_rife_weights(find_rife_weights(config.interpolator_weights))

    def between_tensors(
        self, first: Tensor, second: Tensor, positions: Sequence[float]
    ) -> Iterator[Tensor]:
        """As `between`, for images that may lie on the device already; results stay on it.

        Nothing waits for the device, so the output is not checked: the simulator of
        `texvent.simulate.gpu` refuses NaN and infinite intensities when it counts events.

        Args:
            first: the earlier image, [H, W] luma or [3, H, W] RGB, 0..255 scale, uint8 or float.
            second: the later image, alike.
            positions: τ, 0..1, both excluded.

        Yields:
            One image per position, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the images differ in shape, have another one than allowed, or do not fit
                into the device's memory.
        """
        if first.shape != second.shape:
            raise InputError(
                f"the images are {list(first.shape)} and {list(second.shape)}; both must have "
                "one shape"
            )
        torch = import_torch()
        device = self._placement.device
        with torch.inference_mode():
            seen, lumas = zip(*(rgb_and_luma(one, device) for one in (first, second)), strict=True)
            # Scaled down together, so that a bright pair stays in the range the network knows.
            scale = 1.0 / torch.stack([one.amax() for one in seen]).amax().clamp(min=WHITE)
            images = [one * scale for one in seen]
        yield from self._draw(images, lumas, positions)

    def _prepare(self, images: Sequence[Tensor]) -> _Pair:
        tiles = self._estimator.prepare(*images)
        return _Pair(tiles, self._estimator.estimate(tiles, MIDDLE) if self._is_shared else None)

    def _luma_at(self, pair: _Pair, lumas: Sequence[Tensor], at: float) -> Tensor:
        if pair.middle is None:
            motion = self._estimator.estimate(pair.tiles, at)
        else:
            motion = move_motion(pair.middle, at)
        weight = import_torch().sigmoid(motion.mask)
        first, second = warp(lumas[0], motion.flow[:, :2]), warp(lumas[1], motion.flow[:, 2:])
        return (second + (first - second) * weight)[0, 0]
