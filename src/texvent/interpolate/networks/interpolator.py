"""What the interpolators with a trained network share: frames in, frames out, failures named."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError
from texvent.interpolate.networks.device import (
    Placement,
    explain_failures,
    image_tensors,
    luma_tensor,
    place,
)
from texvent.interpolate.networks.torch_import import Tensor, import_torch
from texvent.pairs.instants import check_between, position
from texvent.video import Frame


class NetworkInterpolator(ABC):
    """Shows frames to a network, and moves their float32 luma as the network says."""

    def __init__(self, path: Path, config: InterpolateConfig) -> None:
        """An interpolator without its network.

        Args:
            path: the weights file, for messages.
            config: device and precision.

        Raises:
            ConfigError: "cuda" without a GPU.
        """
        self._path = path
        self._placement: Placement = place(config)

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
        lumas = tuple(luma_tensor(frame, self._placement.device) for frame in (first, second))
        positions = [position(first, second, t_us) for t_us in times_us]
        drawn = self._draw(image_tensors(first, second), lumas, positions)
        for t_us, luma in zip(times_us, drawn, strict=True):
            if not bool(luma.isfinite().all()):
                raise FileFormatError(
                    f"{self._path}: the network's output is NaN or infinite; with float16 try "
                    "bfloat16 or float32"
                )
            yield Frame(luma.cpu().numpy(), t_us, is_source=False, transfer=first.transfer)

    def _draw(
        self, images: Sequence[Tensor], lumas: Sequence[Tensor], positions: Sequence[float]
    ) -> Iterator[Tensor]:
        """Luma at every position, [H, W] float32 on the device.

        Args:
            images: what the network sees of both frames, [1, 3, H, W] each, 0..1.
            lumas: what is moved, [1, 1, H, W] each, on the device.
            positions: τ, 0..1, both excluded.
        """
        torch = import_torch()
        pair = None
        for at in positions:
            # Not around the yield: the caller must not inherit the mode.
            with torch.inference_mode(), explain_failures(self._placement.device):
                if pair is None:
                    pair = self._prepare(images)
                luma = self._luma_at(pair, lumas, at)
            yield luma

    @abstractmethod
    def _prepare(self, images: Sequence[Tensor]) -> Any:
        """What all instants of a pair share."""

    @abstractmethod
    def _luma_at(self, pair: Any, lumas: Sequence[Tensor], at: float) -> Tensor:
        """Luma at τ = `at`, [H, W] float32 on the device."""
