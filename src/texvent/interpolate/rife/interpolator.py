"""RIFE: the paper's interpolator, with its published weights."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from texvent.config import InterpolateConfig
from texvent.errors import FileFormatError
from texvent.frames import Frame, FrameStream
from texvent.interpolate.rife.weights import (
    describe_rife_weights,
    find_rife_weights,
    import_torch,
    read_rife_weights,
)
from texvent.networks import Tensor
from texvent.pairs.instants import matching_levels, position
from texvent.pairs.on_device import levels_on, luma_on
from texvent.runtime.devices import Device, explain_device_memory, to_device
from texvent.transfer import WHITE, Transfer

if TYPE_CHECKING:
    from texvent.interpolate.rife.network import IntermediateFlow, RifeNetwork

BYTES_PER_PIXEL = {True: 100, False: 1_000}
"""About what one intermediate frame takes while it is drawn, for each pixel: by a motion that the
frames share, and with the network run anew."""
KEPT = 4
"""Networks that later runs of the process find loaded, by file and device."""
DRAWN_BYTES = 2 << 30
"""Frames are drawn in one batch on a GPU; so much memory for it, at most."""


class RifeInterpolator:
    """Moves both frames along the flow that a trained network estimates, and mixes them.

    The network only sees the frames; their float32 luma is moved, so intermediate frames have no
    steps.

    Source: Huang et al., Real-Time Intermediate Flow Estimation for Video Frame Interpolation
        (ECCV 2022); section 3.2.1 of the paper.
    Deviation: unless `rife_flow` is "each", the motion is estimated once per pair, at its middle,
        and points move straight and evenly. Grey frames are shown to the network as colour, edges
        are padded by repetition instead of with black, and the result is not clipped. On a GPU the
        network computes in float16.
    """

    takes_device: ClassVar[bool] = True
    """Whether it can be built with `device`."""

    def __init__(
        self, config: InterpolateConfig, stream: FrameStream, *, device: Device | None = None
    ) -> None:
        """An interpolator with its weights loaded.

        Args:
            config: the weights, and how often the motion is estimated.
            stream: its size, for messages.
            device: torch.device of the network; None: the CPU.

        Raises:
            MissingDependencyError: torch or safetensors is not installed.
            InputError: there are no weights.
            FileFormatError: the weights are damaged or of another network.
        """
        torch = import_torch()
        self._device = torch.device("cpu") if device is None else device
        self._path = find_rife_weights(config.interpolator_weights)
        state = self._path.stat()
        with explain_device_memory(self._device, stream.size):
            self._network, self._run = _load(
                self._path, self._device, (state.st_ino, state.st_size, state.st_mtime_ns)
            )
        self._is_shared = config.rife_flow == "once"

    @staticmethod
    def provenance(config: InterpolateConfig) -> dict[str, str]:
        """Name, sha256 and layout of the weights file; stored with the events.

        Raises:
            MissingDependencyError, InputError, FileFormatError: as when it is built.
        """
        import_torch()
        return describe_rife_weights(find_rife_weights(config.interpolator_weights))

    def between(self, first: Frame, second: Frame, times_us: Sequence[int]) -> RifeFrames:
        """Frames with every point moved along its path from `first` to `second`.

        Args:
            first: the earlier source frame.
            second: the later source frame.
            times_us: times of the intermediate frames, µs.

        Returns:
            One frame per time, [H, W] float32 luma, 0..255 scale, drawn when it is asked for; the
            motion that they share is estimated before, on a GPU at once.

        Raises:
            InputError: the frames do not fit into the device's memory.
        """
        positions = [position(first, second, t_us) for t_us in times_us]
        is_cpu = self._device.type == "cpu"

        @cache
        def prepare() -> tuple[Sequence[Tensor], Any]:
            with explain_device_memory(self._device, first.size), import_torch().inference_mode():
                frames = (luma_on(one, self._device) for one in (first, second))
                images = image_tensors(first, second, self._device)
                return [one.float()[None, None] for one in frames], self._prepare(images)

        def draw(start: int, stop: int) -> Tensor:
            lumas, prepared = prepare()
            with explain_device_memory(self._device, first.size), import_torch().inference_mode():
                return self._lumas_at(prepared, lumas, positions[start:stop])

        if not is_cpu:
            prepare()  # the GPU begins while the pair before is simulated
        bytes_each = BYTES_PER_PIXEL[self._is_shared] * first.size.width * first.size.height
        at_once = 1 if is_cpu else max(1, DRAWN_BYTES // bytes_each)
        return RifeFrames(times_us, at_once, draw, first.transfer, self._path)

    def _prepare(self, images: Sequence[Tensor]) -> Any:
        """Shared by all instants of a pair: the motion at its middle, or only its images."""
        if not self._is_shared:
            return images
        return self._cropped(images, self._run(*self._padded(images)))

    def _padded(self, images: Sequence[Tensor]) -> list[Tensor]:
        return [pad_to_multiple(image, self._network.layout.pad_to) for image in images]

    def _cropped(self, images: Sequence[Tensor], motion: IntermediateFlow) -> IntermediateFlow:
        from texvent.interpolate.rife.network import IntermediateFlow  # needs torch

        height, width = images[0].shape[-2:]
        return IntermediateFlow(
            motion.flow[..., :height, :width], motion.mask[..., :height, :width]
        )

    def _estimate(self, images: Sequence[Tensor], positions: Sequence[float]) -> IntermediateFlow:
        """The motion at each instant anew."""
        count = len(positions)
        at = to_device(np.array(positions, np.float32)[:, None, None, None], self._device)
        padded = [one.expand(count, -1, -1, -1) for one in self._padded(images)]
        if self._device.type == "cpu":
            return self._cropped(images, self._network(*padded, at))
        from texvent.interpolate.rife.network import estimate_in_half  # needs torch

        return self._cropped(images, estimate_in_half(self._network, *padded, at))

    def _lumas_at(
        self, prepared: Any, lumas: Sequence[Tensor], positions: Sequence[float]
    ) -> Tensor:
        """Luma at K instants, [K, H, W]."""
        from texvent.interpolate.rife.network import move_motion, warp  # needs torch

        make = move_motion if self._is_shared else self._estimate
        motion = make(prepared, positions)
        weight = import_torch().sigmoid(motion.mask)
        images = (one.expand(len(positions), -1, -1, -1) for one in lumas)
        flows = motion.flow[:, :2], motion.flow[:, 2:]
        first, second = (warp(*one) for one in zip(images, flows, strict=True))
        return (second + (first - second) * weight)[:, 0]


@lru_cache(maxsize=KEPT)
def _load(
    path: Path, device: Device, state: object
) -> tuple[RifeNetwork, Callable[..., IntermediateFlow]]:
    """The network of a file on a device, and how it is run there for a pair."""
    del state  # only so that another file under that path is read again
    network = read_rife_weights(path).to(device)
    if device.type != "cuda":
        return network, network
    from texvent.interpolate.rife.network import RecordedNetwork  # needs torch

    return network, RecordedNetwork(network)


@dataclass(frozen=True, eq=False)
class RifeFrames:
    """Intermediate frames of one pair, drawn on the device; see `pairs.on_device.DrawnOnDevice`."""

    times_us: Sequence[int]
    at_once: int
    draw: Callable[[int, int], Tensor]
    transfer: Transfer
    weights: Path

    def __iter__(self) -> Iterator[Frame]:
        """The frames on the host.

        Raises:
            FileFormatError: the weights give numbers that are NaN or infinite.
        """
        for start in range(0, len(self.times_us), self.at_once):
            stop = min(start + self.at_once, len(self.times_us))
            lumas = self.draw(start, stop).cpu().numpy()
            if not np.isfinite(lumas).all():
                raise FileFormatError(f"{self.weights}: the network's output is NaN or infinite")
            for luma, t_us in zip(lumas, self.times_us[start:stop], strict=True):
                yield Frame(luma, t_us, is_source=False, transfer=self.transfer)


def image_tensors(
    first: Frame, second: Frame, device: Device | None = None
) -> tuple[Tensor, Tensor]:
    """Both frames of a pair as a network expects them.

    Grey frames are repeated in all three channels. Levels above white are compressed
    (`pairs.instants.matching_levels`) and both frames are scaled together, so that they stay in
    the range the network knows.

    Returns:
        Two tensors [1, 3, H, W] float32, 0..1, on the device; None: on the CPU.
    """
    torch = import_torch()
    levels = [_levels(one, device or torch.device("cpu")) for one in (first, second)]
    highest = torch.stack([one.max() for one in levels]).max().clamp(min=WHITE)
    scale = (1.0 / highest.double()).float()
    earlier, later = ((one * scale).expand(1, 3, -1, -1) for one in levels)
    return earlier, later


def _levels(frame: Frame, device: Device) -> Tensor:
    """[1 or 3, H, W] float32, 0..255 scale, as `pairs.instants.matching_levels` has them."""
    torch = import_torch()
    levels = levels_on(frame, device)
    if frame.transfer is Transfer.LINEAR:
        levels = to_device(matching_levels(levels.cpu().numpy(), frame.transfer), device)
    else:
        bright = WHITE * (1 + torch.log(levels.clamp(min=WHITE) / WHITE))
        levels = torch.where(levels > WHITE, bright, levels)
    return levels[None] if levels.ndim == 2 else levels.movedim(2, 0)


def pad_to_multiple(image: Tensor, multiple: int) -> Tensor:
    """The image with its right and lower edges repeated up to a multiple of a number of px."""
    height, width = image.shape[-2:]
    below, right = -height % multiple, -width % multiple
    pad = import_torch().nn.functional.pad
    return pad(image, (0, right, 0, below), mode="replicate")
