"""One clip on the GPU: the intermediate frames of RIFE go to the kernels without a copy."""

from __future__ import annotations

import math
from typing import Any

from texvent._require import require
from texvent.config import InterpolateConfig, check_range
from texvent.errors import InputError
from texvent.pairs.instants import intermediate_times_us
from texvent.pairs.tensors import Tensor, rgb_and_luma
from texvent.simulate.gpu.launch import EXTRA


class GpuPairs:
    """One clip, source frame by source frame, on the device from image to event."""

    def __init__(
        self,
        simulator: Any,
        interpolator: Any,
        *,
        count: int | None = None,
        max_intermediate: int = InterpolateConfig.max_intermediate,
    ) -> None:
        """Prepare a clip that has seen no frame.

        Args:
            simulator: a `texvent.simulate.gpu.GpuSimulator` that has seen none either.
            interpolator: makes the images between two source frames: has `between_tensors`, as
                `rife.RifeInterpolator` has.
            count: intermediate frames per pair; None: as many as Eq. 4 alone asks for, for which
                the host waits for the device once more.
            max_intermediate: upper limit of Eq. 4's count.

        Raises:
            ConfigError: a count below 0.
        """
        check_range("count", count or 0, 0)
        check_range("max_intermediate", max_intermediate, 0)
        self._simulator, self._interpolator = simulator, interpolator
        self._count, self._cap = count, max_intermediate
        self._seen: tuple[Tensor, Tensor, int] | None = None

    def step(self, image: Tensor, t_us: int) -> Any:
        """Events between the source frame before and this one.

        Scene cuts are not detected; reset the simulator between scenes.

        Args:
            image: [H, W] luma or [3, H, W] RGB, 0..255 scale, uint8 or float32, on the device.
            t_us: its time, µs.

        Returns:
            `texvent.simulate.gpu.EventBatch` of one clip; empty for the first frame.

        Raises:
            InputError: another shape than allowed or before, a time that does not increase, or a
                network whose output is NaN or infinite.

        Equation: (4), section 3.2.1, computed on the device.
        """
        torch = require("torch", extra=EXTRA)
        with torch.no_grad():
            luma = rgb_and_luma(image, str(image.device))[1][0, 0]
            if self._seen is None:
                events = self._simulator.step(luma[None, None], [t_us])
            else:
                events = self._step_pair(image, luma, t_us, self._seen)
        self._seen = image, luma, t_us
        return events

    def _step_pair(
        self, image: Tensor, luma: Tensor, t_us: int, seen: tuple[Tensor, Tensor, int]
    ) -> Any:
        torch = require("torch", extra=EXTRA)
        first, first_luma, first_us = seen
        if first.shape != image.shape:
            raise InputError(
                f"the frame is {list(image.shape)}, the one before is {list(first.shape)}; all "
                "of a clip must have one shape"
            )
        count = self._count
        if count is None:
            count = self._count_intermediate(first_luma, luma)
        times_us = intermediate_times_us(first_us, t_us, count)
        positions = [(one - first_us) / (t_us - first_us) for one in times_us]
        between = self._interpolator.between_tensors(first, image, positions)
        frames = torch.stack([*between, luma])[None]
        flags = [False] * len(times_us) + [True]
        return self._simulator.step(frames, [*times_us, t_us], flags)

    def _count_intermediate(self, first: Tensor, second: Tensor) -> int:
        """Eq. 4's K; see `interpolate.count_policy`."""
        balance = self._simulator.balance
        change = (first.double() + balance).log() - (second.double() + balance).log()
        steps = float(change.abs().max()) / self._simulator.contrast_threshold
        return min(math.floor(steps), self._cap) if math.isfinite(steps) else self._cap
