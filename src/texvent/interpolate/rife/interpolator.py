"""RIFE: the paper's interpolator, with its published weights."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from texvent.config import InterpolateConfig
from texvent.errors import InputError
from texvent.interpolate.networks import (
    WHITE,
    NetworkInterpolator,
    Tensor,
    import_torch,
    pad_to_multiple,
    warp,
)
from texvent.interpolate.rife.weights import (
    describe_rife_weights,
    find_rife_weights,
    read_rife_weights,
)
from texvent.pairs.tensors import rgb_and_luma
from texvent.video import FrameStream

if TYPE_CHECKING:
    from texvent.interpolate.rife.network import Motion


class RifeInterpolator(NetworkInterpolator):
    """Moves both frames along the flow that a trained network estimates, and mixes them.

    The network only sees the frames; their float32 luma is moved, so intermediate frames have no
    steps.

    Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation
        (ECCV 2022); section 3.2.1 of the paper.
    Deviation: the motion is estimated once per pair, at its middle, and points move straight and
        evenly; the paper estimates it anew at each instant, and differences between the estimates
        flicker. Grey frames are shown to the network as colour, edges are padded by repetition
        instead of with black, and the result is not clipped.
    """

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: weights and device.
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
        self._network = read_rife_weights(self._path).to(self._device)

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
        """As `between`, for images that may be on the device already; results stay on it.

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
        with torch.inference_mode():
            both = (rgb_and_luma(one, self._device) for one in (first, second))
            seen, lumas = zip(*both, strict=True)
            # Scaled down together, so that a bright pair stays in the range the network knows.
            scale = 1.0 / torch.stack([one.amax() for one in seen]).amax().clamp(min=WHITE)
            images = [one * scale for one in seen]
        yield from self._draw(images, lumas, positions)

    def _prepare(self, images: Sequence[Tensor]) -> Motion:
        from texvent.interpolate.rife.network import Motion  # needs torch

        height, width = images[0].shape[-2:]
        pad_to = self._network.layout.pad_to
        padded = (pad_to_multiple(image, pad_to).to(self._device) for image in images)
        motion = self._network(*padded)
        return Motion(motion.flow[..., :height, :width], motion.mask[..., :height, :width])

    def _luma_at(self, pair: Motion, lumas: Sequence[Tensor], at: float) -> Tensor:
        from texvent.interpolate.rife.network import move_motion  # needs torch

        motion = move_motion(pair, at)
        weight = import_torch().sigmoid(motion.mask)
        first, second = warp(lumas[0], motion.flow[:, :2]), warp(lumas[1], motion.flow[:, 2:])
        return (second + (first - second) * weight)[0, 0]
