"""Shared parts of the interpolators with a trained network: torch, devices, frames, warping."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from texvent._require import require
from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError, InputError
from texvent.pairs.instants import check_between, matching_levels, position
from texvent.video import UINT16_PER_LEVEL, Frame

EXTRA = "rife"
"""The texvent extra that installs torch and safetensors."""
WHITE = 255.0
Tensor: TypeAlias = Any
"""torch.Tensor."""


def import_torch() -> ModuleType:
    """The module torch.

    Raises:
        MissingDependencyError: it is not installed.
    """
    return require("torch", extra=EXTRA)


class NetworkInterpolator(ABC):
    """Shows frames to a network, and moves their float32 luma as the network says."""

    def __init__(self, path: Path, config: InterpolateConfig) -> None:
        """An interpolator without its network.

        Args:
            path: the weights file, for messages.
            config: the device.

        Raises:
            ConfigError: "cuda" without a GPU.
        """
        self._path = path
        self._device = choose_device()

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
        lumas = tuple(_luma_tensor(frame, self._device) for frame in (first, second))
        positions = [position(first, second, t_us) for t_us in times_us]
        drawn = self._draw(image_tensors(first, second), lumas, positions)
        for t_us, luma in zip(times_us, drawn, strict=True):
            if not bool(luma.isfinite().all()):
                raise FileFormatError(f"{self._path}: the network's output is NaN or infinite")
            yield Frame(luma.cpu().numpy(), t_us, is_source=False, transfer=first.transfer)

    def _draw(
        self, images: Sequence[Tensor], lumas: Sequence[Tensor], positions: Sequence[float]
    ) -> Iterator[Tensor]:
        """Luma at every position, [H, W] float32 on the device.

        Args:
            images: both frames as the network sees them, [1, 3, H, W] each, 0..1.
            lumas: both frames as they are moved, [1, 1, H, W] each, on the device.
            positions: τ, 0..1, both excluded.
        """
        torch = import_torch()
        pair = None
        for at in positions:
            # Not around the yield: the caller must not inherit the mode.
            with torch.inference_mode(), _explain_memory(self._device):
                if pair is None:
                    pair = self._prepare(images)
                luma = self._luma_at(pair, lumas, at)
            yield luma

    @abstractmethod
    def _prepare(self, images: Sequence[Tensor]) -> Any:
        """The state that all instants of a pair share."""

    @abstractmethod
    def _luma_at(self, pair: Any, lumas: Sequence[Tensor], at: float) -> Tensor:
        """Luma at τ = `at`, [H, W] float32 on the device."""


def choose_device() -> str:
    """The device of networks: cuda if torch finds a GPU (`CUDA_VISIBLE_DEVICES=` hides it), or cpu.

    Raises:
        MissingDependencyError: torch is not installed.
    """
    return "cuda" if import_torch().cuda.is_available() else "cpu"


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


def warp(image: Tensor, flow: Tensor) -> Tensor:
    """The image that `flow` looks up: bilinear, edges repeated.

    Args:
        image: [N, C, H, W] float32.
        flow: from each pixel to where it is looked up, [N, 2, H, W] as (x, y), px.

    Returns:
        [N, C, H, W].
    """
    torch = import_torch()
    height, width = image.shape[-2:]
    columns = torch.arange(width, device=flow.device, dtype=torch.float32)
    rows = torch.arange(height, device=flow.device, dtype=torch.float32)
    # grid_sample wants -1..1 from the first pixel's centre to the last one's.
    x = (flow[:, 0] + columns) * (2.0 / max(width - 1, 1)) - 1.0
    y = (flow[:, 1] + rows[:, None]) * (2.0 / max(height - 1, 1)) - 1.0
    return torch.nn.functional.grid_sample(
        image,
        torch.stack((x, y), dim=-1),
        mode="bilinear",
        padding_mode="border",
        align_corners=True,
    )


@contextmanager
def _explain_memory(device: str) -> Iterator[None]:
    """Turn torch's failure of memory into one line.

    Raises:
        InputError: the images do not fit into the device's memory.
    """
    try:
        yield
    except RuntimeError as error:
        if "memory" in str(error):
            raise InputError(
                f"a pair of frames does not fit into the memory of device {device}; choose a "
                "smaller `sensor`, or hide the GPU with CUDA_VISIBLE_DEVICES="
            ) from error
        raise
