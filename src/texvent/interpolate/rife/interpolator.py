"""RIFE: the paper's interpolator, with its published weights."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError
from texvent.interpolate.rife.weights import (
    Tensor,
    describe_rife_weights,
    find_rife_weights,
    import_torch,
    read_rife_weights,
)
from texvent.pairs.instants import matching_levels, position
from texvent.runtime.memory import explain_memory
from texvent.video import UINT16_PER_LEVEL, Frame, FrameStream

if TYPE_CHECKING:
    from texvent.interpolate.rife.network import Motion

WHITE = 255.0


class RifeInterpolator:
    """Moves both frames along the flow that a trained network estimates, and mixes them.

    The network only sees the frames; their float32 luma is moved, so intermediate frames have no
    steps.

    Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation
        (ECCV 2022); section 3.2.1 of the paper.
    Deviation: unless `rife_flow` is "each", the motion is estimated once per pair, at its middle,
        and points move straight and evenly. Grey frames are shown to the network as colour, edges
        are padded by repetition instead of with black, and the result is not clipped.
    """

    def __init__(self, config: InterpolateConfig, stream: FrameStream) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: the weights, and how often the motion is estimated.
            stream: not used; every interpolator is built alike.

        Raises:
            MissingDependencyError: torch or safetensors is not installed.
            InputError: there are no weights.
            FileFormatError: the weights are damaged or of another network.
        """
        del stream
        torch = import_torch()
        self._device = "cuda" if torch.cuda.is_available() else "cpu"
        self._path = find_rife_weights(config.interpolator_weights)
        self._network = read_rife_weights(self._path).to(self._device)
        self._is_shared = config.rife_flow == "once"

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name, sha256 and layout of the weights file; stored with the events.

        Raises:
            MissingDependencyError, InputError, FileFormatError: as when it is built.
        """
        import_torch()
        return describe_rife_weights(find_rife_weights(config.interpolator_weights))

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> Iterator[Frame]:
        """Frames with every point moved along its path from `first` to `second`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Yields:
            One frame per time, [H, W] float32 luma, 0..255 scale.

        Raises:
            InputError: the frames do not fit into the device's memory.
            FileFormatError: the weights give numbers that are NaN or infinite.
        """
        lumas = tuple(_luma_tensor(frame, self._device) for frame in (first, second))
        images, prepared, torch = image_tensors(first, second), None, import_torch()
        what = (
            f"a pair of frames does not fit into the memory of device {self._device}; choose a "
            "smaller `sensor`, or hide the GPU with CUDA_VISIBLE_DEVICES="
        )
        for t_us in times_us:
            at = position(first, second, t_us)
            # Not around the yield: the caller must not inherit the mode.
            with torch.inference_mode(), explain_memory(what):
                prepared = prepared or self._prepare(images)
                luma = self._luma_at(prepared, lumas, at)
            if not bool(luma.isfinite().all()):
                raise FileFormatError(f"{self._path}: the network's output is NaN or infinite")
            yield Frame(luma.cpu().numpy(), t_us, is_source=False, transfer=first.transfer)

    def _prepare(self, images: Sequence[Tensor]) -> Any:
        """Shared by all instants of a pair: the motion at its middle, or only its images."""
        from texvent.interpolate.rife.network import MIDDLE  # needs torch

        return self._estimate(images, MIDDLE) if self._is_shared else images

    def _estimate(self, images: Sequence[Tensor], at: float) -> Motion:
        from texvent.interpolate.rife.network import Motion  # needs torch

        height, width = images[0].shape[-2:]
        pad_to = self._network.layout.pad_to
        padded = (pad_to_multiple(image, pad_to).to(self._device) for image in images)
        motion = self._network(*padded, at)
        return Motion(motion.flow[..., :height, :width], motion.mask[..., :height, :width])

    def _luma_at(self, prepared: Any, lumas: Sequence[Tensor], at: float) -> Tensor:
        from texvent.interpolate.rife.network import move_motion, warp  # needs torch

        shared = self._is_shared
        motion = move_motion(prepared, at) if shared else self._estimate(prepared, at)
        weight = import_torch().sigmoid(motion.mask)
        first, second = warp(lumas[0], motion.flow[:, :2]), warp(lumas[1], motion.flow[:, 2:])
        return (second + (first - second) * weight)[0, 0]


def image_tensors(first: Frame, second: Frame) -> tuple[Tensor, Tensor]:
    """Both frames of a pair as a network expects them.

    Grey frames are repeated in all three channels. Levels above white are compressed
    (`pairs.instants.matching_levels`) and both frames are scaled together, so that they stay in
    the range the network knows.

    Returns:
        Two tensors [1, 3, H, W] float32, 0..1, on the CPU.
    """
    torch = import_torch()
    levels = [_levels(first), _levels(second)]
    scale = np.float32(1.0 / max(WHITE, *(float(one.max()) for one in levels)))
    earlier, later = (
        torch.from_numpy(np.ascontiguousarray(one * scale)).expand(1, 3, -1, -1) for one in levels
    )
    return earlier, later


def _levels(frame: Frame) -> NDArray[np.float32]:
    """[1 or 3, H, W] float32, 0..255 scale, as `pairs.instants.matching_levels` has them."""
    pixels = np.asarray(frame.pixels, dtype=np.float32)
    if frame.pixels.dtype == np.uint16:
        pixels = pixels / np.float32(UINT16_PER_LEVEL)
    pixels = matching_levels(pixels, frame.transfer)
    return pixels[None] if pixels.ndim == 2 else np.moveaxis(pixels, 2, 0)


def _luma_tensor(frame: Frame, device: str) -> Tensor:
    """Luma of a frame, [1, 1, H, W] float32, 0..255 scale, on the device."""
    luma = np.array(frame.luma, dtype=np.float32)
    return import_torch().from_numpy(luma)[None, None].to(device)


def pad_to_multiple(image: Tensor, multiple: int) -> Tensor:
    """The image with its right and lower edges repeated up to a multiple of a number of px."""
    height, width = image.shape[-2:]
    below, right = -height % multiple, -width % multiple
    pad = import_torch().nn.functional.pad
    return pad(image, (0, right, 0, below), mode="replicate")
